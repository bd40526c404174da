//! What happened in a run, and when.

use lptn_network::{ControlId, LimitId, Network, SwitchId};

/// Something that happened at a time that was not known beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// When, in s.
    pub time: f64,
    /// What.
    pub kind: EventKind,
    /// 1 if it was on, held or was broken before, else 0.
    pub before: u8,
    /// The same afterwards.
    pub after: u8,
}

/// Where a control stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlState {
    /// Whether it is on.
    pub on: bool,
    /// When it switched last, in s; minus infinity if it never did.
    pub since: f64,
}

/// What an event is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A control switched: 0 is off, 1 is on.
    Control(ControlId),
    /// A comparison of temperatures changed: 1 if it holds.
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
    /// Everything of a network that switches at times that are not known beforehand: controls, then
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

    /// What it is about by name; a comparison by the element and the field it stands in,
    /// `heater.P`.
    pub fn name(self, network: &Network) -> String {
        match self {
            Self::Control(id) => network.controls()[id.index()].name.clone(),
            Self::Comparison(id) => {
                let switch = &network.switches()[id.index()];
                format!("{}.{}", network.name_of(switch.item), switch.field.key())
            }
            Self::Limit(id) => network.limits()[id.index()].name.clone(),
        }
    }
}
