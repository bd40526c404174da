//! Heat content over temperature: the exact integral of a capacity that depends on temperature.
//!
//! A capacity C(T) is represented on panels by polynomials that agree with it to [`ACCURACY`]; the heat content is
//! their integral, so capacity, heat content and its inverse belong together to the last digit and books close.

use std::sync::Arc;

/// Relative difference between a capacity and its polynomials.
const ACCURACY: f64 = 1e-12;

/// Width of a panel in K to begin with.
const PANEL: f64 = 64.0;

/// No panel is narrower, in K: a kink is then wrong on this width only.
const NARROWEST: f64 = 1e-6;

/// Nothing is asked above this temperature in K.
const HOTTEST: f64 = 16_384.0;

/// How often a nearer edge is looked for before the capacity counts as unknown.
const EDGES: usize = 50;

/// Coefficients of a panel: a polynomial of degree 8.
const TERMS: usize = 9;

/// Where a panel is interpolated: Chebyshev points on (-1, 1).
const POINTS: [f64; TERMS] = [
    -0.984_807_753_012_208,
    -0.866_025_403_784_438_7,
    -0.642_787_609_686_539_4,
    -0.342_020_143_325_668_7,
    0.0,
    0.342_020_143_325_668_7,
    0.642_787_609_686_539_4,
    0.866_025_403_784_438_7,
    0.984_807_753_012_208,
];

/// Where a panel is checked: inside it, for the capacity may jump at its ends.
const CHECKS: [f64; 8] = [-0.998, -0.94, -0.77, -0.5, 0.18, 0.5, 0.77, 0.998];

/// A difference below this is left where halving a panel hardly lessens it: it is rounding in the capacity itself, or a
/// kink on a panel so narrow that it holds no heat to speak of.
const ROUGHNESS: f64 = 1e-9;

/// What halving has to divide a difference by to be worth while; for a smooth capacity it is 2^9.
const WORTH: f64 = 8.0;

/// Differences are judged relative to the capacity, but no smaller one than this part of that at the start.
const FLOOR: f64 = 1e-3;

