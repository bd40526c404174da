//! Parts of every report on a netlist: its network, its parameters, and its sources.

use lptn_graph::{Diagram, Grouping, Laid, MOST_PLACES, View, diagram};
use lptn_netlist::Netlist;
use lptn_network::{Field, Item, Network, ParameterId};
use lptn_report::{Claim, Piece, Report, Section, Standing, Text, TextTable, plain, significant};
use lptn_solve::{Lumping, OutOfRange, Snapshot};
use lptn_study::{FileHash, Sundials};
use lptn_units::Unit;
use serde_json::Value;

use crate::families::{self, Row};
use crate::input::{Input, quoted};
use crate::words::{count, difference, spaced, unverified};
use crate::{fields, ranges};

/// Sensitivity of an answer to each parameter.
pub struct Sensitivities {
    /// Quantity that changes: `steel at 25 min`.
    pub of: String,
    /// Change in K per 1 % of each parameter, or per 1 K of a temperature; `None` if not known, or
    /// if the value is 0, of which there is no share.
    pub values: Vec<Option<f64>>,
}

/// Additions of a verb to the report on a network.
#[derive(Default)]
pub struct Known<'a> {
    /// Claims on how far its answer can be trusted.
    pub claims: Vec<Claim>,
    /// The network at instants, each under a heading.
    pub states: Vec<(String, Snapshot)>,
    /// The network at further instants, in order, for the fields of its grids; empty for the last
    /// of the states.
    pub frames: Vec<(String, Snapshot)>,
    /// Unit of temperatures if it is not that of the netlist.
    pub unit: Option<&'a Unit>,
    /// Heading of the network if no instants are shown; `None` for "Network".
    pub network: Option<&'a str>,
    /// The change of the answer by each parameter.
    pub sensitivities: Option<Sensitivities>,
}

/// Report on a network: drawings, parameters, sources and claims.
pub fn about(input: &Input, known: Known<'_>) -> Report {
    let unit = known.unit.unwrap_or(&input.netlist.temperature_unit);
    let states =
        known.states.iter().flat_map(|(title, state)| drawing(input, (title, unit), Some(state)));
    let mut sections: Vec<Section> = states.collect();
    if sections.is_empty() {
        sections.extend(drawing(input, (known.network.unwrap_or("Network"), unit), None));
    }
    let frames = match known.frames.is_empty() {
        true => known.states.as_slice(),
        false => known.frames.as_slice(),
    };
    sections.splice(0..0, fields::sections(input, unit, frames));
    sections.extend(parameters(input, known.sensitivities.as_ref()));
    sections.push(made_from(&hashes(&input.netlist), &input.command));
    let mut claims = known.claims;
    claims.push(linearity(input));
    Report { name: input.text.stem.clone(), claims, sections, ..Report::default() }
}

/// Every file that a netlist was read from.
pub fn hashes(netlist: &Netlist) -> Vec<FileHash> {
    let hash = |(name, bytes): (&str, &[u8])| FileHash {
        name: name.to_owned(),
        sha256: lptn_study::sha256(bytes),
    };
    netlist.input_bytes().map(hash).collect()
}

/// Claim on the linearity of the network.
pub fn linearity(input: &Input) -> Claim {
    let network = &input.netlist.network;
    let constant = network.first_varying_capacity().is_none();
    let linear = constant && input.assemble().is_ok_and(|system| system.is_proportional());
    Claim::open(match (linear, network.has_events()) {
        (true, false) => "linear: temperatures rise in proportion to heat",
        (true, true) => "linear between switches",
        (false, _) => "not linear: a result at one load need not be true at another",
    })
}

/// Claims on the laws: if they stayed within their ranges, and which are unverified.
pub fn laws(network: &Network, outside: &[OutOfRange]) -> Vec<Claim> {
    let mut claims = vec![ranges::claim(network, outside)];
    claims.extend(unverified(network).map(Claim::open));
    claims
}

