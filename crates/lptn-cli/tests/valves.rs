//! Streams of flow networks that pass nodes, by hand.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::Folder;

/// A loop of a pump and a valve that opens above 21 degC. The oil settles at 20 + 200/100 = 22 degC.
const VALVE: &str = r#"format = 1
[boundary]
supply = { T = "20 degC" }
[node]
oil = { C = "100 J/K", T0 = "20 degC" }
[control]
valve = { sense = "oil", on_above = "21 degC", off_below = "20.5 degC" }
[junction]
tank = { p = "0 bar" }
rail = {}
[branch]
pump = { from = "tank", to = "rail", flow = "0.05 kg/s" }
pipe = { from = "rail", to = "tank", flow = "dp * (0.5 + valve) * 1e-6 [kg/(s Pa)]" }
[advection]
in = { from = "supply", to = "oil", mcp = "pump * 2000 [J/(kg K)]" }
out = { from = "oil", to = "supply", mcp = "pipe * 2000 [J/(kg K)]" }
[source]
P = { into = "oil", P = "200 W" }
[run]
stop = "1 min"
"#;

/// A stream of a flow network that does not leave its node is a doubt in the answer. Pressures are
/// those of the open valve, so flows have to be too.
#[test]
fn a_flow_that_does_not_leave_a_node_is_a_warning() {
    let whole = Folder::with("loop.toml", VALVE);
    let lines = VALVE.lines().filter(|line| !line.starts_with("out ="));
    let open = Folder::with("loop.toml", &lines.collect::<Vec<_>>().join("\n"));
    for command in ["run", "steady", "compare"] {
        open.run(&[command, "loop.toml"]).says("network::unbalanced_streams").says("100 W/K");
        let ran = whole.run(&[command, "loop.toml"]).exits(0);
        assert!(!ran.err.contains("unbalanced"), "{}", ran.err);
    }
}

/// The same loop with a valve that opens with the temperature of the oil: its stream is the same in
/// both places, whatever the slope of its flow is. 1 kW leaves through 50 W/K at 20 + 20 degC.
#[test]
fn a_valve_that_reads_a_temperature_keeps_its_streams_balanced() {
    let text = r#"format = 1
[node]
oil = { C = "1 kJ/K", T0 = "20 degC" }
cooler = { C = "1 kJ/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[junction]
tank = { p = "0 bar" }
rail = {}
[branch]
pump = { from = "tank", to = "rail", flow = "0.2 kg/s" }
valve = { from = "rail", to = "tank", K_v = "2 [m^3/h] * max(0.01, min(1, (oil.T - 30 [degC]) / 20 [K]))", density = "1000 kg/m^3" }
bypass = { from = "rail", to = "tank", K_v = "0.5 m^3/h", density = "1000 kg/m^3" }
[advection]
there = { from = "oil", to = "cooler", mcp = "valve * 4000 [J/(kg K)]" }
back = { from = "cooler", to = "oil", mcp = "valve * 4000 [J/(kg K)]" }
[resistor]
fins = { from = "cooler", to = "air", G = "50 W/K" }
[source]
loss = { into = "oil", P = "1 kW" }
[run]
stop = "10 min"
"#;
    let folder = Folder::with("loop.toml", text);
    for command in ["run", "steady", "compare"] {
        let ran = folder.run(&[command, "loop.toml"]).exits(0);
        assert!(!ran.err.contains("unbalanced"), "{}", ran.err);
    }
    let found = folder.json("steady loop.toml").json();
    let near = |path: &str, expected: f64| {
        let value = found.pointer(path).and_then(serde_json::Value::as_f64);
        assert!(value.is_some_and(|value| (value - expected).abs() < 1e-6), "{path}: {value:?}");
    };
    near("/values/cooler.T/value", 40.0);
}
