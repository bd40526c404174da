//! Property: the errors that a plan predicts are the scatter of what fits of such records find.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on has failed")]

use crate::planned;

use planned::{KINDS, Truth, predicted, scatter};

/// The scatter of 500 is known to 3.2 %, so 10 % are three of its standard deviations.
fn agree(truth: &Truth) {
    let (expected, found) = (predicted(truth), scatter(truth, 500));
    for (expected, found) in expected.iter().zip(&found) {
        let ratio = found / expected;
        println!("{truth:?}: {ratio:.3}");
        assert!((ratio - 1.0).abs() < 0.1, "{truth:?}: {found} is not {expected}");
    }
}

#[test]
fn predicted_errors_are_the_scatter_of_fits() {
    let [.., drift_and_offsets] = KINDS;
    agree(&Truth { samples: 101, every: 15.0, ..drift_and_offsets });
}

/// Every kind of noise: `cargo test --release --workspace --test all design_scatter:: -- --ignored
/// --nocapture`.
#[test]
#[ignore = "takes a minute"]
fn predicted_errors_are_the_scatter_of_fits_with_every_noise() {
    KINDS.iter().for_each(agree);
}
