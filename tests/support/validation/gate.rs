//! Switched heat: when a thermostat switches.

use lptn::prelude::*;
use lptn_network::{Acts, Context, Thermostat};
use lptn_solve::EventKind;

use super::answer::Trouble;
use super::case::Gate;
use super::expected::Quantity;
use super::network::{Building, Unit};

impl Building {
    /// The name that is 1 while the gate lets heat through, 0 otherwise.
    pub fn gate(&mut self, id: &str, gate: &Gate) -> Result<String, String> {
        let control = super::network::name("gate", id);
        let declared = self.b.control(&control);
        let setpoint = self.text(&gate.setpoint, Unit::Kelvin)?;
        let threshold =
            |half: f64| self.expression(Context::Control, &format!("({setpoint}) + ({half} [K])"));
        let (on, off) = (threshold(-0.5 * gate.band)?, threshold(0.5 * gate.band)?);
        let (sense, start, min_dwell) =
            (self.end(&gate.sensor)?, gate.initial_on, Time(0.0).into());
        let acts = Acts::Heating;
        self.b.thermostat(declared, Thermostat { sense, acts, on, off, start, min_dwell });
        Ok(control)
    }
}

/// What a case asks of its gate, from the events of a run.
pub fn answer(solution: &Solution, quantity: &Quantity) -> Result<f64, Trouble> {
    let mut controls = solution.network().control_ids();
    let (Some(control), None) = (controls.next(), controls.next()) else {
        return Err("which gate?".into());
    };
    let until = |t_end: &Option<f64>| t_end.unwrap_or(f64::INFINITY);
    let switches = |t_end: f64| {
        let own = solution.events().iter().filter(move |e| e.kind == EventKind::Control(control));
        own.filter(move |event| event.time <= t_end).map(|event| (event.time, event.after == 1))
    };
    // from one switching on to the next, with the switching off between them
    let last_cycle = |t_end: f64| {
        let switches: Vec<(f64, bool)> = switches(t_end).collect();
        let cycles = switches.windows(3).rev();
        let cycle = cycles.into_iter().find(|cycle| cycle[0].1).map(|c| [c[0].0, c[1].0, c[2].0]);
        cycle.ok_or_else(|| Trouble::from("no full cycle"))
    };
    match quantity {
        Quantity::GateFirstSwitch { t_end } => {
            let first = switches(until(t_end)).next();
            first.map(|(time, _)| time).ok_or_else(|| "it never switches".into())
        }
        Quantity::GateOnTime { t_end } => last_cycle(until(t_end)).map(|[on, off, _]| off - on),
        Quantity::GatePeriod { t_end } => last_cycle(until(t_end)).map(|[on, _, again]| again - on),
        _ => Err("this is not a question to a gate".into()),
    }
}
