//! Means and extremes of days, as windows one after the other.

use lptn_network::Network;

use super::{Recorder, StateAt};
use crate::drawn::{DAY, Day, Drawn};
use crate::readings::pieces;
use crate::stop_reason::StopReason;
use crate::tracked::Tracked;
use crate::window::Window;

/// More numbers than this are not kept: 64 MB.
pub(super) const MOST_NUMBERS: usize = 8_000_000;

/// The days of a run up to now.
#[derive(Clone, Debug)]
pub(crate) struct Days {
    /// The part of the run that is drawn, in s.
    span: (f64, f64),
    /// The present day; `None` after the last one.
    now: Option<Tracked>,
    past: Vec<Day>,
}

impl Days {
    /// `None` if they are not wanted, or need too much memory.
    pub(super) fn new(drawn: &Drawn, run: (f64, f64), network: &Network) -> Option<Self> {
        let span = (drawn.span.0.max(run.0), drawn.span.1.min(run.1));
        let numbers = ((span.1 - span.0) / DAY + 2.0) * 3.0 * drawn.of.quantities().len() as f64;
        let kept = drawn.days && span.0 < span.1 && numbers <= MOST_NUMBERS as f64;
        let first = window(drawn, (span.0, span));
        kept.then(|| Self { span, now: Some(Tracked::new(first, network)), past: Vec::new() })
    }

    pub(super) fn jump(&mut self) {
        self.now.iter_mut().for_each(Tracked::jump);
    }

    /// Ends the present day, and begins the next one.
    fn turn(&mut self, network: &Network) {
        let Some(ended) = self.now.take() else { return };
        let Window { to, of, .. } = ended.window.clone();
        self.past.extend(ended.into_day());
        let drawn = Drawn { of, span: self.span, days: true };
        let next = window(&drawn, (to, self.span));
        self.now = (to < self.span.1).then(|| Tracked::new(next, network));
    }

    pub(super) fn into_past(mut self) -> Vec<Day> {
        self.past.extend(self.now.take().and_then(Tracked::into_day));
        self.past
    }
}

/// The window of the day that begins at `from`.
fn window(drawn: &Drawn, (from, span): (f64, (f64, f64))) -> Window {
    let to = (((from / DAY).floor() + 1.0) * DAY).min(span.1);
    Window { name: String::new(), from, to, of: drawn.of.clone() }
}

impl Recorder<'_> {
    /// Takes a step into the days that it reaches.
    pub(super) fn count_days(
        &mut self,
        step: (f64, f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        let Some(mut days) = self.days.take() else { return Ok(()) };
        let mut outcome = Ok(());
        for (piece, _) in pieces(&self.readings.days, step) {
            self.inside = self.readings.inside(piece.0);
            while let (Some(now), true) = (&mut days.now, outcome.is_ok()) {
                outcome = self.track(now, piece, state_at);
                if now.window.to > piece.1 {
                    break;
                }
                days.turn(self.system.network());
            }
        }
        self.days = Some(days);
        outcome
    }
}
