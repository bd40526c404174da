//! Where an axis has marks, and what stands at them.

use crate::figure::{Axis, Scale};

/// An axis with its range, its marks and its title.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ruler {
    /// Lowest and highest value.
    pub(crate) range: (f64, f64),
    /// Values with their texts.
    pub(crate) ticks: Vec<(f64, String)>,
    /// What stands at the axis.
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

/// A range that is not empty around what may be one value.
fn opened((low, high): (f64, f64)) -> (f64, f64) {
    let around = 1e-9_f64.max(1e-9 * low.abs().max(high.abs()));
    if high - low > around {
        return (low, high);
    }
    let middle = f64::midpoint(low, high);
    let half = if middle.abs() > 1.0 { 0.5 } else { 0.5 * middle.abs().max(around) };
    (middle - half, middle + half)
}

fn linear(axis: &Axis, range: (f64, f64), count: f64, whole: bool) -> Ruler {
    let (low, high) = opened(range);
    let step = round_step((high - low) / count.max(1.0));
    let (first, last) = ((low / step - 1e-9).floor(), (high / step + 1e-9).ceil());
    let range = if whole { (first * step, last * step) } else { (low, high) };
    // one number alone does not tell how large a distance is
    let steps = [step, round_step(0.4 * step), round_step(0.1 * step)].map(|s| marks(range, s));
    let ticks = steps.into_iter().find(|ticks| ticks.len() > 1).unwrap_or_default();
    Ruler { range, ticks, title: title(&axis.name, &axis.unit), log: false }
}

/// Multiples of a step inside a range.
fn marks((low, high): (f64, f64), step: f64) -> Vec<(f64, String)> {
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    let margin = 1e-6;
    let (first, last) = ((low / step - margin).ceil(), (high / step + margin).floor());
    let mut ticks = Vec::new();
    let mut at = first;
    while at <= last && ticks.len() < 1000 {
        ticks.push((at * step, number(at * step, decimals)));
        at += 1.0;
    }
    ticks
}

/// A number with this many decimals and the sign of typography; large and tiny ones with a power of
/// ten.
fn number(value: f64, decimals: usize) -> String {
    let text = if value.abs() >= 1e6 || decimals > 5 {
        let text = format!("{value:.2e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'))
    } else {
        format!("{value:.decimals$}")
    };
    let is_zero = text.bytes().all(|c| matches!(c, b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches('-').into() } else { text.replace('-', "\u{2212}") }
}

/// The least of 1, 2 and 5 times a power of ten that is not below.
fn round_step(least: f64) -> f64 {
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
    let ticks = all.filter(inside).map(|value| (value, short(value))).collect();
    Ruler { range: (low, high), ticks, title: title(&axis.name, &axis.unit), log: true }
}

fn short(value: f64) -> String {
    let power = value.log10().floor();
    if (-3.0..5.0).contains(&power) {
        return number(value, (-power).max(0.0) as usize);
    }
    number(value, 12)
}

/// Seconds in the units in which people tell times, with the steps that divide each.
const TIMES: [(&str, f64, &[f64]); 5] = [
    ("ms", 1e-3, &[1.0, 2.0, 5.0]),
    ("s", 1.0, &[1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0]),
    ("min", 60.0, &[1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0]),
    ("h", 3600.0, &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0]),
    ("d", 86400.0, &[1.0, 2.0, 5.0, 7.0, 10.0, 20.0, 30.0, 50.0, 100.0]),
];

/// The unit in which a time of this length is told: one of which there are at least three.
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
        unit => format!("{name} [{}]", printed(unit)),
    }
}

/// A unit as it is printed: `degC` as °C, powers of 2 and 3 raised.
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

    #[test]
    fn logarithms_have_decades() {
        let axis = Axis::log("frequency", "Hz");
        assert_eq!(texts(&axis, (0.01, 1e6), 9.0).0[..4], ["0.01", "0.1", "1", "10"]);
        assert_eq!(texts(&axis, (1.0, 100.0), 9.0).0, ["1", "2", "5", "10", "20", "50", "100"]);
    }
}
