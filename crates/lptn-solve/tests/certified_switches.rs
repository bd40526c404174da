//! Proven bounds through the switches of thermostats: against closed forms, and against
//! Runge-Kutta's method with located switches on random networks that are written out twice.

#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use std::fmt::Write as _;

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{EventKind, Selection, Solution, Transient, Unbounded};

fn certified(text: &str, tolerance: f64, stop: f64) -> Solution {
    let network = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let system = ThermalSystem::assemble(&network.network).unwrap();
    let settings = Transient::until(Time(stop)).every(Time(stop / 40.0)).tolerance(tolerance);
    let certified = Some(Selection::all(&network.network));
    Transient { certify: true, certified, ..settings }.solve(&system).unwrap()
}

fn reason(found: &Solution) -> Option<(&'static str, String)> {
    let reason = found.certificate().unwrap().as_ref().err()?;
    Some((reason.code(), reason.to_string()))
}

/// The times at which controls switched after the start.
fn switches(found: &Solution) -> Vec<f64> {
    let of_control = |kind| matches!(kind, EventKind::Control(_));
    let events = found.events().iter().filter(|event| of_control(event.kind) && event.time > 0.0);
    events.map(|event| event.time).collect()
}

/// A body of 600 J/K, 3 W/K to air of 20 degC, 240 W from below 58 degC to above 62 degC.
const THERMOSTAT: &str = r#"format = 1
[node]
body = { C = "600 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "3 W/K" }
[control]
heater = { sense = "body", on_below = "58 degC", off_above = "62 degC", start = "on" }
[source]
element = { into = "body", P = "240 [W] * heater" }
"#;

/// The temperature over air in K, the times of all switches in s, and the time for which it is on:
/// exponentials with a time constant of 200 s to 80 K and to 0 K. From 600 s on both thresholds are
/// `later` K higher.
fn thermostat(time: f64, later: f64) -> (f64, Vec<f64>, f64) {
    let (mut at, mut rise, mut on, mut heated, mut times) = (0.0, 0.0, true, 0.0, Vec::new());
    loop {
        let by = if at < 600.0 { 0.0 } else { later };
        let (end, next) = if on { (80.0, 42.0 + by) } else { (0.0, 38.0 + by) };
        let switches = at + 200.0 * f64::ln((end - rise) / (end - next));
        let until = if at < 600.0 { switches.min(600.0) } else { switches };
        let lasts = until.min(time) - at;
        rise = end + (rise - end) * f64::exp(-lasts / 200.0);
        heated += if on { lasts } else { 0.0 };
        if until > time {
            return (rise, times, heated);
        }
        at = until;
        if until >= switches || (!on && rise < 38.0 + later) {
            times.push(at);
            on = !on;
        }
    }
}

/// Checks a thermostat with its closed form; gives the largest error and bound in K.
fn check(found: &Solution, later: f64) -> [f64; 2] {
    assert_eq!(reason(found), None);
    let (_, right, heated) = thermostat(2000.0, later);
    let proven = found.proven_switches().unwrap();
    assert_eq!((switches(found).len(), proven.len()), (right.len(), right.len()));
    for ((right, found), [from, to]) in right.iter().zip(switches(found)).zip(proven) {
        assert!(from - 1e-9 <= *right && *right <= to + 1e-9, "{from} {right} {to}");
        assert!(*from <= found && found <= *to, "{from} {found} {to}");
    }
    let source = found.network().source_ids().next().unwrap();
    let energy = found.ledger().sources[source.index()] - 240.0 * heated;
    let bound = found.source_bound(source).unwrap();
    assert!(energy.abs() <= bound + 1e-7, "{energy:e} J, bound {bound:e} J");
    let body = found.network().node("body").unwrap();
    let (values, bounds) = (found.temperature(body).unwrap(), found.bounds(body).unwrap());
    let mut largest = [0.0_f64; 2];
    for ((time, value), bound) in found.times().iter().zip(values).zip(bounds) {
        let error = (value - 293.15 - thermostat(*time, later).0).abs();
        assert!(error <= bound + 1e-11, "{time} s, {error:e} K, bound {bound:e}");
        largest = [largest[0].max(error), largest[1].max(bound)];
    }
    println!(
        "{} switches: error {:e}, bound {:e}, {bound:e} J",
        right.len(),
        largest[0],
        largest[1]
    );
    largest
}

#[test]
fn a_thermostat_stays_within_its_bounds() {
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let largest = check(&certified(THERMOSTAT, tolerance, 2000.0), 0.0);
        assert!(largest[1] < 3.0 * tolerance, "{largest:?}");
    }
}

