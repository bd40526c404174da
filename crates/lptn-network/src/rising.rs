//! Heat flows that certainly go one way with temperature, by the form of their laws.

use lptn_laws::{Carries, Form};
use lptn_units::Trend;

use crate::id::{ConductorId, End, SourceId};
use crate::network::Network;
use crate::parts::layout::Holds;
use crate::slot;
use crate::value::Value;

impl Network {
    /// True if the heat of a conductor is known to rise with the temperature of its first end and
    /// to fall with that of its second, at all temperatures. Examples are radiation, and a film
    /// coefficient that rises with the magnitude of `dT`. `false` if this is not known, and for a
    /// stream.
    pub fn heat_rises(&self, id: ConductorId) -> bool {
        let conductor = &self.conductors()[id.index()];
        let depends = self.parts.dependence(id);
        if depends.vertices.len() > 2 || !depends.named.is_empty() {
            return false;
        }
        let along = conductor.law.along().filter(|_| self.along(id).is_some());
        let trend = |value: &Value| match along.is_some_and(|along| std::ptr::eq(along, value)) {
            // heat is the integral of a nonnegative property
            true => Trend::HELD,
            false => self.trend(value, &|holds, at| link(holds, at)),
        };
        let declared = conductor.law.formula().declaration();
        let mut values = conductor.law.values().iter().map(trend);
        match (declared.carries, declared.form) {
            // a negative conductance is refused
            (Carries::Conductance, Form::Product) => {
                values.fold(Trend::constant(1.0), Trend::times).rises && !declared.reads_ends
            }
            (Carries::Conductance, Form::Reciprocal) => values.all(|r| r.falls && r.low >= 0.0),
            // an exchange area that no temperature changes leaves a difference of fourth powers
            (Carries::Conductance | Carries::Radiation, _) => {
                values.all(Trend::is_held) && !declared.reads_ends
            }
            _ => false,
        }
    }

    /// True if a source heats one node, and is known not to heat it more when that is warmer.
    pub fn source_falls(&self, id: SourceId) -> bool {
        let source = &self.sources()[id.index()];
        let [(node, _)] = source.into.as_slice() else { return false };
        let own = |holds: Holds, _: u32| match holds {
            Holds::Own => Trend::VARIABLE,
            Holds::Temperature(End::Node(of)) if of == *node => Trend::VARIABLE,
            other => elsewhere(other),
        };
        match source.power() {
            Some(power) => self.trend(power, &own).falls,
            None => source.law.values().iter().all(|value| self.trend(value, &own).is_held()),
        }
    }

    fn trend(&self, value: &Value, of: &dyn Fn(Holds, u32) -> Trend) -> Trend {
        match value {
            Value::Constant(value) => Trend::constant(*value),
            Value::Expression(program) => program.trend(&|at| {
                let holds = self.parts.layout.holds(at);
                match holds {
                    Holds::Parameter(id) => Trend::constant(self.parameter_value(id)),
                    _ => of(holds, at),
                }
            }),
            Value::Product(factors) => {
                let one = Trend::constant(1.0);
                factors.iter().fold(one, |product, factor| product.times(self.trend(factor, of)))
            }
        }
    }
}

/// Trend of a slot while the difference between the ends of a conductor grows.
fn link(holds: Holds, at: u32) -> Trend {
    match holds {
        Holds::Link if at == slot::DIFFERENCE => Trend::SIGNED,
        other => elsewhere(other),
    }
}

/// Trend of a slot that is not the variable itself.
fn elsewhere(holds: Holds) -> Trend {
    match holds {
        Holds::Time
        | Holds::FrozenTime
        | Holds::Signal(_)
        | Holds::FrozenSignal(_)
        | Holds::Control(_)
        | Holds::Switch(_) => Trend::HELD,
        _ => Trend::UNKNOWN,
    }
}
