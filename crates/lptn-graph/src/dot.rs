//! Writes a diagram for Graphviz.

use std::fmt::Write as _;

use crate::model::{Diagram, Link, PlaceRole, Target};

/// A diagram in the language DOT of Graphviz. Ids are generated; names and titles appear only in
/// quoted strings.
pub fn dot(diagram: &Diagram) -> String {
    let mut out = format!(
        "digraph {{\n  graph [rankdir=LR, label={}, labelloc=t, fontname=Helvetica];\n  node \
         [shape=box, style=rounded, fontname=Helvetica];\n  edge [fontname=Helvetica, \
         fontsize=11];\n",
        quoted(std::slice::from_ref(&diagram.title))
    );
    for (i, place) in diagram.places.iter().enumerate() {
        let (shape, capacity) = match &place.role {
            PlaceRole::Node(capacity) => ("", Some(capacity.clone())),
            PlaceRole::Junction => (", style=\"rounded,dashed\"", None),
            PlaceRole::Boundary => (", style=bold", None),
            PlaceRole::Group(words, capacity) => {
                let words = capacity.iter().fold(words.clone(), |a, c| format!("{a}, {c}"));
                (", peripheries=2", Some(words))
            }
        };
        let lines = [place.name.clone()].into_iter().chain(capacity);
        let label = quoted(&lines.chain(diagram.state_of(place)).collect::<Vec<_>>());
        push(&mut out, format_args!("  n{} [label={label}{shape}];\n", i + 1));
    }
    for (i, source) in diagram.sources.iter().enumerate() {
        let label = quoted(&[source.name.clone(), source.value.clone()]);
        push(&mut out, format_args!("  s{} [label={label}, shape=circle];\n", i + 1));
        push(&mut out, format_args!("  s{} -> n{};\n", i + 1, source.into + 1));
    }
    for link in &diagram.links {
        push(&mut out, format_args!("  {};\n", edge(diagram, link)));
    }
    controls(diagram, &mut out);
    out.push_str("}\n");
    out
}

/// Writing to a `String` cannot fail.
pub(crate) fn push(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = out.write_fmt(text);
}

/// The lines of text at a path: its name, its value or kind, its heat.
pub(crate) fn link_words(diagram: &Diagram, link: &Link) -> Vec<String> {
    let value = link.value.clone().unwrap_or_else(|| link.kind.declaration().section.to_owned());
    let heat = diagram.scales.as_ref().zip(link.heat);
    let heat = heat.map(|(scales, heat)| scales.heat(heat));
    [Some(link.name.clone()), Some(value), heat].into_iter().flatten().collect()
}

/// The ends of the arrow of a path, and true if it has one. It points with the fluid, else with the
/// heat.
pub(crate) fn arrow(link: &Link) -> (usize, usize, bool) {
    match link.heat {
        _ if link.stream => (link.from, link.to, true),
        Some(heat) if heat < 0.0 => (link.to, link.from, true),
        Some(heat) => (link.from, link.to, heat > 0.0),
        None => (link.from, link.to, false),
    }
}

fn edge(diagram: &Diagram, link: &Link) -> String {
    let label = quoted(&link_words(diagram, link));
    let (from, to, arrow) = arrow(link);
    let arrow = if arrow { "" } else { ", dir=none" };
    let style = match link.kind.declaration().section {
        "radiation" => ", style=dashed",
        _ if link.stream => ", style=bold",
        _ => "",
    };
    format!("n{} -> n{} [label={label}{arrow}{style}]", from + 1, to + 1)
}

fn controls(diagram: &Diagram, out: &mut String) {
    for (i, control) in diagram.controls.iter().enumerate() {
        let label = quoted(&[control.name.clone(), control.rule.clone()]);
        let id = i + 1;
        push(out, format_args!("  c{id} [label={label}, style=dotted];\n"));
        push(out, format_args!("  n{} -> c{id} [style=dotted];\n", control.sense + 1));
        for target in &control.switches {
            let to = match target {
                Target::Link(i) => format!("n{}", diagram.links[*i].to + 1),
                Target::Source(i) => format!("s{}", i + 1),
            };
            push(out, format_args!("  c{id} -> {to} [style=dotted];\n"));
        }
    }
}

/// Lines as one quoted string. Backslashes and quotes are escaped.
fn quoted(lines: &[String]) -> String {
    let escaped = |line: &String| {
        let mut out = String::new();
        for c in line.chars() {
            match c {
                '"' => out.push_str("\\\""),
                '\\' => out.push_str("\\\\"),
                c if c.is_control() => out.push(' '),
                // Graphviz reads entities of HTML in every label
                '&' => out.push_str("&amp;"),
                c => out.push(c),
            }
        }
        out
    };
    format!("\"{}\"", lines.iter().map(escaped).collect::<Vec<_>>().join("\\n"))
}