/// At 600 s the heater is off and the body is colder than the new threshold.
#[test]
fn a_threshold_that_jumps_switches_at_that_time() {
    let text = THERMOSTAT
        .replace("\"58 degC\"", "\"if(t < 600 [s], 58 [degC], 68 [degC])\"")
        .replace("\"62 degC\"", "\"if(t < 600 [s], 62 [degC], 72 [degC])\"");
    for tolerance in [1e-3, 1e-6] {
        check(&certified(&text, tolerance, 2000.0), 10.0);
    }
    assert!(thermostat(2000.0, 10.0).1.contains(&600.0));
}

/// The heated body comes closer and closer to 100 degC.
#[test]
fn a_temperature_that_runs_along_its_threshold_is_not_proven() {
    for threshold in ["100 degC", "99.99999999 degC"] {
        let text = THERMOSTAT.replace("62 degC", threshold);
        let found = certified(&text, 1e-5, 20_000.0);
        let (code, text) = reason(&found).unwrap();
        assert_eq!(code, "certify::switch_time");
        assert!(text.contains("`heater`") && text.contains("too close"), "{text}");
        assert!(found.bounds(found.network().node("body").unwrap()).is_none());
    }
}

/// Both heaters feel the same temperature and switch at one time.
#[test]
fn controls_that_switch_together_are_not_proven() {
    let second = "second = { sense = \"body\", on_below = \"50 degC\", off_above = \"62 degC\" }";
    let text = THERMOSTAT.replace("[source]", &format!("{second}\n[source]"));
    let found = certified(&text, 1e-5, 2000.0);
    let (code, text) = reason(&found).unwrap();
    assert_eq!(code, "certify::switch_time", "{text}");
    assert!(text.contains("at about the same time"), "{text}");
}

/// A thermostat: on beyond the first temperature in K, off beyond the second one.
struct Control {
    sense: usize,
    cools: bool,
    thresholds: [f64; 2],
    /// In s.
    dwell: f64,
    acts: Act,
}

#[derive(Clone, Copy)]
enum Act {
    /// Heat in W into a node.
    Heats(f64, usize),
    /// Conductance in W/K from a node to air.
    Cools(f64, usize),
}

/// A random network: capacities in J/K; paths between nodes, or to air; radiation in m^2 from each
/// node to air; heat in W and its change in W/s into each node; thermostats.
struct Written {
    capacities: Vec<f64>,
    links: Vec<(usize, Option<usize>, f64)>,
    areas: Vec<f64>,
    heats: Vec<(f64, f64)>,
    controls: Vec<Control>,
}

const AIR: f64 = 293.15;
const SIGMA: f64 = 5.670_374_419e-8;
const STOP: f64 = 400.0;

