//! The page: head, claims, sections.

use lptn_plot::Scene;
use lptn_plot::svg::{self, escaped};
use lptn_report::{Piece, Report, Section, Standing};

use crate::live::{self, Live};
use crate::{chart, policy, style, text};

/// The charts, from uPlot by Leon Sorokin (MIT licence, `assets/uPlot.LICENSE`).
pub(crate) const UPLOT: &str = include_str!("../assets/uPlot.iife.min.js");

/// Script of this page, which uses the charts.
pub(crate) const SCRIPT: &str = include_str!("../assets/page.js");

/// Writes a report as one HTML file.
pub fn write(report: &Report) -> String {
    whole(report, None)
}

/// Writes a report as one HTML file that solves its netlist again.
pub fn write_live(report: &Report, live: &Live<'_>) -> String {
    whole(report, Some(live))
}

/// The file, with the additions of a live page.
fn whole(report: &Report, live: Option<&Live<'_>>) -> String {
    let mut out = head(&report.title, live.is_some());
    out += &format!("<header><h1>{}</h1>{BUTTON}</header>\n", text::coded(&report.title));
    claims(&mut out, report);
    out += live.map_or("", |_| live::PANEL);
    report.sections.iter().for_each(|part| section(&mut out, part));
    out += &live.map(live::data).unwrap_or_default();
    out += &format!("<script>{UPLOT}</script>\n<script>{SCRIPT}</script>\n");
    out += &live.map(|_| format!("<script>{}</script>\n", live::SCRIPT)).unwrap_or_default();
    out + "</body>\n</html>\n"
}

/// Smallest scale at which a drawing is shown to fit the page.
const SMALLEST: f64 = 0.8;

const BUTTON: &str = "<button id=\"theme\" type=\"button\" hidden>light or dark</button>";

fn head(title: &str, live: bool) -> String {
    let (title, style, policy) = (escaped(title), style::sheet(), policy::content(live));
    let style = if live { style + live::STYLE } else { style };
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
    )
}

pub(crate) fn claims(out: &mut String, report: &Report) {
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
        let text = text::coded(&claim.text);
        *out += &format!("<li class=\"{class}\"><b>{sign}</b> {text}</li>\n");
    }
    *out += "</ul>\n";
}

fn section(out: &mut String, section: &Section) {
    let title = text::coded(&section.title);
    match (section.folded, title.is_empty()) {
        (true, _) => *out += &format!("<details>\n<summary>{title}</summary>\n"),
        (false, true) if section.is_of_small() => *out += "<section class=\"many\">\n",
        (false, true) => *out += "<section>\n",
        (false, false) => *out += &format!("<section>\n<h2>{title}</h2>\n"),
    }
    section.pieces.iter().for_each(|part| piece(out, part));
    *out += if section.folded { "</details>\n" } else { "</section>\n" };
}

pub(crate) fn piece(out: &mut String, piece: &Piece) {
    match piece {
        Piece::Text(of) => text::write(out, of),
        Piece::Figure(figure) => chart::write(out, figure),
        Piece::Drawing(scene, caption) => {
            *out += &format!("<figure class=\"drawing\">\n<div>{}</div>\n", drawing(scene));
            *out += &format!("<figcaption>{}</figcaption>\n</figure>\n", text::coded(caption));
        }
        Piece::Frames(frames) => moving(out, frames),
        Piece::Verbatim(lines) => text::verbatim(out, lines),
    }
}

/// A drawing that scrolls on a narrow screen: smaller, it would be illegible.
fn drawing(scene: &Scene) -> String {
    let least = (SMALLEST * scene.size.0).round();
    svg::write(scene).replacen("<svg ", &format!("<svg style=\"min-width:{least}px\" "), 1)
}

/// Drawings with a slider over their times. Without scripts the last one is shown.
fn moving(out: &mut String, frames: &[(String, Scene)]) {
    let last = frames.len().saturating_sub(1);
    *out += "<figure class=\"drawing frames\">\n";
    if last > 0 {
        *out += &format!(
            "<label class=\"slider\" hidden>time <input type=\"range\" min=\"0\" max=\"{last}\" \
             value=\"{last}\"> <output></output></label>\n"
        );
    }
    for (i, (time, scene)) in frames.iter().enumerate() {
        let hidden = if i < last { " hidden" } else { "" };
        let time = escaped(time);
        *out += &format!("<div data-time=\"{time}\"{hidden}>{}</div>\n", drawing(scene));
    }
    *out += "</figure>\n";
}
