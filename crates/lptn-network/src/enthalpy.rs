//! Heat content over temperature: the exact integral of a capacity that depends on temperature.
//!
//! A capacity C(T) is represented on panels by polynomials that agree with it to [`ACCURACY`]; the heat content is
//! their integral, so capacity, heat content and its inverse belong together to the last digit and books close.

/// Relative difference between a capacity and its polynomials.
const ACCURACY: f64 = 1e-12;

/// Width of a panel in K to begin with.
const PANEL: f64 = 64.0;

/// No panel is narrower, in K: a kink is then wrong on this width only.
const NARROWEST: f64 = 1e-6;

/// Nothing is asked above this temperature in K.
const HOTTEST: f64 = 16_384.0;

/// Coefficients of a panel: a polynomial of degree 4.
const TERMS: usize = 5;

/// Where a panel is interpolated: Chebyshev points on (-1, 1).
const POINTS: [f64; TERMS] = [
    -0.951_056_516_295_153_5,
    -0.587_785_252_292_473_1,
    0.0,
    0.587_785_252_292_473_1,
    0.951_056_516_295_153_5,
];

/// Where a panel is checked: inside it, for the capacity may jump at its ends.
const CHECKS: [f64; 6] = [-0.99, -0.8, -0.3, 0.35, 0.75, 0.99];

/// Heat content over temperature in J, or in J/kg for a fluid; zero where it was asked to be.
#[derive(Clone, Debug)]
pub struct Enthalpy {
    /// Ascending without gaps.
    panels: Vec<Panel>,
}

/// A piece of the curve. One of no width holds latent heat that is taken up at one temperature.
#[derive(Clone, Copy, Debug)]
struct Panel {
    from: f64,
    to: f64,
    /// Heat content at `from`.
    heat: f64,
    /// Heat taken up between `from` and `to`.
    rise: f64,
    /// Capacity over `x = (T - middle) / half` by powers.
    capacity: [f64; TERMS],
}

/// Latent heat that is taken up evenly between two temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Latent {
    pub(crate) solidus: f64,
    pub(crate) liquidus: f64,
    pub(crate) heat: f64,
}

/// A heat content, its temperature and the capacity there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content {
    /// Temperature in K.
    pub temperature: f64,
    /// Capacity in J/K (J/(kg K) for a fluid); infinite while latent heat is taken up at one temperature.
    pub capacity: f64,
}

impl Enthalpy {
    /// The curve of `capacity` around `start` in K, as far as it is defined and positive. Its zero is at `start`.
    /// `edges` are temperatures at which the capacity may bend or jump.
    pub(crate) fn new(
        capacity: &mut dyn FnMut(f64) -> Option<f64>,
        start: f64,
        edges: &[f64],
        latent: &[Latent],
    ) -> Option<Self> {
        let mut fit = Fit { capacity, panels: Vec::new() };
        let mut stops: Vec<f64> = edges.to_vec();
        stops.extend(latent.iter().flat_map(|l| [l.solidus, l.liquidus]));
        let down = fit.reach(start, &stops, -1.0);
        let up = fit.reach(start, &stops, 1.0);
        for pair in down.windows(2) {
            fit.cover(pair[1], pair[0], 0);
        }
        fit.panels.sort_by(|a, b| a.from.total_cmp(&b.from));
        for pair in up.windows(2) {
            fit.cover(pair[0], pair[1], 0);
        }
        let mut panels = fit.panels;
        latent.iter().for_each(|l| add_latent(&mut panels, *l));
        if panels.is_empty() {
            return None;
        }
        accumulate(&mut panels, start);
        Some(Self { panels })
    }

    /// The temperatures in K between which it is known.
    pub fn range(&self) -> (f64, f64) {
        (self.panels[0].from, self.panels[self.panels.len() - 1].to)
    }

    /// Heat content at a temperature in K; `None` outside [`Enthalpy::range`]. At the temperature of an isothermal
    /// change of phase: before it.
    pub fn heat(&self, temperature: f64) -> Option<f64> {
        let (first, last) = self.range();
        if !(first..=last).contains(&temperature) {
            return None;
        }
        let after = self.panels.partition_point(|panel| panel.to < temperature);
        let panel = &self.panels[after.min(self.panels.len() - 1)];
        Some(panel.heat + panel.taken_up(temperature))
    }

    /// Capacity at a temperature in K; `None` outside [`Enthalpy::range`].
    pub fn capacity(&self, temperature: f64) -> Option<f64> {
        let (first, last) = self.range();
        if !(first..=last).contains(&temperature) {
            return None;
        }
        let after = self.panels.partition_point(|panel| panel.to < temperature);
        let panel = &self.panels[after.min(self.panels.len() - 1)];
        Some(panel.capacity_at(temperature))
    }

    /// The temperature of a heat content; `None` outside [`Enthalpy::range`].
    pub fn temperature(&self, heat: f64) -> Option<Content> {
        let last = &self.panels[self.panels.len() - 1];
        if !(self.panels[0].heat..=last.heat + last.rise).contains(&heat) {
            return None;
        }
        let after = self.panels.partition_point(|panel| panel.heat + panel.rise < heat);
        let panel = &self.panels[after.min(self.panels.len() - 1)];
        let temperature = panel.invert(heat - panel.heat);
        Some(Content { temperature, capacity: panel.capacity_at(temperature) })
    }

