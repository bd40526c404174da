//! `[param]`: values in the order in which they depend on each other.

use foldhash::HashMap;
use lptn_data::{Diagnostic, Span};
use lptn_network::{Field, Item};
use lptn_units::{Quantity, Type};

use crate::fields::Owner;
use crate::format::{Role, SectionDeclaration};
use crate::names::ValueKind;
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind};

use crate::work::Elaboration;

pub(crate) const PARAM: SectionDeclaration = SectionDeclaration {
    name: ValueKind::Parameter.section(),
    sentence: "Quantities, numbers, or expressions over other parameters, each with its own name.",
    role: Role::Value,
    example: "\"0.3 K/W\"",
    ..SectionDeclaration::NEW
};

/// A parameter or signal before its names are resolved.
pub(crate) struct Pending<'a> {
    pub(crate) entry: &'a RawEntry,
    pub(crate) owner: Owner<'a>,
    /// `None` if it could not be read, or is not an expression.
    pub(crate) text: Option<Text>,
    /// Those of its kind that it uses, as positions in the file.
    uses: Vec<usize>,
}

impl<'a> Elaboration<'a> {
    /// Gives all parameters to the builder.
    pub(crate) fn parameters(&mut self) {
        for mut pending in self.in_order(ValueKind::Parameter, "netlist::parameter_cycle") {
            self.parameter(&mut pending);
        }
    }

    /// The entries of a section, each after those that it uses. Cycles are reported, and their
    /// members have no text.
    pub(crate) fn in_order(&mut self, kind: ValueKind, code: &'static str) -> Vec<Pending<'a>> {
        let entries = self.elements(kind.section());
        let positions: HashMap<&str, usize> =
            entries.iter().enumerate().map(|(i, entry)| (entry.key.as_str(), i)).collect();
        let mut pending: Vec<Option<Pending<'a>>> =
            entries.iter().map(|entry| Some(self.pending(kind, entry, &positions))).collect();
        let (order, cycles) = order(&pending);
        for cycle in &cycles {
            let members: Vec<&Pending<'_>> =
                cycle.iter().filter_map(|&i| pending[i].as_ref()).collect();
            self.problems.push(describe_cycle(kind.word(), code, &members));
            for &member in cycle {
                if let Some(pending) = &mut pending[member] {
                    pending.text = None;
                    self.names.fail(&pending.entry.key);
                }
            }
        }
        order.into_iter().filter_map(|i| pending[i].take()).collect()
    }

    fn pending(
        &mut self,
        kind: ValueKind,
        entry: &'a RawEntry,
        positions: &HashMap<&str, usize>,
    ) -> Pending<'a> {
        let owner = Owner::element(kind.word(), &entry.key);
        if let (RawKind::Table(_), true) = (&entry.value.kind, kind == ValueKind::Signal) {
            // its points are read later
            return Pending { entry, owner, text: None, uses: Vec::new() };
        }
        let place = Place { owner: &owner, key: "", raw: &entry.value };
        let wanted = self.names.structure.type_of(&entry.key).cloned();
        let ty = self.type_of(&entry.key);
        let text = match place.kelvin_for(ty).map_or_else(|| self.names.text(place, ty), Err) {
            Ok(text) => Some(text),
            Err(problem) => {
                self.problems.push(of_type(problem, wanted.as_ref()));
                None
            }
        };
        let mut uses = Vec::new();
        if let Some(Text::Expression(expression)) = &text {
            uses.extend(
                expression
                    .names()
                    .iter()
                    .filter_map(|(name, _)| positions.get(name.as_str()).copied()),
            );
        }
        Pending { entry, owner, text, uses }
    }

    /// The type that a value has to have because of the template or gearbox that it belongs to.
    pub(crate) fn type_of(&self, name: &str) -> Option<Type> {
        let of_template = self.names.structure.type_of(name).map(|(ty, _)| *ty);
        of_template.or_else(|| self.gears.types.get(name).copied())
    }

    fn parameter(&mut self, pending: &mut Pending<'_>) {
        let entry = pending.entry;
        let place = Place { owner: &pending.owner, key: "", raw: &entry.value };
        let ty = self.names.structure.type_of(&entry.key).cloned();
        let wanted = Wanted { ty: self.type_of(&entry.key), ..Wanted::parameter() };
        let before = self.problems.len();
        let mut given = pending.text.take().and_then(|text| self.resolve(place, text, wanted));
        if let Some(Given::Quantity(quantity)) = &mut given {
            // as for `--set`
            let of_template = self.names.structure.deviation_of(&entry.key);
            quantity.deviation = quantity.deviation.or(of_template);
        }
        if let Some(problem) = self.problems.get_mut(before) {
            *problem = of_type(problem.clone(), ty.as_ref());
        }
        if given.is_none() {
            self.names.fail(&entry.key);
        }
        // the name is checked even if the value is wrong
        let stand_in = || Quantity { value: 1.0, deviation: None, ty: Type::SCALAR }.into();
        let id =
            self.builder.parameter(&entry.key, given.map_or_else(stand_in, |given| given.input()));
        self.map.insert(Item::Parameter(id), Field::Name, entry.key_span.clone());
        self.map.value(Item::Parameter(id), Field::Value, &entry.value);
    }
}

/// Adds the place in the template that gives a parameter its type.
fn of_type(problem: Diagnostic, wanted: Option<&(Type, Span)>) -> Diagnostic {
    match wanted {
        Some((_, span)) if problem.code == "units::dimension" => {
            problem.also(span.clone(), "as in the template")
        }
        _ => problem,
    }
}

/// Positions in file order, but each parameter after those that it uses; and the cycles.
fn order(pending: &[Option<Pending<'_>>]) -> (Vec<usize>, Vec<Vec<usize>>) {
    let mut state = vec![State::New; pending.len()];
    let (mut order, mut cycles) = (Vec::with_capacity(pending.len()), Vec::new());
    for start in 0..pending.len() {
        // a chain may be as long as the file: no recursion
        let mut path = vec![(start, 0)];
        while let Some((at, next)) = path.last_mut() {
            let at = *at;
            if *next == 0 && state[at] != State::New {
                path.pop();
                continue;
            }
            state[at] = State::Open;
            let Some(&used) = pending[at].as_ref().and_then(|p| p.uses.get(*next)) else {
                state[at] = State::Done;
                order.push(at);
                path.pop();
                continue;
            };
            *next += 1;
            match state[used] {
                State::New => path.push((used, 0)),
                State::Open => cycles.push(cycle(&path, used)),
                State::Done => {}
            }
        }
    }
    (order, cycles)
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

/// The part of the path from `first` on.
fn cycle(path: &[(usize, usize)], first: usize) -> Vec<usize> {
    path.iter().map(|(at, _)| *at).skip_while(|at| *at != first).collect()
}

fn describe_cycle(kind: &str, code: &'static str, cycle: &[&Pending<'_>]) -> Diagnostic {
    let name = |p: &&Pending<'_>| format!("`{}`", p.entry.key);
    let mut chain: Vec<String> = cycle.iter().map(name).collect();
    chain.extend(cycle.first().map(name));
    let message = match cycle {
        [one] => format!("{kind} {} is defined by itself", name(one)),
        _ => format!("{kind}s are defined by each other: {}", chain.join(" -> ")),
    };
    let members = cycle.iter().zip(chain.iter().skip(1));
    let uses =
        members.map(|(member, next)| (member.entry.value.span.clone(), format!("uses {next}")));
    Diagnostic::error(code, message).places(uses).help("give one of them its own value")
}
