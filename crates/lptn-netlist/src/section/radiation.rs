//! `[radiation]`.

use lptn_network::{Emissivity, Exchange, Input, Path};
use lptn_units::{Dimension, Type};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, sample};
use crate::raw::{RawKind, RawValue};
use crate::section::conductor::check_forms;
use crate::value::{Place, Wanted};

const FORMS: &[&[&str]] = &[&["Gr"], &["emissivity", "area"]];

impl<'a> Elaboration<'a> {
    /// The law of a radiating exchange.
    pub(crate) fn radiation(&mut self, fields: &Fields<'a>) -> Option<Path> {
        self.problems.extend(check_forms(fields, FORMS));
        let exchange = self.law(fields, "Gr", Type::of(Dimension::AREA));
        let emissivity = fields.get("emissivity").and_then(|raw| self.emissivity(fields, raw));
        let area = self.law(fields, "area", Type::of(Dimension::AREA));
        let view_factor = self.law(fields, "view_factor", Type::SCALAR);
        if let Some(exchange) = exchange {
            if view_factor.is_some() && emissivity.is_none() {
                self.refuse_keys(fields, &["view_factor"], "has no effect: `Gr` includes it");
            }
            return Some(Path::Radiation(Exchange::Area(exchange)));
        }
        let view_factor = view_factor.unwrap_or_else(|| Input::number(1.0));
        Some(Path::Radiation(Exchange::Surfaces { emissivity: emissivity?, area: area?, view_factor }))
    }

    /// One effective emissivity, or those of two parallel plates.
    fn emissivity(&mut self, fields: &Fields<'a>, raw: &'a RawValue) -> Option<Emissivity<Input>> {
        let mut one = |raw: &'a RawValue| {
            let place = Place { owner: &fields.owner, key: "emissivity", raw };
            let given = self.given(place, Wanted::of_link(Type::SCALAR));
            given.map_or_else(|| stand_in(Type::SCALAR), |given| given.input())
        };
        let RawKind::Array(list) = &raw.kind else { return Some(Emissivity::Effective(one(raw))) };
        if let [a, b] = list.as_slice() {
            let first = one(a);
            return Some(Emissivity::Plates(first, one(b)));
        }
        let message = format!("{} has {} values", fields.owner.field("emissivity"), list.len());
        let problem = Diagnostic::error("netlist::emissivities", message).at(raw.span.clone(), "");
        self.report(problem.help(format!(
            "give one for the exchange as a whole, `{}`, or two for parallel plates, `emissivity = [0.8, 0.9]`",
            sample("emissivity")
        )));
        None
    }
}
