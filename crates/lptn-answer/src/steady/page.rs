//! A steady state as a page.

use std::collections::HashSet;
use std::io;

use lptn_network::{ConductorId, FacePathId, GridValue, HeatOf, Item, Network, NodeId};
use lptn_report::{
    Claim, Json, Page, Report, Rows, Text, TextTable, decimals, fixed, prefix, shortened,
    significant,
};
use lptn_solve::SteadyState;
use serde_json::{Map, json};

use crate::about::{self, Known};
use crate::balance;
use crate::limits;
use crate::words::{difference, largest, some_of, symbol};
use crate::{families, proven, ranges};

use super::SteadyAnswer;

/// Rises in K and heats in W below this are rounding.
/// No unit and no decimals are chosen to show them.
const NOISE: f64 = 1e-9;

/// A temperature or heat flow with its value. Names are made for those that are shown.
#[derive(Clone, Copy)]
struct Row {
    of: Of,
    value: f64,
}

#[derive(Clone, Copy)]
enum Of {
    /// A node or boundary.
    Item(Item),
    Grid(GridValue),
    Heat(HeatOf),
}

impl Row {
    /// The name of its column.
    fn column(self, network: &Network) -> String {
        match self.of {
            Of::Item(item) => format!("{}.T", network.name_of(item)),
            Of::Grid(value) => value.name(network),
            Of::Heat(heat) => heat.name(network),
        }
    }

    /// Its name, and the kind that a family must share.
    fn family(self, network: &Network) -> (String, u8) {
        let kind = match self.of {
            Of::Item(Item::Node(_)) => 0,
            Of::Item(_) => 1,
            Of::Grid(_) => 2,
            Of::Heat(HeatOf::Source(_)) => 3,
            Of::Heat(HeatOf::Boundary(_)) => 4,
            Of::Heat(HeatOf::ReceivedFrom(_)) => 5,
            Of::Heat(_) => 6,
        };
        (self.label(network), kind)
    }

    /// Its name without `T`, `Q` and `P`.
    fn label(self, network: &Network) -> String {
        match self.of {
            Of::Item(item) => network.name_of(item).into_owned(),
            Of::Heat(heat) => network.name_of(heat.item()).into_owned(),
            Of::Grid(GridValue::Mean(_) | GridValue::Min(_) | GridValue::Max(_)) => {
                self.column(network)
            }
            Of::Grid(_) => self.column(network).trim_end_matches(".T").to_owned(),
        }
    }

    fn words(self, network: &Network) -> String {
        let name = |end: lptn_network::End| network.name_of(end.into());
        let ends = |id: lptn_network::ConductorId| {
            let conductor = &network.conductors()[id.index()];
            (name(conductor.from), name(conductor.to))
        };
        match self.of {
            Of::Item(Item::Node(id)) if network.nodes()[id.index()].massless => "junction".into(),
            Of::Item(Item::Node(_)) => "node".into(),
            Of::Item(_) => "boundary".into(),
            Of::Grid(GridValue::Mean(_)) => "mean of the grid".into(),
            Of::Grid(GridValue::Min(_)) => "coldest cell".into(),
            Of::Grid(GridValue::Max(_)) => "hottest cell".into(),
            Of::Grid(GridValue::Face(_)) => "mean of the face".into(),
            Of::Grid(GridValue::Patch(_)) => "mean of the patch".into(),
            Of::Heat(HeatOf::FacePath(id)) => {
                let joint = &network.face_paths()[id.index()];
                let [from, to] =
                    [joint.from, joint.to].map(|terminal| network.terminal_name(terminal));
                format!("{from} -> {to}")
            }
            Of::Heat(HeatOf::Conductor(id)) => {
                let (from, to) = ends(id);
                format!("{from} -> {to}")
            }
            Of::Heat(HeatOf::ReceivedFrom(id)) => format!("stream to {}", ends(id).0),
            Of::Heat(HeatOf::ReceivedTo(id)) => format!("stream to {}", ends(id).1),
            Of::Heat(HeatOf::Source(id)) => {
                format!("source into {}", network.heated_places(id).join(", "))
            }
            Of::Heat(HeatOf::Told(_, key)) => key.into(),
            Of::Heat(HeatOf::Boundary(_)) if self.value > 0.0 => "boundary gives".into(),
            Of::Heat(HeatOf::Boundary(_)) => "boundary takes".into(),
        }
    }
}

