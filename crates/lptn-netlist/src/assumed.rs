//! Assumptions of laws that a file seems to violate: gears at the centre distance of their pitch
//! circles, a conductivity that is linear over the temperatures of a body.

use lptn_data::Diagnostic;
use lptn_network::{Field, Item, Naming, Network, Value, slot};
use lptn_units::{Degree, format_six as short};

use crate::source_map::SourceMap;

/// Allowed difference between the addenda of two gears and their sum without shift, in modules.
const ROUNDED: f64 = 0.005;

/// A warning for each mesh whose addenda indicate shifted profiles.
pub(crate) fn shifted_gears(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let sources = network.source_ids().map(Item::Source);
    sources.filter_map(|item| shifted((network, map), item)).collect()
}

fn shifted((network, map): (&Network, &SourceMap), item: Item) -> Option<Diagnostic> {
    let law = network.law(item)?;
    let keys = ["addendum_1", "addendum_2"];
    let values = [law.value(keys[0])?, law.value(keys[1])?];
    let mut scope = network.evaluation();
    let mut sum = 0.0;
    for value in values {
        sum += value.at(&mut scope).ok()?;
    }
    let shift = sum - 2.0;
    // the teeth of a ring are often made shorter, without a shift
    let internal = !law.formula().declaration().ordered.is_empty();
    if shift.abs() <= ROUNDED || internal && shift < 0.0 {
        return None;
    }
    let message = format!(
        "the addenda of mesh `{}` sum to {} modules: its loss is that of gears without profile \
         shift, which have 2",
        network.name_of(item),
        short(sum)
    );
    let place = |key: &str| map.get(item, Field::of_law(key)?);
    let place = keys.into_iter().find_map(place).or_else(|| map.name(item));
    let help = format!(
        "if x1 + x2 = {}, the centres are further apart and the loss differs by tens of percent: \
         take it from a test, as a [source]",
        short(shift)
    );
    Some(Diagnostic::warning("netlist::profile_shift", message).at(place, "").help(help))
}

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
