//! Biot numbers, diffusion times, and skipped checks of nodes, in words.

use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Field, Item, Network, NodeId};
use lptn_report::{Text, TextTable, duration, significant};
use lptn_solve::{Biot, LumpCheck, Lumping, NotChecked, Stretch};
use lptn_study::SiValue;
use serde_json::{Map, Value, json};

use crate::words::count;

/// Amount of detail in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// The answer, for scripts and logs.
    Brief,
    /// Also the skipped checks, for people at a terminal.
    Usual,
    /// Everything that is known.
    Verbose,
}

/// Most nodes with separate warnings, the worst of them.
const MOST_WARNINGS: usize = 5;

const SOURCE: &str =
    "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, section 5.2";

/// A warning for each of the worst nodes that are not lumps, and one that counts the others.
pub fn warnings(netlist: &Netlist, lumping: &Lumping) -> Vec<Diagnostic> {
    let (thick, slow) = (lumping.too_thick(), lumping.too_slow());
    let mut found: Vec<Diagnostic> = Vec::new();
    found.extend(
        thick.iter().take(MOST_WARNINGS).map(|(check, biot)| too_thick(netlist, check, biot)),
    );
    found.extend(more("lumping::biot", thick.len(), "Biot numbers above 0.1"));
    let each = slow.iter().take(MOST_WARNINGS);
    found.extend(each.map(|(check, time, stretch)| too_slow(netlist, check, (*time, *stretch))));
    found.extend(more("lumping::diffusion_time", slow.len(), "diffusion times that are not short"));
    found
}

fn more(code: &'static str, all: usize, what: &str) -> Option<Diagnostic> {
    let more = all.checked_sub(MOST_WARNINGS).filter(|more| *more > 0)?;
    let message = format!("{} more with {what}", count(more, "node"));
    Some(Diagnostic::warning(code, message).help("-v lists all of them"))
}

fn too_thick(netlist: &Netlist, check: &LumpCheck, biot: &Biot) -> Diagnostic {
    let name = &netlist.network.nodes()[check.node.index()].name;
    let message = format!(
        "node `{name}` is not a lump: its Biot number is {}, above 0.1",
        significant(biot.number, 3)
    );
    let numbers = format!(
        "Bi = h L_char / k with h = {} W/(m^2 K) at {}, k = {} W/(m K); below 0.1 the error of one \
         temperature is small ({SOURCE})",
        significant(biot.coefficient, 3),
        duration(biot.time, 3),
        significant(biot.conductivity, 3)
    );
    at(netlist, check, Diagnostic::warning("lumping::biot", message)).note(numbers)
}

fn too_slow(netlist: &Netlist, check: &LumpCheck, (time, stretch): (f64, Stretch)) -> Diagnostic {
    let name = &netlist.network.nodes()[check.node.index()].name;
    let message = format!(
        "inside node `{name}` heat takes {} to spread, more than a tenth of the {} between two \
         changes",
        duration(time, 3),
        duration(stretch.to - stretch.from, 3)
    );
    let numbers = format!(
        "L_char^2 / alpha; from {} to {} no source and no boundary jumps, and for about this time \
         after a jump one temperature does not describe the body",
        duration(stretch.from, 4),
        duration(stretch.to, 4)
    );
    at(netlist, check, Diagnostic::warning("lumping::diffusion_time", message)).note(numbers)
}

fn at(netlist: &Netlist, check: &LumpCheck, warning: Diagnostic) -> Diagnostic {
    let map = &netlist.source_map;
    let item = Item::Node(check.node);
    let place = map.get(item, Field::CharacteristicLength).or_else(|| map.name(item));
    warning
        .at(place, "")
        .help("make it several nodes with [conduction] between them; L_char is volume over surface")
}

/// Adds a few lines below a result: the largest numbers and the skipped checks.
/// If nothing was checked, [`Detail::Brief`] adds none.
pub fn lines(
    text: &mut Text,
    network: &Network,
    (lumping, label, detail): (&Lumping, &str, Detail),
) {
    let name = |id: NodeId| &network.nodes()[id.index()].name;
    let mut pieces = Vec::new();
    let biots =
        lumping.checks.iter().filter_map(|check| Some((check.node, check.biot.ok()?.number)));
    let times = lumping.checks.iter().filter_map(|check| Some((check.node, check.diffusion.ok()?)));
    if let Some((node, number)) = biots.max_by(|a, b| a.1.total_cmp(&b.1)) {
        pieces.push(format!("Bi up to {} ({}),", significant(number, 2), name(node)));
    }
    if let Some((node, time)) = times.max_by(|a, b| a.1.total_cmp(&b.1)) {
        pieces.push(format!("L^2/alpha up to {} ({}),", duration(time, 2), name(node)));
    }
    if detail > Detail::Brief || !pieces.is_empty() {
        pieces.extend(not_checked(lumping));
    }
    if let Some(last) = pieces.last_mut().filter(|last| last.ends_with(',')) {
        last.pop();
    }
    if pieces.is_empty() {
        return;
    }
    text.labelled(label, pieces);
    if detail == Detail::Verbose {
        details(text, network, lumping);
    }
}

