//! A linear network whose parameters change again and again: only the numbers that depend on them
//! are evaluated, with the same checks.

use lptn_units::Degree;

use crate::evaluation::Evaluation;
use crate::id::{CapacitorId, ConductorId, Field, Item, NodeId, ParameterId};
use crate::law::At;
use crate::network::Network;
use crate::numbers::{Work, range_of};
use crate::parts::layout::{Followed, Holds};
use crate::value::Value;
use lptn_laws::Range;

/// A linear network of nodes with constant numbers, for one candidate after the other.
///
/// There is one only for networks of constant conductances without grids, fluids and switches,
/// whose materials, limits and signals do not depend on the changed parameters. If a candidate is
/// refused, [`Network::with`] explains why.
pub struct Variants<'a> {
    work: Work<'a>,
    network: &'a Network,
    /// The parameters that change, and those that follow from them, in the order of evaluation.
    changed: Vec<ParameterId>,
    following: Vec<usize>,
    /// The numbers that follow from them.
    conductors: Vec<usize>,
    nodes: Vec<usize>,
    fixed: Vec<(Item, Field, &'a Value, Range)>,
    /// Conductance of each conductor in W/K.
    pub conductance: Vec<f64>,
    /// Heat capacity of each node in J/K; 0 for a massless one.
    pub capacity: Vec<f64>,
    /// Temperature of each node at the start in K; NaN for a massless one.
    pub initial: Vec<f64>,
}

/// The slots that change.
struct Touched {
    slots: Vec<bool>,
}

impl Touched {
    fn by(&self, value: &Value) -> bool {
        value.slots().into_iter().any(|slot| self.slots[slot as usize])
    }
}

impl Network {
    /// The candidates of this network in which these parameters differ; `None` if it is not of the
    /// required kind.
    pub fn variants(&self, changed: &[ParameterId]) -> Option<Variants<'_>> {
        let parts = &*self.parts;
        let plain = parts.grids.is_empty()
            && parts.fluids.is_empty()
            && parts.face_paths.is_empty()
            && self.first_nonlinear().is_none()
            && !self.has_events()
            && parts.nodes.iter().all(|node| node.length.is_none());
        let conductance: Option<Vec<f64>> =
            self.conductor_ids().map(|id| self.conductance(id)).collect();
        let (conductance, touched) = (conductance.filter(|_| plain)?, self.touched(changed));
        if self.touches_more(&touched) {
            return None;
        }
        let mut work = Work { parts, scope: self.evaluation(), errors: Vec::new() };
        work.scope.set_time(0.0, 0.0);
        let count = parts.conductors.len();
        let own = |i: &usize| parts.conductors[*i].law.values().iter().any(|v| touched.by(v));
        let following = (0..parts.parameters.len()).filter(|i| {
            let id = ParameterId::from_len(*i);
            touched.slots[parts.layout.parameter(id) as usize] && !changed.contains(&id)
        });
        Some(Variants {
            network: self,
            following: following.collect(),
            conductors: (0..count).filter(own).collect(),
            nodes: self.touched_nodes(&touched),
            fixed: self.touched_inputs(&touched),
            changed: changed.to_vec(),
            conductance,
            capacity: self.numbers.capacity.clone(),
            initial: self.numbers.initial.clone(),
            work,
        })
    }

    /// The slots of the parameters that change, and of those that follow from them. A parameter
    /// that is given does not follow.
    fn touched(&self, changed: &[ParameterId]) -> Touched {
        let parts = &*self.parts;
        let mut touched = Touched { slots: vec![false; parts.layout.len()] };
        for (i, parameter) in parts.parameters.iter().enumerate() {
            let id = ParameterId::from_len(i);
            let follows = !self.numbers.given[i] && touched.by(&parameter.value);
            if changed.contains(&id) || follows {
                touched.slots[parts.layout.parameter(id) as usize] = true;
            }
        }
        touched
    }

    /// True if a value follows from parameters that change.
    pub fn depends_on(&self, value: &Value, changed: &[ParameterId]) -> bool {
        self.touched(changed).by(value)
    }

    /// True if the changed parameters affect more than conductances, capacities, starts and the
    /// height of inputs: substances, limits, signals, or the times at which an input bends.
    fn touches_more(&self, touched: &Touched) -> bool {
        let parts = &*self.parts;
        let substances = parts.materials.iter().flat_map(|m| {
            let melting = m.melting.iter().flat_map(|m| [&m.solidus, &m.liquidus, &m.heat]);
            m.density.iter().chain(&m.cp).chain(&m.k).chain(&m.k_axis).chain(melting)
        });
        let limits = parts.limits.iter().flat_map(|limit| [&limit.of, &limit.value]);
        let signals = self.inputs().filter(|(item, ..)| matches!(item, Item::Signal(_)));
        let ordered = parts.sources.iter().map(|source| &source.law);
        let ordered = ordered.filter(|law| !law.formula().declaration().ordered.is_empty());
        let ordered = ordered.flat_map(|law| law.values());
        let mut values =
            substances.chain(ordered).chain(limits).chain(signals.map(|(_, _, value)| value));
        values.any(|value| touched.by(value)) || self.bends_move(touched)
    }

    /// True if a time at which an input bends may follow from the changed parameters, or if an
    /// input that depends on time calls a table.
    fn bends_move(&self, touched: &Touched) -> bool {
        let timed = self.inputs().filter(|(_, _, value)| self.parts.reads(value).time);
        let mut programs = timed.flat_map(|(_, _, value)| value.programs());
        programs.any(|program| {
            let inner = program.comparisons().iter().chain(program.kinks());
            let moves = inner.flat_map(|inner| inner.slots());
            let mut moves = moves.filter(|slot| touched.slots[*slot as usize]);
            moves.next().is_some() || !program.table_calls().is_empty()
        })
    }

    fn touched_nodes(&self, touched: &Touched) -> Vec<usize> {
        let parts = &*self.parts;
        let node = |i: &usize| {
            let node = &parts.nodes[*i];
            let pieces = parts.capacitors.iter().filter(|piece| piece.node.index() == *i);
            let mut values = node
                .capacity
                .iter()
                .chain(&node.initial)
                .chain(pieces.map(|piece| &piece.capacity));
            values.any(|value| touched.by(value))
        };
        (0..parts.nodes.len()).filter(node).collect()
    }

    /// The constant inputs that follow from the changed parameters, with their ranges.
    fn touched_inputs(&self, touched: &Touched) -> Vec<(Item, Field, &Value, Range)> {
        let range = |item: Item, field: Field| match (item, field) {
            (Item::Boundary(_), _) => Some(Range::Temperature),
            (Item::Source(_), Field::Law(law)) => Some(law.range),
            _ => None,
        };
        self.inputs()
            .filter(|(_, _, value)| touched.by(value) && self.parts.reads(value).is_constant())
            .filter_map(|(item, field, value)| Some((item, field, value, range(item, field)?)))
            .collect()
    }

    /// The variable of the results that a value depends on, if it is the only one and the value is
    /// a straight line in it.
    pub fn follows(&self, value: &Value) -> Option<Followed> {
        let programs = value.programs();
        let (Value::Expression(_), [program]) = (value, programs.as_slice()) else { return None };
        let mut found = None;
        for slot in program.slots() {
            let followed = match self.parts.layout.holds(slot) {
                Holds::Parameter(_) => continue,
                Holds::Temperature(end) => Followed::Temperature(end),
                Holds::Heat(heat) => Followed::Heat(heat),
                _ => return None,
            };
            let straight = program.degree_in(slot) <= Degree::Affine;
            let alone = found.replace(followed).is_none();
            let plain = program.comparisons().is_empty() && program.kinks().is_empty();
            if !(straight && alone && plain && program.table_calls().is_empty()) {
                return None;
            }
        }
        found
    }
}

