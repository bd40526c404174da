//! The network of a case, built through the public API.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Arc;

use lptn::prelude::*;
use lptn_network::{
    AfterEnd, Area, ConductorId, ConductorKind, Context, Course, End, FilmCoefficient, Input, Item,
    Path,
};
use lptn_units::{
    Dimension, Interpolation as Join, LookupTable as Curve, Outside, Table1, TableSymbol, Type,
};

use super::calibration;
use super::case::{
    At, Calibrated, CapacityCurve, Case, Edge, Gate, Interpolation, Node, Source, Table, Target,
    TimeFunction,
};

/// The Stefan-Boltzmann constant of the SI in W/(m^2 K^4), which lptn computes with.
const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// A case as lptn knows it.
pub struct Model {
    pub system: ThermalSystem,
    pub ends: BTreeMap<String, End>,
    pub edges: BTreeMap<String, ConductorId>,
}

impl Model {
    /// Builds the network.
    ///
    /// # Errors
    /// What lptn says about it, or that lptn has no such element.
    pub fn new(case: &Case) -> Result<Self, String> {
        Self::built(case, &[])
    }

    /// Builds the network with what is to be calibrated as parameters.
    ///
    /// # Errors
    /// What lptn says about it, or a field that cannot be calibrated here.
    pub fn calibrating(case: &Case) -> Result<Self, String> {
        Self::built(
            case,
            case.calibration.as_ref().map_or(&[], |calibration| &calibration.parameters),
        )
    }

    fn built(case: &Case, calibrated: &[Calibrated]) -> Result<Self, String> {
        let mut building = Building {
            b: NetworkBuilder::new(),
            zero: case.zero(),
            ends: BTreeMap::new(),
            edges: BTreeMap::new(),
            signals: 0,
            targets: Vec::new(),
            met: Cell::new(0),
        };
        for parameter in calibrated {
            let name = calibration::parameter(&parameter.name);
            building.b.parameter(&name, Input::number(parameter.initial));
            building
                .targets
                .extend(parameter.targets.iter().map(|target| (target.clone(), name.clone())));
        }
        case.nodes.iter().try_for_each(|node| building.node(node))?;
        case.edges.iter().try_for_each(|edge| building.edge(edge))?;
        case.sources.iter().try_for_each(|source| building.source(source))?;
        if building.met.get() != building.targets.len() {
            return Err("a field of a target cannot be calibrated".to_owned());
        }
        let Building { b, ends, edges, .. } = building;
        let network = b.build().map_err(|e| e.to_string())?;
        let system = ThermalSystem::assemble(&network).map_err(|e| e.to_string())?;
        Ok(Self { system, ends, edges })
    }

    /// A network from elsewhere that is to answer for a case. Nodes and edges bear the names of the
    /// case, or those that `names` pairs with them.
    ///
    /// # Errors
    /// What lptn says about it.
    pub fn of(network: &Network, case: &Case, names: &[(&str, &str)]) -> Result<Self, String> {
        let system = ThermalSystem::assemble(network).map_err(|e| e.to_string())?;
        let item = |id: &str| {
            let name = names.iter().find(|(theirs, _)| *theirs == id).map_or(id, |(_, ours)| ours);
            network.item(name).ok()
        };
        let mut model = Self { system, ends: BTreeMap::new(), edges: BTreeMap::new() };
        for node in &case.nodes {
            let end = match item(node.id()) {
                Some(Item::Node(id)) => End::Node(id),
                Some(Item::Boundary(id)) => End::Boundary(id),
                _ => return Err(format!("`{}` is not a node of the network", node.id())),
            };
            model.ends.insert(node.id().to_owned(), end);
        }
        for edge in &case.edges {
            if let Some(Item::Conductor(id)) = item(edge.id()) {
                model.edges.insert(edge.id().to_owned(), id);
            }
        }
        Ok(model)
    }
}

pub struct Building {
    pub b: NetworkBuilder,
    zero: f64,
    ends: BTreeMap<String, End>,
    edges: BTreeMap<String, ConductorId>,
    signals: usize,
    /// Fields that are parameters, and their names.
    targets: Vec<(Target, String)>,
    /// How many of them were met.
    met: Cell<usize>,
}

