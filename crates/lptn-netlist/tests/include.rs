//! Netlists of several files, in folders of their own.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::PathBuf;

use lptn_netlist::{Netlist, ReadError, Rejected, parse, parse_with, read};

/// A folder that is removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder =
            std::env::temp_dir().join(format!("lptn-include-{}-{name}", std::process::id()));
        for (file, text) in files {
            let path = folder.join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        Self(folder)
    }

    fn read(&self, file: &str) -> Netlist {
        read(&self.0.join(file)).unwrap_or_else(|error| panic!("{error}"))
    }

    /// The plain text of the refusal, without the folder.
    fn refused(&self, file: &str) -> (String, Rejected) {
        match read(&self.0.join(file)) {
            Err(ReadError::Rejected(rejected)) => {
                (rejected.to_string().replace(&format!("{}/", self.0.display()), ""), rejected)
            }
            other => panic!("{other:?}"),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        drop(std::fs::remove_dir_all(&self.0));
    }
}

const MAIN: &str = "include = [\"parts/materials.toml\", \"ambient.toml\"]\nformat = 1\ntitle \
    = \"main\"\n\
                    [node]\na = { T0 = \"25 degC\", material = \"cast\", mass = \"2 kg\" }\n\
                    [resistor]\nr = { from = \"a\", to = \"air\", R = \"1 K/W\" }\n";
const MATERIALS: &str = "format = 1\ntitle = \"materials\"\n[param]\nc = \"460 J/(kg K)\"\n\
                         [material]\ncast = { cp = \"c\" }\nother = { cp = \"1 J/(g K)\" }\n";
const AMBIENT: &str = "format = 1\n[boundary]\nair = { T = \"25 degC\" }\n";

#[test]
fn what_is_included_counts_as_written_in_front() {
    let folder = Folder::new(
        "good",
        &[("net.toml", MAIN), ("parts/materials.toml", MATERIALS), ("ambient.toml", AMBIENT)],
    );
    let mut netlist = folder.read("net.toml");
    let node = netlist.network.node("a").unwrap();
    assert!((netlist.network.capacity(node) - 920.0).abs() < 1e-9);
    assert_eq!(netlist.network.title(), Some("main"));
    assert!(netlist.warnings.is_empty(), "a material of an included file may stay unused");
    let names: Vec<String> =
        netlist.inputs().map(|(name, _)| name.rsplit('/').next().unwrap().to_owned()).collect();
    assert_eq!(names, ["net.toml", "materials.toml", "ambient.toml"]);
    assert_eq!(netlist.inputs().nth(1).unwrap().1, MATERIALS);
    // `--set` is not a file, and places stay in theirs
    netlist.set(&["c=500 J/(kg K)".into()]).unwrap();
    assert_eq!(netlist.inputs().count(), 3);
    let parameter = netlist.network.parameter("c").unwrap();
    let span = netlist.source_map.parameter(parameter).unwrap();
    assert!(netlist.files.name(span.file).ends_with("parts/materials.toml"));
    assert_eq!(netlist.files.at(&span), "\"460 J/(kg K)\"");
}

#[test]
fn paths_are_relative_to_the_file_that_includes_and_a_file_counts_once() {
    let folder = Folder::new(
        "relative",
        &[
            (
                "net.toml",
                "include = [\"parts/one.toml\", \"ambient.toml\"]\nformat = 1\n[node]\na = { T0 \
                 = \"25 degC\", C = \"1 J/K\" }\n",
            ),
            (
                "parts/one.toml",
                "include = [\"../ambient.toml\", \"./../parts/two.toml\"]\nformat = 1\n",
            ),
            ("parts/two.toml", "format = 1\n[source]\np = { into = \"a\", P = \"1 W\" }\n"),
            ("ambient.toml", AMBIENT),
        ],
    );
    let netlist = folder.read("net.toml");
    assert_eq!((netlist.network.boundaries().len(), netlist.network.sources().len()), (1, 1));
    assert_eq!(netlist.inputs().count(), 4);
}

#[test]
fn a_name_in_two_files_names_both_places() {
    let folder = Folder::new(
        "twice",
        &[
            (
                "net.toml",
                &format!(
                    "{MAIN}[boundary]\nair = {{ T = \"20 degC\" }}\ncast = {{ T = \"1 K\" \
                     }}\n[source]\ncast = {{ into = \"a\", P = \"1 W\" }}\n"
                ),
            ),
            ("parts/materials.toml", MATERIALS),
            ("ambient.toml", AMBIENT),
        ],
    );
    let (text, rejected) = folder.refused("net.toml");
    assert_eq!(rejected.diagnostics.len(), 2, "{text}");
    assert!(
        text.contains(
            "error[netlist::duplicate_key]: `air` is given in two files\n --> \
        net.toml:9:1: given again\n ::: ambient.toml:3:1: first given here"
        ),
        "{text}"
    );
    assert!(
        text.contains("error[network::duplicate_name]: the name `cast` is taken twice"),
        "{text}"
    );
}

