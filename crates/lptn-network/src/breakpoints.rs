//! Times at which an input bends or jumps: known in advance, so that no step crosses them.

use lptn_units::{Comparison, Degree, Program};

use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{Field, Item, SignalId, SourceId};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::parts::Parts;
use crate::parts::layout::Holds;
use crate::parts::watched::Watched;
use crate::value::Value;

/// Parts of a stretch in which a curve is searched for a bend.
const LOOKS: u32 = 256;

/// Halvings of the interval in which it does: to the rounding of the time.
const BISECTIONS: usize = 60;

/// Most samples of a state in a run.
const MOST_SAMPLES: f64 = 1e6;

/// A stretch of time without a point of a signal inside, from and to in s.
type Stretch = (f64, f64);

impl Network {
    /// The times inside `(start, stop)` in s at which an input of the heat flows may bend or jump,
    /// ascending: points of signals, changes of comparisons, kinks of `abs`, `min` and `max`, knots
    /// of tables, and the times at which states are sampled.
    ///
    /// A comparison goes straight between points of signals and kinks of its `abs`, `min` and `max`
    /// (the builder refuses others), so its two sides meet at most once there. Kinks of curves are
    /// looked for in small steps.
    ///
    /// A value that is not defined at some time is left to the run, which reports it.
    ///
    /// # Errors
    /// [`InputProblem::TooManyPoints`] for a signal that is repeated beyond reason.
    pub fn breakpoints(&self, start: f64, stop: f64) -> Result<Vec<f64>, InputError> {
        let mut times = self.times_of(&self.parts.driving(), (start, stop))?;
        if self.sample_times((start, stop), &mut times)? {
            tidy(&mut times, start, stop);
        }
        Ok(times)
    }

    /// Adds the times at which states are sampled, multiples of the time between samples; false if
    /// there are none.
    fn sample_times(
        &self,
        (start, stop): Stretch,
        times: &mut Vec<f64>,
    ) -> Result<bool, InputError> {
        let before = times.len();
        for (id, every) in self.sampled_states() {
            let (first, last) = ((start / every).ceil(), (stop / every).floor());
            if last - first > MOST_SAMPLES {
                return Err(InputError {
                    item: Item::State(id),
                    field: Field::Every,
                    name: self.states()[id.index()].name.clone(),
                    problem: InputProblem::TooManyPoints(last - first),
                });
            }
            let count = (last - first).max(0.0) as u32;
            times.extend((0..=count).map(|k| (first + f64::from(k)) * every));
        }
        Ok(times.len() > before)
    }

    /// The same for results: limits, reports and signals, which are evaluated over time too but
    /// change no heat flow. A result at one of these times is to be read inside the stretch on its
    /// right.
    ///
    /// # Errors
    /// As [`Network::breakpoints`].
    pub fn result_breakpoints(
        &self,
        items: &[Item],
        (start, stop): (f64, f64),
    ) -> Result<Vec<f64>, InputError> {
        self.times_of(&self.parts.results(items), (start, stop))
    }

    /// The same for a value that is not part of the network.
    ///
    /// # Errors
    /// As [`Network::breakpoints`].
    pub fn value_breakpoints(
        &self,
        value: &Value,
        span: (f64, f64),
    ) -> Result<Vec<f64>, InputError> {
        self.times_of(&self.parts.watched(vec![value], &[]), span)
    }

    /// Everything that is evaluated over time in addition to the inputs of the heat flows: limits,
    /// reports, and signals that drive nothing.
    pub fn results(&self) -> Vec<Item> {
        let driving = self.parts.driving().signals;
        let idle = self.signal_ids().filter(|id| !driving[id.index()]);
        let limits = self.limit_ids().map(Item::Limit);
        limits.chain(self.report_ids().map(Item::Report)).chain(idle.map(Item::Signal)).collect()
    }

    fn times_of(&self, what: &Watched<'_>, (start, stop): Stretch) -> Result<Vec<f64>, InputError> {
        let mut times = self.points(&what.signals, (start, stop), true)?;
        let mut ends = self.points(&what.signals, (start, stop), false)?;
        ends.insert(0, start);
        ends.push(stop);
        let stretches: Vec<Stretch> = ends.windows(2).map(|pair| (pair[0], pair[1])).collect();
        let mut scope = self.evaluation();
        for value in &what.values {
            for difference in self.differences(value) {
                for &stretch in &stretches {
                    for stretch in difference.straight(&mut scope, stretch) {
                        // a part in a branch that is not taken may have no value there
                        let _ = crossings(&difference, &mut scope, stretch, &mut times);
                    }
                }
            }
        }
        tidy(&mut times, start, stop);
        Ok(times)
    }

