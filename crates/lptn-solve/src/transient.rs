//! Temperatures over time.

mod failed;
mod finish;
mod fold;
mod guarded;
mod piped;
mod remembered;
mod rest;
mod sampled;
mod switches;

use lptn_assembly::ThermalSystem;
use lptn_network::NoTangents;

use crate::balance::Books;
use crate::certify::{Certifier, Uncertified};
use crate::curved::Curved;
use crate::error::TransientError;
use crate::events::{Crossings, Switching};
use crate::growth::Growth;
use crate::guard::{Guard, Verdict};
use crate::heat::Heat;
use crate::limit;
use crate::method::Method;
use crate::pipe::Shared;
use crate::readings::Readings;
use crate::recorder::Recorder;
use crate::settings::{Proceed, Progress, Transient};
use crate::settings_error::SettingsError;
use crate::solution::{RunStatus, Solution};
use crate::state::State;
use crate::stateless;
use crate::stepper::{Inputs, Stepper, stepper};
use crate::stop_reason::StopReason;
use crate::tangent::Tangent;
use crate::times::{Segment, check_resolution, segments, snap};
use crate::trajectory::Trajectory;
use crate::unsolved::Unsolved;
use crate::window::Window;

use guarded::Effort;
pub(crate) use rest::{FINE, MOVED, ROUGH, Way, rest};

impl Transient {
    /// Runs to the stop.
    ///
    /// # Errors
    /// [`TransientError`]; a run that breaks off hands over its results up to now, and so does one
    /// whose energy balance does not close: no solution that reached its stop has an open one.
    pub fn solve(&self, system: &ThermalSystem) -> Result<Solution, TransientError> {
        self.solve_observed(system, &mut |_| Proceed::Continue)
    }

    /// Runs to the stop and calls `observer` after every step of the integrator; it may interrupt
    /// the run.
    ///
    /// # Errors
    /// As [`Transient::solve`].
    pub fn solve_observed(
        &self,
        system: &ThermalSystem,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Solution, TransientError> {
        self.solve_from(system, &State::initial(system), observer)
    }

    /// [`Transient::solve_observed`] from another state than the network's own start.
    ///
    /// # Errors
    /// As [`Transient::solve`]; a state of another network is an error of the settings.
    pub fn solve_from(
        &self,
        system: &ThermalSystem,
        from: &State,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Solution, TransientError> {
        if !from.fits(system) {
            return Err(TransientError::Settings(SettingsError::State));
        }
        let (mut care, mut grows, mut coarse) = (Care::Untried, 1.0, None);
        loop {
            let effort = Effort { care, grows };
            let attempt =
                match (self.attempt(system, from, (effort, &mut *observer)), coarse.take()) {
                    (Err(_), Some(solution)) => return closed(solution),
                    (attempt, _) => attempt?,
                };
            if let Some(solution) = attempt {
                if grows > 1.0 || !self.can_make_up_for(&solution) {
                    return closed(solution);
                }
                (grows, coarse) = (solution.growth, Some(solution));
                continue;
            }
            if !self.sensitivities.is_empty() || self.trajectory {
                return Err(TransientError::Settings(SettingsError::Sensitivity(
                    NoTangents::Leaps,
                )));
            }
            care = Care::Leaps;
        }
    }

    /// A run, or `None` if it shows that more care is needed.
    fn attempt(
        &self,
        system: &ThermalSystem,
        from: &State,
        (effort, observer): (Effort, &mut dyn FnMut(Progress) -> Proceed),
    ) -> Result<Option<Solution>, TransientError> {
        let rows = self.rows().map_err(TransientError::Settings)?;
        let network = system.network();
        if network.reads_time() || !self.windows.is_empty() || network.first_sampled().is_some() {
            check_resolution(self.start, self.stop).map_err(TransientError::Settings)?;
        }
        let mut breakpoints =
            network.breakpoints(self.start, self.stop).map_err(TransientError::Input)?;
        snap(&mut breakpoints, &rows, (self.start, self.stop));
        breakpoints.dedup();
        let segments = segments(self.start, self.stop, &breakpoints);
        let curved = Curved::of(system, &segments, &rows);
        let of_limits = limit::window(network, (self.start, self.stop));
        let windows: Vec<Window> = self.windows.iter().cloned().chain(of_limits).collect();
        let days = self.drawn.as_ref().filter(|drawn| drawn.days).map(|drawn| &drawn.of);
        let readings = Readings::new(network, &segments, &rows, (&windows, days))
            .map_err(TransientError::Input)?;
        let recorder = Recorder::new(system, (rows, readings), self)?;
        if system.states().is_empty() {
            let solution = stateless::solve(recorder, &segments, &self.books(network))?;
            let certificate = self.certify.then(|| Err(Uncertified::without_state(system)));
            return Ok(Some(Solution { certificate, ..solution }));
        }
        Run::new(recorder, (&segments, curved), (self, effort), from)?.through(&segments, observer)
    }
}

impl Transient {
    fn books(&self, network: &lptn_network::Network) -> Books {
        Books::new(network, self.balance).allowing(self.balance_error)
    }
}

/// A run that did not reach its stop or whose energy balance closes; no one relies on the balance
/// of an interrupted run.
fn closed(solution: Solution) -> Result<Solution, TransientError> {
    match solution.ledger().check() {
        Err(open) if solution.end() == RunStatus::Reached => {
            Err(TransientError::Open { open, solution: Box::new(solution) })
        }
        _ => Ok(solution),
    }
}

/// Required accuracy of the times at which massless nodes jump.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Care {
    /// No jump is known: at a fold the run ends, and is repeated with care. Errors before it are
    /// made already: as with a switch, they move the jump and all that follows. If heat changes as
    /// the root of the time that is left, all steps err to one side.
    Untried,
    /// The accuracy of the times of switches.
    Leaps,
    /// No accuracy: only the result of the jump is needed.
    Way,
}

/// Reason why a run ends before its stop.
enum Break {
    Interrupted,
    /// A fold is ahead of a run that was not known to have one.
    Fold,
    Failed(StopReason),
}

/// A run under way.
pub(crate) struct Run<'a> {
    integrator: Stepper<'a>,
    method: Method,
    recorder: Recorder<'a>,
    initial: Vec<f64>,
    books: Books,
    tolerance: f64,
    /// Positions that have to switch when the next segment begins.
    due: Vec<usize>,
    /// `None` unless an input curves.
    curved: Option<Curved>,
    /// `None` unless tables, kinks or functions that turn read temperatures.
    guard: Option<Guard>,
    /// `None` unless errors may grow.
    growth: Option<Growth>,
    /// The growth that the tolerance allows for.
    grows: f64,
    /// `None` unless something switches.
    switching: Option<Switching<'a>>,
    /// `None` without pipes.
    pipes: Option<Shared>,
    /// `None` unless bounds on the errors are asked for.
    certifier: Option<Result<Certifier<'a>, Uncertified>>,
    /// `None` unless it is kept.
    trajectory: Option<Trajectory>,
    /// True if temperatures may bend at the present time, for what enters a pipe.
    bends: bool,
    /// Steps in a row, each after refused ones, that are too short to make progress.
    crawled: usize,
    /// Attempts in a row that failed before a fold.
    stuck: usize,
    care: Care,
    /// The last time in s and state at which massless nodes of several solutions were stable.
    stood: Option<(f64, Vec<f64>)>,
}