/// Heat content over temperature in J, or in J/kg for a fluid; zero where it was asked to be.
#[derive(Clone, Debug)]
pub struct Enthalpy {
    /// Ascending without gaps; several curves may share them.
    panels: Arc<[Panel]>,
    /// The factor by which capacities and heat contents are larger than those of the panels.
    scale: f64,
    /// Heat content by the panels where that of the curve is zero.
    zero: f64,
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
        let mut stops: Vec<f64> = edges.to_vec();
        stops.extend(latent.iter().flat_map(|l| [l.solidus, l.liquidus]));
        let mut fit = Fit { capacity, panels: Vec::new(), floor: 0.0 };
        fit.floor = FLOOR * fit.at(start)?;
        fit.walk(start, &stops, -1.0);
        fit.walk(start, &stops, 1.0);
        let mut panels = fit.panels;
        panels.sort_by(|a, b| a.from.total_cmp(&b.from));
        latent.iter().for_each(|l| add_latent(&mut panels, *l));
        if panels.is_empty() {
            return None;
        }
        accumulate(&mut panels, start);
        Some(Self { panels: panels.into(), scale: 1.0, zero: 0.0 })
    }

    /// The same curve `scale` times as high, with its zero at another `start` in K; `None` if that is outside its range.
    pub(crate) fn rescaled(&self, scale: f64, start: f64) -> Option<Self> {
        let zero = self.zero + self.heat(start)? / self.scale;
        Some(Self { panels: Arc::clone(&self.panels), scale: self.scale * scale, zero })
    }

    /// The same curve with its zero where `share` of the latent heat at just `start` in K is taken up; `None` if no
    /// latent heat is taken up at that temperature alone.
    pub(crate) fn partly_molten(&self, start: f64, share: f64) -> Option<Self> {
        let latent = self.latent_at(start)?;
        let mut curve = self.rescaled(1.0, start)?;
        curve.zero += share * latent;
        Some(curve)
    }

    /// What the panels without width at a temperature take up, by the panels.
    fn latent_at(&self, temperature: f64) -> Option<f64> {
        let first = self.panels.partition_point(|panel| panel.to < temperature);
        let here = self.panels[first..].iter().take_while(|panel| panel.from <= temperature);
        let mut latent = here.filter(|panel| panel.to <= panel.from).map(|panel| panel.rise).peekable();
        latent.peek().is_some().then(|| latent.sum())
    }

    /// How much of the latent heat that is taken up at just one temperature is taken up, from 0 to 1; `None` for a
    /// heat content at another temperature.
    pub fn melted(&self, heat: f64) -> Option<f64> {
        let temperature = self.temperature(heat)?.temperature;
        let latent = self.scale * self.latent_at(temperature)?;
        Some(((heat - self.heat(temperature)?) / latent).clamp(0.0, 1.0))
    }

    /// The panel of a temperature, the lower one where two meet; `None` outside [`Enthalpy::range`].
    fn panel(&self, temperature: f64) -> Option<&Panel> {
        let (first, last) = self.range();
        if !(first..=last).contains(&temperature) {
            return None;
        }
        let after = self.panels.partition_point(|panel| panel.to < temperature);
        Some(&self.panels[after.min(self.panels.len() - 1)])
    }

    /// The temperatures in K between which it is known.
    pub fn range(&self) -> (f64, f64) {
        (self.panels[0].from, self.panels[self.panels.len() - 1].to)
    }

    /// The ends of its smooth pieces strictly between two temperatures in K, ascending.
    pub(crate) fn stops(&self, from: f64, to: f64) -> Vec<f64> {
        let ends = self.panels.iter().map(|panel| panel.to).filter(|t| *t > from && *t < to);
        let mut stops: Vec<f64> = ends.collect();
        stops.dedup();
        stops
    }

    /// Heat content at a temperature in K; `None` outside [`Enthalpy::range`]. At the temperature of an isothermal
    /// change of phase: before it.
    pub fn heat(&self, temperature: f64) -> Option<f64> {
        let panel = self.panel(temperature)?;
        Some(self.scale * (panel.heat - self.zero + panel.taken_up(temperature)))
    }

    /// Capacity at a temperature in K; `None` outside [`Enthalpy::range`].
    pub fn capacity(&self, temperature: f64) -> Option<f64> {
        Some(self.scale * self.panel(temperature)?.capacity_at(temperature))
    }

    /// The temperature of a heat content; `None` outside [`Enthalpy::range`].
    pub fn temperature(&self, heat: f64) -> Option<Content> {
        let heat = heat / self.scale + self.zero;
        let last = &self.panels[self.panels.len() - 1];
        if !(self.panels[0].heat..=last.heat + last.rise).contains(&heat) {
            return None;
        }
        let after = self.panels.partition_point(|panel| panel.heat + panel.rise < heat);
        let panel = &self.panels[after.min(self.panels.len() - 1)];
        let temperature = panel.invert(heat - panel.heat);
        Some(Content { temperature, capacity: self.scale * panel.capacity_at(temperature) })
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
    /// The least capacity that differences are judged by.
    floor: f64,
}

