//! Kept nodes as a page.

use std::io;

use lptn_reduce::Deviation;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, decimals, duration, fixed, significant,
};
use lptn_solve::Table;
use serde_json::{Value, json};

use super::keep::KeptAnswer;
use super::page::error_json;
use crate::about::{self, Known};
use crate::scale;
use crate::words::count;

/// Most conductances that are shown.
const MOST_LINKS: usize = 12;

/// A node of the reduced network.
struct Row<'a> {
    name: &'a str,
    asked: bool,
    capacity: f64,
    run: Option<Deviation>,
    /// Error and rise over every load in K.
    load: Option<(f64, f64)>,
}

impl Page for KeptAnswer {
    fn text(&self) -> Text {
        let mut text = Text::new();
        let standing = if self.holds() { Standing::Holds } else { Standing::Fails };
        text.section().marked(standing, self.verdict());
        text.append(self.input.begun());
        text.section().table(self.nodes());
        text.section().table(self.links());
        text.section().notes(self.notes());
        text
    }

    fn rows(&self) -> Rows<'_> {
        let all = self.all();
        let mut table = Table::of(&all);
        table.label("node", |row| row.name.to_owned());
        table.label("asked", |row| if row.asked { "yes" } else { "no" }.to_owned());
        table.column("C", "J/K", |row| row.capacity);
        let of_run = |row: &Row<'_>, of: &dyn Fn(&Deviation) -> Option<f64>| {
            row.run.as_ref().and_then(of).unwrap_or(f64::NAN)
        };
        table.column("run.max", "K", |row| of_run(row, &|run| Some(run.kelvin)));
        table.column("run.relative", "-", |row| of_run(row, &|run| run.relative));
        table.column("run.time", "s", |row| of_run(row, &|run| Some(run.time)));
        table.column("run.signed", "K", |row| of_run(row, &|run| Some(run.signed)));
        table.column("run.good_from", "s", |row| of_run(row, &|run| run.good_from));
        table.column("any_load.max", "K", |row| row.load.map_or(f64::NAN, |load| load.0));
        scale::table(table.done(), &self.unit).into()
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let si = |value: f64, unit: &str| json!({ "value": value, "unit": unit });
        self.input.head(json, &[])?;
        json.member("keep", &self.names)?;
        let verdict = json!({
            "text": self.verdict(),
            "holds": self.holds(),
            "limit": self.limit.text,
            "judged_by": if self.judges_run() { "run" } else { "any_load" },
        });
        json.member("verdict", &verdict)?;
        json.member("power", &si(self.power, "W"))?;
        let node = |row: &Row<'_>| {
            let load = row.load.map(
                |(error, rise)| json!({ "max": scale::of_difference(error, &self.unit), "relative": si(error / rise, "1") }),
            );
            json!({
                "name": row.name,
                "asked": row.asked,
                "C": si(row.capacity, "J/K"),
                "run": row.run.as_ref().map(|run| error_json(run, &self.unit)),
                "any_load": load,
            })
        };
        let nodes: Vec<Value> = self.all().iter().map(node).collect();
        json.member("nodes", &nodes)?;
        let link = |(from, to, g): (String, String, f64)| json!({ "from": from, "to": to, "G": si(g, "W/K") });
        let links: Vec<Value> = self.conductances().into_iter().map(link).collect();
        json.member("conductances", &links)?;
        json.member("projected", &self.projected_json())?;
        json.member("moments_missed", &si(self.kept.moments, "1"))?;
        json.member("notes", &self.notes())
    }
}