impl SteadyAnswer {
    fn temperatures(&self, inside: bool) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let ids: Box<dyn Iterator<Item = NodeId>> = if inside {
            Box::new(network.thermal_nodes())
        } else {
            Box::new(network.outer_nodes())
        };
        let row = |item, value| Row { of: Of::Item(item), value };
        let nodes = ids.map(|id| row(Item::Node(id), self.steady.temperatures[id.index()]));
        let idle = network.idle_grid_values().filter(|_| inside);
        let grids = network.grid_values().chain(idle).map(|of| Row {
            of: Of::Grid(of),
            value: network.grid_value(of, &self.steady.temperatures),
        });
        let boundaries = network.boundary_ids().zip(&self.steady.boundary_temperatures);
        let boundaries = boundaries.map(|(id, &value)| row(Item::Boundary(id), value));
        nodes.chain(grids).chain(boundaries).collect()
    }

    /// The heat that the end of a path to a face receives.
    fn through(&self, id: FacePathId) -> f64 {
        let joint = &self.input.netlist.network.face_paths()[id.index()];
        joint.conductors().map(|id| self.steady.received[id.index()][1]).sum()
    }

    fn flows(&self, inside: bool) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let row = |heat: HeatOf, value: f64| Row { of: Of::Heat(heat), value };
        let shown = |id: &ConductorId| inside || network.whole(Item::Conductor(*id)).is_none();
        let paths = network.conductor_ids().filter(shown).flat_map(|id| {
            let [back, on] = self.steady.received[id.index()];
            let heats = network.heats_of(id).into_iter();
            heats.map(move |heat| {
                row(heat, if heat == HeatOf::ReceivedFrom(id) { back } else { on })
            })
        });
        let heat = &self.steady.source_heat;
        let sources = network.heat_sources().map(|id| (id, &heat[id.index()]));
        let boundaries = network.boundary_ids().zip(&self.steady.boundary_heat);
        let sources = sources.map(|(id, &value)| row(HeatOf::Source(id), value));
        let joints =
            network.shared_face_paths().map(|id| row(HeatOf::FacePath(id), self.through(id)));
        let boundaries = boundaries.map(|(id, &value)| row(HeatOf::Boundary(id), value));
        sources.chain(paths).chain(joints).chain(boundaries).collect()
    }

    /// Temperatures with their rise over the coldest boundary, hottest first if there are many.
    fn nodes(&self, rows: Vec<Row>, text: &mut Text) {
        let network = &self.input.netlist.network;
        let coldest = coldest(network, &self.steady).unwrap_or_default();
        let rises = rows.iter().map(|r| (r.value - coldest.1).abs());
        let most = rises.filter(|rise| *rise > NOISE).fold(0.0, f64::max);
        let digits = decimals(most / self.unit.scale, 3, 1);
        let mut rows = families::folded(rows, self.fold, |r| r.family(network), |r| r.value);
        let all = largest(&mut rows, |row| row.item.value);
        let kelvin = |r: &Row| fixed((r.value - coldest.1) / self.unit.scale, digits);
        let celsius = |value: f64| fixed(self.unit.from_si(value), digits);
        let over = format!("over {} [{}]", shortened(&coldest.0, 24), difference(&self.unit));
        let table = TextTable::of(&rows).left("temperature", |row| row.name.as_str());
        let table = families::members(table, &rows, "hottest")
            .right(format!("T [{}]", self.unit.text), |row| row.range(|r| r.value, celsius))
            .right(over, |row| kelvin(&row.item))
            .left("", |row| row.item.words(network))
            .optional();
        some_of(text, table, (all, "the hottest first; --select 'NAME.T' shows others"));
    }

    fn heat_flows(&self, rows: Vec<Row>, text: &mut Text) {
        let network = &self.input.netlist.network;
        let size = |row: &Row| row.value.abs();
        let most = rows.iter().map(size).filter(|heat| *heat > NOISE).fold(0.0, f64::max);
        let mut rows = families::folded(rows, self.fold, |r| r.family(network), size);
        let all = largest(&mut rows, |row| size(&row.item));
        let (scale, letter) = prefix(most);
        let digits = decimals(most / scale, 4, 0);
        let watt = |value: f64| fixed(value / scale, digits);
        let table = TextTable::of(&rows).left("heat flow", |row| row.name.as_str());
        let table = families::members(table, &rows, "largest")
            .right(format!("Q [{letter}W]"), |row| row.range(|r| r.value, watt))
            .left("", |row| row.item.words(network))
            .optional();
        some_of(text, table, (all, "the largest first; --select 'NAME.Q' shows others"));
    }

    /// Signals, controls and reports.
    fn others(&self, text: &mut Text) {
        let network = &self.input.netlist.network;
        let of_item =
            |name: &str| name.rsplit_once('.').is_some_and(|(item, _)| network.item(item).is_ok());
        let shown: Vec<_> = self.table.columns().iter().filter(|c| !of_item(&c.name)).collect();
        let named = |column: &&lptn_solve::Column| (column.name.clone(), 0);
        let value = |column: &&lptn_solve::Column| column.values[0];
        let rows = families::folded(shown, self.fold, named, value);
        let number = |value: f64| match value.is_finite() {
            true => significant(value, 5),
            // a number over time that grows without end
            false => "-".into(),
        };
        if !rows.is_empty() {
            let table = TextTable::of(&rows)
                .left("column", |row| format!("{} [{}]", row.name, symbol(&row.item.unit)));
            let table = families::members(table, &rows, "largest");
            text.section().table(table.right("", |row| row.range(value, number)));
        }
    }

    /// Claims and sections of a report.
    fn report(&self) -> Report {
        let (network, unit) = (&self.input.netlist.network, &self.unit);
        let (imbalance, moved) = (self.steady.imbalance(), self.steady.turned_over());
        let books = match moved > 0.0 {
            true => significant(imbalance.abs() / moved, 2),
            false => "0".into(),
        };
        let laws = about::laws(network, &self.steady.trust.out_of_range);
        let books = format!("heat in and heat out differ by {books} of the heat exchanged");
        let own = [Claim::checked(true, books)].into_iter().chain(laws);
        let claims = own.chain(limits::claims(&self.judgement())).collect();
        let states = vec![("Steady state".to_owned(), self.steady.state.clone())];
        about::about(&self.input, Known { claims, states, unit: Some(unit), ..Known::default() })
    }
}

