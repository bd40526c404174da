//! The same networks as netlists.

use std::fmt::Write as _;

use super::case::{Case, Element, Fan, Kind, Node, Read, Storage};
use super::laws::{
    AREA, BEARING, CP, DENSITY, DIAMETER, F1, FAR_MORE, GEAR, HARDNESS, K, LENGTH, MODULE, OIL,
    OTHER, PRESSURE, RADII, ROUGH, ROUGHNESS, RPM, SECOND, SLOPE, TEETH, THICKNESS, WIDTH,
    emissivity, exchange_area, joint, of_one_watt, of_shape, omega, torque,
};
use crate::features::{Feature, Shape};

/// A netlist on the way.
struct Text {
    text: String,
    tables: usize,
}

impl Case {
    pub(crate) fn text(&self) -> String {
        let mut out = Text { text: "format = 1\n".to_owned(), tables: 0 };
        out.line("[boundary]\nair = { T = \"20 degC\" }");
        self.nodes.iter().enumerate().for_each(|(i, node)| out.node(i, node));
        for (i, element) in self.elements.iter().enumerate() {
            out.element(i, element, self);
        }
        if let Some(fan) = &self.fan {
            out.fan(fan, &self.name(fan.other));
        }
        out.text
    }

    fn name(&self, vertex: usize) -> String {
        if vertex == self.air() { "air".to_owned() } else { format!("n{vertex}") }
    }
}

impl Text {
    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// `1 + ..` over a temperature, with the tables that it calls.
    fn factor(&mut self, features: &[Feature], temperature: &str, unit: &str) -> String {
        let mut factor = "(1".to_owned();
        for feature in features {
            if let Some((x, y)) = feature.table() {
                let smooth = matches!(feature.shape, Shape::Pchip(_));
                let interp = if smooth { "pchip" } else { "linear" };
                self.line(&format!(
                    "[table.shape{}]\nx = {x:?}\ny = {y:?}\ninterp = \"{interp}\"\noutside = \
                     \"hold\"",
                    self.tables
                ));
            }
            let _ = write!(factor, " + {}", feature.text(self.tables, temperature, unit));
            self.tables += 1;
        }
        factor + ")"
    }

    fn node(&mut self, i: usize, node: &Node) {
        let c = node.capacity;
        let stores = match &node.storage {
            Storage::Constant => format!("C = \"{c:?} J/K\""),
            Storage::Massless => return self.line(&format!("[node.n{i}]\nmassless = true")),
            Storage::Capacity(features) => {
                let x = self.factor(features, "T", "degC");
                format!("C = \"{c:?} [J/K] * {x}\"")
            }
            Storage::Material(features) => {
                let cp = self.property("J/(kg K)", c, features);
                self.line(&format!("[material.m{i}]\nsource = \"none\"\ncp = {cp}"));
                format!("material = \"m{i}\"\nmass = \"1 kg\"")
            }
            Storage::Melts { from, to, latent } => {
                self.line(&format!(
                    "[material.m{i}]\nsource = \"none\"\ncp = \"{c:?} J/(kg K)\"\nsolidus = \
                     \"{from:?} degC\"\nliquidus = \"{to:?} degC\"\nlatent_heat = \"{latent:?} J/kg\""
                ));
                format!("material = \"m{i}\"\nmass = \"1 kg\"")
            }
        };
        self.line(&format!("[node.n{i}]\nT0 = \"{:?} degC\"\n{stores}", node.start));
    }

    /// A property over its own temperature: a table of its own, or an expression.
    fn property(&mut self, unit: &str, size: f64, features: &[Feature]) -> String {
        if let [feature] = features
            && let (Some((x, y)), Shape::Table(_)) = (feature.table(), &feature.shape)
        {
            let x: Vec<f64> = x.iter().map(|x| feature.at + feature.width * x).collect();
            let y: Vec<f64> = y.iter().map(|y| size * (1.0 + feature.size * y)).collect();
            return format!(
                "{{ x = {x:?}, y = {y:?}, x_unit = \"degC\", y_unit = \"{unit}\", outside = \
                 \"hold\" }}"
            );
        }
        let x = self.factor(features, "T", "degC");
        format!("\"{size:?} [{unit}] * {x}\"")
    }

