//! Random networks in which one place or two read a temperature through something narrow.

use super::oracle;
use crate::features::{Dice, Feature};

/// What a body of a network stores, as a function of its own temperature.
#[derive(Clone, Debug)]
pub(crate) enum Storage {
    Constant,
    /// The key `C`.
    Capacity(Vec<Feature>),
    /// `cp` of its material.
    Material(Vec<Feature>),
    /// Its material melts between two temperatures in degC and takes up so many J.
    Melts {
        from: f64,
        to: f64,
        latent: f64,
    },
    Massless,
}

#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// In J/K.
    pub(crate) capacity: f64,
    /// In degC.
    pub(crate) start: f64,
    pub(crate) storage: Storage,
}

/// What an element reads of the temperatures; vertices are the nodes and the air behind them.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Read {
    Own,
    From,
    To,
    Mean,
    Difference,
    Named(usize),
}

/// Elements by the field that has features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    // into a node
    Power,
    BearingLoad,
    BearingOil,
    Churning,
    Mesh,
    // between two
    Resistance,
    Conductance,
    Film,
    FilmResistance,
    Contact,
    Pressure,
    Emissivity,
    Plates,
    ExchangeArea,
    // conduction with a value for the whole body, and with one that is integrated
    Slab,
    Rod,
    MaterialSlab,
    MaterialCylinder,
    MaterialSphere,
    // from the air
    Stream,
    Flow,
    Enthalpy,
    // of their own inlets
    CoolerCounter,
    CoolerParallel,
    CoolerOne,
    CoolerShell,
    CoolerFlow,
}

pub(crate) const KINDS: [Kind; 27] = [
    Kind::Power,
    Kind::BearingLoad,
    Kind::BearingOil,
    Kind::Churning,
    Kind::Mesh,
    Kind::Resistance,
    Kind::Conductance,
    Kind::Film,
    Kind::FilmResistance,
    Kind::Contact,
    Kind::Pressure,
    Kind::Emissivity,
    Kind::Plates,
    Kind::ExchangeArea,
    Kind::Slab,
    Kind::Rod,
    Kind::MaterialSlab,
    Kind::MaterialCylinder,
    Kind::MaterialSphere,
    Kind::Stream,
    Kind::Flow,
    Kind::Enthalpy,
    Kind::CoolerCounter,
    Kind::CoolerParallel,
    Kind::CoolerOne,
    Kind::CoolerShell,
    Kind::CoolerFlow,
];

impl Kind {
    pub(crate) fn heats(self) -> bool {
        matches!(
            self,
            Self::Power | Self::BearingLoad | Self::BearingOil | Self::Churning | Self::Mesh
        )
    }

    pub(crate) fn is_stream(self) -> bool {
        matches!(self, Self::Stream | Self::Flow | Self::Enthalpy)
    }

    /// Whether the feature is one of a property, whose own temperature is the only one there is.
    pub(crate) fn is_property(self) -> bool {
        matches!(
            self,
            Self::MaterialSlab | Self::MaterialCylinder | Self::MaterialSphere | Self::Enthalpy
        )
    }
}

/// An element; `size` is its heat in W, or about its conductance in W/K, without the features.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) kind: Kind,
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) size: f64,
    pub(crate) read: Read,
    pub(crate) features: Vec<Feature>,
}

impl Element {
    fn plain(kind: Kind, from: usize, to: usize, size: f64) -> Self {
        Self { kind, from, to, size, read: Read::Own, features: Vec::new() }
    }

    /// What it reads at temperatures of all vertices in degC.
    pub(crate) fn number(&self, celsius: &[f64]) -> f64 {
        let (from, to) = (celsius[self.from], celsius[self.to]);
        match self.read {
            Read::Own | Read::From => from,
            Read::To => to,
            Read::Mean => 0.5 * (from + to),
            Read::Difference => from - to,
            Read::Named(vertex) => celsius[vertex],
        }
    }
}

/// A fan that a node switches on above a temperature in degC and off below another; on, it carries
/// so many W/K more from there to the air. Both temperatures are higher by 2 K times the features of
/// another node.
#[derive(Clone, Debug)]
pub(crate) struct Fan {
    pub(crate) node: usize,
    pub(crate) on: f64,
    pub(crate) off: f64,
    pub(crate) more: f64,
    pub(crate) other: usize,
    pub(crate) features: Vec<Feature>,
}

impl Fan {
    /// How far its node is above where it switches, in K.
    pub(crate) fn beyond(&self, celsius: &[f64], blows: bool) -> f64 {
        let from = if blows { self.off } else { self.on };
        celsius[self.node] - from - 2.0 * (factor(&self.features, celsius[self.other]) - 1.0)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) nodes: Vec<Node>,
    pub(crate) elements: Vec<Element>,
    pub(crate) fan: Option<Fan>,
    /// In s.
    pub(crate) stop: f64,
    pub(crate) tolerance: f64,
}

/// Temperature of the air in degC.
pub(crate) const AIR: f64 = 20.0;

impl Case {
    pub(crate) fn random(dice: &mut Dice) -> Self {
        let mut case = Self::plain(dice);
        for _ in 0..1 + dice.one_of(3) / 2 {
            case.place(dice);
        }
        if dice.roll() < 0.15 {
            case.blow(dice);
        }
        case
    }

