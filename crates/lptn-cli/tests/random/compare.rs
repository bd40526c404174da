//! How far apart two results may be, and whether they are.

use std::collections::BTreeMap;

use super::model::{Net, TOLERANCE, base};
use super::relations::{As, Variant};
use super::results::{Results, results};

/// A network with its results and how far its errors may go.
pub struct Case {
    pub seed: u64,
    pub net: Net,
    pub results: Results,
    /// By how much a disturbance of all temperatures grows.
    pub growth: f64,
}

/// The disturbance in K that shows the growth of errors.
const DISTURBANCE: f64 = 1e-3;

/// Networks that make more of an error than this, or switch more often, have no useful bound.
const MOST_GROWTH: f64 = 10.0;
const MOST_SWITCHES: usize = 12;

/// Why a network is left out.
#[derive(Clone, Debug)]
#[allow(dead_code, reason = "what they hold is for messages")]
pub enum LeftOut {
    /// It cannot be run.
    Fails(String),
    /// It has no useful bound.
    NoBound(String),
}

impl Case {
    pub fn new(seed: u64, net: Net) -> Result<Self, LeftOut> {
        let found = results(&net.texts()).map_err(LeftOut::Fails)?;
        let disturbed = results(&super::relations::disturbed(&net, DISTURBANCE).texts());
        let disturbed = disturbed.map_err(LeftOut::NoBound)?;
        let growth = largest(&found, &disturbed) / DISTURBANCE;
        if growth > MOST_GROWTH || found.events.len() > MOST_SWITCHES {
            let switches = found.events.len();
            return Err(LeftOut::NoBound(format!(
                "errors grow {growth:.1} times, {switches} switches"
            )));
        }
        Ok(Self { seed, net, results: found, growth })
    }

    /// How far two temperatures of the same meaning may be apart, in K: ten times the tolerance, as
    /// far as the network does not amplify errors. Every switch adds what an error in its time
    /// does.
    pub fn bound(&self) -> f64 {
        10.0 * TOLERANCE * self.growth.max(1.0) * (1 + self.results.events.len()) as f64
    }

    /// A bound on the change of a column for 1 K, of whatever kind it is.
    fn slope(&self, column: &str) -> f64 {
        let (element, _) = split(column);
        let last = element.rsplit('.').next().unwrap_or(element);
        let own = |name: &str| self.net.entries.iter().find(|entry| entry.name == name);
        let Some(entry) = own(last).or_else(|| own(base(last))) else { return 0.0 };
        if entry.kind() != "boundary" {
            return entry.slope;
        }
        let ends = |path: &&super::model::Entry| {
            [path.end("from"), path.end("to")].iter().flatten().any(|end| base(end) == entry.name)
        };
        self.net.entries.iter().filter(ends).map(|path| path.slope).sum()
    }
}

fn largest(one: &Results, other: &Results) -> f64 {
    let mut most: f64 = 0.0;
    for (name, values) in one.columns.iter().filter(|(name, _)| name.ends_with(".T")) {
        for (a, b) in values.iter().zip(&other.columns[name]) {
            most = most.max((a - b).abs());
        }
    }
    most
}

/// The element of a column, and what of it is meant.
pub fn split(column: &str) -> (&str, &str) {
    const WHAT: [&str; 8] = [".T", ".Q", ".P", ".Q_from", ".Q_to", ".mean", ".min", ".max"];
    let end = WHAT
        .iter()
        .find(|what| column.ends_with(**what))
        .map_or(column.len(), |what| column.len() - what.len());
    column.split_at(end)
}

/// Whether a variant gives what the network gives; else the first difference.
pub fn same(case: &Case, variant: &Variant, found: &Results) -> Result<(), String> {
    let base = &case.results;
    let aligned = base.times.len() == found.times.len();
    let apart = |(a, b): (&f64, &f64)| (a + variant.shift - b).abs() > 1e-9 * (1.0 + b.abs());
    if !aligned || base.times.iter().zip(&found.times).any(apart) {
        return Err(format!("rows at {:?}, and now at {:?}", base.times, found.times));
    }
    for (column, values) in &base.columns {
        columns(case, variant, (column, values), found)?;
    }
    let within = |what: String, a: f64, b: f64, bound: f64| near(&what, (a, b), bound);
    for (name, margin) in &base.margins {
        let renamed = variant.renamed(name);
        let Some(now) = found.margins.get(&renamed) else { continue };
        within(format!("margin of {name}"), *margin, *now, case.bound())?;
    }
    for ((window, column), values) in &base.windows {
        let Some(renamed) = variant.single(column) else { continue };
        let key = (variant.renamed(window), renamed);
        let now = found.windows.get(&key).ok_or_else(|| format!("no window {key:?}"))?;
        for (a, b) in values.iter().zip(now) {
            within(format!("{column} in {window}"), *a, *b, case.bound())?;
        }
    }
    if case.net.linear {
        for (node, value) in &base.steady {
            let Some(renamed) = variant.single(&format!("{node}.T")) else { continue };
            let now = found
                .steady
                .get(split(&renamed).0)
                .ok_or_else(|| format!("{node} is not in the steady state"))?;
            within(format!("steady {node}"), *value, *now, 1e-6)?;
        }
    }
    Ok(())
}

fn columns(
    case: &Case,
    variant: &Variant,
    (column, values): (&str, &[f64]),
    found: &Results,
) -> Result<(), String> {
    let get = |name: &str| {
        found.columns.get(name).ok_or_else(|| format!("no column {name} for {column}"))
    };
    match variant.columns(column) {
        As::Nothing => Ok(()),
        As::Each(names) => names
            .iter()
            .try_for_each(|name| rows(case, variant, (column, values), (get(name)?, found))),
        As::Sum(names) => {
            let mut sum = vec![0.0; values.len()];
            for name in &names {
                sum.iter_mut().zip(get(name)?).for_each(|(sum, value)| *sum += value);
            }
            rows(case, variant, (column, values), (&sum, found))
        }
    }
}

fn rows(
    case: &Case,
    variant: &Variant,
    (column, before): (&str, &[f64]),
    (now, found): (&[f64], &Results),
) -> Result<(), String> {
    let (_, what) = split(column);
    let temperature = matches!(what, ".T" | ".mean" | ".min" | ".max");
    let slope = case.slope(column);
    for (i, (a, b)) in before.iter().zip(now).enumerate() {
        let time = case.results.times[i];
        let count =
            |events: &[f64], shift: f64| events.iter().filter(|at| **at - shift <= time).count();
        let switched = count(&case.results.events, 0.0) != count(&found.events, variant.shift);
        if a.is_nan() && b.is_nan() || !temperature && switched {
            continue; // between the moments at which one and the other switch
        }
        let bound = match (variant.exact, temperature) {
            (true, _) => 0.0,
            (false, true) => case.bound(),
            (false, false) => 2.0 * slope * case.bound() + 1e-9 * (1.0 + a.abs()),
        };
        near(&format!("{column} at {time} s"), (*a, *b), bound)?;
    }
    Ok(())
}

fn near(what: &str, (before, now): (f64, f64), bound: f64) -> Result<(), String> {
    if before.to_bits() == now.to_bits() || (before - now).abs() <= bound {
        return Ok(());
    }
    let apart = (before - now).abs();
    Err(format!(
        "{what} was {before} and is {now}: {apart:.2e} apart, where {bound:.1e} is allowed"
    ))
}

/// How many networks hold each feature.
pub fn coverage(cases: &[Case]) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for feature in cases.iter().flat_map(|case| &case.net.features) {
        *counts.entry(*feature).or_default() += 1;
    }
    counts
}
