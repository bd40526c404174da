//! `planet[*].gear`: every instance, in `of` of a limit, in `into` of a source and in the ends of a
//! path; `planet[*-1].gear`: the instance before, in the ends of a path.

use std::ops::Range;

use lptn_data::{Diagnostic, Files, Span};
use lptn_units::Expression;

use super::instance::{copied, mentions};
use super::plan::BEFORE;
use super::structure::Structure;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::section::PATHS;

const STAR: &str = "[*]";

/// Replaces a limit of all instances by one for each, and a heated pattern by its instances.
pub(super) fn expand(
    files: &mut Files,
    raw: &mut RawNetlist,
    structure: &mut Structure,
) -> Vec<Diagnostic> {
    let mut work = Patterns { files, structure, problems: Vec::new() };
    for section in &mut raw.top.entries {
        let RawKind::Table(table) = &mut section.value.kind else { continue };
        if section.key == "limit" {
            let entries = std::mem::take(&mut table.entries);
            table.entries = entries.into_iter().flat_map(|entry| work.limit(entry)).collect();
        } else if section.key == "source" {
            table.entries.retain_mut(|entry| work.source(entry));
        } else if is_path(&section.key) && table.entries.iter().any(joins_patterns) {
            let entries = std::mem::take(&mut table.entries);
            table.entries = entries.into_iter().flat_map(|entry| work.path(entry)).collect();
        }
    }
    work.problems
}

/// True for a section of elements between two ends.
fn is_path(section: &str) -> bool {
    PATHS.iter().any(|path| path.section.name == section && !path.kind.is_source())
}

/// True for a path with a pattern at an end.
fn joins_patterns(entry: &RawEntry) -> bool {
    ["from", "to"].into_iter().any(|key| field(entry, key).is_some_and(is_pattern))
}

fn is_pattern(value: &RawValue) -> bool {
    let RawKind::String { text, .. } = &value.kind else { return false };
    text.contains(STAR) || text.contains(BEFORE)
}

/// A pattern with its `[*-1]` as `[*]`.
fn plain(pattern: &str) -> String {
    pattern.replace(BEFORE, STAR)
}

struct Patterns<'s> {
    files: &'s mut Files,
    structure: &'s mut Structure,
    problems: Vec<Diagnostic>,
}

/// The indices of one instance, outermost first.
type Indices = Vec<usize>;