/// Claim on the Biot numbers of the nodes.
pub fn lumps(lumping: &Lumping) -> Claim {
    let (thick, slow) = (lumping.too_thick().len(), lumping.too_slow().len());
    let checked = lumping.checks.iter().filter(|check| check.biot.is_ok()).count();
    match (thick + slow, checked) {
        (0, 0) => Claim::open("no Biot number checked: no node has an L_char"),
        (0, n) => {
            let others = lumping.without_length.len();
            let rest = if others > 0 { format!(", {others} not checked") } else { String::new() };
            Claim::checked(true, format!("Biot numbers below 0.1: {}{rest}", count(n, "node")))
        }
        _ => {
            Claim::checked(false, format!("{} not a lump, see the messages", are(thick.max(slow))))
        }
    }
}

fn are(nodes: usize) -> String {
    if nodes == 1 { "1 node is".into() } else { format!("{nodes} nodes are") }
}

/// The manifest of a run without the members that change from run to run.
pub fn manifest(mut value: Value) -> Option<Section> {
    let members = value.as_object_mut()?;
    for key in ["environment", "results"] {
        members.shift_remove(key);
    }
    let mut text = String::new();
    lines(&value, 0, &mut text);
    Some(Section::of("Manifest", Piece::Verbatim(text)).folded())
}

/// Most members of an object of the manifest: a page of a grid does not list its cells.
const MOST_MEMBERS: usize = 40;

/// JSON with one line per member; a value that contains no further objects is on one line.
fn lines(value: &Value, depth: usize, out: &mut String) {
    let Some(members) = value.as_object().filter(|all| all.values().any(is_deep)) else {
        return *out += &value.to_string();
    };
    *out += "{\n";
    let left_out = members.len().saturating_sub(MOST_MEMBERS);
    let told = (left_out > 0).then(|| ("..".to_owned(), format!("{left_out} more").into()));
    let shown = members.iter().take(MOST_MEMBERS);
    let shown = shown.chain(told.iter().map(|(key, told)| (key, told)));
    for (i, (key, member)) in shown.enumerate() {
        let comma = if i > 0 { ",\n" } else { "" };
        *out += &format!(
            "{comma}{:indent$}{}: ",
            "",
            Value::from(key.as_str()),
            indent = 2 * depth + 2
        );
        lines(member, depth + 1, out);
    }
    *out += &format!("\n{:indent$}}}", "", indent = 2 * depth);
}

fn is_deep(value: &Value) -> bool {
    value.as_object().is_some_and(|members| !members.is_empty())
}

/// The network as a drawing, with temperatures and heat flows of an instant on it. If instances are
/// one box, every node follows in a folded section.
fn drawing(input: &Input, (title, unit): (&str, &Unit), state: Option<&Snapshot>) -> Vec<Section> {
    let drawn = |grouping: Grouping| {
        let view = View { title: "", grouping, unit, state, marked: state.is_some() };
        diagram(&input.netlist.network, &view)
    };
    let diagram = drawn(Grouping::Auto);
    let mut sections = vec![section(title.to_owned(), &diagram, state)];
    let network = &input.netlist.network;
    let few = network.nodes().len() + network.boundaries().len() <= MOST_PLACES;
    if few && !diagram.grouped.is_empty() {
        sections
            .push(section(format!("{title}, every node"), &drawn(Grouping::No), state).folded());
    }
    sections.retain(|section| !section.pieces.is_empty());
    sections
}

/// A diagram as a circuit and, in a state, as bands.
fn section(title: String, diagram: &Diagram, state: Option<&Snapshot>) -> Section {
    let mut pieces = Vec::new();
    let laid = Laid::of(diagram);
    if let Ok(scene) = laid.scene() {
        pieces.push(Piece::Drawing(scene, diagram.grouped.join("; ")));
    }
    if let Some(Ok(scene)) = state.map(|_| laid.sankey()) {
        pieces.push(Piece::Drawing(scene, String::new()));
    }
    Section { title, pieces, folded: false }
}

