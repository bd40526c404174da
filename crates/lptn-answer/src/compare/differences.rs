//! The candidates side by side: titles, conditions, and the values in which their netlists differ.
//!
//! The values of elements are those of the expansion, so a part that a template makes is compared
//! as it is computed.

use lptn_netlist::Derived;
use lptn_report::{Align, Column, Piece, Section, Standing, Text, TextTable, plain, significant};

use super::conditions::Condition;
use super::margins::NOTHING;
use super::{CompareAnswer, page};
use crate::input::Input;
use crate::words::{count, spaced};

/// Candidates next to each other: the best.
const MOST: usize = 6;

/// Most values in which candidates differ that are listed.
const MOST_ROWS: usize = 24;

/// A name and the text of its value in each candidate.
type Line = (String, Vec<String>);

impl CompareAnswer {
    /// The verdict, the conditions, and the differences of the netlists.
    pub(super) fn side_by_side(&self) -> Vec<Section> {
        let mut text = Text::new();
        if let Some(verdict) = self.verdict() {
            text.marked(self.standing(), verdict).section();
        }
        let known: Vec<usize> =
            (0..self.rows.len()).filter(|&row| self.inputs[row].is_some()).collect();
        let shown = &known[..known.len().min(MOST)];
        if shown.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![("title".to_owned(), self.titles(shown))];
        let ambients = self.ambients().into_iter();
        lines.extend(ambients.map(|of| (format!("T of {}", of.name), texts(&of, shown))));
        lines.extend([self.duty(), self.length()].map(|of| (of.name.clone(), texts(&of, shown))));
        text.table(self.table("candidate", shown, lines));
        let mut lines = self.differences(shown);
        let all = lines.len();
        lines.truncate(MOST_ROWS);
        if !lines.is_empty() {
            text.section().table(self.table("differs in", shown, lines));
        }
        if all > MOST_ROWS {
            text.line(format!("{MOST_ROWS} of {all} values that differ are shown"));
        }
        if shown.len() < known.len() {
            text.line(format!("the first {} of {}", shown.len(), count(known.len(), "candidate")));
        }
        vec![Section::of("Verdict", Piece::Text(text))]
    }

    /// True if the best candidate keeps its limits.
    fn standing(&self) -> Standing {
        let has = |status: &str| self.rows.iter().any(|row| row.status() == status);
        match (has("kept"), has("broken")) {
            (true, _) => Standing::Holds,
            (false, true) => Standing::Fails,
            _ => Standing::Open,
        }
    }

    fn titles(&self, shown: &[usize]) -> Vec<String> {
        shown.iter().map(|&row| self.rows[row].title.clone()).collect()
    }

    fn table(&self, first: &str, shown: &[usize], lines: Vec<Line>) -> TextTable {
        let names = page::names(&self.rows);
        let labels = lines.iter().map(|line| line.0.clone()).collect();
        let mut columns = vec![Column::new(first, Align::Left, labels)];
        for (i, &row) in shown.iter().enumerate() {
            let cells = lines.iter().map(|line| line.1[i].clone()).collect();
            columns.push(Column::new(names[row].clone(), Align::Left, cells));
        }
        TextTable::new(columns)
    }

    /// Parameters and values of elements in which the netlists of rows differ.
    pub(super) fn differences(&self, rows: &[usize]) -> Vec<Line> {
        let declared: Vec<Vec<(String, String)>> = rows
            .iter()
            .map(|&row| self.inputs[row].as_deref().map_or(Vec::new(), declared))
            .collect();
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in declared.iter().flatten() {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        let line = |name: &str| {
            let of = |own: &Vec<(String, String)>| {
                let found = own.iter().find(|(key, _)| key == name);
                found.map_or_else(|| NOTHING.to_owned(), |(_, value)| value.clone())
            };
            (name.to_owned(), declared.iter().map(of).collect::<Vec<_>>())
        };
        let lines = names.into_iter().map(line);
        lines.filter(|(_, cells)| cells.iter().any(|cell| *cell != cells[0])).collect()
    }
}

fn texts(of: &Condition, shown: &[usize]) -> Vec<String> {
    let cell = |&row: &usize| {
        of.cells[row].as_ref().map_or_else(|| NOTHING.to_owned(), |(_, text)| text.clone())
    };
    shown.iter().map(cell).collect()
}

/// Every parameter and every value of an element, by name.
fn declared(input: &Input) -> Vec<(String, String)> {
    let network = &input.netlist.network;
    let value = |(parameter, id): (&lptn_network::Parameter, _)| {
        let unit = input.unit_of(id);
        let number = significant(unit.from_si(network.parameter_value(id)), 6);
        (parameter.name.clone(), format!("{number}{}", spaced(&unit.text)))
    };
    let parameters = network.parameters().iter().zip(network.parameter_ids()).map(value);
    parameters.chain(elements(input)).collect()
}

/// The values of the elements: `skin.h` and `10 W/(m^2 K)`.
fn elements(input: &Input) -> Vec<(String, String)> {
    let made = Derived { network: &input.netlist.network, title: "", run: None, folder: None };
    let text = input.netlist.derived(&made);
    let (mut section, mut found) = (String::new(), Vec::new());
    for line in text.lines() {
        if let Some(name) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            section = name.split_once('.').map_or(String::new(), |(_, own)| format!("{own}."));
            if name == "param" {
                section = "param".to_owned();
            }
            continue;
        }
        let (Some((key, value)), false) = (line.split_once(" = "), section == "param") else {
            continue;
        };
        let name = format!("{section}{key}");
        match value.strip_prefix("{ ").and_then(|value| value.strip_suffix(" }")) {
            Some(fields) => found.extend(pieces(fields).into_iter().filter_map(|field| {
                let (key, value) = field.split_once(" = ")?;
                Some((format!("{name}.{key}"), shown(value)))
            })),
            None => found.push((name, shown(value))),
        }
    }
    found
}

/// A value without its quotes.
fn shown(value: &str) -> String {
    plain(value.trim_matches('"'))
}

/// Parts of a text between commas outside of quotes and brackets.
fn pieces(text: &str) -> Vec<&str> {
    let (mut depth, mut quoted, mut begin) = (0_i32, false, 0);
    let mut found = Vec::new();
    for (at, sign) in text.char_indices() {
        match sign {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            ',' if !quoted && depth == 0 => {
                found.push(text[begin..at].trim());
                begin = at + 1;
            }
            _ => {}
        }
    }
    found.push(text[begin..].trim());
    found
}

#[cfg(test)]
mod tests {
    use super::pieces;

    #[test]
    fn commas_inside_of_values_do_not_part_them() {
        let found = pieces("from = \"a\", G = \"max(1 [W/K], G_0)\", t = [[1, 2], [3, 4]]");
        assert_eq!(found, ["from = \"a\"", "G = \"max(1 [W/K], G_0)\"", "t = [[1, 2], [3, 4]]"]);
    }
}
