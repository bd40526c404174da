//! Bounds on heats while temperatures and time go a way: of the heats themselves, of their Taylor
//! coefficients along the way, and of their slopes.
//!
//! Laws and expressions are evaluated on bounds in place of numbers ([`lptn_units::Bounded`]), from
//! the same lines. A law that decides by a value has no bounds.

use lptn_units::{Bounded, Scalar, Table1, Taylor};

use crate::evaluation::Evaluation;
use crate::id::{BoundaryId, ConductorId, SignalId, SourceId};
use crate::law::At;
use crate::network::Network;
use crate::network::flow::{name, place};
use crate::parts::signal::Course;
use crate::slot;
use crate::value::Value;

/// The numbers that expressions read over a stretch of time, as bounds. The variable of the way
/// goes from -1 at its start to 1 at its end.
#[derive(Clone, Debug)]
pub struct InputBounds {
    slots: Vec<Bounded>,
    stack: Vec<Bounded>,
}

impl InputBounds {
    /// The same numbers over the whole stretch, without their change along the way.
    #[must_use]
    pub fn still(&self) -> Self {
        let still = |bounds: &Bounded| {
            let range = bounds.taylor().range();
            range.map_or(*bounds, |range| Bounded::from(Taylor::between(&[range])))
        };
        Self { slots: self.slots.iter().map(still).collect(), stack: Vec::new() }
    }

    pub(super) fn set(&mut self, slot: u32, bounds: Taylor) {
        self.slots[slot as usize] = Bounded::from(bounds);
    }

    /// Bounds on an expression; `None` if there are none.
    pub(super) fn value(&mut self, value: &Value) -> Option<Taylor> {
        let Self { slots, stack } = self;
        Bounded::watched(|| value.on(slots, stack).ok())?.map(Bounded::taylor)
    }
}

impl Network {
    /// The numbers that expressions read from one time in s to another, over the whole stretch and
    /// in its middle. It lies inside one segment between [`Network::breakpoints`]; comparisons are
    /// as they are at `inside`.
    pub fn input_bounds(
        &self,
        scope: &mut Evaluation,
        (from, to): (f64, f64),
        inside: f64,
    ) -> [InputBounds; 2] {
        let mut read = |time: f64| {
            scope.set_time(time, inside);
            scope.plain().0.to_vec()
        };
        let (first, last) = (read(from), read(to));
        [over as Line, in_the_middle].map(|line| {
            let mut slots: Vec<Bounded> = first.iter().map(|x| Bounded::from_f64(*x)).collect();
            slots[slot::TIME as usize] = line(from, to);
            let mut stack = Vec::new();
            for (i, signal) in self.parts.layout.signals().iter().enumerate() {
                let place = self.parts.layout.signal(SignalId::from_len(i)) as usize;
                slots[place] = match &signal.course {
                    Course::Expression(value) => {
                        value.on(&slots, &mut stack).unwrap_or_else(|_| unknown())
                    }
                    Course::Curve { points, .. } if !signal.course.is_straight() => {
                        let offset = signal.course.offset(inside);
                        on_cubic(points, (from - offset, to - offset), line)
                    }
                    _ => line(first[place], last[place]),
                };
            }
            InputBounds { slots, stack }
        })
    }

    /// The points inside `(start, stop)` in s of signals that are joined by cubics, in the order of the
    /// signals. Nothing bends there, but each cubic ends. Signals with points beyond number, which
    /// no run accepts, are left out.
    pub fn ends_of_cubics(&self, start: f64, stop: f64) -> Vec<f64> {
        let mut times = Vec::new();
        let cubic = |course: &&Course| !course.is_straight() && course.is_monotone();
        let courses = self.signals().iter().map(|signal| &signal.course).filter(cubic);
        courses.for_each(|course| {
            let _ = course.points((start, stop), false, &mut times);
        });
        times
    }

    /// Bounds on the heat in W that the two ends of a conductor receive while the vertices (nodes,
    /// then boundaries) have the bounds `at`, in K; `None` if there are none.
    pub fn enclose_exchange(
        &self,
        id: ConductorId,
        inputs: &mut InputBounds,
        at: &dyn Fn(u32) -> Taylor,
    ) -> Option<[Taylor; 2]> {
        let conductor = &self.conductors()[id.index()];
        let dependence = self.parts.dependence(id);
        // a constant conductor has no dependence, but its ends
        let ends = [conductor.from, conductor.to].map(|end| self.vertex(end) as u32);
        let vertex = |k: usize| {
            Bounded::from(at(dependence.vertices.get(k).copied().unwrap_or_else(|| ends[k])))
        };
        let InputBounds { slots, stack } = inputs;
        place(slots, &dependence, &vertex);
        if self.along(id).is_some() {
            return self.enclose_conducted(id, inputs, [vertex(0), vertex(1)]);
        }
        let received = Bounded::watched(|| {
            self.received(conductor, At::new((slots, stack)), vertex(0), vertex(1)).ok()
        });
        received.flatten().map(|ends| ends.map(Bounded::taylor))
    }