/// A unit as expressions write it, and its type.
#[derive(Clone, Copy)]
pub enum Unit {
    Kelvin,
    Watt,
    WattPerKelvin,
}

impl Unit {
    fn text(self) -> &'static str {
        match self {
            Self::Kelvin => "K",
            Self::Watt => "W",
            Self::WattPerKelvin => "W/K",
        }
    }

    fn ty(self) -> Type {
        match self {
            Self::Kelvin => Type::ABSOLUTE_TEMPERATURE,
            Self::Watt => Type::of(Dimension::POWER),
            Self::WattPerKelvin => Type::of(Dimension::CONDUCTANCE),
        }
    }
}

/// A name that lptn accepts and that says what it stands for: names of a case may be reserved
/// words, and a node and an edge may share one.
pub fn name(kind: &str, id: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    format!("{kind}_{}", id.chars().map(plain).collect::<String>())
}

impl Building {
    pub fn end(&self, id: &str) -> Result<End, String> {
        self.ends.get(id).copied().ok_or_else(|| format!("there is no node `{id}`"))
    }

    /// What a field is a multiple of, if it is calibrated: the parameter, with its scale.
    fn factor(&self, place: (&str, &str, &str)) -> Option<String> {
        let is_it = |(target, _): &&(Target, String)| {
            (target.list.as_str(), target.id.as_str(), target.field.as_str()) == place
        };
        let (target, name) = self.targets.iter().find(is_it)?;
        self.met.set(self.met.get() + 1);
        Some(format!("{name} * {}", target.scale.unwrap_or(1.0)))
    }

    /// A constant of the case, or the parameter in its place.
    fn number(&self, place: (&str, &str, &str), plain: impl Into<Input>) -> Result<Input, String> {
        let plain = plain.into();
        let Some(factor) = self.factor(place) else { return Ok(plain) };
        self.expression(
            Context::Time,
            &format!("{factor} * 1 [{}]", plain.ty().dimension.si_unit()),
        )
    }

    /// A temperature of the case, or the parameter in its place, a number on the case's scale.
    fn temperature(&self, place: (&str, &str, &str), plain: Input) -> Result<Input, String> {
        let Some(factor) = self.factor(place) else { return Ok(plain) };
        let zero = self.zero;
        self.expression(Context::Time, &format!("absolute(({factor} + {zero}) * 1 [K])"))
    }

    pub fn expression(&self, context: Context, text: &str) -> Result<Input, String> {
        let program = self.b.expression_in(context, text, None);
        program.map(Input::from).map_err(|errors| format!("`{text}`: {errors:?}"))
    }

    fn node(&mut self, node: &Node) -> Result<(), String> {
        let (id, end) = match node {
            Node::Capacitance { id, capacity, initial, over_temperature } => {
                let capacity = match over_temperature {
                    None => self.number(("nodes", id, "C"), HeatCapacity(*capacity))?,
                    Some(curve) => self.capacity(id, *capacity, curve)?,
                };
                let initial = Temperature(initial + self.zero);
                let initial = self.temperature(("nodes", id, "T0"), initial.into())?;
                (id, self.b.node(&name("node", id), capacity, initial).into())
            }
            Node::Massless { id, .. } => (id, self.b.massless(&name("node", id)).into()),
            Node::Boundary { id, temperature } => {
                let plain = self.of_time(temperature, Unit::Kelvin)?;
                let temperature = self.temperature(("nodes", id, "T"), plain)?;
                (id, self.b.boundary(&name("node", id), temperature).into())
            }
        };
        match self.ends.insert(id.clone(), end) {
            Some(_) => Err(format!("there are two nodes `{id}`")),
            None => Ok(()),
        }
    }

