//! A run as a picture: its columns over time, with limits, events and uncertainty.

use std::collections::BTreeMap;

use lptn_graph::series;
use lptn_network::{End, Item, Network};
use lptn_plot::figure::{Curve, Day, Moment, Panel};
use lptn_plot::{Figure, SERIES};
use lptn_report::{MOST_CURVES, TEMPERATURE, column_names, panels, proven_caption};
use lptn_solve::{ColumnDays, DaySeen, Event};

use super::answer::RunAnswer;
use super::uncertainty::figure::{InputBand, inputs};
use crate::limits;
use crate::words::count;

/// More events than this would hide the curves.
pub const MOST_EVENTS: usize = 24;

impl RunAnswer {
    /// The selected columns over time; large families are bands if tables have them in one row.
    pub fn figure(&self) -> Figure {
        self.drawn(self.folds())
    }

    /// The same; `families` is true if large families are bands.
    pub fn drawn(&self, families: bool) -> Figure {
        let (network, unit) = (self.solution.network(), &self.task.unit);
        // the bands of uncertain results are of single curves
        let fold = families && self.uncertainty().is_none();
        let table = self.table.clone().with_jumps(&self.solution, &self.task.selection, unit);
        let (mut panels, left_out) = panels(&table, fold);
        self.know_days(&mut panels);
        panels.iter_mut().for_each(|panel| self.spread(panel));
        if self.uncertainty().is_some() {
            panels = panels.into_iter().flat_map(facets).collect();
        }
        let undrawn = limits::mark(&mut panels, network, unit, families);
        let moments = moments(network, self.solution.events());
        for panel in &mut panels {
            panel.moments.clone_from(&moments);
            inked(panel, network);
        }
        let title = self.task.input.title();
        Figure { title, note: self.note((left_out, undrawn), moments.is_empty()), panels }
    }

    /// Note on parts that are not shown.
    fn note(&self, (left_out, undrawn): (usize, usize), no_moments: bool) -> String {
        let mut notes = Vec::new();
        if left_out > 0 {
            notes.push(format!(
                "the {MOST_CURVES} highest curves of {}; --select chooses others",
                left_out + MOST_CURVES
            ));
        }
        if undrawn > 0 {
            notes.push(format!("{} of no curve that is shown", count(undrawn, "limit")));
        }
        let events = self.solution.events().len();
        if no_moments && events > 0 {
            notes.push(format!("{events} events, which are not marked"));
        }
        let drawn = self.solution.knows_jumps();
        if events > self.table.rows() && !drawn {
            notes.push("more happens between rows than they show: --every writes more".into());
        } else if self.task.picture && !drawn {
            notes.push(
                "too many jumps and bends to draw: straight between rows; --from and --to show all of \
                 a part"
                    .into(),
            );
        }
        notes.extend(limits::broken(&self.judgement(&self.limits())));
        notes.extend(self.ended_early());
        if self.uncertainty().is_some() {
            notes.push("bands of 95 %".into());
        } else {
            notes.extend(proven_caption(&self.table));
        }
        notes.join("; ")
    }

    /// Gives the curves the days that the solver saw.
    fn know_days(&self, panels: &mut [Panel]) {
        let columns =
            ColumnDays::of(&self.solution, &self.task.selection, &self.task.unit).into_iter();
        let day = |day: &DaySeen| {
            let DaySeen { from, to, mean, low, high } = *day;
            Day { from, to, mean, range: (low, high) }
        };
        let columns: BTreeMap<String, Vec<Day>> =
            columns.map(|of| (of.name, of.days.iter().map(day).collect())).collect();
        for curve in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
            let days = column_names(curve).find_map(|name| columns.get(&name));
            curve.days = days.cloned().unwrap_or_default();
        }
    }

    /// Draws bands around inputs and temperatures, if they are known.
    fn spread(&self, panel: &mut Panel) {
        let Some(study) = self.uncertainty() else { return };
        let network = self.solution.network();
        let inputs = inputs(network, &study.found);
        self.spread_inputs(panel, &study.found.times, &inputs);
        if panel.y.name != TEMPERATURE {
            return;
        }
        let shown = |kelvin: &f64| self.task.unit.from_si(*kelvin);
        for curve in &mut panel.curves {
            let of = |node: usize| network.nodes()[node].name == curve.name;
            let bands = study.found.bands.iter().find(|bands| of(bands.node.index()));
            let Some(bands) = bands else { continue };
            let times = study.found.times.iter().copied();
            let points = times.zip(bands.value.iter().map(shown)).collect();
            let sides = bands.low.iter().map(shown).zip(bands.high.iter().map(shown));
            *curve = Curve::line(&curve.name, points).within(sides.collect());
        }
    }
}

