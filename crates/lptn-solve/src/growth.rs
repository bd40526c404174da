//! Growth of errors along a run.
//!
//! If heat rises faster with temperature than it is carried off, or a film grows as a body cools,
//! two states that differ a little diverge, and so does a computed state from the exact one. If
//! nothing changes by itself, the speed `dT/dt` obeys the same linear equation along the solution
//! as such a difference. So the speed gives the growth of an error: at most as much as the largest
//! speed has grown since. In networks that only lose heat it never grows. If a capacity falls,
//! errors of the heat content become larger errors of the temperature.
//!
//! If the error grows, the run is repeated with a tolerance that is smaller by this factor.

use lptn_assembly::ThermalSystem;

use crate::linearised::is_proportional;

/// A change of all states below this number of tolerances gives only a limit of the speed.
const TOLD: f64 = 50.0;

/// Errors that grow by at most this factor need no smaller tolerance.
const BORNE: f64 = 1.1;

/// The assumed growth if steps pass something narrow over temperature, whose errors have no time to
/// decay.
pub(crate) const NARROW: f64 = 1.2;

/// The tolerance is tightened by this factor more than an error grows: nothing decays in that time,
/// so that the errors of the steps add up, all of one sign. With a heat of reaction that nearly
/// doubles the speed, this was measured to make ten tolerances of them.
const SPARE: f64 = 4.0;

/// Errors that grow by this factor more than the tolerance allows for are reported.
pub(crate) const TELLING: f64 = 4.0;

/// The growth of errors.
#[derive(Clone, Debug)]
pub(crate) struct Growth {
    tolerance: f64,
    /// The state from which the next speed is computed, and the time since then in s.
    before: Vec<f64>,
    elapsed: f64,
    /// Change of each temperature over that of its state, at least 1.
    weights: Vec<f64>,
    /// The largest change of a state in K/s; unknown after a jump.
    speed: Option<f64>,
    /// Growth of errors since they were smallest, and its maximum.
    now: f64,
    most: f64,
}

impl Growth {
    /// `None` for a network in which no error grows, and for one whose inputs change by themselves
    /// between two jumps: there the speed gives no growth. `tolerance` is that of the integrator in
    /// K.
    pub(crate) fn of(system: &ThermalSystem, tolerance: f64) -> Option<Self> {
        let told = !is_proportional(system) && system.network().stands_still();
        told.then(|| Self {
            tolerance,
            before: Vec::new(),
            elapsed: 0.0,
            weights: Vec::new(),
            speed: None,
            now: 1.0,
            most: 1.0,
        })
    }

    /// Begins at a state, after a jump or for the first time.
    pub(crate) fn begin(&mut self, state: &[f64]) {
        self.before = state.to_vec();
        self.speed = None;
        self.elapsed = 0.0;
    }

    /// Takes in the slopes of temperatures over their states at the end of a step. If a slope is
    /// below 1 the tolerance is one of the state.
    pub(crate) fn weigh(&mut self, slopes: &[f64]) {
        self.weights.clear();
        self.weights.extend(slopes.iter().map(|slope| slope.max(1.0)));
    }

    /// Takes in a step of `length` in s to a state. Short steps are taken together.
    pub(crate) fn step(&mut self, length: f64, state: &[f64]) {
        self.elapsed += length;
        let changes = state.iter().zip(&self.before).map(|(now, before)| (now - before).abs());
        let weights = self.weights.iter().copied().chain(std::iter::repeat(1.0));
        let change = changes.zip(weights).map(|(change, weight)| change * weight);
        let change = change.fold(0.0, f64::max);
        let least = TOLD * self.tolerance;
        if self.elapsed <= 0.0 {
            return;
        }
        if change < least {
            let most = least / self.elapsed;
            if self.speed.is_some_and(|speed| speed > most) {
                self.takes(most);
            }
            return;
        }
        self.takes(change / self.elapsed);
        self.before.copy_from_slice(state);
        self.elapsed = 0.0;
    }

    /// Takes in a speed in K/s.
    fn takes(&mut self, speed: f64) {
        self.now = (self.now * speed / self.speed.unwrap_or(speed)).max(1.0);
        self.most = self.most.max(self.now);
        self.speed = Some(speed);
    }

    /// The largest growth of an error.
    pub(crate) fn most(&self) -> f64 {
        self.most
    }
}

/// The share of the tolerance that makes up for errors that grow by a factor.
pub(crate) fn share(factor: f64) -> f64 {
    if factor > BORNE { (SPARE * factor).recip() } else { 1.0 }
}

