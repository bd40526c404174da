//! A page as a report.

use lptn_plot::Figure;

use crate::page::Page;
use crate::report::{Claim, Piece, Report, Section};
use crate::text::{Block, Text};

/// A page as a report, with all that it adds for one.
pub fn report_of(page: &dyn Page) -> Report {
    let mut more = page.more();
    more.claims.extend(page.no().map(|no| Claim::checked(false, no)));
    with_results(&page.text(), page.figures(), more)
}

/// A report with the figures and the text of a page before its own sections. Months are shown by
/// days.
pub fn with_results(text: &Text, figures: Vec<Figure>, report: Report) -> Report {
    let (title, text) = titled(text);
    let mut report = Report { title, ..report };
    let text = report.results.take().unwrap_or(text);
    let mut own: Vec<Section> = std::mem::take(&mut report.answer);
    for figure in figures.into_iter().filter(|figure| !figure.panels.is_empty()) {
        let mut figure = figure.legible().light();
        if figure.title == report.title {
            figure.title = String::new();
        }
        add(&mut own, figure);
    }
    own.push(Section::of("Results", Piece::Text(text)));
    report.sections.splice(0..0, own);
    report
}

/// Adds a figure as a section; small ones are together.
fn add(own: &mut Vec<Section>, figure: Figure) {
    match own.last_mut().filter(|last| figure.is_small() && last.is_of_small()) {
        Some(last) => last.pieces.push(Piece::Figure(figure)),
        None => own.push(Section::of("", Piece::Figure(figure))),
    }
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
