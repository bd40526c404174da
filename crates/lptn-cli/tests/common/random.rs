//! Random numbers for networks.
#![allow(dead_code, unreachable_pub, reason = "each test file uses a part of it")]

/// SplitMix64 (S. Vigna, public domain): the same networks everywhere.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// A number between two others.
pub fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * (random.next() as f64 / u64::MAX as f64)
}
