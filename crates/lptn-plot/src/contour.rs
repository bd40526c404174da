//! Lines of equal value of a field over a grid: each cell is cut into two triangles, in which the
//! field is linear.

use crate::ticks::round_step;

/// A field over a grid with these ascending coordinates.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// Coordinates to the right.
    pub x: Vec<f64>,
    /// Coordinates upwards.
    pub y: Vec<f64>,
    /// Values, those of the first y first; NaN if there is none.
    pub values: Vec<f64>,
}

/// Round values inside a range, at most `most`, at equal distances.
pub fn levels((low, high): (f64, f64), most: usize) -> Vec<f64> {
    let step = round_step((high - low) / most.max(1) as f64);
    if !(step.is_finite() && step > 0.0) {
        return Vec::new();
    }
    let first = (low / step + 1e-9).floor() + 1.0;
    let all = (0..=most).map(|i| (first + i as f64) * step);
    all.filter(|level| *level < high - 1e-9 * step).take(most).collect()
}

impl Lattice {
    fn corner(&self, (i, j): (usize, usize)) -> [f64; 3] {
        [self.x[i], self.y[j], self.values[j * self.x.len() + i]]
    }

    /// Points of the line of a level: pairs of points, with NaN between pairs.
    pub fn line(&self, level: f64) -> Vec<(f64, f64)> {
        let mut points = Vec::new();
        for j in 1..self.y.len() {
            for i in 1..self.x.len() {
                let [a, b] = [(i - 1, j - 1), (i, j)].map(|at| self.corner(at));
                for third in [(i, j - 1), (i - 1, j)] {
                    if let Some([from, to]) = crossing([a, b, self.corner(third)], level) {
                        points.extend([from, to, (f64::NAN, f64::NAN)]);
                    }
                }
            }
        }
        points.pop();
        points
    }
}

/// The two points at which the border of a triangle has this level.
fn crossing(triangle: [[f64; 3]; 3], level: f64) -> Option<[(f64, f64); 2]> {
    if triangle.iter().any(|corner| !corner[2].is_finite()) {
        return None;
    }
    let edge = |(from, to): (usize, usize)| {
        let ([x, y, a], [u, v, b]) = (triangle[from], triangle[to]);
        let part = (level - a) / (b - a);
        ((a < level) != (b < level)).then_some((x + part * (u - x), y + part * (v - y)))
    };
    let found: Vec<_> = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(edge).collect();
    match found[..] {
        [from, to] => Some([from, to]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Lattice, levels};

    #[test]
    fn levels_are_round_and_inside() {
        assert_eq!(levels((32.4, 48.8), 9), [34.0, 36.0, 38.0, 40.0, 42.0, 44.0, 46.0, 48.0]);
        assert_eq!(levels((20.0, 25.0), 5), [21.0, 22.0, 23.0, 24.0]);
        assert_eq!(levels((20.0, 20.0), 5).len() + levels((f64::NAN, 1.0), 5).len(), 0);
    }

    /// `x + 2 y` is linear, so its lines are straight on any grid.
    #[test]
    fn the_lines_of_a_plane_are_straight() {
        let (x, y) = (vec![0.0, 1.0, 3.0], vec![0.0, 2.0, 5.0]);
        let values = y.iter().flat_map(|y| x.iter().map(move |x| x + 2.0 * y)).collect();
        let line = Lattice { x, y, values }.line(4.5);
        let points: Vec<_> = line.into_iter().filter(|point| point.0.is_finite()).collect();
        assert!(points.iter().all(|(x, y)| (x + 2.0 * y - 4.5).abs() < 1e-12), "{points:?}");
        let ends =
            points.iter().fold((f64::INFINITY, 0.0_f64), |e, p| (e.0.min(p.0), e.1.max(p.0)));
        // from (0, 2.25) to (3, 0.75)
        assert_eq!(ends, (0.0, 3.0));
    }

    /// `x^2 + y^2` on a fine grid: the circle of radius 1, to the square of the cell.
    #[test]
    fn the_line_of_a_bowl_is_a_circle() {
        let axis: Vec<f64> = (-20..=20).map(|i| f64::from(i) * 0.1).collect();
        let values = axis.iter().flat_map(|y| axis.iter().map(move |x| x * x + y * y)).collect();
        let mut field = Lattice { x: axis.clone(), y: axis, values };
        let line = field.line(1.0);
        let near = |(x, y): &(f64, f64)| x.is_nan() || (x.hypot(*y) - 1.0).abs() < 0.005;
        assert!(line.len() > 100 && line.iter().all(near));
        field.values[20 * 41 + 30] = f64::NAN;
        assert!(field.line(1.0).len() < line.len());
    }
}
