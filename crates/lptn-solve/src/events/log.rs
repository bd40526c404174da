//! Events of a run and their times.

use lptn_network::{ControlId, LimitId, Network, SwitchId};

/// An event at a time that was not known in advance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Its time in s.
    pub time: f64,
    /// Its kind.
    pub kind: EventKind,
    /// 1 if it was on, true or broken before, else 0.
    pub before: u8,
    /// The same afterwards.
    pub after: u8,
}

/// State of a control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlState {
    /// True if it is on.
    pub on: bool,
    /// Time of its last switch in s; minus infinity if it never switched.
    pub since: f64,
}

/// Subject of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A control switched: 0 is off, 1 is on.
    Control(ControlId),
    /// A comparison of temperatures changed: 1 if it is true.
    Comparison(SwitchId),
    /// A limit was broken for the first time: 1 if it is broken.
    Limit(LimitId),
}

impl Event {
    pub(crate) fn new(time: f64, kind: EventKind, after: bool) -> Self {
        Self { time, kind, before: u8::from(!after), after: u8::from(after) }
    }
}

impl EventKind {
    /// Everything of a network that switches at times not known in advance: controls, then
    /// comparisons.
    pub fn switching(network: &Network) -> impl Iterator<Item = Self> + use<> {
        let controls = network.control_ids().map(Self::Control);
        controls.chain(network.switch_ids().map(Self::Comparison))
    }

    /// The word for its kind in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Control(_) => "control",
            Self::Comparison(_) => "comparison",
            Self::Limit(_) => "limit",
        }
    }

    /// Its subject by name; a comparison by its element and field, `heater.P`.
    pub fn name(self, network: &Network) -> String {
        match self {
            Self::Control(id) => network.controls()[id.index()].name.clone(),
            Self::Comparison(id) => {
                let (item, field) = network.place_of_switch(id);
                format!("{}.{}", network.name_of(item), field.key())
            }
            Self::Limit(id) => network.limits()[id.index()].name.clone(),
        }
    }
}
