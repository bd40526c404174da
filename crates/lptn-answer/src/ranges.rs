//! Laws outside the ranges in which they are known, in words.

use lptn_laws::Group;
use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Item, Network, list_of};
use lptn_report::{Claim, duration, significant};
use lptn_solve::OutOfRange;
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::words::count;

/// Digits of a group: correlations are good to a few percent.
const DIGITS: usize = 3;

/// The stretches in which one group of one path was outside.
struct Left<'a> {
    stretches: &'a [OutOfRange],
    /// The one that went furthest.
    worst: &'a OutOfRange,
}

impl Left<'_> {
    /// Law and group: those of one law are reported together.
    fn law(&self, network: &Network) -> (&'static str, &'static str) {
        (name_of_law(network, self.worst.item), self.worst.group.meaning)
    }

    fn length(&self) -> f64 {
        self.stretches.iter().map(|stretch| stretch.to - stretch.from).sum()
    }
}

fn name_of_law(network: &Network, item: Item) -> &'static str {
    network.law(item).map_or("", |law| law.formula().declaration().name)
}

/// Factor by which a value is outside its range.
fn times_outside(of: &OutOfRange) -> f64 {
    let Group { from, to, .. } = *of.group;
    if of.value < from { from / of.value } else { of.value / to }
}

/// Each path and group with its stretches, in the order of the paths.
fn gathered<'f>(found: &'f [OutOfRange]) -> Vec<Left<'f>> {
    let same = |a: &OutOfRange, b: &OutOfRange| a.item == b.item && a.group == b.group;
    let further = |a: &&OutOfRange, b: &&OutOfRange| times_outside(a).total_cmp(&times_outside(b));
    let one = |stretches: &'f [OutOfRange]| {
        Some(Left { stretches, worst: stretches.iter().max_by(further)? })
    };
    found.chunk_by(same).filter_map(one).collect()
}

/// `1e4 to 1e11`, `at most 1e12`.
fn range(group: &Group) -> String {
    let [from, to] = [group.from, group.to].map(|end| significant(end, DIGITS));
    match (group.from, group.to) {
        (0.0, _) => format!("at most {to}"),
        (_, f64::INFINITY) => format!("at least {from}"),
        _ => format!("from {from} to {to}"),
    }
}

/// A warning for each law and group that was outside, with the path that was outside longest.
pub fn warnings(netlist: &Netlist, found: &[OutOfRange], run: bool) -> Vec<Diagnostic> {
    let network = &netlist.network;
    let mut left = gathered(found);
    left.sort_by(|a, b| {
        a.law(network).cmp(&b.law(network)).then(b.length().total_cmp(&a.length()))
    });
    let together = left.chunk_by(|a, b| a.law(network) == b.law(network));
    together.map(|paths| warning(netlist, paths, run)).collect()
}

fn warning(netlist: &Netlist, paths: &[Left<'_>], run: bool) -> Diagnostic {
    let network = &netlist.network;
    let (first, others) = (&paths[0], &paths[1..]);
    let OutOfRange { item, group, value, at, .. } = *first.worst;
    let name = |left: &Left<'_>| network.name_of(left.worst.item).into_owned();
    let (symbol, value) = (group.name, significant(value, DIGITS));
    let mut message = format!("{symbol} of `{}` is {value}", name(first));
    if run {
        message += &format!(" at {}", duration(at, 4));
    }
    let law = name_of_law(network, item);
    message += &format!(", but `{law}` is known for a {} {}", group.meaning, range(group));
    if run {
        message += &format!("; it is outside {}", when(first.stretches));
    }
    let names: Vec<String> = others.iter().map(name).collect();
    if !names.is_empty() {
        message += &format!("; so it is in {}", list_of(&names, "elements"));
    }
    Diagnostic::warning("run::out_of_range", message).at(netlist.source_map.name(item), "").help(
        "the heat flow is uncertain there: choose another law, or check its influence on the \
         result",
    )
}

/// `from 0 s to 12 min`, `in 4 stretches from 0 s to 25 min, 12 min in all`.
fn when(stretches: &[OutOfRange]) -> String {
    let (Some(first), Some(last)) = (stretches.first(), stretches.last()) else {
        return String::new();
    };
    let span = format!("from {} to {}", duration(first.from, 4), duration(last.to, 4));
    if stretches.len() == 1 {
        return span;
    }
    let all: f64 = stretches.iter().map(|stretch| stretch.to - stretch.from).sum();
    format!("in {} stretches {span}, {} in all", stretches.len(), duration(all, 3))
}

/// Claim for a report that every law stayed in its range, or which did not.
pub fn claim(network: &Network, found: &[OutOfRange]) -> Claim {
    let rest = "no fluid or capacity left its range, nor a table without `outside`";
    if network.ranged().is_empty() {
        return Claim::checked(true, rest);
    }
    let left = gathered(found);
    if left.is_empty() {
        return Claim::checked(true, rest.replace("no fluid", "no law, fluid"));
    }
    let told = |left: &Left<'_>| {
        let name = network.name_of(left.worst.item);
        format!("{} of {name}", left.worst.group.name)
    };
    let first = told(&left[0]);
    let more = left.len() - 1;
    let more = if more > 0 { format!(" and {}", count(more, "other")) } else { String::new() };
    Claim::checked(false, format!("a law left its range, see the messages: {first}{more}"))
}

/// For each path and group that was outside its range, an object
/// `{ path, law, group, meaning, from, to, value, at, stretches }`, times in s. A loss has `source`
/// instead of `path`. Nothing if none was outside. A range without an end has none.
pub fn members(network: &Network, found: &[OutOfRange], run: bool) -> Option<Vec<Value>> {
    let one = |left: &Left<'_>| {
        let OutOfRange { item, group, value, at, .. } = *left.worst;
        let finite = |end: f64| end.is_finite().then_some(end);
        let of = if matches!(item, Item::Source(_)) { "source" } else { "path" };
        let mut member = json!({
            of: network.name_of(item),
            "law": name_of_law(network, item),
            "group": group.name,
            "meaning": group.meaning,
            "from": group.from,
            "to": finite(group.to),
            "value": finite(value),
        });
        if let (true, Some(member)) = (run, member.as_object_mut()) {
            let stretch = |of: &OutOfRange| [of.from, of.to].map(|time| SiValue::new(time, "s"));
            let stretches: Vec<_> = left.stretches.iter().map(stretch).collect();
            member.insert("at".into(), json!(SiValue::new(at, "s")));
            member.insert("stretches".into(), json!(stretches));
        }
        member
    };
    let left = gathered(found);
    (!left.is_empty()).then(|| left.iter().map(one).collect())
}
