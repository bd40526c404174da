//! Switches that the error of the run decides, and not the network.
//!
//! A body that approaches a threshold without end may pass it by an error of the run, at any time
//! or never. So may one whose peak just touches the threshold. If a quantity is nearer to its
//! threshold than the run is accurate for a time `tau`, its switch is uncertain by `tau`. The
//! temperatures then err by `tau` times the change of their rates at the switch. This is the
//! saltation of hybrid systems (P. C. Müller, Chaos, Solitons & Fractals 5 (1995) 1671).

use super::EventKind;

/// The error of a quantity that switches, as a multiple of [`super::Gates::rooms`]: ten tolerances
/// of the integrator, which gets a hundredth of the tolerance if something switches.
const ERROR: f64 = 10.0;

/// A switch is uncertain if its error in temperatures exceeds this many tolerances. The estimate
/// assumes the largest error of the run, which is some ten times the usual one.
const MOST: f64 = 100.0;

/// The same if it is uncertain whether it switches at all.
const MOST_IF_MISSED: f64 = 10.0;

/// A switch that the run's error decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undecided {
    /// Its subject: a control or a comparison.
    pub kind: EventKind,
    /// The time in s from which on it is within the error of the run.
    pub from: f64,
    /// The time in s until which it is.
    pub to: f64,
    /// True if it switches at [`Undecided::to`], false if it does not.
    pub switches: bool,
    /// The largest error of a temperature from it in K, if temperatures do not decay until then.
    pub error: f64,
}

/// Relation of a quantity to its threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    /// Further away than the error of the run: the last time in s and excess that were seen.
    Away(f64, f64),
    /// Within the error of the run since this time in s.
    Near(f64),
    /// It has switched, and is not yet away.
    Fresh,
}

/// A stay near a threshold that ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stay {
    pub(crate) position: usize,
    from: f64,
    to: f64,
    end: StayEnd,
}

/// End of a stay near a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
enum StayEnd {
    Switch,
    Away,
    Stop,
}

impl Stay {
    /// The stay as a result if it matters: the element changes the rates of temperatures by up to
    /// `change` in K/s, in a run until `stop` in s with this tolerance in K.
    pub(crate) fn matters(
        &self,
        change: f64,
        (stop, tolerance): (f64, f64),
        kind: EventKind,
    ) -> Option<Undecided> {
        let (time, most) = match self.end {
            StayEnd::Switch | StayEnd::Stop => (self.to - self.from, MOST),
            StayEnd::Away => (stop - self.from, MOST_IF_MISSED),
        };
        let switches = self.end == StayEnd::Switch;
        let error = change * time;
        let undecided = Undecided { kind, from: self.from, to: self.to, switches, error };
        (error > most * tolerance).then_some(undecided)
    }
}

/// Watches how near everything that switches is to its threshold.
#[derive(Clone, Debug)]
pub(crate) struct Nearness {
    places: Vec<Place>,
    /// False for elements whose threshold is passed at exact times.
    watched: Vec<bool>,
}

impl Nearness {
    pub(crate) fn new(watched: Vec<bool>) -> Self {
        Self { places: vec![Place::Fresh; watched.len()], watched }
    }

    /// Takes the excess of each over its threshold at a time in s. Gives the stays that end there
    /// without a switch. `rooms` are those of [`super::Gates::rooms`].
    pub(crate) fn look(&mut self, time: f64, excess: &[f64], rooms: &[f64]) -> Vec<Stay> {
        let mut ended = Vec::new();
        for (position, place) in self.places.iter_mut().enumerate() {
            let (excess, edge) = (excess[position], -ERROR * rooms[position]);
            *place = match *place {
                Place::Near(from) if excess < edge => {
                    ended.push(Stay { position, from, to: time, end: StayEnd::Away });
                    Place::Away(time, excess)
                }
                Place::Fresh | Place::Away(..) if excess < edge => Place::Away(time, excess),
                Place::Away(before, low) => {
                    Place::Near(before + (time - before) * (edge - low) / (excess - low))
                }
                near_or_fresh => near_or_fresh,
            };
        }
        ended.retain(|stay| self.watched[stay.position]);
        ended
    }

    /// The element at this position switches at a time in s; gives its stay near the threshold.
    pub(crate) fn switch(&mut self, position: usize, time: f64) -> Option<Stay> {
        let place = std::mem::replace(&mut self.places[position], Place::Fresh);
        self.stay(position, place, (time, StayEnd::Switch))
    }

    /// The stays that last until the run stops at a time in s.
    pub(crate) fn stop(&self, time: f64) -> Vec<Stay> {
        let places = self.places.iter().enumerate();
        places.filter_map(|(i, place)| self.stay(i, *place, (time, StayEnd::Stop))).collect()
    }

    fn stay(&self, position: usize, place: Place, (to, end): (f64, StayEnd)) -> Option<Stay> {
        match place {
            Place::Near(from) if self.watched[position] => Some(Stay { position, from, to, end }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
