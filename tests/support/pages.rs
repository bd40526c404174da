//! The pages of the documentation and the blocks in them.
#![allow(dead_code, unreachable_pub, reason = "each test file uses a part of it")]

use std::path::{Path, PathBuf};

/// README and every page below `docs`, sorted; `root` is the folder of the project.
pub fn pages(root: &Path) -> Vec<PathBuf> {
    let (mut pages, mut folders) = (vec![root.join("README.md")], vec![root.join("docs")]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("the folder of documentation") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

/// A block of a page.
pub struct Block {
    /// What stands behind the opening fence.
    pub info: String,
    /// Its lines, counted from 0.
    pub lines: std::ops::Range<usize>,
}

impl Block {
    /// The words of the info string: the language, and what else is said.
    pub fn words(&self) -> (&str, &str) {
        self.info.split_once(' ').unwrap_or((&self.info, ""))
    }
}

/// The blocks of a page's lines.
pub fn blocks(lines: &[String]) -> Vec<Block> {
    let (mut found, mut open) = (Vec::new(), None);
    for (number, line) in lines.iter().enumerate() {
        match (open.take(), line.strip_prefix("```")) {
            (None, Some(info)) => open = Some((info.trim().to_owned(), number + 1)),
            (Some((info, start)), Some(_)) => found.push(Block { info, lines: start..number }),
            (still, None) => open = still,
        }
    }
    assert!(open.is_none(), "a block is not closed");
    found
}

/// The lines of a page.
pub fn lines(page: &Path) -> Vec<String> {
    std::fs::read_to_string(page).expect("a page").lines().map(str::to_owned).collect()
}

/// What fragments may refer to.
const BASE: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\nbase_node = { C = \"1 kJ/K\" \
    }\n\
                    [boundary]\nbase_air = { T = \"20 degC\" }\n[resistor]\n\
                    base_path = { from = \"base_node\", to = \"base_air\", R = \"1 K/W\" }\n";

/// The base with the fragment's lines put under the headings that both have.
pub fn completed(fragment: &str) -> String {
    let mut sections: Vec<(String, String)> = Vec::new();
    for line in BASE.lines().chain(std::iter::once("")).chain(fragment.lines()) {
        let heading = if line.starts_with('[') { Some(line.to_owned()) } else { None };
        match heading {
            Some(heading) if !sections.iter().any(|(known, _)| *known == heading) => {
                sections.push((heading, String::new()));
            }
            Some(heading) => {
                let at =
                    sections.iter().position(|(known, _)| *known == heading).expect("just found");
                let section = sections.remove(at);
                sections.push(section); // what follows belongs to it
            }
            None if sections.is_empty() => sections.push((String::new(), format!("{line}\n"))),
            None => sections.last_mut().expect("not empty").1.push_str(&format!("{line}\n")),
        }
    }
    sections.iter().map(|(heading, body)| format!("{heading}\n{body}")).collect()
}