impl Patterns<'_> {
    /// `hot` with `of = "planet[*].gear.T"` becomes `hot[1]`, `hot[2]` and so on.
    fn limit(&mut self, entry: RawEntry) -> Vec<RawEntry> {
        let Some((text, value)) =
            field(&entry, "of").and_then(|value| Some((starred(value)?, value)))
        else {
            return vec![entry];
        };
        let Ok(expression) = Expression::parse(text) else { return vec![entry] };
        // those inside `max(…)` and the like are one value
        let members = |name: &str| self.structure.members(&value.span, name);
        let expression = expression.with_members(&members);
        let names = expression.names().into_iter().filter(|(name, _)| name.contains(STAR));
        let names: Vec<(String, Range<usize>)> = names.collect();
        if names.is_empty() {
            return vec![entry];
        }
        let mut all: Option<Vec<Indices>> = None;
        for (name, range) in &names {
            let before = self.problems.len();
            let Some(indices) = self.instances(name, (&value.span, &value.part(range))) else {
                // one that has been reported is not to be read
                return if self.problems.len() > before { Vec::new() } else { vec![entry] };
            };
            match &all {
                Some(first) if *first != indices => {
                    self.problems.push(uneven(&names, value));
                    return Vec::new();
                }
                _ => all = Some(indices),
            }
        }
        let each = all.unwrap_or_default().into_iter().map(|indices| {
            let list: Vec<String> = indices.iter().map(usize::to_string).collect();
            let key = format!("{}[{}]", entry.key, list.join(","));
            self.numbered(with_of(&entry, key, filled(text, &names, &indices)), &indices)
        });
        each.collect()
    }

    /// `side` from `cell[*-1].body` to `cell[*].body` becomes `side[2]`, `side[3]` and so on.
    fn path(&mut self, entry: RawEntry) -> Vec<RawEntry> {
        let ends = ["from", "to"].map(|key| {
            let value = field(&entry, key).filter(|value| is_pattern(value))?;
            let RawKind::String { text, .. } = &value.kind else { return None };
            Some((text.clone(), value.clone()))
        });
        let given: Vec<&(String, RawValue)> = ends.iter().flatten().collect();
        let Some((_, place)) = given.first() else { return vec![entry] };
        let mut all: Option<Vec<Indices>> = None;
        for (pattern, value) in &given {
            let found = self.instances(&plain(pattern), (&value.span, &value.span));
            let Some(found) = found else { return Vec::new() };
            if all.as_ref().is_some_and(|all| *all != found) {
                let names =
                    given.iter().map(|(text, value)| (text.clone(), value.span.range.clone()));
                self.problems.push(uneven(&names.collect::<Vec<_>>(), place));
                return Vec::new();
            }
            all = Some(found);
        }
        let behind = given.iter().any(|(pattern, _)| pattern.contains(BEFORE));
        let each = all.unwrap_or_default().into_iter();
        let each = each.filter(|indices| !behind || indices.iter().all(|index| *index > 1));
        each.map(|indices| self.numbered(between(&entry, &indices), &indices)).collect()
    }

    /// An element of one instance, whose values may read its number.
    fn numbered(&mut self, entry: RawEntry, indices: &[usize]) -> RawEntry {
        let [index] = *indices else { return entry };
        if !mentions(&entry.value) {
            return entry;
        }
        let named = (entry.key.clone(), entry.key_span.clone());
        let copy = self.structure.copy_of(self.files, named, index);
        copied(&entry, copy)
    }

    /// `into = "planet[*].gear"` shares the heat equally; `false` after an error.
    fn source(&mut self, entry: &mut RawEntry) -> bool {
        let before = self.problems.len();
        let RawKind::Table(fields) = &mut entry.value.kind else { return true };
        let Some(into) = fields.entries.iter_mut().find(|field| field.key == "into") else {
            return true;
        };
        let span = into.value.span.clone();
        let shares = match &into.value.kind {
            RawKind::String { text, .. } if text.contains(STAR) => {
                let whole = RawValue { span: span.clone(), kind: RawKind::Integer("1".to_owned()) };
                self.shares(text, (&span, &whole))
            }
            RawKind::Table(table) if table.entries.iter().any(|share| share.key.contains(STAR)) => {
                let shares = table.entries.iter().map(|share| match share.key.contains(STAR) {
                    true => self.shares(&share.key, (&share.key_span, &share.value)),
                    false => Some(vec![share.clone()]),
                });
                shares.collect::<Option<Vec<_>>>().map(|shares| shares.concat())
            }
            _ => return true,
        };
        if let Some(entries) = shares {
            into.value.kind = RawKind::Table(RawTable { span, entries });
        }
        self.problems.len() == before
    }

    /// A share for each instance, which sum to the share of all.
    fn shares(
        &mut self,
        pattern: &str,
        (span, share): (&Span, &RawValue),
    ) -> Option<Vec<RawEntry>> {
        let instances = self.instances(pattern, (span, span))?;
        let each = match &share.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
                text.trim().replace('_', "").parse::<f64>().ok()
            }
            _ => None,
        };
        // a share that is not a number is reported where it is read
        let number =
            each.map(|share| RawKind::Float(format!("{:?}", share / instances.len() as f64)));
        let kind = number.unwrap_or_else(|| share.kind.clone());
        let value = RawValue { span: share.span.clone(), kind };
        let entry = |indices: Indices| RawEntry {
            key: fill(pattern, &indices),
            key_span: span.clone(),
            value: value.clone(),
        };
        Some(instances.into_iter().map(entry).collect())
    }

    /// The indices of every instance that a pattern names; `None` if it names none, which is
    /// reported.
    fn instances(&mut self, pattern: &str, (scope, at): (&Span, &Span)) -> Option<Vec<Indices>> {
        let full = self.structure.resolve(scope, pattern);
        if self.structure.is_lost(&full) {
            return None;
        }
        let mut found: Vec<(String, Indices)> = vec![(String::new(), Vec::new())];
        for part in full.split('.') {
            let mut next = Vec::new();
            for (before, indices) in found {
                let Some(name) = part.strip_suffix(STAR) else {
                    next.push((format!("{before}{part}."), indices));
                    continue;
                };
                let used = format!("{before}{name}");
                let Some(Some(count)) = self.structure.count(&used) else {
                    self.problems.push(no_instances(&used, at));
                    return None;
                };
                next.extend((1..=count).map(|index| {
                    let indices = indices.iter().copied().chain([index]).collect();
                    (format!("{used}[{index}]."), indices)
                }));
            }
            found = next;
        }
        Some(found.into_iter().map(|(_, indices)| indices).collect())
    }
}