    /// Points of the signals that are used; with `bends` only those at which one may bend or jump.
    fn points(&self, used: &[bool], span: (f64, f64), bends: bool) -> Result<Vec<f64>, InputError> {
        let mut times = Vec::new();
        let signals = self.signals().iter().zip(used).enumerate();
        for (i, (signal, _)) in signals.filter(|(_, (_, used))| **used) {
            signal.course.points(span, bends, &mut times).map_err(|count| InputError {
                item: Item::Signal(SignalId::from_len(i)),
                field: Field::Period,
                name: signal.name.clone(),
                problem: InputProblem::TooManyPoints(count),
            })?;
        }
        tidy(&mut times, span.0, span.1);
        Ok(times)
    }

    /// Differences whose roots are the times at which a value bends or jumps.
    fn differences(&self, value: &Value) -> Vec<Difference> {
        let mut differences = Vec::new();
        for program in value.programs() {
            let plain = program.comparisons().iter().chain(program.kinks());
            differences.extend(plain.map(|p| self.parts.difference(p, program.kinks())));
            for call in program.table_calls() {
                let axes = (0..call.table.dimension()).map(|axis| call.table.knots(axis));
                let pairs = call.arguments.iter().zip(axes);
                differences.extend(pairs.map(|(argument, knots)| Difference {
                    knots: knots.to_vec(),
                    ..self.parts.difference(argument, &[])
                }));
            }
        }
        let parts = &self.parts;
        let of_time = |d: &Difference| {
            let value = Value::Expression(d.program.clone().into());
            d.degree > Degree::Constant && !parts.reads(&value).reads_results()
        };
        differences.retain(of_time);
        differences
    }

    /// Degree in time of a source's heat between [`Network::breakpoints`], at fixed temperatures.
    pub fn course_of_source(&self, id: SourceId) -> Degree {
        let source = &self.sources()[id.index()];
        let course = |value: &Value| self.course(value);
        match source.power() {
            Some(power) => course(power),
            None if source.law.values().iter().all(|v| course(v) == Degree::Constant) => {
                Degree::Constant
            }
            None => Degree::Nonlinear,
        }
    }

    /// True if the heat of every source and the temperature of every boundary is a straight line in
    /// time between [`Network::breakpoints`], with switches fixed.
    pub fn inputs_are_straight(&self) -> bool {
        let mut boundaries = self.boundaries().iter();
        boundaries.all(|boundary| self.course(&boundary.temperature) < Degree::Nonlinear)
            && self.source_ids().all(|id| self.course_of_source(id) < Degree::Nonlinear)
    }

    /// True if no input changes with time between [`Network::breakpoints`] except through
    /// temperatures.
    pub fn stands_still(&self) -> bool {
        let mut driving = self.inputs().filter(|(item, _, _)| !matches!(item, Item::Signal(_)));
        driving.all(|(_, _, value)| self.course(value) == Degree::Constant)
    }

    /// Degree in time of a value between [`Network::breakpoints`], at fixed temperatures.
    pub fn course(&self, value: &Value) -> Degree {
        self.parts.course(value)
    }
}

/// A program with the values at which something happens, and its degree in time.
struct Difference {
    program: Program,
    knots: Vec<f64>,
    /// Between its kinks.
    degree: Degree,
    /// Those of its own `abs`, `min` and `max` that go straight between others before them.
    kinks: Vec<Difference>,
}

impl Difference {
    /// The parts of a stretch in which it goes straight, if that is known from its form.
    fn straight(&self, scope: &mut Evaluation, (from, to): Stretch) -> Vec<Stretch> {
        let mut ends = vec![from, to];
        for kink in &self.kinks {
            let mut times = Vec::new();
            for part in ends.windows(2) {
                let _ = crossings(kink, scope, (part[0], part[1]), &mut times);
            }
            tidy(&mut times, from, to);
            ends.extend(times);
            ends.sort_unstable_by(f64::total_cmp);
        }
        ends.windows(2).map(|part| (part[0], part[1])).collect()
    }
}

/// Adds the times strictly inside a stretch at which a program takes the value of a knot.
fn crossings(
    difference: &Difference,
    scope: &mut Evaluation,
    (from, to): Stretch,
    times: &mut Vec<f64>,
) -> Result<(), InputProblem> {
    let middle = 0.5 * (from + to);
    let mut at = |time: f64| {
        let value = scope.evaluate(&difference.program, time, middle);
        value.map_err(InputProblem::from)
    };
    let looks = if difference.degree == Degree::Nonlinear { LOOKS } else { 1 };
    let place =
        |k: u32| if k == looks { to } else { from + (to - from) * f64::from(k) / f64::from(looks) };
    let mut left = (from, at(from)?);
    for k in 1..=looks {
        let right = (place(k), at(place(k))?);
        let (low, high) = (left.1.min(right.1), left.1.max(right.1));
        for &knot in difference.knots.iter().filter(|knot| (low..=high).contains(*knot)) {
            if left.1.to_bits() == right.1.to_bits() {
                continue;
            }
            let straight = left.0 + (right.0 - left.0) * ((knot - left.1) / (right.1 - left.1));
            times.push(if looks == 1 { straight } else { bisect(&mut at, knot, left, right)? });
        }
        left = right;
    }
    Ok(())
}

