//! The linear cases of the validation set, whose answers nobody computed with lptn: textbooks, standards, closed
//! forms, result files of other tools. `tests/validation/*/case.json` says where each number comes from.

#![allow(clippy::print_stdout, clippy::float_cmp, reason = "the table of results, shown with --nocapture")]

mod support;

use lptn::network::{Area, Bound, End, FilmCoefficient, Input, LimitId, NodeId, Path, Severity};
use lptn::prelude::*;
use lptn::reduce::{Bias, NortonEquivalent, transfer_resistance};
use lptn::solve::Modes;
use serde_json::Value;

/// A case with its network built through the public API. Names of nodes are those of the case.
struct Case {
    json: Value,
    system: ThermalSystem,
    /// The levels whose first crossing is asked for, in the order of `expected`.
    levels: Vec<(usize, LimitId)>,
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("`{key}` is no text in {value}"))
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("`{key}` is no number in {value}"))
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("`{key}` is no list in {value}"))
}

impl Case {
    fn read(id: &str) -> Self {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/validation").join(id);
        let json = std::fs::read_to_string(path.join("case.json")).expect("the case is there");
        let json: Value = serde_json::from_str(&json).expect("the case is JSON");
        let zero = if text(&json, "temperature_unit") == "C" { number(&json, "celsius_zero_K") } else { 0.0 };
        let mut b = NetworkBuilder::new();
        let ends: Vec<(String, End)> = list(&json, "nodes").iter().map(|n| node(&mut b, n, zero)).collect();
        let end = |name: &str| ends.iter().find(|(known, _)| known == name).expect("the node is there").1;
        for edge in list(&json, "edges") {
            let path = match text(edge, "type") {
                "conductance" => Conductance(number(edge, "G")).into(),
                "convection" => {
                    Path::Film(FilmCoefficient(number(edge, "h")).into(), Area(number(edge, "A")).into())
                }
                other => panic!("an edge of type {other} is not linear"),
            };
            b.resistor(text(edge, "id"), end(text(edge, "a")), end(text(edge, "b")), path);
        }
        for source in list(&json, "sources") {
            assert!(source.get("gate").is_none() && source.get("T_coeff").is_none(), "{id}: {source}");
            b.source(text(source, "id"), end(text(source, "node")), HeatFlow(number(source, "Q")));
        }
        let levels = levels(&mut b, &json, zero);
        Self { json, system: support::assembled(b), levels }
    }

    fn zero(&self) -> f64 {
        if text(&self.json, "temperature_unit") == "C" { number(&self.json, "celsius_zero_K") } else { 0.0 }
    }

    fn node(&self, expected: &Value, key: &str) -> NodeId {
        self.system.network().node(text(expected, key)).expect("the node is there")
    }

    /// A hundredth of the smallest tolerance of a transient temperature, at least 1e-9 K; 1e-7 K if there is none.
    fn tolerance(&self) -> f64 {
        let transient = |e: &&Value| text(e, "quantity") == "T" && e["t"].is_number();
        let tolerances = list(&self.json, "expected").iter().filter(transient);
        let least = tolerances.map(allowed).fold(f64::INFINITY, f64::min);
        if least.is_finite() { (least / 100.0).max(1e-9) } else { 1e-7 }
    }

    /// The run with a row at each of these times.
    fn run(&self, mut times: Vec<f64>) -> Solution {
        times.retain(|t| *t > 0.0);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let stop = *times.last().expect("a time to run to");
        let run = Transient::until(Time(stop)).at(&times).tolerance(self.tolerance());
        run.solve(&self.system).expect("it runs")
    }

