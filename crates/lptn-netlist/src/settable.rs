//! Help for `--set outside.T=…`: only parameters can be set, so a field needs one.

use lptn_data::Span;
use lptn_network::{Field, Item, Law};
use lptn_units::parse_quantity;

use crate::netlist::Netlist;

impl Netlist {
    /// The parameter that a field of an element needs to be set: `outside.T`.
    pub(crate) fn parameter_for(&self, name: &str) -> Option<(Option<Span>, String)> {
        let (element, key) = name.rsplit_once('.')?;
        let item = self.network.item(element).ok()?;
        let of_law = |law: &Law| law.parts().map(|(field, _)| field).find(|f| f.key() == key);
        let field = match item {
            Item::Boundary(_) => Some(Field::Temperature),
            Item::Node(_) => [Field::Initial, Field::Capacity].into_iter().find(|f| f.key() == key),
            Item::Conductor(id) => of_law(&self.network.conductors()[id.index()].law),
            Item::Source(id) => of_law(&self.network.sources()[id.index()].law),
            _ => None,
        };
        let field = field.filter(|field| field.key() == key)?;
        let place = self.source_map.get(item, field);
        let written = place.as_ref().map(|place| self.files.at(place));
        let own = written.map(|text| text.trim_matches('"'));
        if let Some(own) = own.filter(|own| self.network.parameter(own).is_ok()) {
            let help = format!("its value is the parameter `{own}`: set that");
            return Some((place, help));
        }
        let quantity = |text: &&str| parse_quantity(text, None).is_ok();
        let Some(value) = own.filter(quantity) else {
            let help = "only parameters can be set: set one that this value reads";
            return Some((place, help.to_owned()));
        };
        let parameter: String =
            name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let help = format!(
            "only parameters can be set: add `{parameter} = \"{value}\"` below [param], write \
             `{key} = \"{parameter}\"` in `{element}`, and set `{parameter}`"
        );
        Some((place, help))
    }
}
