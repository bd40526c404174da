//! The studies of a netlist, found by their name.

use std::sync::Arc;

use lptn_netlist::Diagnostic;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;

/// The studies of one kind, and the messages if the wanted one cannot be found.
pub struct Studies {
    /// The word of their sections, `size` of `[size.fan]`.
    pub section: &'static str,
    /// The codes if there is none, and if several can be meant.
    pub codes: [&'static str; 2],
    /// The question of such a study, for the message.
    pub question: &'static str,
    /// A section to paste, with names of the file.
    pub example: fn(&Input) -> String,
}

impl Studies {
    /// The study of this name, or the only one.
    pub fn find<'a, S>(
        &self,
        input: &Input,
        (all, name_of): (&'a [S], fn(&S) -> &str),
        name: Option<&str>,
    ) -> Result<&'a S, Failure> {
        let (file, section) = (&input.text.name, self.section);
        let known = || all.iter().map(name_of);
        let list = || known().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let [none, several] = self.codes;
        let found = match name {
            Some(name) => all.iter().find(|study| name_of(study) == name),
            None => all.first().filter(|_| all.len() == 1),
        };
        if let Some(found) = found {
            return Ok(found);
        }
        let problem = match (name, all.is_empty()) {
            (None, true) => Diagnostic::error(
                none,
                format!("{file} has no [{section}.NAME]: {}", self.question),
            )
            .help(format!("add for example:\n\n{}", (self.example)(input))),
            (None, false) => {
                Diagnostic::error(several, format!("{file} has several [{section}.NAME]"))
                    .help(format!("name one of {}", list()))
            }
            (Some(name), empty) => {
                let problem = Diagnostic::error(none, format!("{file} has no [{section}.{name}]"));
                if empty {
                    problem
                } else {
                    problem.did_you_mean(name, known(), || format!("name one of {}", list()))
                }
            }
        };
        Err(Failure::new(Exit::Input, problem))
    }
}

/// The input with a warning for each of these parameters that `--set`, a case or a posterior gave a
/// value: a study of them replaces it. `study` is the section and name of the study.
pub(crate) fn with_replaced<'n>(
    mut input: Arc<Input>,
    (code, study): (&'static str, &str),
    names: impl Iterator<Item = &'n str>,
) -> Arc<Input> {
    let (network, given) = (&input.netlist.network, input.netlist.overrides());
    let is_given = |name: &&str| network.parameter(name).is_ok_and(|id| given.value(id).is_some());
    let warning = |name: &str| {
        let message = format!("the value given for `{name}` has no effect: [{study}] varies it");
        let help = format!("set it in the netlist without this study, or leave `{name}` out of it");
        Diagnostic::warning(code, message).help(help)
    };
    let found: Vec<Diagnostic> = names.filter(is_given).map(warning).collect();
    if !found.is_empty() {
        Arc::make_mut(&mut input).netlist.warnings.extend(found);
    }
    input
}
