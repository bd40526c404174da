//! The standard normal distribution.

/// The share of a normal distribution below `x` standard deviations over its mean.
pub fn share_below(x: f64) -> f64 {
    0.5 * libm::erfc(-x / std::f64::consts::SQRT_2)
}

/// The number of standard deviations below which the share `p` lies, from 1e-10 to 1 - 1e-10.
///
/// M. J. Wichura, Algorithm AS 241, Applied Statistics 37 (1988) 477, routine PPND16 without its
/// far tails (beyond 6.3 standard deviations): relative error about 1e-16.
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(&CENTRE, r);
    }
    let r = (-(if q < 0.0 { p } else { 1.0 - p }).ln()).sqrt();
    ratio(&TAIL, r - 1.6).copysign(q)
}

/// Coefficients of numerator and denominator by ascending powers.
type Ratio = [[f64; 8]; 2];

fn ratio([numerator, denominator]: &Ratio, r: f64) -> f64 {
    let polynomial = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, c| sum * r + c);
    polynomial(numerator) / polynomial(denominator)
}

const CENTRE: Ratio = [
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
];

const TAIL: Ratio = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];

#[cfg(test)]
mod tests {
    use super::super::NORMAL_95;
    use super::{quantile, share_below};

    /// `scipy.special.ndtri`, SciPy 1.17.1.
    const NDTRI: [(f64, f64); 7] = [
        (2.9802322387695312e-08, -5.419983174916869),
        (1e-06, -4.753424308822899),
        (0.001, -3.090232306167813),
        (0.025, -1.9599639845400545),
        (0.074, -1.4466320671589785),
        (0.076, -1.4325027208258116),
        (0.4, -0.2533471031357997),
    ];

    #[test]
    fn quantiles_are_those_of_scipy() {
        for (p, z) in NDTRI {
            assert!((quantile(p) - z).abs() <= 4e-16 * z.abs(), "{p}: {}", quantile(p));
            assert!((quantile(p) + quantile(1.0 - p)).abs() <= 1e-8 * z.abs(), "{p}");
            assert!((share_below(z) - p).abs() <= 1e-14 * p, "{p}: {}", share_below(z));
        }
        assert!(quantile(0.5).abs() < 1e-300);
        assert!((quantile(0.975) - NORMAL_95).abs() < 1e-15);
    }
}
