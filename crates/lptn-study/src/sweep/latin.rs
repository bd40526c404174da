//! Latin hypercubes whose samples are computed one by one, in any order and without memory.

/// The place of sample `index` of `count` in a permutation: A. Kensler, Correlated Multi-Jittered
/// Sampling, Pixar Technical Memo 13-01 (2013), listing 2, whose steps are a bijection of a power
/// of two that is walked until it comes back below `count`.
fn permuted(index: u32, count: u32, seed: u32) -> u32 {
    let mut mask = count - 1;
    for shift in [1, 2, 4, 8, 16] {
        mask |= mask >> shift;
    }
    let mut i = index;
    loop {
        i ^= seed;
        i = i.wrapping_mul(0xe170_893d);
        i ^= seed >> 16;
        i ^= (i & mask) >> 4;
        i ^= seed >> 8;
        i = i.wrapping_mul(0x0929_eb3f);
        i ^= seed >> 23;
        i ^= (i & mask) >> 1;
        i = i.wrapping_mul(1 | (seed >> 27));
        i = i.wrapping_mul(0x6935_fa69);
        i ^= (i & mask) >> 11;
        i = i.wrapping_mul(0x74dc_b303);
        i ^= (i & mask) >> 2;
        i = i.wrapping_mul(0x9e50_1cc3);
        i ^= (i & mask) >> 2;
        i = i.wrapping_mul(0xc860_a3df);
        i &= mask;
        i ^= i >> 5;
        if i < count {
            return ((u64::from(i) + u64::from(seed)) % u64::from(count)) as u32;
        }
    }
}

/// Bits that look random (S. Vigna's variant 13 of D. Stafford's mixer, as in SplitMix64).
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// One coordinate of one sample, between 0 and 1: each of the `count` cells of an axis has one
/// sample, anywhere inside.
pub(super) fn sample(index: u64, count: u64, axis: usize, seed: u32) -> f64 {
    const DOUBLE: f64 = 1.0 / (1_u64 << 53) as f64;
    let of_axis = mixed((u64::from(seed) << 32) ^ axis as u64 ^ 0x9e37_79b9_7f4a_7c15);
    // there are never more than MOST_CASES
    let (small, all) =
        (u32::try_from(index).unwrap_or(0), u32::try_from(count).unwrap_or(u32::MAX));
    let cell = permuted(small, all, (of_axis >> 32) as u32);
    let within = (mixed(of_axis.wrapping_add(index.wrapping_mul(0x9e37_79b9_7f4a_7c15))) >> 11)
        as f64
        * DOUBLE;
    (f64::from(cell) + within) / count as f64
}

#[cfg(test)]
mod tests {
    use super::sample;

    /// The defining property of a Latin hypercube: each cell of each axis has one sample.
    #[test]
    fn every_cell_of_every_axis_holds_one_sample() {
        for count in [1, 2, 3, 7, 64, 100, 1000] {
            for axis in 0..6 {
                for seed in [0, 1, 4_294_967_295] {
                    let mut held = vec![0; count];
                    for index in 0..count {
                        let x = sample(index as u64, count as u64, axis, seed);
                        assert!((0.0..1.0).contains(&x), "{x}");
                        held[(x * count as f64) as usize] += 1;
                    }
                    assert!(held.iter().all(|&n| n == 1), "{count} {axis} {seed}");
                }
            }
        }
    }

    /// Two axes are no more alike than chance makes them: the correlation of 1000 independent
    /// pairs has a standard deviation of 0.032.
    #[test]
    fn axes_do_not_follow_each_other() {
        let at = |axis| (0..1000).map(move |i| sample(i, 1000, axis, 1) - 0.5);
        for other in 1..8 {
            let product: f64 =
                at(0).zip(at(other)).map(|(a, b)| a * b).sum::<f64>() / 1000.0 * 12.0;
            assert!(product.abs() < 0.13, "{other}: {product}");
        }
    }
}
