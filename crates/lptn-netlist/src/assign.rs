//! `--set`: other values for parameters, checked like those of the file.

use std::collections::HashSet;

use lptn_network::{BuildError, Item, Network, ParameterError, ParameterId, Parameters, Value};
use lptn_network::{Field, Law};

use crate::describe::describe;
use crate::diagnostic::{Diagnostic, arrange};
use crate::file::{FileId, Span, on_borders};
use crate::netlist::{Netlist, Rejected};

/// What the text of the assignments is called in diagnostics.
const FILE: &str = "--set";

/// A parameter that was set, and where.
struct Assignment {
    id: ParameterId,
    name: String,
    span: Span,
}

impl Netlist {
    /// Gives parameters other values, written as `omega=5000rpm`. What was set before stays set. On an error
    /// nothing is changed.
    ///
    /// # Errors
    /// [`Rejected`] with every problem: a text that is no assignment, an unknown parameter, a wrong unit, or what
    /// the new values break in the network or in `[run]`.
    pub fn set(&mut self, assignments: &[String]) -> Result<(), Rejected> {
        let mut files = self.files.clone();
        let file = files.add(FILE, assignments.join("\n"));
        let mut new = self.assigned.clone();
        let result = self.assign(assignments, file, &mut new).and_then(|done| self.evaluate(&new, &done));
        match result {
            Ok((network, run)) => {
                (self.network, self.run, self.files, self.assigned) = (network, run, files, new);
                Ok(())
            }
            Err(mut diagnostics) => {
                arrange(&mut diagnostics);
                Err(Rejected { files, diagnostics, syntax: false })
            }
        }
    }

    fn assign(
        &self,
        assignments: &[String],
        file: FileId,
        new: &mut Parameters,
    ) -> Result<Vec<Assignment>, Vec<Diagnostic>> {
        let (mut done, mut problems): (Vec<Assignment>, _) = (Vec::new(), Vec::new());
        let mut start = 0;
        for text in assignments {
            let line = Span::new(file, start..start + text.len());
            start += text.len() + 1;
            match self.one(text, line, new) {
                Ok(this) => match done.iter().find(|other| other.id == this.id) {
                    Some(first) => problems.push(twice(&this, first)),
                    None => done.push(this),
                },
                Err(problem) => problems.push(problem),
            }
        }
        if problems.is_empty() { Ok(done) } else { Err(problems) }
    }

    fn one(&self, text: &str, line: Span, new: &mut Parameters) -> Result<Assignment, Diagnostic> {
        let Some((name, value)) = text.split_once('=') else {
            return Err(Diagnostic::error("netlist::bad_assignment", format!("`{text}` is no assignment"))
                .at(line, "`=` is missing")
                .help("write NAME=VALUE, for example `omega=5000rpm`"));
        };
        let written = name.trim();
        match new.set_text(written, value) {
            Ok(id) => Ok(Assignment { id, name: written.to_owned(), span: line }),
            Err(error) => Err(self.refused(&error, (name, value), line)),
        }
    }

    fn refused(&self, error: &ParameterError, (name, value): (&str, &str), line: Span) -> Diagnostic {
        let start = line.range.start;
        match error {
            ParameterError::Unknown(unknown) => {
                let place = Span::new(line.file, start..start + name.len());
                let message = format!("there is no parameter `{}`", unknown.name);
                let problem = Diagnostic::error("netlist::unknown_parameter", message).at(place, "");
                self.suggest_parameter(problem, unknown.suggestion.as_deref())
            }
            ParameterError::Unit { name: parameter, error, .. } => {
                let start = start + name.len() + 1;
                let part = on_borders(value, error.span.clone());
                let place = Span::new(line.file, start + part.start..start + part.end);
                let says = error.to_string();
                let joint = if says.starts_with("must be ") { " " } else { ": " };
                let message = format!("parameter `{parameter}`{joint}{says}");
                let problem = Diagnostic::error(error.code(), message).at(place, "");
                let problem = match self.network.parameter(parameter) {
                    Ok(id) => self.defined(problem, id),
                    Err(_) => problem,
                };
                match error.help() {
                    Some(help) => problem.help(help),
                    None => problem,
                }
            }
        }
    }

    fn suggest_parameter(&self, problem: Diagnostic, near: Option<&str>) -> Diagnostic {
        if let Some(near) = near {
            let problem = problem.help(format!("did you mean `{near}`?"));
            return match self.network.parameter(near) {
                Ok(id) => self.defined(problem, id),
                Err(_) => problem,
            };
        }
        let names: Vec<&str> = self.network.parameters().iter().map(|p| p.name.as_str()).take(12).collect();
        match names.as_slice() {
            [] => problem.help("this netlist has no parameters: give it a section [param]"),
            names => problem.help(format!("its parameters are {}", crate::vocabulary::list(names))),
        }
    }

