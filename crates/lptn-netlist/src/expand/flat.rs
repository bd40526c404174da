//! Networks without a flat form: a text that would describe another network is not written.

use lptn_data::Diagnostic;
use lptn_network::{Item, Network};

use crate::netlist::Netlist;

impl Netlist {
    /// The reason why [`Netlist::expanded`] is not this network; `None` if it is. Grids, imported
    /// elements without names, and a start that only a state can describe have no flat form.
    pub fn not_flat(&self) -> Option<Diagnostic> {
        let network = &self.network;
        let (item, words, help) =
            grid(network).or_else(|| unnamed(network)).or_else(|| self.of_state())?;
        let problem =
            Diagnostic::error("netlist::not_flat", format!("{words}, which has no flat form"));
        let problem = problem.help(help);
        Some(problem.at(self.source_map.name(item), ""))
    }

    /// A start that only a state can describe: see `initial` of `[run]`.
    fn of_state(&self) -> Option<Reason> {
        let network = &self.network;
        let held = || {
            let held = self.plan.as_ref()?.settings(network).ok()?.held;
            let mut controls = network.control_ids().zip(held);
            let (id, _) = controls
                .find(|(id, held)| held.is_some_and(|held| held < network.min_dwell(*id)))?;
            let name = network.name_of(Item::Control(id));
            Some((
                Item::Control(id),
                format!(
                    "control `{name}` starts within its \
                `min_dwell`"
                ),
                KEEP,
            ))
        };
        molten(network).or_else(held)
    }
}

const KEEP: &str = "only `initial` of [run] can set this: keep the file as it is";

type Reason = (Item, String, &'static str);

fn grid(network: &Network) -> Option<Reason> {
    let grid = network.grids().first()?;
    let item = network.item(&grid.name).ok()?;
    Some((
        item,
        format!("`{}` is a grid", grid.name),
        "`lptn run` and `lptn check` read the file as it is",
    ))
}

/// Imported elements without names: their names are reserved for rows of imports.
fn unnamed(network: &Network) -> Option<Reason> {
    let conductors = network.conductor_ids().map(Item::Conductor);
    let mut items = conductors.chain(network.source_ids().map(Item::Source));
    let reserved =
        |name: &str| name.starts_with("import.conductor[") || name.starts_with("import.source[");
    let item = items.find(|item| reserved(&network.name_of(*item)))?;
    let words = format!("`{}` has no name", network.name_of(item));
    Some((item, words, "give every row of the CSV file a `name`"))
}

fn molten(network: &Network) -> Option<Reason> {
    let (id, node) = network.node_ids().zip(network.nodes()).find(|(_, node)| node.molten > 0.0)?;
    let words = format!("node `{}` starts partly molten", node.name);
    Some((Item::Node(id), words, KEEP))
}
