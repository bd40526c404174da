//! `--set`: other values for parameters, checked like those of the file.

use foldhash::{HashSet, HashSetExt as _};
use lptn_data::{Diagnostic, FileId, Files, Rejected, Span, on_borders};
use lptn_network::{
    BuildError, Course, Field, GridFace, Item, Material, Network, ParameterError, ParameterId,
    Parameters, SignalId, Value,
};
use lptn_units::{Expression, UnitErrorKind};

use crate::RunSettings;
use crate::case::CaseStudy;
use crate::describe::describe;
use crate::gearbox;
use crate::netlist::Netlist;
use crate::template::wrong_path;
use crate::value_help::celsius_or_kelvin;

/// Name of the text of the assignments in diagnostics.
const FILE: &str = "--set";

/// A parameter that was set, with its place.
struct Assignment {
    id: ParameterId,
    name: String,
    span: Span,
}

impl Netlist {
    /// Gives parameters other values, written as `omega=5000rpm`. Earlier assignments stay. On an
    /// error nothing changes.
    ///
    /// # Errors
    /// [`Rejected`] with every problem: a text that is not an assignment, an unknown parameter, a
    /// wrong unit, or new values that do not suit the network or `[run]`.
    pub fn set(&mut self, assignments: &[String]) -> Result<(), Rejected> {
        if assignments.is_empty() {
            return Ok(()); // nothing is evaluated again
        }
        let mut files = self.files.clone();
        let file = files.add(FILE, assignments.join("\n"));
        let mut new = self.assigned.clone();
        let done = self.assign(assignments, file, &mut new);
        match done.and_then(|done| Ok((self.evaluate(&new, &done)?, done))) {
            Ok(((network, run), done)) => {
                let idle = |one: &Assignment| self.initial.as_ref()?.idle(&one.name, &one.span);
                self.written.extend(done.iter().filter_map(idle).collect::<Vec<_>>());
                (self.network, self.run, self.files, self.assigned) = (network, run, files, new);
                self.judge();
                Ok(())
            }
            Err(diagnostics) => Err(Rejected::arranged(files, diagnostics, 0)),
        }
    }

    /// Takes a load case: its signals, then its parameters, which are returned as
    /// [`Netlist::set`] takes them.
    ///
    /// # Errors
    /// All problems of its values.
    pub fn take_case(&mut self, case: &CaseStudy) -> Result<Vec<String>, Rejected> {
        let refused = |files: &Files, code, message: String| {
            let problem = Diagnostic::error(code, format!("case `{}`: {message}", case.name));
            Rejected::arranged(files.clone(), vec![problem.at(case.span.clone(), "")], 0)
        };
        let set = case.assignments(&self.network);
        let set = set.map_err(|error| refused(&self.files, error.code(), error.to_string()))?;
        self.network = case.with_signals(&self.network).map_err(|errors| {
            let first = errors.0.first();
            let code = first.map_or("network::not_finite", |first| first.code());
            refused(&self.files, code, errors.to_string())
        })?;
        self.assigned = self.network.adopted(&self.assigned);
        self.case = Some(case.name.clone());
        self.set(&set)?;
        Ok(set)
    }

    /// The name of the load case that was taken.
    pub fn case(&self) -> Option<&str> {
        self.case.as_deref()
    }

    /// The settings of `[run]` for a network with other parameters, if `--set` would take these:
    /// for loops over candidates.
    ///
    /// # Errors
    /// The problems that the values cause in `[run]` or in a gearbox.
    pub fn settings_of(&self, network: &Network) -> Result<Option<RunSettings>, Vec<Diagnostic>> {
        let run = self.plan.as_ref().map(|plan| plan.settings(network)).transpose()?;
        let gears = gearbox::check(&self.gearboxes, network, &self.source_map);
        if gears.is_empty() { Ok(run) } else { Err(gears) }
    }

    /// Checks that the gears of a network with other parameters mesh, as `--set` does.
    ///
    /// # Errors
    /// The first stage whose wheels cannot be assembled.
    pub fn meshes(&self, network: &Network) -> Result<(), Box<Diagnostic>> {
        let first = gearbox::check(&self.gearboxes, network, &self.source_map).into_iter().next();
        first.map_or(Ok(()), |problem| Err(Box::new(problem)))
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
        let bad = |is: &str, label: &str| {
            Diagnostic::error("netlist::bad_assignment", format!("`{text}` {is}"))
                .at(line.clone(), label)
                .help("write NAME=VALUE, for example `omega=5000rpm`")
        };
        let (name, value) =
            text.split_once('=').ok_or_else(|| bad("is not an assignment", "`=` is missing"))?;
        let written = name.trim();
        if written.is_empty() {
            return Err(bad("names no parameter", "a name is missing before `=`"));
        }
        if let Some(given) = self.gearboxes.iter().find_map(|g| g.given_for(written)) {
            let message = format!("`{written}` follows from other values of its gearbox");
            let place = Span::new(line.file, line.range.start..line.range.start + name.len());
            let help = format!("set {given}");
            return Err(Diagnostic::wrong("netlist::gear_follows", message, &place, help));
        }
        match new.set_text(written, value) {
            Ok(id) => Ok(Assignment { id, name: written.to_owned(), span: line }),
            Err(error) => Err(self.refused(&error, (name, value), line)),
        }
    }

