//! Wrong bounds of series have to be noticed.

use super::super::at_rest::{DEFECT, Wrong, at_rest, errors, notices, turn};
use super::*;

/// The least share of bound over error, after the first step.
fn least_share(wrong: Wrong) -> f64 {
    let (system, rest) = at_rest();
    let segment = Segment { from: 0.0, to: 60.0 };
    let straight = |lacks: f64| {
        let mut straight = Straight::new(&system, &rest);
        assert_eq!(straight.enter(&system, segment, &rest), Some(()));
        straight.heat[0] -= lacks;
        straight
    };
    let right = straight(0.0);
    let mut slopes = right.slopes.clone();
    if wrong == Wrong::Sign {
        turn(&system, &mut slopes);
    }
    let mut bound = Bound::new(&right.pattern, system.mass()).unwrap_or_else(|e| panic!("{e}"));
    bound.set_matrix(&slopes);
    let mut rows = Rows::new(&system, &[], &[]);
    let mut group = Group::new(0.0, (2, 0));
    let options = Options { tolerance: 1e-9, max_step_size: Some(2.0), ..Options::default() };
    let way = OneStep::new(straight(DEFECT), 0.0, &rest, &options);
    let mut way = way.unwrap_or_else(|e| panic!("{e}"));
    way.set_stop(segment.to);
    let (peaks, mut least, mut count) = (Peaks::new(), f64::INFINITY, 0);
    while way.time() < segment.to {
        way.step().unwrap_or_else(|e| panic!("{e}"));
        if way.longer_series().is_none_or(|step| way.time() < step.span.1) {
            continue;
        }
        way.extend().unwrap_or_else(|e| panic!("{e}"));
        let Some(step) = way.longer_series() else { continue };
        assert_eq!(group.take(&Numbers::new(&step, &peaks, step.span.0), &right), Some(()));
        group.to = step.span.1;
        if wrong == Wrong::HalvedDefect {
            group.defect.iter_mut().for_each(|defect| *defect *= 0.5);
        }
        count += 1;
        if wrong == Wrong::SkippedStep && count == 2 {
            group.from = group.to;
            continue;
        }
        let closed = group.close(&mut bound, (&mut rows, &mut None), system.mass());
        closed.unwrap_or_else(|reason| panic!("{reason}"));
        let pairs = bound.now().iter().zip(errors(way.time()));
        least = pairs.map(|(bound, error)| bound / error).fold(least, f64::min);
    }
    least
}

#[test]
fn a_wrong_bound_is_exceeded() {
    notices(least_share);
}
