//! Runs of one candidate after the other, in closed form from one bend of the inputs to the next.

use lptn_network::{End, Followed, HeatOf};

use super::{Course, CourseSeen, LinearVariants, Look, Quantity, Segment, segments};

/// The slowest mode has to lose this share of itself over a run: a straight line that it does not
/// come near is a difference of large numbers.
const LEAST_DECAY: f64 = 1e-3;

/// Vectors of a dense solver are right to rounding of the fastest rate over the slowest, of
/// temperatures of about this size in K.
const SIZE: f64 = 1e3;

impl LinearVariants<'_> {
    /// Whether runs of this network can be followed in closed form at all.
    pub fn runs(&self) -> bool {
        self.network.inputs_are_straight() && self.network.nodes().iter().all(|n| !n.massless)
    }

    /// Follows quantities over the run from `start` to `stop` in s, whose inputs bend at
    /// `breakpoints` alone: [`Network::breakpoints`](lptn_network::Network::breakpoints). `None`
    /// where a number fails or rounding may cost more than a tenth of `tolerance` in K.
    pub fn run(
        &mut self,
        (start, stop): (f64, f64),
        breakpoints: &[f64],
        (quantities, tolerance): (&[Quantity<'_>], f64),
    ) -> Option<Vec<CourseSeen>> {
        self.modes.find(self.network, &self.variants)?;
        let (slowest, fastest) = self.modes.span();
        let lost = f64::EPSILON * SIZE * fastest / slowest;
        if slowest * (stop - start) < LEAST_DECAY || lost > 0.1 * tolerance {
            return None;
        }
        self.begin()?;
        let integrated = quantities.iter().any(|quantity| quantity.look == Look::Integral);
        let mut seen = vec![CourseSeen::NOTHING; quantities.len()];
        for segment in segments(start, stop, breakpoints) {
            self.segment(segment, integrated)?;
            for (quantity, seen) in quantities.iter().zip(&mut seen) {
                self.see(quantity, segment.to - segment.from, seen)?;
            }
            self.advance(segment.to - segment.from)?;
        }
        let whole =
            |seen: &CourseSeen| [seen.last, seen.min, seen.max, seen.integral, seen.positive];
        seen.iter().flat_map(whole).all(f64::is_finite).then_some(seen)
    }

    /// The temperature in K from which rises are counted.
    fn reference(&self) -> f64 {
        self.variants.initial[0]
    }

    /// The amplitudes at the start.
    fn begin(&mut self) -> Option<()> {
        let n = self.temperatures.len();
        let reference = self.reference();
        let (initial, capacity) = (&self.variants.initial, &self.variants.capacity);
        let amplitude = |x: &[f64]| -> f64 {
            let parts = x.iter().zip(capacity).zip(initial);
            parts.map(|((x, c), t)| c * x * (t - reference)).sum()
        };
        self.march.amplitudes.clear();
        self.march.amplitudes.extend(self.modes.shapes.chunks_exact(n).map(amplitude));
        self.march.amplitudes.iter().all(|y| y.is_finite()).then_some(())
    }

    /// Reads the inputs of a segment, and what they do to every mode.
    fn segment(&mut self, segment: Segment, integrated: bool) -> Option<()> {
        let (n, inside) = (self.temperatures.len(), segment.inside());
        let length = segment.to - segment.from;
        self.inputs(segment.from, inside)?;
        self.march.first.0.clone_from(&self.boundaries);
        self.march.first.1.clone_from(&self.powers);
        if self.timed {
            self.inputs(segment.to, inside)?;
        }
        self.heats_of_segment(length);
        let march = &mut self.march;
        march.level.clear();
        march.slope.clear();
        march.left.clear();
        march.stretch.begin(&self.modes.rates, length, integrated);
        for ((x, rate), y) in
            self.modes.shapes.chunks_exact(n).zip(&self.modes.rates).zip(&march.amplitudes)
        {
            let of = |heat: &[f64]| -> f64 { x.iter().zip(heat).map(|(x, q)| x * q).sum() };
            let slope = of(&march.growth) / rate;
            let level = (of(&march.heat) - slope) / rate;
            march.slope.push(slope);
            march.level.push(level);
            march.left.push(y - level);
        }
        Some(())
    }

    /// Heat into each node at the start, from surroundings that are warmer than the reference too,
    /// and how fast it grows.
    fn heats_of_segment(&mut self, length: f64) {
        let reference = self.reference();
        let march = &mut self.march;
        for heat in [&mut march.heat, &mut march.growth] {
            heat.clear();
            heat.resize(self.temperatures.len(), 0.0);
        }
        let conductors = self.network.conductors().iter().zip(&self.variants.conductance);
        for (conductor, g) in conductors {
            let ((End::Node(a), End::Boundary(b)) | (End::Boundary(b), End::Node(a))) =
                (conductor.from, conductor.to)
            else {
                continue;
            };
            let (first, last) = (march.first.0[b.index()], self.boundaries[b.index()]);
            march.heat[a.index()] += g * (first - reference);
            march.growth[a.index()] += g * (last - first) / length;
        }
        let powers = march.first.1.iter().zip(&self.powers);
        for (source, (first, last)) in self.network.sources().iter().zip(powers) {
            for (node, share) in &source.into {
                march.heat[node.index()] += share * first;
                march.growth[node.index()] += share * (last - first) / length;
            }
        }
    }

    /// Takes a segment of a quantity in.
    fn see(&mut self, quantity: &Quantity<'_>, length: f64, seen: &mut CourseSeen) -> Option<()> {
        let (at_zero, gain) = self.straight(quantity)?;
        let (constant, growth) = self.as_sum(quantity.with, length);
        let n = self.temperatures.len();
        let march = &mut self.march;
        let (mut p, mut q) = (constant, growth);
        march.parts.clear();
        for (k, x) in self.modes.shapes.chunks_exact(n).enumerate() {
            let share: f64 = march.nodes.iter().map(|&(i, c)| c * x[i]).sum();
            p += share * march.level[k];
            q += share * march.slope[k];
            march.parts.push(gain * share * march.left[k]);
        }
        let (p, q) = (at_zero + gain * p, gain * q);
        let course = Course { p, q, e: &march.parts, rates: &self.modes.rates, length };
        course.see(&mut march.stretch, quantity.look, seen);
        Some(())
    }

    /// The quantity where what it goes with is 0, and its gain.
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
        let n = self.temperatures.len();
        let reference = self.reference();
        let march = &mut self.march;
        self.temperatures.fill(reference);
        for (k, y) in march.amplitudes.iter_mut().enumerate() {
            *y = march.level[k] + march.slope[k] * length + march.left[k] * march.stretch.ends[k];
            let shape = &self.modes.shapes[k * n..(k + 1) * n];
            self.temperatures.iter_mut().zip(shape).for_each(|(t, x)| *t += *y * x);
        }
        // what is colder than that is for the integrator to refuse
        self.temperatures.iter().all(|t| *t >= 0.0 && t.is_finite()).then_some(())
    }
}
