//! Memory for the evaluation of a system: one per thread, so that evaluating allocates nothing.
//!
//! Inputs that are straight lines are read at the ends of a segment (`Workspace::draw_line`), not
//! at every step and row. Expressions that read the time in another way are updated on request.

use lptn_network::{Evaluation, InputError, Network, Positions, SourceId};

use crate::slopes::Slopes;

/// Inputs at one time, and the temperatures of all vertices.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Values that expressions read; older than the inputs if there is a line, see `behind`.
    pub(crate) scope: Evaluation,
    /// Heat of every source in W.
    pub(crate) power: Vec<f64>,
    /// The sources to evaluate again when the time changes; the others only when something
    /// switches.
    timed: Vec<SourceId>,
    /// True if `power` includes the heat of the other sources.
    settled: bool,
    /// Heat put into every vertex in W, that of massless nodes passed on.
    pub(crate) heat: Vec<f64>,
    /// Heat that elements other than constant conductances bring to every vertex in W.
    pub(crate) element_heat: Vec<f64>,
    /// Temperature of every vertex in K: nodes, then boundaries.
    pub(crate) temperature: Vec<f64>,
    pub(crate) slopes: Slopes,
    /// Potential or conductivity of the vertices of a body.
    pub(crate) potentials: Vec<f64>,
    /// Heat of the elements that were evaluated together in W, by their positions; NaN for others.
    pub(crate) together: Vec<f64>,
    /// States of the controls and truth of the comparisons.
    positions: Positions,
    /// True if the inputs must be evaluated again when the time changes.
    varies: bool,
    /// The time and segment that the inputs were read for.
    read_at: Option<(f64, f64)>,
    /// The inputs of the present segment, if they are straight lines in time.
    line: Option<Line>,
    /// True if `scope` is not at the time of `read_at`.
    behind: bool,
}

/// Inputs that change evenly over a segment.
#[derive(Clone, Debug)]
struct Line {
    from: f64,
    to: f64,
    /// Time of the comparisons of `t` in s; they have the same truth between the ends.
    segment: f64,
    /// Heat of every source in W, temperatures of the boundaries in K, at the two ends.
    power: [Vec<f64>; 2],
    boundaries: [Vec<f64>; 2],
}

impl Line {
    /// The share of the line at a time, if the time is on it.
    fn share(&self, time: f64, segment: f64) -> Option<f64> {
        let inside = self.from < segment && segment < self.to;
        let same = inside || self.segment.to_bits() == segment.to_bits();
        let on = same && (self.from..=self.to).contains(&time);
        on.then(|| (time - self.from) / (self.to - self.from))
    }
}

/// Interpolates between two ends.
fn between([first, last]: &[Vec<f64>; 2], share: f64, out: &mut [f64]) {
    for ((out, a), b) in out.iter_mut().zip(first).zip(last) {
        *out = a + share * (b - a);
    }
}

impl Workspace {
    pub(crate) fn new(network: &Network) -> Self {
        let vertices = network.nodes().len() + network.boundaries().len();
        Self {
            scope: network.evaluation(),
            power: vec![0.0; network.sources().len()],
            timed: network.timed_sources(),
            settled: false,
            heat: vec![0.0; vertices],
            element_heat: vec![0.0; vertices],
            temperature: vec![f64::NAN; vertices],
            slopes: Slopes::default(),
            potentials: Vec::new(),
            together: Vec::new(),
            positions: network.initial_positions(),
            varies: network.has_time_dependent_inputs(),
            read_at: None,
            line: None,
            behind: false,
        }
    }

    /// Reads sources and boundaries at `time` [s] unless that was done; true if they are new.
    pub(crate) fn read(
        &mut self,
        network: &Network,
        time: f64,
        segment: f64,
    ) -> Result<bool, InputError> {
        let now = (time.to_bits(), segment.to_bits());
        let known =
            self.read_at.is_some_and(|(t, s)| !self.varies || (t.to_bits(), s.to_bits()) == now);
        if known {
            return Ok(false);
        }
        self.read_at = None; // an error leaves nothing half read
        let boundaries = network.nodes().len();
        if let Some((line, share)) =
            self.line.as_ref().and_then(|line| Some((line, line.share(time, segment)?)))
        {
            between(&line.power, share, &mut self.power);
            between(&line.boundaries, share, &mut self.temperature[boundaries..]);
            (self.read_at, self.behind) = (Some((time, segment)), true);
            return Ok(true);
        }
        self.behind = false;
        self.scope.set_time(time, segment);
        self.read_powers(network)?;
        network.boundary_temperatures(&mut self.scope, &mut self.temperature[boundaries..])?;
        self.read_at = Some((time, segment));
        Ok(true)
    }

    fn read_powers(&mut self, network: &Network) -> Result<(), InputError> {
        if !self.settled {
            network.source_powers(&mut self.scope, &mut self.power)?;
            self.settled = true;
            return Ok(());
        }
        for &id in &self.timed {
            self.power[id.index()] = network.source_heat(id, &mut self.scope, &[])?;
        }
        Ok(())
    }

    /// Treats the inputs between two times of a segment as straight lines, which the caller must
    /// know: a system with many sources is read at two times, not at every step and row. For
    /// linear systems; forgotten when something switches or another line is drawn.
    pub fn draw_line(&mut self, network: &Network, (from, to): (f64, f64), segment: f64) {
        self.forget();
        if !self.varies || from >= to {
            return;
        }
        let mut ends = [from, to].into_iter().map_while(|time| {
            // a failure occurs again, and is reported, when the input is read
            self.read(network, time, segment).ok()?;
            Some((self.power.clone(), self.temperature[network.nodes().len()..].to_vec()))
        });
        let line = match (ends.next(), ends.next()) {
            (Some((first, at_first)), Some((last, at_last))) => Some(Line {
                from,
                to,
                segment,
                power: [first, last],
                boundaries: [at_first, at_last],
            }),
            _ => None,
        };
        self.forget();
        self.line = line;
    }

    /// Runs `act` with inputs that are read themselves, not taken from a line; afterwards they must
    /// be read again.
    pub(crate) fn off_line<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        let Some(line) = self.line.take() else { return act(self) };
        self.read_at = None;
        let done = act(self);
        (self.read_at, self.line) = (None, Some(line));
        done
    }

    /// Values that expressions read, at the time of the inputs last read, and the temperatures.
    pub(crate) fn current(&mut self) -> (&mut Evaluation, &[f64]) {
        if let (true, Some((time, segment))) = (self.behind, self.read_at) {
            self.scope.set_time(time, segment);
            self.behind = false;
        }
        (&mut self.scope, &self.temperature)
    }

    /// Sets the states of the controls and the truth of the comparisons, at the start
    /// [`Network::initial_positions`]; inputs must be read again.
    pub fn set_positions(&mut self, positions: &Positions) {
        self.scope.set_positions(positions);
        self.positions.clone_from(positions);
        self.settled = false;
        self.forget();
    }

    /// States of the controls and truth of the comparisons.
    pub fn positions(&self) -> &Positions {
        &self.positions
    }

    /// Discards the inputs that were read.
    pub(crate) fn forget(&mut self) {
        self.read_at = None;
        self.line = None;
        self.behind = false;
    }
}
