//! Flat netlists: each file of `tests/expand` is written as the `.expanded.toml` beside it, and
//! what is written is the same network. `LPTN_BLESS=1` writes them anew; what it writes has to be
//! read.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use lptn_netlist::{Netlist, parse_with};

use crate::support;
use support::{same, seen};

fn here(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

/// The netlists of a folder, without what was written from them.
fn netlists(folder: &str) -> Vec<PathBuf> {
    let files = std::fs::read_dir(here(folder)).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &PathBuf| path.file_name().unwrap().to_str().unwrap().to_owned();
    let mut found: Vec<PathBuf> = files.filter(|path| name(path).ends_with(".toml")).collect();
    found.retain(|path| !name(path).ends_with(".expanded.toml"));
    found.sort();
    found
}

/// Reads a text as if it stood at `path`.
fn parse(path: &Path, text: &str) -> Netlist {
    let name = path.file_name().unwrap().to_str().unwrap();
    let folder = path.parent().unwrap().to_owned();
    parse_with(name, text, &mut |path| std::fs::read(folder.join(path)))
        .unwrap_or_else(|rejected| panic!("{}: {rejected}\n\n{text}", path.display()))
}

fn cases() -> Vec<PathBuf> {
    let mut cases = netlists("tests/expand");
    cases.retain(|path| !path.to_str().unwrap().ends_with(".flat.toml"));
    cases
}

#[test]
fn expansions_are_as_reviewed() {
    let mut differences = Vec::new();
    for path in cases() {
        let found = parse(&path, &std::fs::read_to_string(&path).unwrap()).expanded();
        let expected = path.with_extension("expanded.toml");
        if std::env::var_os("LPTN_BLESS").is_some() {
            std::fs::write(&expected, &found).unwrap();
        } else if std::fs::read_to_string(&expected).unwrap_or_default().replace("\r\n", "\n")
            != found
        {
            differences.push(format!("{}:\n{found}", path.display()));
        }
    }
    assert!(cases().len() >= 12);
    assert!(differences.is_empty(), "LPTN_BLESS=1 writes these:\n\n{}", differences.join("\n"));
}

/// Reference: what a colleague would write without templates.
#[test]
fn expansions_are_what_was_written_by_hand() {
    let mut compared = 0;
    for path in cases() {
        let flat = path.with_extension("flat.toml");
        let Ok(text) = std::fs::read_to_string(&flat) else { continue };
        let expanded = parse(&path, &std::fs::read_to_string(&path).unwrap()).expanded();
        let (found, expected) = (parse(&path, &expanded), parse(&flat, &text));
        same(&seen(&found.network), &seen(&expected.network), 1e-14);
        compared += 1;
    }
    assert!(compared >= 3);
}

/// Property: for the corpus, the good files and every network that is shipped.
#[test]
fn an_expansion_is_the_same_network_and_its_own_expansion() {
    let mut files = netlists("tests/expand");
    files.extend(netlists("tests/good"));
    files.extend(netlists("../../networks"));
    assert!(files.len() > 40);
    for path in files {
        let original = parse(&path, &std::fs::read_to_string(&path).unwrap());
        if let Some(problem) = original.not_flat() {
            assert!(!original.network.grids().is_empty(), "{problem:?}");
            continue;
        }
        let text = original.expanded();
        let again = parse(&path, &text);
        println!("{}", path.display());
        same(&seen(&again.network), &seen(&original.network), 0.0);
        assert_eq!(again.run, original.run, "{}", path.display());
        assert_eq!(again.network.title(), original.network.title());
        let sizes = |netlist: &Netlist| {
            let text = |size: &lptn_netlist::SizeStudy| {
                let texts: Vec<String> = size.requirements.iter().map(|r| r.text.clone()).collect();
                (
                    size.name.clone(),
                    size.objective.text.clone(),
                    texts,
                    size.ranges(&netlist.network).unwrap(),
                )
            };
            netlist.studies.sizes.iter().map(text).collect::<Vec<_>>()
        };
        assert_eq!(sizes(&again), sizes(&original));
        let fits = |netlist: &Netlist| {
            let text = |fit: &lptn_netlist::FitStudy| {
                let columns: Vec<_> =
                    fit.observed.iter().map(|o| (o.column.clone(), o.text.clone())).collect();
                let plan = fit.plan(&netlist.network, &netlist.overrides()).unwrap();
                let varied: Vec<_> = plan
                    .varied
                    .iter()
                    .map(|v| (*v, netlist.network.parameter_value(v.parameter)))
                    .collect();
                let records: Vec<_> =
                    fit.records.iter().map(|record| record.record.time.clone()).collect();
                (fit.name.clone(), columns, varied, plan.sigmas, records)
            };
            netlist.studies.fits.iter().map(text).collect::<Vec<_>>()
        };
        assert_eq!(fits(&again), fits(&original));
        assert_eq!(again.expanded(), text, "{}", path.display());
    }
}

#[test]
fn what_was_set_is_written() {
    let path = here("tests/expand/counted.toml");
    let mut netlist = parse(&path, &std::fs::read_to_string(&path).unwrap());
    netlist.set(&["planet[3].R_pin=0.5K/W".to_owned(), "T_amb=30degC".to_owned()]).unwrap();
    let text = netlist.expanded();
    assert!(text.contains("\"planet[3].R_pin\" = \"0.5 K/W\"\n"), "{text}");
    assert!(text.contains("T_amb = \"absolute(303.15 [K])\"\n"), "{text}");
    same(&seen(&parse(&path, &text).network), &seen(&netlist.network), 0.0);
}
