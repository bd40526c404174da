//! Errors about names inside a template.

use lptn_data::{Diagnostic, Span};
use lptn_network::is_name;

use super::structure::Structure;
use crate::names::{ValueKind, base};
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

/// `index` in a place that has none. `instance` is the instance of a template around it.
pub(crate) fn no_index(place: Place<'_>, instance: Option<&str>, at: Span) -> Diagnostic {
    let message = format!("{} uses `index`, but is not of one of several instances", place.words());
    let help = match instance {
        Some(_) => {
            "`index` is the number of an instance of a `[use]` with `count`: give this use a \
             `count`, or give the template a parameter `n` and set it, `set = { n = \"index\" }`"
        }
        None => {
            "`index` is the number of an instance: it may be used in `set` of a `[use]` with \
             `count`, in its template, and in limits and paths of all instances, `cell[*]`"
        }
    };
    Diagnostic::error("netlist::no_index", message).at(at, "").help(help)
}

/// `index` of an instance in a file that gives the name to another value.
pub(crate) fn two_meanings(place: Place<'_>, kind: ValueKind, at: Span) -> Diagnostic {
    let kind = kind.word();
    let message = format!(
        "{} uses `index`, which is a {kind} of the file and the number of the instance",
        place.words()
    );
    Diagnostic::error("netlist::two_meanings", message)
        .at(at, "")
        .help(format!("rename the {kind}, for example `index_0`"))
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
