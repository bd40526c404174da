//! The numbers of a plate: made from a seed, or read.

/// W/(m^2 K^4).
const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Points of a power over time in s and W.
type Points = Vec<(f64, f64)>;

/// Vertices are cells, then what is given.
pub(crate) struct Plate {
    /// J/K.
    pub(crate) capacity: Vec<f64>,
    /// degC.
    pub(crate) start: Vec<f64>,
    /// degC.
    pub(crate) given: Vec<f64>,
    /// W/K.
    pub(crate) links: Vec<(usize, usize, f64)>,
    /// m^2.
    pub(crate) radiation: Vec<(usize, usize, f64)>,
    pub(crate) sources: Vec<(usize, Points)>,
    pub(crate) probes: Vec<usize>,
    /// s.
    pub(crate) rows: Vec<f64>,
    pub(crate) stop: f64,
}

impl Plate {
    /// `n` by `n` cells: capacities, conductances and areas are spread evenly over their decades,
    /// powers step, pulse or ramp at seven times that they share.
    pub(crate) fn make(n: usize) -> Self {
        let mut random = Random(20_240_517);
        let (cells, stop) = (n * n, 2.0 * (n * n) as f64);
        let mut links = Vec::new();
        for (i, k) in (0..cells).map(|k| (k / n, k)) {
            let neighbours = [(k % n + 1 < n).then_some(k + 1), (i + 1 < n).then_some(k + n)];
            links.extend(
                neighbours.into_iter().flatten().map(|to| (k, to, random.decades(0.1, 10.0))),
            );
        }
        for i in 0..n {
            let faces = [i, cells - n + i, i * n, i * n + n - 1];
            links.extend(faces.map(|k| (k, cells, random.decades(0.01, 0.1))));
        }
        let mut radiation: Vec<_> =
            (0..cells).map(|k| (k, cells, random.decades(1e-3, 1e-2))).collect();
        let far = (0..cells)
            .step_by(10)
            .map(|k| (k, (k + cells / 2) % cells, random.decades(1e-3, 5e-3)));
        radiation.extend(far);
        let sources: Vec<_> =
            (0..300).map(|k| (k * 1783 % cells, points(k, stop, &mut random))).collect();
        let mut probes: Vec<usize> =
            sources.iter().take(25).map(|s| s.0).chain((0..25).map(|k| k * 101)).collect();
        probes.sort_unstable();
        probes.dedup();
        Self {
            capacity: (0..cells).map(|_| random.decades(1.0, 100.0)).collect(),
            start: vec![25.0; cells],
            given: vec![25.0],
            links,
            radiation,
            sources,
            probes,
            rows: (1..=200).map(|k| f64::from(k) * stop / 200.0).collect(),
            stop,
        }
    }

    /// Reads the binary form: 12 numbers of 64 bits (the second to the tenth count the items),
    /// doubles, then indices of 32 bits.
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let mut rest = bytes;
        let counts = take(&mut rest, 12, |b| i64::from_le_bytes(b) as usize);
        let [_, n, links, radiation, given, sources, points, probes, rows, breaks, ..] = counts[..]
        else {
            return Self::make(0);
        };
        let mut doubles = |count| take(&mut rest, count, f64::from_le_bytes);
        let (stop, capacity, start, g, k) =
            (doubles(1)[0], doubles(n), doubles(n), doubles(links), doubles(radiation));
        let (given, t, p, rows) = (doubles(given), doubles(points), doubles(points), doubles(rows));
        doubles(breaks);
        let mut indices = |count| take(&mut rest, count, |b| i32::from_le_bytes(b) as usize);
        let joined = |from: Vec<usize>, to: Vec<usize>, values: Vec<f64>| {
            from.into_iter().zip(to).zip(values).map(|((i, j), value)| (i, j, value)).collect()
        };
        let links = joined(indices(links), indices(links), g);
        let areas = k.iter().map(|k| k / STEFAN_BOLTZMANN).collect();
        let radiation = joined(indices(radiation), indices(radiation), areas);
        let (cells, first) = (indices(sources), indices(sources + 1));
        let course = |i: usize| (first[i]..first[i + 1]).map(|k| (t[k], p[k])).collect::<Points>();
        let sources = cells.into_iter().enumerate().map(|(i, cell)| (cell, course(i))).collect();
        let probes = indices(probes);
        Self { capacity, start, given, links, radiation, sources, probes, rows, stop }
    }
}

/// Takes `count` values of `N` bytes each.
fn take<const N: usize, T>(
    bytes: &mut &[u8],
    count: usize,
    value: impl Fn([u8; N]) -> T,
) -> Vec<T> {
    let (head, rest) = bytes.split_at(count * N);
    *bytes = rest;
    head.as_chunks().0.iter().map(|chunk| value(*chunk)).collect()
}

/// A step, a train of pulses, or a ramp from point to point.
fn points(k: usize, stop: f64, random: &mut Random) -> Points {
    let times = [0.0, 4.0, 5.0, 10.0, 12.0, 13.0, 14.0, 15.0, 16.0].map(|t| t * stop / 16.0);
    let power = 60.0 * (0.1 + 0.9 * random.unit());
    match k % 3 {
        0 => {
            let t = times[1 + k / 3 % 7];
            vec![(0.0, 0.0), (t, 0.0), (t, power), (stop, power)]
        }
        1 => (0..8)
            .flat_map(|i| {
                let p = if i % 2 == 0 { power } else { 0.0 };
                [(times[i], p), (times[i + 1], p)]
            })
            .collect(),
        _ => times.map(|t| (t, 60.0 * random.unit())).to_vec(),
    }
}

/// A linear congruential generator (Knuth, MMIX).
struct Random(u64);

impl Random {
    /// Even over 0 to 1.
    fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Its logarithm even between those of `low` and `high`.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }
}