fn bisect(
    at: &mut dyn FnMut(f64) -> Result<f64, InputProblem>,
    knot: f64,
    mut left: (f64, f64),
    mut right: (f64, f64),
) -> Result<f64, InputProblem> {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (left.0 + right.0);
        let value = at(middle)?;
        if (value - knot) * (right.1 - knot) > 0.0 {
            right = (middle, value);
        } else {
            left = (middle, value);
        }
    }
    Ok(0.5 * (left.0 + right.0))
}

/// Sorts times, keeps those inside, and makes two that differ by rounding only one.
fn tidy(times: &mut Vec<f64>, start: f64, stop: f64) {
    let margin = same_time(start, stop);
    times.retain(|&time| time > start + margin && time < stop - margin);
    times.sort_unstable_by(f64::total_cmp);
    times.dedup_by(|a, b| (*a - *b).abs() <= margin);
}

/// Times of a run from `start` to `stop` that are closer than this are one, all in s: they differ
/// by rounding, or by too little for a step.
pub fn same_time(start: f64, stop: f64) -> f64 {
    (1e-12 * (stop - start)).max(64.0 * f64::EPSILON * start.abs().max(stop.abs()))
}

impl Parts {
    /// Degree in time of a value between the points of the signals it reads, at fixed temperatures.
    pub(crate) fn course(&self, value: &Value) -> Degree {
        let mut factors = value.programs().into_iter().map(|program| self.course_of(program));
        let first = factors.next().unwrap_or(Degree::Constant);
        // a product of two that vary is not a straight line
        factors.fold(
            first,
            |a, b| if a.min(b) > Degree::Constant { Degree::Nonlinear } else { a.max(b) },
        )
    }

    pub(crate) fn course_of(&self, program: &Program) -> Degree {
        self.course_by(program, Program::degree_in)
    }

    /// The same between the kinks of the program.
    fn course_between_kinks(&self, program: &Program) -> Degree {
        self.course_by(program, Program::degree_between_kinks)
    }

    /// A difference that is zero at its events, of a program with these kinks.
    fn difference(&self, program: &Program, kinks: &[Program]) -> Difference {
        let plain = |program: &Program, degree, kinks| Difference {
            program: program.clone(),
            knots: vec![0.0],
            degree,
            kinks,
        };
        let (whole, between) = (self.course_of(program), self.course_between_kinks(program));
        if whole == between {
            return plain(program, whole, Vec::new());
        }
        // inner ones come first
        let own = kinks.iter().filter(|kink| self.course_between_kinks(kink) == Degree::Affine);
        let own = own.map(|kink| plain(kink, Degree::Affine, Vec::new()));
        plain(program, between, own.collect())
    }

    fn course_by(&self, program: &Program, degree: fn(&Program, u32) -> Degree) -> Degree {
        let mut worst = Degree::Constant;
        let mut varying = 0;
        for slot in program.slots() {
            let own = match self.layout.holds(slot) {
                Holds::Time => Degree::Affine,
                Holds::Signal(id) if self.layout.signals()[id.index()].course.is_straight() => {
                    Degree::Affine
                }
                Holds::Signal(_) => Degree::Nonlinear,
                _ => continue,
            };
            varying += 1;
            worst = worst.max(own.max(degree(program, slot)));
        }
        // each is straight by itself, but the form of the code does not exclude a product
        if varying > 1 { Degree::Nonlinear } else { worst }
    }

    /// Why a comparison cannot be used: it compares a temperature, or its change is not known in
    /// advance.
    pub(crate) fn comparison_problem(
        &self,
        (comparison, relation): (&Program, Comparison),
        item: Item,
        field: Field,
    ) -> Option<BuildErrorKind> {
        let value = Value::Expression(comparison.clone().into());
        if self.is_switch(comparison) {
            // an event, unless it cannot be followed
            let followed = matches!(item, Item::Source(_) | Item::Conductor(_));
            let equality = matches!(relation, Comparison::Equal | Comparison::NotEqual);
            return (!followed || equality)
                .then_some(BuildErrorKind::ComparesTemperature { item, field });
        }
        let single = comparison.slots().into_iter().filter(|&s| match self.layout.holds(s) {
            Holds::Signal(id) => self.layout.signals()[id.index()].course.is_monotone(),
            _ => false,
        });
        let known = match (self.course(&value), single.count()) {
            (Degree::Constant | Degree::Affine, _) => true,
            _ if self.course_between_kinks(comparison) <= Degree::Affine => true,
            // one curve that goes one way between its points
            (Degree::Nonlinear, 1) => {
                let affine = |s: &u32| comparison.degree_in(*s) <= Degree::Affine;
                let varying =
                    |s: &u32| matches!(self.layout.holds(*s), Holds::Time | Holds::Signal(_));
                comparison.slots().iter().filter(|s| varying(s)).all(affine)
            }
            _ => false,
        };
        (!known).then_some(BuildErrorKind::ComparisonNotLinear { item, field })
    }
}
