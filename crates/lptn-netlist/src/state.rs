//! The state of a network at one time, as in the file `state.json`: a run can start from it.
//!
//! A state contains everything that a temperature does not determine. Wax at its melting point is
//! saved with its molten share, a control with the time since its last switch.

use std::fmt::Display;
use std::io::{self, Write};

/// The version of the file's format.
pub(crate) const FORMAT: &str = "1";

lptn_units::words! {
/// The end of the run that wrote a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateEnd {
    /// At its stop.
    Reached = "reached",
    /// Before its stop, by Ctrl-C.
    Interrupted = "interrupted",
    /// Before its stop, because the numbers failed.
    Failed = "failed",
}
/// Its word in the file.
pub(crate) fn word;
}

impl StateEnd {
    /// The end of this word.
    pub(crate) fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|end| end.word() == word)
    }
}

/// A state that is to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState<'a> {
    /// The name of the network: its file without the extension.
    pub network: &'a str,
    /// Its title, if it has one.
    pub title: Option<&'a str>,
    /// The time in s.
    pub time: f64,
    /// The end of the run.
    pub end: StateEnd,
    /// Temperature of every node by name, in K.
    pub temperatures: Vec<(&'a str, f64)>,
    /// The molten share, from 0 to 1, of each node whose temperature does not determine it.
    pub melted: Vec<(&'a str, f64)>,
    /// The value of every state of `[state]` by name, in SI units.
    pub states: Vec<(&'a str, f64)>,
    /// The state of every control.
    pub controls: Vec<StateControl<'a>>,
}

/// A control in a state that is to be written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateControl<'a> {
    /// Its name.
    pub name: &'a str,
    /// True if it is on.
    pub on: bool,
    /// Time in s since it switched, from 0; `None` if it never switched.
    pub held: Option<f64>,
}

impl SavedState<'_> {
    /// Writes the file; every number reads back as the same `f64`.
    ///
    /// # Errors
    /// The error of the stream.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = |text: &str| serde_json::Value::from(text);
        writeln!(out, "{{\n  \"format\": {FORMAT},\n  \"network\": {},", text(self.network))?;
        if let Some(title) = self.title {
            writeln!(out, "  \"title\": {},", text(title))?;
        }
        let time = serde_json::Value::from(self.time);
        writeln!(out, "  \"time\": {{ \"value\": {time}, \"unit\": \"s\" }},")?;
        writeln!(out, "  \"end\": \"{}\",", self.end.word())?;
        write!(out, "  \"temperatures\": {{ \"unit\": \"K\", \"values\": ")?;
        object(out, self.temperatures.iter().map(number))?;
        write!(out, " }},\n  \"melted\": ")?;
        object(out, self.melted.iter().map(number))?;
        if !self.states.is_empty() {
            write!(out, ",\n  \"states\": ")?;
            object(out, self.states.iter().map(number))?;
        }
        write!(out, ",\n  \"controls\": ")?;
        object(out, self.controls.iter().map(|control| (control.name, control.text())))?;
        writeln!(out, "\n}}")
    }
}

impl StateControl<'_> {
    fn text(&self) -> String {
        let held = self.held.map(serde_json::Value::from);
        let held = held.map(|held| format!(", \"held\": {{ \"value\": {held}, \"unit\": \"s\" }}"));
        format!("{{ \"on\": {}{} }}", self.on, held.unwrap_or_default())
    }
}

fn number<'a>((name, number): &(&'a str, f64)) -> (&'a str, serde_json::Value) {
    (name, serde_json::Value::from(*number))
}

fn object<'a>(
    out: &mut dyn Write,
    members: impl Iterator<Item = (&'a str, impl Display)>,
) -> io::Result<()> {
    let mut begun = false;
    for (name, value) in members {
        let separator = if begun { "," } else { "{" };
        write!(out, "{separator}\n    {}: {value}", serde_json::Value::from(name))?;
        begun = true;
    }
    out.write_all(if begun { b"\n  }" } else { b"{}" })
}
