//! Writes a diagram for Mermaid.

use crate::dot::{arrow, link_words, push};
use crate::model::{Diagram, PlaceRole, Target};

/// A diagram as a flowchart of Mermaid, which GitHub draws. Ids are generated. In names and titles
/// every letter that could have another meaning is written as its number.
pub fn mermaid(diagram: &Diagram) -> String {
    let mut out = format!("---\ntitle: {}\n---\nflowchart LR\n", yaml(&diagram.title));
    for (i, place) in diagram.places.iter().enumerate() {
        let more = match &place.role {
            PlaceRole::Node(capacity) => Some(capacity.clone()),
            PlaceRole::Junction | PlaceRole::Boundary => None,
            PlaceRole::Group(words, _) => Some(words.clone()),
        };
        let [open, close] = match place.role {
            PlaceRole::Boundary => ["[[", "]]"],
            PlaceRole::Group(..) => ["[", "]"],
            _ => ["(", ")"],
        };
        let lines = [place.name.clone()].into_iter().chain(more);
        let label = quoted(&lines.chain(diagram.state_of(place)).collect::<Vec<_>>());
        push(&mut out, format_args!("  n{}{open}{label}{close}\n", i + 1));
    }
    for (i, source) in diagram.sources.iter().enumerate() {
        let label = quoted(&[source.name.clone(), source.value.clone()]);
        push(&mut out, format_args!("  s{0}(({label})) --> n{1}\n", i + 1, source.into + 1));
    }
    for link in &diagram.links {
        let (from, to, pointed) = arrow(link);
        let line = match (link.kind.declaration().section, pointed) {
            ("radiation", true) => "-.->",
            ("radiation", false) => "-.-",
            _ if link.stream => "==>",
            (_, true) => "-->",
            (_, false) => "---",
        };
        let label = quoted(&link_words(diagram, link));
        push(&mut out, format_args!("  n{} {line}|{label}| n{}\n", from + 1, to + 1));
    }
    controls(diagram, &mut out);
    out
}

fn controls(diagram: &Diagram, out: &mut String) {
    for (i, control) in diagram.controls.iter().enumerate() {
        let label = quoted(&[control.name.clone(), control.rule.clone()]);
        let id = i + 1;
        push(out, format_args!("  n{} -.-> c{id}{{{{{label}}}}}\n", control.sense + 1));
        for target in &control.switches {
            let to = match target {
                Target::Link(i) => format!("n{}", diagram.links[*i].to + 1),
                Target::Source(i) => format!("s{}", i + 1),
            };
            push(out, format_args!("  c{id} -.-> {to}\n"));
        }
    }
}

/// True if a letter has no special meaning in labels and in YAML.
fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric()
        || " .,/()_-+=%".contains(c)
        || (!c.is_ascii() && !c.is_control() && c != '\u{2028}' && c != '\u{2029}')
}

/// Lines as one quoted label.
fn quoted(lines: &[String]) -> String {
    let escaped = |line: &String| {
        let mut out = String::new();
        for c in line.chars() {
            match c {
                c if is_plain(c) => out.push(c),
                c if c.is_control() => out.push(' '),
                c => push(&mut out, format_args!("#{};", c as u32)),
            }
        }
        // an arrow is three letters, each of which is plain
        out.replace("--", "#45;#45;")
    };
    format!("\"{}\"", lines.iter().map(escaped).collect::<Vec<_>>().join("<br/>"))
}

/// A title as a quoted string of YAML.
fn yaml(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            c if is_plain(c) => out.push(c),
            c => push(&mut out, format_args!("\\u{:04x}", c as u32)),
        }
    }
    out.push('"');
    out
}