    /// The heat through a body whose conductivity k depends on temperature alone: the difference of
    /// the integrals of k at both ends, times its shape.
    fn enclose_conducted(
        &self,
        id: ConductorId,
        inputs: &mut InputBounds,
        ends: [Bounded; 2],
    ) -> Option<[Taylor; 2]> {
        let shape = self.shape(id)?;
        let value = self.conductors()[id.index()].law.along()?;
        let InputBounds { slots, stack } = inputs;
        let mut conductivity = |temperature: Taylor| {
            slots[slot::OWN as usize] = Bounded::from(temperature);
            Bounded::watched(|| value.on(slots, stack).ok())?.map(Bounded::taylor)
        };
        let [from, to] = ends.map(Bounded::taylor);
        let change = conductivity(from)? * from.derivative() - conductivity(to)? * to.derivative();
        let heat = match (from.range()?, to.range()?) {
            // at two temperatures the integral itself is known
            ([a, b], [c, d]) if a.to_bits() == b.to_bits() && c.to_bits() == d.to_bits() => {
                let mean = self.along(id)?.mean::<f64>([a, c], &[]).ok()?;
                Taylor::constant(mean.value * (a - c))
            }
            ([a, b], [c, d]) => {
                conductivity(Taylor::between(&[[a.min(c), b.max(d)]]))? * (from - to)
            }
        };
        let heat = (change.integral(heat)) * Taylor::constant(shape);
        Some([-heat, heat])
    }

    /// Bounds on the heat of a source in W while the vertices have the bounds `at`, in K; `None` if
    /// there are none.
    pub fn enclose_source(
        &self,
        id: SourceId,
        inputs: &mut InputBounds,
        at: &dyn Fn(u32) -> Taylor,
    ) -> Option<Taylor> {
        let source = &self.sources()[id.index()];
        let dependence = &self.parts.source_dependence[id.index()];
        let vertex = |k: usize| Bounded::from(at(dependence.vertices[k]));
        let InputBounds { slots, stack } = inputs;
        name(slots, dependence, &vertex);
        let heat = Bounded::watched(|| At::new((slots, stack)).heat(&source.law).ok());
        heat.flatten().map(Bounded::taylor)
    }

    /// Bounds on the temperature of a boundary in K; `None` if there are none.
    pub fn enclose_boundary(&self, id: BoundaryId, inputs: &mut InputBounds) -> Option<Taylor> {
        let temperature = &self.boundaries()[id.index()].temperature;
        let InputBounds { slots, stack } = inputs;
        let bounds = Bounded::watched(|| temperature.on(slots, stack).ok());
        bounds.flatten().map(Bounded::taylor).filter(|bounds| bounds.range().is_some())
    }
}

fn unknown() -> Bounded {
    Bounded::from(Taylor::between(&[[f64::NEG_INFINITY, f64::INFINITY]]))
}

/// A curve of cubics over times in s that reach beyond neither its first nor its last point, except
/// by rounding; or that lie outside of them, with its first or last value.
fn on_cubic(points: &Table1, (from, to): (f64, f64), line: Line) -> Bounded {
    let (knots, values) = (points.knots(), points.values());
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let slack = 1e-12 * (last - first).max(first.abs().max(last.abs()));
    Bounded::from(match (from, to) {
        _ if to <= first + slack => Taylor::constant(values[0]),
        _ if from >= last - slack => Taylor::constant(values[values.len() - 1]),
        _ if from < first - slack || to > last + slack => return unknown(),
        _ => points.enclose(line(from.max(first), to.min(last)).taylor()),
    })
}

/// A straight line along the way, from its values at both ends.
type Line = fn(f64, f64) -> Bounded;

/// Over the whole way.
fn over(first: f64, last: f64) -> Bounded {
    let half = 0.5 * (last - first);
    let whole = [first.min(last), first.max(last)];
    Bounded::from(match half == 0.0 {
        true => Taylor::constant(first),
        false => Taylor::between(&[whole, [half, half]]),
    })
}

/// In its middle.
fn in_the_middle(first: f64, last: f64) -> Bounded {
    let (middle, half) = (0.5 * first + 0.5 * last, 0.5 * (last - first));
    Bounded::from(Taylor::between(&[[middle, middle], [half, half]]))
}
