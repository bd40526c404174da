//! The same bytes on every processor.

#![allow(clippy::unwrap_used, reason = "a helper of a test that cannot go on")]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The C library without fused multiplication and wide vectors, as on an older processor.
const OLDER: &str = "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable";

fn networks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let mut found: Vec<PathBuf> = folder.read_dir().unwrap().map(|e| e.unwrap().path()).collect();
    found.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    found.sort();
    found
}

fn printed(verb: &[&str], network: &Path, processor: Option<&str>) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lptn"));
    command.args(verb).arg(network).env_remove("GLIBC_TUNABLES");
    if let Some(processor) = processor {
        command.env("GLIBC_TUNABLES", processor);
    }
    command.output().unwrap().stdout
}

/// The elementary functions of the C library differ in the last digit between processors: runs of
/// `drive_cycle.toml`, `gearbox_parts.toml` and `sunlit_wall.toml` did.
#[test]
fn results_do_not_depend_on_the_processor() {
    let networks = networks();
    assert!(networks.len() > 30);
    let run: &[&str] = &["run", "--no-files", "--format", "csv"];
    let verify: &[&str] = &["verify", "--format", "json"];
    for network in &networks {
        for verb in [run, verify] {
            let (here, older) = (printed(verb, network, None), printed(verb, network, Some(OLDER)));
            assert!(!here.is_empty() && here == older, "{} {}", verb[0], network.display());
        }
    }
}

/// Closed forms of sweeps have decompositions of their own, which no library chooses by the
/// processor.
#[test]
fn sweeps_do_not_depend_on_the_processor() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/cookbook/candidates.md");
    let page = std::fs::read_to_string(page).unwrap();
    let netlist = page.split("```toml motor.toml\n").nth(1).unwrap().split("```").next().unwrap();
    let file = std::env::temp_dir().join(format!("lptn-processors-{}.toml", std::process::id()));
    std::fs::write(&file, netlist).unwrap();
    let sweep: &[&str] = &["sweep", "--no-files", "--format", "csv"];
    let (here, older) = (printed(sweep, &file, None), printed(sweep, &file, Some(OLDER)));
    std::fs::remove_file(&file).unwrap();
    assert!(here.len() > 10_000 && here == older);
}