    fn refused(
        &self,
        error: &ParameterError,
        (name, value): (&str, &str),
        line: Span,
    ) -> Diagnostic {
        let start = line.range.start;
        match error {
            ParameterError::Unknown(unknown) => {
                let place = Span::new(line.file, start..start + name.len());
                if let Some(wrong) = self.structure.wrong_path(&unknown.name) {
                    return wrong_path(("--set", &unknown.name), place, wrong);
                }
                let message = format!("there is no parameter `{}`", unknown.name);
                let problem =
                    Diagnostic::error("netlist::unknown_parameter", message).at(place, "");
                if let Some(id) = self.signal(&unknown.name) {
                    let problem = problem.also(self.source_map.name(Item::Signal(id)), "a signal");
                    return problem.help(
                        "a signal changes with time: scale it with a parameter, and set that",
                    );
                }
                if let Ok(item) = self.network.item(&unknown.name) {
                    let problem = problem.also(self.source_map.name(item), item.word());
                    return problem.help(
                        "only parameters can be set: write its value into [param], and the name \
                         of the parameter here and in the element",
                    );
                }
                if let Some((place, help)) = self.parameter_for(name.trim()) {
                    return problem.also(place, "its value in the netlist").help(help);
                }
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
                if matches!(error.kind, UnitErrorKind::AbsoluteWanted { .. }) {
                    let line = |text: &str| format!("`--set \"{}={text}\"`", name.trim());
                    if let Some(help) = celsius_or_kelvin(value, line, "") {
                        return problem.help(help);
                    }
                }
                if self.is_expression(value) {
                    return problem.help(
                        "`--set` takes a number or a quantity, not an expression: `omega=5000rpm`",
                    );
                }
                let own = self.in_its_unit(parameter, value, error);
                problem.help(own.or_else(|| error.help()))
            }
        }
    }

    fn signal(&self, name: &str) -> Option<SignalId> {
        let signals = self.network.signals();
        self.network.signal_ids().find(|id| signals[id.index()].name == name)
    }

    /// True if the text is an expression of parameters, which a netlist may contain but an
    /// assignment may not.
    fn is_expression(&self, text: &str) -> bool {
        let is_parameter = |name: &str| self.network.parameter(name).is_ok();
        Expression::parse(text).is_ok_and(|e| e.names().iter().any(|(name, _)| is_parameter(name)))
    }

    fn suggest_parameter(&self, problem: Diagnostic, near: Option<&str>) -> Diagnostic {
        if let Some(near) = near {
            let problem = problem.help(format!("did you mean `{near}`?"));
            return match self.network.parameter(near) {
                Ok(id) => self.defined(problem, id),
                Err(_) => problem,
            };
        }
        let names: Vec<&str> =
            self.network.parameters().iter().map(|p| p.name.as_str()).take(12).collect();
        match names.as_slice() {
            [] => problem.help("this netlist has no parameters: give it a section [param]"),
            names => problem.help(format!("its parameters are {}", lptn_data::list(names))),
        }
    }

    fn defined(&self, problem: Diagnostic, id: ParameterId) -> Diagnostic {
        problem.also(self.source_map.parameter(id), "its value in the netlist")
    }

    /// The network with other parameters, and the settings of its run.
    pub(crate) fn evaluated(
        &self,
        new: &Parameters,
    ) -> Result<(Network, Option<RunSettings>), Vec<Diagnostic>> {
        self.evaluate(new, &[])
    }

