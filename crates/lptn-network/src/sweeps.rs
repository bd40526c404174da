//! Values that read temperatures, sampled before a step carries a temperature past their bends: the
//! twin of [`Network::curves`](crate::Network::curves).

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use lptn_laws::Formula;
use lptn_units::{Degree, Program, Traced, Trend};

use crate::evaluation::Evaluation;
use crate::id::{ConductorId, Field, Item, SourceId};
use crate::input_error::InputError;
use crate::law::At;
use crate::network::Network;
use crate::network::flow::{name, place};
use crate::parts::dependence::Dependence;
use crate::parts::layout::Holds;
use crate::slot;
use crate::value::Value;

/// An expression that drives a heat flow, or decides when something switches, and is not linear in
/// the temperatures that it reads.
#[derive(Clone, Debug)]
pub struct Reader {
    program: Arc<Program>,
    reads: Vec<(u32, Read)>,
    /// Readers of one number are alike if it is the only thing that changes in their expression.
    family: Option<usize>,
}

/// A number that an expression makes of temperatures, by their vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Read {
    One(usize),
    Mean(usize, usize),
    Difference(usize, usize),
}

impl Read {
    fn of(self, temperatures: &[f64]) -> f64 {
        match self {
            Self::One(a) => temperatures[a],
            Self::Mean(a, b) => 0.5 * (temperatures[a] + temperatures[b]),
            Self::Difference(a, b) => temperatures[a] - temperatures[b],
        }
    }
}

impl Reader {
    /// Index of the group of readers that turn alike, if it reads one number of temperatures and
    /// nothing else that changes.
    pub fn family(&self) -> Option<usize> {
        self.family
    }

    /// The first number that it reads, in K, at these temperatures of all vertices.
    pub fn number(&self, temperatures: &[f64]) -> f64 {
        self.reads[0].1.of(temperatures)
    }

    /// True if `holds` is true of all vertices that it reads.
    pub fn reads_only(&self, holds: impl Fn(usize) -> bool) -> bool {
        self.reads.iter().all(|(_, read)| match *read {
            Read::One(a) => holds(a),
            Read::Mean(a, b) | Read::Difference(a, b) => holds(a) && holds(b),
        })
    }
}

/// True if the form of an expression that reads one number shows that it never turns.
fn goes_one_way(program: &Program, reads: &[(u32, Read)]) -> bool {
    let &[(slot, read)] = reads else { return false };
    let own = match read {
        Read::Difference(..) => Trend { low: f64::NEG_INFINITY, ..Trend::VARIABLE },
        Read::One(_) | Read::Mean(..) => Trend::VARIABLE,
    };
    let trend = program.trend(&|other| if other == slot { own } else { Trend::HELD });
    trend.rises || trend.falls
}

impl Network {
    /// The nonlinear expressions that may turn while temperatures go one way.
    pub fn readers(&self) -> Vec<Reader> {
        let mut readers = Vec::new();
        for (item, field, value) in self.inputs() {
            let Some(dependence) = self.dependence_of(item) else { continue };
            // a path that takes the mean of a property reads it at both ends
            let ends = match (item, field) {
                (Item::Conductor(id), Field::Law(law)) if law.along && self.along(id).is_some() => {
                    &[Some(0), Some(1)][..]
                }
                _ => &[None],
            };
            for (program, end) in
                value.programs().into_iter().flat_map(|p| ends.iter().map(move |end| (p, *end)))
            {
                readers.extend(self.reader(program, &dependence, end));
            }
        }
        // comparisons that switch are sampled too
        let comparing = self.switches().iter().filter_map(|switch| {
            let of = self.dependence_of(switch.item)?;
            self.reader(&switch.difference, of.as_ref(), None)
        });
        readers.extend(comparing);
        self.group(&mut readers);
        readers
    }

    /// Groups the readers that turn alike.
    fn group(&self, readers: &mut [Reader]) {
        let mut families = BTreeMap::new();
        for reader in readers.iter_mut() {
            if self.stands_still_beside(reader) {
                let key = (Arc::as_ptr(&reader.program).addr(), reader.reads[0].0);
                let next = families.len();
                reader.family = Some(*families.entry(key).or_insert(next));
            }
        }
    }

