//! An assumption of laws that a file seems to violate: a conductivity that is linear over the
//! temperatures of a body.

use lptn_data::Diagnostic;
use lptn_network::{Field, Item, Naming, Network, Value, slot};
use lptn_units::Degree;

use crate::source_map::SourceMap;

/// A warning for each body whose conductivity is written over the mean of its ends and is not
/// straight in it.
pub(crate) fn mean_conductivities(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let conductors = network.conductor_ids().map(Item::Conductor);
    conductors.filter_map(|item| at_the_mean((network, map), item)).collect()
}

fn at_the_mean((network, map): (&Network, &SourceMap), item: Item) -> Option<Diagnostic> {
    let law = network.law(item)?;
    let (field, value) =
        law.parts().find(|(field, _)| matches!(field, Field::Law(law) if law.along))?;
    let Value::Expression(program) = value else { return None };
    if program.degree_in(slot::MEAN) <= Degree::Affine {
        return None;
    }
    let name = network.name_of(item);
    let message = format!(
        "`{}` of {} `{name}` curves over `T_mean`: a body conducts with the mean of its \
         conductivity, not with that at the mean temperature",
        field.key(),
        map.kind(item)
    );
    let others = [slot::FROM, slot::TO, slot::DIFFERENCE];
    let alone = !program.slots().iter().any(|slot| others.contains(slot));
    let help = match alone {
        true => format!(
            "name a material: `[material.of_{name}]` with `k = \"{}\"`, and `material = \
             \"of_{name}\"` instead of `k`",
            over_own(program.text())
        ),
        false => "name a [material] whose `k` is an expression of `T`".to_owned(),
    };
    let place = map.get(item, field).or_else(|| map.name(item));
    Some(Diagnostic::warning("netlist::mean_conductivity", message).at(place, "").help(help))
}

/// The same text over `T`.
fn over_own(text: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut parts = text.split("T_mean").peekable();
    let mut written = parts.next().unwrap_or_default().to_owned();
    for after in parts {
        let alone = !written.ends_with(is_part) && !after.starts_with(is_part);
        written += if alone { "T" } else { "T_mean" };
        written += after;
    }
    written
}

#[cfg(test)]
mod tests {
    use super::over_own;

    #[test]
    fn only_the_name_itself_is_replaced() {
        assert_eq!(over_own("kelvin(T_mean) + k_of(T_mean)"), "kelvin(T) + k_of(T)");
        assert_eq!(over_own("a.T_mean + T_mean2 + T_mean"), "a.T_mean + T_mean2 + T");
    }
}
