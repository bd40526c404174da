//! Descriptions of the codes: the pages of `docs/codes`, which are a part of the program.

/// The pages. A code is in a heading `## area::problem`, codes of the same meaning in one heading.
/// The first paragraph below it is the summary in one line.
const PAGES: [&str; 7] = [
    include_str!("../../../../../docs/codes/netlist.md"),
    include_str!("../../../../../docs/codes/network.md"),
    include_str!("../../../../../docs/codes/units.md"),
    include_str!("../../../../../docs/codes/records.md"),
    include_str!("../../../../../docs/codes/runs.md"),
    include_str!("../../../../../docs/codes/studies.md"),
    include_str!("../../../../../docs/codes/command.md"),
];

/// Words of a verdict, in the same form.
const WORDS: &str = include_str!("../../../../../docs/codes/words.md");

/// A code and the text below its heading.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Code {
    pub(crate) code: &'static str,
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Part {
    /// A paragraph on one line.
    Paragraph(String),
    /// A wrong file and the corrected one.
    Example(Example),
}

/// A block ` ```diff `: lines of both files, of the wrong one (`-`) and of the corrected one (`+`).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Example {
    /// The verb that shows it, with its options.
    pub(crate) verb: &'static str,
    pub(crate) lines: Vec<&'static str>,
}

impl Code {
    /// The part before `::`.
    pub(crate) fn area(&self) -> &'static str {
        self.code.split("::").next().unwrap_or_default()
    }

    /// The part after `::`.
    pub(crate) fn problem(&self) -> &'static str {
        self.code.rsplit("::").next().unwrap_or_default()
    }

    /// Its summary in one line.
    pub(crate) fn summary(&self) -> &str {
        self.paragraphs().next().unwrap_or_default()
    }

    /// Everything but the summary.
    pub(crate) fn parts(&self) -> &[Part] {
        self.parts.get(1..).unwrap_or_default()
    }

    pub(crate) fn paragraphs(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().filter_map(|part| match part {
            Part::Paragraph(text) => Some(text.as_str()),
            Part::Example(_) => None,
        })
    }

    pub(crate) fn examples(&self) -> impl Iterator<Item = &Example> {
        self.parts.iter().filter_map(|part| match part {
            Part::Paragraph(_) => None,
            Part::Example(example) => Some(example),
        })
    }
}

impl Example {
    /// One of the two files.
    pub(crate) fn file(&self, without: char) -> String {
        let lines = self.lines.iter().filter(|line| !line.starts_with(without));
        lines.map(|line| format!("{}\n", line.get(1..).unwrap_or_default())).collect()
    }

    /// True if it is a record, not a netlist.
    pub(crate) fn is_record(&self) -> bool {
        self.verb.starts_with("fit step")
    }

    /// True if it is an addition to a small network; one with a `format` is complete.
    pub(crate) fn is_fragment(&self) -> bool {
        !self.is_record() && !self.file('-').starts_with("format")
    }
}

/// Every code, by area and name.
pub(crate) fn all() -> Vec<Code> {
    let mut codes: Vec<Code> = PAGES.iter().flat_map(|page| of_page(page)).collect();
    codes.sort_by_key(|code| code.code);
    codes
}

/// Words of a verdict, each as a code: `broken`.
pub(crate) fn words() -> impl Iterator<Item = Code> {
    of_page(WORDS).into_iter()
}

fn of_page(page: &'static str) -> Vec<Code> {
    let sections = page.split("\n## ").skip(1);
    let section = |text: &'static str| {
        let text = text.split("\n# ").next().unwrap_or_default();
        let (heading, body) = text.split_once('\n').unwrap_or((text, ""));
        let parts = parts(body);
        heading.split(", ").map(|code| Code { code, parts: parts.clone() }).collect::<Vec<_>>()
    };
    sections.flat_map(section).collect()
}

fn parts(body: &'static str) -> Vec<Part> {
    let (mut parts, mut paragraph) = (Vec::new(), Vec::new());
    let mut lines = body.lines();
    while let Some(line) = lines.next() {
        let verb = line.strip_prefix("```diff");
        match verb {
            None if !line.is_empty() => paragraph.push(line),
            _ if !paragraph.is_empty() => {
                parts.push(Part::Paragraph(std::mem::take(&mut paragraph).join(" ")));
            }
            _ => {}
        }
        if let Some(verb) = verb {
            let lines = lines.by_ref().take_while(|line| *line != "```").collect();
            let verb = Some(verb.trim()).filter(|verb| !verb.is_empty()).unwrap_or("check");
            parts.push(Part::Example(Example { verb, lines }));
        }
    }
    let last = (!paragraph.is_empty()).then(|| Part::Paragraph(paragraph.join(" ")));
    parts.extend(last);
    parts
}

#[cfg(test)]
mod tests {
    use super::{Part, of_page};

    #[test]
    fn a_page_is_cut_into_codes_with_their_parts() {
        let page = "# Area\n\n## a::b, a::c\n\nShort.\n\nLong\nlines.\n\n```diff run\n x\n-y\n\
                    +z\n```\n\n# Other\n\n## a::d\n\nLast.\n";
        let codes = of_page(page);
        let names: Vec<&str> = codes.iter().map(|code| code.code).collect();
        assert_eq!(names, ["a::b", "a::c", "a::d"]);
        assert_eq!((codes[0].summary(), codes[2].summary()), ("Short.", "Last."));
        assert_eq!(codes[1].parts()[0], Part::Paragraph("Long lines.".into()));
        let example = codes[0].examples().next().unwrap();
        assert_eq!((example.verb, example.file('+').as_str()), ("run", "x\ny\n"));
        assert_eq!(example.file('-'), "x\nz\n");
    }
}