    fn element(&mut self, i: usize, element: &Element, case: &Case) {
        let (from, to) = (case.name(element.from), case.name(element.to));
        let ends = format!("from = \"{from}\"\nto = \"{to}\"");
        let (temperature, unit) = match element.read {
            Read::Own => ("T".to_owned(), "degC"),
            Read::From => ("T_from".to_owned(), "degC"),
            Read::To => ("T_to".to_owned(), "degC"),
            Read::Mean => ("T_mean".to_owned(), "degC"),
            Read::Difference => ("dT".to_owned(), "K"),
            Read::Named(vertex) => (format!("{}.T", case.name(vertex)), "degC"),
        };
        if element.kind.is_property() {
            return self.of_property(i, element, &ends);
        }
        let x = self.factor(&element.features, &temperature, unit);
        if element.kind.heats() {
            self.line(&loss(i, element, &to, &x));
        } else {
            self.line(&path(i, element, &ends, &x));
        }
    }

    fn fan(&mut self, fan: &Fan, other: &str) {
        let factor = self.factor(&fan.features, &format!("{other}.T"), "degC");
        let moved = match fan.features.is_empty() {
            true => String::new(),
            false => format!(" + 2 [K] * ({factor} - 1)"),
        };
        let (node, on, off) = (fan.node, fan.on, fan.off);
        self.line(&format!(
            "[control]\nfan = {{ sense = \"n{node}\", on_above = \"{on:?} [degC]{moved}\", off_below = \
             \"{off:?} [degC]{moved}\" }}\n[resistor.blown]\nfrom = \"n{node}\"\nto = \"air\"\nG = \
             \"{:?} [W/K] * fan\"",
            fan.more
        ));
    }

    fn of_property(&mut self, i: usize, element: &Element, ends: &str) {
        if element.kind == Kind::Enthalpy {
            let cp = self.property("J/(kg K)", CP, &element.features);
            let flow = element.size / CP;
            return self.line(&format!(
                "[fluid.f{i}]\nsource = \"none\"\ncp = {cp}\n[advection.e{i}]\n{ends}\nfluid = \
                 \"f{i}\"\nflow = \"{flow:?} kg/s\""
            ));
        }
        let k = element.size / of_shape(element.kind);
        let k = self.property("W/(m K)", k, &element.features);
        let [r_in, r_out] = RADII;
        let tube = format!("r_in = \"{r_in:?} m\"\nr_out = \"{r_out:?} m\"");
        let shape = match element.kind {
            Kind::MaterialSphere => format!("shape = \"sphere\"\n{tube}"),
            Kind::MaterialCylinder => {
                format!("shape = \"cylinder\"\n{tube}\nlength = \"{LENGTH:?} m\"")
            }
            _ => slab(),
        };
        self.line(&format!(
            "[material.k{i}]\nsource = \"none\"\nk = {k}\n[conduction.e{i}]\n{ends}\nmaterial = \
             \"k{i}\"\n{shape}"
        ));
    }
}

fn slab() -> String {
    format!("shape = \"slab\"\narea = \"{AREA:?} m^2\"\nthickness = \"{THICKNESS:?} m\"")
}

fn loss(i: usize, element: &Element, into: &str, x: &str) -> String {
    let size = element.size;
    let [f0, dip] = of_one_watt().map(|one| size * one);
    let into = format!("into = \"{into}\"");
    let bearing =
        format!("[bearing.e{i}]\n{into}\nspeed = \"{RPM:?} rpm\"\nd_m = \"{BEARING:?} mm\"");
    match element.kind {
        Kind::Power => format!("[source.e{i}]\n{into}\nP = \"{size:?} [W] * {x}\""),
        Kind::BearingLoad => {
            let load = size / (F1 * 1e-3 * BEARING * omega());
            format!("{bearing}\nmodel = \"load\"\nf1 = {F1:?}\nload = \"{load:?} [N] * {x}\"")
        }
        Kind::BearingOil => {
            format!("{bearing}\nmodel = \"no_load\"\nf0 = {f0:?}\nnu = \"{OIL:?} [mm^2/s] * {x}\"")
        }
        Kind::Mesh => {
            let [z1, z2] = TEETH;
            format!(
                "[mesh.e{i}]\n{into}\nmodel = \"external\"\nspeed = \"{RPM:?} rpm\"\ntorque = \"{:?} [N \
                 m] * {x}\"\nz1 = {z1}\nz2 = {z2}\nmodule = \"{MODULE:?} mm\"\nwidth = \"{WIDTH:?} \
                 mm\"\nRa = \"{ROUGH:?} um\"\nnu = \"{OIL:?} mm^2/s\"\ndensity = \"{DENSITY:?} kg/m^3\"",
                torque(size)
            )
        }
        _ => format!(
            "[churning.e{i}]\n{into}\nspeed = \"{RPM:?} rpm\"\npart = \"sides\"\nD = \"{GEAR:?} \
             mm\"\ndip = {dip:?}\nnu = \"{OIL:?} [mm^2/s] * {x}\""
        ),
    }
}

