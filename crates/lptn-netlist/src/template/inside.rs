//! Errors about names inside a template.

use lptn_data::Diagnostic;
use lptn_network::is_name;

use super::structure::Structure;
use crate::names::base;
use crate::place::Place;

/// Help for a template that needs a name around it.
pub(crate) fn by_port(name: &str) -> String {
    let port = name.rsplit('.').next().filter(|port| is_name(port)).unwrap_or("port");
    format!(
        "a template knows the rest of the network by its ports: add `{port}` to its `port`, and \
         `connect = {{ {port} = \"{name}\" }}` when it is used"
    )
}

/// A result of the network around a template.
pub(crate) fn outside(place: Place<'_>, name: &str, template: &str) -> Diagnostic {
    let message = format!("{} uses `{name}`, which is not in template `{template}`", place.words());
    Diagnostic::error("netlist::outside_template", message).help(by_port(base(name)))
}

/// Shortens the help for a text in a template to the names of the template.
pub(crate) fn in_own_words(
    structure: &Structure,
    place: Place<'_>,
    mut problem: Diagnostic,
) -> Diagnostic {
    if let Some(instance) = structure.instance_at(&place.raw.span) {
        problem.help = problem.help.map(|help| help.replace(&format!("{instance}."), ""));
    }
    problem
}
