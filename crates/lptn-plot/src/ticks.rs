//! Marks of an axis and their texts.

use crate::figure::{Axis, Scale};

/// An axis with its range, its marks and its title.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ruler {
    /// Lowest and highest value.
    pub(crate) range: (f64, f64),
    /// Values with their texts.
    pub(crate) ticks: Vec<(f64, String)>,
    /// Name and unit.
    pub(crate) title: String,
    log: bool,
}

impl Ruler {
    /// An axis for values from `low` to `high` with about `count` marks. With `whole`, the range is
    /// widened to its outermost marks.
    pub(crate) fn new(axis: &Axis, (low, high): (f64, f64), count: f64, whole: bool) -> Self {
        match &axis.scale {
            Scale::Linear => linear(axis, (low, high), count, whole),
            Scale::Log => log(axis, (low, high), count),
            Scale::Time => time(axis, (low, high), count),
            Scale::Names(names) => named(axis, names),
        }
    }

    /// The place of a value, from 0 at the lowest to 1 at the highest.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        if self.log {
            return (value.ln() - low.ln()) / (high.ln() - low.ln());
        }
        (value - low) / (high - low)
    }
}

/// Widens a range of one value, so that it is not empty.
fn opened((low, high): (f64, f64)) -> (f64, f64) {
    if high - low > 1e-12 * low.abs().max(high.abs()) {
        return (low, high);
    }
    let middle = f64::midpoint(low, high);
    let half = if middle.abs() > 1.0 || middle.abs() < 1e-300 { 0.5 } else { 0.5 * middle.abs() };
    (middle - half, middle + half)
}

fn linear(axis: &Axis, range: (f64, f64), count: f64, whole: bool) -> Ruler {
    let (low, high) = opened(range);
    let step = round_step((high - low) / count.max(1.0));
    let (first, last) = ((low / step - 1e-9).floor(), (high / step + 1e-9).ceil());
    let range = if whole { (first * step, last * step) } else { (low, high) };
    // one number alone does not show the scale
    let steps = [step, round_step(0.4 * step), round_step(0.1 * step)].map(|s| marks(range, s));
    let ticks = steps.into_iter().find(|ticks| ticks.len() > 1).unwrap_or_default();
    Ruler { range, ticks, title: title(&axis.name, &axis.unit), log: false }
}

/// Multiples of a step inside a range.
fn marks((low, high): (f64, f64), step: f64) -> Vec<(f64, String)> {
    let notation = Notation::of(low.abs().max(high.abs()), step);
    let margin = 1e-6;
    let (first, last) = ((low / step - margin).ceil(), (high / step + margin).floor());
    let mut ticks = Vec::new();
    let mut at = first;
    while at <= last && ticks.len() < 1000 {
        ticks.push((at * step, notation.text(at * step)));
        at += 1.0;
    }
    ticks
}

/// About `count` round values inside a range, with their texts.
pub fn round_marks((low, high): (f64, f64), count: f64) -> Vec<(f64, String)> {
    let is_range = high > low && (high - low).is_finite();
    if is_range {
        marks((low, high), round_step((high - low) / count.max(1.0)))
    } else {
        Vec::new()
    }
}

/// Notation of the numbers of an axis, with enough digits to distinguish its marks.
struct Notation {
    decimals: usize,
    /// A power of ten that all share.
    power: Option<i32>,
}

impl Notation {
    /// Notation for numbers up to `largest` that are multiples of `step`.
    fn of(largest: f64, step: f64) -> Self {
        let (high, low) = (exponent(largest), exponent(step));
        let decimals = |digits: i32| usize::try_from(digits).unwrap_or(0);
        if high <= 6 && low >= -6 || (0..=3).contains(&high) && low >= -9 {
            return Self { decimals: decimals(-low), power: None };
        }
        Self { decimals: decimals(high - low), power: Some(high) }
    }

