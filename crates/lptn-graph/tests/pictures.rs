//! Pictures of every network of the collection: nothing that is to be read lies under anything
//! else, the same network gives the same bytes, and names cannot become code.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{EVIL, check, drawn, networks};
use lptn_graph::{Diagram, Grouping, Laid, dot, mermaid};
use lptn_netlist::Netlist;
use lptn_plot::{png, svg};

/// A ladder of so many nodes that lose heat to one boundary: rows of columns.
fn ladder(count: usize) -> Netlist {
    let mut text = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\n".to_owned();
    (1..=count).for_each(|i| text += &format!("n{i} = {{ C = \"{i} J/K\" }}\n"));
    text +=
        "[boundary]\nair = { T = \"20 degC\" }\n[source]\nheat = { into = \"n1\", P = \"9 W\" }\n";
    text += "[resistor]\n";
    for i in 1..count {
        text += &format!("r{i} = {{ from = \"n{i}\", to = \"n{}\", R = \"0.1 K/W\" }}\n", i + 1);
    }
    (1..=count).for_each(|i| {
        text += &format!("c{i} = {{ from = \"n{i}\", to = \"air\", R = \"9 K/W\" }}\n")
    });
    lptn_netlist::parse("ladder", &text).unwrap()
}

#[test]
fn nothing_lies_upon_a_text() {
    for path in networks() {
        let netlist = lptn_netlist::read(&path).unwrap();
        for steady in [false, true] {
            let picture = Laid::of(&drawn(&netlist, steady, Grouping::Auto)).scene().unwrap();
            check(&picture, &path.display().to_string());
        }
        check(&Laid::of(&drawn(&netlist, true, Grouping::Yes)).scene().unwrap(), "grouped");
    }
    check(&Laid::of(&drawn(&ladder(100), true, Grouping::No)).scene().unwrap(), "ladder");
}

#[test]
fn the_same_network_gives_the_same_bytes() {
    for name in ["gearbox", "planetary_stage", "heated_tube"] {
        let path = networks().into_iter().find(|path| path.ends_with(format!("{name}.toml")));
        let path = path.unwrap();
        let all = || {
            let of = drawn(&lptn_netlist::read(&path).unwrap(), true, Grouping::Auto);
            let picture = Laid::of(&of).scene().unwrap();
            (dot(&of), mermaid(&of), svg::write(&picture), png::write(&picture, 1.0).unwrap())
        };
        assert!(all() == all(), "{name}");
    }
}

#[test]
fn large_networks_are_grouped_by_the_number_at_the_end_of_their_names() {
    let of = drawn(&ladder(200), false, Grouping::Auto);
    let names: Vec<&str> = of.places.iter().map(|place| place.name.as_str()).collect();
    assert_eq!(names, ["n*", "air"]);
    assert_eq!(of.grouped, ["n*: 200 nodes"]);
    // 200 paths of 9 K/W side by side, and those inside are left out
    assert_eq!(of.links.len(), 1);
    assert_eq!(of.links[0].value.as_deref(), Some("45 mK/W"));
    assert_eq!(drawn(&ladder(100), false, Grouping::Auto).places.len(), 101);
    assert_eq!(drawn(&ladder(200), false, Grouping::No).places.len(), 201);
}

fn evil() -> Diagram {
    let mut of = drawn(&ladder(3), true, Grouping::No);
    of.title = EVIL.into();
    of.places.iter_mut().for_each(|place| place.name = EVIL.into());
    of.links.iter_mut().for_each(|link| link.name = EVIL.into());
    of.sources.iter_mut().for_each(|source| source.name = EVIL.into());
    of
}

#[test]
fn names_cannot_become_elements_of_svg() {
    let text = svg::write(&Laid::of(&evil()).scene().unwrap());
    assert!(!text.contains("<script") && text.matches("</svg>").count() == 1, "{text}");
}

#[test]
fn names_cannot_become_code_of_mermaid() {
    let text = mermaid(&evil());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines[0], lines[2], lines[3]), ("---", "---", "flowchart LR"));
    assert!(!text.contains("<script") && !text.contains("%%{") && !text.contains('`'), "{text}");
    // outside of quotes stand ids and marks of ours only
    for line in &lines[4..] {
        let parts: Vec<&str> = line.split('"').collect();
        assert_eq!(parts.len(), 3, "{line}");
        let code = [parts[0], parts[2]].concat();
        assert!(code.chars().all(|c| c.is_ascii_digit() || " ns|->=.()[]".contains(c)), "{code}");
        let label = parts[1].replace("<br/>", "");
        assert!(
            !label.contains(['<', '>', '[', ']', '\\', '|']) && !label.contains("--"),
            "{label}"
        );
    }
    assert_eq!(lines.len(), 4 + 4 + 1 + 5);
}

#[test]
fn names_cannot_become_code_of_dot() {
    let text = dot(&evil());
    // what stands outside of quoted strings; a backslash takes the next letter with it
    let (mut code, mut quoted) = (String::new(), false);
    let mut letters = text.chars();
    while let Some(c) = letters.next() {
        match c {
            '\\' if quoted => drop(letters.next()),
            '"' => quoted = !quoted,
            c if !quoted => code.push(c),
            _ => {}
        }
    }
    assert!(!quoted && !code.contains("script") && !code.contains("init"), "{code}");
    let nodes = code.matches("n1 [label=").count();
    assert_eq!((nodes, code.matches("->").count()), (1, 1 + 5), "{code}");
}

/// Graphviz reads what is written, names and all, where it is installed.
#[test]
fn graphviz_reads_dot() {
    use std::io::Write as _;
    use std::process::{Command, Stdio};
    let version = Command::new("dot").arg("-V").output();
    if !version.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: Graphviz is not installed, `apt install graphviz`: DOT was not read");
        return;
    }
    let gearbox = networks().into_iter().find(|path| path.ends_with("gearbox.toml")).unwrap();
    let gearbox = drawn(&lptn_netlist::read(&gearbox).unwrap(), true, Grouping::Auto);
    for (of, nodes, edges) in [(evil(), 4 + 1, 5 + 1), (gearbox, 4 + 1, 3 + 1)] {
        let mut child = Command::new("dot")
            .arg("-Tplain")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(dot(&of).as_bytes()).unwrap();
        let output = child.wait_with_output().unwrap();
        let (text, said) =
            (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success() && !said.contains("rror"), "{said}");
        let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
        assert_eq!((count("node "), count("edge ")), (nodes, edges), "{text}");
    }
}