/// Number of nodes that were not checked, by reason.
fn not_checked(lumping: &Lumping) -> Vec<String> {
    let mut reasons: Vec<(String, usize)> =
        vec![("no L_char".into(), lumping.without_length.len())];
    let mut found: Vec<NotChecked> =
        lumping.checks.iter().filter_map(|check| check.biot.err()).collect();
    found.sort_unstable();
    for reason in found {
        let words = told(reason).0.to_owned();
        match reasons.iter_mut().find(|(known, _)| *known == words) {
            Some((_, count)) => *count += 1,
            None => reasons.push((words, 1)),
        }
    }
    reasons.retain(|(_, count)| *count > 0);
    let pieces = reasons.iter().enumerate().map(|(i, (words, nodes))| {
        let start = if i == 0 { "not checked: " } else { "" };
        format!("{start}{} ({words}),", count(*nodes, "node"))
    });
    pieces.collect()
}

/// Why a node was not checked: for reading, and for programs.
fn told(reason: NotChecked) -> (&'static str, &'static str) {
    match reason {
        NotChecked::NoMaterial => ("no material", "no_material"),
        NotChecked::SeveralMaterials => ("several materials", "several_materials"),
        NotChecked::NoConductivity => ("material without k", "no_conductivity"),
        NotChecked::NoHeatCapacity => ("material without density or cp", "no_heat_capacity"),
        NotChecked::NoSurface => ("no surface with h", "no_surface"),
        NotChecked::NoArea(_) => ("surface without area", "no_area"),
        NotChecked::NoValue => ("h has no value", "no_value"),
    }
}

/// More nodes than this are counted.
const MOST_SHOWN: usize = 12;

/// The number of nodes shown then: the worst, or the first.
const SHOWN: usize = 5;

/// The checks to show in the order of the file, or those with the largest Biot numbers.
fn worst(checks: &[LumpCheck]) -> Vec<&LumpCheck> {
    let mut shown: Vec<&LumpCheck> = checks.iter().collect();
    if shown.len() > MOST_SHOWN {
        let number = |check: &LumpCheck| check.biot.map_or(f64::NEG_INFINITY, |biot| biot.number);
        shown.sort_by(|a, b| number(b).total_cmp(&number(a)));
        shown.truncate(SHOWN);
    }
    shown
}

/// Names, or the first of many and how many more there are.
fn few(mut names: Vec<String>) -> Vec<String> {
    let count = names.len();
    if count > MOST_SHOWN {
        names.truncate(SHOWN);
        names.push(format!("and {} more", count - SHOWN));
    }
    names
}

/// Nodes one by one; of many the worst.
fn details(text: &mut Text, network: &Network, lumping: &Lumping) {
    let name = |id: NodeId| network.nodes()[id.index()].name.clone();
    let of_biot = |part: fn(&Biot) -> f64| {
        move |c: &&LumpCheck| c.biot.map_or("-".into(), |b| significant(part(&b), 3))
    };
    if !lumping.checks.is_empty() {
        let shown = worst(&lumping.checks);
        let table = TextTable::of(&shown)
            .left("lump", |c| name(c.node))
            .right("L_char [mm]", |c| significant(1e3 * c.length, 3))
            .right("h [W/(m^2 K)]", of_biot(|b| b.coefficient))
            .right("k [W/(m K)]", of_biot(|b| b.conductivity))
            .right("Bi", of_biot(|b| b.number))
            .right("L^2/alpha", |c| c.diffusion.map_or("-".into(), |t| duration(t, 3)));
        text.section().table(table);
        if shown.len() < lumping.checks.len() {
            text.line(format!("{} of {} lumps: the largest Bi", shown.len(), lumping.checks.len()));
        }
    }
    let unknown = |id: &NodeId| ("no L_char", *id);
    let mut reasons: Vec<(&str, NodeId)> = lumping.without_length.iter().map(unknown).collect();
    reasons.extend(
        lumping.checks.iter().filter_map(|check| Some((told(check.biot.err()?).0, check.node))),
    );
    // by reason; within one in the order of the file
    reasons.sort_by_key(|(words, _)| *words);
    for group in reasons.chunk_by(|a, b| a.0 == b.0) {
        let names: Vec<String> = group.iter().map(|(_, id)| name(*id)).collect();
        text.labelled(&format!("{}: ", group[0].0), few(names));
    }
}

/// The member `lumping` of JSON.
pub fn json(network: &Network, lumping: &Lumping) -> Value {
    let mut nodes = Map::new();
    for check in &lumping.checks {
        let mut node = Map::new();
        let mut scalar = |key: &str, value: f64, unit: &str| {
            drop(node.insert(key.to_owned(), json!(SiValue::new(value, unit))))
        };
        scalar("L_char", check.length, "m");
        if let Ok(biot) = check.biot {
            scalar("biot", biot.number, "1");
            scalar("h", biot.coefficient, "W/(m^2 K)");
            scalar("k", biot.conductivity, "W/(m K)");
            scalar("at", biot.time, "s");
        }
        if let Ok(time) = check.diffusion {
            scalar("diffusion_time", time, "s");
        }
        let reasons = [("biot", check.biot.err()), ("diffusion_time", check.diffusion.err())];
        let missing = reasons
            .iter()
            .filter_map(|(key, reason)| Some(((*key).to_owned(), json!(told((*reason)?).1))));
        let missing: Map<String, Value> = missing.collect();
        if !missing.is_empty() {
            node.insert("not_checked".to_owned(), Value::Object(missing));
        }
        nodes.insert(network.nodes()[check.node.index()].name.clone(), Value::Object(node));
    }
    let time = |time: f64| SiValue::new(time, "s");
    let stretch = lumping.shortest.map(|s| json!({ "from": time(s.from), "to": time(s.to) }));
    json!({
        "nodes": nodes,
        "without_length": lumping.without_length.len(),
        "shortest_stretch": stretch,
    })
}
