//! Lines, sentences and tables.

use lptn_plot::Ink;
use lptn_plot::svg::escaped;
use lptn_report::{Align, Block, Column, Standing, Text, TextTable};

/// Cells of at most this many bytes stay on one line.
const SHORT: usize = 16;

/// Writes a text, a paragraph for each of its lines.
pub(crate) fn write(out: &mut String, text: &Text) {
    for section in text.sections() {
        *out += "<div class=\"part\">\n";
        section.iter().for_each(|part| block(out, part));
        *out += "</div>\n";
    }
}

fn block(out: &mut String, block: &Block) {
    match block {
        Block::Title(title) => *out += &format!("<h3>{}</h3>\n", coded(title)),
        Block::Line(lines) if lines.contains('\n') => verbatim(out, lines),
        Block::Line(line) => *out += &format!("<p>{}</p>\n", coded(line)),
        Block::Marked(standing, line) => {
            *out += &format!("<p class=\"{}\">{}</p>\n", class_of(*standing), coded(line));
        }
        Block::Table(of) => table(out, of),
        Block::Labelled(label, pieces) => {
            let (label, text) = (escaped(label.trim()), coded(&pieces.join(" ")));
            *out += &format!("<p><span class=\"label\">{label}</span> {text}</p>\n");
        }
    }
}

/// A text in which names between two backticks are code.
pub(crate) fn coded(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // the last of an even number of parts follows a backtick that none closes
    let pairs = (parts.len() - 1) / 2 * 2;
    let mut out = String::new();
    for (i, part) in parts.iter().enumerate() {
        let (begin, end) = match i % 2 {
            1 if i < pairs => ("<code>", "</code>"),
            1 => ("`", ""),
            _ => ("", ""),
        };
        out += &format!("{begin}{}{end}", escaped(part));
    }
    out
}

/// CSS class of a standing.
pub(crate) fn class_of(standing: Standing) -> &'static str {
    match standing {
        Standing::Holds => "holds",
        Standing::Open => "open",
        Standing::Fails => "fails",
    }
}

/// True if a text is a sparkline of block characters.
fn is_spark(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| ('\u{2581}'..='\u{2588}').contains(&c))
}

/// A text whose lines stay as they are.
pub(crate) fn verbatim(out: &mut String, lines: &str) {
    let lines: Vec<String> = lines.lines().map(escaped).collect();
    *out += &format!("<pre>{}</pre>\n", lines.join("\n"));
}

fn table(out: &mut String, table: &TextTable) {
    let class = |column: &Column| match column.align {
        Align::Right => " class=\"number\"",
        Align::Left if column.cells.iter().all(|cell| is_spark(cell)) => " class=\"spark\"",
        Align::Left if column.cells.iter().all(|cell| cell.len() <= SHORT) => " class=\"short\"",
        Align::Left => "",
    };
    *out += "<div class=\"table\"><table>\n";
    if table.columns().iter().any(|column| !column.title.is_empty()) {
        *out += "<thead><tr>";
        for column in table.columns() {
            *out += &format!("<th{}>{}</th>", class(column), escaped(&column.title));
        }
        *out += "</tr></thead>\n";
    }
    *out += "<tbody>\n";
    for row in 0..table.rows() {
        *out += "<tr>";
        for column in table.columns() {
            let class = match column.standing.get(row) {
                Some(standing) => format!(" class=\"{}\"", class_of(*standing)),
                None => match column.curves.get(row) {
                    Some(Some(place)) => {
                        format!(" class=\"spark c-{}\"", Ink::Series(*place).key())
                    }
                    _ => class(column).to_owned(),
                },
            };
            *out += &format!("<td{class}>{}</td>", coded(&column.cells[row]));
        }
        *out += "</tr>\n";
    }
    *out += "</tbody></table></div>\n";
}

#[cfg(test)]
mod tests {
    use super::coded;

    #[test]
    fn names_between_backticks_are_code() {
        let cases = [
            ("`a` and `<b>`", "<code>a</code> and <code>&lt;b&gt;</code>"),
            ("a ` b", "a ` b"),
            ("`a` ` b", "<code>a</code> ` b"),
            ("", ""),
        ];
        for (text, expected) in cases {
            assert_eq!(coded(text), expected);
        }
    }
}
