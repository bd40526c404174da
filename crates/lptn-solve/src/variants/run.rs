//! Runs of one candidate after the other, in closed form from one bend of the inputs to the next.

use lptn_network::{End, Followed, HeatOf};

use super::{Course, CourseSeen, LinearVariants, Look, Quantity, Segment, segments};

/// Vectors of a dense solver are right to rounding of the fastest rate over the slowest, of
/// temperatures of about this size in K.
const SIZE: f64 = 1e3;

/// Roundings of a straight line that nodes do not come near, which is a difference of large numbers.
const LARGE: f64 = 8.0;

impl LinearVariants<'_> {
    /// True if runs of this network can be followed in closed form at all.
    pub fn runs(&self) -> bool {
        self.network.inputs_are_straight() && self.plan.massless < self.plan.order.len()
    }

    /// Follows quantities over the run from `start` to `stop` in s, whose inputs bend at
    /// `breakpoints` alone: [`Network::breakpoints`](lptn_network::Network::breakpoints). `None` if
    /// a number fails or temperatures may be wrong by more than a tenth of `tolerance` in K.
    pub fn run(
        &mut self,
        (start, stop): (f64, f64),
        breakpoints: &[f64],
        (quantities, tolerance): (&[Quantity<'_>], f64),
    ) -> Option<Vec<CourseSeen>> {
        let segments = segments(start, stop, breakpoints);
        let longest = segments.iter().fold(0.0, |most: f64, s| most.max(s.to - s.from));
        // without heat no error grows, so those of all segments add up at worst
        let allowed = 0.1 * tolerance / segments.len() as f64;
        self.begin(longest, allowed)?;
        let integrated = quantities.iter().any(|quantity| quantity.look == Look::Integral);
        let mut seen = vec![CourseSeen::NOTHING; quantities.len()];
        for segment in segments {
            let length = segment.to - segment.from;
            self.segment(segment, allowed)?;
            self.march.stretch.begin(&self.modes.rates, length, integrated);
            for (quantity, seen) in quantities.iter().zip(&mut seen) {
                self.see(quantity, length, seen)?;
            }
            self.advance(length)?;
        }
        let whole =
            |seen: &CourseSeen| [seen.last, seen.min, seen.max, seen.integral, seen.positive];
        seen.iter().flat_map(whole).all(f64::is_finite).then_some(seen)
    }

    /// The temperature in K from which rises are counted.
    fn reference(&self) -> f64 {
        self.variants.initial[self.plan.order[self.plan.massless]]
    }

    /// Decomposes the network, and puts the start into the march.
    fn begin(&mut self, longest: f64, allowed: f64) -> Option<()> {
        let (plan, star) = (&self.plan, &mut self.star);
        let (conductance, capacity) = (&self.variants.conductance, &self.variants.capacity);
        let n = plan.order.len();
        star.begin(plan, conductance);
        star.eliminate(plan, 0..plan.massless)?;
        match &mut self.krylov {
            Some(krylov) => {
                self.modes.forget();
                krylov.begin(plan, (conductance, capacity), longest)?;
            }
            None => {
                self.modes.find(plan, star, capacity)?;
                let (slowest, fastest) = self.modes.span();
                if f64::EPSILON * SIZE * fastest / slowest > allowed {
                    return None;
                }
            }
        }
        star.eliminate(plan, plan.massless..n)?;
        let reference = self.reference();
        let march = &mut self.march;
        march.state.clear();
        march.state.extend(self.variants.initial.iter().map(|t| t - reference));
        for numbers in [&mut march.level, &mut march.slope] {
            numbers.resize(n, 0.0);
        }
        Some(())
    }

    /// Reads the inputs of a segment, and their effects on every node.
    fn segment(&mut self, segment: Segment, allowed: f64) -> Option<()> {
        let (inside, length) = (segment.inside(), segment.to - segment.from);
        self.inputs(segment.from, inside)?;
        self.march.first.0.clone_from(&self.boundaries);
        self.march.first.1.clone_from(&self.powers);
        if self.timed {
            self.inputs(segment.to, inside)?;
        }
        let size = self.line(length);
        if f64::EPSILON * LARGE * size > allowed {
            return None;
        }
        self.rest();
        self.project();
        match self.krylov.is_some() {
            true => self.span(length, allowed),
            false => Some(()),
        }
    }

    /// The straight line that nodes tend to, and the size of its numbers in K.
    fn line(&mut self, length: f64) -> f64 {
        let reference = self.reference();
        let mut march = std::mem::take(&mut self.march);
        let (boundaries, powers) = &march.first;
        let rise = |b: usize| boundaries[b] - reference;
        self.heat(rise, |s| powers[s], &mut march.level);
        march.slope.fill(0.0);
        if self.timed {
            let rise = |b: usize| (self.boundaries[b] - boundaries[b]) / length;
            self.heat(rise, |s| (self.powers[s] - powers[s]) / length, &mut march.slope);
        }
        if march.slope.iter().any(|slope| *slope != 0.0) {
            self.star.solve(&self.plan, &mut march.slope);
            let stored = self.variants.capacity.iter().zip(&march.slope);
            march.level.iter_mut().zip(stored).for_each(|(heat, (c, slope))| *heat -= c * slope);
        }
        self.star.solve(&self.plan, &mut march.level);
        let sizes = march.level.iter().zip(&march.slope);
        let size =
            sizes.map(|(level, slope)| level.abs() + length * slope.abs()).fold(0.0, f64::max);
        self.march = march;
        size
    }

    /// The difference of the state from that line.
    fn rest(&mut self) {
        let march = &mut self.march;
        march.rest.clear();
        march.rest.extend(march.state.iter().zip(&march.level).map(|(state, level)| state - level));
        self.star.recover(&self.plan, &mut march.rest);
    }

    /// The same difference as a sum of modes.
    fn project(&mut self) {
        let (march, capacity) = (&mut self.march, &self.variants.capacity);
        let part = |shape: &[f64]| -> f64 {
            let parts = shape.iter().zip(capacity).zip(&march.rest);
            parts.map(|((x, c), rest)| c * x * rest).sum()
        };
        march.left.clear();
        march.left.extend(self.modes.shapes.chunks_exact(capacity.len()).map(part));
    }

    /// Finds modes that represent the rest, unless those of the segment before do.
    fn span(&mut self, length: f64, allowed: f64) -> Option<()> {
        if self.error(length)? <= allowed {
            return Some(());
        }
        let krylov = self.krylov.as_mut()?;
        krylov.span(&self.plan, &self.march.rest, (length, allowed), &mut self.modes)?;
        self.project();
        (self.error(length)? <= allowed).then_some(())
    }

    /// Largest error of the temperatures of the segment in K: the miss of the modes at the start,
    /// and their residual of the equation.
    fn error(&mut self, length: f64) -> Option<f64> {
        let march = &self.march;
        let mut missed = march.rest.clone();
        for (left, shape) in march.left.iter().zip(self.modes.shapes.chunks_exact(missed.len())) {
            missed.iter_mut().zip(shape).for_each(|(missed, x)| *missed -= left * x);
        }
        let missed = missed.iter().fold(0.0, |most: f64, t| most.max(t.abs()));
        let left = self.krylov.as_mut()?.error(&self.modes.rates, &march.left, length);
        Some(missed + left)
    }

    /// Takes in a segment of a quantity.
    fn see(&mut self, quantity: &Quantity<'_>, length: f64, seen: &mut CourseSeen) -> Option<()> {
        let (at_zero, gain) = self.straight(quantity)?;
        let (constant, growth) = self.as_sum(quantity.with, length);
        let n = self.temperatures.len();
        let march = &mut self.march;
        let (mut p, mut q) = (constant, growth);
        for &(i, c) in &march.nodes {
            p += c * march.level[i];
            q += c * march.slope[i];
        }
        march.parts.clear();
        for (k, x) in self.modes.shapes.chunks_exact(n).enumerate() {
            let share: f64 = march.nodes.iter().map(|&(i, c)| c * x[i]).sum();
            march.parts.push(gain * share * march.left[k]);
        }
        let (p, q) = (at_zero + gain * p, gain * q);
        let course = Course { p, q, e: &march.parts, rates: &self.modes.rates, length };
        course.see(&mut march.stretch, quantity.look, seen);
        Some(())
    }

    /// The quantity if its temperature or heat flow is 0, and its gain.
    fn straight(&mut self, quantity: &Quantity<'_>) -> Option<(f64, f64)> {
        /// A power of two, so that the difference is divided without rounding.
        const FAR: f64 = 1024.0;
        let scope = self.variants.scope();
        let [zero, far] = [0.0, FAR].map(|x| {
            scope.follow(quantity.with, x);
            quantity.value.at(scope).ok()
        });
        let (zero, far) = (zero?, far?);
        Some((zero, (far - zero) / FAR))
    }

    /// A temperature or a heat flow as a sum over the rises of nodes, and the rest of it as a
    /// straight line.
    fn as_sum(&mut self, of: Followed, length: f64) -> (f64, f64) {
        let reference = self.reference();
        let network = self.network;
        let march = &mut self.march;
        march.nodes.clear();
        march.boundaries.clear();
        let mut add = |end: End, c: f64| match end {
            End::Node(id) => march.nodes.push((id.index(), c)),
            End::Boundary(id) => march.boundaries.push((id.index(), c)),
        };
        let mut constant = 0.0;
        let (mut first, mut last) = (0.0, 0.0);
        match of {
            Followed::Temperature(end) => {
                add(end, 1.0);
                constant = reference;
            }
            Followed::Heat(HeatOf::Conductor(id)) => {
                let conductor = &network.conductors()[id.index()];
                let g = self.variants.conductance[id.index()];
                add(conductor.from, g);
                add(conductor.to, -g);
            }
            Followed::Heat(HeatOf::Boundary(id)) => {
                let at = End::Boundary(id);
                let all = network.conductors().iter().zip(&self.variants.conductance);
                for (conductor, &g) in all {
                    if conductor.from == at || conductor.to == at {
                        let other =
                            if conductor.from == at { conductor.to } else { conductor.from };
                        add(at, g);
                        add(other, -g);
                    }
                }
            }
            Followed::Heat(HeatOf::Source(id)) => {
                (first, last) = (march.first.1[id.index()], self.powers[id.index()]);
            }
            Followed::Heat(_) => constant = f64::NAN,
        }
        for &(b, c) in &march.boundaries {
            first += c * (march.first.0[b] - reference);
            last += c * (self.boundaries[b] - reference);
        }
        (constant + first, (last - first) / length)
    }

    /// Goes to the end of the segment.
    fn advance(&mut self, length: f64) -> Option<()> {
        let reference = self.reference();
        let march = &mut self.march;
        let line = march.level.iter().zip(&march.slope);
        march
            .state
            .iter_mut()
            .zip(line)
            .for_each(|(t, (level, slope))| *t = level + slope * length);
        let parts = march.left.iter().zip(&march.stretch.ends);
        for ((left, end), shape) in parts.zip(self.modes.shapes.chunks_exact(march.state.len())) {
            let amplitude = left * end;
            march.state.iter_mut().zip(shape).for_each(|(t, x)| *t += amplitude * x);
        }
        for (t, rise) in self.temperatures.iter_mut().zip(&march.state) {
            *t = reference + rise;
        }
        // a colder temperature is for the integrator to refuse
        self.temperatures.iter().all(|t| *t >= 0.0 && t.is_finite()).then_some(())
    }
}
