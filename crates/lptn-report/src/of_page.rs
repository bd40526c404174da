//! A page as a report.

use crate::page::Page;
use crate::report::{Claim, Piece, Report, Section};
use crate::text::{Block, Text};

/// A page as a report, with all that it adds for one.
pub fn report_of(page: &dyn Page) -> Report {
    let (title, text) = titled(&page.text());
    let mut report = Report { title, ..page.more() };
    report.claims.extend(page.no().map(|no| Claim::checked(false, no)));
    let mut own: Vec<Section> = Vec::new();
    for mut figure in page.figures().into_iter().filter(|figure| !figure.panels.is_empty()) {
        if figure.title == report.title {
            figure.title = String::new();
        }
        own.push(Section::of("", Piece::Figure(figure)));
    }
    own.push(Section::of("Results", Piece::Text(text)));
    report.sections.splice(0..0, own);
    report
}
/// The title of a text, and the text without it.
fn titled(text: &Text) -> (String, Text) {
    let mut title = String::new();
    let mut rest = Text::new();
    for section in text.sections() {
        rest.section();
        for block in section {
            match block {
                Block::Title(own) if title.is_empty() => title.clone_from(own),
                block => drop(rest.add(block.clone())),
            }
        }
    }
    (title, rest)
}