    /// A number, with a typographic minus sign.
    fn text(&self, value: f64) -> String {
        let decimals = self.decimals;
        let text = match self.power {
            Some(power) => format!("{:.decimals$}", value / 10_f64.powi(power)),
            None => format!("{value:.decimals$}"),
        };
        if text.bytes().all(|c| matches!(c, b'-' | b'0' | b'.')) {
            return if self.power.is_some() { "0".into() } else { text.replace('-', "") };
        }
        let power = self.power.map_or(String::new(), |power| format!("e{power}"));
        format!("{text}{power}").replace('-', "\u{2212}")
    }
}

/// The power of ten of a number.
fn exponent(value: f64) -> i32 {
    (value.log10() + 1e-9).floor().clamp(-300.0, 300.0) as i32
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `least`.
pub(crate) fn round_step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|step| step * power >= least * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

fn log(axis: &Axis, (low, high): (f64, f64), count: f64) -> Ruler {
    let (low, high) = if low > 0.0 && high > low * 1.001 {
        (low, high)
    } else {
        let middle = high.max(f64::MIN_POSITIVE * 10.0);
        (middle / 2.0, middle * 2.0)
    };
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let few = f64::from(last - first) <= count / 3.0;
    let digits: &[f64] = if few { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let every = (f64::from(last - first) / count.max(1.0)).ceil().max(1.0) as i32;
    let inside = |value: &f64| *value >= low * (1.0 - 1e-9) && *value <= high * (1.0 + 1e-9);
    let all = (first..=last)
        .filter(|power| power % every == 0)
        .flat_map(|power| digits.iter().map(move |digit| digit * 10_f64.powi(power)));
    let ticks = all.filter(inside).map(|value| (value, decade(value))).collect();
    Ruler { range: (low, high), ticks, title: title(&axis.name, &axis.unit), log: true }
}

fn decade(value: f64) -> String {
    let power = exponent(value);
    if (-3..5).contains(&power) {
        return Notation::of(value, 10_f64.powi(power)).text(value);
    }
    format!("{}e{power}", (value / 10_f64.powi(power)).round()).replace('-', "\u{2212}")
}

/// A number with four digits, for sentences.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    Notation::of(value.abs(), 10_f64.powi(exponent(value.abs()) - 3)).text(value)
}

/// Units of time with their seconds and the steps that divide each.
const TIMES: [(&str, f64, &[f64]); 5] = [
    ("ms", 1e-3, &[1.0, 2.0, 5.0]),
    ("s", 1.0, &[1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0]),
    ("min", 60.0, &[1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0]),
    ("h", 3600.0, &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0]),
    ("d", 86400.0, &[1.0, 2.0, 5.0, 7.0, 10.0, 20.0, 30.0, 50.0, 100.0]),
];

/// The largest unit that a time of this length in s has at least three of, or else ms.
fn time_unit(length: f64) -> (&'static str, f64, &'static [f64]) {
    let fits = |unit: &&(_, f64, _)| length >= 3.0 * unit.1;
    *TIMES.iter().rev().find(fits).unwrap_or(&TIMES[0])
}

fn time(axis: &Axis, range: (f64, f64), count: f64) -> Ruler {
    let (low, high) = opened(range);
    let (unit, scale, steps) = time_unit(high - low);
    let least = (high - low) / scale / count.max(1.0);
    let step = steps.iter().copied().find(|step| *step >= least && least > 0.5);
    let step = step.unwrap_or_else(|| round_step(least));
    let ticks = marks((low / scale, high / scale), step);
    let ticks = ticks.into_iter().map(|(value, text)| (value * scale, text)).collect();
    Ruler { range: (low, high), ticks, title: title(&axis.name, unit), log: false }
}

fn named(axis: &Axis, names: &[String]) -> Ruler {
    let ticks = names.iter().enumerate().map(|(i, name)| (i as f64, name.clone())).collect();
    let range = (-0.5, names.len() as f64 - 0.5);
    Ruler { range, ticks, title: title(&axis.name, &axis.unit), log: false }
}

/// Name and unit of an axis.
fn title(name: &str, unit: &str) -> String {
    match unit {
        "" | "1" | "-" => name.into(),
        unit if name.is_empty() => format!("[{}]", printed(unit)),
        unit => format!("{name} [{}]", printed(unit)),
    }
}

