//! Codes as a page.

use std::io;

use lptn_report::{Json, Page, RowColumn, Rows, Standing, Text};
use serde_json::{Value, json};

use super::codes::{Code, Part};

/// The network that examples add to.
const FRAGMENT: &str = "The lines belong to a network with a node `base_node`, a boundary \
    `base_air` and a resistor of 1 K/W between them.";

/// The codes that were requested.
pub(super) struct Explained {
    pub(super) codes: Vec<Code>,
    /// True if they were requested by name.
    pub(super) named: bool,
}

impl Page for Explained {
    fn text(&self) -> Text {
        let mut text = Text::new();
        if self.named {
            self.codes.iter().for_each(|code| describe(code, &mut text));
            return text;
        }
        for codes in self.codes.chunk_by(|a, b| a.area() == b.area()) {
            text.section().title(codes[0].area());
            // a code that were shortened could not be typed
            let width = codes.iter().map(|code| code.problem().len()).max().unwrap_or(0);
            for code in codes {
                text.sentence(&format!("{:width$}  ", code.problem()), code.summary());
            }
        }
        text.section().line("More on one of them: lptn explain AREA::CODE");
        text
    }

    fn rows(&self) -> Rows<'_> {
        let column = |name, text: fn(&Code) -> &str| {
            let cells: Vec<String> = self.codes.iter().map(|code| text(code).to_owned()).collect();
            RowColumn::words(name, cells)
        };
        Rows::Columns(vec![column("code", |code| code.code), column("summary", Code::summary)])
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        json.member("format", &1)?;
        json.member("codes", &self.codes.iter().map(member).collect::<Value>())
    }
}

fn describe(code: &Code, text: &mut Text) {
    text.title(code.code).sentence("", code.summary());
    for part in code.parts() {
        text.section();
        match part {
            Part::Paragraph(paragraph) => drop(text.sentence("", paragraph)),
            Part::Example(example) => example.lines.iter().for_each(|line| mark(line, text)),
        }
    }
    if code.examples().any(super::codes::Example::is_fragment) {
        text.section().sentence("", FRAGMENT);
    }
}

/// A line of an example, the sign of its file at the edge.
fn mark(line: &str, text: &mut Text) {
    let (sign, rest) = line.split_at_checked(1).unwrap_or((" ", line));
    let line = format!("{sign}   {rest}").trim_end().to_owned();
    match sign {
        "-" => text.marked(Standing::Fails, line),
        "+" => text.marked(Standing::Holds, line),
        _ => text.line(line),
    };
}

fn member(code: &Code) -> Value {
    let examples = code.examples().map(|example| {
        json!({
            "verb": example.verb,
            "fragment": example.is_fragment(),
            "wrong": example.file('+'),
            "mended": example.file('-'),
        })
    });
    json!({
        "code": code.code,
        "summary": code.summary(),
        "text": code.paragraphs().skip(1).collect::<Vec<_>>(),
        "examples": examples.collect::<Vec<_>>(),
    })
}