impl Written {
    fn new(seed: u64) -> Self {
        // the generator of Knuth's MMIX (The Art of Computer Programming 2, 3.3.4)
        let mut state = seed.wrapping_add(29);
        let mut next = move |from: f64, to: f64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            from + (to - from) * (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let nodes = 1 + next(0.0, 4.0) as usize;
        let radiates = next(0.0, 1.0) < 0.5;
        let mut links = vec![(0, None, next(0.3, 1.5))];
        for from in 1..nodes {
            links.push((from, Some(next(0.0, from as f64) as usize), next(0.5, 3.0)));
            links.push((from, None, next(0.1, 0.5)));
        }
        let controls = (0..1 + next(0.0, 3.0) as usize).map(|i| {
            let (sense, cools) = (next(0.0, nodes as f64) as usize, next(0.0, 1.0) < 0.4);
            let (low, band) = (AIR + next(6.0, 14.0) + 3.0 * i as f64, next(1.0, 4.0));
            let place = next(0.0, nodes as f64) as usize;
            let acts = match next(0.0, 1.0) < 0.5 && cools {
                true => Act::Cools(next(0.5, 2.0), sense),
                false if cools => Act::Heats(-next(10.0, 25.0), place),
                false => Act::Heats(next(20.0, 45.0), place),
            };
            let thresholds = if cools { [low + band, low] } else { [low, low + band] };
            let dwell = if next(0.0, 1.0) < 0.25 { next(2.0, 12.0) } else { 0.0 };
            Control { sense, cools, thresholds, dwell, acts }
        });
        let controls = controls.collect();
        Self {
            capacities: (0..nodes).map(|_| 10f64.powf(next(1.2, 2.3))).collect(),
            links,
            areas: (0..nodes).map(|_| if radiates { next(0.005, 0.05) } else { 0.0 }).collect(),
            heats: (0..nodes).map(|_| (next(0.0, 8.0), next(-0.01, 0.02))).collect(),
            controls,
        }
    }

    fn text(&self) -> String {
        let mut text = String::from("format = 1\n[boundary]\nair = { T = \"293.15 K\" }\n[node]\n");
        for (i, c) in self.capacities.iter().enumerate() {
            writeln!(text, "n{i} = {{ C = \"{c} J/K\", T0 = \"293.15 K\" }}").unwrap();
        }
        writeln!(text, "[control]").unwrap();
        for (i, of) in self.controls.iter().enumerate() {
            let [on, off] = of.thresholds;
            let keys = if of.cools { ["on_above", "off_below"] } else { ["on_below", "off_above"] };
            writeln!(
                text,
                "c{i} = {{ sense = \"n{}\", {} = \"{on} K\", {} = \"{off} K\", min_dwell = \"{} s\" }}",
                of.sense, keys[0], keys[1], of.dwell
            )
            .unwrap();
        }
        for (i, (from, to, g)) in self.links.iter().enumerate() {
            let to = to.map_or("air".to_owned(), |to| format!("n{to}"));
            let keys = format!("from = \"n{from}\", to = \"{to}\", G = \"{g} W/K\"");
            writeln!(text, "[resistor.p{i}]\n{}", keys.replace(", ", "\n")).unwrap();
        }
        for (i, area) in self.areas.iter().enumerate().filter(|(_, area)| **area > 0.0) {
            writeln!(text, "[radiation.r{i}]\nfrom = \"n{i}\"\nto = \"air\"\nGr = \"{area} m^2\"")
                .unwrap();
        }
        for (i, (heat, rate)) in self.heats.iter().enumerate() {
            writeln!(text, "[source.q{i}]\ninto = \"n{i}\"\nP = \"{heat} [W] + {rate} [W/s] * t\"")
                .unwrap();
        }
        for (i, of) in self.controls.iter().enumerate() {
            match of.acts {
                Act::Heats(heat, node) => {
                    writeln!(text, "[source.u{i}]\ninto = \"n{node}\"\nP = \"{heat} [W] * c{i}\"")
                }
                Act::Cools(g, node) => writeln!(
                    text,
                    "[convection.u{i}]\nfrom = \"n{node}\"\nto = \"air\"\narea = \"1 m^2\"\n\
                     h = \"{g} [W/(m^2 K)] * c{i}\""
                ),
            }
            .unwrap();
        }
        text
    }

    /// Change of each temperature in K/s.
    fn slopes(&self, time: f64, t: &[f64], on: &[bool]) -> Vec<f64> {
        let mut heat: Vec<f64> = self.heats.iter().map(|(heat, rate)| heat + rate * time).collect();
        for (from, to, g) in &self.links {
            let q = g * (t[*from] - to.map_or(AIR, |to| t[to]));
            heat[*from] -= q;
            to.iter().for_each(|to| heat[*to] += q);
        }
        for (i, area) in self.areas.iter().enumerate() {
            heat[i] -= SIGMA * area * (t[i].powi(4) - AIR.powi(4));
        }
        for (of, _) in self.controls.iter().zip(on).filter(|(_, on)| **on) {
            match of.acts {
                Act::Heats(power, node) => heat[node] += power,
                Act::Cools(g, node) => heat[node] -= g * (t[node] - AIR),
            }
        }
        heat.iter().zip(&self.capacities).map(|(q, c)| q / c).collect()
    }

    /// One step of Runge-Kutta's method.
    fn step(&self, (time, step): (f64, f64), t: &[f64], on: &[bool]) -> Vec<f64> {
        let along =
            |k: &[f64], by: f64| -> Vec<f64> { t.iter().zip(k).map(|(t, k)| t + by * k).collect() };
        let k1 = self.slopes(time, t, on);
        let k2 = self.slopes(time + 0.5 * step, &along(&k1, 0.5 * step), on);
        let k3 = self.slopes(time + 0.5 * step, &along(&k2, 0.5 * step), on);
        let k4 = self.slopes(time + step, &along(&k3, step), on);
        let sum = |i: usize| k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i];
        (0..t.len()).map(|i| t[i] + step / 6.0 * sum(i)).collect()
    }

    /// The first control beyond the threshold of its state that may switch at a time.
    fn due(&self, time: f64, t: &[f64], (on, since): (&[bool], &[f64])) -> Option<usize> {
        let is_due = |(i, of): (usize, &Control)| {
            let [enters, leaves] = of.thresholds;
            let above = if on[i] { !of.cools } else { of.cools };
            let over = t[of.sense] - if on[i] { leaves } else { enters };
            (time >= since[i] + of.dwell && if above { over > 0.0 } else { over < 0.0 })
                .then_some(i)
        };
        self.controls.iter().enumerate().find_map(is_due)
    }

