//! Prior knowledge of the parameters, in words.

use lptn_network::Network;
use lptn_report::{fixed, significant};
use lptn_study::uncertainty::{Uncertain, Uncertainty};
use lptn_units::Distribution;

use super::files::parameter;
use crate::words::count;

/// Pairs of correlated parameters that are named.
const MOST_PAIRS: usize = 6;

/// A parameter that is not normal and has this share of a variance rules the shape of the result.
const RULES: f64 = 0.5;

/// "11 parameters with ±".
pub(super) fn counted(found: &Uncertainty) -> String {
    let parameters = count(found.inputs.len(), "parameter");
    if found.inputs.are_correlated() {
        format!("{parameters} with ±, correlated")
    } else {
        format!("{parameters} with ±")
    }
}

/// The parameters that are not normal, and those that are correlated most.
pub(super) fn described(network: &Network, found: &Uncertainty) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    for (label, distribution) in
        [("rectangle: ", Distribution::Rectangle), ("lognormal: ", Distribution::Lognormal)]
    {
        let names: Vec<String> = (0..found.inputs.len())
            .filter(|&i| found.inputs[i].spread.distribution == distribution)
            .map(|i| parameter(network, found, i))
            .collect();
        if !names.is_empty() {
            lines.push((label, names.join(", ")));
        }
    }
    if found.inputs.are_correlated() {
        lines.push(("correlation: ", pairs(network, found)));
    }
    lines
}

/// The pairs that are correlated most, the closest first.
fn pairs(network: &Network, found: &Uncertainty) -> String {
    let n = found.inputs.len();
    let between = |(i, j): (usize, usize)| found.inputs.correlations().between(i, j);
    let mut all: Vec<(usize, usize)> = (0..n)
        .flat_map(|i| (0..i).map(move |j| (j, i)))
        .filter(|&pair| between(pair).abs() > 0.0)
        .collect();
    all.sort_by(|&a, &b| between(b).abs().total_cmp(&between(a).abs()));
    let text = |&(i, j): &(usize, usize)| {
        let (a, b) = (parameter(network, found, i), parameter(network, found, j));
        format!("{a} with {b} {}", fixed(between((i, j)), 2))
    };
    let mut texts: Vec<String> = all.iter().take(MOST_PAIRS).map(text).collect();
    if all.len() > MOST_PAIRS {
        texts.push(count(all.len() - MOST_PAIRS, "more pair"));
    }
    texts.join(", ")
}

/// The standard deviation of a parameter: in percent, in K for a temperature.
pub(super) fn deviation(network: &Network, found: &Uncertainty, input: usize) -> String {
    let input = &found.inputs[input];
    let ty = network.parameters()[input.parameter.index()].ty;
    if ty.absolute {
        return format!("{} K", significant(input.deviation(), 3));
    }
    if input.value == 0.0 {
        return format!("{} {}", significant(input.deviation(), 3), ty.dimension.si_unit());
    }
    format!("{} %", significant(100.0 * (input.deviation() / input.value).abs(), 2))
}

/// Note on shares of correlated parameters.
pub(super) fn shares(found: &Uncertainty) -> Option<String> {
    found.inputs.are_correlated().then(|| {
        "parameters are correlated, so no share of the variance belongs to one alone: a share is \
         the effect times the covariance with the result and may be negative; the shares add up to \
         the variance of the linear model; Sobol indices are not defined"
            .to_owned()
    })
}

/// Parameters that are not normal and make most of a result.
/// Straight lines take the band of that result to be normal.
pub(super) fn far_from_normal(network: &Network, found: &Uncertainty) -> Option<String> {
    let shaped = |input: &Uncertain| input.spread.distribution == Distribution::Rectangle;
    let rules = |i: usize| {
        let mut parts = found.answers.iter().flat_map(|answer| &answer.ranking);
        parts.any(|part| part.input == i && part.share.value >= RULES)
    };
    let mut all = 0..found.inputs.len();
    let name = parameter(network, found, all.find(|&i| shaped(&found.inputs[i]) && rules(i))?);
    Some(format!(
        "`{name}` is uniform and dominates a result, whose band is computed as normal: it is up to \
         a fifth too wide, see --uncertainty sobol"
    ))
}
