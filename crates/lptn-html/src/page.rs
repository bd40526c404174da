//! The page: head, claims, sections.

use lptn_plot::svg::{self, escaped};
use lptn_report::{Piece, Report, Section, Standing};

use crate::{chart, policy, style, text};

/// The charts, from uPlot by Leon Sorokin (MIT licence, `assets/uPlot.LICENSE`).
pub(crate) const UPLOT: &str = include_str!("../assets/uPlot.iife.min.js");

/// Script of this page, which uses the charts.
pub(crate) const SCRIPT: &str = include_str!("../assets/page.js");

/// Writes a report as one HTML file.
pub fn write(report: &Report) -> String {
    let mut out = head(&report.title);
    out += &format!("<header><h1>{}</h1>{BUTTON}</header>\n", escaped(&report.title));
    claims(&mut out, report);
    report.sections.iter().for_each(|part| section(&mut out, part));
    out += &format!("<script>{UPLOT}</script>\n<script>{SCRIPT}</script>\n</body>\n</html>\n");
    out
}

/// Smallest scale at which a drawing is shown to fit the page.
const SMALLEST: f64 = 0.8;

const BUTTON: &str = "<button id=\"theme\" type=\"button\" hidden>light or dark</button>";

fn head(title: &str) -> String {
    let (title, style, policy) = (escaped(title), style::sheet(), policy::content());
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
    )
}

fn claims(out: &mut String, report: &Report) {
    if report.claims.is_empty() {
        return;
    }
    *out += "<ul class=\"claims\">\n";
    for claim in &report.claims {
        let class = text::class_of(claim.standing);
        let sign = match claim.standing {
            Standing::Holds => "\u{2713}",
            Standing::Open => "\u{b7}",
            Standing::Fails => "\u{2717}",
        };
        let text = escaped(&claim.text);
        *out += &format!("<li class=\"{class}\"><b>{sign}</b> {text}</li>\n");
    }
    *out += "</ul>\n";
}

fn section(out: &mut String, section: &Section) {
    let title = escaped(&section.title);
    match (section.folded, title.is_empty()) {
        (true, _) => *out += &format!("<details>\n<summary>{title}</summary>\n"),
        (false, true) => *out += "<section>\n",
        (false, false) => *out += &format!("<section>\n<h2>{title}</h2>\n"),
    }
    section.pieces.iter().for_each(|part| piece(out, part));
    *out += if section.folded { "</details>\n" } else { "</section>\n" };
}

fn piece(out: &mut String, piece: &Piece) {
    match piece {
        Piece::Text(of) => text::write(out, of),
        Piece::Figure(figure) => chart::write(out, figure),
        Piece::Drawing(scene, caption) => {
            let (drawing, caption) = (svg::write(scene), escaped(caption));
            // on a narrow screen it scrolls: smaller, it would be illegible
            let least = (SMALLEST * scene.size.0).round();
            *out += "<figure class=\"drawing\">\n<div>";
            *out += &drawing.replacen("<svg ", &format!("<svg style=\"min-width:{least}px\" "), 1);
            *out += "</div>\n";
            *out += &format!("<figcaption>{caption}</figcaption>\n</figure>\n");
        }
        Piece::Verbatim(lines) => text::verbatim(out, lines),
    }
}
