//! Sign change of a function of one variable.

/// Most steps; bisection alone needs 52 to use up the digits of a number, Brent's method at most
/// the square of that.
const MOST_STEPS: usize = 3000;

/// A point and the value there.
pub(crate) type Point = (f64, f64);

/// Narrows a bracket between a point where `f` is not negative and one where it is, to neighbouring
/// numbers or to a share of their size, and gives them: the last one at which everything is kept,
/// and the first at which something is broken.
///
/// Brent's method: R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4:
/// inverse quadratic interpolation or the secant if they make progress, else bisection.
///
/// # Errors
/// The error of `f`.
pub(crate) fn last_kept<E>(
    kept: Point,
    broken: Point,
    (share, f): (f64, &mut dyn FnMut(f64) -> Result<f64, E>),
) -> Result<[Point; 2], E> {
    let mut bracket = Bracket::new(broken, kept, share);
    for _ in 0..MOST_STEPS {
        bracket.arrange();
        if bracket.is_closed() {
            break;
        }
        let x = bracket.next();
        bracket.advance((x, f(x)?));
    }
    Ok(bracket.ends())
}

/// `b` is the best point up to now, `a` the one before it, and `c` the last one of the other sign.
struct Bracket {
    a: Point,
    b: Point,
    c: Point,
    step: f64,
    step_before: f64,
    /// The share of a number that counts.
    share: f64,
}

fn same_side(a: Point, b: Point) -> bool {
    (a.1 >= 0.0) == (b.1 >= 0.0)
}

impl Bracket {
    fn new(a: Point, b: Point, share: f64) -> Self {
        let share = share.max(2.0 * f64::EPSILON);
        Self { a, b, c: a, step: b.0 - a.0, step_before: b.0 - a.0, share }
    }

    /// Keeps the sign change between `b` and `c`, and the smaller value at `b`.
    fn arrange(&mut self) {
        if same_side(self.b, self.c) {
            self.c = self.a;
            self.step = self.b.0 - self.a.0;
            self.step_before = self.step;
        }
        if self.c.1.abs() < self.b.1.abs() {
            self.a = self.b;
            self.b = self.c;
            self.c = self.a;
        }
    }

    /// The smallest step that counts for a number of this size.
    fn least(&self) -> f64 {
        (self.share * self.b.0.abs()).max(f64::MIN_POSITIVE)
    }

    fn is_closed(&self) -> bool {
        0.5 * (self.c.0 - self.b.0).abs() <= self.least() || self.b.1 == 0.0
    }

    fn next(&mut self) -> f64 {
        let half = 0.5 * (self.c.0 - self.b.0);
        let promising = self.step_before.abs() >= self.least() && self.a.1.abs() > self.b.1.abs();
        let (p, q) = if promising { self.interpolation(half) } else { (0.0, 0.0) };
        if promising
            && 2.0 * p
                < (3.0 * half * q - (self.least() * q).abs()).min((self.step_before * q).abs())
        {
            self.step_before = self.step;
            self.step = p / q;
        } else {
            self.step = half;
            self.step_before = half;
        }
        let least = self.least().copysign(half);
        self.b.0 + if self.step.abs() > self.least() { self.step } else { least }
    }

    /// The step to the zero of the curve through the known points, as `p / q` with `p` positive.
    fn interpolation(&self, half: f64) -> Point {
        let s = self.b.1 / self.a.1;
        let (p, q) = if self.a == self.c {
            (2.0 * half * s, 1.0 - s)
        } else {
            let (q, r) = (self.a.1 / self.c.1, self.b.1 / self.c.1);
            let p = s * (2.0 * half * q * (q - r) - (self.b.0 - self.a.0) * (r - 1.0));
            (p, (q - 1.0) * (r - 1.0) * (s - 1.0))
        };
        if p > 0.0 { (p, -q) } else { (-p, q) }
    }

    fn advance(&mut self, point: Point) {
        self.a = self.b;
        self.b = point;
    }

    /// The kept one and the broken one.
    fn ends(&self) -> [Point; 2] {
        if self.b.1 >= 0.0 { [self.b, self.c] } else { [self.c, self.b] }
    }
}