    /// Temperature of a node or boundary over the rows, or its heat flow, by what is asked for.
    fn at(&self, expected: &Value) -> Option<f64> {
        let network = self.system.network();
        let quantity = text(expected, "quantity");
        if expected["t"] == "steady" {
            let steady = SteadyState::solve(&self.system, 0.0).expect("there is a steady state");
            return Some(match quantity {
                "T" => {
                    self.port_gives(expected);
                    steady.temperatures[self.node(expected, "node").index()] - self.zero()
                }
                "Q_edge" => steady.conductor_heat[self.conductor(text(expected, "edge"))],
                "Q_boundary" => steady.boundary_heat[self.boundary(text(expected, "node"))],
                _ => return None,
            });
        }
        let solution = self.run(vec![expected["t"].as_f64()?]);
        let last = |values: Option<Vec<f64>>| values.and_then(|v| v.last().copied());
        match quantity {
            "T" => Some(last(solution.temperature(self.node(expected, "node")))? - self.zero()),
            "Q_edge" => {
                let id = network.conductor_ids().nth(self.conductor(text(expected, "edge")))?;
                last(solution.conductor_heat(id))
            }
            _ => None,
        }
    }

    /// The steady temperature of a node is `T_ref + R_eq Q_N` with the node as port.
    fn port_gives(&self, expected: &Value) {
        let port = NortonEquivalent::new(&self.system, self.node(expected, "node")).expect("it is grounded");
        let inputs = port.inputs(&self.system, 0.0).expect("the inputs have values");
        let found = inputs.reference + port.resistance * inputs.heat - self.zero();
        let off = (found - number(expected, "value")).abs();
        assert!(off <= allowed(expected), "{expected} but the port gives {found}");
    }

    fn conductor(&self, name: &str) -> usize {
        let conductors = self.system.network().conductors();
        conductors.iter().position(|c| c.name == name).expect("the edge is there")
    }

    fn boundary(&self, name: &str) -> usize {
        let boundaries = self.system.network().boundaries();
        boundaries.iter().position(|b| b.name == name).expect("the boundary is there")
    }

    /// The value lptn finds for an expected one; `None` if this test does not know the quantity.
    fn found(&self, index: usize, expected: &Value) -> Option<f64> {
        let network = self.system.network();
        let resistance = |from, to| transfer_resistance(&self.system, from, to).expect("it is grounded");
        let mode = || {
            let modes = Modes::solve(network).expect("it has modes");
            let index = usize::try_from(expected["index"].as_u64().expect("an index")).expect("it is small");
            modes.modes()[index].clone()
        };
        Some(match text(expected, "quantity") {
            "T" | "Q_edge" | "Q_boundary" => self.at(expected)?,
            "R_port" => resistance(self.node(expected, "node"), self.node(expected, "node")),
            "R_transfer" => resistance(self.node(expected, "source_node"), self.node(expected, "node")),
            "C_total" => network.node_ids().map(|id| network.capacity(id)).sum(),
            "time_constant" => mode().tau(),
            "mode_ratio" => {
                let shape = mode().shape;
                shape[self.node(expected, "node").index()] / shape[self.node(expected, "over").index()]
            }
            "crossing_time" => {
                let limit = self.levels.iter().find(|(i, _)| *i == index)?.1;
                let solution = self.run(vec![number(expected, "t_end")]);
                solution.limits().iter().find(|seen| seen.limit == limit)?.broken_at?
            }
            fit if fit.starts_with("fit_") => self.fit(expected)?,
            _ => return None,
        })
    }

    fn fit(&self, expected: &Value) -> Option<f64> {
        let (from, to, n) = (number(expected, "t0"), number(expected, "t1"), number(expected, "n"));
        assert_eq!(from, 0.0, "{expected}");
        let run = Transient::until(Time(to)).every(Time(to / (n - 1.0))).tolerance(self.tolerance());
        let bias = Bias::new(&self.system, self.node(expected, "node"), &run).expect("it runs");
        let bias = bias.expect("it can be fitted");
        assert_eq!(bias.points as f64, n, "{expected}");
        Some(match text(expected, "quantity") {
            "fit_Ti" => bias.fit.initial - self.zero(),
            "fit_Tf" => bias.fit.settled - self.zero(),
            "fit_tau" => bias.fit.tau,
            "fit_rms" => bias.fit.rms,
            _ => return None,
        })
    }
}

