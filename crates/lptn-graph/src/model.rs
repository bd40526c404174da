//! A network as it is drawn: what has a place, what lies between places, and the words beside it.

use lptn_network::ConductorKind;

/// A network as it is drawn.
#[derive(Clone, Debug)]
pub struct Diagram {
    /// What it is called.
    pub title: String,
    /// Its nodes and boundaries, or groups of them.
    pub places: Vec<Place>,
    /// The paths between two places, those inside a group left out.
    pub links: Vec<Link>,
    /// The heat put in.
    pub sources: Vec<Supply>,
    /// What switches.
    pub controls: Vec<Switching>,
    /// The scales of the state that is shown.
    pub scales: Option<Scales>,
    /// What stands as one box, in words.
    pub grouped: Vec<String>,
}

/// A node or boundary, or several as one.
#[derive(Clone, Debug)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// What it is.
    pub role: PlaceRole,
    /// What is known of its temperature, in words: `92.7 °C`.
    pub temperature: Option<String>,
    /// The mean of its temperatures in the state that is shown, in K.
    pub kelvin: Option<f64>,
    /// The heat that it stores there in W, negative if it gives it back; `None` where nothing can
    /// be stored, or nothing is any more.
    pub stored: Option<f64>,
    /// Of several the heat that streams between them bring there, in W, positive into them.
    pub within: f64,
}

/// What a place is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaceRole {
    /// A node with its capacity, `735 J/K`.
    Node(String),
    /// A node that stores nothing.
    Junction,
    /// A place with a given temperature.
    Boundary,
    /// Several nodes: what they are, `24 nodes`, and their capacity together unless they store
    /// nothing.
    Group(String, Option<String>),
}

impl Diagram {
    /// What is known of the state of a place, a line each.
    pub fn state_of(&self, place: &Place) -> Vec<String> {
        let stored = self.scales.as_ref().and_then(|scales| scales.stored(place));
        place.temperature.iter().cloned().chain(stored).collect()
    }
}

impl PlaceRole {
    /// Whether it has a capacity.
    pub fn stores(&self) -> bool {
        matches!(self, Self::Node(_) | Self::Group(_, Some(_)))
    }
}

/// A path between two places, or several of one kind.
#[derive(Clone, Debug)]
pub struct Link {
    /// Its name; how many they are where they are several.
    pub name: String,
    /// The section it stands in.
    pub kind: ConductorKind,
    /// The place that positive heat leaves.
    pub from: usize,
    /// The place that positive heat enters.
    pub to: usize,
    /// Its resistance, `0.42 K/W`, or what else is known before a run.
    pub value: Option<String>,
    /// Whether heat goes with a fluid.
    pub stream: bool,
    /// Its heat in the state that is shown in W, positive from `from` to `to`.
    pub heat: Option<f64>,
    /// Of several streams that run both ways the heat in W that `from` receives of those that run
    /// against the others.
    pub against: f64,
}

/// Heat that is put into a place.
#[derive(Clone, Debug)]
pub struct Supply {
    /// Its name, with the share that this place has of it.
    pub name: String,
    /// Where it goes.
    pub into: usize,
    /// How much it is, `220.6 W`, or that it changes.
    pub value: String,
    /// How much it is in the state that is shown in W.
    pub heat: Option<f64>,
}

/// A control and what it switches.
#[derive(Clone, Debug)]
pub struct Switching {
    /// Its name.
    pub name: String,
    /// The place whose temperature it feels.
    pub sense: usize,
    /// When it switches: `on above 85 °C, off below 75 °C`.
    pub rule: String,
    /// What it switches.
    pub switches: Vec<Target>,
}

/// What a control switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A path, by its position in [`Diagram::links`].
    Link(usize),
    /// A source, by its position in [`Diagram::sources`].
    Source(usize),
}

/// What the numbers of a state are shown by.
#[derive(Clone, Debug)]
pub struct Scales {
    /// The coldest and the hottest temperature in K.
    pub span: [f64; 2],
    /// The same in words.
    pub ends: [String; 2],
    /// That it is a steady state, and for which inputs where they change; else its time.
    pub caption: String,
    /// The largest heat flow in W; not negative.
    pub most: f64,
    /// The unit of power of 1000 in W that heat flows are written in, and its name.
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

    /// What a place stores or gives back, in words: `stores 12.1 W`.
    pub fn stored(&self, place: &Place) -> Option<String> {
        // what is printed as 0 says nothing
        let least =
            0.5 * self.heat_unit.0 * 0.1_f64.powi(i32::try_from(self.decimals).unwrap_or(0));
        let watts = place.stored.filter(|watts| watts.abs() >= least)?;
        let does = if watts < 0.0 { "releases" } else { "stores" };
        Some(format!("{does} {}", self.heat(watts)))
    }

    /// Where a temperature in K lies, from 0, the coldest, to 1.
    pub fn share(&self, kelvin: f64) -> f64 {
        let [low, high] = self.span;
        if high > low { ((kelvin - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 }
    }
}
