//! Zeros at the edges of parts.

use super::zero;

/// `x` from 0 to 1, and `-x`: the value at the edge is on neither side.
#[test]
fn a_zero_at_the_edge_of_a_part_is_there() {
    assert!(zero(&[0.0, 1.0], &[0.0, 1.0]) < 1e-15);
    assert!(zero(&[0.0, 1.0], &[-1.0, 0.5]).abs() < 1e-15);
    assert!((zero(&[-0.25, 1.0], &[-1.0, 1.0]) - 0.25).abs() < 1e-15);
    assert!((zero(&[0.25, -1.0], &[-1.0, 1.0]) - 0.25).abs() < 1e-15);
    assert!(zero(&[0.0, -1.0], &[-1.0, 0.0]).abs() < 1e-15);
}