    fn evaluate(
        &self,
        new: &Parameters,
        done: &[Assignment],
    ) -> Result<(Network, Option<RunSettings>), Vec<Diagnostic>> {
        let network = self.network.with(new).map_err(|errors| {
            errors.0.iter().map(|error| self.blame(error, done)).collect::<Vec<_>>()
        })?;
        let run = self.plan.as_ref().map(|plan| plan.settings(&network)).transpose();
        let run = run.map_err(|problems| {
            problems.into_iter().map(|p| name_changed(p, done.iter())).collect::<Vec<_>>()
        })?;
        let gears = gearbox::check(&self.gearboxes, &network, &self.source_map);
        match gears.is_empty() {
            true => Ok((network, run)),
            false => Err(gears.into_iter().map(|p| name_changed(p, done.iter())).collect()),
        }
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

    /// The parameters that a value depends on, directly or through others.
    fn dependencies(&self, item: Item, field: Field) -> HashSet<ParameterId> {
        let mut found = HashSet::new();
        let mut open: Vec<ParameterId> = match item {
            Item::Parameter(id) => vec![id],
            _ => self
                .values(item, field)
                .into_iter()
                .flat_map(|value| self.parameters_of(value))
                .collect(),
        };
        while let Some(id) = open.pop() {
            if found.insert(id) {
                let value =
                    self.network.parameters().get(id.index()).map(|parameter| &parameter.value);
                open.extend(value.into_iter().flat_map(|value| self.parameters_of(value)));
            }
        }
        found
    }

    /// The parameters in a value, those of the signals it reads included.
    fn parameters_of(&self, value: &Value) -> Vec<ParameterId> {
        let network = &self.network;
        let (mut slots, mut next) = (value.slots(), 0);
        while let Some(&slot) = slots.get(next) {
            next += 1;
            let read = |id: &SignalId| (0..2).any(|k| network.signal_slot(*id) + k == slot);
            let signal =
                network.signal_ids().find(read).and_then(|id| network.signals().get(id.index()));
            if let Some(Course::Expression(value)) = signal.map(|signal| &signal.course) {
                let more: Vec<u32> =
                    value.slots().into_iter().filter(|s| !slots.contains(s)).collect();
                slots.extend(more);
            }
        }
        network.parameter_ids().filter(|id| slots.contains(&network.parameter_slot(*id))).collect()
    }

    fn values(&self, item: Item, field: Field) -> Vec<&Value> {
        let network = &self.network;
        match item {
            Item::Node(id) => {
                let node = &network.nodes()[id.index()];
                let value = match field {
                    Field::Initial => &node.initial,
                    Field::CharacteristicLength => &node.length,
                    _ => &node.capacity,
                };
                value.iter().collect()
            }
            Item::Material(id) => material_values(&network.materials()[id.index()], field),
            Item::Fluid(id) => {
                let fluid = &network.fluids()[id.index()];
                if field == Field::Density {
                    fluid.density.iter().collect()
                } else {
                    vec![&fluid.cp]
                }
            }
            Item::Boundary(id) => vec![&network.boundaries()[id.index()].temperature],
            Item::State(id) => {
                let state = &network.states()[id.index()];
                state.start.iter().chain(state.bounds.iter().flatten()).collect()
            }
            Item::Control(id) => {
                let thermostat = network.thermostat(id).into_iter();
                thermostat.flat_map(|t| [&t.on, &t.off, &t.min_dwell]).collect()
            }
            Item::Capacitor(id) => vec![&network.capacitors()[id.index()].capacity],
            Item::Source(id) => network.sources()[id.index()].law.values().iter().collect(),
            Item::Limit(id) => {
                let limit = &network.limits()[id.index()];
                vec![if field == Field::Of { &limit.of } else { &limit.value }]
            }
            Item::Conductor(id) => {
                // a conductance out of range may result from any of them
                network.conductors()[id.index()].law.values().iter().collect()
            }
            Item::Signal(id) => match &network.signals()[id.index()].course {
                Course::Expression(value) => vec![value],
                _ => Vec::new(),
            },
            Item::Grid(id) => {
                let grid = &network.grids()[id.index()];
                let lengths = grid.shape.values().into_iter();
                lengths.chain(&grid.conductivity).chain(&grid.initial).collect()
            }
            Item::FacePath(id) => {
                let joint = &network.face_paths()[id.index()];
                // the area of the face depends on the size of its grid
                let grid = |at: GridFace| network.grids()[at.grid.index()].shape.values();
                joint.area.iter().chain(joint.faces().flat_map(grid)).collect()
            }
            Item::Patch(patch) => network.grids()[patch.at.grid.index()].values_of_patch(patch),
            Item::Report(id) => vec![&network.reports()[id.index()].value],
            Item::Parameter(_) | Item::Table(_) | Item::Value(_) => Vec::new(),
        }
    }
}

fn material_values(material: &Material, field: Field) -> Vec<&Value> {
    let melting = material.melting.as_ref();
    let value = match field {
        Field::Density => material.density.as_ref(),
        Field::SpecificHeat => material.cp.as_ref(),
        Field::AxialConductivity => material.k_axis.as_ref(),
        Field::Fill => material.winding.as_ref().map(|winding| &winding.fill),
        Field::EnamelFill => material.winding.as_ref().map(|winding| &winding.enamel_fill),
        Field::Solidus => melting.map(|m| &m.solidus),
        Field::LatentHeat => melting.map(|m| &m.heat),
        Field::Liquidus => return melting.map_or_else(Vec::new, |m| vec![&m.solidus, &m.liquidus]),
        _ => material.k.as_ref(),
    };
    value.into_iter().collect()
}

fn name_changed<'a>(
    problem: Diagnostic,
    changed: impl Iterator<Item = &'a Assignment>,
) -> Diagnostic {
    changed.fold(problem, |problem, a| {
        problem.also(a.span.clone(), format!("`{}` is set here", a.name))
    })
}

fn twice(this: &Assignment, first: &Assignment) -> Diagnostic {
    Diagnostic::error("netlist::assigned_twice", format!("parameter `{}` is set twice", this.name))
        .at(this.span.clone(), "set again")
        .also(first.span.clone(), "first set here")
        .help("keep one of the two")
}
