//! Numbers in prose against those that the commands of the page print.

use std::path::Path;

use crate::pages;

/// Numbers that are near a printed one and are not it: the end of the page's name, the number, and
/// where it comes from.
const KNOWN: [(&str, &str, &str); 4] = [
    ("cookbook/housing.md", "125.0", "computed by hand, beside what the grid says"),
    ("netlist.md", "220.6", "an example of a number"),
    ("paper.md", "223.8", "of another fit, in the text of the paper"),
    ("paper.md", "222.85", "the power that was put in"),
];

/// Apart by less than this part, two numbers were meant to be one.
const NEAR: f64 = 3e-3;

/// A number of three digits or more, as it is written.
struct Written {
    text: String,
    value: f64,
    decimals: usize,
}

impl Written {
    fn digits(&self) -> usize {
        let digits = self.text.replace('.', "");
        digits.trim_start_matches('0').len()
    }

    /// Whether it is another number, rounded.
    fn rounds(&self, other: f64) -> bool {
        #[expect(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "few")]
        let unit = 10.0_f64.powi(-(self.decimals as i32));
        (self.value - other).abs() <= 0.5001 * unit
    }
}

/// The numbers of a line; those inside words, such as those of a reference, are none.
fn numbers(line: &str) -> Vec<Written> {
    let inside = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '^' | '-');
    let mut found = Vec::new();
    let mut before = ' ';
    let mut rest = line;
    while let Some(letter) = rest.chars().next() {
        let length = if letter.is_ascii_digit() {
            rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len())
        } else {
            letter.len_utf8()
        };
        let (part, tail) = rest.split_at(length);
        let text = part.trim_end_matches('.');
        let joined = inside(before) || tail.starts_with(|c: char| c.is_ascii_alphabetic());
        if letter.is_ascii_digit() && !joined {
            let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            found.extend(text.parse().ok().map(|value| Written {
                text: text.to_owned(),
                value,
                decimals,
            }));
        }
        before = part.chars().next_back().unwrap_or(' ');
        rest = tail;
    }
    found
}

/// The numbers in the prose of a page that are nearly one that the page prints, and not it.
pub(crate) fn nearly_printed(path: &Path) -> Vec<String> {
    let lines = pages::lines(path);
    let (mut printed, mut prose) = (Vec::new(), Vec::new());
    let mut block: Option<bool> = None;
    for (number, line) in lines.iter().enumerate() {
        if let Some(words) = line.strip_prefix("```") {
            let shows = ["console", "toml", "csv"].iter().any(|kind| words.starts_with(kind));
            block = if block.is_some() { None } else { Some(shows) };
            continue;
        }
        match block {
            Some(true) => printed.extend(numbers(line)),
            None if !line.starts_with('|') => {
                prose.extend(numbers(line).into_iter().map(|written| (number + 1, written)));
            }
            _ => {}
        }
    }
    let name = path.display().to_string();
    let known = |text: &str| KNOWN.iter().any(|(page, of, _)| name.ends_with(page) && *of == text);
    let odd = prose.iter().filter(|(_, written)| {
        let is_printed = printed.iter().any(|other| written.rounds(other.value));
        let near = |other: &&Written| {
            other.digits() >= 3 && (written.value / other.value - 1.0).abs() < NEAR
        };
        let year = written.decimals == 0 && (1800.0..2100.0).contains(&written.value);
        written.digits() >= 3
            && !year
            && !is_printed
            && printed.iter().any(|other| near(&other))
            && !known(&written.text)
    });
    odd.map(|(line, written)| format!("{name}:{line}: {}", written.text)).collect()
}
