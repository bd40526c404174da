//! Lists of times, frequencies and shares, and their defaults.

use std::f64::consts::TAU;

use lptn_units::{Dimension, Type, parse_quantity};

use super::Form;
use crate::failure::Failure;
use crate::input;

/// Positive numbers in s.
pub(super) fn times(text: &str) -> Result<Vec<f64>, Failure> {
    ascending("--time", text, text.split(',').map(|word| time(word.trim())).collect())
}

fn time(word: &str) -> Result<f64, Failure> {
    let what = (Dimension::TIME, "impedance::list", "1ms,1s");
    Ok(input::positive("--time", word, what)?.value)
}

/// Angular frequencies in rad/s; 0 is the steady response.
pub(super) fn omegas(text: &str) -> Result<Vec<f64>, Failure> {
    ascending("--omega", text, text.split(',').map(|word| omega(word.trim())).collect())
}

fn omega(word: &str) -> Result<f64, Failure> {
    let plain = parse_quantity(word, Some(Type::of(Dimension::FREQUENCY)));
    match plain {
        Ok(hertz) => Ok(TAU * hertz.value),
        Err(_) => {
            let ty = Type::of(Dimension::ANGULAR_VELOCITY);
            Ok(input::quantity("--omega", word, ty)?.value)
        }
    }
}

/// Shares between 0 and 1.
pub(super) fn shares(text: &str) -> Result<Vec<f64>, Failure> {
    let one = |word: &str| {
        let share = input::quantity("--duty", word, Type::SCALAR)?.value;
        match share > 0.0 && share < 1.0 {
            true => Ok(share),
            false => {
                let message = format!("--duty takes shares between 0 and 1, got `{word}`");
                let help = "write for example --duty 0.5,0.2,0.1";
                Err(Failure::refused("impedance::duty", message, help))
            }
        }
    };
    text.split(',').map(|word| one(word.trim())).collect()
}

/// Values of at least 0 in ascending order, each once: the curve is drawn through them.
fn ascending(
    option: &str,
    text: &str,
    values: Result<Vec<f64>, Failure>,
) -> Result<Vec<f64>, Failure> {
    let mut values = values?;
    if values.iter().any(|value| *value < 0.0 || !value.is_finite()) {
        let message = format!("the values of {option} must be 0 or more, got `{text}`");
        let help = format!("write for example {option} \"1 s, 10 s\"");
        let help = if option == "--time" { help } else { help.replace(" s", " Hz") };
        return Err(Failure::refused("impedance::list", message, help));
    }
    values.sort_by(f64::total_cmp);
    values.dedup();
    Ok(values)
}

/// A note that a list is shown in another order than it was given in, or without repetitions.
pub(super) fn reordered(form: &Form) -> Option<String> {
    let given = |text: &str, one: &dyn Fn(&str) -> Result<f64, Failure>| {
        let values = text.split(',').filter_map(|word| one(word.trim()).ok());
        values.collect::<Vec<f64>>().windows(2).any(|pair| pair[0] >= pair[1])
    };
    let option = match form {
        Form::Step { times: Some(times), .. } if given(times, &time) => "--time",
        Form::Swing(Some(omegas)) if given(omegas, &omega) => "--omega",
        _ => return None,
    };
    Some(format!("note: the values of {option} are listed in ascending order, each once"))
}

/// 1, 2, 5, 10 and so on, from the last below `from` to the first above `to`.
pub(super) fn three_a_decade(from: f64, to: f64) -> Vec<f64> {
    if !(from > 0.0 && from <= to && to.is_finite()) {
        return Vec::new();
    }
    let mut values = Vec::new();
    let (first, last) = (from.log10().floor(), to.log10().ceil());
    let mut decade = first;
    while decade <= last {
        // written out and read, so that 0.2 is the number that 0.2 is
        let of = |digit: u32| format!("{digit}e{decade}").parse().unwrap_or(f64::NAN);
        values.extend([1, 2, 5].map(of));
        decade += 1.0;
    }
    let start = values.partition_point(|value| *value < from).saturating_sub(1);
    let end = values.partition_point(|value| *value < to);
    values[start..values.len().min(end + 1)].to_vec()
}

#[cfg(test)]
mod tests {
    use super::three_a_decade;

    #[test]
    #[allow(clippy::float_cmp, reason = "they are the numbers as written")]
    fn decades_hold_what_is_asked_for() {
        assert_eq!(three_a_decade(0.3, 4.0), [0.2, 0.5, 1.0, 2.0, 5.0]);
        assert_eq!(three_a_decade(0.2, 0.2), [0.1, 0.2]);
        assert!(three_a_decade(0.0, 4.0).is_empty());
        assert!(three_a_decade(1.0, f64::INFINITY).is_empty());
    }
}
