//! Analytic: what the laws do at equal temperatures, at reversal, at zero flow, in their limits;
//! conservation of streams.

use std::f64::consts::PI;

use lptn_laws::{
    STEFAN_BOLTZMANN, advection_from, advection_to, cylinder, effective_emissivity_parallel_plates,
    radiation_conductance, slab, sphere, stream_from, stream_to,
};
use lptn_units::Dual;

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    let error = (found - expected).abs();
    assert!(error <= relative * expected.abs(), "{found}, expected {expected}");
}

fn ends(t_from: f64, t_to: f64) -> [Dual<2>; 2] {
    [Dual::variable(t_from, 0), Dual::variable(t_to, 1)]
}

/// CODATA: 2 pi^5 k^4 / (15 h^3 c^2) with the exact k, h and c of the SI.
#[test]
fn the_constant_follows_from_the_si() {
    let (k, h, c) = (1.380649e-23_f64, 6.62607015e-34_f64, 299_792_458.0_f64);
    near(STEFAN_BOLTZMANN, 2.0 * PI.powi(5) * k.powi(4) / (15.0 * h.powi(3) * c.powi(2)), 4e-11);
}

/// (T + d)^4 - T^4 = 4 T^3 d + 6 T^2 d^2 + 4 T d^3 + d^4, with a d that T + d holds exactly.
#[test]
fn radiation_does_not_cancel() {
    let (t, d) = (300.0_f64, 2f64.powi(-30));
    let heat = radiation_conductance(0.5, t + d, t) * (t + d - t);
    let powers =
        4.0 * t.powi(3) * d + 6.0 * t.powi(2) * d.powi(2) + 4.0 * t * d.powi(3) + d.powi(4);
    near(heat, STEFAN_BOLTZMANN * 0.5 * powers, 1e-15);
}

#[test]
fn radiation_at_equal_and_reversed_temperatures() {
    for (t_from, t_to) in
        [(300.0, 300.0), (300.0, 450.0), (450.0, 300.0), (0.0, 300.0), (300.0, 0.0)]
    {
        let [a, b] = ends(t_from, t_to);
        let heat = radiation_conductance(Dual::constant(0.5), a, b) * (a - b);
        let sigma = STEFAN_BOLTZMANN * 0.5;
        near(heat.value, sigma * (t_from.powi(4) - t_to.powi(4)), 1e-14);
        near(heat.derivatives[0], 4.0 * sigma * t_from.powi(3), 1e-14);
        near(heat.derivatives[1], -4.0 * sigma * t_to.powi(3), 1e-14);
        let back = radiation_conductance(0.5, t_to, t_from) * (t_to - t_from);
        assert_eq!(
            back.to_bits(),
            (-heat.value + 0.0).to_bits(),
            "what one end gives the other takes"
        );
    }
}

/// Both ends together take mcp (T_from - T_to) whatever the sign, and so do the derivatives, at
/// zero flow too.
#[test]
fn both_ends_of_a_stream_have_one_smooth_sum() {
    for mcp in [20.0, 1e-300, 0.0, -0.0, -1e-300, -20.0] {
        let flow = Dual::<3>::variable(mcp, 0);
        let (a, b) = (Dual::variable(350.0, 1), Dual::variable(300.0, 2));
        let found = advection_to(flow, a, b) + advection_from(flow, a, b);
        assert_eq!(
            (found.value, found.derivatives),
            (mcp * 50.0, [50.0, mcp, -mcp]),
            "mcp = {mcp}"
        );
    }
}

#[test]
fn only_the_end_a_stream_enters_receives() {
    assert_eq!(
        (advection_to(20.0, 350.0, 300.0), advection_from(20.0, 350.0, 300.0)),
        (1000.0, 0.0)
    );
    assert_eq!(
        (advection_to(-20.0, 350.0, 300.0), advection_from(-20.0, 350.0, 300.0)),
        (0.0, -1000.0)
    );
    assert_eq!((stream_to(0.5, 3e5, 1e5), stream_from(0.5, 3e5, 1e5)), (1e5, 0.0));
    assert_eq!((stream_to(-0.5, 3e5, 1e5), stream_from(-0.5, 3e5, 1e5)), (0.0, -1e5));
}

/// Conservation: around a loop a stream takes up nothing, in either direction, and not where cp
/// varies.
#[test]
fn a_closed_loop_neither_gains_nor_loses() {
    let heats = [4.1e5, 1.3e5, 2.75e5, 0.5e5, 3.3e5];
    for flow in [0.25, 0.0, -0.25] {
        let next = heats.iter().cycle().skip(1);
        let links = heats.iter().zip(next);
        let sum: f64 = links.map(|(&a, &b)| stream_to(flow, a, b) + stream_from(flow, a, b)).sum();
        assert!(sum.abs() <= 1e-10, "{sum} W are left over");
    }
}

#[test]
fn plates_in_their_limits() {
    near(
        effective_emissivity_parallel_plates(0.3, 0.6),
        1.0 / (1.0 / 0.3 + 1.0 / 0.6 - 1.0),
        1e-15,
    );
    near(effective_emissivity_parallel_plates(0.0, 0.6), 0.0, 0.0);
    near(effective_emissivity_parallel_plates(1.0, 1.0), 1.0, 0.0);
}

/// A shell of thickness d at radius r is a slab of its middle surface, to order (d/r)^2.
#[test]
fn thin_shells_are_slabs() {
    let (k, r, d) = (50.0, 0.1, 1e-5);
    near(cylinder(k, r, r + d, 2.0), slab(k, 2.0 * PI * (r + d / 2.0) * 2.0, d), 1e-8);
    near(sphere(k, r, r + d), slab(k, 4.0 * PI * r * (r + d), d), 1e-10);
}
