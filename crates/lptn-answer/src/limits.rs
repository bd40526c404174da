//! Limits as a result: a line each, JSON, and the verdict on them.

use lptn_analysis::LimitResult;
use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Bound, Item, Limit, LimitId, LimitSeverity, Network};
use lptn_plot::figure::{Curve, Level, Panel};
use lptn_plot::printed;
use lptn_report::{
    Claim, Clock, Standing, TEMPERATURE, Text, TextTable, column_names, duration, rounded_up,
    significant,
};
use lptn_study::SiValue;
use lptn_units::{Dimension, Type, Unit};
use serde_json::{Map, Value, json};

use crate::families::{self, Row};
use crate::scale;
use crate::words::{count, spaced};

/// Digits of a margin.
const DIGITS: usize = 4;

/// The node whose temperature breaks its limit.
pub fn broken_node<'a>(found: &LimitResult, network: &'a Network) -> Option<&'a str> {
    let limit = &network.limits()[found.limit.index()];
    let node = limit.text.strip_suffix(".T")?;
    let known = network.nodes().iter().any(|own| own.name == node);
    (found.broken_at.is_some() && known).then_some(node)
}

/// Its name, and properties that a family must share:
/// judged or not, severity, side of the bound, and kind of quantity.
fn family(found: &LimitResult, limit: &Limit) -> (String, u8) {
    let bits = [
        found.is_open(),
        limit.severity == LimitSeverity::Error,
        limit.bound == Bound::Below,
        limit.ty.absolute,
    ];
    (limit.name.clone(), bits.iter().fold(0, |kind, bit| 2 * kind + u8::from(*bit)))
}

fn standing(found: &LimitResult) -> Standing {
    match (found.is_open(), found.is_broken()) {
        (true, _) => Standing::Open,
        (false, true) => Standing::Fails,
        (false, false) => Standing::Holds,
    }
}

/// All limits of a netlist with their results.
#[derive(Clone, Copy, Debug)]
pub struct Judgement<'a> {
    /// The netlist.
    pub netlist: &'a Netlist,
    /// The unit of temperatures.
    pub unit: &'a Unit,
    /// The unit of times.
    pub clock: Clock,
    /// The results, in the order of the network.
    pub limits: &'a [LimitResult],
    /// True if large families are shown as their worst member.
    pub fold: bool,
}

impl<'a> Judgement<'a> {
    fn of(&self, judged: &LimitResult) -> &'a Limit {
        &self.netlist.network.limits()[judged.limit.index()]
    }

    fn rows(&self) -> Vec<Row<LimitResult>> {
        let named = |judged: &LimitResult| family(judged, self.of(judged));
        families::folded(self.limits.to_vec(), self.fold, named, |judged| -judged.margin)
    }

    /// Broken limits: of a large family the worst one, and how many others are broken.
    fn broken(&self) -> Vec<(LimitResult, String)> {
        let others = |row: &Row<LimitResult>| match row
            .others
            .iter()
            .filter(|judged| judged.is_broken())
            .count()
        {
            0 => String::new(),
            n => format!(", and {n} more of {}", row.name),
        };
        let rows = self.rows().into_iter().filter(|row| row.item.is_broken());
        rows.map(|row| (row.item, others(&row))).collect()
    }
}

/// A section with a line for each limit, or for each large family.
/// Nothing without limits.
pub fn section(text: &mut Text, judgement: &Judgement<'_>) {
    let Judgement { netlist: Netlist { network, .. }, unit, clock, limits, .. } = *judgement;
    if limits.is_empty() {
        return;
    }
    let of = |judged: &LimitResult| judgement.of(judged);
    let rows = judgement.rows();
    let table = TextTable::of(&rows).left("limit", |row| row.name.as_str());
    let mut table = families::members(table, &rows, "worst")
        .left("wanted", |row| of(&row.item).text.as_str())
        .names()
        .left("", |row| bounded(network, row.item.limit, unit))
        .right("margin", |row| margin(&row.item, of(&row.item), unit));
    if limits.iter().any(|judged| judged.worst_at.is_some()) {
        let time = |row: &Row<LimitResult>| row.item.worst_at.map(|time| clock.text(time, 3));
        let time = move |row: &Row<LimitResult>| time(row).unwrap_or_else(|| "-".into());
        table = table.right("least at", time).spare();
    }
    if limits.iter().any(|judged| judged.proven.is_some()) {
        let bound = |judged: &LimitResult| proven_error(judged, of(judged), unit);
        table = table.right("proven error", move |row| bound(&row.item));
    }
    let table = table.left("", |row| verdict(&row.item, of(&row.item), clock));
    text.section().table(table.judged(|row| standing(&row.item)));
}

