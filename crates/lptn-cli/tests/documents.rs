//! Every command that README and docs show is run, and what they show of its output is what it
//! prints.
//!
//! A block ` ```console ` holds commands, each after `$ `, and their output. The commands of a page
//! run one after the other through `sh` in a temporary folder of its own that holds a copy of
//! `networks/` and the netlists and records of `docs/`, and the blocks of the page that have a file
//! name: ` ```toml motor.toml `, ` ```csv points.csv `, ` ```python loop.py `.
//! ` ```python plot.py optional ` needs packages that may not be there and is only compiled.
//!
//! - A block that shows any output shows all of it, stdout and stderr as a terminal would; a line
//!   `..` stands for lines that are left out, `[..]` for a part of a line. A block that shows none
//!   only has to run.
//! - A command has to end with 0, or with the number that a comment behind it says:
//!   `# exit code 1`.
//! - What differs between machines is not compared: [`normal`] lists it.
//! - ` ```console by-hand ` is not run: it builds, installs or measures, and every command in it is
//!   one of [`BY_HAND`].
//! - A picture `pictures/NAME.svg` that a page shows is the `NAME.svg` that its commands wrote.
//!
//! A block with a folder in its name is a file of the repository, so that its commands run there too:
//! ` ```toml docs/cups.toml `. A block ` ```toml from docs/cups.toml ` shows lines of such a file, in
//! its order; `# …` stands for lines that are left out. `LPTN_PAGE=gearbox` runs the pages with this in their name only.
//!
//! `LPTN_BLESS=1 cargo test -p lptn-cli --test all documents::` writes what the commands print into the
//! pages; what it writes has to be read as one who learns from it would. A block with `..` is not
//! written: shorten it by hand.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::pages;
use crate::prose;

use std::fmt::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::Folder;
use pages::{Block, blocks, pages};