fn path(i: usize, element: &Element, ends: &str, x: &str) -> String {
    let (kind, size) = (element.kind, element.size);
    let section = match kind {
        Kind::Resistance | Kind::Conductance => "resistor",
        Kind::Film | Kind::FilmResistance => "convection",
        Kind::Contact | Kind::Pressure => "contact",
        Kind::Emissivity | Kind::Plates | Kind::ExchangeArea => "radiation",
        Kind::Slab | Kind::Rod => "conduction",
        Kind::Stream | Kind::Flow => "advection",
        _ => "cooler",
    };
    let keys = match kind {
        Kind::Resistance | Kind::FilmResistance => {
            format!("R = \"{:?} [K/W] * {x}\"", size.recip())
        }
        Kind::Conductance => format!("G = \"{size:?} [W/K] * {x}\""),
        Kind::Film | Kind::Contact => {
            let h = size / AREA;
            format!("area = \"{AREA:?} m^2\"\nh = \"{h:?} [W/(m^2 K)] * {x}\"")
        }
        Kind::Pressure => pressed(size, x),
        Kind::Emissivity | Kind::Plates | Kind::ExchangeArea => radiation(element, x),
        Kind::Slab => format!("{}\nk = \"{:?} [W/(m K)] * {x}\"", slab(), size / of_shape(kind)),
        Kind::Rod => format!(
            "shape = \"rod\"\ndiameter = \"{DIAMETER:?} m\"\nlength = \"{LENGTH:?} m\"\nk = \
             \"{:?} [W/(m K)] * {x}\"",
            size / of_shape(kind)
        ),
        Kind::Stream => format!("mcp = \"{size:?} [W/K] * {x}\""),
        Kind::Flow => {
            let flow = format!("fluid = \"f{i}\"\nflow = \"{:?} [kg/s] * {x}\"", size / CP);
            format!("{flow}\n[fluid.f{i}]\nsource = \"none\"\ncp = \"{CP:?} J/(kg K)\"")
        }
        _ => cooler(kind, size, x),
    };
    format!("[{section}.e{i}]\n{ends}\n{keys}")
}

fn pressed(size: f64, x: &str) -> String {
    let area = size * joint();
    format!(
        "area = \"{area:?} m^2\"\npressure = \"{PRESSURE:?} [Pa] * {x}\"\nhardness = \
         \"{HARDNESS:?} Pa\"\nslope = {SLOPE:?}\nroughness = \"{ROUGHNESS:?} m\"\nk = [\"{:?} \
         W/(m K)\", \"{:?} W/(m K)\"]",
        K[0], K[1]
    )
}

fn radiation(element: &Element, x: &str) -> String {
    let area = element.size * exchange_area();
    let e = emissivity(&element.features);
    match element.kind {
        Kind::Emissivity => format!("area = \"{area:?} m^2\"\nemissivity = \"{e:?} * {x}\""),
        Kind::Plates => {
            format!("area = \"{area:?} m^2\"\nemissivity = [\"{e:?} * {x}\", {SECOND:?}]")
        }
        _ => format!("Gr = \"{area:?} [m^2] * {x}\""),
    }
}

fn cooler(kind: Kind, size: f64, x: &str) -> String {
    let (form, other) = match kind {
        Kind::CoolerParallel => ("parallel", OTHER * size),
        Kind::CoolerShell => ("shell_and_tube", OTHER * size),
        Kind::CoolerFlow => ("counterflow", FAR_MORE * size),
        _ => ("counterflow", OTHER * size),
    };
    let own = format!("UA = \"{size:?} [W/K] * {x}\"");
    match kind {
        Kind::CoolerOne => format!("form = \"one_stream\"\nmcp = \"{size:?} W/K\"\n{own}"),
        Kind::CoolerFlow => format!(
            "form = \"{form}\"\nUA = \"{:?} W/K\"\nmcp = [\"{size:?} [W/K] * {x}\", \"{other:?} \
             W/K\"]",
            2.0 * size
        ),
        _ => {
            format!("form = \"{form}\"\nmcp = [\"{size:?} W/K\", \"{other:?} W/K\"]\n{own}")
        }
    }
}