/// The zero nearest to the middle of `x = (a, m, b)` of the function `(u + v x) / (1 + w x)`
/// through three points, if it lies between the outer ones.
///
/// This is how a temperature depends on one conductance. Seen from its two ends the rest of a
/// linear network is a Norton equivalent, so the heat through the path is
/// `G dT_open / (1 + G R_open)`, and every temperature is a constant plus a multiple of this heat.
pub(crate) fn norton_guess([(x0, y0), (x1, y1), (x2, y2)]: [Point; 3]) -> Option<f64> {
    // y (1 + w x) = u + v x, with differences to the middle point so that u = y1 there
    let ((s0, d0), (s2, d2)) = ((x0 - x1, y0 - y1), (x2 - x1, y2 - y1));
    // v s - w s y = d  for both outer points
    let determinant = -s0 * s2 * y2 + s2 * s0 * y0;
    let (v, w) = ((-d0 * s2 * y2 + d2 * s0 * y0) / determinant, (s0 * d2 - s2 * d0) / determinant);
    let guess = if determinant == 0.0 || !(v.is_finite() && w.is_finite()) {
        x0 - y0 * (x2 - x0) / (y2 - y0)
    } else {
        x1 - y1 / v
    };
    (guess > x0.min(x2) && guess < x0.max(x2)).then_some(guess)
}

#[cfg(test)]
mod tests {
    use super::{last_kept, norton_guess};
    use std::convert::Infallible;

    fn root(f: impl Fn(f64) -> f64, kept: f64, broken: f64) -> (f64, usize) {
        let mut calls = 0;
        let mut counted = |x: f64| {
            calls += 1;
            Ok::<f64, Infallible>(f(x))
        };
        let ends = last_kept((kept, f(kept)), (broken, f(broken)), (0.0, &mut counted)).unwrap();
        let (x, y) = ends[0];
        assert!(y >= 0.0, "{x} is not kept: {y}");
        (x, calls)
    }

    #[test]
    fn known_roots_are_found_to_the_last_digits() {
        let (x, calls) = root(|x| x * x - 2.0, 2.0, 0.0);
        assert!(
            (x - std::f64::consts::SQRT_2).abs() <= 4.0 * f64::EPSILON && calls < 20,
            "{x} in {calls}"
        );
        let (x, _) = root(|x| x.cos() - x, 0.0, 1.0);
        // the Dottie number, OEIS A003957
        assert!((x - 0.739_085_133_215_160_6).abs() <= 4.0 * f64::EPSILON, "{x}");
    }

    #[test]
    fn a_kink_and_a_flat_root_cost_steps_but_not_the_answer() {
        let (x, calls) = root(|x| (x - 3.0).min(1e-3 * (x - 3.0)), 1e6, -1e6);
        assert!((x - 3.0).abs() < 1e-14 && calls < 200, "{x} in {calls}");
        let (x, calls) = root(|x| (x - 1.0).powi(9), 4.0, 0.0);
        assert!((x - 1.0).abs() < 1e-14 && calls < 500, "{x} in {calls}");
    }

    #[test]
    fn the_last_kept_point_touches_a_jump() {
        let (x, _) = root(|x| if x >= 0.3 { 1.0 } else { -1.0 }, 1.0, 0.0);
        assert!(x >= 0.3 && x - 0.3 <= 4.0 * f64::EPSILON, "{x}");
    }

    #[test]
    fn a_norton_equivalent_is_guessed_exactly() {
        // 20 + 50 / (1 + 2 x) = 30 at x = 2, seen as a margin
        let margin = |x: f64| 30.0 - (20.0 + 50.0 / (1.0 + 2.0 * x));
        let guess = norton_guess([0.5, 3.0, 7.0].map(|x| (x, margin(x)))).unwrap();
        assert!((guess - 2.0).abs() < 1e-14, "{guess}");
        // a straight line is the simplest of them
        let guess = norton_guess([1.0, 2.0, 4.0].map(|x| (x, 3.0 * x - 9.0))).unwrap();
        assert!((guess - 3.0).abs() < 1e-14, "{guess}");
        assert_eq!(norton_guess([1.0, 2.0, 4.0].map(|x| (x, x + 1.0))), None);
    }
}