    /// A chain of nodes to the air that is heated, or cools.
    fn plain(dice: &mut Dice) -> Self {
        let count = 1 + usize::try_from(dice.one_of(3)).unwrap();
        let cools = dice.roll() < 0.3;
        let start = if cools { dice.between(200.0, 600.0) } else { 20.0 };
        let node = |dice: &mut Dice| Node {
            capacity: dice.in_ratio(50.0, 500.0),
            start,
            storage: Storage::Constant,
        };
        let mut nodes: Vec<Node> = (0..count).map(|_| node(dice)).collect();
        let mut elements: Vec<Element> = (0..count)
            .map(|i| Element::plain(Kind::Conductance, i, i + 1, dice.in_ratio(0.5, 4.0)))
            .collect();
        if !cools {
            let power = dice.between(20.0, 100.0);
            elements.push(Element::plain(Kind::Power, 0, 0, power));
        }
        if count > 1 && dice.roll() < 0.25 {
            nodes[1].storage = Storage::Massless;
        }
        let stored: f64 = nodes.iter().map(|node| node.capacity).sum();
        let stop = dice.in_ratio(0.3, 3.0) * stored / elements[count - 1].size;
        let tolerance = [1e-3, 1e-4, 1e-5][usize::try_from(dice.one_of(3)).unwrap()];
        Self { nodes, elements, fan: None, stop, tolerance }
    }

    /// Puts features in a random place.
    fn place(&mut self, dice: &mut Dice) {
        let node = usize::try_from(dice.one_of(self.nodes.len() as u64)).unwrap();
        let choice = usize::try_from(dice.one_of(KINDS.len() as u64 + 4)).unwrap();
        match KINDS.get(choice) {
            Some(kind) => self.add(*kind, node, dice),
            None => self.store(node, choice - KINDS.len(), dice),
        }
    }

    fn add(&mut self, kind: Kind, node: usize, dice: &mut Dice) {
        let air = self.nodes.len();
        let (from, to) = match kind {
            kind if kind.heats() => (node, node),
            kind if kind.is_stream() => (air, node),
            _ if dice.roll() < 0.5 => (node, air),
            _ => (node, node + 1),
        };
        let size = if kind.heats() { dice.between(10.0, 60.0) } else { dice.in_ratio(0.3, 3.0) };
        let any = Read::Named(usize::try_from(dice.one_of(air as u64)).unwrap());
        let read = match dice.one_of(5) {
            _ if kind.is_property() => Read::Own,
            0 => any,
            _ if kind.heats() => Read::Own,
            _ if kind.is_stream() => Read::To,
            1 => Read::From,
            2 if to < air => Read::To,
            3 => Read::Difference,
            _ => Read::Mean,
        };
        let mut element = Element { read, ..Element::plain(kind, from, to, size) };
        let numbers = match kind.is_property() {
            // a property is read from end to end
            true => oracle::range(self, |celsius| celsius[node]),
            false => oracle::range(self, |celsius| element.number(celsius)),
        };
        element.features = features(numbers, dice);
        self.elements.push(element);
    }

    fn store(&mut self, node: usize, way: usize, dice: &mut Dice) {
        if matches!(self.nodes[node].storage, Storage::Massless) {
            return;
        }
        let (low, high) = oracle::range(self, |celsius| celsius[node]);
        let capacity = self.nodes[node].capacity;
        self.nodes[node].storage = match way {
            0 | 1 if high - low > 30.0 => {
                let from = dice.between(low + 5.0, high - 5.0);
                let width = dice.in_ratio(0.1, 20.0).min(from - low).min(high - from);
                let to = from + if way == 0 { 0.0 } else { 0.9 * width };
                Storage::Melts { from, to, latent: capacity * dice.between(2.0, 40.0) }
            }
            2 => Storage::Material(features((low, high), dice)),
            _ => Storage::Capacity(features((low, high), dice)),
        };
    }

    fn blow(&mut self, dice: &mut Dice) {
        let node = usize::try_from(dice.one_of(self.nodes.len() as u64)).unwrap();
        let (low, high) = oracle::range(self, |celsius| celsius[node]);
        let on = dice.between(low, high);
        let off = on - dice.in_ratio(1.0, 20.0);
        if off > AIR + 1.0 && !matches!(self.nodes[node].storage, Storage::Massless) {
            let other = usize::try_from(dice.one_of(self.nodes.len() as u64)).unwrap();
            let seen = oracle::range(self, |celsius| celsius[other]);
            let moves = other != node && dice.roll() < 0.7;
            let features = if moves { features(seen, dice) } else { Vec::new() };
            let more = dice.in_ratio(0.3, 3.0);
            self.fan = Some(Fan { node, on, off, more, other, features });
        }
    }

    /// The air's place among the vertices.
    pub(crate) fn air(&self) -> usize {
        self.nodes.len()
    }
}

fn features((low, high): (f64, f64), dice: &mut Dice) -> Vec<Feature> {
    let inside = (low + 0.05 * (high - low), high - 0.05 * (high - low));
    (0..1 + dice.one_of(3)).map(|_| Feature::random(dice, inside).or_smooth(dice)).collect()
}

/// 1 and the features at a temperature in degC.
pub(crate) fn factor(features: &[Feature], celsius: f64) -> f64 {
    1.0 + features.iter().map(|feature| feature.of(celsius)).sum::<f64>()
}

/// The most that [`factor`] is anywhere.
pub(crate) fn most(features: &[Feature]) -> f64 {
    1.0 + features.iter().map(|feature| feature.size.max(0.0)).sum::<f64>()
}
