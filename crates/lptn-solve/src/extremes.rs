//! The hottest and the coldest of all temperatures that a run shows.

use lptn_network::{Network, NodeId};

/// Nothing is solid above this temperature in K, 4000 degC: tungsten melts at 3422 degC, tantalum
/// hafnium carbide at about 3900 degC.
const HOTTEST: f64 = 4273.15;

/// Below this temperature in K, -100 degC, a node is only brought by something that is as cold.
const COLDEST: f64 = 173.15;

/// A node, its temperature in K and the time in s; `None` in steady state.
pub(crate) type Place = (NodeId, f64, Option<f64>);

/// The hottest and the coldest of some places: of equals the first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Extremes {
    hottest: Option<Place>,
    coldest: Option<Place>,
}

impl Extremes {
    pub(crate) fn take_in(&mut self, place: Place) {
        let (_, temperature, _) = place;
        if temperature.is_finite() {
            if self.hottest.is_none_or(|known| temperature > known.1) {
                self.hottest = Some(place);
            }
            if self.coldest.is_none_or(|known| temperature < known.1) {
                self.coldest = Some(place);
            }
        }
    }

    /// Takes in every node in K at a time in s; `range` is their lowest and highest one.
    pub(crate) fn take_in_all(
        &mut self,
        time: f64,
        (network, nodes): (&Network, &[f64]),
        range: Option<(f64, f64)>,
    ) {
        let all = || network.thermal_nodes().map(|id| (id, nodes[id.index()], Some(time)));
        let range = range.filter(|_| network.states().is_empty());
        let Some((least, most)) = range else {
            return all().for_each(|place| self.take_in(place));
        };
        // rows in which nothing is new are the most
        if self.hottest.is_none_or(|known| most > known.1) {
            all().find(|place| place.1 >= most).into_iter().for_each(|place| self.take_in(place));
        }
        if self.coldest.is_none_or(|known| least < known.1) {
            all().find(|place| place.1 <= least).into_iter().for_each(|place| self.take_in(place));
        }
    }

    /// The same with these places.
    #[must_use]
    pub(crate) fn with(mut self, places: impl IntoIterator<Item = Place>) -> Self {
        places.into_iter().for_each(|place| self.take_in(place));
        self
    }

    /// The hottest or the coldest place, if nothing real is as hot, or nothing else that cold.
    /// `others` are the temperatures of boundaries in K.
    pub(crate) fn odd(self, network: &Network, others: impl Iterator<Item = f64>) -> Option<Place> {
        let starts = network.thermal_nodes().map(|id| network.initial(id));
        let cold_anyway = || others.chain(starts).any(|t| t < COLDEST);
        let hot = self.hottest.filter(|place| place.1 > HOTTEST);
        hot.or_else(|| self.coldest.filter(|place| place.1 < COLDEST).filter(|_| !cold_anyway()))
    }
}