impl Page for SteadyAnswer {
    fn text(&self) -> Text {
        let network = &self.input.netlist.network;
        let mut text = self.input.begun();
        let kept: HashSet<&str> =
            self.table.columns().iter().map(|column| column.name.as_str()).collect();
        let keep = |row: &Row| self.all || kept.contains(row.column(network).as_str());
        // cells and their paths are shown on request
        let inside = !self.all && !network.grids().is_empty();
        self.nodes(self.temperatures(inside).into_iter().filter(keep).collect(), &mut text);
        self.heat_flows(self.flows(inside).into_iter().filter(keep).collect(), &mut text);
        self.others(&mut text);
        limits::section(&mut text, &self.judgement());
        if let Some(of) = &self.balance {
            balance::section(&mut text, network, (of, None));
        }
        if let Some(Ok(bounds)) = &self.proven {
            text.section().sentence("note: ", &proven::of_steady(bounds));
            for note in proven::verdicts(network, &self.limits) {
                text.section().sentence("note: ", &note);
            }
        }
        for doubt in self.noted() {
            text.section().sentence("note: ", &doubt.message);
        }
        text
    }

    fn rows(&self) -> Rows<'_> {
        (&self.table).into()
    }

    fn more(&self) -> Report {
        self.report()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let netlist = &self.input.netlist;
        let value = |c: &lptn_solve::Column| {
            (c.name.clone(), json!({ "value": c.values[0], "unit": c.unit }))
        };
        self.input.head(json, &[self.noted(), self.beside()].concat())?;
        json.member("values", &self.table.columns().iter().map(value).collect::<Map<_, _>>())?;
        json.optional("limits", limits::members(&netlist.network, &self.limits, &self.unit))?;
        let outside = ranges::members(&netlist.network, &self.steady.trust.out_of_range, false);
        json.optional("out_of_range", outside)?;
        let proven = self.proven.iter().flatten().next();
        let proven =
            proven.map(|bounds| proven::steady_members(&netlist.network, bounds, &self.unit));
        json.optional("proven", proven)?;
        json.optional(
            "balance",
            self.balance.as_ref().map(|of| balance::json(&netlist.network, of)),
        )
    }
}

/// The boundary that rises are measured against; without one the coldest node.
fn coldest(network: &Network, steady: &SteadyState) -> Option<(String, f64)> {
    let coldest = |a: &(Item, f64), b: &(Item, f64)| a.1.total_cmp(&b.1);
    let boundaries = network
        .boundary_ids()
        .map(Item::Boundary)
        .zip(steady.boundary_temperatures.iter().copied());
    let nodes = network.thermal_nodes();
    let nodes = nodes.map(|id| (Item::Node(id), steady.temperatures[id.index()]));
    let (item, temperature) = boundaries.min_by(coldest).or_else(|| nodes.min_by(coldest))?;
    Some((network.name_of(item).into_owned(), temperature))
}