impl Fit<'_> {
    fn at(&mut self, temperature: f64) -> Option<f64> {
        (self.capacity)(temperature).filter(|c| c.is_finite() && *c > 0.0)
    }

    /// Covers the temperatures from `start` on in one direction with panels, as far as the capacity is defined.
    fn walk(&mut self, start: f64, stops: &[f64], direction: f64) {
        let mut here = start;
        while here > 0.0 && here < HOTTEST || here <= 0.0 && direction > 0.0 {
            let next = (here + direction * PANEL).clamp(0.0, HOTTEST);
            let ahead = |t: &&f64| (**t - here) * direction > 0.0 && (next - **t) * direction > 0.0;
            let nearest = |a: &&f64, b: &&f64| ((**a - here).abs()).total_cmp(&(**b - here).abs());
            let next = stops.iter().filter(ahead).min_by(nearest).copied().unwrap_or(next);
            if let Err(outside) = self.stretch(here, next) {
                self.last(here, outside);
                return;
            }
            here = next;
        }
    }

    /// Covers what is left up to the first temperature at which the capacity is not defined.
    fn last(&mut self, here: f64, mut outside: f64) {
        for _ in 0..EDGES {
            let Some(inside) = self.edge(here, outside) else { return };
            match self.stretch(here, inside) {
                Ok(()) => return,
                Err(nearer) => outside = nearer,
            }
        }
    }

    /// Covers the temperatures between `here` and `next`, or nothing.
    fn stretch(&mut self, here: f64, next: f64) -> Result<(), f64> {
        let before = self.panels.len();
        let done = match self.at(next) {
            Some(_) => self.cover(here.min(next), here.max(next), f64::INFINITY),
            None => Err(next),
        };
        if done.is_err() {
            self.panels.truncate(before);
        }
        done
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

    /// Adds panels from `from` to `to`, halved until they agree with the capacity; `before` is the difference on the
    /// panel that this is a half of.
    ///
    /// # Errors
    /// A temperature at which the capacity is not defined.
    fn cover(&mut self, from: f64, to: f64, before: f64) -> Result<(), f64> {
        let middle = 0.5 * (from + to);
        let half = 0.5 * (to - from);
        let mut values = [0.0; TERMS];
        for (value, x) in values.iter_mut().zip(POINTS) {
            let place = middle + half * x;
            *value = self.at(place).ok_or(place)?;
        }
        let capacity = interpolate(&values);
        let mut difference = 0.0;
        for x in CHECKS {
            let place = middle + half * x;
            let found = self.at(place).ok_or(place)?;
            difference = f64::max(difference, (horner(&capacity, x) - found).abs() / found.max(self.floor));
        }
        let rough = difference <= ROUGHNESS && difference * WORTH > before;
        if difference <= ACCURACY || rough || to - from <= NARROWEST {
            let mut panel = Panel { from, to, heat: 0.0, rise: 0.0, capacity };
            panel.rise = panel.taken_up(to);
            self.panels.push(panel);
            return Ok(());
        }
        self.cover(from, middle, difference)?;
        self.cover(middle, to, difference)
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
    fn a_capacity_with_a_hole_ends_before_it() {
        // it was covered on both sides once, and a node jumped over the hole
        let mut capacity = |t: f64| (!(330.0..340.0).contains(&t)).then_some(100.0);
        let curve = Enthalpy::new(&mut capacity, 300.0, &[], &[]).unwrap();
        assert!((curve.range().1 - 330.0).abs() < 1e-5, "{:?}", curve.range());
        assert_eq!(curve.temperature(100.0 * 41.0), None);
    }

    #[test]
    fn a_capacity_with_rounding_in_it_is_covered_at_once() {
        // a difference of large numbers: its last digits are noise
        let noisy = |t: f64| 1e7 + 100.0 + 1e-3 * (7.0 * t).sin() - 1e7;
        let curve = Enthalpy::new(&mut |t| Some(noisy(t)), 300.0, &[], &[]).unwrap();
        assert!(curve.panels.len() < 100_000, "{}", curve.panels.len());
        assert!((curve.heat(400.0).unwrap() - 1e4).abs() < 0.1);
    }

    #[test]
    fn curves_share_panels_whatever_their_size_and_start() {
        let curve = Enthalpy::new(&mut |t| Some(100.0 + 0.5 * (t - 300.0)), 300.0, &[], &[]).unwrap();
        let other = curve.rescaled(3.0, 350.0).unwrap();
        close(other.heat(350.0).unwrap(), 0.0);
        close(other.heat(400.0).unwrap(), 3.0 * (50.0 * 100.0 + 0.25 * (1e4 - 2500.0)));
        close(other.temperature(other.heat(420.0).unwrap()).unwrap().temperature, 420.0);
        assert!(Arc::ptr_eq(&curve.panels, &other.panels));
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
    fn a_curve_may_begin_amid_melting() {
        let latent = Latent { solidus: 330.0, liquidus: 330.0, heat: 5000.0 };
        let curve = Enthalpy::new(&mut |_| Some(100.0), 300.0, &[], &[latent]).unwrap();
        assert_eq!(curve.melted(2000.0), None);
        close(curve.melted(3000.0 + 1500.0).unwrap(), 0.3);
        let amid = curve.rescaled(2.0, 310.0).unwrap().partly_molten(330.0, 0.3).unwrap();
        close(amid.melted(0.0).unwrap(), 0.3);
        // 0.7 of 10 kJ are left to melt, then 200 J/K
        close(amid.temperature(7000.0 + 400.0).unwrap().temperature, 332.0);
        close(amid.temperature(-3000.0 - 400.0).unwrap().temperature, 328.0);
        assert!(curve.partly_molten(331.0, 0.3).is_none(), "it melts at 330 K alone");
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
