//! Names of nodes and boundaries, where something is connected to them.

use std::collections::BTreeSet;

use lptn_network::{End, NodeId, is_name};
use lptn_units::suggest;

use crate::diagnostic::Diagnostic;
use crate::elaborate::Elaboration;
use crate::fields::Fields;
use crate::raw::RawValue;

impl<'a> Elaboration<'a> {
    /// The node or boundary that a field names.
    pub(crate) fn end(&mut self, fields: &Fields<'a>, key: &str) -> Option<(End, &'a RawValue)> {
        let raw = fields.require(key, &mut self.problems)?;
        let name = fields.text(key, raw, &mut self.problems)?;
        self.named_end(fields, key, (name, raw))
    }

    /// The node or boundary of this name.
    pub(crate) fn named_end(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        (name, raw): (&str, &'a RawValue),
    ) -> Option<(End, &'a RawValue)> {
        match self.ends.get(name) {
            Some((end, _)) => Some((*end, raw)),
            None if self.names.is_hidden(name) => None, // what hides it has been reported
            None => {
                let problem = self.unknown_end(fields, key, (name, raw));
                self.report(problem);
                None
            }
        }
    }

    /// The node that a field names; a boundary is not one.
    pub(crate) fn node_end(&mut self, fields: &Fields<'a>, key: &str) -> Option<(NodeId, &'a RawValue)> {
        let (end, raw) = self.end(fields, key)?;
        match end {
            End::Node(id) => Some((id, raw)),
            End::Boundary(_) => {
                let message =
                    format!("{} names a boundary, which needs no capacity", fields.owner.field(key));
                let problem = Diagnostic::error("netlist::not_a_node", message)
                    .at(raw.span.clone(), "a boundary")
                    .help("a boundary keeps its temperature whatever flows in: name a node");
                self.report(problem);
                None
            }
        }
    }

    fn unknown_end(&mut self, fields: &Fields<'_>, key: &str, (name, raw): (&str, &RawValue)) -> Diagnostic {
        let wanted = if matches!(key, "node" | "into") { "node" } else { "node or boundary" };
        let message = format!("no {wanted} named `{name}`, which {} refers to", fields.owner.field(key));
        let error = Diagnostic::error("netlist::unknown_node", message)
            .at(raw.span.clone(), format!("no such {wanted}"));
        if let Some(near) = self.similar_end(name, wanted == "node") {
            let error = error.help(format!("did you mean `{near}`?"));
            return match self.ends.get(near) {
                Some((_, span)) => error.also((*span).clone(), "similar name"),
                None => error,
            };
        }
        match self.names.kind_of(name) {
            Some(kind) => error.help(format!("`{name}` is a {kind}; name the {wanted} itself")),
            None if is_name(name) => error.help(format!("add it, for example {}", example(name, wanted))),
            None => error.help("write the name as it stands below [node] or [boundary]"),
        }
    }

    /// The most similar name of an end; of equally similar ones the first in the alphabet, as nothing may depend
    /// on hash order.
    fn similar_end(&mut self, name: &str, only_nodes: bool) -> Option<&'a str> {
        if !self.names.may_search() {
            return None;
        }
        let fits = |end: &End| !only_nodes || matches!(end, End::Node(_));
        let candidates: BTreeSet<&'a str> =
            self.ends.iter().filter(|(_, (end, _))| fits(end)).map(|(name, _)| *name).collect();
        suggest(name, candidates.into_iter())
    }
}

fn example(name: &str, wanted: &str) -> String {
    match wanted {
        "node" => format!("`{name} = {{ T0 = \"25 degC\", C = \"500 J/K\" }}` below [node]"),
        _ => format!("`{name} = {{ T = \"25 degC\" }}` below [boundary]"),
    }
}