/// What a block that is not run may hold, and why it is not run.
const BY_HAND: [(&str, &str); 9] = [
    ("make ", "builds everything"),
    ("git clone", "needs the network"),
    ("cd ", "follows a clone"),
    ("mkdir ", "is part of an installation"),
    ("pip install ", "needs the wheel; .ci/test-wheel does it"),
    ("cargo ", "builds everything"),
    ("LPTN_BLESS=1 cargo ", "builds everything"),
    ("sed ", "prepares a measurement"),
    ("/usr/bin/time", "measures, and needs a release build"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A command of a block, and where its output stands.
struct Step {
    command: String,
    output: Range<usize>,
}

fn steps(lines: &[String], block: &Block) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut continues = false;
    for number in block.lines.clone() {
        let line = &lines[number];
        match (line.strip_prefix("$ "), steps.last_mut()) {
            (None, Some(step)) if continues => {
                step.command = format!("{}\n{line}", step.command);
                step.output = number + 1..number + 1;
            }
            (None, Some(step)) => step.output.end = number + 1,
            (None, None) => {
                panic!("line {}: a block begins with a command: `$ lptn ..`", number + 1)
            }
            (Some(command), _) => {
                steps.push(Step { command: command.to_owned(), output: number + 1..number + 1 });
            }
        }
        continues = line.ends_with('\\') && steps.last().is_some_and(|step| step.output.is_empty());
    }
    steps
}

/// The exit code that the command's comment says; 0 without one.
fn expected_code(command: &str) -> i32 {
    let said = command.rsplit_once("exit code ").map(|(_, code)| code);
    let digits = |code: &str| code.chars().take_while(char::is_ascii_digit).collect::<String>();
    said.and_then(|code| digits(code).parse().ok()).unwrap_or(0)
}

/// What may differ from machine to machine, each in a word: residuals of rounding (below 1e-12),
/// hashes of files, how long the computer took (`solved in 130 ms`).
fn normal(line: &str) -> String {
    let mut words: Vec<String> = line.trim_end().split(' ').map(str::to_owned).collect();
    for i in 1..words.len().saturating_sub(2) {
        if (words[i - 1] == "solved" && words[i] == "in") || words[i] == "(in" {
            words.splice(i + 1..i + 3, ["<duration>".to_owned()]);
        }
    }
    for word in &mut words {
        let bare = word.trim_matches([',', ';', ')', '(']).to_owned();
        let rounding =
            bare.contains("e-") && bare.parse::<f64>().is_ok_and(|number| number.abs() < 1e-12);
        let hash = bare.len() == 64 && bare.chars().all(|c| c.is_ascii_hexdigit());
        if rounding || hash {
            *word = word.replace(&bare, if hash { "<hash>" } else { "<rounding>" });
        }
    }
    words.join(" ")
}

/// Whether a line is the expected one, in which `[..]` stands for anything.
fn same_line(expected: &str, found: &str) -> bool {
    let (expected, found) = (normal(expected), normal(found));
    let mut parts = expected.split("[..]");
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = found.strip_prefix(first) else { return false };
    let parts: Vec<&str> = parts.collect();
    let Some((last, between)) = parts.split_last() else { return rest.is_empty() };
    for part in between {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

/// Whether the lines are the expected ones, of which `..` stands for any.
fn same(expected: &[String], found: &[String]) -> bool {
    match (expected.split_first(), found.split_first()) {
        (None, None) => true,
        (Some((line, rest)), _) if line == ".." => {
            same(rest, found) || found.split_first().is_some_and(|(_, fewer)| same(expected, fewer))
        }
        (Some((line, rest)), Some((other, others))) => same_line(line, other) && same(rest, others),
        _ => false,
    }
}

/// A page in its folder.
struct Page {
    name: String,
    lines: Vec<String>,
    folder: Folder,
    /// What is wrong, in words.
    wrong: String,
    /// What is to be written in place of which lines.
    blessed: Vec<(Range<usize>, Vec<String>)>,
}

impl Page {
    fn open(path: &Path) -> Self {
        let lines = pages::lines(path);
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        let folder = Folder::empty();
        std::fs::create_dir(folder.path().join("bin")).unwrap();
        std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_lptn"), folder.path().join("bin/lptn"))
            .unwrap();
        let files = "networks docs/records docs/netlists docs/*.toml docs/*.csv \
                     docs/cookbook/*.toml docs/cookbook/*.csv";
        let copied = format!("tar -cf - {files} | tar -xf - -C '{}'", folder.path().display());
        let status = Command::new("sh").args(["-c", &copied]).current_dir(root()).status();
        assert!(status.unwrap().success());
        Self { name, lines, folder, wrong: String::new(), blessed: Vec::new() }
    }

    /// Writes the blocks that have a file name, and runs the others.
    fn run(&mut self) -> usize {
        let mut count = 0;
        for block in blocks(&self.lines) {
            match block.words() {
                ("console", "") => {
                    count += 1;
                    self.console(&block);
                }
                ("console", "by-hand") => self.by_hand(&block),
                ("python", file) if file.ends_with(" optional") => self.compiles(&block),
                (_, file) if file.starts_with("from ") => {}
                ("toml" | "csv" | "python", file) if file.contains('.') => {
                    let text = self.lines[block.lines.clone()].join("\n") + "\n";
                    self.folder.write(file, &text);
                }
                ("console" | "sh" | "bash" | "shell", _) => {
                    self.complain(block.lines.start, "commands stand in a block `console`");
                }
                ("text", _)
                    if self.lines[block.lines.clone()].iter().any(|line| is_command(line)) =>
                {
                    self.complain(block.lines.start, "commands stand in a block `console`");
                }
                _ => {}
            }
        }
        count
    }

    fn complain(&mut self, line: usize, what: &str) {
        writeln!(self.wrong, "{}:{}: {what}", self.name, line + 1).unwrap();
    }

    /// Python that needs more than the tests may ask for is read, not run.
    fn compiles(&mut self, block: &Block) {
        let text = self.lines[block.lines.clone()].join("\n") + "\n";
        self.folder.write("optional.py", &text);
        let (code, found) = self.execute("python3 -m py_compile optional.py");
        if code != Some(0) {
            self.complain(block.lines.start, &found.join("\n"));
        }
    }

    fn by_hand(&mut self, block: &Block) {
        for step in steps(&self.lines, block) {
            if !BY_HAND.iter().any(|(start, _)| step.command.starts_with(start))
                && !step.command.starts_with("lptn setup completions")
            {
                self.complain(step.output.start, &format!("`{}` can be run", step.command));
            }
        }
    }

    fn console(&mut self, block: &Block) {
        let steps = steps(&self.lines, block);
        let shown = steps.iter().any(|step| !step.output.is_empty());
        for step in steps {
            let (code, found) = self.execute(&step.command);
            if code != Some(expected_code(&step.command)) {
                let said = found.join("\n");
                let what = format!("`{}` ends with {code:?}:\n{said}", step.command);
                self.complain(step.output.start, &what);
            }
            let expected = &self.lines[step.output.clone()];
            if shown && !same(expected, &found) {
                let what = format!("`{}` prints\n\n{}\n", step.command, found.join("\n"));
                if !expected.iter().any(|line| line == "..") {
                    self.blessed.push((step.output.clone(), found));
                }
                self.complain(step.output.start, &what);
            }
        }
    }

    /// Compares the pictures that the page shows with those that its commands drew. The tests of the
    /// Python package draw those of notebooks.
    fn pictures(&mut self) {
        if self.name.starts_with("docs/notebooks/") {
            return;
        }
        let shown: Vec<(usize, String)> =
            self.lines.iter().enumerate().filter_map(picture).collect();
        for (line, name) in shown {
            let kept = root().join("docs/pictures").join(&name);
            let drawn = std::fs::read(self.folder.path().join(&name)).ok();
            if drawn.is_none() {
                self.complain(line, &format!("no command of the page writes {name}"));
            } else if std::fs::read(&kept).ok() != drawn {
                self.complain(line, &format!("{name} is another picture now"));
                if let (Some(_), Some(drawn)) = (std::env::var_os("LPTN_BLESS"), drawn) {
                    std::fs::write(kept, drawn).unwrap();
                }
            }
        }
    }

    fn execute(&self, command: &str) -> (Option<i32>, Vec<String>) {
        let path = std::env::var("PATH").unwrap_or_default();
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("exec 2>&1\n{command}")]).current_dir(self.folder.path());
        shell.env("PATH", format!("{}:{path}", self.folder.path().join("bin").display()));
        let output = shell.stdin(std::process::Stdio::null()).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), text.lines().map(|line| line.trim_end().to_owned()).collect())
    }

    /// The page with what the commands print.
    fn bless(&self) {
        let mut lines = self.lines.clone();
        for (place, found) in self.blessed.iter().rev() {
            lines.splice(place.clone(), found.iter().cloned());
        }
        std::fs::write(root().join(&self.name), lines.join("\n") + "\n").unwrap();
    }
}

