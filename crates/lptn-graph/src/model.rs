//! A network as it is drawn: places, paths between places, and their labels.

use lptn_network::ConductorKind;
use lptn_units::Unit;

use crate::words::Scale;

/// A network as it is drawn.
#[derive(Clone, Debug)]
pub struct Diagram {
    /// Its title.
    pub title: String,
    /// Its nodes and boundaries, or groups of them.
    pub places: Vec<Place>,
    /// The paths between two places, those inside a group left out.
    pub links: Vec<Link>,
    /// The heat put in.
    pub sources: Vec<Supply>,
    /// Its controls.
    pub controls: Vec<Switching>,
    /// The scales of the state that is shown.
    pub scales: Option<Scales>,
    /// The groups drawn as one box, in words.
    pub grouped: Vec<String>,
}

/// A node or boundary, or several as one.
#[derive(Clone, Debug)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Its role.
    pub role: PlaceRole,
    /// Its known temperature, in words: `92.7 °C`.
    pub temperature: Option<String>,
    /// The mean of its temperatures in the state that is shown, in K.
    pub kelvin: Option<f64>,
    /// The heat that it stores there in W, negative if it releases heat. `None` if it cannot store
    /// heat, or if the state is steady.
    pub stored: Option<f64>,
    /// For a group, the heat that streams between its members bring in W, positive into them.
    pub within: f64,
    /// The place of its curve over time, whose ink marks it: see [`series`](crate::series()).
    pub series: Option<usize>,
}

/// The role of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaceRole {
    /// A node with its capacity, `735 J/K`.
    Node(String),
    /// A node that stores nothing.
    Junction,
    /// A place with a given temperature.
    Boundary,
    /// Several nodes: their description, `24 nodes`, and their total capacity unless they store
    /// nothing.
    Group(String, Option<String>),
}

impl Diagram {
    /// Temperature and stored heat of a place if known, one line each.
    pub fn state_of(&self, place: &Place) -> Vec<String> {
        let stored = self.scales.as_ref().and_then(|scales| scales.stored(place));
        place.temperature.iter().cloned().chain(stored).collect()
    }
}

impl PlaceRole {
    /// True if it has a capacity.
    pub fn stores(&self) -> bool {
        matches!(self, Self::Node(_) | Self::Group(_, Some(_)))
    }
}

/// A path between two places, or several of one kind.
#[derive(Clone, Debug)]
pub struct Link {
    /// Its name; for several, their number.
    pub name: String,
    /// Its kind, which names its section.
    pub kind: ConductorKind,
    /// The place that positive heat leaves.
    pub from: usize,
    /// The place that positive heat enters.
    pub to: usize,
    /// Its resistance, `0.42 K/W`, or another value that is known before a run.
    pub value: Option<String>,
    /// True if heat goes with a fluid.
    pub stream: bool,
    /// Its heat in the state that is shown in W, positive from `from` to `to`.
    pub heat: Option<f64>,
    /// Of a stream whose capacity rate is known, in the state that is shown: the rate in W/K, and
    /// its product with the temperature in K of the places that the fluid leaves.
    pub carries: Option<(f64, f64)>,
    /// For several streams that run both ways, the heat in W that `from` receives from those that
    /// run against the others.
    pub against: f64,
}

/// Heat that is put into a place.
#[derive(Clone, Debug)]
pub struct Supply {
    /// Its name, with the share that this place has of it.
    pub name: String,
    /// The place that receives it, a position in [`Diagram::places`].
    pub into: usize,
    /// Its value, `220.6 W`, or a note that it changes.
    pub value: String,
    /// Its heat in the state that is shown in W.
    pub heat: Option<f64>,
}

/// A control and its targets.
#[derive(Clone, Debug)]
pub struct Switching {
    /// Its name.
    pub name: String,
    /// The place whose temperature it senses.
    pub sense: usize,
    /// When it switches: `on above 85 °C, off below 75 °C`.
    pub rule: String,
    /// The paths and sources that it switches.
    pub switches: Vec<Target>,
}

/// A path or source that a control switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A path, by its position in [`Diagram::links`].
    Link(usize),
    /// A source, by its position in [`Diagram::sources`].
    Source(usize),
}

/// Scales and units for the numbers of a state.
#[derive(Clone, Debug)]
pub struct Scales {
    /// The coldest and the hottest temperature in K.
    pub span: [f64; 2],
    /// The same in words.
    pub ends: [String; 2],
    /// Round temperatures: their share of the way from the coldest to the hottest, and their
    /// numbers.
    pub ticks: Vec<(f64, String)>,
    /// The unit of temperatures.
    pub unit: Unit,
    /// "Steady state", with the time of its inputs if they change; else the time of the state.
    pub caption: String,
    /// The largest heat flow in W; not negative.
    pub most: f64,
    /// The unit of heat flows: its size in W, a power of 1000, and its name.
    pub heat_unit: (f64, String),
    /// Decimals of heat flows.
    pub decimals: usize,
}

impl Scales {
    /// A heat flow in W in words, without its sign: `154.4 W`.
    pub fn heat(&self, watts: f64) -> String {
        let (scale, unit) = &self.heat_unit;
        format!("{} {unit}", lptn_report::fixed(watts.abs() / scale, self.decimals))
    }

    /// A temperature in K in words: `92.7 °C`.
    pub fn temperature(&self, kelvin: f64) -> String {
        Scale::new(&self.unit, self.span[1] - self.span[0]).text(kelvin)
    }

    /// The heat that a place stores or releases, in words: `stores 12.1 W`.
    pub fn stored(&self, place: &Place) -> Option<String> {
        // a number that is printed as 0 is left out
        let least =
            0.5 * self.heat_unit.0 * 0.1_f64.powi(i32::try_from(self.decimals).unwrap_or(0));
        let watts = place.stored.filter(|watts| watts.abs() >= least)?;
        let does = if watts < 0.0 { "releases" } else { "stores" };
        Some(format!("{does} {}", self.heat(watts)))
    }

    /// Position of a temperature in K on the scale, from 0, the coldest, to 1.
    pub fn share(&self, kelvin: f64) -> f64 {
        let [low, high] = self.span;
        if high > low { ((kelvin - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 }
    }
}
