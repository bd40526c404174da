//! Heat content over temperature: the exact integral of a capacity that depends on temperature.
//!
//! A capacity C(T) is represented on panels by polynomials that agree with it to 1e-12. The heat
//! content is their integral, so capacity, heat content and its inverse agree to the last digit,
//! and the energy balance closes.
//!
//! The state of such a node is `T0 + H / C0`, with the heat content H. The approximation of the
//! changing capacity loses no heat, and melting at one temperature is not a special case. The
//! energy balance closes to the residual of Newton's method. The Newton matrix is scaled by dT/dy
//! in its columns and stays symmetric.

mod fit;
mod panel;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use fit::Fit;
pub(crate) use fit::{Capacity, Known, NoCurve};
pub(crate) use panel::Panel;

/// Heat content over temperature in J, or in J/kg for a fluid; zero where it was asked to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Enthalpy {
    /// Ascending without gaps; several curves may share them.
    panels: Arc<[Panel]>,
    /// The factor by which capacities and heat contents are larger than those of the panels.
    scale: f64,
    /// Heat content by the panels where that of the curve is zero.
    zero: f64,
}

/// Latent heat that is taken up evenly between two temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Latent {
    pub(crate) solidus: f64,
    pub(crate) liquidus: f64,
    pub(crate) heat: f64,
}

/// Solidus and liquidus that differ by no more than this, relative to them, are one temperature:
/// the rounding of a change of units and of a few sums, 3e-10 K at room temperature.
const ONE_TEMPERATURE: f64 = 1e-12;

/// True if a material with these solidus and liquidus temperatures in K melts at one temperature.
pub(crate) fn is_one_temperature(solidus: f64, liquidus: f64) -> bool {
    (liquidus - solidus).abs() <= ONE_TEMPERATURE * solidus.abs().max(liquidus.abs())
}

impl Latent {
    /// Latent heat in J between two temperatures in K, or at one.
    pub(crate) fn new((solidus, liquidus): (f64, f64), heat: f64) -> Self {
        let liquidus = if is_one_temperature(solidus, liquidus) { solidus } else { liquidus };
        Self { solidus, liquidus, heat }
    }
}

/// A heat content, its temperature and the capacity there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content {
    /// Temperature in K.
    pub temperature: f64,
    /// Capacity in J/K (J/(kg K) for a fluid); infinite while latent heat is taken up at one
    /// temperature.
    pub capacity: f64,
}

impl Enthalpy {
    /// The curve of `capacity` around `start` in K, as far as it is defined and positive. Its zero
    /// is at `start`. `edges` are temperatures at which the capacity may bend or jump.
    pub(crate) fn new(
        capacity: &mut dyn Capacity,
        start: f64,
        edges: &[f64],
        latent: &[Latent],
    ) -> Result<Self, NoCurve> {
        let mut stops: Vec<f64> = edges.to_vec();
        stops.extend(latent.iter().flat_map(|l| [l.solidus, l.liquidus]));
        let mut panels = Fit::panels(capacity, start, &stops)?;
        latent.iter().for_each(|l| add_latent(&mut panels, *l));
        accumulate(&mut panels, start);
        Ok(Self { panels: panels.into(), scale: 1.0, zero: 0.0 })
    }

    /// The same curve `scale` times as high, with its zero at another `start` in K; `None` if that
    /// is outside its range.
    pub(crate) fn rescaled(&self, scale: f64, start: f64) -> Option<Self> {
        let zero = self.zero + self.heat(start)? / self.scale;
        Some(Self { panels: Arc::clone(&self.panels), scale: self.scale * scale, zero })
    }

    /// The same curve with its zero where `share` of the latent heat at just `start` in K is taken
    /// up; `None` if no latent heat is taken up at that temperature alone.
    pub(crate) fn partly_molten(&self, start: f64, share: f64) -> Option<Self> {
        let latent = self.latent_at(start)?;
        let mut curve = self.rescaled(1.0, start)?;
        curve.zero += share * latent;
        Some(curve)
    }

    /// Heat taken up by the panels without width at a temperature.
    fn latent_at(&self, temperature: f64) -> Option<f64> {
        let first = self.panels.partition_point(|panel| panel.to < temperature);
        let here = self.panels[first..].iter().take_while(|panel| panel.from <= temperature);
        let mut latent =
            here.filter(|panel| panel.to <= panel.from).map(|panel| panel.rise).peekable();
        latent.peek().is_some().then(|| latent.sum())
    }

    /// Melted share, from 0 to 1, of the latent heat that is taken up at just one temperature;
    /// `None` for a heat content at another temperature.
    pub fn melted(&self, heat: f64) -> Option<f64> {
        let temperature = self.temperature(heat)?.temperature;
        let latent = self.scale * self.latent_at(temperature)?;
        Some(((heat - self.heat(temperature)?) / latent).clamp(0.0, 1.0))
    }

    /// The panel of a temperature, the lower one where two meet; `None` outside
    /// [`Enthalpy::range`].
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

    /// Heat content at a temperature in K; `None` outside [`Enthalpy::range`]. At the temperature
    /// of an isothermal change of phase: before it.
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
        self.temperature_near(heat, &mut 0)
    }

    /// The same, faster if the heat content is on the same panel as that of the last call; `panel`
    /// is any number at first.
    pub fn temperature_near(&self, heat: f64, panel: &mut usize) -> Option<Content> {
        let heat = heat / self.scale + self.zero;
        let is_below = |panel: &Panel| panel.heat + panel.rise < heat;
        let inside = match self.panels.get(panel.wrapping_sub(1)..=*panel) {
            Some([before, here]) => is_below(before) && !is_below(here),
            _ if *panel == 0 => heat >= self.panels[0].heat && !is_below(&self.panels[0]),
            _ => false,
        };
        if !inside {
            let last = &self.panels[self.panels.len() - 1];
            if !(self.panels[0].heat..=last.heat + last.rise).contains(&heat) {
                return None;
            }
            *panel = self.panels.partition_point(is_below).min(self.panels.len() - 1);
        }
        let panel = &self.panels[*panel];
        let temperature = panel.invert(heat - panel.heat);
        Some(Content { temperature, capacity: self.scale * panel.capacity_at(temperature) })
    }
}

fn add_latent(panels: &mut Vec<Panel>, latent: Latent) {
    let Latent { solidus, liquidus, heat } = latent;
    if liquidus > solidus {
        let within =
            panels.iter_mut().filter(|p| p.from >= solidus && p.to <= liquidus && p.to > p.from);
        within.for_each(|panel| panel.raise(lptn_laws::melting_capacity(heat, solidus, liquidus)));
        return;
    }
    let place = panels.iter().position(|p| p.from >= solidus);
    let whole = panels.last().is_some_and(|p| p.to >= solidus) && panels[0].from <= solidus;
    if whole {
        panels.insert(place.unwrap_or(panels.len()), Panel::isothermal(solidus, heat));
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