impl Variants<'_> {
    /// The network that it began with.
    pub fn network(&self) -> &Network {
        self.network
    }

    /// The evaluation with the numbers of the candidate.
    pub fn scope(&mut self) -> &mut Evaluation {
        &mut self.work.scope
    }

    /// Sets the changed parameters to these values in SI units. `false` if [`Network::with`]
    /// refuses them: the numbers belong to no candidate then.
    pub fn set(&mut self, values: &[f64]) -> bool {
        self.work.errors.clear();
        self.parameters(values);
        if !self.work.errors.is_empty() {
            return false;
        }
        for &(item, field, value, range) in &self.fixed {
            self.work.evaluate(item, field, value, range);
        }
        self.nodes();
        self.conductances();
        self.work.errors.is_empty()
    }

    fn parameters(&mut self, values: &[f64]) {
        let parts = self.work.parts;
        for (id, &value) in self.changed.iter().zip(values) {
            let range = range_of(&parts.parameters[id.index()]);
            self.work.in_range(Item::Parameter(*id), Field::Value, value, range);
            self.work.scope.set_parameter(id.index(), value);
        }
        for &i in &self.following {
            let parameter = &parts.parameters[i];
            let item = Item::Parameter(ParameterId::from_len(i));
            let value =
                self.work.evaluate(item, Field::Value, &parameter.value, range_of(parameter));
            self.work.scope.set_parameter(i, value);
        }
    }

    fn nodes(&mut self) {
        let parts = self.work.parts;
        for &i in &self.nodes {
            let (node, item) = (&parts.nodes[i], Item::Node(NodeId::from_len(i)));
            if let Some(initial) = node.initial.as_ref().filter(|_| !node.massless) {
                let initial = self.work.evaluate(item, Field::Initial, initial, Range::Temperature);
                self.initial[i] = initial;
            }
            let own = node.capacity.as_ref();
            let mut capacity =
                own.map_or(0.0, |c| self.work.evaluate(item, Field::Capacity, c, Range::Positive));
            for (k, piece) in parts.capacitors.iter().enumerate() {
                if piece.node.index() == i {
                    let item = Item::Capacitor(CapacitorId::from_len(k));
                    capacity +=
                        self.work.evaluate(item, Field::Capacity, &piece.capacity, Range::Positive);
                }
            }
            self.capacity[i] = capacity;
        }
    }

    fn conductances(&mut self) {
        let parts = self.work.parts;
        for &i in &self.conductors {
            let (law, item) = (&parts.conductors[i].law, Item::Conductor(ConductorId::from_len(i)));
            let declared = law.formula().declaration();
            for ((field, value), of) in law.parts().zip(declared.fields) {
                if !matches!(value, Value::Constant(_)) {
                    self.work.evaluate(item, field, value, of.range);
                }
            }
            if !declared.ordered.is_empty() {
                self.work.check_order(item, law);
            }
            let (slots, stack) = self.work.scope.plain();
            let number = At::new((slots, stack)).value(law).unwrap_or(f64::NAN);
            let last = Field::law(law.formula(), declared.fields.len() - 1);
            self.conductance[i] = self.work.in_range(item, last, number, Range::Positive);
        }
    }
}
