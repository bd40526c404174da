//! Outliers of every kind, and the text on them.

use crate::record::spikes::spikes;
use crate::record::stuck::{LONG, stuck};

/// The places of outliers, in order; those of a temperature in K include readings that are stuck.
/// `values` has no gaps.
pub(crate) fn outliers(values: &[f64], is_temperature: bool) -> Vec<usize> {
    let mut found = spikes(values);
    if is_temperature {
        found.extend(stuck(values));
        found.sort_unstable();
        found.dedup();
    }
    found
}

/// The text on outliers among `count` values: the first of them, `at` its time, the number of rows
/// in which it stays, the next value that is not one, and the number of others.
pub(crate) fn told(
    (outliers, count): (&[usize], usize),
    at: &str,
    shown: impl Fn(usize) -> String,
) -> Option<String> {
    let first = *outliers.first()?;
    let near = (first + 1..count).find(|place| !outliers.contains(place));
    let near = near.or_else(|| (0..first).next_back()).unwrap_or(first);
    let (value, near) = (shown(first), shown(near));
    let alike = |(place, k): &(&usize, usize)| **place == first + k && shown(**place) == value;
    let (all, same) = (outliers.len(), outliers.iter().zip(0..).take_while(alike).count());
    let rest = |known: usize| match all - known {
        0 => String::new(),
        more => format!("; {more} more are as far off"),
    };
    Some(match same {
        ..LONG => format!("reads {value}{at}, but {near} next to it{}", rest(1)),
        _ => {
            let others = same - 1;
            let rest = rest(same);
            format!(
                "reads {value}{at} and in {others} rows after it, but {near} next to them{rest}"
            )
        }
    })
}
