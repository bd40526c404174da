//! The studies that the help of `no_study` offers: each is pasted into the file that it was offered
//! for, and has to be right there.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::common;

use common::Folder;

/// Netlists that are shipped and have a parameter, copied with their records.
fn shipped() -> (Folder, Vec<String>) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = Folder::empty();
    let mut names = Vec::new();
    for part in ["networks", "networks/candidates", "networks/records", "docs/netlists"] {
        let mut paths: Vec<PathBuf> = std::fs::read_dir(root.join(part))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.is_file()) {
            let name = format!("{part}/{}", path.file_name().unwrap().to_str().unwrap());
            let text = std::fs::read_to_string(path).unwrap();
            folder.write(&name, &text);
            if name.ends_with(".toml") && text.contains("\n[param]") && part != "networks/records" {
                names.push(name);
            }
        }
    }
    (folder, names)
}

/// The section that the help of a command offers for a file, `None` if the file has a study.
fn offered(folder: &Folder, command: &str, name: &str) -> Option<String> {
    let ran = folder.json(&format!("{command} {name}"));
    if ran.code != Some(2) {
        return None;
    }
    let answer: Value = ran.json();
    let first = answer["errors"].as_array()?.first()?.clone();
    let code = first["code"].as_str()?;
    if !code.ends_with("::no_study") {
        return None;
    }
    let help = first["help"].as_str().map(str::to_owned);
    let help = help.or_else(|| Some(first["help"].as_array()?.first()?.as_str()?.to_owned()))?;
    Some(help.split_once("\n\n").unwrap_or_else(|| panic!("{help}")).1.to_owned())
}

/// Writes the file with the section, and gives its name.
fn paste(folder: &Folder, name: &str, section: &str) -> String {
    let pasted = name.replace(".toml", "_pasted.toml");
    folder.write(&pasted, &format!("{}\n{section}\n", folder.read(name)));
    pasted
}

fn record(folder: &Folder, name: &str, section: &str) {
    let header = section.split("its header is `").nth(1).and_then(|rest| rest.split('`').next());
    let Some(header) = header else { return };
    let rows: String =
        (0..40).map(|k| format!("{},{}\n", 10 * k, 20.0 + 0.5 * f64::from(k))).collect();
    let place = Path::new(name).parent().unwrap().join("record.csv");
    folder.write(place.to_str().unwrap(), &format!("{header}\n{rows}"));
}

#[test]
fn an_offered_size_has_an_answer_in_every_shipped_network() {
    let (folder, names) = shipped();
    let mut failed = Vec::new();
    let mut count = 0;
    for name in &names {
        let Some(section) = offered(&folder, "size", name) else { continue };
        let pasted = paste(&folder, name, &section);
        let ran = folder.run(&["size", &pasted, "best"]);
        count += 1;
        if ran.code != Some(0) {
            failed.push(format!("{name}\n{section}\n{}{}", ran.out, ran.err));
        }
    }
    assert!(count > 30, "{count}");
    assert!(failed.is_empty(), "{} of {count}:\n\n{}", failed.len(), failed.join("\n\n"));
}

#[test]
fn other_offered_studies_are_accepted_in_every_shipped_network() {
    let (folder, names) = shipped();
    let mut failed = Vec::new();
    for name in &names {
        for command in ["sweep", "plan", "fit network", "infer"] {
            let Some(section) = offered(&folder, command, name) else { continue };
            record(&folder, name, &section);
            let pasted = paste(&folder, name, &section);
            let study = if command == "sweep" {
                folder.run(&["sweep", &pasted, "designs", "--no-files"])
            } else {
                folder.run(&["check", &pasted])
            };
            if study.code != Some(0) {
                failed.push(format!("{command} {name}\n{section}\n{}{}", study.out, study.err));
            }
        }
    }
    assert!(failed.is_empty(), "{}:\n\n{}", failed.len(), failed.join("\n\n"));
}

/// A fan must be strong enough and a power small enough: the direction follows from the physics.
#[test]
fn a_cheap_choice_is_offered() {
    let network = |parameter: &str, path: &str, source: &str| {
        format!(
            "format = 1\n[param]\n{parameter}\n[node]\nbox = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n\
             [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"box\", to = \
             \"air\", {path} }}\n[source]\nheat = {{ into = \"box\", P = \"{source}\" }}\n[limit]\nhot \
             = {{ of = \"box.T\", below = \"95 degC\" }}\n"
        )
    };
    for (parameter, path, source, wanted) in [
        ("P = \"4 W\"\nG = \"1 W/K\"", "G = \"G\"", "P", "minimise = \"G\""),
        ("P = \"4 W\"\nR = \"1 K/W\"", "R = \"R\"", "P", "maximise = \"R\""),
        ("P = \"15 W\"", "G = \"1 W/K\"", "P", "maximise = \"P\""),
        ("idle = \"2 W/K\"\nP = \"15 W\"", "G = \"1 W/K\"", "P", "maximise = \"P\""),
    ] {
        let text = network(parameter, path, source);
        let folder = Folder::with("box.toml", &text);
        let section = offered(&folder, "size", "box.toml").unwrap();
        assert!(section.contains(wanted), "{section}");
        assert!(section.contains("require = [\"box.T <= 95 [degC]\"]"), "{section}");
        assert!(!section.contains(".000"), "{section}");
        let pasted = paste(&folder, "box.toml", &section);
        folder.run(&["size", &pasted]).exits(0);
    }
}
