//! `[value]`: expressions with a name.

use lptn_data::Diagnostic;
use lptn_network::{Context, Field, Item};
use lptn_units::Expression;

use crate::format::{Role, SectionDeclaration};
use crate::names::ValueKind;
use crate::parameters::Pending;
use crate::place::{Place, Text, Wanted};
use crate::work::Elaboration;
use crate::{controller, hydraulic};

pub(crate) const VALUE: SectionDeclaration = SectionDeclaration {
    name: ValueKind::Value.section(),
    sentence: "An expression over temperatures, states and other values, with its own name.",
    role: Role::Value,
    example: "\"5 [W/(m^2 K)] + 0.1 [W/(m^2 K^2)] * abs(skin.T - air.T)\"",
    ..SectionDeclaration::NEW
};

impl<'a> Elaboration<'a> {
    /// Gives all named values to the builder, each after those it uses.
    pub(crate) fn named_values(&mut self) {
        for pending in self.in_order(ValueKind::Value, "netlist::value_cycle") {
            let key = &pending.entry.key;
            if self.named_value(pending).is_none() {
                self.names.fail(key);
            }
        }
    }

    /// True but for the inner values of a controller or branch.
    fn is_shown(&self, name: &str) -> bool {
        let of = controller::INNER
            .iter()
            .chain(&hydraulic::INNER)
            .find_map(|inner| name.strip_suffix(inner)?.strip_suffix('.'));
        let whole = [Some(ValueKind::Value), Some(ValueKind::State)];
        of.is_none_or(|of| !whole.contains(&self.names.value_kind(of)))
    }

    fn named_value(&mut self, mut pending: Pending<'a>) -> Option<()> {
        let entry = pending.entry;
        let place = Place { owner: &pending.owner, key: "", raw: &entry.value };
        let text = pending.text.take()?;
        let wanted = Wanted::of_law(self.type_of(&entry.key), Context::Control);
        self.resolve(place, text.clone(), wanted)?;
        let expression = match text {
            Text::Quantity(quantity) => {
                self.report(constant(place));
                Expression::literal(quantity.value, quantity.ty)
            }
            Text::Expression(expression) => expression,
        };
        let id =
            self.builder.named_value(&entry.key, &expression, self.is_shown(&entry.key)).ok()?;
        self.map.insert(Item::Value(id), Field::Name, entry.key_span.clone());
        self.map.value(Item::Value(id), Field::Value, &entry.value);
        Some(())
    }
}

/// Error for a value that is a quantity.
fn constant(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::constant_value",
        format!("{} is a constant", place.words()),
        &place.raw.span,
        "write it in [param]: parameters can be set, swept and fitted",
    )
}
