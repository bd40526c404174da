//! Checks of a flow network as a whole: references, dead ends, flows that no pressure changes.

use foldhash::HashMap;
use lptn_data::Diagnostic;

use crate::hydraulic::JUNCTION;
use crate::hydraulic::branch::Branch;
use crate::raw::{RawEntry, RawKind};

/// Reports parts of a circuit whose pressures nothing determines.
pub(super) fn check(junctions: &[RawEntry], branches: &[Branch], problems: &mut Vec<Diagnostic>) {
    let number: HashMap<&str, usize> =
        junctions.iter().enumerate().map(|(i, junction)| (junction.key.as_str(), i)).collect();
    let ends: Vec<[usize; 2]> = branches
        .iter()
        .map(|branch| [0, 1].map(|end: usize| number[branch.ends[end].as_str()]))
        .collect();
    let given: Vec<bool> = junctions.iter().map(has_pressure).collect();
    for (i, junction) in junctions.iter().enumerate().filter(|(i, _)| !given[*i]) {
        problems.extend(dead_end(junction, ends.iter().filter(|ends| ends.contains(&i)).count()));
    }
    // only a flow that yields ties two pressures together
    let yielding = branches.iter().zip(&ends).filter(|(branch, _)| branch.yields);
    let yielding: Vec<[usize; 2]> = yielding.map(|(_, ends)| *ends).collect();
    let mut seen = given.clone();
    for (i, junction) in junctions.iter().enumerate() {
        let reached = reached(i, &yielding, &mut seen, &given);
        let joined = ends.iter().any(|ends| ends.contains(&i));
        problems.extend((!reached && joined).then(|| no_reference(junction)));
    }
}

fn has_pressure(junction: &RawEntry) -> bool {
    matches!(&junction.value.kind, RawKind::Table(table) if table.get("p").is_some())
}

/// True unless the part around a junction that was not seen before has no given pressure.
fn reached(from: usize, ends: &[[usize; 2]], seen: &mut [bool], given: &[bool]) -> bool {
    if seen[from] {
        return true;
    }
    let (mut waiting, mut tied) = (vec![from], false);
    while let Some(at) = waiting.pop() {
        tied |= given[at];
        if given[at] || std::mem::replace(&mut seen[at], true) {
            continue;
        }
        for pair in ends.iter().filter(|pair| pair.contains(&at)) {
            waiting.push(if pair[0] == at { pair[1] } else { pair[0] });
        }
    }
    tied
}

fn no_reference(junction: &RawEntry) -> Diagnostic {
    let name = &junction.key;
    Diagnostic::wrong(
        "netlist::no_reference",
        format!("no branch ties the pressure of {} `{name}` to a given one", JUNCTION.name),
        &junction.key_span,
        format!(
            "give one junction of its circuit a pressure, `{name} = {{ p = \"0 bar\" }}`; a branch \
             with a fixed `flow` ties no pressures"
        ),
    )
}

/// A junction where nothing flows through.
fn dead_end(junction: &RawEntry, branches: usize) -> Option<Diagnostic> {
    let name = &junction.key;
    let message = match branches {
        0 => format!("{} `{name}` has no branch", JUNCTION.name),
        1 => format!("{} `{name}` has one branch, so nothing flows there", JUNCTION.name),
        _ => return None,
    };
    let help = format!("add the branch that leads on, or give the pressure: `p` of `{name}`");
    Some(match branches {
        0 => Diagnostic::wrong("netlist::dead_end", message, &junction.key_span, help),
        _ => Diagnostic::doubt("netlist::dead_end", message, &junction.key_span, help),
    })
}
