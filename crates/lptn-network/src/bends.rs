//! Bends of results in the temperatures and heat flows that they read: inside a step, at times that
//! are not known in advance.

use std::sync::Arc;

use lptn_units::{Degree, Program, Taylor};

use crate::evaluation::Evaluation;
use crate::id::Item;
use crate::network::Network;
use crate::parts::layout::Holds;
use crate::value::Value;

/// The places at which some results bend: the arguments of `abs`, the differences of the arguments
/// of `min` and `max`, and the arguments of tables, as far as they read temperatures or heat flows.
/// Between two times at which none of them passes one of its levels, the results are as smooth as
/// the temperatures and heat flows. Results that are nonlinear in their arguments may still be
/// narrow there; [`Bends::enclose`] bounds them.
#[derive(Clone, Debug, Default)]
pub struct Bends {
    programs: Vec<Program>,
    /// For each of them the values at which a result bends, rising.
    levels: Vec<Vec<f64>>,
    /// The slots that move in the programs.
    rounded: Vec<u32>,
    /// For each of them the change that rounding of these slots makes.
    roundings: Vec<f64>,
    /// Results that are not straight in a temperature or heat flow.
    curved: Vec<Arc<Program>>,
    /// The slots that move in these.
    moved: Vec<u32>,
}

/// Share of a number by which a run may round it, with the polynomials between its steps.
const ROUNDED: f64 = 32.0 * f64::EPSILON;

impl Network {
    /// The bends of the results of these items, limits and reports. Times at which they bend by the
    /// time and the signals that they read are in [`Network::result_breakpoints`].
    pub fn bends(&self, items: impl IntoIterator<Item = Item>) -> Bends {
        let mut bends = Bends::default();
        for item in items {
            match item {
                Item::Limit(id) => {
                    let sides = self.limits()[id.index()].sides();
                    sides.into_iter().for_each(|side| bends.add_all(self, side));
                }
                Item::Report(id) => bends.add_all(self, &self.reports()[id.index()].value),
                _ => {}
            }
        }
        bends
    }
}

impl Bends {
    /// The values at which results bend, rising, one list for each quantity that is followed.
    pub fn levels(&self) -> &[Vec<f64>] {
        &self.levels
    }

    /// For each followed quantity the change that is rounding, in SI units; empty before
    /// [`Bends::stand`].
    pub fn roundings(&self) -> &[f64] {
        &self.roundings
    }

    /// Takes the roundings from the state of `scope`: each temperature, heat flow, signal and time
    /// is off by 7e-15 of itself.
    pub fn stand(&mut self, scope: &mut Evaluation) {
        let slots = scope.plain().0;
        let off = |slot: u32| {
            let value = slots[slot as usize];
            let by = ROUNDED * value.abs();
            Some(Taylor::between(&[[value - by, value + by]]))
        };
        let known = |slot: u32| self.rounded.binary_search(&slot).ok().and_then(|_| off(slot));
        let width = |program: &Program| {
            let range = program.enclose_along(&known, slots).range();
            range.map_or(0.0, |[low, high]| high - low)
        };
        self.roundings = self.programs.iter().map(width).collect();
    }

    /// Number of slots that move in nonlinear results.
    pub fn moved(&self) -> usize {
        self.moved.len()
    }

    /// All slots at the state of `scope`, for [`Bends::enclose`]; empty if no result is nonlinear.
    pub fn slots(&self, scope: &mut Evaluation) -> Vec<f64> {
        if self.curved.is_empty() { Vec::new() } else { scope.plain().0.to_vec() }
    }

    /// Bounds on each nonlinear result while the numbers that move in it (`moved`, as many as
    /// [`Bends::moved`] and in the order of [`Bends::read`]) go a way by one variable. The rest is
    /// as in `slots`.
    pub fn enclose(&self, moved: &[Taylor], slots: &[f64]) -> Vec<Taylor> {
        let known = |slot: u32| self.moved.binary_search(&slot).ok().map(|place| moved[place]);
        self.curved.iter().map(|program| program.enclose_along(&known, slots)).collect()
    }

    /// Adds the value of each followed quantity at the state of `scope`, in SI units; NaN if it has
    /// none, as in a branch that is not taken. Then adds the numbers that move in nonlinear
    /// results.
    pub fn read(&self, scope: &mut Evaluation, values: &mut Vec<f64>) {
        let (slots, stack) = scope.plain();
        let value = |program: &Program| program.eval(slots, stack).unwrap_or(f64::NAN);
        values.extend(self.programs.iter().map(value));
        values.extend(self.moved.iter().map(|slot| scope.slot(*slot)));
    }

    fn add_all(&mut self, network: &Network, value: &Value) {
        for program in value.programs() {
            self.add_curved(network, program);
            program.kinks().iter().for_each(|kink| self.add(network, kink, &[0.0]));
            for call in program.table_calls() {
                let axes = (0..call.table.dimension()).map(|axis| call.table.knots(axis));
                let arguments = call.arguments.iter().zip(axes);
                arguments.for_each(|(argument, knots)| self.add(network, argument, knots));
            }
        }
    }

    fn add_curved(&mut self, network: &Network, program: &Arc<Program>) {
        let holds = |slot: u32| network.parts.layout.holds(slot);
        let is_result = |slot: &u32| is_result(holds(*slot));
        let slots = program.slots();
        let curves = |slot: &u32| is_result(slot) && program.degree_in(*slot) > Degree::Affine;
        if slots.iter().any(curves) {
            let moves = |slot: &u32| moves(holds(*slot));
            self.moved.extend(slots.iter().copied().filter(moves));
            self.moved.sort_unstable();
            self.moved.dedup();
            self.curved.push(Arc::clone(program));
        }
    }

    fn add(&mut self, network: &Network, program: &Program, levels: &[f64]) {
        let reads = Value::Expression(program.clone().into());
        if !network.reads_results(&reads) {
            return;
        }
        let form = program.fingerprint();
        let known = self.programs.iter().position(|other| other.fingerprint() == form);
        let place = known.unwrap_or_else(|| {
            let moves = |slot: &u32| moves(network.parts.layout.holds(*slot));
            self.rounded.extend(program.slot_list().iter().copied().filter(moves));
            self.rounded.sort_unstable();
            self.rounded.dedup();
            self.programs.push(program.clone());
            self.levels.push(Vec::new());
            self.levels.len() - 1
        });
        let all = &mut self.levels[place];
        all.extend_from_slice(levels);
        all.sort_by(f64::total_cmp);
        all.dedup();
    }
}

fn is_result(held: Holds) -> bool {
    matches!(held, Holds::Temperature(_) | Holds::Heat(_) | Holds::Grid(_))
}

fn moves(held: Holds) -> bool {
    is_result(held) || matches!(held, Holds::Time | Holds::Signal(_))
}