impl<'a> Run<'a> {
    fn new(
        mut recorder: Recorder<'a>,
        (segments, curved): (&[Segment], Option<Curved>),
        (settings, effort): (&Transient, Effort),
        from: &State,
    ) -> Result<Self, TransientError> {
        let system = recorder.system();
        let initial = from.carried().to_vec();
        let books = settings.books(system.network());
        let unsolved = |e| TransientError::Start(Unsolved::new(system, e));
        let mut heat = Heat::new(system, segments[0].inside(), books.clone()).map_err(unsolved)?;
        if !from.stood().is_empty() {
            heat.stand_at(from.stood());
        }
        heat.samples = sampled::of(system, effort.care);
        let reads = (from, settings.tolerance, effort.care);
        let pipes = piped::attach(system, (&mut heat, &mut recorder), reads).map_err(unsolved)?;
        let mut carried = Vec::new();
        if !settings.sensitivities.is_empty() {
            let tangent = Tangent::new(system, &settings.sensitivities)?;
            let own_start = *from == State::initial(system);
            carried =
                heat.follow(tangent, (settings.start, &initial, own_start)).map_err(unsolved)?;
        }
        recorder.remembered = curved.as_ref().map_or(0.0, |c| c.remembered);
        let switching = system
            .network()
            .has_events()
            .then(|| Switching::new(system, &settings.controls, settings.tolerance));
        let finer = system.network().has_events() || effort.care == Care::Leaps;
        let care = if finer { Care::Leaps } else { effort.care };
        let grows = effort.grows;
        let options = settings.options(system, (finer, grows), curved.as_ref());
        let guard = Guard::of(system, options.tolerance);
        let growth = Growth::of(system, options.tolerance);
        let straight = curved.is_none() && system.network().inputs_are_straight();
        let inputs = Inputs { curved: !straight, parts: settings.parts(segments) };
        let choice = (settings.integrator_for(system), inputs);
        let (mut integrator, method) = stepper(heat, (settings.start, &initial), &options, choice)?;
        let certifier = settings.certify.then(|| recorder.certifier(method, &initial, settings));
        if !carried.is_empty() {
            integrator.set_sensitivities(&carried).map_err(TransientError::Integrator)?;
        }
        let trajectory = settings.trajectory.then(|| Trajectory::new(system.network()));
        Ok(Self {
            integrator,
            method,
            recorder,
            initial,
            books,
            tolerance: settings.tolerance,
            due: Vec::new(),
            switching,
            pipes,
            certifier,
            trajectory,
            bends: true,
            curved,
            guard,
            growth,
            grows,
            crawled: 0,
            stuck: 0,
            care,
            stood: None,
        })
    }

