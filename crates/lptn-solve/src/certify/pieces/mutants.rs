//! Wrong bounds of pieces have to be noticed.

use super::super::at_rest::{Wrong, at_rest, errors, notices, turn};
use super::*;

const STEP: f64 = 2.0;

/// The least share of bound over error, after the first step.
fn least_share(wrong: Wrong) -> f64 {
    let (system, rest) = at_rest();
    let rows = Rows::new(&system, &[], &[]);
    let mut pieces = Pieces::new(&system, (rows, None, &rest), (0.0, 1e-5))
        .unwrap_or_else(|reason| panic!("{reason}"));
    let mut slopes = pieces.constant.clone().unwrap_or_default();
    if wrong == Wrong::Sign {
        turn(&system, &mut slopes);
        pieces.bound.set_matrix(&slopes);
    }
    let mut least = f64::INFINITY;
    for step in 0..30 {
        let (from, to) = (STEP * f64::from(step), STEP * f64::from(step + 1));
        let times = way::places::<SAMPLES>().map(|place| from + 0.5 * STEP * (1.0 + place));
        let samples = times.map(|time| {
            let errors = errors(time);
            vec![rest[0] - errors[0], rest[1] - errors[1]]
        });
        pieces.way.put(&samples, &pieces.basis);
        let read = pieces.collocation.read((&times, from + 1.0), &samples);
        assert_eq!(read, Some(()));
        let whole: Vec<Taylor> = (0..2).map(|i| pieces.way.whole(i)).collect();
        let mut defect = vec![0.0; 2];
        pieces.add_defect(2.0 / STEP, &whole, &mut defect);
        if wrong == Wrong::HalvedDefect {
            defect.iter_mut().for_each(|defect| *defect *= 0.5);
        }
        if wrong != Wrong::SkippedStep || step != 1 {
            let line = pieces.bound.over(STEP, &defect);
            pieces.bound.go(&line.unwrap_or_else(|| panic!("{wrong:?} at {from} s")));
        }
        let pairs = pieces.bound.now().iter().zip(errors(to));
        least = pairs.map(|(bound, error)| bound / error).fold(least, f64::min);
    }
    least
}

#[test]
fn a_wrong_bound_is_exceeded() {
    notices(least_share);
}