    /// Temperatures at forty equal times after the start in K, and the times of the switches.
    fn run(&self, steps: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
        let count = self.controls.len();
        let (mut on, mut since) = (vec![false; count], vec![f64::NEG_INFINITY; count]);
        let (mut t, mut switches) = (vec![AIR; self.capacities.len()], Vec::new());
        while let Some(i) = self.due(0.0, &t, (&on, &since)) {
            (on[i], since[i]) = (!on[i], 0.0);
        }
        let mut rows = vec![t.clone()];
        for k in 0..steps {
            let (mut time, end) =
                (STOP * k as f64 / steps as f64, STOP * (k + 1) as f64 / steps as f64);
            while time < end {
                let free = since.iter().zip(&self.controls).map(|(since, of)| since + of.dwell);
                let mut stop = free.filter(|free| *free > time).fold(end, f64::min);
                let mut after = self.step((time, stop - time), &t, &on);
                if self.due(stop, &after, (&on, &since)).is_some() {
                    // halve down to the first moment
                    let mut low = time;
                    while let middle = 0.5 * (low + stop)
                        && low < middle
                        && middle < stop
                    {
                        let there = self.step((time, middle - time), &t, &on);
                        match self.due(middle, &there, (&on, &since)) {
                            Some(_) => (stop, after) = (middle, there),
                            None => low = middle,
                        }
                    }
                    let i = self.due(stop, &after, (&on, &since)).unwrap();
                    (on[i], since[i]) = (!on[i], stop);
                    switches.push(stop);
                }
                (time, t) = (stop, after);
            }
            if (k + 1) % (steps / 40) == 0 {
                rows.push(t.clone());
            }
        }
        (rows, switches)
    }
}

#[test]
fn random_thermostats_stay_within_their_bounds() {
    let count = std::env::var("LPTN_CERTIFIED").map_or(12, |text| text.parse().unwrap());
    let mut all = [1e-3, 1e-5, 1e-7].map(|tolerance| (tolerance, Vec::new(), 0, 0));
    for seed in 0..count {
        let written = Written::new(seed);
        let ((rough, times), (fine, again)) = (written.run(4000), written.run(8000));
        if times.len() != again.len() {
            continue; // a switch that the steps of the reference can miss
        }
        let pairs = rough.iter().flatten().zip(fine.iter().flatten());
        let own = pairs.map(|(a, b)| (a - b).abs()).fold(1e-11, f64::max);
        for (tolerance, ratios, proven, switched) in &mut all {
            let found = certified(&written.text(), *tolerance, STOP);
            if let Some((code, text)) = reason(&found) {
                println!("seed {seed}, {tolerance:e}: {text}");
                assert!(["certify::switch_time", "certify::lost"].contains(&code), "{text}");
                continue;
            }
            let within =
                found.network().node_ids().all(|id| found.largest_bound(id).unwrap() < *tolerance);
            let doubt = found.why_unbounded();
            let false_alarm = within && matches!(doubt, Some(Unbounded::Switch(_)));
            assert!(!false_alarm, "seed {seed}, {tolerance:e}: {doubt:?}");
            (*proven, *switched) = (*proven + 1, *switched + again.len());
            let intervals = found.proven_switches().unwrap();
            assert_eq!(intervals.len(), again.len(), "seed {seed}");
            for (([from, to], right), rough) in intervals.iter().zip(&again).zip(&times) {
                let own = (right - rough).abs() + 1e-9;
                assert!(
                    from - own <= *right && *right <= to + own,
                    "seed {seed}: {from} {right} {to}"
                );
            }
            for (node, id) in found.network().node_ids().enumerate() {
                let (values, bounds) = (found.temperature(id).unwrap(), found.bounds(id).unwrap());
                let most = found.largest_bound(id).unwrap();
                for (row, (value, bound)) in values.iter().zip(&bounds).enumerate() {
                    let error = (value - fine[row][node]).abs();
                    let about = format!("seed {seed}, node {node}, row {row}");
                    assert!(error <= bound + own, "{about}: {error:e} K, bound {bound:e}");
                    assert!(*bound <= most * (1.0 + 1e-9) + 1e-12, "{about}: {bound:e} {most:e}");
                    if error > 10.0 * own {
                        ratios.push(bound / error);
                    }
                }
            }
        }
    }
    for (tolerance, mut ratios, proven, switched) in all {
        ratios.sort_by(f64::total_cmp);
        let at = |share: usize| ratios.get(ratios.len() * share / 100).copied().unwrap_or(0.0);
        println!(
            "{tolerance:e} K: {proven} of {count} proven, {switched} switches, bound over error {:.2}, \
             95 % below {:.1}, {} numbers",
            at(50),
            at(95),
            ratios.len()
        );
        assert!(proven * 10 >= count as usize * 7, "{proven} of {count}");
    }
}
