//! Inputs that repeat themselves: their period, and a check that they really repeat.

use lptn_units::EvalError;

use crate::evaluation::Evaluation;
use crate::id::{Field, Item, SignalId};
use crate::input_error::InputError;
use crate::network::Network;
use crate::parts::signal::AfterEnd;
use crate::slot;
use crate::value::Value;

/// Two signals whose periods have no reasonably small common multiple.
#[derive(Clone, Debug, PartialEq)]
pub struct NoCommonPeriod {
    /// The two signals whose periods do not fit.
    pub signals: [SignalId; 2],
    /// Their names.
    pub names: [String; 2],
    /// The period of the first one, and of those before it, in s, and that of the second.
    pub periods: [f64; 2],
}

/// An input that is not the same one period later.
#[derive(Clone, Debug, PartialEq)]
pub struct NotPeriodic {
    /// The item that it belongs to.
    pub item: Item,
    /// The field of the item.
    pub field: Field,
    /// The name of the item.
    pub name: String,
    /// A time in s.
    pub time: f64,
    /// The period in s.
    pub period: f64,
    /// Its values in SI units at that time and one period later; `None` if it has none.
    pub values: [Option<f64>; 2],
    /// The unit of the values, if it is known.
    pub unit: Option<String>,
}

/// The most periods of one signal in a common period.
const MOST_PERIODS: u32 = 1000;

/// Largest relative difference between equal multiples of two periods.
const SAME_PERIOD: f64 = 1e-9;

/// Values that differ by this part of the largest are the same: times are rounded when a period is
/// added.
const SAME_VALUE: f64 = 1e-9;

/// Least number of samples of the inputs in a period.
const LOOKS: usize = 64;

/// Least number of samples in a stretch between two breakpoints.
const LEAST_LOOKS: usize = 5;

/// Temperatures in K of the two ends of a path, for values that depend on them as well.
const ENDS: [(f64, f64); 3] = [(310.0, 300.0), (350.0, 290.0), (280.0, 400.0)];

impl Network {
    /// The least time in s after which every repeated signal in use restarts; `None` if none is
    /// repeated. An expression in `t` may repeat itself too, which this does not detect.
    ///
    /// # Errors
    /// [`NoCommonPeriod`] for periods that are not small multiples of a common one.
    pub fn repeat_period(&self) -> Result<Option<f64>, NoCommonPeriod> {
        let mut common: Option<(SignalId, f64)> = None;
        for (id, period) in self.repeated_signals() {
            let Some((first, so_far)) = common else {
                common = Some((id, period));
                continue;
            };
            let least = common_multiple(so_far, period).ok_or_else(|| {
                let name = |id: SignalId| self.signals()[id.index()].name.clone();
                let (signals, names) = ([first, id], [name(first), name(id)]);
                NoCommonPeriod { signals, names, periods: [so_far, period] }
            })?;
            common = Some((id, least));
        }
        Ok(common.map(|(_, period)| period))
    }

