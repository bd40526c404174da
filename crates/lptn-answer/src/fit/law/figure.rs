//! Pictures of `lptn fit law`, in the form of the paper's Figures 7, 8 and 9: rise, time constant
//! and power over the speed.

use lptn_fit::law::{Consistency, LawFit, LawOf, StatedLaw};
use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::plain;

use super::FitLawAnswer;
use super::laws::StatedLawsAnswer;
use super::page::{coefficient, ends};
use super::shown::{SpeedUnit, with_error};

/// Points of a curve that is drawn.
const POINTS: u32 = 120;

/// Most laws drawn in addition to the best.
const MOST_RIVALS: usize = 4;

/// Name, unit and divisor (from SI) of the upward axis.
fn upward(of: LawOf) -> (&'static str, &'static str, f64) {
    match of {
        LawOf::Rise => ("temperature rise", "K", 1.0),
        LawOf::TimeConstant => ("time constant", "min", 60.0),
        LawOf::Power => ("dissipated power", "W", 1.0),
    }
}

/// A figure of a quantity over the speed, which is being built.
pub(super) struct OverSpeed<'a> {
    unit: &'a SpeedUnit,
    of: LawOf,
    /// Least and highest speed in rad/s.
    range: (f64, f64),
    curves: Vec<Curve>,
}

impl<'a> OverSpeed<'a> {
    pub(super) fn new(unit: &'a SpeedUnit, of: LawOf, range: (f64, f64)) -> Self {
        Self { unit, of, range, curves: Vec::new() }
    }

    fn put(&mut self, curve: Curve, place: usize) {
        self.curves.push(curve.as_place(place));
    }

    /// Speeds in rad/s at which curves are drawn.
    fn speeds(&self) -> Vec<f64> {
        let (low, high) = self.range;
        let at = |i: u32| low + (high - low) * f64::from(i) / f64::from(POINTS);
        (0..=POINTS).map(at).collect()
    }

    /// Adds measured values at speeds in rad/s, in SI units.
    /// Standard errors are added if they are known.
    pub(super) fn measured(
        &mut self,
        (name, place): (&str, usize),
        speeds: &[f64],
        (values, errors): (&[f64], Option<&[f64]>),
    ) {
        let (_, _, scale) = upward(self.of);
        let rows = speeds.iter().zip(values);
        let points = rows.map(|(speed, v)| (self.unit.0.from_si(*speed), v / scale)).collect();
        let bars = errors.unwrap_or_default();
        let bars = bars.iter().zip(values).map(|(e, v)| ((v - e) / scale, (v + e) / scale));
        let dots = Curve::line(name, points).within(bars.collect());
        self.put(dots.looks(Look::Dots), place);
    }

    /// Adds a law: `of` gives its value and half the width of its band at a speed in rad/s.
    /// Both are in SI units; the half width is NaN if it is not known.
    fn law(&mut self, name: &str, (look, place): (Look, usize), of: impl Fn(f64) -> (f64, f64)) {
        let values: Vec<(f64, (f64, f64))> =
            self.speeds().into_iter().map(|speed| (speed, of(speed))).collect();
        self.valued(name, (look, place), &values);
    }

    fn valued(&mut self, name: &str, (look, place): (Look, usize), of: &[(f64, (f64, f64))]) {
        let (_, _, scale) = upward(self.of);
        let shown = |speed: f64| self.unit.0.from_si(speed);
        let points = of.iter().map(|(speed, (value, _))| (shown(*speed), value / scale)).collect();
        let mut curve = Curve::line(name, points).looks(look);
        if of.iter().all(|(_, (_, half))| half.is_finite()) {
            let side = |(_, (v, h)): &(f64, (f64, f64))| ((v - h) / scale, (v + h) / scale);
            curve = curve.within(of.iter().map(side).collect());
        }
        self.put(curve, place);
    }

    /// A power of the speed through a point.
    fn power(&mut self, name: &str, style: (Look, usize), (speed, value, n): (f64, f64, f64)) {
        self.law(name, style, |omega| (value * (omega / speed).powf(n), f64::NAN));
    }

    pub(super) fn figure(self, of: &str, notes: &[String]) -> Figure {
        let (name, unit, _) = upward(self.of);
        let x = Axis::linear("speed", &*self.unit.0.text);
        let mut panel = Panel::new(x, Axis::linear(name, unit));
        // points over lines
        panel.curves = self.curves;
        panel.curves.sort_by_key(|curve| curve.look == Look::Dots);
        let title = format!("{of}: {name} over speed");
        Figure { title, note: notes.join("\n"), panels: vec![panel] }
    }
}

/// The power of the speed that was fitted to the rises, and one in proportion for comparison.
pub(super) fn rise_laws(over: &mut OverSpeed<'_>, place: usize, found: &Consistency) -> String {
    let (middle, n) = (&found.at[1], found.rise);
    over.power("omega^n", (Look::Line, place), (middle.speed, middle.rise, n.value));
    over.power("in proportion", (Look::Dashed, place), (middle.speed, middle.rise, 1.0));
    let exponent = with_error(n.value, n.standard_error);
    format!("line: omega^n with n = {exponent}; dashed: in proportion to the speed")
}

/// The power of the speed that was fitted to the time constants.
pub(super) fn time_laws(over: &mut OverSpeed<'_>, place: usize, found: &Consistency) -> String {
    let (middle, n) = (&found.at[1], found.time_constant);
    let through = (middle.speed, middle.time_constant, n.value);
    over.power("omega^n", (Look::Dashed, place), through);
    format!("dashed: omega^n with n = {}", with_error(n.value, n.standard_error))
}

