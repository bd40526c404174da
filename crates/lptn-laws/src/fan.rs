//! Fans and pumps at a system: their duty point.
//!
//! A fan follows three powers of its speed. At a system of r Q^2 the curve shrinks along that
//! parabola. The duty point at one speed is therefore sufficient, and the expansion writes it.

/// Flow and pressure of a fan or pump at its duty point: its curve intersects that of the system, p
/// = r Q^2.
///
/// * `curve`: points of flow in m^3/s, at least 0 and rising, and pressure in Pa, not rising, with
///   straight lines between them
/// * `resistance`: r of the system in Pa/(m^3/s)^2, above 0
///
/// `None` if they do not intersect between the ends of the curve. There is at most one, since one
/// falls and the other rises; on a line p = a - b Q it is Q = 2 a / (b + sqrt(b^2 + 4 r a)). At
/// another speed n both flows change as n and both pressures as n^2, so that they meet at Q n/n0
/// and p (n/n0)^2, and the power is P (n/n0)^3 (affinity laws, for a system of this form exact).
/// Source: F. M. White, Fluid Mechanics, 7th edition, sections 11.3 and 11.5.
///
/// ```
/// let curve = [[0.0, 100.0], [0.1, 100.0], [0.2, 0.0]];
/// // on the second line, 200 - 1000 Q: 5000 Q^2 + 1000 Q - 200 = 0
/// let [flow, pressure] = lptn_laws::fan_duty(&curve, 5000.0).unwrap();
/// assert!((flow - (1e6_f64 + 4e6).sqrt() / 1e4 + 0.1).abs() < 1e-15);
/// assert!((pressure - (200.0 - 1000.0 * flow)).abs() < 1e-12);
/// ```
pub fn fan_duty(curve: &[[f64; 2]], resistance: f64) -> Option<[f64; 2]> {
    let spare = |[flow, pressure]: [f64; 2]| pressure - resistance * flow * flow;
    curve.windows(2).find_map(|ends| {
        let [start, end] = [ends[0], ends[1]];
        if spare(start) < 0.0 || spare(end) > 0.0 {
            return None;
        }
        let fall = (start[1] - end[1]) / (end[0] - start[0]);
        let at_rest = start[1] + fall * start[0];
        let root = (fall * fall + 4.0 * resistance * at_rest).sqrt();
        let flow = if at_rest > 0.0 { 2.0 * at_rest / (fall + root) } else { 0.0 };
        Some([flow, resistance * flow * flow])
    })
}