/// The growth of errors that a run made up for, if the integrator had no less than `finest` of the
/// tolerance.
pub(crate) fn made_up(grows: f64, finest: f64) -> f64 {
    grows.min((SPARE * finest).recip()).max(1.0)
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::float_cmp,
        reason = "a test that cannot go on has failed; numbers that are given"
    )]

    use lptn_assembly::ThermalSystem;
    use lptn_network::{Conductance, Context, HeatCapacity, NetworkBuilder, Temperature};

    use super::Growth;

    fn new() -> Growth {
        let (before, weights, speed) = (vec![], vec![], None);
        Growth { tolerance: 1e-5, before, elapsed: 0.0, weights, speed, now: 1.0, most: 1.0 }
    }

    /// The growth of a run with one state over time, in steps of 1 s.
    fn growth(of: impl Fn(f64) -> f64) -> f64 {
        let mut growth = new();
        growth.begin(&[of(0.0)]);
        (1..=50).for_each(|k| growth.step(1.0, &[of(f64::from(k))]));
        growth.most()
    }

    #[test]
    fn an_error_grows_as_the_speed_does() {
        let exact = 4.9_f64.exp();
        let grown = growth(|t| (0.1 * t).exp());
        assert!((grown / exact - 1.0).abs() < 1e-9, "{grown} {exact}");
        assert!((growth(|t| (-0.1 * t).exp()) - 1.0).abs() < 1e-12);
        assert!((growth(|t| 300.0 + 0.5 * t) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn noise_of_a_state_that_rests_is_not_growth() {
        let noise = |t: f64| if t % 2.0 < 0.5 { 0.0 } else { 2e-5 };
        let grown = growth(|t| 100.0 * (-t).exp() + noise(t));
        assert!((grown - 1.0).abs() < 1e-12, "{grown}");
    }

    /// A state of slope 3 changes by three times as much in temperature; one below 1 counts as it
    /// is.
    #[test]
    fn a_temperature_that_changes_more_than_its_state_counts_as_it_changes() {
        let mut growth = new();
        growth.begin(&[0.0]);
        for (slope, state, grown) in
            [(0.2, 1.0, 1.0), (3.0, 2.0, 3.0), (6.0, 3.0, 6.0), (2.0, 4.0, 6.0)]
        {
            growth.weigh(&[slope]);
            growth.step(1.0, &[state]);
            assert!((growth.most() - grown).abs() < 1e-12, "{slope}: {}", growth.most());
        }
        assert!((growth.now - 2.0).abs() < 1e-12);
    }

    /// Fifty tolerances in one or more steps give a speed; less gives only an upper limit.
    #[test]
    fn what_hardly_changes_tells_only_how_fast_it_is_at_most() {
        let mut growth = new();
        growth.begin(&[0.0]);
        growth.step(1.0, &[1.0]);
        growth.step(2.0, &[1.0 + 4e-4]);
        assert!((growth.speed.unwrap() - 2.5e-4).abs() < 1e-15);
        // together with the one before it gives a speed
        growth.step(2.0, &[1.0 + 8e-4]);
        assert!((growth.speed.unwrap() - 2e-4).abs() < 1e-12 && growth.most() <= 1.0);
        growth.step(2.0, &[1.0 + 8e-4 + 5.1e-4]);
        assert!((growth.most() - 5.1 / 4.0).abs() < 1e-9, "{}", growth.most());
        growth.step(0.0, &[9.0]);
        assert!((growth.speed.unwrap() - 2.55e-4).abs() < 1e-12);
    }

    /// A speed that falls to a hundredth and rises again, many times: errors grow a hundredfold
    /// once. Slow parts change by less than 50 tolerances a step.
    #[test]
    fn speeds_that_fall_and_rise_again_count_once() {
        let mut growth = new();
        let mut state = 0.0;
        growth.begin(&[state]);
        for k in 0..100 {
            state += if k % 10 < 5 { 1e-2 } else { 1e-4 };
            growth.step(1.0, &[state]);
        }
        assert!((10.0..=100.1).contains(&growth.most()), "{}", growth.most());
    }

    #[test]
    fn the_tolerance_makes_up_for_what_grows_by_more_than_a_tenth() {
        let shares = [0.5, 1.0, 1.09, 1.2, 10.0].map(super::share);
        let expected = [1.0, 1.0, 1.0, 1.0 / 4.8, 1.0 / 40.0];
        assert!(shares.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{shares:?}");
    }

    #[test]
    fn a_run_makes_up_for_as_much_as_its_finest_tolerance_allows() {
        assert!((super::made_up(100.0, 1e-4) - 100.0).abs() < 1e-12);
        assert!((super::made_up(100.0, 1e-2) - 25.0).abs() < 1e-12);
        assert!((super::made_up(100.0, 1.0) - 1.0).abs() < 1e-12);
    }

    /// Errors do not grow in a network in which nothing acts on itself. If inputs change by
    /// themselves, the speed shows no growth.
    #[test]
    fn growth_is_followed_where_the_speed_tells_it() {
        let is_followed = |power: &str| {
            let mut b = NetworkBuilder::new();
            let body = b.node("body", HeatCapacity(1.0), Temperature(300.0));
            let air = b.boundary("air", Temperature(300.0));
            b.resistor("skin", body, air, Conductance(1.0));
            let power = b.expression_in(Context::Source, power, None).unwrap();
            b.source("heat", body, power);
            let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
            Growth::of(&system, 1e-5).is_some()
        };
        assert!(is_followed("1 [W/K^2] * (T - absolute(300 [K]))^2"));
        assert!(!is_followed("1 [W]"));
        assert!(!is_followed("1 [W] * sin(t / 1 [s])"));
        assert!(!is_followed("1 [W/K^2] * (T - absolute(300 [K]))^2 * sin(t / 1 [s])"));
    }
}
