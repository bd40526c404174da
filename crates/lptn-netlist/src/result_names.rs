//! The names of results in expressions: temperatures and heat flows.
//!
//! Expressions of results (limits, requirements) read the slots of nodes and boundaries.

use lptn_data::{Diagnostic, Span};
use lptn_laws::{Formula, Kind};
use lptn_network::is_name;
use lptn_units::suggest;

use crate::grid_names::VALUES;
use crate::names::{Names, base};
use crate::place::Place;

impl Names {
    /// A heat flow: `NAME.Q` of a path or boundary, `NAME.Q_from` or `NAME.Q_to` of a stream,
    /// `NAME.P` of a source.
    pub(crate) fn is_heat(&self, name: &str) -> bool {
        let Some((base, ending)) = name.rsplit_once('.') else { return false };
        !self.untold.contains_key(name)
            && self.kind_of(base).is_some_and(|kind| heats(kind).contains(&ending))
    }

    /// Notes results that the law of an element does not have although others of its kind do.
    /// Results of a wrong law are not reported again.
    pub(crate) fn learn_results(&mut self, element: &str, kind: Kind, law: Option<Formula>) {
        let all = kind.laws().flat_map(|law| law.result_declarations());
        for key in all.map(|result| result.key) {
            let name = format!("{element}.{key}");
            let Some(law) = law else {
                self.fail(&name);
                continue;
            };
            if law.result_declarations().iter().all(|own| own.key != key) {
                let why = law.declaration().idle.iter().find(|(idle, _)| *idle == key);
                self.untold.insert(name, why.map_or("", |(_, why)| *why));
            }
        }
    }

    /// Error for an unknown name in a place that takes results.
    pub(crate) fn unknown_result(&mut self, place: Place<'_>, name: &str, at: Span) -> Diagnostic {
        let (words, base) = (place.words(), base(name));
        let dotted = base.len() < name.len();
        let kind = self.kind_of(base);
        let message = match kind {
            Some(kind) if dotted => {
                format!("{words} uses `{name}`, which {kind} `{base}` does not have")
            }
            None if dotted && name.ends_with(".T") => {
                format!("{words}: no node or boundary named `{base}`")
            }
            None if dotted => format!("{words}: no element named `{base}`"),
            _ => format!("{words} uses `{name}`, which is not a parameter"),
        };
        let error = Diagnostic::error("netlist::unknown_name", message).at(at, "unknown name");
        if let Some(why) = self.untold.get(name).filter(|why| !why.is_empty()) {
            return error.help(format!("`{}` {why}", name.rsplit('.').next().unwrap_or(name)));
        }
        match kind.map(|kind| (kind, results_of(kind, base))) {
            Some((kind, has)) if has.is_empty() => {
                error.help(format!("`{base}` is a {kind}; results are temperatures and heat flows"))
            }
            Some(("node", _)) => error.help(format!("its temperature is `{base}.T`")),
            Some(("boundary", _)) => error
                .help(format!("its temperature is `{base}.T`, the heat it gives is `{base}.Q`")),
            Some((kind, has)) => {
                let has: Vec<String> = has.iter().map(|name| format!("`{name}`")).collect();
                let article = if kind.starts_with('a') { "an" } else { "a" };
                error.help(format!("`{base}` is {article} {kind}: write {}", has.join(" or ")))
            }
            None => match self.similar_result(name) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help(self.some_results()),
            },
        }
    }

    /// Help with a temperature and a heat flow of the netlist, the first in the alphabet.
    fn some_results(&self) -> String {
        let first = |ends: &[&str]| {
            // the nodes and paths before the boundaries
            let of = |(name, kind): (&String, &&'static str)| {
                let last = *kind == "boundary";
                results_of(kind, name).into_iter().map(move |result| (last, result))
            };
            let usable = |(name, _): &(&String, _)| name.split('.').all(is_name);
            let all = self.elements.iter().filter(usable).flat_map(of);
            let all = all.filter(|(_, name)| ends.iter().any(|end| name.ends_with(end)));
            all.min().map(|(_, name)| format!(" such as `{name}`")).unwrap_or_default()
        };
        let (temperature, heat) = (first(&[".T"]), first(&[".Q", ".P"]));
        format!("name a temperature{temperature}, a heat flow{heat}, a parameter or `t`")
    }

    /// The most similar parameter, temperature or heat flow; in a tie, the first in the alphabet.
    fn similar_result(&mut self, name: &str) -> Option<String> {
        if !self.may_search(self.elements.len()) {
            return None;
        }
        let mut names: Vec<String> =
            self.elements.iter().flat_map(|(name, kind)| results_of(kind, name)).collect();
        names.extend(self.order.iter().cloned());
        names.sort_unstable();
        suggest(name, names.iter().map(String::as_str)).map(str::to_owned)
    }
}

/// The endings of the heat flows of an element of this section, and of the results of its laws.
fn heats(kind: &str) -> Vec<&'static str> {
    match kind {
        "boundary" => vec!["Q"],
        path => match Kind::ALL.iter().find(|kind| kind.declaration().section == path) {
            Some(kind) if kind.is_stream() => vec!["Q_from", "Q_to"],
            Some(kind) => {
                let heat = if kind.is_source() { "P" } else { "Q" };
                let told = kind.laws().flat_map(|law| law.result_declarations());
                let mut endings: Vec<_> =
                    [heat].into_iter().chain(told.map(|result| result.key)).collect();
                endings.dedup();
                endings
            }
            None => vec![],
        },
    }
}

/// The results of an element of this section: `steel.T`, `internal.Q`.
fn results_of(kind: &str, name: &str) -> Vec<String> {
    let temperature: &[&str] = match kind {
        "node" | "boundary" => &["T"],
        "grid" => &VALUES,
        _ => &[],
    };
    temperature.iter().chain(&heats(kind)).map(|ending| format!("{name}.{ending}")).collect()
}
