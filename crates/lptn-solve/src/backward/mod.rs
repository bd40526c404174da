//! Gradients of results of a run by its adjoint: one integration back in time for each result,
//! however many parameters there are (Y. Cao, S. Li, L. Petzold and R. Serban, SIAM J. Sci. Comput.
//! 24 (2003) 1076).
//!
//! At a switch the rates jump by `f+ - f-`, and its time moves with the temperatures and parameters.
//! With the distance `g` from the threshold, `dt/dp = -(dg/dp) / (dg/dt)`, and a heat content jumps
//! by `(f- - f+) dt/dp` (I. A. Hiskens and M. A. Pai, IEEE Trans. Circuits Syst. I 47 (2000) 204).
//! The adjoint takes the transposed of this jump. The end of a dwell moves as the switch at which it
//! began.
//!
//! The trajectory is kept in memory. Its error, that of the run, is the largest part of the error of
//! the gradient.

mod error;
mod integral;
mod moment;
mod rate;
mod running;
mod system;
mod transposed;
mod turns;
mod way;

use lptn_network::{Functional, LimitId, ParameterId};

use crate::margin::{Margin, Point};
use crate::result_slopes::MarginSlopes;
use crate::settings::{Proceed, Progress};
use crate::solution::Solution;
use crate::trajectory::{NoTrajectory, Stretch, Trajectory};

pub use error::BackwardError;
use integral::Integral;
use moment::Moment;
use way::Way;

/// Two times that are nearer than this part of a run are the same.
const SAME: f64 = 1e-9;

/// The moment of a result: a stretch of the run, and a time in s in it.
#[derive(Clone, Copy, Debug)]
struct Aim {
    stretch: usize,
    time: f64,
}

/// A result of a run to be differentiated.
struct Asked<'a> {
    solution: &'a Solution,
    trajectory: &'a Trajectory,
    margin: Margin<'a>,
    parameters: &'a [ParameterId],
    observer: &'a dyn Fn(Progress) -> Proceed,
}

impl Solution {
    /// The margin of a limit at the end of the run, its least or its largest value, its mean or its
    /// integral over the run, and the derivatives by these parameters, in SI units. The run begins at
    /// the network's own start and keeps its trajectory ([`crate::Transient::trajectory`]). Controls
    /// and comparisons may switch.
    /// `observer` is called after every step of the way back and may interrupt it.
    ///
    /// # Errors
    /// [`BackwardError`]
    pub fn margin_gradient(
        &self,
        (limit, functional): (LimitId, Functional),
        parameters: &[ParameterId],
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<MarginSlopes, BackwardError> {
        let trajectory = self.trajectory.as_deref().ok_or(NoTrajectory::Unknown)?;
        trajectory.check()?;
        let margin = Margin { system: &self.system, limit };
        let asked = Asked { solution: self, trajectory, margin, parameters, observer };
        match functional {
            Functional::Mean | Functional::Integral => asked.integrated(functional),
            Functional::Min => asked.of_moment(asked.worst()?),
            Functional::Last => {
                let stretch = trajectory.stretches.len() - 1;
                asked.of_moment(Aim { stretch, time: trajectory.stretches[stretch].span().1 })
            }
            _ => {
                let name = self.network().limits()[limit.index()].text.clone();
                Err(BackwardError::Functional { name })
            }
        }
    }
}

impl Asked<'_> {
    /// The stretches that contain a time.
    fn around(&self, time: f64) -> impl Iterator<Item = usize> + '_ {
        let room = SAME * self.length();
        let holds = move |stretch: &Stretch| {
            let (from, to) = stretch.span();
            (from - room..=to + room).contains(&time)
        };
        self.trajectory.stretches.iter().enumerate().filter(move |(_, s)| holds(s)).map(|(k, _)| k)
    }

    /// The error of a result whose integral does not settle.
    fn unresolved(&self) -> BackwardError {
        let limits = self.margin.system.network().limits();
        BackwardError::Unresolved { name: limits[self.margin.limit.index()].text.clone() }
    }

    /// End of the run in s.
    fn end(&self) -> f64 {
        self.trajectory.stretches.last().map_or(0.0, |stretch| stretch.span().1)
    }

    /// Duration of the run in s.
    fn length(&self) -> f64 {
        let ends = [self.trajectory.stretches.first(), self.trajectory.stretches.last()];
        let [first, last] = ends.map(|stretch| stretch.map_or((0.0, 0.0), Stretch::span));
        last.1 - first.0
    }

    /// The run in a stretch at a time in s.
    fn point(
        &self,
        moment: &mut Moment<'_>,
        (stretch, time): (usize, f64),
    ) -> Result<Point, BackwardError> {
        let stretch = &self.trajectory.stretches[stretch];
        let mut state = vec![0.0; self.margin.system.states().len()];
        stretch.at(time, &mut state);
        let (at, positions) = ((time, stretch.inside), stretch.positions.clone());
        let branch = stretch.branch(time);
        moment.set_positions(positions.as_ref());
        moment.stand(branch);
        moment.go(at, &state)?;
        Ok(Point { at, positions, nodes: moment.nodes().to_vec(), weight: 1.0 })
    }

    /// The moment at which the margin is least. At a jump the side whose margin it is.
    fn worst(&self) -> Result<Aim, BackwardError> {
        let seen = self.solution.limits()[self.margin.limit.index()];
        let mut moment = Moment::new(self.margin.system, &[])?;
        let mut best: Option<(f64, Aim)> = None;
        for stretch in self.around(seen.worst_at) {
            let (from, to) = self.trajectory.stretches[stretch].span();
            let near = |end: f64| (seen.worst_at - end).abs() <= SAME * self.length();
            let inside = if near(from) { from } else { seen.worst_at };
            let time = if near(to) { to } else { inside };
            let point = self.point(&mut moment, (stretch, time))?;
            let off = (self.margin.at(&point)? - seen.margin).abs();
            // of two sides that agree the one before
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, Aim { stretch, time }));
            }
        }
        let Some((_, aim)) = best else { return Err(NoTrajectory::Unknown.into()) };
        let (from, to) = self.trajectory.stretches[aim.stretch].span();
        let is_inside = from < aim.time && aim.time < to;
        if is_inside { self.level(&mut moment, aim) } else { Ok(aim) }
    }

    fn of_moment(&self, aim: Aim) -> Result<MarginSlopes, BackwardError> {
        let mut way = Way::new(self, Some(aim))?;
        let (_, margin) = way.read(aim.stretch, aim.time)?;
        let by = way.back()?;
        Ok(MarginSlopes { margin, by })
    }

    fn integrated(&self, functional: Functional) -> Result<MarginSlopes, BackwardError> {
        let mut way = Way::new(self, None)?;
        let integral = Integral::of(&mut way)?;
        way.integrator.system_mut().typical = integral.size / self.length();
        let mut by = way.back()?;
        if self.margin.nodes_alone().is_none() {
            for (by, &parameter) in by.iter_mut().zip(self.parameters) {
                *by += self.margin.directly(&integral.points, parameter)?;
            }
        }
        let over = if functional == Functional::Mean { self.length() } else { 1.0 };
        by.iter_mut().for_each(|slope| *slope /= over);
        Ok(MarginSlopes { margin: integral.value / over, by })
    }
}