/// A unit as it is printed: `degC` as °C, `Ohm` as Ω, powers of 2 and 3 raised.
pub fn printed(unit: &str) -> String {
    let unit = unit.replace("deg", "\u{b0}").replace("^2", "\u{b2}").replace("^3", "\u{b3}");
    unit.replace("Ohm", "\u{3a9}")
}

#[cfg(test)]
mod tests {
    use super::{Ruler, printed};
    use crate::figure::Axis;

    fn texts(axis: &Axis, range: (f64, f64), count: f64) -> (Vec<String>, String) {
        let ruler = Ruler::new(axis, range, count, false);
        (ruler.ticks.into_iter().map(|(_, text)| text).collect(), ruler.title)
    }

    #[test]
    fn times_are_told_as_people_tell_them() {
        let cases = [
            (1500.0, vec!["0", "5", "10", "15", "20", "25"], "time [min]"),
            (90.0, vec!["0", "15", "30", "45", "60", "75", "90"], "time [s]"),
            (86400.0, vec!["0", "4", "8", "12", "16", "20", "24"], "time [h]"),
            (604_800.0, vec!["0", "1", "2", "3", "4", "5", "6", "7"], "time [d]"),
            (0.01, vec!["0", "2", "4", "6", "8", "10"], "time [ms]"),
            (2e-6, vec!["0.0000", "0.0005", "0.0010", "0.0015", "0.0020"], "time [ms]"),
        ];
        for (stop, ticks, title) in cases {
            let (found, named) = texts(&Axis::time(), (0.0, stop), 7.0);
            assert_eq!((found, &*named), (ticks.iter().map(|t| (*t).to_owned()).collect(), title));
        }
    }

    #[test]
    fn marks_are_round_and_keep_their_sign() {
        let axis = Axis::linear("heat", "W/m^2");
        let (found, title) = texts(&axis, (-0.3, 0.31), 6.0);
        assert_eq!(found, ["\u{2212}0.2", "0.0", "0.2"]);
        assert_eq!(title, "heat [W/m\u{b2}]");
        assert_eq!(texts(&axis, (0.0, 3e7), 3.0).0, ["0", "1e7", "2e7", "3e7"]);
        assert_eq!(texts(&axis, (5.0, 5.0), 2.0).0, ["4.5", "5.0", "5.5"]);
        assert_eq!(texts(&axis, (-0.3, 0.31), 2.0).0, ["\u{2212}0.2", "0.0", "0.2"]);
        assert_eq!(printed("degC"), "°C");
    }

    /// Two marks with the same text would suggest that nothing changes.
    #[test]
    fn marks_are_told_apart() {
        for range in [
            (999_000.0, 1_001_000.0),
            (1e6, 1_000_900.0),
            (20.0, 20.000_004),
            (-273.15, -273.149_999_9),
            (1e-12, 3e-12),
            (-3e-12, 3e-12),
            (1e9, 1e9 + 50.0),
        ] {
            let (mut found, _) = texts(&Axis::linear("heat", "W"), range, 5.0);
            let value = |text: &String| text.replace('\u{2212}', "-").parse::<f64>().unwrap();
            let span = range.1 - range.0;
            let inside = |v: f64| v >= range.0 - 1e-3 * span && v <= range.1 + 1e-3 * span;
            assert!(found.len() >= 3 && found.iter().map(value).all(inside), "{found:?}");
            let count = found.len();
            found.dedup();
            assert_eq!(found.len(), count, "{found:?}");
        }
    }

    #[test]
    fn logarithms_have_decades() {
        let axis = Axis::log("frequency", "Hz");
        assert_eq!(texts(&axis, (0.01, 1e6), 9.0).0[..4], ["0.01", "0.1", "1", "10"]);
        assert_eq!(texts(&axis, (1.0, 100.0), 9.0).0, ["1", "2", "5", "10", "20", "50", "100"]);
    }
}