/// A constant with the scatter of one value, in s.
pub(super) fn mean(over: &mut OverSpeed<'_>, (name, place): (&str, usize), of: (f64, f64)) {
    over.law(&format!("mean of {name}"), (Look::Line, place), |_| of);
}

/// The best law with its band, and the laws that the points cannot distinguish from it.
pub(super) fn power_laws(over: &mut OverSpeed<'_>, answer: &FitLawAnswer) -> Vec<String> {
    let study = &answer.study;
    let mut notes = vec![study.verdict()];
    let best = study.best().or(study.candidates.first().filter(|c| c.fitted().is_some()));
    let Some((best, fit)) = best.and_then(|best| Some((best, best.fitted()?))) else {
        return notes;
    };
    let numbers = (0..fit.coefficients.len()).map(|i| coefficient(answer, best, fit, i));
    let numbers: Vec<String> = numbers.collect();
    notes.push(format!("line with its 95 % band: {}, {}", best.law, numbers.join("; ")));
    put_law(over, answer, (best, Look::Line, 0));
    let rivals = study.rivals();
    for (i, rival) in rivals.iter().take(MOST_RIVALS).enumerate() {
        put_law(over, answer, (rival, Look::Dashed, 1 + i));
    }
    if rivals.len() > MOST_RIVALS {
        notes.push(format!("{} more laws are as good", rivals.len() - MOST_RIVALS));
    }
    if let Some(found) = answer.consistency.as_ref().filter(|found| !found.derived) {
        let (at, n) = (&found.at[1], found.implied.value);
        let place = 1 + rivals.len().min(MOST_RIVALS);
        over.power("C dT / t_RC", (Look::Dashed, place), (at.speed, at.implied, n));
    }
    notes
}

/// A law of the power. One that uses more than the speed is known at the points alone.
fn put_law(
    over: &mut OverSpeed<'_>,
    answer: &FitLawAnswer,
    (law, look, place): (&LawFit, Look, usize),
) {
    let name = plain(&law.law.to_string());
    let speeds = over.speeds();
    if let Some(found) = answer.study.along(law, &speeds) {
        // bands of rivals would cover the best one's
        let band = |(v, h): (f64, f64)| (v, if look == Look::Line { h } else { f64::NAN });
        let values = speeds.into_iter().zip(found.into_iter().map(band)).collect::<Vec<_>>();
        return over.valued(&name, (look, place), &values);
    }
    let Some(fit) = law.fitted() else { return };
    let of = answer.study.points.speed().iter().zip(&fit.values);
    let mut values: Vec<(f64, (f64, f64))> = of.map(|(s, v)| (*s, (*v, f64::NAN))).collect();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    over.valued(&format!("{name} at the points"), (look, place), &values);
}

impl FitLawAnswer {
    /// Figures of rise and time constant, if the file has them, and of power.
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let (data, speeds) = (&self.data, self.data.points.speed());
        let range = ends(speeds);
        let (name, errors) = (plain(&data.name), data.errors.as_ref());
        let bars = "bars: one standard error".to_owned();
        let mut figures = Vec::new();
        let given = [(LawOf::Rise, &data.rise), (LawOf::TimeConstant, &data.time_constant)];
        for (i, (of, values)) in given.into_iter().enumerate() {
            let Some(values) = values else { continue };
            let mut over = OverSpeed::new(&data.unit, of, range);
            over.measured((of.symbol(), 0), speeds, (values, errors.map(|e| &*e[i])));
            let laws = if of == LawOf::Rise { rise_laws } else { time_laws };
            let law = self.consistency.as_ref().map(|found| laws(&mut over, 0, found));
            let bars = errors.map(|_| bars.clone());
            figures.push(over.figure(&name, &law.into_iter().chain(bars).collect::<Vec<_>>()));
        }
        let mut over = OverSpeed::new(&data.unit, LawOf::Power, range);
        let deviation = data.points.deviation();
        let values = (data.points.power(), deviation);
        over.measured((&data.power_name, 0), speeds, values);
        let mut notes = power_laws(&mut over, self);
        notes.extend(deviation.map(|_| bars));
        figures.push(over.figure(&name, &notes));
        figures
    }
}

impl StatedLawsAnswer {
    /// The three laws, the time constant that rise and power need, and the power that rise and
    /// time constant imply.
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let capacity = self.found.capacity;
        let value = |law: &StatedLaw, speed: f64| law.value(speed).unwrap_or(f64::NAN);
        let [rise, tau, power] = &self.laws;
        let picture = |law: &StatedLaw, implied: Option<(&str, &dyn Fn(f64) -> f64)>| {
            let mut over = OverSpeed::new(&self.unit, law.of, self.found.range);
            let error = law.relative_error.unwrap_or(f64::NAN);
            let band = |speed: f64| (value(law, speed), error * value(law, speed));
            over.law(law.of.symbol(), (Look::Line, 0), band);
            let mut notes = vec![format!("{} = {} as stated", law.of.symbol(), plain(&law.text))];
            notes.extend(law.relative_error.map(|_| "band: \u{b1} as stated".to_owned()));
            if let Some((name, of)) = implied {
                over.law(name, (Look::Dashed, 1), |speed| (of(speed), f64::NAN));
                notes.push(format!("dashed: {name}, with which all three would agree"));
            }
            over.figure("Three laws of the speed", &notes)
        };
        let needed = |speed| capacity * value(rise, speed) / value(power, speed);
        let implied = |speed| capacity * value(rise, speed) / value(tau, speed);
        vec![
            picture(rise, None),
            picture(tau, Some(("C dT / P", &needed))),
            picture(power, Some(("C dT / t_RC", &implied))),
        ]
    }
}
