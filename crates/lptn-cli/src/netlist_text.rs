//! A network that was made here as a netlist: TOML that reads back as the same numbers.

use lptn_netlist::RunSettings;
use lptn_network::{AfterEnd, Conductor, Course, End, Law, Network, NodeId, OutputTimes, Signal, Value};
use lptn_report::Shortest;
use lptn_units::{Dimension, Interpolation, Outside, Table, TableSymbol, Type};

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
    section("table", network.tables().map(|(name, symbol)| table(name, symbol)).collect());
    section("signal", network.signals().iter().map(|signal| course(network, signal)).collect());
    section("node", nodes(network));
    let boundary = |b: &lptn_network::Boundary| {
        format!("{} = {{ T = {} }}", b.name, value(network, &b.temperature, Type::ABSOLUTE_TEMPERATURE))
    };
    section("boundary", network.boundaries().iter().map(boundary).collect());
    section("resistor", network.conductors().iter().map(|c| resistor(network, c)).collect());
    let source = |s: &lptn_network::Source| {
        let power = value(network, &s.power, Type::of(Dimension::POWER));
        format!("{} = {{ into = {}, P = {power} }}", s.name(), into(network, &s.into))
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
                quantity(number, p.ty)
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
            let capacity = quantity(network.capacity(id), Type::of(Dimension::CAPACITY));
            let initial = quantity(network.initial(id), Type::ABSOLUTE_TEMPERATURE);
            format!("{} = {{ C = {capacity}, T0 = {initial} }}", node.name)
        })
        .collect()
}

/// A conductor of a reduced network: all of them are constant.
fn resistor(network: &Network, conductor: &Conductor) -> String {
    let end = |end: End| string(&network.name_of(end.into()));
    let law = match &conductor.law {
        Law::Resistance(r) => format!("R = {}", value(network, r, Type::of(Dimension::RESISTANCE))),
        law => {
            let conductance = law.conductance(&mut network.evaluation()).unwrap_or(f64::NAN);
            format!("G = {}", quantity(conductance, Type::of(Dimension::CONDUCTANCE)))
        }
    };
    format!("{} = {{ from = {}, to = {}, {law} }}", conductor.name(), end(conductor.from), end(conductor.to))
}

/// The node that a source heats, or the shares of several.
fn into(network: &Network, shares: &[(NodeId, f64)]) -> String {
    let name = |id: NodeId| &network.nodes()[id.index()].name;
    if let [(node, _)] = shares {
        return string(name(*node));
    }
    let shares: Vec<String> =
        shares.iter().map(|(node, share)| format!("{} = {}", name(*node), shortest(*share))).collect();
    format!("{{ {} }}", shares.join(", "))
}

/// A table of one argument; those of two come from files and cannot be written into a netlist.
fn table(name: &str, symbol: &TableSymbol) -> String {
    let Table::One(points) = &*symbol.table else { return format!("# {name}: a table of two arguments") };
    let x = symbol.arguments.first().copied().unwrap_or(Type::SCALAR);
    let outside = if points.outside() == Outside::Hold { "hold" } else { "error" };
    let interp = if points.interpolation() == Interpolation::Pchip { "pchip" } else { "linear" };
    format!(
        "{name} = {{ x = {}, y = {}, x_unit = {}, y_unit = {}, interp = \"{interp}\", outside = \"{outside}\" }}",
        list(points.knots()),
        list(points.values()),
        string(&unit(x)),
        string(&unit(symbol.ty))
    )
}

fn course(network: &Network, signal: &Signal) -> String {
    let name = &signal.name;
    let (times, values, interp, after) = match &signal.course {
        Course::Expression(expression) => {
            return format!("{name} = {}", value(network, expression, signal.ty));
        }
        Course::Steps { times, values, after } => (&times[..], &values[..], "previous", after),
        Course::Curve { points, after } => {
            let pchip = points.interpolation() == Interpolation::Pchip;
            (points.knots(), points.values(), if pchip { "pchip" } else { "linear" }, after)
        }
    };
    let after = match after {
        AfterEnd::Error => "after_end = \"error\"".to_owned(),
        AfterEnd::Hold => "after_end = \"hold\"".to_owned(),
        AfterEnd::Repeat(period) => {
            format!("after_end = \"repeat\", period = \"{} s\"", shortest(*period))
        }
    };
    format!(
        "{name} = {{ t = {}, v = {}, t_unit = \"s\", v_unit = {}, interp = \"{interp}\", {after} }}",
        list(times),
        list(values),
        string(&unit(signal.ty))
    )
}

fn list(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(|&x| shortest(x)).collect();
    format!("[{}]", texts.join(", "))
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

/// A value as TOML: an expression as it was written, anything else as the number it comes to.
fn value(network: &Network, value: &Value, ty: Type) -> String {
    match value {
        Value::Expression(program) => string(program.text()),
        other => quantity(other.at(&mut network.evaluation()).unwrap_or(f64::NAN), ty),
    }
}

fn quantity(number: f64, ty: Type) -> String {
    if ty.is_scalar() { shortest(number) } else { string(&format!("{} {}", shortest(number), unit(ty))) }
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
