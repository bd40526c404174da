//! Templates: parts that are written once and used several times.
//!
//! Templates are expanded in the raw tree, before values are read. Each instance becomes separate
//! elements with full names (`planet[2].gear`) and the values of the template. A place knows its
//! instance, which determines the meaning of names there ([`Structure::meaning`]). So no section
//! has to know of templates.
//!
//! An error that occurs in every instance is reported once.

mod definition;
mod inside;
mod instance;
mod nesting;
mod pattern;
mod plan;
mod structure;
mod wrong_path;

use std::sync::Arc;

use foldhash::HashSet;
use lptn_data::{Diagnostic, Files, Severity};

use crate::format::{
    NAMES, NetlistFormat, Role, SectionDeclaration, Takes, VALUES, names, shaped, text, whole,
};
use crate::include::any_error;
use crate::raw::RawNetlist;
use definition::{OPEN_PARAMETER, Template};
use instance::Maker;

pub(crate) use inside::{by_port, in_own_words, no_index, outside, two_meanings};
pub(crate) use structure::{INDEX, Structure};
pub(crate) use wrong_path::wrong_path;

/// `[template.NAME]`; its contents are read separately.
pub(crate) const TEMPLATE: SectionDeclaration = SectionDeclaration {
    name: "template",
    sentence: "A part that is written once: its elements are below `[template.NAME.node]` and so \
        on.",
    role: Role::Template,
    keys: &[
        shaped(
            "param",
            "table",
            Takes::Each(&Takes::Either(&[Takes::Like, Takes::Table(&OPEN_PARAMETER)])),
            "parameters, with a value or with `{ unit = .. }`",
            "{ m = \"0.2 kg\" }",
        ),
        names(
            "port",
            "list of names",
            "the places of the rest of the network that it uses",
            "[\"in\", \"out\"]",
        ),
    ],
    example: "`port = [\"in\", \"out\"]` and elements below `[template.planet.node]`",
    ..SectionDeclaration::NEW
};

pub(crate) const USE: SectionDeclaration = SectionDeclaration {
    name: "use",
    sentence: "A template in use: once, or several times.",
    role: Role::Use,
    keys: &[
        text("template", "name of a template", "the template that is used", "\"planet\"").needed(),
        whole("count", "the number of instances; without it there is one, without an index", "3"),
        shaped(
            "connect",
            "table of names of nodes or boundaries",
            Takes::Each(&Takes::Either(&[Takes::Text, NAMES])),
            "the node or boundary of each port",
            "{ carrier = \"carrier\" }",
        ),
        shaped(
            "set",
            "table",
            Takes::Each(&VALUES),
            "parameters of the template; a list gives each instance its own",
            "{ ratio = 0.5 }",
        ),
    ],
    example: "{ template = \"planet\", count = 3, connect = { carrier = \"carrier\" } }",
    elsewhere: &[
        ("param", "parameters of the template are given in `set`: `set = { ratio = 0.5 }`"),
        (
            "port",
            "the node or boundary of a port is in `connect`: `connect = { carrier = \
            \"carrier\" }`",
        ),
        (
            "ports",
            "the node or boundary of a port is in `connect`: `connect = { carrier = \"carrier\" }`",
        ),
        ("n", "the number of instances is `count`"),
    ],
    ..SectionDeclaration::NEW
};

/// A netlist without templates: every instance is written out.
#[derive(Debug)]
pub(crate) struct Expanded {
    pub(crate) raw: RawNetlist,
    pub(crate) structure: Arc<Structure>,
    pub(crate) problems: Vec<Diagnostic>,
}

/// Replaces every use by elements.
pub(crate) fn expand(files: &mut Files, mut raw: RawNetlist, format: &NetlistFormat) -> Expanded {
    let (main, mut problems) = (raw.top.span.file, Vec::new());
    let (written, uses) = (raw.take(TEMPLATE.name), raw.take(USE.name));
    let mut templates: Vec<Template<'_>> =
        written.iter().map(|entry| Template::read(entry, format, &mut problems)).collect();
    let sizes = nesting::check(&mut templates, &mut problems);
    let mut maker = Maker::new((files, format), (&templates, &sizes), &mut raw);
    maker.top(&uses);
    let (mut structure, found, used) = maker.finish();
    problems.extend(found);
    problems.extend(pattern::expand(files, &mut raw, &mut structure));
    problems
        .extend(unused(&templates, &used).filter(|d| d.place().is_some_and(|at| at.file == main)));
    if any_error(&problems) {
        // warnings may follow from errors
        problems.retain(|problem| problem.severity == Severity::Error);
    }
    Expanded { raw, structure: Arc::new(structure), problems }
}

/// Warns about unused templates. A file of templates that is included is a selection to choose
/// from.
fn unused<'t>(
    templates: &'t [Template<'t>],
    used: &HashSet<usize>,
) -> impl Iterator<Item = Diagnostic> {
    let unused = templates.iter().enumerate().filter(|(position, _)| !used.contains(position));
    unused.map(|(_, template)| {
        Diagnostic::doubt(
            "netlist::unused_template",
            format!("nothing uses template `{}`", template.name()),
            &template.entry.key_span,
            format!("use it, `[use.name]` with `template = \"{}\"`, or remove it", template.name()),
        )
    })
}
