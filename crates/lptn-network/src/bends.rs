//! Where results bend by what they read of temperatures and heat flows: inside a step, at times that
//! nobody knows beforehand.

use lptn_units::Program;

use crate::evaluation::Evaluation;
use crate::id::Item;
use crate::network::Network;
use crate::value::Value;

/// The places at which some results bend: the arguments of `abs`, the differences of the arguments
/// of `min` and `max`, and the arguments of tables, as far as they read temperatures or heat flows.
/// Between two times at which none of them passes one of its levels the results are smooth wherever
/// temperatures and heat flows are.
#[derive(Clone, Debug, Default)]
pub struct Bends {
    programs: Vec<Program>,
    /// For each of them the values at which a result bends, rising.
    levels: Vec<Vec<f64>>,
}

impl Network {
    /// Where results of these items bend: limits and reports. Times at which they bend by what they
    /// read of the time and of signals are [`Network::result_breakpoints`].
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

    /// Adds the value of each quantity where `scope` stands, in SI units; NaN for one that has none,
    /// as in a branch that is not taken.
    pub fn read(&self, scope: &mut Evaluation, values: &mut Vec<f64>) {
        let (slots, stack) = scope.plain();
        let value = |program: &Program| program.eval(slots, stack).unwrap_or(f64::NAN);
        values.extend(self.programs.iter().map(value));
    }

    fn add_all(&mut self, network: &Network, value: &Value) {
        for program in value.programs() {
            program.kinks().iter().for_each(|kink| self.add(network, kink, &[0.0]));
            for call in program.table_calls() {
                let axes = (0..call.table.dimension()).map(|axis| call.table.knots(axis));
                let arguments = call.arguments.iter().zip(axes);
                arguments.for_each(|(argument, knots)| self.add(network, argument, knots));
            }
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