/// "steel.T below 110 degC".
fn wanted(network: &Network, id: LimitId, unit: &Unit) -> String {
    format!("{} {}", network.limits()[id.index()].text, bounded(network, id, unit))
}

/// "below 110 degC".
fn bounded(network: &Network, id: LimitId, unit: &Unit) -> String {
    let limit = &network.limits()[id.index()];
    let bound = number(bound(network, limit), limit.ty, unit);
    format!("{} {bound}", limit.bound.field().key())
}

/// Marks the limits in the panels of their quantities: temperatures, and columns by name.
/// Returns the number of limits without such a panel.
pub fn mark(panels: &mut [Panel], network: &Network, unit: &Unit, fold: bool) -> usize {
    let mut left_out = 0;
    // limits of one family with one bound are one line
    let named = |id: &LimitId| {
        let name = &network.limits()[id.index()].name;
        (format!("{name} {}", bounded(network, *id, unit)), 0)
    };
    for row in families::folded(network.limit_ids().collect(), fold, named, |_| 0.0) {
        let id = row.item;
        let limit = &network.limits()[id.index()];
        let value = bound(network, limit);
        let of_temperatures = limit.ty.absolute && limit.ty.dimension == Dimension::TEMPERATURE;
        let value = if of_temperatures { unit.from_si(value) } else { value };
        let name = if row.others.is_empty() { wanted(network, id, unit) } else { row.name };
        let level = Level { name: printed(&name), value };
        let is_own = |curve: &Curve| column_names(curve).any(|name| name == limit.text);
        let own = panels.iter().position(|panel| panel.curves.iter().any(is_own));
        let of_kind = || panels.iter().position(|panel| panel.y.name == TEMPERATURE);
        let at = if of_temperatures { own.or_else(of_kind) } else { own };
        match at {
            Some(at) => panels[at].limits.push(level),
            None => left_out += 1,
        }
    }
    left_out
}

/// Broken limits with their excess and its time: rows may miss it.
pub fn broken(judgement: &Judgement<'_>) -> Vec<String> {
    let said = |(judged, others): (LimitResult, String)| {
        let limit = judgement.of(&judged);
        let by = number(-judged.margin, limit.margin_type(), judgement.unit);
        let at = judged.worst_at.map_or(String::new(), |time| format!(" at {}", duration(time, 3)));
        format!("{} broken by {by}{at}{others}", limit.name)
    };
    judgement.broken().into_iter().map(said).collect()
}

/// Claims for a report on broken, kept and unjudged limits.
pub fn claims(judgement: &Judgement<'_>) -> Vec<Claim> {
    let limits = judgement.limits;
    let open = limits.iter().filter(|judged| judged.is_open()).count();
    let kept = limits.iter().filter(|judged| !judged.is_open() && !judged.is_broken()).count();
    let broken = broken(judgement);
    let told = |n: usize, what: &str| format!("{} {what}", count(n, "limit"));
    let mut claims: Vec<Claim> =
        broken.into_iter().map(|broken| Claim::checked(false, broken)).collect();
    claims.extend((kept > 0).then(|| Claim::checked(true, told(kept, "kept"))));
    claims.extend((open > 0).then(|| Claim::open(told(open, "not judged"))));
    claims
}

/// The bound of a limit, in SI units.
fn bound(network: &Network, limit: &Limit) -> f64 {
    // it is constant and was evaluated when the network was built
    limit.value.at(&mut network.evaluation()).unwrap_or(f64::NAN)
}

fn margin(judged: &LimitResult, limit: &Limit, unit: &Unit) -> String {
    if judged.is_open() { "-".into() } else { number(judged.margin, limit.margin_type(), unit) }
}

/// A bound on the error of the margin.
fn proven_error(judged: &LimitResult, limit: &Limit, unit: &Unit) -> String {
    let Some(bound) = judged.margin_bound() else { return "-".into() };
    let (value, unit) = scale::in_unit(bound, limit.margin_type(), unit);
    format!("{}{}", rounded_up(value), spaced(&unit))
}

/// " ± 0.02 s": the time at which a limit is broken lies between proven times.
fn proven_time(judged: &LimitResult) -> String {
    let bound = judged.time_bound().map(|bound| format!(" \u{b1} {} s", rounded_up(bound)));
    bound.unwrap_or_default()
}

