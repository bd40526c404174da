//! Runs the program in a folder of its own.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

pub mod browse;
pub mod random;

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

/// The gearbox of the seed paper, `networks/gearbox.toml`.
pub const GEARBOX: &str = include_str!("../../../../networks/gearbox.toml");

/// A run that would take minutes.
pub fn endless() -> String {
    let long = GEARBOX
        .replace("\"25 min\"", "\"500 d\"")
        .replace("{ every = \"5 s\" }", "{ every = \"6 h\" }");
    long.replace("P = \"P_7000\"", "P = \"P_7000 * (1 + 0.5 * sin(t / 10 [s]))\"")
}

/// A temporary folder that is removed in the end.
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// An empty folder.
    pub fn empty() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name =
            format!("lptn-cli-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).unwrap();
        Self { path }
    }

    /// A folder with `gearbox.toml`.
    pub fn with_gearbox() -> Self {
        Self::with("gearbox.toml", GEARBOX)
    }

    /// A folder with one file.
    pub fn with(name: &str, text: &str) -> Self {
        let folder = Self::empty();
        folder.write(name, text);
        folder
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.path.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path.join(name)).unwrap()
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All files below the folder, sorted.
    pub fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut open = vec![self.path.clone()];
        while let Some(folder) = open.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    open.push(path);
                } else {
                    found.push(path.strip_prefix(&self.path).unwrap().display().to_string());
                }
            }
        }
        found.sort();
        found
    }

    /// The program, ready to run here.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lptn"));
        command.args(arguments).current_dir(&self.path).stdin(Stdio::null());
        command.env_remove("NO_COLOR").env_remove("COLUMNS");
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        Ran::of(self.command(arguments).output().unwrap())
    }

    /// Runs a command with `--format json`, given as its words between blanks.
    pub fn json(&self, command: &str) -> Ran {
        let words: Vec<&str> = command.split(' ').chain(["--format", "json"]).collect();
        self.run(&words)
    }

    /// Runs with a text on stdin. A program that refuses the study may end before it has read it.
    pub fn run_with(&self, arguments: &[&str], stdin: &str) -> Ran {
        self.run_bytes(arguments, stdin.as_bytes())
    }

    /// The same with bytes that need not be text.
    pub fn run_bytes(&self, arguments: &[&str], stdin: &[u8]) -> Ran {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let wrote = child.stdin.take().unwrap().write_all(stdin);
        let left = |error: std::io::Error| error.kind() == std::io::ErrorKind::BrokenPipe;
        assert!(wrote.map_or_else(left, |()| true));
        Ran::of(child.wait_with_output().unwrap())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

/// What a run gave.
#[derive(Debug)]
pub struct Ran {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Ran {
    pub fn of(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// The same, after a look at the exit code.
    #[track_caller]
    pub fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}\n{}", self.out, self.err);
        self
    }

    #[track_caller]
    pub fn says(self, text: &str) -> Self {
        assert!(self.err.contains(text), "no `{text}` in\n{}", self.err);
        self
    }

    #[track_caller]
    pub fn prints(self, text: &str) -> Self {
        assert!(self.out.contains(text), "no `{text}` in\n{}", self.out);
        self
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap()
    }
}

/// A CSV file: headers, and rows of numbers.
pub fn csv(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let number = |field: &str| field.parse::<f64>().unwrap();
    let rows = reader.records().map(|row| row.unwrap().iter().map(number).collect()).collect();
    (headers, rows)
}

/// What the validation case `gearbox_two_node` expects of a quantity, of a node where it has one.
pub fn gearbox_case(quantity: &str, node: &str) -> Vec<serde_json::Value> {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/validation/gearbox_two_node/case.json");
    let case: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let all = case["expected"].as_array().unwrap().iter();
    let of_node = |e: &&serde_json::Value| {
        e["quantity"] == quantity && (node.is_empty() || e["node"] == node)
    };
    all.filter(of_node).cloned().collect()
}

/// The values of [`gearbox_case`].
pub fn gearbox_values(quantity: &str, node: &str) -> Vec<f64> {
    gearbox_case(quantity, node)
        .iter()
        .map(|expected| expected["value"].as_f64().unwrap())
        .collect()
}