    fn through(
        mut self,
        segments: &[Segment],
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Option<Solution>, TransientError> {
        for (i, &segment) in segments.iter().enumerate() {
            let outcome = self.segment(segment, i == 0, observer);
            match outcome {
                Ok(()) => {}
                Err(Break::Interrupted) => {
                    let end = RunStatus::Interrupted(self.integrator.time());
                    return self.finish(end).map(Some);
                }
                Err(Break::Fold) => return Ok(None),
                Err(Break::Failed(reason)) => {
                    let time = self.integrator.time();
                    let partial = Box::new(self.finish(RunStatus::Failed(time))?);
                    return Err(TransientError::Stopped { time, reason, partial });
                }
            }
        }
        self.end_stays();
        self.finish(RunStatus::Reached).map(Some)
    }

    /// Integrates one segment; a row at its start is written with the inputs after the jump.
    fn segment(
        &mut self,
        segment: Segment,
        first: bool,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<(), Break> {
        self.begin(segment, first)?;
        while self.integrator.time() < segment.to {
            self.step(segment)?;
            let (start, stop) = self.recorder.span();
            if observer(Progress { start, time: self.integrator.time(), stop })
                == Proceed::Interrupt
            {
                return Err(Break::Interrupted);
            }
        }
        Ok(())
    }

    /// Changes to the inputs of a segment.
    fn begin(&mut self, segment: Segment, first: bool) -> Result<(), Break> {
        self.integrator.system_mut().enter(segment.inside());
        let due = std::mem::take(&mut self.due);
        let before = self.before_switch(f64::NAN);
        self.switch(&due, first)?;
        self.remember_switch(&due, before)?;
        self.sample(segment, first)?;
        self.enter(segment)
    }

    /// Enters a segment, or the rest of it after an event.
    fn enter(&mut self, segment: Segment) -> Result<(), Break> {
        self.stand()?;
        self.begin_to_guard();
        self.bends = true;
        self.recorder.enter(segment, self.switching.as_ref().map(|switching| &switching.positions));
        self.remember_stretch(self.integrator.time());
        if self.method == Method::OneStep {
            self.integrator.system_mut().draw_line((segment.from, segment.to));
            self.recorder.draw_line();
        }
        let sensitivities = self.integrator.sensitivities().map(<[f64]>::to_vec);
        let sensitivities = sensitivities.map_err(|e| self.failed(e))?;
        self.recorder.start(self.integrator.state(), &sensitivities).map_err(Break::Failed)
    }

    /// One step, or the part of it up to an event.
    fn step(&mut self, segment: Segment) -> Result<(), Break> {
        let armed =
            self.switching.as_ref().map_or(f64::INFINITY, |s| s.next_armed(self.integrator.time()));
        let (stop, longest) = self.hold_for_pipes(segment.to.min(armed))?;
        self.hold_step(stop, longest);
        let step = match self.integrator.step() {
            Ok(step) => step,
            Err(error) => return self.leap_or_fail(segment, error),
        };
        self.check_crawl(step.to - step.from)?;
        let verdict = self.judged(&step)?;
        if verdict == Verdict::Back {
            return Ok(());
        }
        let Crossings { mut due, time: crossed, looks } = self.crossings(&step)?;
        let to = self.reaches(step.from, crossed)?;
        let (to, leaves) = self.pipes_reach(step.from, to)?;
        if to < crossed {
            due.clear();
        }
        let cut = !due.is_empty() || leaves.is_some();
        self.recorder.edges(cut.then_some(to), armed);
        let row = self.recorder.written();
        self.recorder.step(self.integrator.as_mut(), step.from, to).map_err(Break::Failed)?;
        self.bound_errors((step.from, to), segment);
        self.remember_step(step.from, to)?;
        if let Some(switching) = &mut self.switching {
            switching.reach(to, self.recorder.span(), self.recorder.written() > row);
        }
        self.fill_pipes(step.from, to)?;
        if to < step.to {
            self.integrator.rewind(to).map_err(|e| self.failed(e))?;
            self.guard_begins();
        }
        self.errors_go_on(to - step.from);
        self.watch_thresholds(&looks, to);
        if to >= segment.to {
            self.due = due; // the next segment begins with it
            return Ok(());
        }
        let happens = !due.is_empty() || to >= armed;
        if let (Some(edge), false) = (leaves, happens) {
            self.integrator.restart(None).map_err(|e| self.failed(e))?;
            self.enter(Segment { from: to, to: segment.to })?;
            // a bend that leaves bends no other temperature
            self.bends = edge.jumps;
            return Ok(());
        }
        let before = self.before_switch(if to >= armed { armed } else { f64::NAN });
        if happens && (self.switch(&due, false)? || !due.is_empty()) {
            self.remember_switch(&due, before)?;
            self.integrator.restart(None).map_err(|e| self.failed(e))?;
            return self.enter(Segment { from: to, to: segment.to });
        }
        if verdict == Verdict::BeginsAnew && to >= step.to {
            self.integrator.restart(None).map_err(|e| self.failed(e))?;
            self.guard_begins();
        }
        self.stand_or_leap(segment)
    }
}