fn verdict(judged: &LimitResult, limit: &Limit, clock: Clock) -> String {
    if judged.is_open() {
        return "not judged".into();
    }
    let within = proven_time(judged);
    match (judged.is_broken(), judged.broken_at, limit.severity) {
        (false, ..) => "kept".into(),
        (true, Some(time), LimitSeverity::Error) => {
            format!("BROKEN from {}{within}", clock.text(time, 4))
        }
        (true, Some(time), LimitSeverity::Warning) => {
            format!("exceeded from {}{within}", clock.text(time, 4))
        }
        (true, None, LimitSeverity::Error) => "BROKEN".into(),
        (true, None, LimitSeverity::Warning) => "exceeded".into(),
    }
}

/// A number in the unit that is shown for its type.
fn number(value: f64, ty: Type, unit: &Unit) -> String {
    let (value, unit) = scale::in_unit(value, ty, unit);
    format!("{}{}", significant(value, DIGITS), spaced(&unit))
}

/// Members by the limit's name:
/// `{ of, below or above, worst, margin, worst_at, broken_at, severity, kept }`, temperatures in
/// `unit`; with proven bounds `margin_bound`, `broken_between` and `is_proven` too. `worst` is the value of `of` at the least margin. If a limit is not judged, `worst`,
/// `margin` and `kept` are null. Nothing without limits.
pub fn members(
    network: &Network,
    limits: &[LimitResult],
    unit: &Unit,
) -> Option<Map<String, Value>> {
    let one = |judged: &LimitResult| {
        let limit = &network.limits()[judged.limit.index()];
        let time = |time: Option<f64>| time.map(|time| SiValue::new(time, "s"));
        let scalar =
            |value: f64, ty: Type| (!value.is_nan()).then(|| scale::scalar(value, ty, unit));
        let bound = bound(network, limit);
        let worst = match limit.bound {
            Bound::Below => bound - judged.margin,
            Bound::Above => bound + judged.margin,
        };
        let mut member = json!({
            "of": limit.text,
            limit.bound.field().key(): scalar(bound, limit.ty),
            "worst": scalar(worst, limit.ty),
            "margin": scalar(judged.margin, limit.margin_type()),
            "worst_at": time(judged.worst_at),
            "broken_at": time(judged.broken_at),
            "severity": if limit.severity == LimitSeverity::Error { "error" } else { "warning" },
            "kept": (!judged.is_open()).then_some(!judged.is_broken()),
        });
        if let Some(proven) = &judged.proven {
            let bound = judged.margin_bound().and_then(|bound| scalar(bound, limit.margin_type()));
            let times = proven.broken.map(|at| time(Some(at).filter(|at| at.is_finite())));
            member["margin_bound"] = json!(bound);
            member["broken_between"] = json!(times);
            member["is_proven"] = json!(judged.is_proven());
        }
        (limit.name.clone(), member)
    };
    (!limits.is_empty()).then(|| limits.iter().map(one).collect())
}

/// The verdict on limits.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Broken limits of severity warning, of a large family the worst.
    pub warnings: Vec<Diagnostic>,
    /// A sentence for each broken limit of severity error, of a large family for the worst.
    pub broken: Vec<String>,
}

impl Verdict {
    /// The verdict on all limits.
    pub fn of(judgement: &Judgement<'_>) -> Self {
        let mut verdict = Self::default();
        for (found, others) in judgement.broken() {
            let words = words(judgement, &found) + &others;
            match judgement.of(&found).severity {
                LimitSeverity::Warning => verdict.warnings.push(warning(judgement, &found, words)),
                LimitSeverity::Error => verdict.broken.push(format!("limit broken: {words}")),
            }
        }
        verdict
    }

    /// True if every limit of severity error that was judged is kept.
    pub fn holds(&self) -> bool {
        self.broken.is_empty()
    }
}

fn warning(judgement: &Judgement<'_>, judged: &LimitResult, words: String) -> Diagnostic {
    let item = Item::Limit(judged.limit);
    let place = judgement.netlist.source_map.name(item);
    Diagnostic::warning("limit::exceeded", words).at(place, "")
}

/// "`hot` (steel.T below 110 degC) by 3.2 K at 25 min, first after 12.05 min".
fn words(judgement: &Judgement<'_>, judged: &LimitResult) -> String {
    let Judgement { netlist: Netlist { network, .. }, unit, clock, .. } = judgement;
    let limit = &network.limits()[judged.limit.index()];
    let by = number(-judged.margin, limit.margin_type(), unit);
    let mut text = format!("`{}` ({}) by {by}", limit.name, wanted(network, judged.limit, unit));
    match judged.worst_at {
        Some(time) => text += &format!(" at {}", clock.text(time, 4)),
        None => text += " in steady state",
    }
    if let Some(time) = judged.broken_at {
        text += &format!(", first at {}", clock.text(time, 4));
    }
    text
}
