//! The same bytes on every processor.
//!
//! Without QEMU's user mode (`qemu-user`) the tests of other processors say so and pass, unless
//! `LPTN_REQUIRE_ORACLES` is set.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test that cannot go on has failed, and one that cannot begin says why"
)]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The C library without fused multiplication and wide vectors, as on an older processor.
const OLDER: &str = "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable";

/// Without AVX (2008), and with AVX2 and fused multiplication (2013): faer and pulp, which ask the
/// processor themselves, take other kernels on each.
const PROCESSORS: [&str; 2] = ["Nehalem", "Haswell"];

/// What every verb prints of something small. All decompositions are asked for: symmetric (modes,
/// verify), without symmetry and with pairs (streams), of singular values (fits), and so on.
const COMMANDS: [&str; 20] = [
    "run networks/gearbox_fan.toml --no-files --format csv",
    "run networks/paper_bed.toml --uncertainty linear --no-files --format json",
    "steady networks/gearbox.toml --format json",
    "steady networks/welding_gun.toml --periodic --format json",
    "modes networks/gearbox.toml --format json",
    "modes networks/chip.toml --at steady --format json",
    "verify networks/gearbox.toml --format json",
    "verify networks/room_heavy.toml --format json",
    "compare networks/candidates --no-files --format json",
    "size networks/candidates/fan.toml --format json",
    "rank networks/gearbox.toml --format json",
    "reduce networks/gearbox.toml --port steel --format json",
    "reduce networks/rc_ladder.toml --port n8 --nodes 3 --format json",
    "impedance networks/rc_ladder.toml --port n8 --foster 3 --format json",
    "impedance networks/rc_ladder.toml --port n8 --to n1 --omega 1mHz --format json",
    "fit step docs/records/synthetic_ring.csv --column ring --format json",
    "fit network networks/coffee.toml --format json",
    "fit law POINTS --format json",
    "sweep SWEEP --no-files --format csv",
    "modes STREAMS --format json",
];

/// A ring of streams, whose modes swing.
const STREAMS: &str = r#"format = 1
default.T0 = "20 degC"
node.a = { C = "100 J/K" }
node.b = { C = "150 J/K" }
node.c = { C = "200 J/K" }
node.d = { C = "130 J/K" }
boundary.room.T = "20 degC"
advection.ab = { from = "a", to = "b", mcp = "2 W/K" }
advection.bc = { from = "b", to = "c", mcp = "2 W/K" }
advection.cd = { from = "c", to = "d", mcp = "2 W/K" }
advection.da = { from = "d", to = "a", mcp = "2 W/K" }
resistor.wall = { from = "a", to = "room", R = "2 K/W" }
resistor.lid = { from = "c", to = "room", R = "3 K/W" }
"#;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn networks() -> Vec<PathBuf> {
    let folder = root().join("networks");
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

/// A block of a page that is a file, without the fences.
fn block(page: &str, name: &str) -> String {
    let page = std::fs::read_to_string(root().join(page)).unwrap();
    page.split(&format!(" {name}\n")).nth(1).unwrap().split("```").next().unwrap().to_owned()
}

/// Files that the commands name in capitals, in a folder that goes with this.
struct Files(PathBuf);

impl Files {
    fn new() -> Self {
        let folder = std::env::temp_dir().join(format!("lptn-processors-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("STREAMS"), STREAMS).unwrap();
        let sweep = root().join("docs/netlists/motor_sweep.toml");
        std::fs::copy(sweep, folder.join("SWEEP")).unwrap();
        let points = block("docs/fit-law.md", "points.csv");
        std::fs::write(folder.join("POINTS"), points).unwrap();
        Self(folder)
    }

    /// The words of a command with the paths of these files.
    fn words(&self, command: &str) -> Vec<String> {
        let own = |word: &str| self.0.join(word).display().to_string();
        let capital = |word: &str| word.chars().all(|c| c.is_ascii_uppercase());
        let word = |word: &str| if capital(word) { own(word) } else { word.to_owned() };
        command.split(' ').map(word).collect()
    }

    fn on(&self, processor: Option<&str>, command: &str) -> Option<Vec<u8>> {
        let program = env!("CARGO_BIN_EXE_lptn");
        let mut all = match processor {
            Some(processor) => {
                let mut qemu = Command::new("qemu-x86_64");
                qemu.args(["-cpu", processor, program]);
                qemu
            }
            None => Command::new(program),
        };
        all.args(self.words(command)).current_dir(root()).stdin(Stdio::null());
        Some(all.output().ok()?.stdout)
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The elementary functions of the C library differ in the last digit between processors: runs of
/// `drive_cycle.toml`, `gearbox_parts.toml` and `sunlit_wall.toml` did.
#[test]
fn results_do_not_depend_on_the_c_library() {
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

/// Decompositions of a library that chooses its kernels by the processor differed in the last
/// digits: modes, verifications, reductions, impedances, fits.
#[test]
fn no_verb_depends_on_the_processor() {
    let required = std::env::var_os("LPTN_REQUIRE_ORACLES").is_some();
    if Command::new("qemu-x86_64").arg("--version").output().is_err() {
        assert!(!required, "qemu-user is required");
        return eprintln!("skipped: there is no qemu-x86_64 (Debian: qemu-user)");
    }
    let files = Files::new();
    for command in COMMANDS {
        let here = files.on(None, command).unwrap();
        let text = String::from_utf8_lossy(&here);
        let refused = text.contains(r#""exit": 2"#) || text.contains(r#""exit": 3"#);
        assert!(here.len() > 200 && !refused, "{command} prints {text}");
        for processor in PROCESSORS {
            assert!(files.on(Some(processor), command).unwrap() == here, "{command} {processor}");
        }
    }
}