fn node(b: &mut NetworkBuilder, node: &Value, zero: f64) -> (String, End) {
    let name = text(node, "id");
    let end = match text(node, "type") {
        "capacitance" => {
            let (capacity, initial) =
                (HeatCapacity(number(node, "C")), Temperature(number(node, "T0") + zero));
            b.node(name, capacity, initial).into()
        }
        "massless" => b.massless(name).into(),
        "boundary" => b.boundary(name, boundary(b, &node["T"], zero)).into(),
        other => panic!("a node of type {other} is unknown"),
    };
    (name.to_owned(), end)
}

fn boundary(b: &NetworkBuilder, of_time: &Value, zero: f64) -> Input {
    if let Some(constant) = of_time.as_f64() {
        return Temperature(constant + zero).into();
    }
    assert_eq!(text(of_time, "kind"), "sine", "{of_time}");
    let [mean, amp, omega, phase] = ["mean", "amp", "omega", "phase"].map(|key| number(of_time, key));
    let sine = format!("absolute({} [K]) + {amp} [K] * sin({omega} [1/s] * t + {phase})", mean + zero);
    b.expression(&sine, None).expect("it compiles").into()
}

/// A limit for every level whose crossing is asked for: it breaks when the node rises through it.
fn levels(b: &mut NetworkBuilder, json: &Value, zero: f64) -> Vec<(usize, LimitId)> {
    let mut levels = Vec::new();
    for (i, expected) in list(json, "expected").iter().enumerate() {
        if text(expected, "quantity") == "crossing_time" {
            let of = format!("{}.T", text(expected, "node"));
            let program = b.post_expression(&of, None).expect("it compiles");
            let level = Temperature(number(expected, "level") + zero);
            let name = format!("level_{i}");
            let limit =
                b.limit(&name, (program.into(), &of), (Bound::Below, level.into()), Severity::Warning);
            levels.push((i, limit));
        }
    }
    levels
}

fn allowed(expected: &Value) -> f64 {
    let of = |key: &str| expected[key].as_f64().unwrap_or(0.0);
    of("tol_abs").max(of("tol_rel") * number(expected, "value").abs())
}

/// Checks every expected value of a case; `later` names the quantities that wait for other analyses.
fn check(id: &str, later: &[&str]) {
    let case = Case::read(id);
    let (mut checked, mut worst, mut waiting) = (0, 0.0_f64, Vec::new());
    for (i, expected) in list(&case.json, "expected").iter().enumerate() {
        let quantity = text(expected, "quantity");
        match case.found(i, expected) {
            Some(_) if later.contains(&quantity) => panic!("{id}: {quantity} need not wait any longer"),
            Some(found) => {
                let share = (found - number(expected, "value")).abs() / allowed(expected);
                assert!(share <= 1.0, "{id}: {expected} but found {found}");
                (checked, worst) = (checked + 1, worst.max(share));
            }
            None if later.contains(&quantity) => waiting.push(quantity),
            None => panic!("{id}: no way to compute {expected}"),
        }
    }
    assert!(checked > 0, "{id}: nothing was checked");
    println!("{id}: {checked} values, the worst at {worst:.2e} of what is allowed; waiting: {waiting:?}");
}

macro_rules! cases {
    ($($id:ident $(waits for $($later:literal)*)?;)*) => {$(
        #[test]
        fn $id() {
            check(stringify!($id), &[$($($later),*)?]);
        }
    )*};
}

cases! {
    bridge_steady;
    emach_resistance_network;
    gearbox_speed_sweep;
    gearbox_two_node;
    incropera_3_2_chip;
    incropera_3_9_fins;
    incropera_5_1_thermocouple;
    incropera_5_4_pipeline;
    iso10211_case1;
    msl_two_masses;
    nafems_t3;
    rc_ladder;
    freq_two_node waits for "freq_gain" "freq_phase";
}
