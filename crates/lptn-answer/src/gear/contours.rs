//! Lines of equal value of a field over a grid: each cell is cut into two triangles, in which the
//! field is linear.

/// A field over a grid with these ascending coordinates.
pub(super) struct GridField {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Values, those of the first y first; NaN if there is none.
    pub(super) values: Vec<f64>,
}

impl GridField {
    fn corner(&self, (i, j): (usize, usize)) -> [f64; 3] {
        [self.x[i], self.y[j], self.values[j * self.x.len() + i]]
    }

    /// Points of the line of a level: pairs of points, with NaN between pairs.
    pub(super) fn line(&self, level: f64) -> Vec<(f64, f64)> {
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
    use super::GridField;

    /// `x + 2 y` is linear, so its lines are straight on any grid.
    #[test]
    fn the_lines_of_a_plane_are_straight() {
        let (x, y) = (vec![0.0, 1.0, 3.0], vec![0.0, 2.0, 5.0]);
        let values = y.iter().flat_map(|y| x.iter().map(move |x| x + 2.0 * y)).collect();
        let line = GridField { x, y, values }.line(4.5);
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
        let mut field = GridField { x: axis.clone(), y: axis, values };
        let line = field.line(1.0);
        let near = |(x, y): &(f64, f64)| x.is_nan() || (x.hypot(*y) - 1.0).abs() < 0.005;
        assert!(line.len() > 100 && line.iter().all(near));
        field.values[20 * 41 + 30] = f64::NAN;
        assert!(field.line(1.0).len() < line.len());
    }
}
