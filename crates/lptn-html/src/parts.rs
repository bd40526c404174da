//! Parts of a page that a live page writes again.

use lptn_plot::Figure;
use lptn_report::{Piece, Report};
use serde_json::{Value, json};

use crate::text::coded;
use crate::{chart, page};

/// Heading of the results.
const RESULTS: &str = "Results";

/// The list of claims.
pub fn claims(report: &Report) -> String {
    let mut out = String::new();
    page::claims(&mut out, report);
    out
}

/// The figures in their order: the values of charts that can be zoomed, the picture, the notes
/// as HTML.
pub fn figures(report: &Report) -> Vec<Value> {
    let pieces = report.sections.iter().flat_map(|section| &section.pieces);
    let one = |figure: &Figure| {
        json!({
            "values": chart::zoomable(figure),
            "picture": chart::picture(figure),
            "notes": figure.note.lines().map(coded).collect::<Vec<_>>(),
        })
    };
    let of =
        |piece: &Piece| if let Piece::Figure(figure) = piece { Some(one(figure)) } else { None };
    pieces.filter_map(of).collect()
}

/// The texts and tables of the results.
pub fn results(report: &Report) -> String {
    let mut out = String::new();
    let results = report.sections.iter().filter(|section| section.title == RESULTS);
    results.flat_map(|section| &section.pieces).for_each(|piece| page::piece(&mut out, piece));
    out
}
