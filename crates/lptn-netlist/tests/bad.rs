//! Every file of `tests/bad` is refused with exactly the words beside it, in `.txt`. `LPTN_BLESS=1`
//! writes them anew; what it writes has to be read as the newcomer would who made the mistake.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::fixes;

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

use lptn_netlist::{Netlist, Rejected, Severity, parse_bytes, parse_with};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

fn cases() -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let mut cases: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    cases.sort();
    cases
}

fn parse(path: &Path) -> Result<Netlist, Rejected> {
    let name = path.file_name().unwrap().to_str().unwrap();
    parse_text(name, &std::fs::read(path).unwrap())
}

fn parse_text(name: &str, bytes: &[u8]) -> Result<Netlist, Rejected> {
    match std::str::from_utf8(bytes) {
        // the CSV files and states of a case, and what it includes, stand beside it
        Ok(text)
            if [
                "csv = ",
                "catalogue = ",
                "data = ",
                "file = ",
                "initial = ",
                "posterior = ",
                "[import]",
                ".inc\"",
            ]
            .iter()
            .any(|key| text.contains(key)) =>
        {
            parse_with(name, text, &mut |path| std::fs::read(folder().join(path)))
        }
        _ => parse_bytes(name, bytes),
    }
}

/// The plain rendering, and the text that each place covers.
fn render(rejected: &Rejected) -> String {
    let mut text = String::new();
    for diagnostic in &rejected.diagnostics {
        text += &rejected.files.plain(diagnostic);
        for label in &diagnostic.labels {
            text += &format!("\n    marks {:?}", rejected.files.at(&label.span));
        }
        text += "\n\n";
    }
    text += if rejected.syntax { "not TOML 1.0\n" } else { "" };
    text.trim_end().to_owned() + "\n"
}

#[test]
fn messages_are_as_reviewed() {
    let mut differences = Vec::new();
    for path in cases() {
        let found = match parse(&path) {
            Ok(_) => "accepted\n".to_owned(),
            Err(rejected) => render(&rejected),
        };
        let expected = path.with_extension("txt");
        if std::env::var_os("LPTN_BLESS").is_some() {
            std::fs::write(&expected, &found).unwrap();
        } else if std::fs::read_to_string(&expected).unwrap_or_default().replace("\r\n", "\n")
            != found
        {
            differences.push(format!("{}:\n{found}", path.file_name().unwrap().display()));
        }
    }
    assert!(differences.is_empty(), "LPTN_BLESS=1 writes these:\n\n{}", differences.join("\n"));
}

#[test]
fn every_file_is_refused_with_a_place_and_a_code() {
    for path in cases() {
        let rejected = parse(&path).unwrap_err();
        let errors = rejected.diagnostics.iter().filter(|d| d.severity == Severity::Error);
        assert!(errors.count() > 0, "{}", path.display());
        for diagnostic in &rejected.diagnostics {
            assert!(diagnostic.place().is_some(), "{}: {diagnostic}", path.display());
            assert!(diagnostic.labels[0].primary, "{}: {diagnostic}", path.display());
            assert!(diagnostic.code.contains("::"), "{}: {diagnostic}", path.display());
        }
    }
}

/// A message without help is one that says itself what to do.
#[test]
fn there_are_many_cases_and_nearly_all_offer_help() {
    let (mut codes, mut with_help, mut all) = (BTreeSet::new(), 0, 0);
    for path in cases() {
        for diagnostic in parse(&path).unwrap_err().diagnostics {
            codes.insert(diagnostic.code);
            with_help += usize::from(diagnostic.help.is_some());
            all += 1;
        }
    }
    assert!(cases().len() >= 230);
    assert!(codes.len() >= 30, "{codes:?}");
    assert!(with_help * 10 >= all * 9, "{with_help} of {all}");
}

/// Whether a mistake of this code is still there, in what a fix has put into the text.
fn is_left(
    mended: &Result<Netlist, Rejected>,
    (name, code): (&str, &str),
    written: &Range<usize>,
) -> bool {
    let Err(rejected) = mended else { return false };
    rejected.diagnostics.iter().any(|problem| {
        let place = problem.place().filter(|place| rejected.files.name(place.file) == name);
        problem.code == code
            && place.is_some_and(|place| {
                place.range.start < written.end && written.start < place.range.end
            })
    })
}

/// What a help says is to be written is written, and read again: the mistake is gone.
#[test]
fn what_helps_say_to_write_can_be_pasted() {
    let (mut count, mut wrong) = (0, Vec::new());
    for path in cases() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let Ok(text) = String::from_utf8(std::fs::read(&path).unwrap()) else { continue };
        let rejected = parse_text(name, text.as_bytes()).unwrap_err();
        for diagnostic in &rejected.diagnostics {
            let place = diagnostic.place().unwrap();
            if rejected.files.name(place.file) != name {
                continue;
            }
            for fix in fixes::of(diagnostic, &text, &place.range) {
                count += 1;
                let mended = parse_text(name, fix.applied(&text).as_bytes());
                let written = fix.part.start..fix.part.start + fix.text.len();
                if is_left(&mended, (name, diagnostic.code), &written) {
                    wrong.push(format!("{name}: {}: {}", diagnostic.code, fix.text));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "of {count}:\n{}", wrong.join("\n"));
    assert!(count >= 150, "only {count} fixes were tried");
}