fn parameters(input: &Input, sensitivities: Option<&Sensitivities>) -> Option<Section> {
    let network = &input.netlist.network;
    let ids: Vec<ParameterId> = network.parameter_ids().collect();
    if ids.is_empty() {
        return None;
    }
    let of = |id: &ParameterId| &network.parameters()[id.index()];
    let shown = |id: ParameterId, value: f64| {
        let unit = input.unit_of(id);
        format!("{}{}", significant(unit.from_si(value), 6), spaced(&unit.text))
    };
    let deviation = |id: &ParameterId| {
        let deviation = input.netlist.overrides().deviation(*id).or(of(id).deviation);
        let unit = input.unit_of(*id);
        let text = unit.text.as_str();
        let text = if of(id).ty.absolute { difference(&unit) } else { text };
        deviation.map_or(String::new(), |spread| {
            let sigma = significant(spread.sigma(network.parameter_value(*id)) / unit.scale, 3);
            format!("{sigma}{}{}", spaced(text), spread.suffix())
        })
    };
    // members of a family are one row if the file has one text for all
    let name = |id: &ParameterId| (of(id).name.clone(), (written(input, *id), deviation(id)));
    let effect = |id: &ParameterId| sensitivities.and_then(|found| found.values[id.index()]);
    let most = |id: &ParameterId| effect(id).map_or(0.0, f64::abs);
    let rows: Vec<Row<ParameterId>> = families::folded(ids, true, name, most);
    let table = TextTable::of(&rows).left("parameter", |row| row.name.as_str());
    let value = |row: &Row<ParameterId>| {
        row.range(|id| network.parameter_value(*id), |value| shown(row.item, value))
    };
    let mut table = families::members(table, &rows, "with the largest effect")
        .right("value", value)
        .left("in the file", |row| written(input, row.item));
    if rows.iter().any(|row| !deviation(&row.item).is_empty()) {
        table = table.right("\u{b1}, one standard deviation", |row| deviation(&row.item));
    }
    if sensitivities.is_some() {
        let value = |row: &Row<ParameterId>| match effect(&row.item) {
            Some(_) => row.range(|id| effect(id).unwrap_or(f64::NAN), |x| format!("{x:+.3}")),
            None => "-".to_owned(),
        };
        table = table.right("+1 % changes it by [K]", value);
    }
    let mut text = Text::new();
    text.table(table);
    if let Some(found) = sensitivities {
        let of = &found.of;
        text.line(format!(
            "The last column is about {of}; of a temperature it is for 1 K more. A value of 0 has no \
             1 %."
        ));
    }
    Some(Section::of("Parameters", Piece::Text(text)))
}

/// The value of a parameter as the file states it, with the comment after it.
fn written(input: &Input, id: ParameterId) -> String {
    let netlist = &input.netlist;
    let Some(span) = netlist.source_map.get(Item::Parameter(id), Field::Value) else {
        return String::new();
    };
    let text = netlist.files.text(span.file);
    let rest = text[span.range.end..].lines().next().unwrap_or_default();
    let comment = rest.split_once('#').map_or("", |(_, comment)| comment.trim());
    let value = netlist.files.at(&span).trim_matches(['"', '\'']);
    match comment {
        "" => plain(value),
        comment => plain(&format!("{value} ({comment})")),
    }
}

/// A verdict as the answer that a report begins with.
pub fn verdict(standing: Standing, verdict: &str) -> Vec<Section> {
    let mut text = Text::new();
    text.marked(standing, verdict);
    vec![Section::of("", Piece::Text(text))]
}

/// Report on an answer that is not about a netlist.
pub fn of_command(files: &[FileHash], command: &[String]) -> Report {
    Report { sections: vec![made_from(files, command)], ..Report::default() }
}

/// The files that were read, with their hashes, and the command.
fn made_from(read: &[FileHash], command: &[String]) -> Section {
    let mut text = Text::new();
    if !read.is_empty() {
        let table = TextTable::of(read).left("file", |file| plain(&file.name));
        text.table(table.left("SHA-256", |file| file.sha256.as_str()));
    }
    text.section();
    if !command.is_empty() {
        let words: Vec<String> = command.iter().map(|word| quoted(word)).collect();
        text.sentence("command:", &plain(&format!("lptn {}", words.join(" "))));
    }
    text.sentence("lptn:", &versions());
    Section::of("Files and versions", Piece::Text(text)).folded()
}

/// "0.1.0, SUNDIALS 7.1.0".
fn versions() -> String {
    let own = env!("CARGO_PKG_VERSION");
    match Sundials::linked().version.as_str() {
        "" => own.to_owned(),
        version => format!("{own}, SUNDIALS {version}"),
    }
}
