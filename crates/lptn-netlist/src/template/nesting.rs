//! Templates that contain each other.

use super::definition::Template;
use lptn_data::Diagnostic;

use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

/// Greatest depth of parts inside parts.
const DEEPEST: usize = 32;

/// The sizes of templates with everything that they use.
struct Extent {
    /// Number of instances that one instance makes, itself included.
    instances: Vec<usize>,
    depth: Vec<usize>,
}

/// Reports every circle of templates once, and marks its members as broken. Returns the number of
/// instances that one of each other template makes, itself included.
pub(super) fn check(templates: &mut [Template<'_>], problems: &mut Vec<Diagnostic>) -> Vec<usize> {
    let edges: Vec<Vec<Edge<'_>>> =
        templates.iter().map(|template| used_by(template.uses, templates)).collect();
    let mut state = vec![State::New; templates.len()];
    let mut extent =
        Extent { instances: vec![1; templates.len()], depth: vec![1; templates.len()] };
    let mut circles = Vec::new();
    for start in 0..templates.len() {
        let mut path = vec![(start, 0_usize)];
        while let Some((at, next)) = path.last_mut() {
            let (at, edge) = (*at, *next);
            *next += 1;
            if edge == 0 && state[at] != State::New {
                path.pop();
                continue;
            }
            state[at] = State::Open;
            match edges[at].get(edge) {
                None => {
                    state[at] = State::Done;
                    extent.close(at, &edges[at]);
                    path.pop();
                }
                Some(edge) if state[edge.used] == State::New => path.push((edge.used, 0)),
                Some(edge) if state[edge.used] == State::Open => {
                    // each step is the member and the edge that was taken
                    let members = path.iter().map(|(at, next)| (*at, next - 1));
                    circles
                        .push(members.skip_while(|(at, _)| *at != edge.used).collect::<Vec<_>>());
                }
                Some(_) => {}
            }
        }
    }
    for circle in circles {
        let steps: Vec<(&str, &RawValue)> = circle
            .iter()
            .map(|&(at, edge)| (templates[at].name(), edges[at][edge].value))
            .collect();
        problems.push(describe(&steps));
        circle.iter().for_each(|(at, _)| templates[*at].broken = true);
    }
    for (template, depth) in templates.iter_mut().zip(extent.depth) {
        if depth == DEEPEST + 1 {
            problems.push(too_deep(template));
        }
        template.broken |= depth > DEEPEST;
    }
    extent.instances
}

impl Extent {
    /// Adds the sizes of everything that a template uses, once they are known.
    fn close(&mut self, at: usize, edges: &[Edge<'_>]) {
        for edge in edges {
            let inner = self.instances[edge.used].saturating_mul(edge.count);
            self.instances[at] = self.instances[at].saturating_add(inner);
            self.depth[at] = self.depth[at].max(self.depth[edge.used] + 1);
        }
    }
}

/// One template uses another.
struct Edge<'r> {
    used: usize,
    count: usize,
    value: &'r RawValue,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

/// The templates that these uses name.
fn used_by<'r>(uses: &'r [RawEntry], templates: &[Template<'_>]) -> Vec<Edge<'r>> {
    let named = uses.iter().filter_map(|entry| {
        let RawKind::Table(table) = &entry.value.kind else { return None };
        let value = &table.get("template")?.value;
        let RawKind::String { text, .. } = &value.kind else { return None };
        let used = templates.iter().position(|template| template.name() == text)?;
        Some(Edge { used, count: count(table), value })
    });
    named.collect()
}

/// The count of a use, 1 if it cannot be read.
pub(super) fn count(line: &RawTable) -> usize {
    match line.get("count").map(|field| &field.value.kind) {
        Some(RawKind::Integer(number)) => number.replace('_', "").parse().unwrap_or(1),
        _ => 1,
    }
}

fn too_deep(template: &Template<'_>) -> Diagnostic {
    let message = format!("templates are inside each other more than {DEEPEST} deep");
    Diagnostic::error("netlist::template_depth", message)
        .at(template.entry.key_span.clone(), "the one around all")
        .help("write the innermost parts into the template that uses them")
}

fn describe(steps: &[(&str, &RawValue)]) -> Diagnostic {
    let mut chain: Vec<&str> = steps.iter().map(|(name, _)| *name).collect();
    chain.extend(chain.first().copied());
    let message = match steps {
        [(one, _)] => format!("template `{one}` uses itself"),
        _ => format!("templates use each other: {}", chain.join(" -> ")),
    };
    let next = chain.iter().skip(1);
    let uses = steps
        .iter()
        .zip(next)
        .map(|((_, value), next)| (value.span.clone(), format!("uses `{next}`")));
    Diagnostic::error("netlist::template_recursion", message)
        .places(uses)
        .help("a part cannot be inside itself: take one of the uses out, or give a use a `count`")
}
