//! Powers of one number, like the flow, pressure and power of a fan or a pump over its speed.

use crate::taylor::Taylor;

/// A function of one number from 0 on: `y = y0 (x / x0)^k` with a whole power k of 1 or more.
#[derive(Clone, PartialEq, Debug)]
pub struct PowerLaw {
    point: [f64; 2],
    power: u8,
    range: [f64; 2],
}

impl PowerLaw {
    /// The one through a point `[x0, y0]`, for `x` from 0 to `last`; `None` unless `x0 > 0`,
    /// `y0 >= 0`, `power >= 1` and `last > 0`, all of them finite.
    pub fn through(point: [f64; 2], power: u8, last: f64) -> Option<Self> {
        let [x, y] = point;
        let finite = x.is_finite() && y.is_finite() && last.is_finite();
        let meant = finite && x > 0.0 && y >= 0.0 && power >= 1 && last > 0.0;
        meant.then_some(Self { point, power, range: [0.0, last] })
    }

    /// The point that it goes through.
    pub fn point(&self) -> [f64; 2] {
        self.point
    }

    /// The range of its argument.
    pub fn range(&self) -> &[f64] {
        &self.range
    }

    /// Its value and slope; `None` outside its range.
    pub fn value_and_slope(&self, x: f64) -> Option<(f64, f64)> {
        let [first, last] = self.range;
        let ([x0, y0], power) = (self.point, i32::from(self.power));
        let ratio = (first..=last).contains(&x).then_some(x / x0)?;
        Some((y0 * ratio.powi(power), y0 / x0 * f64::from(power) * ratio.powi(power - 1)))
    }

    /// Bounds on its value for an argument with known bounds.
    pub(crate) fn enclose(&self, x: Taylor) -> Taylor {
        let ([first, last], [x0, y0]) = (self.range, self.point);
        match x.range() {
            Some([from, to]) if first <= from && to <= last => {
                let ratio = x * Taylor::constant(1.0 / x0);
                Taylor::constant(y0) * ratio.power(f64::from(self.power))
            }
            _ => Taylor::unknown(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PowerLaw;
    use crate::taylor::Taylor;

    #[test]
    fn it_follows_its_power_up_to_its_end() {
        for power in 1..=3_u8 {
            let law = PowerLaw::through([150.0, 8.0], power, 300.0).expect("a law");
            assert_eq!(law.value_and_slope(150.0).map(|(y, _)| y), Some(8.0));
            let half = 8.0 * 0.5f64.powi(i32::from(power));
            assert_eq!(law.value_and_slope(75.0), Some((half, half * f64::from(power) / 75.0)));
            assert_eq!(law.value_and_slope(0.0).map(|(y, _)| y), Some(0.0));
            assert_eq!(law.value_and_slope(300.1), None);
            assert_eq!(law.value_and_slope(-0.1), None);
            let bounds = law.enclose(Taylor::variable(70.0, 80.0)).range().expect("bounds");
            assert!(bounds[0] <= half && half <= bounds[1]);
            assert_eq!(law.enclose(Taylor::variable(290.0, 310.0)).range(), None);
        }
    }

    #[test]
    fn what_is_none_is_refused() {
        let of = |point, last| PowerLaw::through(point, 2, last);
        assert!(of([0.0, 1.0], 1.0).is_none() && of([1.0, -1.0], 1.0).is_none());
        assert!(of([1.0, 1.0], 0.0).is_none() && of([f64::NAN, 1.0], 1.0).is_none());
        assert!(PowerLaw::through([1.0, 1.0], 0, 1.0).is_none());
    }
}
