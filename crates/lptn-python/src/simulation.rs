//! A network that Python steps.

use lptn::{Diagnostic, Dimension, Exit, Failure, Quantity, Type, Unit, quantity};
use lptn::{EventIndicator, RunSettings, SavedSimulation, Selection, SimulationError, Table, Time};
use pyo3::prelude::*;

use crate::asking::failed;
use crate::netlist::Netlist;
use crate::trouble::Trouble;
use crate::watching::soon;
use crate::words;

/// An event: time in s, kind, name, state before and after.
type Event = (f64, &'static str, String, bool, bool);

/// An event indicator: name, value, unit.
type Indicator = (String, f64, String);

/// A column at one instant: name, unit, value.
type Shown = (String, String, f64);

/// A heat of a step: part of the ledger, name, heat in J.
type Heat = (&'static str, String, f64);

/// A network with its state at a time.
#[pyclass(module = "lptn._lptn")]
pub(crate) struct Simulation {
    simulation: lptn::Simulation,
    unit: Unit,
    events: Vec<Event>,
    ledger: Vec<Heat>,
}

fn refused(error: SimulationError) -> PyErr {
    failed(Failure::of(&error))
}

/// The run that a simulation is a part of.
fn settings(netlist: &Netlist) -> PyResult<RunSettings> {
    let input = netlist.loaded.usual();
    let missing = || {
        let message = format!("{} has no [run], so its duration is not known", input.text.name);
        let problem = Diagnostic::error("run::no_run", message);
        failed(Failure::new(
            Exit::Input,
            problem.help("add these lines:\n\n[run]\nstop = \"25 min\""),
        ))
    };
    input.netlist.run.clone().ok_or_else(missing)
}

/// A time in s of a text such as `10 s`.
fn time(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let wrong = || Trouble::of_type(format!("`{name}` takes a time such as \"10 s\""));
    let text = words::text(value)?.ok_or_else(wrong)?;
    let ty = Type::of(Dimension::TIME);
    given(name, &text, ty).map(|time| time.value)
}

/// The quantity of an argument. Its errors name it, and have no place: the user did not write the
/// text in a file.
fn given(name: &str, text: &str, ty: Type) -> PyResult<Quantity> {
    quantity(name, text, ty).map_err(|mut failure| {
        for problem in &mut failure.diagnostics {
            problem.labels.clear();
            if !problem.message.contains(name) {
                problem.message = format!("`{name}`: {}", problem.message);
            }
        }
        failed(failure)
    })
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, netlist: &Netlist) -> PyResult<Self> {
        let settings = settings(netlist)?;
        let read = &netlist.loaded.usual().netlist;
        let begun = py.detach(|| lptn::Simulation::new(&read.network, &settings));
        let simulation = begun.map_err(refused)?;
        Ok(Self {
            simulation,
            unit: read.temperature_unit.clone(),
            events: Vec::new(),
            ledger: Vec::new(),
        })
    }

    /// The time that was reached, in s.
    #[getter]
    fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// The unit of temperatures.
    #[getter]
    fn temperature_unit(&self) -> &str {
        &self.unit.text
    }

    /// The temperature of a node or boundary, in the unit of temperatures.
    fn temperature(&self, node: &str) -> PyResult<f64> {
        let found = self.simulation.temperature(node).map_err(refused)?;
        Ok(self.unit.from_si(found.0))
    }

    /// All columns at the present time: name, unit, value.
    fn table(&self) -> PyResult<Vec<Shown>> {
        let network = self.simulation.network();
        let at = self.simulation.snapshot().map_err(refused)?;
        let all = Selection::all(network);
        let table = Table::of_snapshot(network, &at, &all, &self.unit);
        let table = table.map_err(|error| failed(Failure::of(&error)))?;
        let shown = table.columns().iter().flat_map(|column| {
            column.values.iter().map(|value| (column.name.clone(), column.unit.clone(), *value))
        });
        Ok(shown.collect())
    }

    /// The heats of the last step in J: part, name, heat.
    #[getter]
    fn ledger(&self) -> Vec<Heat> {
        self.ledger.clone()
    }

    /// The value of a state of `[state]` in its SI unit.
    fn state(&self, name: &str) -> PyResult<f64> {
        self.simulation.state(name).map_err(refused)
    }

    /// Fixes a parameter or a signal at a value such as `220 W`.
    fn set(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let wrong = || Trouble::of_type(format!("`{name}` takes a quantity such as \"220 W\""));
        let text = words::text(value)?.ok_or_else(wrong)?;
        let Quantity { value, .. } = self.read(name, &text)?;
        self.simulation.set(name, value).map_err(refused)
    }

    /// Gives a signal its own time history again, or a parameter its own value.
    fn release(&mut self, name: &str) -> PyResult<()> {
        self.simulation.release(name).map_err(refused)
    }

    /// Steps by a time.
    fn step(&mut self, py: Python<'_>, length: &Bound<'_, PyAny>) -> PyResult<()> {
        let to = self.simulation.time() + time("length", length)?;
        self.goes(py, to)
    }

    /// Steps to a time.
    fn advance(&mut self, py: Python<'_>, to: &Bound<'_, PyAny>) -> PyResult<()> {
        let to = time("to", to)?;
        self.goes(py, to)
    }

    /// The events of the last step.
    #[getter]
    fn events(&self) -> Vec<Event> {
        self.events.clone()
    }

    /// The distance to every event at this time.
    fn event_indicators(&self) -> PyResult<Vec<Indicator>> {
        let found = self.simulation.event_indicators().map_err(refused)?;
        let one = |EventIndicator { name, value, unit, .. }| (name, value, unit.to_string());
        Ok(found.into_iter().map(one).collect())
    }

    /// The data that its future depends on in addition to the network, as JSON.
    fn save(&self) -> PyResult<String> {
        let saved = serde_json::to_string(&self.simulation.save());
        Ok(saved.map_err(|error| Trouble::fault(&error.to_string()))?)
    }

    /// Goes to a state that was saved.
    fn restore(&mut self, saved: &str) -> PyResult<()> {
        let read = serde_json::from_str::<SavedSimulation>(saved);
        let saved = read.map_err(|error| Trouble::of_value(error.to_string()))?;
        self.simulation.restore(&saved).map_err(refused)?;
        self.forget();
        Ok(())
    }
}

impl Simulation {
    /// A value for a parameter or signal, its unit checked.
    fn read(&self, name: &str, text: &str) -> PyResult<Quantity> {
        let network = self.simulation.network();
        let parameter = network.parameter(name).ok();
        let ty = parameter.map(|id| network.parameters()[id.index()].ty);
        let of_signal = || network.signals().iter().find(|signal| signal.name == name);
        // a name that is neither is refused when it is set
        let ty = ty.or_else(|| of_signal().map(|signal| signal.ty));
        let Some(ty) = ty else { return self.unknown(name) };
        given(name, text, ty)
    }

    fn unknown(&self, name: &str) -> PyResult<Quantity> {
        let refusal = self.simulation.clone().set(name, 0.0).err().map(refused);
        Err(refusal.unwrap_or_else(|| Trouble::fault("an input without a type").into()))
    }

    /// Nothing has happened in the last step.
    fn forget(&mut self) {
        self.events.clear();
        self.ledger.clear();
    }

    fn goes(&mut self, py: Python<'_>, to: f64) -> PyResult<()> {
        let now = self.simulation.time();
        if to < now {
            let message = format!("the simulation is at {now} s and cannot go back to {to} s");
            return Err(Trouble::of_value(message).into());
        }
        if to <= now {
            self.forget();
            return Ok(());
        }
        let simulation = &mut self.simulation;
        let answer = soon(py, move || {
            simulation.advance(Time(to), &[]).map_err(|error| Failure::of(&error).into())
        })?;
        let one = |event: &lptn::Event| {
            let name = event.kind.name(answer.network());
            (event.time, event.kind.word(), name, event.before == 1, event.after == 1)
        };
        self.events = answer.events().iter().map(one).collect();
        let heats = answer.ledger().heats(answer.network()).into_iter();
        self.ledger = heats.map(|(part, name, heat)| (part, name.into_owned(), heat)).collect();
        self.ledger.push(("residual", String::new(), answer.ledger().residual()));
        Ok(())
    }
}
