//! Curves: a picture of them, and their values for the script.

use lptn_plot::chart::{far, ink, is_far, ranges, scene};
use lptn_plot::figure::{Axis, Curve, Look, Panel, Scale};
use lptn_plot::svg;
use lptn_plot::{Figure, SERIES, printed};
use serde_json::{Value, json};

use crate::script;
use crate::text::coded;

/// Width of a picture in CSS pixels, and of a small one, of which two are side by side in print.
const WIDTH: f64 = 760.0;
const SMALL_WIDTH: f64 = 460.0;

/// Writes a figure. Its curves can be zoomed if no axis has names, all lines go to the right, and
/// no point has a tooltip, which only the picture shows.
pub(crate) fn write(out: &mut String, figure: &Figure) {
    let picture = picture(figure);
    *out += "<figure class=\"chart\">\n";
    if !figure.title.is_empty() {
        *out += &format!("<h2>{}</h2>\n", coded(&figure.title));
    }
    if let Some(values) = zoomable(figure) {
        let values = script::json(&values);
        *out += &format!("<script type=\"application/json\">{values}</script>\n");
        *out += "<div class=\"live\"></div>\n";
    }
    *out += &format!("<div class=\"still\">{picture}</div>\n");
    for note in figure.note.lines() {
        *out += &format!("<figcaption>{}</figcaption>\n", coded(note));
    }
    *out += "</figure>\n";
}

/// The picture of its panels.
pub(crate) fn picture(figure: &Figure) -> String {
    let still = Figure { title: String::new(), note: String::new(), panels: figure.panels.clone() };
    let width = if figure.is_small() { SMALL_WIDTH } else { WIDTH };
    svg::write(&scene(&[still], width))
}

/// The values of a figure whose curves can be zoomed.
pub(crate) fn zoomable(figure: &Figure) -> Option<Value> {
    figure.panels.iter().all(is_zoomable).then(|| values(figure))
}

/// True if both axes have values, all lines go to the right, and there are no tooltips.
fn is_zoomable(panel: &Panel) -> bool {
    let has_names = |axis: &Axis| matches!(axis.scale, Scale::Names(_));
    !has_names(&panel.x)
        && !has_names(&panel.y)
        && panel.curves.iter().all(|curve| curve.tips.is_empty())
        && panel.curves.iter().all(|curve| is_cloud(curve) || is_sorted(curve))
}

fn is_cloud(curve: &Curve) -> bool {
    matches!(curve.look, Look::Dots | Look::Stems)
}

fn is_sorted(curve: &Curve) -> bool {
    curve.points.is_sorted_by(|a, b| a.0 <= b.0)
}

/// The figure as data for the script. Curves with the same x values share one list of them.
fn values(figure: &Figure) -> Value {
    let mut places: Vec<Vec<f64>> = Vec::new();
    let panels: Vec<Value> =
        figure.panels.iter().map(|panel| of_panel(figure, panel, &mut places)).collect();
    json!({"panels": panels, "places": places})
}

fn of_panel(figure: &Figure, panel: &Panel, places: &mut Vec<Vec<f64>>) -> Value {
    let [across, upward] = ranges(figure, panel);
    let curves = panel.curves.iter().enumerate();
    let curves: Vec<Value> = curves.map(|(i, curve)| of_curve((curve, i), panel, places)).collect();
    let limits = panel.limits.iter().map(|limit| json!({"name": limit.name, "at": limit.value}));
    let moments = panel.moments.iter().map(|moment| json!({"name": moment.name, "at": moment.at}));
    json!({
        "x": axis(&panel.x, across),
        "y": axis(&panel.y, upward),
        "share": panel.share,
        "curves": curves,
        "limits": limits.collect::<Vec<_>>(),
        "moments": moments.collect::<Vec<_>>(),
        "beyond": far(panel),
    })
}

fn axis(axis: &Axis, (low, high): (f64, f64)) -> Value {
    let scale = match axis.scale {
        Scale::Linear | Scale::Names(_) => "linear",
        Scale::Log => "log",
        Scale::Time => "time",
    };
    let unit = if matches!(axis.unit.as_str(), "1" | "-") { "" } else { &axis.unit };
    json!({"name": axis.name, "unit": printed(unit), "scale": scale, "range": [low, high]})
}

/// A curve as data. It is interrupted at values that are not finite, which JSON has as `null`.
/// Points that the x axis cannot show are left out.
fn of_curve((curve, at): (&Curve, usize), panel: &Panel, places: &mut Vec<Vec<f64>>) -> Value {
    let across = &panel.x;
    let mut order: Vec<usize> =
        (0..curve.points.len()).filter(|&i| across.scale.shows(curve.points[i].0)).collect();
    order.sort_by(|&a, &b| curve.points[a].0.total_cmp(&curve.points[b].0));
    let x: Vec<f64> = order.iter().map(|&i| curve.points[i].0).collect();
    let place = places.iter().position(|known| *known == x).unwrap_or_else(|| {
        places.push(x);
        places.len() - 1
    });
    let look = ["line", "dashed", "dots", "stems", "bars"][curve.look as usize];
    let mut value = json!({
        "name": curve.name,
        "look": look,
        "ink": ink(curve, at).key(),
        "again": curve.place.unwrap_or(at) >= SERIES,
        "x": place,
        "y": order.iter().map(|&i| curve.points[i].1).collect::<Vec<f64>>(),
    });
    if is_far(panel, curve) {
        value["far"] = true.into();
    }
    if !curve.spread.is_empty() {
        value["low"] = order.iter().map(|&i| curve.spread[i].0).collect();
        value["high"] = order.iter().map(|&i| curve.spread[i].1).collect();
    }
    value
}
