//! Inputs and results that do something between steps, and runs far from 0: against closed forms
//! written out here.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use std::f64::consts::PI;

use lptn::prelude::*;
use lptn_solve::{Selection, Solution, Window};

fn system(text: &str) -> ThermalSystem {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

fn solved(text: &str, transient: &Transient) -> Solution {
    transient.solve(&system(text)).unwrap_or_else(|e| panic!("{e}"))
}

fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{found} is not {exact} within {within:e}");
}

/// One body of 100 J/K at 30 degC beside a room of 20 degC, and what is added to it.
fn body(rest: &str) -> String {
    format!(
        "format = 1\n[node]\na = {{ C = \"100 J/K\", T0 = \"30 degC\" }}\n[boundary]\nroom = {{ T \
         = \"20 degC\" }}\n{rest}"
    )
}

/// A pulse of 1 around 5123.4 s with a standard deviation of 21.2 s: a two-hundredth of the run.
/// Its integral is 21.2 s times the root of 2 pi.
const PULSE: &str = "exp(-0.5 * ((t - 5123.4 [s]) / (21.2 [s]))^2)";
const AREA: f64 = 21.2 * 2.506_628_274_631_000_7;

/// The rise over the room after the pulse; nothing else happens.
fn rise_after(rest: &str) -> f64 {
    let solution = solved(&body(rest), &Transient::until(Time(1e4)).every(Time(500.0)));
    close(solution.row(9)[0] - 293.15, 10.0, 1e-9); // quiet until then
    solution.row(20)[0] - 293.15
}

/// A pulse in one expression with a temperature was jumped over whole, books closed. With a rise r
/// over the room and C = 100 J/K: where the pulse p gives `C r' = k p r`, r grows by the factor
/// exp(k int p dt / C); with `C r' = -k p r^2` 1/r grows by k int p dt / C.
#[test]
fn a_pulse_beside_a_temperature_is_not_jumped_over() {
    let source = |text: &str| format!("[source]\ns = {{ into = \"a\", P = \"{text}\" }}\n");
    let grown = 10.0 * (0.5 * AREA / 100.0).exp();
    for text in [
        format!("0.5 [W/K] * {PULSE} * (T - 20 [degC])"),
        format!("(T - 20 [degC]) * 0.5 [W/K] * {PULSE}"),
        format!("(a.T - room.T) * {PULSE} / (2 [K/W])"),
        format!("if(T > 0 [degC], 0.5 [W/K] * {PULSE} * (T - 20 [degC]), 0 [W])"),
        format!("0.5 [W/K] * (T - 20 [degC]) - 0.5 [W/K] * (T - 20 [degC]) * (1 - {PULSE})"),
        format!("max(0.5 [W/K] * {PULSE} * (T - 20 [degC]), -1 [W/K] * (T - 20 [degC]))"),
    ] {
        close(rise_after(&source(&text)), grown, 1e-4);
    }
    let fallen = 1.0 / (0.1 + 0.05 * AREA / 100.0);
    for text in [
        format!(
            "[resistor]\\nr = {{ from = \"a\", to = \"room\", G = \"0.05 [W/K^2] * dT * {PULSE}\" \
             }}"
        ),
        format!(
            "[convection]\\nr = {{ from = \"a\", to = \"room\", h = \"{PULSE} * film(dT)\", area \
             = \"1 m^2\" }}\\n\
                 [table]\\nfilm = {{ x = [\"0 K\", \"100 K\"], y = [\"0 W/(m^2 K)\", \"5 W/(m^2 \
                 K)\"] }}"
        ),
    ] {
        close(rise_after(&text.replace("\\n", "\n")), fallen, 1e-4);
    }
}

/// Time and temperature inside one function: `C r' = k p r` once more, the pulse written as exp(-(x -
/// y)^2) whose y holds a temperature that stands still.
#[test]
fn a_pulse_whose_place_depends_on_a_temperature_is_not_jumped_over() {
    let text = "[source]\ns = { into = \"a\", P = \"0.5 [W/K] * (T - 20 [degC]) * exp(-0.5 * ((t - \
        3123.4 [s] \
                - (room.T - 10 [degC]) * 200 [s/K]) / (21.2 [s]))^2)\" }\n";
    close(rise_after(text), 10.0 * (0.5 * AREA / 100.0).exp(), 1e-4);
}