    fn repeated_signals(&self) -> impl Iterator<Item = (SignalId, f64)> + '_ {
        let used = self.parts.driving().signals;
        self.signal_ids().filter_map(move |id| match self.signals()[id.index()].course.after() {
            AfterEnd::Repeat(period) if used[id.index()] => Some((id, period)),
            _ => None,
        })
    }

    /// Checks that every input has the same values in `start..start + period` and one period later,
    /// times in s. Values that depend on temperatures are compared at a few of them.
    ///
    /// # Errors
    /// The first input that has not. The inner error is that of [`Network::breakpoints`].
    pub fn check_period(
        &self,
        start: f64,
        period: f64,
    ) -> Result<Result<(), NotPeriodic>, InputError> {
        let times = self.look_times(start, period)?;
        let mut scope = self.evaluation();
        let (nodes, boundaries) =
            (vec![ENDS[0].0; self.nodes().len()], vec![ENDS[0].1; self.boundaries().len()]);
        scope.set_temperatures(&nodes, &boundaries);
        let items = self.inputs().filter(|(item, _, value)| {
            self.depends_on_time(value) && !matches!(item, Item::Signal(_))
        });
        for (item, field, value) in items {
            if let Some(found) = self.differs((item, field, value), &mut scope, (&times, period)) {
                return Ok(Err(found));
            }
        }
        Ok(Ok(()))
    }

    /// Times inside the stretches between breakpoints of the first period and of the one after it,
    /// each with the middle of its stretch.
    fn look_times(&self, start: f64, period: f64) -> Result<Vec<(f64, f64)>, InputError> {
        let later = |t: f64| if t > start + period { t - period } else { t };
        let mut ends = self.breakpoints(start, start + 2.0 * period)?;
        ends.iter_mut().for_each(|t| *t = later(*t));
        ends.extend([start, start + period]);
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| *b - *a <= SAME_PERIOD * period);
        let count = (LOOKS / ends.len()).max(LEAST_LOOKS);
        let stretch = |pair: &[f64]| {
            let (from, length) = (pair[0], pair[1] - pair[0]);
            let middle = from + 0.5 * length;
            // the golden section: no two samples are a simple part of the stretch apart
            let place =
                move |k: usize| from + length * (0.618_033_988_749_895 * (k as f64 + 0.3)).fract();
            (0..count).map(move |k| (place(k), middle)).collect::<Vec<_>>()
        };
        Ok(ends.windows(2).flat_map(stretch).collect())
    }

    fn differs(
        &self,
        (item, field, value): (Item, Field, &Value),
        scope: &mut Evaluation,
        (times, period): (&[(f64, f64)], f64),
    ) -> Option<NotPeriodic> {
        let mut seen = Vec::with_capacity(times.len());
        for &(time, middle) in times {
            let now = at_ends(value, scope, (time, middle));
            let then = at_ends(value, scope, (time + period, middle + period));
            seen.extend(now.into_iter().zip(then).map(|pair| (time, pair)));
        }
        let sizes = seen.iter().flat_map(|(_, (a, b))| [a, b]).flatten().map(|x| x.abs());
        let largest = sizes.fold(0.0, f64::max);
        let unlike = |(_, pair): &&(f64, (Option<f64>, Option<f64>))| match pair {
            (Some(a), Some(b)) => (a - b).abs() > SAME_VALUE * largest,
            (None, None) => false,
            _ => true,
        };
        let &(time, (now, then)) = seen.iter().find(unlike)?;
        let name = self.name_of(item).into_owned();
        let unit = unit_of(field);
        Some(NotPeriodic { item, field, name, time, period, values: [now, then], unit })
    }
}

/// A value at a time, for each of [`ENDS`] if it depends on temperatures; `None` if it has none.
fn at_ends(value: &Value, scope: &mut Evaluation, (time, segment): (f64, f64)) -> Vec<Option<f64>> {
    scope.set_time(time, segment);
    let one = |(from, to): (f64, f64)| {
        let mean = 0.5 * (from + to);
        let slots = [slot::FROM, slot::TO, slot::MEAN, slot::DIFFERENCE, slot::OWN];
        slots
            .into_iter()
            .zip([from, to, mean, from - to, mean])
            .for_each(|(slot, t)| scope.set(slot, t));
        let found: Result<f64, EvalError> = value.at(scope);
        found.ok().filter(|x| x.is_finite())
    };
    ENDS.into_iter().map(one).collect()
}

/// The unit of the fields whose numbers are worth showing.
fn unit_of(field: Field) -> Option<String> {
    Some(match field {
        Field::Temperature => "K".to_owned(),
        Field::Law(law) => law.ty.dimension.si_unit(),
        _ => return None,
    })
}

fn common_multiple(a: f64, b: f64) -> Option<f64> {
    let is_multiple = |k: &u32| {
        let ratio = f64::from(*k) * a / b;
        let near = (ratio - ratio.round()).abs() <= SAME_PERIOD * ratio;
        near && ratio.round() >= 1.0 && ratio <= f64::from(MOST_PERIODS)
    };
    (1..=MOST_PERIODS).find(is_multiple).map(|k| f64::from(k) * a)
}

#[cfg(test)]
mod tests {
    use super::common_multiple;

    #[test]
    fn periods_have_a_common_multiple_or_none() {
        let is = |a: f64, b: f64, c: f64| {
            common_multiple(a, b).is_some_and(|m| (m - c).abs() < 1e-9 * c)
        };
        assert!(is(60.0, 60.0, 60.0) && is(60.0, 90.0, 180.0) && is(90.0, 60.0, 180.0));
        assert!(
            is(0.1, 0.3, 0.3) && is(86_400.0, 600.0, 86_400.0) && is(600.0, 86_400.0, 86_400.0)
        );
        assert_eq!(common_multiple(1.0, std::f64::consts::PI), None);
        assert_eq!(common_multiple(60.0, 60.001), None);
    }
}