impl KeptAnswer {
    fn all(&self) -> Vec<Row<'_>> {
        let network = &self.input.netlist.network;
        let row = |(k, node): (usize, &lptn_network::NodeId)| Row {
            name: &network.nodes()[node.index()].name,
            asked: k < self.kept.asked,
            capacity: self.kept.capacity[k],
            run: self.errors.run.as_ref().and_then(|run| run.get(k)).map(|(error, _)| *error),
            load: self.errors.loads.get(k).map(|(e, r)| (e * self.power, r * self.power)),
        };
        self.kept.nodes.iter().enumerate().map(row).collect()
    }

    fn nodes(&self) -> TextTable {
        let rows = self.all();
        let largest = rows.iter().map(|row| row.capacity).fold(0.0, f64::max);
        let digits = decimals(largest, 5, 0);
        let none = || "-".to_owned();
        let share = |share: Option<f64>| share.map_or_else(none, |s| fixed(100.0 * s, 3));
        let table = TextTable::of(&rows)
            .left("node", |row| row.name)
            .right("C [J/K]", |row| fixed(row.capacity, digits));
        let table = if self.errors.run.is_some() {
            table
                .right("run [K]", |row| row.run.map_or_else(none, |run| significant(run.signed, 3)))
                .right("[%]", |row| share(row.run.and_then(|run| run.relative)))
                .left("at", |row| row.run.map_or_else(String::new, |run| duration(run.time, 3)))
        } else {
            table
        };
        table
            .right("any load [K]", |row| row.load.map_or_else(none, |load| significant(load.0, 3)))
            .right("[%]", |row| share(row.load.map(|load| load.0 / load.1)))
            .left("", |row| if row.asked { "" } else { "chosen" })
            .into()
    }

    /// The modes that replace the network as well, at the requested nodes.
    fn projected_json(&self) -> Value {
        let network = &self.input.netlist.network;
        let asked = &self.kept.nodes[..self.kept.asked];
        let modes = self.projected.tau.iter().zip(&self.projected.shapes);
        let mode = |(tau, shape): (&f64, &Vec<f64>)| {
            let at = |node: &lptn_network::NodeId| {
                (network.nodes()[node.index()].name.clone(), json!(shape[node.index()]))
            };
            let shape: serde_json::Map<String, Value> = asked.iter().map(at).collect();
            json!({ "tau": { "value": tau, "unit": "s" }, "shape": shape })
        };
        let loads = self.names.iter().zip(&self.projected.errors.loads);
        let load = |(name, (error, _)): (&String, &(f64, f64))| {
            (name.clone(), json!(scale::of_difference(error * self.power, &self.unit)))
        };
        json!({
            "modes": modes.map(mode).collect::<Vec<Value>>(),
            "any_load": loads.map(load).collect::<serde_json::Map<String, Value>>(),
        })
    }

    /// Names and conductances between nodes, then to boundaries, in W/K.
    fn conductances(&self) -> Vec<(String, String, f64)> {
        let network = &self.input.netlist.network;
        let name = |k: usize| network.nodes()[self.kept.nodes[k].index()].name.clone();
        let links = self.kept.links.iter().map(|&(i, j, g)| (name(i), name(j), g));
        let mut all: Vec<(String, String, f64)> = links.collect();
        for (k, grounds) in self.kept.grounds.iter().enumerate() {
            let real = network.boundaries().iter().zip(grounds).filter(|(_, g)| **g > 0.0);
            all.extend(real.map(|(boundary, g)| (name(k), boundary.name.clone(), *g)));
        }
        all
    }

    fn links(&self) -> TextTable {
        let mut all = self.conductances();
        all.sort_by(|a, b| b.2.total_cmp(&a.2));
        all.truncate(MOST_LINKS);
        TextTable::of(&all)
            .left("between", |row| &row.0)
            .left("and", |row| &row.1)
            .right("G [W/K]", |row| significant(row.2, 5))
            .into()
    }

    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = vec![format!(
            "any load: all powers between 0 and {} W into each of the kept nodes at once",
            significant(self.power, 4)
        )];
        let worst = self.projected.errors.share();
        notes.push(format!(
            "{} that do not form a network (`--format json`: projected) would be {} % wrong over \
             every load",
            count(self.projected.tau.len(), "mode"),
            significant(100.0 * worst, 2)
        ));
        let links = self.conductances().len();
        if links > MOST_LINKS {
            let all = count(links, "conductance");
            notes.push(format!("the {MOST_LINKS} largest of {all} are shown"));
        }
        if self.question.nodes.is_some_and(|nodes| nodes > self.kept.count()) {
            notes.push(format!(
                "the kept nodes see {} with capacity: there are no more",
                count(self.kept.count(), "node")
            ));
        }
        if self.kept.moments > 1e-9 {
            notes.push(format!(
                "the first moments at the kept nodes are off by {} %, which makes the error over \
                 every load smaller",
                significant(100.0 * self.kept.moments, 2)
            ));
        }
        if self.errors.run.is_none() {
            notes.push("no run is compared: there is none, or something switches in it".to_owned());
        }
        notes
    }
}