    fn defined(&self, problem: Diagnostic, id: ParameterId) -> Diagnostic {
        match self.source_map.parameter(id) {
            Some(span) => problem.also(span.clone(), "its value in the netlist"),
            None => problem,
        }
    }

    fn evaluate(
        &self,
        new: &Parameters,
        done: &[Assignment],
    ) -> Result<(Network, Option<crate::RunSettings>), Vec<Diagnostic>> {
        let network = self
            .network
            .with(new)
            .map_err(|errors| errors.0.iter().map(|error| self.blame(error, done)).collect::<Vec<_>>())?;
        let run = self.plan.as_ref().map(|plan| plan.settings(&network)).transpose();
        let run = run.map_err(|problems| {
            problems.into_iter().map(|p| name_changed(p, done.iter())).collect::<Vec<_>>()
        })?;
        Ok((network, run))
    }

    /// The place in the netlist, and the assignments that the failing value depends on.
    fn blame(&self, error: &BuildError, done: &[Assignment]) -> Diagnostic {
        let problem = describe(error, &self.source_map);
        let Some((item, field)) = error.place() else { return name_changed(problem, done.iter()) };
        let uses = self.dependencies(item, field);
        let direct: Vec<&Assignment> = done.iter().filter(|a| uses.contains(&a.id)).collect();
        if direct.is_empty() {
            name_changed(problem, done.iter())
        } else {
            name_changed(problem, direct.into_iter())
        }
    }

    /// The parameters that a value depends on, straight or through others.
    fn dependencies(&self, item: Item, field: Field) -> HashSet<ParameterId> {
        let mut found = HashSet::new();
        let mut open: Vec<ParameterId> = match item {
            Item::Parameter(id) => vec![id],
            _ => self.values(item, field).into_iter().flat_map(|value| self.parameters_of(value)).collect(),
        };
        while let Some(id) = open.pop() {
            if found.insert(id) {
                let value = self.network.parameters().get(id.index()).map(|parameter| &parameter.value);
                open.extend(value.into_iter().flat_map(|value| self.parameters_of(value)));
            }
        }
        found
    }

    fn parameters_of(&self, value: &Value) -> Vec<ParameterId> {
        let slots = value.slots();
        let first = lptn_network::slot::PARAMETERS;
        let used = slots.into_iter().filter_map(|slot| slot.checked_sub(first));
        used.filter_map(|n| self.network.parameter_ids().nth(n as usize)).collect()
    }

    fn values(&self, item: Item, field: Field) -> Vec<&Value> {
        let network = &self.network;
        match item {
            Item::Node(id) => {
                let node = &network.nodes()[id.index()];
                let value = if field == Field::Initial { &node.initial } else { &node.capacity };
                value.iter().collect()
            }
            Item::Material(id) => {
                let material = &network.materials()[id.index()];
                let value = match field {
                    Field::Density => &material.density,
                    Field::SpecificHeat => &material.cp,
                    _ => &material.k,
                };
                value.iter().collect()
            }
            Item::Boundary(id) => vec![&network.boundaries()[id.index()].temperature],
            Item::Capacitor(id) => vec![&network.capacitors()[id.index()].capacity],
            Item::Source(id) => vec![&network.sources()[id.index()].power],
            Item::Limit(id) => {
                let limit = &network.limits()[id.index()];
                vec![if field == Field::Of { &limit.of } else { &limit.value }]
            }
            Item::Conductor(id) => match &network.conductors()[id.index()].law {
                Law::Resistance(value) | Law::Conductance(value) => vec![value],
                Law::Film { coefficient, area } => vec![coefficient, area],
            },
            Item::Parameter(_) => Vec::new(),
        }
    }
}

fn name_changed<'a>(problem: Diagnostic, changed: impl Iterator<Item = &'a Assignment>) -> Diagnostic {
    changed.fold(problem, |problem, a| problem.also(a.span.clone(), format!("`{}` is set here", a.name)))
}

fn twice(this: &Assignment, first: &Assignment) -> Diagnostic {
    Diagnostic::error("netlist::assigned_twice", format!("parameter `{}` is set twice", this.name))
        .at(this.span.clone(), "set again")
        .also(first.span.clone(), "first set here")
        .help("keep one of the two")
}
