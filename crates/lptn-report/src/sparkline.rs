//! A curve in one line of text.

const LEVELS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// A curve over time as `width` characters, from its lowest to its highest value.
/// The first and the last character show its ends. A curve that varies by less than `least` is
/// flat. A curve without finite values is blank.
pub fn sparkline(times: &[f64], values: &[f64], width: usize, least: f64) -> String {
    let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
        return " ".repeat(width);
    };
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (low, high) =
        (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let span = (high - low).max(least);
    let cell = |i: usize| {
        let share = if width > 1 { i as f64 / (width - 1) as f64 } else { 1.0 };
        let above = at(times, values, first + share * (last - first)) - low;
        level(if span > 0.0 { above / span } else { above })
    };
    (0..width).map(cell).collect()
}

/// The character for a fraction of the way from lowest to highest.
fn level(share: f64) -> char {
    if !share.is_finite() {
        return ' ';
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 8")]
    let index = (share.clamp(0.0, 1.0) * 8.0) as usize;
    LEVELS[index.min(7)]
}

/// Linear interpolation between rows.
fn at(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times.partition_point(|&t| t < time).min(values.len().saturating_sub(1));
    let Some(&value) = values.get(after) else { return f64::NAN };
    let Some(before) = after.checked_sub(1) else { return value };
    let share = ((time - times[before]) / (times[after] - times[before])).clamp(0.0, 1.0);
    values[before] + share * (value - values[before])
}

#[cfg(test)]
mod tests {
    use super::sparkline;

    #[test]
    fn a_ramp_climbs_every_level() {
        assert_eq!(sparkline(&[0.0, 8.0], &[20.0, 28.0], 9, 0.0), "▁▂▃▄▅▆▇██");
    }

    #[test]
    fn uneven_times_are_drawn_in_proportion() {
        // up in the first tenth, then level
        assert_eq!(sparkline(&[0.0, 1.0, 10.0], &[0.0, 1.0, 1.0], 11, 0.0), "▁██████████");
    }

    #[test]
    fn less_than_the_least_span_is_flat() {
        assert_eq!(sparkline(&[0.0, 1.0, 2.0], &[25.0, 25.000_01, 25.0], 4, 1e-3), "▁▁▁▁");
        assert_eq!(sparkline(&[0.0, 1.0], &[25.0, 25.0], 3, 0.0), "▁▁▁");
    }

    #[test]
    fn nothing_to_draw_is_blank() {
        assert_eq!(sparkline(&[], &[], 3, 1.0), "   ");
        assert_eq!(sparkline(&[0.0, 1.0], &[f64::NAN, f64::NAN], 3, 1.0), "   ");
        assert_eq!(sparkline(&[0.0], &[1.0], 2, 1.0), "▁▁");
    }
}