    fn dependence_of(&self, item: Item) -> Option<Cow<'_, Dependence>> {
        match item {
            Item::Conductor(id) => Some(self.parts.dependence(id)),
            Item::Source(id) => Some(Cow::Borrowed(&self.parts.source_dependence[id.index()])),
            _ => None,
        }
    }

    /// `T` is the temperature of `end`, or without it the mean of both ends.
    fn reader(
        &self,
        program: &Arc<Program>,
        of: &Dependence,
        end: Option<usize>,
    ) -> Option<Reader> {
        let vertex = |position: usize| of.vertices.get(position).map(|vertex| *vertex as usize);
        let read = |slot: u32| {
            if let Some((_, position)) = of.named.iter().find(|(named, _)| *named == slot) {
                return vertex(*position).map(Read::One);
            }
            let (from, to) = (vertex(0)?, vertex(1)?);
            match slot {
                slot::OWN if end.is_some() => vertex(end?).map(Read::One),
                slot::FROM => Some(Read::One(from)),
                slot::TO => Some(Read::One(to)),
                slot::MEAN | slot::OWN => Some(Read::Mean(from, to)),
                slot::DIFFERENCE => Some(Read::Difference(from, to)),
                _ => None,
            }
        };
        let slots = program.slots();
        let reads: Vec<(u32, Read)> =
            slots.into_iter().filter_map(|slot| Some((slot, read(slot)?))).collect();
        let straight = reads.iter().all(|(slot, _)| program.degree_in(*slot) <= Degree::Affine);
        let narrow = !reads.is_empty() && program.may_be_narrow() && !straight;
        let narrow = narrow && !goes_one_way(program, &reads);
        narrow.then(|| Reader { program: Arc::clone(program), reads, family: None })
    }

    fn stands_still_beside(&self, reader: &Reader) -> bool {
        let other = |slot: &u32| *slot != reader.reads[0].0;
        let fixed = |slot: u32| matches!(self.parts.layout.holds(slot), Holds::Parameter(_));
        reader.reads.len() == 1
            && reader.program.slots().iter().filter(|s| other(s)).all(|s| fixed(*s))
    }

    /// Turns of an expression while the temperatures of all vertices go from one state to another,
    /// in K: see [`Program::turns`]. Everything else that it reads is taken from `scope`.
    pub fn turns(
        &self,
        reader: &Reader,
        scope: &Evaluation,
        [from, to]: [&[f64]; 2],
        least: f64,
    ) -> Vec<[f64; 2]> {
        let way = |slot: u32| match reader.reads.iter().find(|(read, _)| *read == slot) {
            Some((_, read)) => [read.of(from), read.of(to)],
            None => [scope.slot(slot); 2],
        };
        reader.program.turns(&way, least)
    }

    /// The same for the first number that it reads, which moves between two values in K.
    pub fn turns_between(
        &self,
        reader: &Reader,
        scope: &Evaluation,
        between: [f64; 2],
        least: f64,
    ) -> Vec<[f64; 2]> {
        let own = reader.reads[0].0;
        let way = |slot: u32| if slot == own { between } else { [scope.slot(slot); 2] };
        reader.program.turns(&way, least)
    }

    /// A number for the pieces of tables, kinks and laws that the heat of a conductor goes through
    /// at these temperatures of all vertices in K; 0 if there is only one.
    ///
    /// # Errors
    /// As [`Network::exchange`].
    pub fn pieces_of_exchange(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<u64, InputError> {
        let conductor = &self.conductors()[id.index()];
        let dependence = self.parts.dependence(id);
        if let Some(pieces) = self.plain_pieces(id, scope, temperatures) {
            return Ok(pieces);
        }
        let at = |k: usize| Traced::variable(temperatures[dependence.vertices[k] as usize]);
        let result = {
            let (slots, stack) = scope.traced();
            place(slots, &dependence, &at);
            self.received(conductor, At::path((slots, stack), self.along(id)), at(0), at(1))
        };
        let [from, to] =
            result.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))?;
        let mut trace = from.trace().wrapping_add(to.trace());
        // the property that a path takes the mean of bends where it does at either end
        if let Some(value) = conductor.law.along().filter(|_| self.along(id).is_some()) {
            let (slots, stack) = scope.traced();
            for end in [at(0), at(1)] {
                slots[slot::OWN as usize] = end;
                trace = trace.wrapping_add(value.on(slots, stack).map_or(0, |k| k.trace()));
            }
        }
        Ok(trace)
    }

    /// The same for a law that is a product of its values, whose pieces are those of their
    /// expressions: these are read without the heat.
    fn plain_pieces(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Option<u64> {
        let law = &self.conductors()[id.index()].law;
        let dependence = self.parts.dependence(id);
        let product =
            matches!(law.formula(), Formula::Resistance | Formula::Conductance | Formula::Film);
        if !product || !dependence.named.is_empty() || self.along(id).is_some() {
            return None;
        }
        let at = |k: usize| temperatures[dependence.vertices[k] as usize];
        let (slots, stack) = scope.plain();
        place(slots, &dependence, &at);
        let mut number = 0_u64;
        for value in law.values() {
            number = number.rotate_left(7);
            number ^= match value {
                Value::Constant(_) => 0,
                Value::Expression(program) => program.pieces(slots, stack, slot::is_of_path)?,
                Value::Product(_) => return None,
            };
        }
        Some(number)
    }

    /// The same for the heat of a source.
    ///
    /// # Errors
    /// As [`Network::source_heat`].
    pub fn pieces_of_source(
        &self,
        id: SourceId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<u64, InputError> {
        let source = &self.sources()[id.index()];
        let dependence = &self.parts.source_dependence[id.index()];
        let at = |k: usize| Traced::variable(temperatures[dependence.vertices[k] as usize]);
        let result = {
            let (slots, stack) = scope.traced();
            name(slots, dependence, &at);
            At::new((slots, stack)).heat(&source.law)
        };
        let heat = result.map_err(|failed| self.failed(Item::Source(id), failed, scope))?;
        Ok(heat.trace())
    }
}