/// The picture that a line shows.
fn picture((number, line): (usize, &String)) -> Option<(usize, String)> {
    let (_, path) = line.strip_prefix("![")?.split_once("](")?;
    let name = path.strip_suffix(')')?.rsplit('/').next()?;
    name.ends_with(".svg").then(|| (number, name.to_owned()))
}

fn is_command(line: &str) -> bool {
    line.starts_with("$ ") || line.starts_with("lptn ")
}

#[test]
fn commands_in_documents_print_what_they_show() {
    let (mut count, mut wrong) = (0, String::new());
    let only = std::env::var("LPTN_PAGE").ok();
    let chosen =
        |path: &PathBuf| only.as_ref().is_none_or(|word| path.display().to_string().contains(word));
    for path in pages(&root()).into_iter().filter(chosen) {
        let mut page = Page::open(&path);
        count += page.run();
        page.pictures();
        wrong += &page.wrong;
        if std::env::var_os("LPTN_BLESS").is_some() && !page.blessed.is_empty() {
            page.bless();
        }
    }
    assert!(wrong.is_empty(), "LPTN_BLESS=1 writes what is printed into the pages:\n\n{wrong}");
    assert!(only.is_some() || count >= 20, "only {count} blocks were found");
}

/// Sixteen commands of the book named files that only the test had.
#[test]
fn blocks_with_a_folder_in_their_name_are_files_of_the_repository() {
    let (mut seen, mut wrong) = (0, String::new());
    for path in pages(&root()) {
        let lines = pages::lines(&path);
        for block in blocks(&lines) {
            let ("toml" | "csv" | "python", file) = block.words() else { continue };
            if !file.contains('/') || file.contains(' ') {
                continue;
            }
            seen += 1;
            let (kept, text) = (root().join(file), lines[block.lines.clone()].join("\n") + "\n");
            if std::fs::read_to_string(&kept).ok().as_ref() == Some(&text) {
                continue;
            }
            writeln!(wrong, "{}: {file} is another file, or missing", path.display()).unwrap();
            if std::env::var_os("LPTN_BLESS").is_some() {
                std::fs::write(kept, text).unwrap();
            }
        }
    }
    assert!(wrong.is_empty(), "LPTN_BLESS=1 writes the files:\n\n{wrong}");
    assert!(seen >= 1, "no such file was found");
}

