//! The linear network near a state, compared with the full one.

use std::io;
use std::sync::Arc;

use lptn_netlist::Diagnostic;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, duration, shortened, significant,
};
use lptn_solve::{Disturbance, DisturbanceShape, NearError, NearState, Table};
use lptn_study::SiValue;
use serde_json::json;

use super::{NODE_WIDTH, NOTHING, with_units};
use crate::about::{self, Known};
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::operating_point::{OperatingPoint, place, without_slopes};
use crate::words::count;

/// A failure at the place that keeps the state from being disturbed.
fn failed(input: &Input, error: &NearError) -> Failure {
    let place = match error {
        NearError::Linearised(error) => place(input, error),
        NearError::Input(error) => input.place_of(error),
        _ => None,
    };
    input.failure(error, place)
}

/// A linear network near a state, and its comparison.
#[derive(Debug)]
pub(super) struct NearAnswer {
    pub(super) input: Arc<Input>,
    point: OperatingPoint,
    near: NearState,
}

impl NearAnswer {
    /// Compares the linear network near the state that a text names.
    pub(super) fn of(
        text: &str,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<Self, Failure> {
        let point = OperatingPoint::find(text, &input, listener)?;
        let system = input.assemble()?;
        let netlist = &input.netlist;
        listener.warn(&netlist.files, &[netlist.warnings.as_slice(), &point.doubts].concat());
        let near = NearState::of(&system, &point.state).map_err(|error| failed(&input, &error))?;
        Ok(Self { input, point, near })
    }

    /// Doubts in the state.
    pub(super) fn doubts_of_state(&self) -> &[Diagnostic] {
        &self.point.doubts
    }

    fn node(&self, disturbance: &Disturbance) -> &str {
        &self.input.netlist.network.nodes()[disturbance.difference.node.index()].name
    }

    fn disturbances(&self) -> TextTable {
        TextTable::of(&self.near.disturbances)
            .left("disturbance", |d| format!("{} {}", shape(d), kelvin(d.size)))
            .right("difference [K]", |d| significant(d.difference.largest, 2))
            .right("share", |d| format!("{} %", significant(100.0 * d.share(), 2)))
            .right("after", |d| duration(d.difference.time, 3))
            .left("of node", |d| shortened(self.node(d), NODE_WIDTH))
            .into()
    }

    fn reference(&self) -> String {
        let NearState { modes, span, .. } = &self.near;
        let (modes, span) = (count(*modes, "mode"), duration(*span, 3));
        format!(
            "exact solution of the linear network near {}, {modes}, over {span}",
            self.point.name()
        )
    }

    /// Why no linear network describes the state, if none does.
    fn fails(&self) -> Option<String> {
        self.near.tried.and_then(without_slopes)
    }

    fn verdict(&self) -> String {
        let share = |share: f64| format!("{} %", significant(100.0 * share, 2));
        let Some(first) = self.near.disturbances.first() else { return NOTHING.into() };
        if let Some(failing) = self.near.failing() {
            let (share, size) = (share(failing.share()), kelvin(failing.size));
            return format!("not verified: the error is {share} even for a disturbance of {size}");
        }
        if let Some(why) = self.fails() {
            return format!("not verified: heat flows {why}");
        }
        if self.near.is_linear() {
            return "verified: every node is within the allowed error of runs".into();
        }
        let largest = self.near.disturbances.iter().filter(|d| d.size >= first.size);
        let missed = share(largest.map(Disturbance::share).fold(0.0, f64::max));
        let size = kelvin(first.size);
        format!(
            "verified: the error is {missed} for a disturbance of {size}, less for smaller \
            ones"
        )
    }

    fn passes(&self) -> bool {
        let shrinks = self.near.failing().is_none() && self.fails().is_none();
        !self.near.disturbances.is_empty() && shrinks
    }

    fn table(&self) -> Table {
        let mut table = Table::of(&self.near.disturbances);
        table.label("shape", |d| word(d.shape).to_owned());
        table.column("size", "K", |d| d.size);
        table.column("difference", "K", |d| d.difference.largest);
        table.column("allowed", "K", |d| d.allowed);
        table.column("time", "s", |d| d.difference.time);
        for (i, node) in self.input.netlist.network.nodes().iter().enumerate() {
            table.column(format!("{}.difference", node.name), "K", |d| d.difference.by_node[i]);
        }
        table.done()
    }
}

impl Page for NearAnswer {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        text.section().table(self.disturbances());
        text.section().labelled("compared with: ", with_units(&self.reference()));
        text.notes(self.point.notes(self.near.tried));
        let standing = if self.passes() { Standing::Holds } else { Standing::Fails };
        text.marked(standing, self.verdict());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.table().into()
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        self.input.head(json, &self.point.doubts)?;
        json.table(&self.table())?;
        json.member("at", &self.point.json(self.near.tried))?;
        json.member(
            "reference",
            &json!({
                "independent": true,
                "modes": self.near.modes,
                "span": SiValue::new(self.near.span, "s"),
                "text": self.reference(),
            }),
        )?;
        json.member("passes", &self.passes())
    }

    fn no(&self) -> Option<String> {
        (!self.passes()).then(|| self.verdict())
    }
}

fn kelvin(size: f64) -> String {
    format!("{} K", significant(size, 3))
}

fn word(shape: DisturbanceShape) -> &'static str {
    match shape {
        DisturbanceShape::Even => "even",
        DisturbanceShape::InTurn => "in turn",
    }
}

/// Words before the size by which nodes are warmer or colder at first.
fn shape(disturbance: &Disturbance) -> &'static str {
    match disturbance.shape {
        DisturbanceShape::Even => "all by",
        DisturbanceShape::InTurn => "in turn by +/-",
    }
}