/// A pulse of a table of two arguments, one of them the time: a triangle of 60 s and height 1,
/// times r / (10 K).
#[test]
fn a_peak_of_a_table_of_time_and_temperature_is_met() {
    let folder = std::env::temp_dir().join("lptn-table-of-time");
    std::fs::create_dir_all(&folder).unwrap();
    let rows = "time [s],rise [K],heat \
        [W]\n0,0,0\n5000,0,0\n5030,0,0\n5060,0,0\n10000,0,0\n0,100,0\n5000,100,0\n\
                5030,100,50\n5060,100,0\n10000,100,0\n";
    std::fs::write(folder.join("map.csv"), rows).unwrap();
    let text = body(
        "[table]\nmap = { csv = \"map.csv\", x = \"time\", y = \"rise\", value = \"heat\" }\n\
                     [source]\ns = { into = \"a\", P = \"map(t, T - 20 [degC])\" }\n",
    );
    std::fs::write(folder.join("net.toml"), text).unwrap();
    let path = folder.join("net.toml");
    let netlist = lptn_netlist::read(&path).unwrap_or_else(|e| panic!("{e}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let solution = Transient::until(Time(1e4)).every(Time(500.0)).solve(&system).unwrap();
    // 0.5 W/K at the tip, so 0.5 W/K times 30 s
    close(solution.row(20)[0] - 293.15, 10.0 * (0.5_f64 * 30.0 / 100.0).exp(), 1e-4);
}

/// A threshold that dips under the temperature of a quiet network for 1/140 of the run: 80 - 70 p <
/// 30 where p > 5/7.
#[test]
fn a_pulse_of_a_threshold_switches() {
    let text = body(&format!(
        "[control]\nfan = {{ sense = \"a\", on_above = \"80 [degC] - 70 [K] * {PULSE} + 0 * (a.T - \
         room.T)\", \
         off_below = \"79 [degC] - 70 [K] * {PULSE}\" }}\n\
         [resistor]\nr = {{ from = \"a\", to = \"room\", G = \"1e-12 [W/K] * fan\" }}\n"
    ));
    let solution = solved(&text, &Transient::until(Time(1e4)).every(Time(500.0)));
    let [on, off] = solution.events() else { panic!("{:?}", solution.events()) };
    let width = |p: f64| 21.2 * (-2.0 * p.ln()).sqrt();
    close(on.time, 5123.4 - width(5.0 / 7.0), 1e-3);
    close(off.time, 5123.4 + width(4.9 / 7.0), 1e-3);
}

/// 200 W on top of a half sine of `base` W in one expression, for pulses from 1/28 to 1/4500 of the
/// run (full width at half height), onto 1000 J/K with 1 W/K. Long after its middle m a pulse of sd
/// s and height A is worth `A s (2 pi)^(1/2) / C exp(s^2 / (2 tau^2) - (t - m) / tau)`.
#[test]
fn a_pulse_on_a_large_slow_input_is_not_jumped_over() {
    let (stop, tau, middle) = (1e4, 1e3, 5123.4);
    for base in [0.0, 1e3, 1e5] {
        for part in [28.0, 200.0, 2000.0, 3000.0, 4500.0] {
            let sd = stop / part / 2.354_820_045_030_949;
            let text = format!(
                "format = 1\n[node]\na = {{ C = \"1000 J/K\", T0 = \"20 degC\" \
                 }}\n[boundary]\nroom = {{ T = \"20 degC\" }}\n\
                 [resistor]\nr = {{ from = \"a\", to = \"room\", R = \"1 K/W\" }}\n[source]\ns = \
                 {{ into = \"a\", P = \"{base} [W] \
                 * sin(pi * t / (10000 [s])) + 200 [W] * exp(-0.5 * ((t - {middle} [s]) / ({sd} \
                 [s]))^2)\" }}\n"
            );
            let solution = solved(&text, &Transient::until(Time(stop)).every(Time(500.0)));
            let exact = |t: f64| {
                let w = PI / stop;
                let slow = (w * t).sin() / tau - w * (w * t).cos() + w * (-t / tau).exp();
                let after = (sd * sd / (2.0 * tau * tau) - (t - middle) / tau).exp();
                let pulse = 200.0 * sd * (2.0 * PI).sqrt() / 1000.0 * after;
                base / 1000.0 * slow / (1.0 / (tau * tau) + w * w)
                    + if t > 6400.0 { pulse } else { 0.0 }
            };
            let error = (13..=20)
                .map(|row| (solution.row(row)[0] - 293.15 - exact(500.0 * row as f64)).abs());
            let error = error.fold(0.0, f64::max);
            let steps = solution.statistics().steps;
            println!("base {base} W, 1/{part} of the run: error {error:.1e} K in {steps} steps");
            assert!(error <= 1e-4, "base {base} W, 1/{part} of the run: {error} K");
            assert!(steps < 1500, "{steps} steps");
        }
    }
}

/// A table whose knot is where a signal stands still was followed in steps of a 38400th of the run:
/// 38415 in place of 345.
#[test]
fn a_signal_that_rests_on_a_knot_costs_no_steps() {
    let steps = |speed: u32| {
        let text = format!(
            "format = 1\n[signal]\nspeed = {{ t = [0, 25, 45, 80], v = [0, {speed}, {speed}, 0], \
             t_unit = \"s\", v_unit = \
             \"rpm\", interp = \"pchip\" }}\n[table]\nfilm = {{ x = [0, 500, 1500], y = [4, 20, \
             44], x_unit = \"rpm\", y_unit = \
             \"W/(m^2 K)\", outside = \"hold\" }}\n[boundary]\nroom = {{ T = \"22 degC\" \
             }}\n[node]\ncase = {{ C = \"3 kJ/K\", \
             T0 = \"60 degC\" }}\n[convection]\nwindage = {{ from = \"case\", to = \"room\", h \
             = \"film(speed)\", area = \
             \"0.35 m^2\" }}\n"
        );
        solved(&text, &Transient::until(Time(80.0))).statistics().steps
    };
    let (flat, control) = (steps(1500), steps(1400));
    println!("{flat} steps where the knot is met, {control} where it is not");
    assert!(flat <= 2 * control, "{flat} steps, {control} without the knot");
}

/// A body that stays at 30 degC, with inputs that only results know of.
fn quiet(rest: &str) -> String {
    format!(
        "format = 1\n[node]\na = {{ C = \"100 J/K\", T0 = \"30 degC\" }}\n[boundary]\nb = {{ T \
         = \"20 degC\" }}\n[resistor]\n\
         r = {{ from = \"a\", to = \"b\", R = \"1 K/W\" }}\n[source]\ns = {{ into = \"a\", P \
         = \"10 W\" }}\n{rest}"
    )
}

/// What a limit alone reads was read once, in the middle of the run.
#[test]
fn limits_follow_what_only_they_read() {
    let text = quiet(
        "[signal]\nallowed = { t = [\"0 s\", \"700 s\", \"800 s\"], v = [\"60 degC\", \"25 \
         degC\", \"60 degC\"], interp = \
         \"previous\", after_end = \"hold\" }\nteeth = { t = [\"0 s\", \"10 s\"], v = [\"0 \
         K\", \"10 K\"], after_end = \
         \"repeat\" }\n[limit]\nstep = { of = \"a.T - allowed\", below = \"0 K\" }\n\
         compared = { of = \"a.T - if(t < 600 [s], 60 [degC], 25 [degC])\", below = \"0 K\" }\n\
         kink = { of = \"a.T - abs(t - 612 [s]) * 1 [K/s]\", below = \"29 degC\" }\n\
         saw = { of = \"a.T + teeth\", below = \"38 degC\" }\n\
         pulse = { of = \"a.T + 9 [K] * exp(-0.5 * ((t - 333.3 [s]) / (1 [s]))^2)\", below = \"38 \
         degC\" }\n\
         kept = { of = \"a.T + 9 [K] * exp(-0.5 * ((t - 333.3 [s]) / (1 [s]))^2)\", below = \"40 \
         degC\" }\n",
    );
    for run in
        [Transient::until(Time(1000.0)).at(&[]), Transient::until(Time(1000.0)).every(Time(1.0))]
    {
        let solution = solved(&text, &run);
        let [step, compared, kink, saw, pulse, kept] = solution.limits() else {
            panic!("six limits")
        };
        let is = |limit: &lptn_solve::LimitSeen, margin: f64, worst: f64, broken: f64| {
            close(limit.margin, margin, 1e-6);
            close(limit.worst_at, worst, 1e-3);
            close(limit.broken_at.unwrap(), broken, 1e-6);
        };
        is(step, -5.0, 700.0, 700.0);
        is(compared, -5.0, 1000.0, 600.0); // it lasts until the end
        is(kink, -1.0, 612.0, 611.0);
        close(saw.margin, -2.0, 1e-6);
        close(saw.broken_at.unwrap(), 8.0, 1e-6);
        is(pulse, -1.0, 333.3, 333.3 - (2.0 * (9.0_f64 / 8.0).ln()).sqrt());
        assert_eq!(kept.broken_at, None);
        close(kept.margin, 1.0, 1e-6);
    }
}

/// Reports and signals that the heat flows do not read had one value for the whole run, or none.
#[test]
fn reports_and_signals_of_their_own_follow_the_time() {
    let text = quiet(
        "[signal]\nsaw = { t = [\"0 s\", \"100 s\"], v = [\"0 K\", \"10 K\"], after_end \
         = \"repeat\" }\n\
         pulse = { t = [\"0 s\", \"50 s\"], v = [\"0 K\", \"10 K\"], interp = \"previous\", \
         after_end = \"repeat\", period = \
         \"100 s\" }\n[run]\nstop = \"1000 s\"\nreport = { two = \"if(t < 600 [s], 1, 2)\", saw2 \
         = \"saw\", left = \
         \"a.T + pulse\", kink = \"abs(t - 500 [s])\" }\n",
    );
    let solution = solved(&text, &Transient::until(Time(1000.0)).every(Time(75.0)));
    let network = solution.network();
    let signals: Vec<Vec<f64>> = network.signal_ids().map(|id| solution.signal(id)).collect();
    let reports: Vec<Vec<f64>> = network.report_ids().map(|id| solution.report(id)).collect();
    for (row, &t) in solution.times().iter().enumerate() {
        let last = row + 1 == solution.times().len();
        // a row is after the jump, the last one before it
        let phase = if last { 100.0 } else { t % 100.0 };
        let (saw, pulse) = (phase / 10.0, if phase < 50.0 { 0.0 } else { 10.0 });
        close(signals[0][row], saw, 1e-9);
        close(signals[1][row], pulse, 1e-9);
        let exact = [if t < 600.0 { 1.0 } else { 2.0 }, saw, 303.15 + pulse, (t - 500.0).abs()];
        reports.iter().zip(exact).for_each(|(report, exact)| close(report[row], exact, 1e-9));
    }
}

/// So did means and extremes over windows, whose ends need not be where anything happens.
#[test]
fn windows_follow_what_only_they_read() {
    let text = quiet(
        "[signal]\nallowed = { t = [\"0 s\", \"600 s\"], v = [\"60 degC\", \"25 degC\"], interp \
         = \"previous\", after_end = \
         \"hold\" }\n[run]\nstop = \"1000 s\"\nreport = { two = \"if(t < 700 [s], 1, 2)\", bump \
         = \"100 * exp(-0.5 * ((t - \
         650 [s]) / (0.5 [s]))^2)\" }\n",
    );
    let system = system(&text);
    let of =
        Selection::matching(system.network(), &["allowed".into(), "two".into(), "bump".into()])
            .unwrap();
    let window = Window { name: "late".into(), from: 550.0, to: 950.0, of };
    let solution = Transient::until(Time(1000.0)).at(&[]).window(window).solve(&system).unwrap();
    let [allowed, two, bump] = &solution.windows()[0].columns[..] else { panic!("three columns") };
    close(allowed.mean, 298.15 + 35.0 * 50.0 / 400.0, 1e-9);
    close(allowed.max.0, 333.15, 1e-9);
    close(allowed.min.0, 298.15, 1e-9);
    close(two.mean, (150.0 + 2.0 * 250.0) / 400.0, 1e-9);
    close(bump.mean, 100.0 * 0.5 * (2.0 * PI).sqrt() / 400.0, 1e-6);
    close(bump.max.0, 100.0, 1e-6);
}

/// From 1e17 s on, where doubles are 16 s apart, a body of 100 s was at 12 degC between 20 degC and
/// its 10 W; from 1e12 s on one of 1 ms was 50 K off. The rise from rest is 10 (1 - exp(-t / tau))
/// K.
#[test]
fn a_start_far_from_zero_costs_no_accuracy() {
    for (start, tau, every) in
        [(1.7e9, 1e-3, 5e-4), (1e12, 1e-3, 0.000_488_281_25), (1e14, 1.0, 0.5), (1e17, 100.0, 32.0)]
    {
        let text = format!(
            "format = 1\n[node]\na = {{ C = \"100 J/K\", T0 = \"20 degC\" }}\n[boundary]\nb = {{ T \
             = \"20 degC\" }}\n\
             [resistor]\nr = {{ from = \"a\", to = \"b\", R = \"{r} K/W\" }}\n[source]\ns = {{ \
             into = \"a\", P = \"{p} W\" }}\n",
            r = tau / 100.0,
            p = 1000.0 / tau
        );
        let run = Transient { start, stop: start + 10.0 * every, ..Transient::until(Time(1.0)) };
        let solution = solved(&text, &run.every(Time(every)));
        assert!(solution.times().len() > 8);
        for (row, time) in solution.times().iter().enumerate() {
            let exact = 293.15 - 10.0 * (-(time - start) / tau).exp_m1();
            close(solution.row(row)[0], exact, 1e-4);
        }
    }
}

/// Rows that a double cannot tell apart were written with the same time; what depends on the time
/// was read at rounded ones.
#[test]
fn runs_whose_times_cannot_be_told_apart_are_refused() {
    let far = |start: f64, length: f64, every: f64| {
        let run = Transient { start, stop: start + length, ..Transient::until(Time(1.0)) };
        run.every(Time(every))
    };
    let still = system(&body(""));
    let error = far(1e17, 96.0, 10.0).solve(&still).unwrap_err();
    assert_eq!(error.code(), "run::settings");
    assert!(error.to_string().contains("the same time") && error.help().is_some(), "{error}");
    let moving =
        system(&body("[source]\ns = { into = \"a\", P = \"1 [W] * sin(t * 1 [1/s])\" }\n"));
    assert!(far(1.7e9, 8.0, 1.0).solve(&moving).is_ok());
    let error = far(1.7e9, 6.0, 1.0).solve(&moving).unwrap_err();
    assert!(error.code() == "run::settings" && error.to_string().contains("too coarse"), "{error}");
    assert!(far(1.7e9, 6.0, 1.0).solve(&still).is_ok());
}

/// A jump that is 8 ms after a row in a run far from 0 was moved onto it.
#[test]
fn a_jump_near_a_row_stays_where_it_is_far_from_zero() {
    let text = body(
        "[source]\ns = { into = \"a\", P = \"if(t < 1700000005.0078125 [s], 0 [W], 100 [W])\" }\n",
    );
    let run = Transient { start: 1.7e9, stop: 1.7e9 + 10.0, ..Transient::until(Time(1.0)) };
    let solution = solved(&text, &run.every(Time(1.0)));
    close(solution.row(5)[0], 303.15, 1e-9);
    close(solution.row(6)[0], 303.15 + 1.0 - 0.007_812_5, 1e-6);
}

/// What only results read must not make the integrator begin anew: a saw tooth of 20,000 teeth in a
/// report.
#[test]
fn what_only_results_read_does_not_restart_the_integrator() {
    let rest = "[signal]\nsaw = { t = [\"0 s\", \"0.05 s\"], v = [\"0 K\", \"10 K\"], after_end \
        = \"repeat\" }\n\
                [run]\nstop = \"1000 s\"\nreport = { top = \"a.T + saw\" }\n";
    let warm = |rest: &str| quiet(rest).replace("30 degC", "25 degC");
    let run = Transient::until(Time(1000.0)).every(Time(10.02));
    let (with, without) = (solved(&warm(rest), &run), solved(&warm(""), &run));
    assert_eq!(with.statistics(), without.statistics());
    let temperatures = |solution: &Solution| solution.temperature(solution.recorded()[0]).unwrap();
    assert_eq!(temperatures(&with), temperatures(&without));
    let report = with.report(with.network().report_ids().next().unwrap());
    let (row, t) = (37, with.times()[37]);
    close(report[row], with.row(row)[0] + (t % 0.05) * 200.0, 1e-6);
}
