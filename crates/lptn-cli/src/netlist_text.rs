//! A network that was made here as a netlist: TOML that reads back as the same numbers.

use lptn_netlist::RunSettings;
use lptn_network::{Conductor, End, Law, Network, OutputTimes, Value};
use lptn_report::Shortest;
use lptn_units::{Dimension, Type};

/// The netlist of a network, with the run that goes with it. Quantities are in SI units, expressions as they were
/// written.
pub(crate) fn netlist(network: &Network, title: &str, run: Option<&RunSettings>) -> String {
    let mut lines = vec!["format = 1".to_owned(), format!("title = {}", string(title))];
    let mut section = |heading: &str, entries: Vec<String>| {
        if !entries.is_empty() {
            lines.push(format!("\n[{heading}]"));
            lines.extend(entries);
        }
    };
    section("param", parameters(network));
    section("node", nodes(network));
    let boundary = |b: &lptn_network::Boundary| {
        format!("{} = {{ T = {} }}", b.name, value(&b.temperature, Type::ABSOLUTE_TEMPERATURE))
    };
    section("boundary", network.boundaries().iter().map(boundary).collect());
    section("resistor", network.conductors().iter().map(|c| resistor(network, c)).collect());
    let source = |s: &lptn_network::Source| {
        let into = &network.nodes()[s.into.index()].name;
        let power = value(&s.power, Type::of(Dimension::POWER));
        format!("{} = {{ into = {}, P = {power} }}", s.name, string(into))
    };
    section("source", network.sources().iter().map(source).collect());
    section("run", run.map(settings).unwrap_or_default());
    lines.join("\n") + "\n"
}

fn parameters(network: &Network) -> Vec<String> {
    let parameters = network.parameters().iter().zip(network.parameter_ids());
    parameters
        .map(|(p, id)| {
            let number = network.parameter_value(id);
            // in [param] a K is a difference
            let text = if p.ty.absolute {
                string(&format!("absolute({} [K])", shortest(number)))
            } else {
                value(&Value::Constant(number), p.ty)
            };
            format!("{} = {text}", p.name)
        })
        .collect()
}

fn nodes(network: &Network) -> Vec<String> {
    let nodes = network.nodes().iter().zip(network.node_ids());
    nodes
        .map(|(node, id)| {
            if node.massless {
                return format!("{} = {{ massless = true }}", node.name);
            }
            let capacity = value(&Value::Constant(network.capacity(id)), Type::of(Dimension::CAPACITY));
            let initial = value(&Value::Constant(network.initial(id)), Type::ABSOLUTE_TEMPERATURE);
            format!("{} = {{ C = {capacity}, T0 = {initial} }}", node.name)
        })
        .collect()
}

fn resistor(network: &Network, conductor: &Conductor) -> String {
    let end = |end: End| string(network.name_of(end.into()));
    let law = match &conductor.law {
        Law::Resistance(r) => format!("R = {}", value(r, Type::of(Dimension::RESISTANCE))),
        Law::Conductance(g) => format!("G = {}", value(g, Type::of(Dimension::CONDUCTANCE))),
        Law::Film { coefficient, area } => format!(
            "G = \"({}) * ({})\"",
            expression(coefficient, Type::of(Dimension::FILM_COEFFICIENT)),
            expression(area, Type::of(Dimension::AREA))
        ),
    };
    format!("{} = {{ from = {}, to = {}, {law} }}", conductor.name, end(conductor.from), end(conductor.to))
}

fn settings(run: &RunSettings) -> Vec<String> {
    let time = |seconds: f64| format!("\"{} s\"", shortest(seconds));
    let mut lines = vec![format!("stop = {}", time(run.stop))];
    if run.start.abs() > 0.0 {
        lines.push(format!("start = {}", time(run.start)));
    }
    lines.push(match &run.output {
        OutputTimes::Every(every) => format!("output = {{ every = {} }}", time(*every)),
        OutputTimes::At(times) => {
            let times: Vec<String> = times.iter().map(|&t| time(t)).collect();
            format!("output = {{ at = [{}] }}", times.join(", "))
        }
    });
    lines.push(format!("tolerance = \"{} K\"", shortest(run.tolerance)));
    lines
}

/// A value as TOML.
fn value(value: &Value, ty: Type) -> String {
    match value {
        Value::Expression(program) => string(program.text()),
        Value::Constant(number) if ty == Type::of(Dimension::NONE) => shortest(*number),
        Value::Constant(number) => string(&format!("{} {}", shortest(*number), unit(ty))),
        Value::Product(_) => {
            unreachable!("a reduced network has one capacity, a number: this is a bug in lptn")
        }
    }
}

/// A value as a part of an expression.
fn expression(value: &Value, ty: Type) -> String {
    match value {
        Value::Expression(program) => escaped(program.text()),
        Value::Constant(number) => format!("{} [{}]", shortest(*number), unit(ty)),
        Value::Product(_) => unreachable!("a reduced network has no products: this is a bug in lptn"),
    }
}

fn unit(ty: Type) -> String {
    if ty.absolute { "K".to_owned() } else { ty.dimension.si_unit() }
}

fn shortest(number: f64) -> String {
    Shortest::new().text(number).to_owned()
}

/// A basic string of TOML.
fn string(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out += "\\n",
            c if c.is_control() => out += &format!("\\u{:04X}", u32::from(c)),
            c => out.push(c),
        }
    }
    out
}
