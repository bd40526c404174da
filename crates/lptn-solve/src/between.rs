//! Temperatures between two solutions of balances, checked for any at which nothing rests.
//!
//! Balances bend and have corners, so that points at even distances may step over a narrow stretch
//! at which nothing rests. If the balances are smooth, the heat left over changes between two
//! points by the mean of its slopes there. If it does not, points are added in the middle.
//!
//! Even points stepped over a stretch next to a corner, and a jump was missed. A stretch below 1e-6
//! K is rounding.

use lptn_assembly::Workspace;

use crate::newton::Newton;
use crate::newton_error::NewtonError;

/// Points between two solutions at which the balances are always evaluated.
const PLACES: u32 = 16;

/// Most points that may be added.
const MORE: usize = 96;

/// The change of the heat left over may differ by this share from the prediction of the slopes at
/// the two ends.
const BENT: f64 = 0.02;

/// A stretch shorter than this, in K, is rounding and not the end of a branch.
pub(crate) const SHORT: f64 = 1e-6;

/// The heat left over at a point on a straight way, with its slope along the way, both in W.
struct Place {
    share: f64,
    left: Vec<f64>,
    slope: Vec<f64>,
}

impl Place {
    /// True if the balances bend between two points more than a parabola does.
    fn bends(&self, next: &Self) -> bool {
        let step = next.share - self.share;
        let changes = self.left.iter().zip(&next.left).map(|(a, b)| b - a);
        let predicted = self.slope.iter().zip(&next.slope).map(|(a, b)| 0.5 * step * (a + b));
        let (mut off, mut most) = (0.0_f64, f64::MIN_POSITIVE);
        for (change, predicted) in changes.zip(predicted) {
            off = off.max((change - predicted).abs());
            most = most.max(predicted.abs());
        }
        off > BENT * most
    }
}

/// A straight way from one set of temperatures to another, all unknowns in K.
struct Way<'a> {
    start: &'a [f64],
    end: &'a [f64],
    /// The largest move of an unknown along the way, in K.
    length: f64,
    /// Points that may still be added.
    left: usize,
}

impl Newton<'_> {
    /// Refuses a solution if nothing rests at some temperatures between `start` and it: it lies on
    /// another branch. All free unknowns move on a straight line here, so that for one massless
    /// node this check is complete.
    ///
    /// # Errors
    /// [`NewtonError::Fold`], or the error of a value or of the factorisation.
    pub(crate) fn stays(
        &mut self,
        work: &mut Workspace,
        start: &[f64],
        end: &[f64],
    ) -> Result<(), NewtonError> {
        let length = self.free.iter().map(|&i| (end[i] - start[i]).abs()).fold(0.0, f64::max);
        let mut way = Way { start, end, length, left: MORE };
        if length > 0.0 {
            self.rests_along(work, &mut way)?;
        } else {
            self.rests_at(work, &way, 1.0)?;
        }
        self.factorize(work, end, 0.0)
    }

    fn rests_along(&mut self, work: &mut Workspace, way: &mut Way<'_>) -> Result<(), NewtonError> {
        self.linearize(work, way.start)?;
        let mut before = self.place(work, way, 0.0)?;
        for place in 1..=PLACES {
            let share = f64::from(place) / f64::from(PLACES);
            self.rests_at(work, way, share)?;
            let next = self.place(work, way, share)?;
            self.rests_between(work, way, (&before, &next))?;
            before = next;
        }
        Ok(())
    }

    /// The same between two neighbouring points.
    fn rests_between(
        &mut self,
        work: &mut Workspace,
        way: &mut Way<'_>,
        (before, next): (&Place, &Place),
    ) -> Result<(), NewtonError> {
        let step = next.share - before.share;
        if way.left == 0 || step * way.length <= SHORT || !before.bends(next) {
            return Ok(());
        }
        way.left -= 1;
        let share = before.share + 0.5 * step;
        self.rests_at(work, way, share)?;
        let middle = self.place(work, way, share)?;
        self.rests_between(work, way, (before, &middle))?;
        self.rests_between(work, way, (&middle, next))
    }

    /// The temperatures at a point, moved by `moved` in K along the way, or all alike if it has no
    /// length.
    fn on(&self, way: &Way<'_>, share: f64, moved: f64) -> Vec<f64> {
        let mut at = way.end.to_vec();
        for &i in &self.free {
            let along = way.end[i] - way.start[i];
            let unit = if way.length > 0.0 { along / way.length } else { 1.0 };
            at[i] = way.start[i] + share * along + moved * unit;
        }
        at
    }

    /// # Errors
    /// [`NewtonError::Fold`] if nothing rests there nor within rounding to one side of it.
    fn rests_at(
        &mut self,
        work: &mut Workspace,
        way: &Way<'_>,
        share: f64,
    ) -> Result<(), NewtonError> {
        let Some(unknown) = self.unstable(work, &self.on(way, share, 0.0))? else { return Ok(()) };
        for moved in [-SHORT, SHORT] {
            if self.unstable(work, &self.on(way, share, moved))?.is_some() {
                return Err(NewtonError::Fold { unknown });
            }
        }
        self.linearize(work, &self.on(way, share, 0.0))
    }

    /// The balances at a point at which the Jacobian was evaluated last.
    fn place(
        &mut self,
        work: &mut Workspace,
        way: &Way<'_>,
        share: f64,
    ) -> Result<Place, NewtonError> {
        let at = self.on(way, share, 0.0);
        self.take_slopes();
        let along: Vec<f64> = self.free.iter().map(|&i| way.end[i] - way.start[i]).collect();
        let mut slope = vec![0.0; along.len()];
        self.pattern.multiply(&self.values, &along, &mut slope);
        slope.iter_mut().for_each(|slope| *slope = -*slope);
        let left = self.residual(work, &at)?;
        Ok(Place { share, left, slope })
    }
}

#[cfg(test)]
mod tests;
