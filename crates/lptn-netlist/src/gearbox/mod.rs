//! `[gearbox.NAME]`: a stage of gears as one block, written out as speeds, torques, meshes,
//! bearings and seals before anything is read.
//!
//! Speeds and torques become parameters, or signals if the input is one, by the names that the docs
//! list: `stage.sun.speed`, `stage.ring.torque`, `stage.force`. So only commands that ask for
//! gearboxes know of them.
//!
//! A gearbox is expanded after the templates. No crate below knows of gears, and sensitivities,
//! `--set`, fits and the expansion need no code for them. Everything that is written keeps the
//! place of the value that it follows from, so that messages show the user's line.

mod check;
mod declaration;
mod make;
mod member;
mod model;
mod parts;
mod shifted;
mod stage;
mod teeth;

use lptn_data::{Diagnostic, nearest};
use lptn_network::is_name;

pub(crate) use check::check;
pub(crate) use declaration::{AGAINST, GEARBOX, MEMBERS, ON, PARTS};
pub use member::{Arrangement, Member};
pub(crate) use model::Gears;
pub use model::{Gearbox, GearboxPart};
pub(crate) use teeth::doubts;

use crate::raw::{RawEntry, RawNetlist, RawValue};
use crate::template::Structure;
use make::Made;
use stage::Stage;

/// Replaces every gearbox by its elements.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &Structure,
    problems: &mut Vec<Diagnostic>,
) -> Gears {
    let entries = raw.take(GEARBOX.name);
    let mut gears = Gears::default();
    let mut read = |entry| {
        is_usable(entry, structure, problems).then(|| Stage::read(entry, structure, problems))?
    };
    let stages: Vec<Stage<'_>> = entries.iter().filter_map(&mut read).collect();
    problems.extend(driven_twice(&stages));
    let known: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
    let mut made: Vec<Made> = Vec::new();
    let mut open: Vec<&Stage<'_>> = stages.iter().collect();
    // a stage comes after the one that drives it
    while !open.is_empty() {
        let before = open.len();
        open.retain(|stage| {
            let driver = stage
                .driver
                .as_ref()
                .map(|(name, _)| made.iter().find(|other| other.gearbox.name == *name));
            match driver {
                Some(None) => true,
                driver => {
                    let new = Made::of((stage, driver.flatten()), raw, structure, problems);
                    made.push(new);
                    false
                }
            }
        });
        if open.len() == before {
            break;
        }
    }
    for stage in open {
        problems.extend(stage.driver.as_ref().and_then(|driver| no_driver(driver, &known)));
    }
    for one in made {
        one.entries.into_iter().for_each(|(section, entry)| raw.push(section, entry));
        gears.types.extend(one.types);
        gears.list.push(one.gearbox);
    }
    gears
}

/// Checks that a gearbox has a name that expressions can use.
fn is_usable(entry: &RawEntry, structure: &Structure, problems: &mut Vec<Diagnostic>) -> bool {
    let around = structure.instance_at(&entry.key_span);
    let own = around.and_then(|path| entry.key.strip_prefix(path)?.strip_prefix('.'));
    let usable = is_name(own.unwrap_or(&entry.key));
    if !usable {
        let message = format!("gearbox `{}` has an invalid name", entry.key);
        let help = "use letters, digits and `_`, and no digit first";
        problems.push(Diagnostic::wrong("network::bad_name", message, &entry.key_span, help));
    }
    usable
}

/// Error if the torque of an output goes to two stages.
fn driven_twice(stages: &[Stage<'_>]) -> Option<Diagnostic> {
    let drivers = || stages.iter().filter_map(|stage| stage.driver.as_ref());
    let (at, (name, second)) = drivers()
        .enumerate()
        .find(|(at, (name, _))| drivers().take(*at).any(|(earlier, _)| earlier == name))?;
    let (_, first) = drivers().take(at).find(|(earlier, _)| earlier == name)?;
    let message =
        format!("two stages are driven by `{name}`, and each would take its whole torque");
    let problem = Diagnostic::error("netlist::gear_driver", message)
        .at(second.span.clone(), "driven by it too")
        .also(first.span.clone(), "driven by it");
    Some(problem.help("give the second one the `speed` and `torque` that it takes of it"))
}

/// Error for a stage without a driver; none if the driver itself is wrong.
fn no_driver((name, at): &(String, &RawValue), known: &[&str]) -> Option<Diagnostic> {
    if known.contains(&name.as_str()) {
        let message = format!("no stage drives `{name}` in the end: stages drive each other");
        let help = "give the first stage `speed` and `torque`";
        return Some(Diagnostic::wrong("netlist::gear_driver", message, &at.span, help));
    }
    let message = format!("there is no gearbox `{name}`");
    let help = nearest(name, known.iter().copied(), "the gearboxes are");
    Some(Diagnostic::wrong("netlist::gear_driver", message, &at.span, help))
}