    fn capacity(
        &mut self,
        id: &str,
        capacity: f64,
        curve: &CapacityCurve,
    ) -> Result<Input, String> {
        let text = match curve {
            CapacityCurve::Linear { beta, reference } => {
                let rise = format!("(T - absolute({} [K]))", reference + self.zero);
                format!("{capacity} [J/K] * (1 + ({beta} [1/K]) * {rise})")
            }
            CapacityCurve::Table { temperatures, factor } => {
                let table = name("table", id);
                let x = temperatures.iter().map(|t| t + self.zero).collect();
                let points = points(x, factor.clone())?;
                let arguments = vec![Type::ABSOLUTE_TEMPERATURE];
                let table_of = TableSymbol {
                    table: Arc::new(Curve::One(points)),
                    arguments,
                    ty: Type::SCALAR,
                    units: Vec::new(),
                };
                self.b.table(&table, table_of);
                format!("{capacity} [J/K] * {table}(T)")
            }
        };
        self.expression(Context::Own, &text)
    }

    fn edge(&mut self, edge: &Edge) -> Result<(), String> {
        let ((id, a, b), kind, path) = match edge {
            Edge::Conductance { id, a, b, conductance } => {
                let conductance = self.number(("edges", id, "G"), Conductance(*conductance))?;
                ((id, a, b), ConductorKind::Resistor, Path::conductance(conductance))
            }
            Edge::Convection { id, a, b, h, area } => {
                let h = self.number(("edges", id, "h"), FilmCoefficient(*h))?;
                let area = self.number(("edges", id, "A"), Area(*area))?;
                ((id, a, b), ConductorKind::Convection, Path::film(h, area))
            }
            Edge::ConvectionPower { id, a, b, c, n } => {
                let g = format!("{c} [W/K] * abs(dT / 1 [K])^({n})");
                (
                    (id, a, b),
                    ConductorKind::Convection,
                    Path::conductance(self.expression(Context::Link, &g)?),
                )
            }
            Edge::ConductanceLinear { id, a, b, conductance, beta, reference, at } => {
                let at = match at {
                    At::Mean => "T_mean",
                    At::A => "T_from",
                    At::B => "T_to",
                };
                let rise = format!("({at} - absolute({} [K]))", reference + self.zero);
                let g = format!("{conductance} [W/K] * (1 + ({beta} [1/K]) * {rise})");
                (
                    (id, a, b),
                    ConductorKind::Resistor,
                    Path::conductance(self.expression(Context::Link, &g)?),
                )
            }
            Edge::Radiation { id, a, b, exchange, sigma } => {
                // books print 5.67e-8: their constant goes into the area, for lptn has the exact
                // one
                let share = sigma / STEFAN_BOLTZMANN;
                let area = match self.factor(("edges", id, "epsA")) {
                    None => Area(exchange * share).into(),
                    Some(factor) => {
                        self.expression(Context::Time, &format!("{factor} * {share} * 1 [m^2]"))?
                    }
                };
                ((id, a, b), ConductorKind::Radiation, Path::radiation(area))
            }
            Edge::Advection { id, a, b, mcp } => {
                let stream = Path::stream(self.of_time(mcp, Unit::WattPerKelvin)?);
                ((id, a, b), ConductorKind::Advection, stream)
            }
        };
        let conductor =
            self.b.conductor(&name("edge", id), kind, (self.end(a)?, self.end(b)?), path);
        match self.edges.insert(id.clone(), conductor) {
            Some(_) => Err(format!("there are two edges `{id}`")),
            None => Ok(()),
        }
    }

    fn source(&mut self, source: &Source) -> Result<(), String> {
        let rise = |reference: f64| format!("(T - absolute({} [K]))", reference + self.zero);
        let (id, node, power) = match source {
            Source::Heat { id, node, heat, coefficient: None, gate: None } => {
                (id, node, self.heat(id, heat)?)
            }
            Source::Heat { id, node, heat, coefficient, gate } => {
                let factor = coefficient.as_ref().map_or("1".to_owned(), |c| {
                    format!("(1 + ({} [1/K]) * {})", c.alpha, rise(c.reference))
                });
                let heat = self.text(heat, Unit::Watt)?;
                (id, node, self.gated((id, gate.as_ref()), &format!("({heat}) * {factor}"))?)
            }
            Source::Resistor { id, node, voltage, resistance, alpha, reference, gate } => {
                let cold = voltage * voltage / resistance;
                let text = format!("{cold} [W] / (1 + ({alpha} [1/K]) * {})", rise(*reference));
                (id, node, self.gated((id, gate.as_ref()), &text)?)
            }
        };
        self.b.source(&name("source", id), self.end(node)?, power);
        Ok(())
    }

