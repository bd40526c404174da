//! Uncertain results as pictures: causes of the margins of limits, and the bands of inputs.

use lptn_network::{Item, Network, Value};
use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_study::uncertainty::{Answer, AnswerOf, Uncertainty};
use lptn_units::Unit;
use lptn_units::statistics::NORMAL_95;

use super::files::{parameter, unit_of};
use super::inputs::deviation;

/// Most answers that have a panel: the margins that are most likely to be negative.
const MOST: usize = 3;

/// Most parameters of a panel.
const MOST_BARS: usize = 10;

/// A parameter with less of the variance has no bar.
const LEAST_SHARE: f64 = 0.0005;

/// A panel for each margin of a limit, else for each temperature at the end: a row for each
/// parameter, with bars from the value to that with one standard deviation less and more.
pub(crate) fn tornado((network, unit): (&Network, &Unit), found: &Uncertainty) -> Option<Figure> {
    let is_margin = |answer: &&Answer| matches!(answer.of, AnswerOf::Margin(_));
    let mut chosen: Vec<&Answer> = found.answers.iter().filter(is_margin).collect();
    let margins = !chosen.is_empty();
    if !margins {
        let is_end = |answer: &&Answer| matches!(answer.of, AnswerOf::End(_));
        chosen = found.answers.iter().filter(is_end).collect();
    }
    chosen.retain(|answer| answer.deviation.value > 0.0);
    chosen.sort_by(|a, b| (a.value / a.deviation.value).total_cmp(&(b.value / b.deviation.value)));
    if !margins {
        chosen.reverse();
    }
    let panels: Vec<Panel> =
        chosen.into_iter().take(MOST).map(|answer| panel((network, unit), found, answer)).collect();
    let note = "bars: one standard deviation less and more of one parameter, the others fixed";
    (!panels.is_empty()).then(|| Figure {
        title: if margins { "Margins of limits" } else { "Temperatures at the end" }.to_owned(),
        note: note.to_owned(),
        panels,
    })
}

fn panel((network, unit): (&Network, &Unit), found: &Uncertainty, answer: &Answer) -> Panel {
    let shown = answer.ranking.iter().filter(|part| part.weight().abs() >= LEAST_SHARE);
    let shown: Vec<_> = shown.take(MOST_BARS).collect();
    let name = |input: usize| {
        format!("{} \u{b1} {}", parameter(network, found, input), deviation(network, found, input))
    };
    let names = shown.iter().map(|part| name(part.input)).collect();
    let (of, zero) = match answer.of {
        AnswerOf::Margin(_) => (answer.of.name(network), 0.0),
        _ => (format!("{} less its value", answer.of.name(network)), answer.value),
    };
    let by = unit_of((network, unit), answer.of);
    let mut panel = Panel::new(Axis::linear(of, &by.text), Axis::names("", names));
    for (name, sign) in [("less", -1.0), ("more", 1.0)] {
        let ends = shown.iter().map(|part| by.from_si(answer.value - zero + sign * part.effect));
        let ends: Vec<f64> = ends.collect();
        let points = ends.iter().copied().zip((0..).map(f64::from)).collect();
        let value = by.from_si(answer.value - zero);
        let spread = ends.iter().map(|end| (end.min(value), end.max(value))).collect();
        panel.curves.push(Curve::line(name, points).within(spread).looks(Look::Bars));
    }
    if matches!(answer.of, AnswerOf::Margin(_)) {
        panel.moments.push(Moment { name: "limit".into(), at: 0.0 });
    }
    panel.moments.push(Moment { name: "value".into(), at: by.from_si(answer.value - zero) });
    panel
}

/// The band of an input: the values with every parameter at its own and half the width of 95 %.
pub(crate) struct InputBand {
    /// The name of the column that it belongs to.
    pub(crate) name: String,
    /// In K, or in W.
    pub(crate) value: Vec<f64>,
    pub(crate) half: Vec<f64>,
}

/// The bands of temperatures of boundaries and of given heats, to first order; none for those that
/// no parameter moves.
pub(crate) fn inputs(network: &Network, found: &Uncertainty) -> Vec<InputBand> {
    let boundaries = network.boundary_ids().map(|id| {
        let boundary = &network.boundaries()[id.index()];
        (boundary.name.clone(), &boundary.temperature)
    });
    let fixed = |value: &Value| {
        let slots = || network.parameter_ids().map(|id| network.parameter_slot(id));
        value.slots().iter().all(|slot| slots().any(|known| known == *slot))
    };
    let sources = network.heat_sources().filter_map(|id| {
        let power = network.sources()[id.index()].power().filter(|power| fixed(power))?;
        Some((format!("{}.P", network.name_of(Item::Source(id))), power))
    });
    let all: Vec<(String, &Value)> = boundaries.chain(sources).collect();
    let moved: Option<Vec<Network>> = (0..found.inputs.len())
        .map(|i| {
            let input = &found.inputs[i];
            let mut parameters = network.overrides();
            parameters.set(input.parameter, input.value + input.deviation());
            network.with(&parameters).ok()
        })
        .collect();
    let Some(moved) = moved else { return Vec::new() };
    let band = |(name, value): (String, &Value)| band(network, (found, &moved), (name, value));
    all.into_iter().filter_map(band).collect()
}

fn band(
    network: &Network,
    (found, moved): (&Uncertainty, &[Network]),
    (name, value): (String, &Value),
) -> Option<InputBand> {
    let at = |network: &Network, time: f64| {
        let mut scope = network.evaluation();
        scope.set_time(time, time);
        value.at(&mut scope).ok()
    };
    let (mut values, mut half) = (Vec::new(), Vec::new());
    for &time in &found.times {
        let own = at(network, time)?;
        let changes: Option<Vec<f64>> =
            moved.iter().map(|moved| Some(at(moved, time)? - own)).collect();
        let changes = changes?;
        let variance = |i: usize| -> f64 {
            let with =
                |j: usize| if i == j { 1.0 } else { found.inputs.correlations().between(i, j) };
            (0..changes.len()).map(|j| changes[i] * changes[j] * with(j)).sum()
        };
        let variance: f64 = (0..changes.len()).map(variance).sum();
        values.push(own);
        half.push(NORMAL_95 * variance.max(0.0).sqrt());
    }
    half.iter().any(|half| *half > 0.0).then_some(InputBand { name, value: values, half })
}
