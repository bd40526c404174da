//! The heat of a diagram as bars and bands between them.

use super::streams::Streams;
use crate::model::{Diagram, Supply};

/// Flows below this share of the largest are not shown.
const LEAST: f64 = 1e-9;

/// More sources of one place than this have one bar together.
const MOST_SOURCES: usize = 4;

/// The heat of a state: its origins, the places that it passes, and its destinations.
#[derive(Clone, Debug, Default)]
pub struct HeatFlows {
    /// Origins, places and destinations of heat: in the order of the diagram its places, then its
    /// sources, then its streams, then released and stored heat.
    pub bars: Vec<Bar>,
    /// The heat flows from one bar to another.
    pub bands: Vec<Band>,
}

/// A thing that heat comes from, goes through or ends in.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its name.
    pub name: String,
    /// Its role.
    pub role: BarRole,
    /// The heat in W that bands bring.
    pub into: f64,
    /// The heat in W that bands take away. At every place but a boundary it equals `into`.
    pub out: f64,
}

/// The role of a bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarRole {
    /// A node, a boundary or a group, by its position in [`Diagram::places`].
    Place(usize),
    /// A source, or many of one place; if they cool, the heat that they take.
    Source,
    /// The fluid of a stream: the heat that it brings and carries away.
    Stream,
    /// Heat that capacities had and give back.
    Released,
    /// Heat that capacities take.
    Stored,
}

/// Heat that flows from one bar to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// The path, source or stream that brings it.
    pub name: String,
    /// The bar that it comes from, a position in [`HeatFlows::bars`].
    pub from: usize,
    /// The bar that it goes to, a position in [`HeatFlows::bars`].
    pub to: usize,
    /// Its heat in W, above zero.
    pub heat: f64,
}

impl Bar {
    fn new(name: impl Into<String>, role: BarRole) -> Self {
        Self { name: name.into(), role, into: 0.0, out: 0.0 }
    }

    /// The heat in W that goes through it, or that it gives or takes: the larger side.
    pub fn heat(&self) -> f64 {
        self.into.max(self.out)
    }
}

impl HeatFlows {
    /// The heat flows of a diagram; none if it shows no state.
    pub fn of(diagram: &Diagram) -> Self {
        let places = diagram.places.iter().enumerate();
        let bars = places.map(|(i, place)| Bar::new(place.name.clone(), BarRole::Place(i)));
        let mut all = Self { bars: bars.collect(), bands: Vec::new() };
        all.sources(diagram);
        let streams = Streams::of(diagram);
        for (link, carried) in diagram.links.iter().zip(&streams.carried) {
            let heat = link.heat.unwrap_or(0.0);
            match carried {
                Some(carried) => all.band(link.name.clone(), (link.from, link.to), *carried),
                None if link.stream => {
                    let stream = || Bar::new(link.name.clone(), BarRole::Stream);
                    all.own_bar(stream(), link.to, heat);
                    all.own_bar(stream(), link.from, link.against);
                }
                None => all.band(link.name.clone(), (link.from, link.to), heat),
            }
        }
        for (i, (name, heat)) in streams.left.into_iter().enumerate() {
            all.own_bar(Bar::new(name, BarRole::Stream), i, heat);
        }
        all.store(diagram);
        all.without_dust()
    }

    /// A bar for each source; one for those that heat one place, or cool it, if they are many.
    fn sources(&mut self, diagram: &Diagram) {
        let alike = |one: &Supply, other: &Supply| {
            let cools = |source: &Supply| source.heat.is_some_and(|heat| heat < 0.0);
            one.into == other.into && cools(one) == cools(other)
        };
        for (i, source) in diagram.sources.iter().enumerate() {
            let all: Vec<&Supply> =
                diagram.sources.iter().filter(|other| alike(source, other)).collect();
            let (name, of) = match all.len() > MOST_SOURCES {
                true if diagram.sources[..i].iter().any(|other| alike(source, other)) => continue,
                true => (format!("{} sources", all.len()), all),
                false => (source.name.clone(), vec![source]),
            };
            let heat = of.iter().filter_map(|source| source.heat).sum();
            self.own_bar(Bar::new(name, BarRole::Source), source.into, heat);
        }
    }

    /// Adds a separate bar, with heat from it to a place, or to that bar if negative.
    fn own_bar(&mut self, bar: Bar, place: usize, heat: f64) {
        if heat != 0.0 {
            self.bars.push(bar);
            let own = self.bars.len() - 1;
            self.band(self.bars[own].name.clone(), (own, place), heat);
        }
    }

    /// Heat from one bar to another, or back if it is negative.
    fn band(&mut self, name: String, (from, to): (usize, usize), heat: f64) {
        let (from, to) = if heat < 0.0 { (to, from) } else { (from, to) };
        self.bands.push(Band { name, from, to, heat: heat.abs() });
    }

    /// Leads the heat that places store to one bar, and the heat that they release from another.
    fn store(&mut self, diagram: &Diagram) {
        let (released, stored) = (self.bars.len(), self.bars.len() + 1);
        self.bars.push(Bar::new("released", BarRole::Released));
        self.bars.push(Bar::new("stored", BarRole::Stored));
        for (i, place) in diagram.places.iter().enumerate() {
            match place.stored.unwrap_or(0.0) {
                heat if heat < 0.0 => {
                    self.band(format!("released by {}", place.name), (released, i), -heat);
                }
                heat => self.band(format!("stored in {}", place.name), (i, stored), heat),
            }
        }
    }

    /// Drops invisible bands and bars, and sums the heat of every bar.
    fn without_dust(mut self) -> Self {
        let most = self.bands.iter().map(|band| band.heat).fold(0.0, f64::max);
        self.bands.retain(|band| band.heat > LEAST * most);
        for band in &self.bands {
            self.bars[band.from].out += band.heat;
            self.bars[band.to].into += band.heat;
        }
        let mut at = vec![0; self.bars.len()];
        let mut kept = Vec::new();
        for (i, bar) in self.bars.into_iter().enumerate() {
            at[i] = kept.len();
            kept.extend(Some(bar).filter(|bar| bar.heat() > 0.0));
        }
        for band in &mut self.bands {
            (band.from, band.to) = (at[band.from], at[band.to]);
        }
        Self { bars: kept, bands: self.bands }
    }
}