fn field<'e>(entry: &'e RawEntry, key: &str) -> Option<&'e RawValue> {
    match &entry.value.kind {
        RawKind::Table(table) => table.get(key).map(|field| &field.value),
        _ => None,
    }
}

/// The text of a string that contains a pattern.
fn starred(value: &RawValue) -> Option<&str> {
    match &value.kind {
        RawKind::String { text, .. } if text.contains(STAR) => Some(text),
        _ => None,
    }
}

/// A pattern with numbers instead of its stars.
fn fill(pattern: &str, indices: &[usize]) -> String {
    let mut text = pattern.to_owned();
    for index in indices {
        text = text.replacen(STAR, &format!("[{index}]"), 1);
    }
    text
}

/// An expression with every pattern filled.
fn filled(text: &str, names: &[(String, Range<usize>)], indices: &[usize]) -> String {
    let mut filled = text.to_owned();
    for (name, range) in names.iter().rev() {
        filled.replace_range(range.clone(), &fill(name, indices));
    }
    filled
}

fn with_of(entry: &RawEntry, key: String, text: String) -> RawEntry {
    let mut entry = RawEntry { key, ..entry.clone() };
    if let RawKind::Table(table) = &mut entry.value.kind
        && let Some(of) = table.entries.iter_mut().find(|field| field.key == "of")
    {
        of.value.kind = RawKind::String { text, start: None };
    }
    entry
}

/// The path of one index, with its ends filled.
fn between(entry: &RawEntry, indices: &[usize]) -> RawEntry {
    let list: Vec<String> = indices.iter().map(usize::to_string).collect();
    let mut entry = RawEntry { key: format!("{}[{}]", entry.key, list.join(",")), ..entry.clone() };
    let RawKind::Table(table) = &mut entry.value.kind else { return entry };
    for end in table.entries.iter_mut().filter(|field| ["from", "to"].contains(&&*field.key)) {
        let RawKind::String { text, start } = &mut end.value.kind else { continue };
        if text.contains(STAR) || text.contains(BEFORE) {
            let before: Vec<usize> = indices.iter().map(|index| index - 1).collect();
            let indices = if text.contains(BEFORE) { &before } else { indices };
            (*text, *start) = (fill(&plain(text), indices), None);
        }
    }
    entry
}

fn no_instances(used: &str, at: &Span) -> Diagnostic {
    let message =
        format!("`{used}[*]` means every instance, but `{used}` is not a use with a `count`");
    Diagnostic::wrong(
        "netlist::pattern",
        message,
        at,
        "write the name of a `[use.NAME]` that has a `count` before `[*]`",
    )
}

/// Patterns of one expression that do not go through the same instances.
fn uneven(names: &[(String, Range<usize>)], value: &RawValue) -> Diagnostic {
    let list: Vec<&str> = names.iter().map(|(name, _)| name.as_str()).collect();
    let message = format!("{} do not have the same instances", lptn_data::list(&list));
    Diagnostic::wrong(
        "netlist::pattern",
        message,
        &value.span,
        "every `[*]` takes the same index: use patterns of one count, or write a limit for each",
    )
}
