//! The coefficients of ARK4(3)6L\[2\]SA-ESDIRK and of a continuous extension of it.
//!
//! Source of `C`, `A`, `B` and the embedded weights: C. A. Kennedy and M. H. Carpenter, *Additive
//! Runge-Kutta schemes for convection-diffusion-reaction equations*, Applied Numerical Mathematics
//! 44 (2003), 139-181, its implicit part. Order 4, embedded order 3, stage order 2, L-stable,
//! stiffly accurate: the last stage is the step.
//!
//! `DENSE` is ours: of all weights of degree 4 in the share of the step that satisfy every order
//! condition up to 4 at every share and join with the right slope at both ends, those with the least
//! sum of squares. The conditions are tested.

/// Number of stages; the first one is explicit.
pub(super) const STAGES: usize = 6;

/// Diagonal of the implicit stages.
pub(super) const GAMMA: f64 = 0.25;

/// The stages' shares of the step.
pub(super) const C: [f64; STAGES] = [0.0, 0.5, 83.0 / 250.0, 31.0 / 50.0, 17.0 / 20.0, 1.0];

/// Weights of the stages before each stage.
pub(super) const A: [&[f64]; STAGES] = [
    &[],
    &[0.25],
    &[8611.0 / 62500.0, -1743.0 / 31250.0],
    &[5_012_029.0 / 34_652_500.0, -654_441.0 / 2_922_500.0, 174_375.0 / 388_108.0],
    &[
        15_267_082_809.0 / 155_376_265_600.0,
        -71_443_401.0 / 120_774_400.0,
        730_878_875.0 / 902_184_768.0,
        2_285_395.0 / 8_070_912.0,
    ],
    &[82889.0 / 524_892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102_672.0, -2260.0 / 8211.0],
];

/// Weights of the step.
pub(super) const B: [f64; STAGES] =
    [82889.0 / 524_892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102_672.0, -2260.0 / 8211.0, GAMMA];

/// Weights of order 4 less those of order 3: the error of a step.
pub(super) const ERROR: [f64; STAGES] = [
    B[0] - 4_586_570_599.0 / 29_645_900_160.0,
    0.0,
    B[2] - 178_811_875.0 / 945_068_544.0,
    B[3] - 814_220_225.0 / 1_159_782_912.0,
    B[4] + 3_700_637.0 / 11_593_932.0,
    B[5] - 61727.0 / 225_920.0,
];

/// For each stage the factors of the share, its square, its cube and its fourth power.
const DENSE: [[f64; 4]; STAGES] = [
    [1.0, -2.597_234_899_897_929, 2.826_134_980_442_543_3, -1.070_983_785_382_943],
    [0.0, 2.564_423_996_142_794, -5.128_847_992_285_588, 2.564_423_996_142_794],
    [0.0, 3.174_854_926_641_346, -5.602_674_091_186_69, 2.614_578_105_069_344],
    [0.0, -3.028_610_246_543_417_7, 8.779_481_674_324_174, -5.070_306_132_471_421],
    [0.0, -1.032_721_969_889_259_6, 0.964_481_815_798_492_6, -0.207_000_376_904_239_56],
    [0.0, 0.919_288_193_546_465_5, -1.838_576_387_092_931, 1.169_288_193_546_465_4],
];

/// Weights of the part of a step up to this share of it, from 0 to 1.
pub(super) fn weights(share: f64) -> [f64; STAGES] {
    if share >= 1.0 {
        return B;
    }
    DENSE.map(|[a, b, c, d]| share * (a + share * (b + share * (c + share * d))))
}

/// Weights in the middle of a step less those of the cubic through the ends with their slopes. Both
/// are of order 3, so the difference is of order 4; a fast decay that a long step skips makes it
/// large.
pub(super) fn inside() -> [f64; STAGES] {
    let mut difference = weights(0.5);
    difference.iter_mut().zip(B).for_each(|(weight, b)| *weight -= 0.5 * b);
    difference[0] -= 0.125;
    difference[STAGES - 1] += 0.125;
    difference
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The stages' weights with the diagonal.
    fn row(stage: usize) -> [f64; STAGES] {
        let mut row = [0.0; STAGES];
        row[..stage].copy_from_slice(A[stage]);
        row[stage] = if stage == 0 { 0.0 } else { GAMMA };
        row
    }

    fn sum(weights: &[f64; STAGES], of: impl Fn(usize) -> f64) -> f64 {
        (0..STAGES).map(|i| weights[i] * of(i)).sum()
    }

    #[track_caller]
    fn same(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
    }

    #[test]
    fn stages_have_order_two() {
        for (stage, c) in C.into_iter().enumerate() {
            same(sum(&row(stage), |_| 1.0), c);
            same(sum(&row(stage), |j| C[j]), c.powi(2) / 2.0);
        }
        row(5).into_iter().zip(B).for_each(|(last, step)| same(last, step));
    }

    /// With stages of order two the conditions of order 4 are five.
    #[test]
    fn every_part_of_a_step_has_order_four() {
        for k in 0..=10 {
            let share = f64::from(k) / 10.0;
            let w = weights(share);
            same(sum(&w, |_| 1.0), share);
            same(sum(&w, |i| C[i]), share.powi(2) / 2.0);
            same(sum(&w, |i| C[i].powi(2)), share.powi(3) / 3.0);
            same(sum(&w, |i| C[i].powi(3)), share.powi(4) / 4.0);
            same(sum(&w, |i| sum(&row(i), |j| C[j].powi(2))), share.powi(4) / 12.0);
        }
    }

    #[test]
    fn a_cubic_is_the_same_inside() {
        for power in 0..3 {
            same(sum(&inside(), |i| C[i].powi(power)), 0.0);
        }
    }

    #[test]
    fn the_error_vanishes_to_order_three() {
        for power in 0..3 {
            same(sum(&ERROR, |i| C[i].powi(power)), 0.0);
        }
        assert!(sum(&ERROR, |i| C[i].powi(3)).abs() > 1e-4);
    }
}