/// An excerpt is lines of its file, in the order of the file.
#[test]
fn excerpts_are_lines_of_their_files() {
    let (mut seen, mut wrong) = (0, String::new());
    for path in pages(&root()) {
        let lines = pages::lines(&path);
        for block in blocks(&lines) {
            let Some(file) = block.words().1.strip_prefix("from ") else { continue };
            seen += 1;
            let text = std::fs::read_to_string(root().join(file)).unwrap_or_default();
            let mut rest = text.lines();
            for number in block.lines.clone() {
                let line = &lines[number];
                let left_out = line.is_empty() || line.starts_with("# …");
                if !left_out && !rest.any(|other| other == line) {
                    let place = format!("{}:{}", path.display(), number + 1);
                    writeln!(wrong, "{place}: `{line}` is not in {file}, or earlier").unwrap();
                    break;
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
    assert!(seen >= 10, "only {seen} excerpts were found");
}

/// A law of 85.25 uW stood below a fit that prints 85.11.
#[test]
fn numbers_in_prose_are_those_that_the_page_prints() {
    let odd: Vec<String> =
        pages(&root()).iter().flat_map(|path| prose::nearly_printed(path)).collect();
    let help = "print them, round them, or name them in tests/support/prose.rs";
    assert!(odd.is_empty(), "nearly what the page prints; {help}:\n{}", odd.join("\n"));
}

/// A bar inside a cell ends it, and what stands behind it vanishes from the page.
#[test]
fn rows_of_tables_have_as_many_cells_as_their_heads() {
    let mut wrong = String::new();
    for path in pages(&root()) {
        let lines = pages::lines(&path);
        let mut head: Option<usize> = None;
        let mut code = false;
        for (number, line) in lines.iter().enumerate() {
            code ^= line.starts_with("```");
            if code || !line.starts_with('|') {
                head = None;
                continue;
            }
            let cells = line.replace("\\|", "").matches('|').count();
            if *head.get_or_insert(cells) != cells {
                writeln!(wrong, "{}:{}: {cells} bars", path.display(), number + 1).unwrap();
            }
        }
    }
    assert!(wrong.is_empty(), "bars in cells are written `\\|`:\n{wrong}");
}

#[test]
fn a_difference_is_seen_and_what_is_left_out_is_not() {
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    assert!(same(&lines("a\n..\nd"), &lines("a\nb\nc\nd")));
    assert!(!same(&lines("a\n..\nd"), &lines("a\nb\nc")));
    assert!(!same(&lines("a"), &lines("a\nb")) && !same(&lines("a\nb"), &lines("a")));
    assert!(same_line("took [..] s", "took 1.5 s") && !same_line("took [..] s", "took 1.5 min"));
    assert!(same_line("closes to 7.9e-16 of", "closes to 2e-15 of"));
    assert!(!same_line("closes to 7.9e-16 of", "closes to 2e-11 of"));
    assert!(same_line("(301 rows, solved in 860 us)", "(301 rows, solved in 1.2 ms)"));
    assert!(!same_line("(301 rows, solved in 860 us)", "(302 rows, solved in 860 us)"));
    assert_eq!((expected_code("lptn x # exit code 1"), expected_code("lptn x")), (1, 0));
}