    /// The largest capacity at an end of a panel that is not a change of phase at one temperature.
    pub fn largest_capacity(&self) -> f64 {
        let ends = self.panels.iter().filter(|p| p.to > p.from);
        ends.flat_map(|p| [p.capacity_at(p.from), p.capacity_at(p.to)]).fold(0.0, f64::max)
    }
}

impl Panel {
    fn half(&self) -> f64 {
        0.5 * (self.to - self.from)
    }

    fn x(&self, temperature: f64) -> f64 {
        if self.to > self.from { (temperature - 0.5 * (self.from + self.to)) / self.half() } else { -1.0 }
    }

    fn capacity_at(&self, temperature: f64) -> f64 {
        if self.to > self.from { horner(&self.capacity, self.x(temperature)) } else { f64::INFINITY }
    }

    /// Heat taken up from `from` to `temperature`.
    fn taken_up(&self, temperature: f64) -> f64 {
        if self.to <= self.from {
            return 0.0;
        }
        self.half() * (primitive(&self.capacity, self.x(temperature)) - primitive(&self.capacity, -1.0))
    }

    /// The temperature at which so much heat is taken up: Newton's method kept inside the panel. The capacity is
    /// positive, so the heat grows strictly.
    fn invert(&self, heat: f64) -> f64 {
        if self.to <= self.from || heat <= 0.0 {
            return self.from;
        }
        if heat >= self.rise {
            return self.to;
        }
        let (mut low, mut high) = (self.from, self.to);
        let mut temperature = self.from + (self.to - self.from) * (heat / self.rise);
        for _ in 0..60 {
            let missing = heat - self.taken_up(temperature);
            if missing > 0.0 {
                low = temperature
            } else {
                high = temperature
            }
            let next = temperature + missing / self.capacity_at(temperature);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - temperature).abs() <= 2.0 * f64::EPSILON * temperature {
                return next;
            }
            temperature = next;
        }
        temperature
    }
}

fn horner(coefficients: &[f64; TERMS], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

fn primitive(coefficients: &[f64; TERMS], x: f64) -> f64 {
    let powers = (1_u8..).map(f64::from);
    let terms: Vec<f64> = coefficients.iter().zip(powers).map(|(c, k)| c / k).collect();
    x * terms.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

struct Fit<'a> {
    capacity: &'a mut dyn FnMut(f64) -> Option<f64>,
    panels: Vec<Panel>,
}

impl Fit<'_> {
    fn at(&mut self, temperature: f64) -> Option<f64> {
        (self.capacity)(temperature).filter(|c| c.is_finite() && *c > 0.0)
    }

    /// Temperatures from `start` on in one direction, at most a panel apart, as far as the capacity is defined.
    fn reach(&mut self, start: f64, stops: &[f64], direction: f64) -> Vec<f64> {
        let mut places = vec![start];
        let mut here = start;
        while here > 0.0 && here < HOTTEST {
            let next = (here + direction * PANEL).clamp(0.0, HOTTEST);
            let ahead = |t: &&f64| (**t - here) * direction > 0.0 && (next - **t) * direction > 0.0;
            let nearest = |a: &&f64, b: &&f64| ((**a - here).abs()).total_cmp(&(**b - here).abs());
            let next = stops.iter().filter(ahead).min_by(nearest).copied().unwrap_or(next);
            if self.at(next).is_none() {
                places.extend(self.edge(here, next));
                break;
            }
            places.push(next);
            here = next;
        }
        places
    }

    /// The last temperature between one where the capacity is defined and one where it is not.
    fn edge(&mut self, mut inside: f64, mut outside: f64) -> Option<f64> {
        let first = inside;
        while (outside - inside).abs() > NARROWEST {
            let middle = 0.5 * (inside + outside);
            if self.at(middle).is_some() { inside = middle } else { outside = middle }
        }
        ((inside - first).abs() > NARROWEST).then_some(inside)
    }

    /// Adds panels from `from` to `to`, halved until they agree with the capacity.
    fn cover(&mut self, from: f64, to: f64, depth: u32) {
        let middle = 0.5 * (from + to);
        let half = 0.5 * (to - from);
        let mut values = [0.0; TERMS];
        for (value, x) in values.iter_mut().zip(POINTS) {
            *value = self.at(middle + half * x).unwrap_or(f64::NAN);
        }
        let capacity = interpolate(&values);
        let fits = CHECKS.iter().all(|&x| {
            let found = self.at(middle + half * x);
            found.is_some_and(|c| (horner(&capacity, x) - c).abs() <= ACCURACY * c)
        });
        if fits || to - from <= NARROWEST || depth > 60 {
            let mut panel = Panel { from, to, heat: 0.0, rise: 0.0, capacity };
            if !capacity.iter().all(|c| c.is_finite()) {
                return;
            }
            panel.rise = panel.taken_up(to);
            self.panels.push(panel);
        } else {
            self.cover(from, middle, depth + 1);
            self.cover(middle, to, depth + 1);
        }
    }
}

