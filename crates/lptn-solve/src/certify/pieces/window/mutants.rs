//! A bound that takes no notice of the interval of a switch has to be noticed.

use lptn_assembly::ThermalSystem;
use lptn_netlist::parse;

use super::*;
use crate::certify::rows::Rows;

const AIR: f64 = 300.0;
/// The way begins this much in K above the exact solution.
const OFF: f64 = 1e-4;
/// In K over air: the temperature that a heated body approaches, its start, and the threshold.
const END: f64 = 13.0;
const START: f64 = 6.0;
const LEAVES: f64 = 10.0;
const TAU: f64 = 10.0;

/// The time of the switch in s for a start that is `off` K warmer, and the temperature in K.
fn body(off: f64) -> (f64, impl Fn(f64) -> f64) {
    let at = TAU * ((END - START - off) / (END - LEAVES)).ln();
    let heated = move |time: f64| END + (START + off - END) * (-time / TAU).exp();
    let all = move |time: f64| match time < at {
        true => AIR + heated(time),
        false => AIR + LEAVES * ((at - time) / TAU).exp(),
    };
    (at, all)
}

/// The share of bound over error after the switch.
fn share(ignores: bool) -> f64 {
    let text = "format = 1\n[boundary]\nair = { T = \"300 K\" }\n\
        [node]\nbody = { C = \"10 J/K\", T0 = \"306 K\" }\n\
        [resistor]\nskin = { from = \"body\", to = \"air\", G = \"1 W/K\" }\n[control]\n\
        heater = { sense = \"body\", on_below = \"303 K\", off_above = \"310 K\", start = \"on\" }\n\
        [source]\nq = { into = \"body\", P = \"13 [W] * heater\" }\n";
    let network = parse("net.toml", text).unwrap_or_else(|e| panic!("{e}")).network;
    let system = ThermalSystem::assemble(&network).unwrap_or_else(|e| panic!("{e}"));
    let ((at, of_way), (_, right)) = (body(OFF), body(0.0));
    let rows = Rows::new(&system, &[], &[]);
    let pieces = Pieces::new(&system, (rows, None, &[of_way(0.0)]), (0.0, 1e-2));
    let mut pieces = pieces.unwrap_or_else(|reason| panic!("{reason}"));
    pieces.bound.set(vec![OFF]);
    let until = at + 2.0;
    let step = |pieces: &mut Pieces<'_>, (from, to): (f64, f64)| {
        let on = from < at;
        let controls = [ControlState { on, since: if on { f64::NEG_INFINITY } else { at } }];
        let state_at = &mut |time: f64, y: &mut [f64]| {
            // the state at the end of a step is that before the switch
            y[0] = of_way(time);
            Ok(())
        };
        let taken = pieces.step(((from, to), 1.0), &controls, state_at);
        taken.unwrap_or_else(|reason| panic!("{reason}"));
    };
    (0..8).for_each(|k| step(&mut pieces, (at * f64::from(k) / 8.0, at * f64::from(k + 1) / 8.0)));
    if ignores {
        let last = pieces.course.span().unwrap_or_else(|| panic!("no last piece"));
        let line = pieces.over(last).unwrap_or_else(|reason| panic!("{reason}"));
        pieces.bound.go(&line);
        pieces.arrive();
        pieces.course.forget_before(at);
        let mut off = pieces.switches.gates.positions.clone();
        off.controls[0] = false;
        pieces.set_positions(&off);
        let span = (at, until);
        let line = pieces.over(span).unwrap_or_else(|reason| panic!("{reason}"));
        pieces.bound.go(&line);
    } else {
        let parts = (0..4).map(|k| (at + 0.5 * f64::from(k), at + 0.5 * f64::from(k + 1)));
        parts.for_each(|span| step(&mut pieces, span));
        pieces.close_window().unwrap_or_else(|reason| panic!("{reason}"));
        pieces.flush().unwrap_or_else(|reason| panic!("{reason}"));
        let [[from, to]] = pieces.switches.found[..] else { panic!("one switch") };
        assert!(from <= body(0.0).0 && body(0.0).0 <= to, "{from} {to}");
    }
    pieces.bound.now()[0] / (right(until) - of_way(until)).abs()
}

/// The temperature rises by 0.3 K/s before the switch and falls by 1 K/s after it, so that the error
/// more than triples.
#[test]
fn an_interval_that_is_ignored_is_noticed() {
    let right = share(false);
    assert!((1.0..1.3).contains(&right), "{right}");
    let ignores = share(true);
    assert!(ignores < 0.5, "it is not noticed: {ignores}");
}
