//! Pages in Chromium, by the protocol of its developer tools, which node speaks.

use std::process::Command;

use serde_json::{Value, json};

use super::Folder;

const BROWSE: &str = include_str!("browse.mjs");

/// The values of an expression in pages, each at a width in pixels. No page says anything on the
/// console or requests anything. `None` without node or Chromium, which `LPTN_REQUIRE_ORACLES`
/// requires.
pub fn browsed(folder: &Folder, pages: &[(&str, u32)], expression: &str) -> Option<Vec<Value>> {
    folder.write("browse.mjs", BROWSE);
    let pages: Vec<String> = pages.iter().map(|(name, width)| format!("{width}:{name}")).collect();
    let mut node = Command::new("node");
    node.args(["browse.mjs", ".", expression]).args(&pages).current_dir(folder.path());
    let output = node.output().ok().map(|output| String::from_utf8(output.stdout).unwrap());
    let found: Vec<Value> = output
        .iter()
        .flat_map(|text| text.lines())
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    if found.is_empty() || found[0]["missing"] == true {
        let required = std::env::var_os("LPTN_REQUIRE_ORACLES").is_some();
        assert!(!required, "node and chromium are required");
        eprintln!("skipped: there is no node, or no chromium");
        return None;
    }
    assert_eq!(found.len(), pages.len());
    for (page, found) in pages.iter().zip(&found) {
        let silent = (&found["said"], &found["requested"]);
        assert_eq!(silent, (&json!([]), &json!([])), "{page}");
    }
    Some(found.into_iter().map(|mut found| found["value"].take()).collect())
}