    /// The heat of a source. A parameter stands for it, or multiplies its table.
    fn heat(&mut self, id: &str, heat: &TimeFunction) -> Result<Input, String> {
        let Some(factor) = self.factor(("sources", id, "Q")) else {
            return self.of_time(heat, Unit::Watt);
        };
        match heat {
            TimeFunction::Constant(_) => {
                self.expression(Context::Source, &format!("{factor} * 1 [W]"))
            }
            table => {
                let table = self.text(table, Unit::Watt)?;
                self.expression(Context::Source, &format!("{factor} * ({table})"))
            }
        }
    }

    /// The heat of a source, where a gate lets it through.
    fn gated(&mut self, (id, gate): (&str, Option<&Gate>), heat: &str) -> Result<Input, String> {
        let Some(gate) = gate else { return self.expression(Context::Source, heat) };
        let open = self.gate(id, gate)?;
        self.expression(Context::Source, &format!("{heat} * {open}"))
    }

    fn of_time(&mut self, of_time: &TimeFunction, unit: Unit) -> Result<Input, String> {
        match *of_time {
            TimeFunction::Constant(value) => Ok(match unit {
                Unit::Kelvin => Temperature(value + self.zero).into(),
                Unit::Watt => HeatFlow(value).into(),
                Unit::WattPerKelvin => Conductance(value).into(),
            }),
            _ => {
                let text = self.text(of_time, unit)?;
                self.expression(Context::Time, &text)
            }
        }
    }

    /// A function of time as an expression; a table becomes a signal first.
    pub fn text(&mut self, of_time: &TimeFunction, unit: Unit) -> Result<String, String> {
        let literal = |value: f64| match unit {
            Unit::Kelvin => format!("absolute({} [K])", value + self.zero),
            _ => format!("{value} [{}]", unit.text()),
        };
        match of_time {
            TimeFunction::Constant(value) => Ok(literal(*value)),
            TimeFunction::Sine(s) => {
                let mean = literal(s.mean);
                let swing = format!("sin(({} [1/s]) * t + ({}))", s.omega, s.phase);
                Ok(format!("{mean} + ({} [{}]) * {swing}", s.amp, unit.text()))
            }
            TimeFunction::Table(table) => {
                let offset = if matches!(unit, Unit::Kelvin) { self.zero } else { 0.0 };
                let signal = format!("signal_{}", self.signals);
                self.signals += 1;
                self.b.signal(&signal, unit.ty(), course(table, offset)?);
                Ok(signal)
            }
        }
    }
}

/// A table of the format: its first value holds before it, its last one after it, and a period
/// wraps time.
fn course(table: &Table, offset: f64) -> Result<Course, String> {
    let mut times = table.t.clone();
    let mut values: Vec<f64> = table.v.iter().map(|v| v + offset).collect();
    if times.is_empty() || times.len() != values.len() {
        return Err(format!("a table of {} times and {} values", times.len(), values.len()));
    }
    if times[0] > 0.0 {
        times.insert(0, 0.0);
        values.insert(0, values[0]);
    }
    let after = match table.period {
        None => AfterEnd::Hold,
        // wrapped time begins at 0, and so does a table that repeats
        Some(period) if times[0] == 0.0 => AfterEnd::Repeat(period),
        Some(_) => return Err("a table that repeats has to begin at 0".to_owned()),
    };
    Ok(match table.interp {
        Interpolation::Linear => Course::Curve { points: points(times, values)?, after },
        Interpolation::Previous => Course::Steps { times, values, after },
    })
}

fn points(x: Vec<f64>, y: Vec<f64>) -> Result<Table1, String> {
    Table1::new(x, y, Join::Linear, Outside::Hold).map_err(|e| e.to_string())
}