#[test]
fn circles_and_depth_are_refused() {
    let folder = Folder::new(
        "cycle",
        &[
            ("a.toml", "include = [\"b.toml\"]\nformat = 1\n"),
            ("b.toml", "include = [\"./a.toml\"]\nformat = 1\n"),
            ("self.toml", "include = [\"self.toml\"]\nformat = 1\n"),
        ],
    );
    let (text, _) = folder.refused("a.toml");
    assert!(
        text.starts_with("error[netlist::include_cycle]: files include each other: "),
        "{text}"
    );
    assert!(text.contains("\n --> b.toml:1:12\n"), "{text}");
    let (text, _) = folder.refused("self.toml");
    assert!(text.contains("includes itself"), "{text}");
    let chain = |n: usize| -> Vec<(String, String)> {
        let link = |i: usize| {
            if i < n {
                format!("include = [\"{}.toml\"]\nformat = 1\n", i + 1)
            } else {
                AMBIENT.into()
            }
        };
        (0..=n).map(|i| (format!("{i}.toml"), link(i))).collect()
    };
    let folder = |n: usize| {
        let files = chain(n);
        let files: Vec<(&str, &str)> =
            files.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        Folder::new(&format!("depth{n}"), &files)
    };
    let (text, _) = folder(9).refused("0.toml");
    assert!(
        text.starts_with(
            "error[netlist::include_depth]: files are included more than 8 deep\n --> 8.toml:1:12"
        ),
        "{text}"
    );
    // eight are allowed: what is missing is a node
    let (text, _) = folder(8).refused("0.toml");
    assert!(text.starts_with("error[network::empty]"), "{text}");
}

fn including(files: &str) -> String {
    let node = "a = { T0 = \"25 degC\", C = \"1 J/K\" }";
    format!("include = {files}\nformat = 1\n[node]\n{node}\n")
}

#[test]
fn what_cannot_be_included_is_named() {
    let net = including;
    let folder = Folder::new(
        "wrong",
        &[
            ("missing.toml", &net("[\"nothing.toml\"]")),
            ("text.toml", &net("\"bare.toml\"")),
            ("numbers.toml", &net("[1]")),
            ("bare_net.toml", &net("[\"bare.toml\"]")),
            ("bare.toml", "[boundary]\nair = { T = \"25 degC\" }\n"),
            ("empty_net.toml", &net("[\"empty.toml\"]")),
            ("empty.toml", "# nothing\n"),
            ("run_net.toml", &net("[\"run.toml\"]")),
            ("run.toml", "format = 1\n[run]\nstop = \"1 s\"\n"),
            ("broken_net.toml", &net("[\"broken.toml\"]")),
            ("broken.toml", "format = 1\n[node\n"),
            ("units_net.toml", &net("[\"units.toml\"]")),
            ("units.toml", "format = 1\n[boundary]\nair = { T = \"25 W\" }\n"),
            ("folder_net.toml", &net("[\"sub\"]")),
            ("sub/x.toml", "format = 1\n"),
        ],
    );
    let says = |file: &str, words: &str| {
        let (text, _) = folder.refused(file);
        assert!(text.contains(words), "{file}: {text}");
    };
    says(
        "missing.toml",
        "error[netlist::include_not_found]: cannot include nothing.toml: there is no such file\n \
         --> missing.toml:1:12",
    );
    says("text.toml", "error[netlist::wrong_shape]: `include` must be a list of file names");
    says(
        "numbers.toml",
        "error[netlist::wrong_shape]: `include` must be a list of file names, got a number\n --> \
         numbers.toml:1:12",
    );
    says(
        "bare_net.toml",
        "error[netlist::missing_format]: `format = 1` is missing\n --> bare.toml:1:1",
    );
    says(
        "empty_net.toml",
        "error[netlist::missing_format]: `format = 1` is missing\n --> empty.toml:1:1",
    );
    says(
        "run_net.toml",
        "error[netlist::study_in_include]: `[run]` cannot be in an included file\n --> \
         run.toml:2:2",
    );
    says("broken_net.toml", "\n --> broken.toml:2:");
    assert!(folder.refused("broken_net.toml").1.syntax);
    says(
        "units_net.toml",
        "error[units::dimension]: `T` of boundary `air` must be an absolute temperature, got a \
         power (W)\n --> units.toml:3:14",
    );
    says("folder_net.toml", "error[netlist::include_not_found]");
}

#[test]
fn a_text_without_a_file_needs_a_loader() {
    let rejected = parse("<stdin>", MAIN).unwrap_err();
    assert_eq!(rejected.diagnostics[0].code, "netlist::include_without_folder");
    let mut asked = Vec::new();
    let netlist = parse_with("folder/net.toml", MAIN, &mut |path| {
        asked.push(path.display().to_string());
        Ok(if path.ends_with("ambient.toml") { AMBIENT } else { MATERIALS }.into())
    });
    assert_eq!(netlist.unwrap().network.nodes().len(), 1);
    assert_eq!(asked, ["folder/parts/materials.toml", "folder/ambient.toml"]);
}