impl RunAnswer {
    /// Draws bands around the boundaries of a panel of temperatures, and around given heats.
    fn spread_inputs(&self, panel: &mut Panel, times: &[f64], inputs: &[InputBand]) {
        let of_temperatures = panel.y.name == TEMPERATURE;
        let unit = &self.task.unit;
        let shown = |si: f64| if of_temperatures { unit.from_si(si) } else { si };
        let is_heat = |band: &InputBand| band.name.ends_with(".P");
        for curve in &mut panel.curves {
            let of =
                |band: &&InputBand| band.name == curve.name && is_heat(band) != of_temperatures;
            let Some(band) = inputs.iter().find(of) else { continue };
            let points = times.iter().copied().zip(band.value.iter().map(|si| shown(*si)));
            let sides = band.value.iter().zip(&band.half);
            let sides = sides.map(|(si, half)| (shown(si - half), shown(si + half))).collect();
            *curve = Curve::line(&curve.name, points.collect()).within(sides);
        }
    }
}

/// Most bands of one panel if they cover each other.
const TOLD_APART: usize = 2;

/// Height of the panel of one of several bands.
const FACET: f64 = 0.5;

/// A panel of temperatures with bands that cover each other as a small one for each band, and one
/// for the lines; else the panel as it is.
fn facets(panel: Panel) -> Vec<Panel> {
    let (bands, lines): (Vec<Curve>, Vec<Curve>) =
        panel.curves.iter().cloned().partition(|curve| !curve.spread.is_empty());
    let covered = |(i, band): (usize, &Curve)| bands[..i].iter().any(|other| cover(band, other));
    let hidden = bands.iter().enumerate().any(covered);
    if panel.y.name != TEMPERATURE || bands.len() <= TOLD_APART || !hidden {
        return vec![panel];
    }
    let bands = bands.into_iter().map(|band| vec![band]);
    let all = bands.chain([lines]).filter(|curves| !curves.is_empty());
    all.map(|curves| Panel { curves, share: FACET, small: true, ..panel.clone() }).collect()
}

/// True if two bands overlap in half of their points.
fn cover(one: &Curve, other: &Curve) -> bool {
    let pairs = one.spread.iter().zip(&other.spread);
    let over = pairs.filter(|(a, b)| a.0 <= b.1 && b.0 <= a.1).count();
    2 * over >= one.spread.len().min(other.spread.len())
}

/// Gives the curves of temperatures the inks that their nodes and boundaries have in every picture.
fn inked(panel: &mut Panel, network: &Network) {
    if panel.y.name != TEMPERATURE {
        return;
    }
    let ends = network.nodes().len() + network.boundaries().len();
    for (i, curve) in panel.curves.iter_mut().enumerate() {
        // curves that lie upon each other are one, with both names
        let first = curve.name.split(", ").next().unwrap_or_default();
        curve.place = match network.item(first) {
            Ok(Item::Node(id)) => series(network, End::Node(id)),
            Ok(Item::Boundary(id)) => series(network, End::Boundary(id)),
            _ if ends <= 2 * SERIES => Some(ends + i),
            _ => None,
        };
    }
}

/// Switches and broken limits, unless there are more than [`MOST_EVENTS`].
fn moments(network: &Network, events: &[Event]) -> Vec<Moment> {
    if events.len() > MOST_EVENTS {
        return Vec::new();
    }
    let moment = |event: &Event| {
        let what = what(event.kind.word(), event.after != 0);
        Moment { name: format!("{} {what}", event.kind.name(network)), at: event.time }
    };
    events.iter().map(moment).collect()
}

/// Word for the effect of an event of this kind.
pub fn what(kind: &str, after: bool) -> &'static str {
    match (kind, after) {
        ("limit", _) => "broken",
        ("control", true) => "on",
        ("control", false) => "off",
        (_, true) => "holds",
        (_, false) => "becomes false",
    }
}