/// The polynomial through the values at [`POINTS`], by powers: Newton's divided differences, multiplied out.
fn interpolate(values: &[f64; TERMS]) -> [f64; TERMS] {
    let mut divided = *values;
    for order in 1..TERMS {
        for i in (order..TERMS).rev() {
            divided[i] = (divided[i] - divided[i - 1]) / (POINTS[i] - POINTS[i - order]);
        }
    }
    let mut powers = [0.0; TERMS];
    for i in (0..TERMS).rev() {
        for k in (1..TERMS).rev() {
            powers[k] = powers[k - 1] - POINTS[i] * powers[k];
        }
        powers[0] = divided[i] - POINTS[i] * powers[0];
    }
    powers
}

fn add_latent(panels: &mut Vec<Panel>, latent: Latent) {
    let Latent { solidus, liquidus, heat } = latent;
    if liquidus > solidus {
        for panel in panels.iter_mut().filter(|p| p.from >= solidus && p.to <= liquidus && p.to > p.from) {
            panel.capacity[0] += heat / (liquidus - solidus);
            panel.rise = panel.taken_up(panel.to);
        }
        return;
    }
    let place = panels.iter().position(|p| p.from >= solidus);
    let whole = panels.last().is_some_and(|p| p.to >= solidus) && panels[0].from <= solidus;
    if whole {
        let panel =
            Panel { from: solidus, to: solidus, heat: 0.0, rise: heat, capacity: [f64::INFINITY; TERMS] };
        panels.insert(place.unwrap_or(panels.len()), panel);
    }
}

/// Heat contents from the rises, zero at `start`.
fn accumulate(panels: &mut [Panel], start: f64) {
    let mut heat = 0.0;
    let mut zero = 0.0;
    for panel in panels.iter_mut() {
        if panel.to <= start && panel.from < panel.to {
            zero = heat + panel.rise;
        }
        panel.heat = heat;
        heat += panel.rise;
    }
    panels.iter_mut().for_each(|panel| panel.heat -= zero);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{a} {b}");
    }

    #[test]
    fn heat_content_of_a_linear_capacity_is_its_integral() {
        // C = 100 + 0.5 (T - 300): H(T) = 100 (T - 300) + 0.25 (T - 300)^2
        let curve = Enthalpy::new(&mut |t| Some(100.0 + 0.5 * (t - 300.0)), 300.0, &[], &[]).unwrap();
        for t in [150.0_f64, 299.0, 300.0, 301.5, 777.7, 3000.0] {
            let heat = 100.0 * (t - 300.0) + 0.25 * (t - 300.0).powi(2);
            close(curve.heat(t).unwrap(), heat);
            let content = curve.temperature(heat).unwrap();
            close(content.temperature, t);
            close(content.capacity, 100.0 + 0.5 * (t - 300.0));
        }
        assert!((curve.range().0 - 100.0).abs() < 1e-5, "the capacity is positive from 100 K on");
        assert_eq!(curve.heat(50.0), None);
    }

    #[test]
    fn a_curved_capacity_is_met_to_rounding() {
        // C = 50 exp(T / 200): H = 10000 (exp(T / 200) - exp(1.5))
        let curve = Enthalpy::new(&mut |t| Some(50.0 * (t / 200.0).exp()), 300.0, &[], &[]).unwrap();
        for t in [200.0_f64, 333.3, 450.0, 600.0] {
            close(curve.heat(t).unwrap(), 1e4 * ((t / 200.0).exp() - 1.5_f64.exp()));
        }
    }

    #[test]
    fn a_kink_is_found() {
        let curve = Enthalpy::new(&mut |t| Some(10.0 + (t - 350.0).abs()), 300.0, &[], &[]).unwrap();
        // from 300 to 400: 1000 + 2 * 50^2 / 2
        assert!((curve.heat(400.0).unwrap() - 3500.0).abs() < 1e-6);
    }

    #[test]
    fn latent_heat_at_one_temperature_holds_it() {
        let latent = Latent { solidus: 330.0, liquidus: 330.0, heat: 5000.0 };
        let curve = Enthalpy::new(&mut |_| Some(100.0), 300.0, &[], &[latent]).unwrap();
        close(curve.temperature(3000.0 + 2500.0).unwrap().temperature, 330.0);
        assert!(curve.temperature(5500.0).unwrap().capacity.is_infinite());
        close(curve.temperature(3000.0 + 5000.0 + 700.0).unwrap().temperature, 337.0);
        close(curve.heat(340.0).unwrap(), 9000.0);
    }

    #[test]
    fn latent_heat_over_an_interval_adds_to_the_capacity() {
        let latent = Latent { solidus: 320.0, liquidus: 330.0, heat: 5000.0 };
        let curve = Enthalpy::new(&mut |_| Some(100.0), 300.0, &[], &[latent]).unwrap();
        close(curve.capacity(325.0).unwrap(), 600.0);
        close(curve.heat(330.0).unwrap(), 8000.0);
        close(curve.temperature(2000.0 + 3000.0).unwrap().temperature, 325.0);
    }
}
