//! The words of the format: which sections and keys there are, and which are decided but not built yet.

pub(crate) use crate::headings::{MINIMAL, PARAM, SECTIONS, SECTIONS_LATER, TOP_KEYS};

use lptn_data::list;
use lptn_units::suggest;

/// A section of elements, or a section that is a table of its own.
#[derive(Debug)]
pub(crate) struct Section {
    /// Its heading; also what an element of it is called.
    pub(crate) name: &'static str,
    /// Its keys, or those of its elements.
    pub(crate) keys: &'static [&'static str],
    /// Keys that are decided but not supported yet.
    pub(crate) later: &'static [&'static str],
    /// The right side of an element, for help.
    pub(crate) example: &'static str,
    /// Help for keys that belong elsewhere.
    pub(crate) elsewhere: &'static [(&'static str, &'static str)],
}

pub(crate) const NODE: Section = Section {
    name: "node",
    keys: &["T0", "C", "material", "mass", "volume", "L_char", "massless"],
    later: &[],
    example: "{ T0 = \"25 degC\", C = \"500 J/K\" }",
    elsewhere: &[
        (
            "T",
            "a node's temperature is solved for: `T0` is its start, and a given temperature is a [boundary]",
        ),
        ("L", "the characteristic length is `L_char`"),
        ("P", "heat is put in by a [source]: `name = { into = \"node\", P = \"100 W\" }`"),
    ],
};

/// A block that is cut into cells.
pub(crate) const GRID: Section = Section {
    name: "grid",
    keys: &["size", "cells", "material", "k", "density", "cp", "T0"],
    later: &[],
    example: "{ size = [\"0.5 m\", \"0.5 m\", \"20 mm\"], cells = [20, 20, 4], material = \"steel_8620\" }",
    elsewhere: &[
        ("rho", "the density is `density`"),
        ("lambda", "the thermal conductivity is `k`"),
        ("C", "the capacity of a grid follows from its size and its `material`, or `density` and `cp`"),
        ("T", "the temperature at the start is `T0`"),
        ("area", "the areas follow from `size`"),
    ],
};

pub(crate) const CAPACITOR: Section = Section {
    name: "capacitor",
    keys: &["node", "C", "material", "mass", "volume"],
    later: &[],
    example: "{ node = \"a\", C = \"500 J/K\" }",
    elsewhere: &[("T0", "the temperature at the start belongs to the node")],
};

pub(crate) const BOUNDARY: Section = Section {
    name: "boundary",
    keys: &["T"],
    later: &[],
    example: "{ T = \"25 degC\" }",
    elsewhere: &[
        ("T0", "the temperature of a boundary is `T`"),
        ("C", "a boundary keeps its temperature whatever flows in; what has a capacity is a [node]"),
    ],
};

pub(crate) const FLUID: Section = Section {
    name: "fluid",
    keys: &["density", "cp", "source"],
    later: &["k", "viscosity"],
    example: "{ density = \"870 kg/m^3\", cp = \"2000 J/(kg K)\" }",
    elsewhere: &[
        ("c", "the specific heat capacity is `cp`"),
        ("rho", "the density is `density`"),
        ("flow", "the flow belongs to the [advection] that carries the fluid"),
    ],
};

/// `[template.NAME]`, for help; what it holds is read by itself.
pub(crate) const TEMPLATE: Section = Section {
    name: "template",
    keys: &["param", "port"],
    later: &[],
    example: "`port = [\"in\", \"out\"]` and elements below `[template.planet.node]`",
    elsewhere: &[],
};

pub(crate) const USE: Section = Section {
    name: "use",
    keys: &["template", "count", "connect", "set"],
    later: &[],
    example: "{ template = \"planet\", count = 3, connect = { carrier = \"carrier\" } }",
    elsewhere: &[
        ("param", "parameters of the template are given in `set`: `set = { ratio = 0.5 }`"),
        ("port", "what a port leads to stands in `connect`: `connect = { carrier = \"carrier\" }`"),
        ("ports", "what a port leads to stands in `connect`: `connect = { carrier = \"carrier\" }`"),
        ("n", "how many there are is `count`"),
    ],
};

/// A parameter of a template without a value of its own: `R = { unit = "K/W" }`.
pub(crate) const OPEN_PARAMETER: Section = Section {
    name: "param",
    keys: &["unit"],
    later: &[],
    example: "{ unit = \"K/W\" }",
    elsewhere: &[
        ("value", "a value of its own stands alone: `m = \"0.2 kg\"`"),
        ("default", "a value of its own stands alone: `m = \"0.2 kg\"`"),
    ],
};

/// What a template cannot hold.
pub(crate) const NOT_IN_TEMPLATE: [&str; 9] =
    ["default", "material", "fluid", "run", "size", "template", "import", "sweep", "fit"];

/// The sections whose entries share no names with elements: values, substances, studies.
pub(crate) const ELSEWHERE: [&str; 14] = [
    "param", "signal", "table", "control", "material", "fluid", "default", "run", "size", "template", "use",
    "import", "sweep", "fit",
];

/// A table of `[table]`, and a property over temperature.
pub(crate) const TABLE: Section = Section {
    name: "table",
    keys: &["x", "y", "x_unit", "y_unit", "csv", "value", "interp", "outside"],
    later: &[],
    example: "{ x = [\"0 rpm\", \"5000 rpm\"], y = [\"0 W\", \"80 W\"] }",
    elsewhere: &[
        ("after_end", "outside its points a table has `outside = \"hold\"`"),
        ("t", "values over time are a [signal]; the arguments of a table are `x`"),
    ],
};

pub(crate) const SIGNAL: Section = Section {
    name: "signal",
    keys: &["t", "v", "t_unit", "v_unit", "csv", "time", "value", "interp", "after_end", "period"],
    later: &[],
    example: "{ t = [\"0 s\", \"60 s\"], v = [\"0 rpm\", \"5000 rpm\"] }",
    elsewhere: &[
        ("outside", "after its last point a signal has `after_end = \"hold\"` or `\"repeat\"`"),
        ("x", "the times of a signal are `t`"),
        ("y", "the values of a signal are `v`"),
    ],
};

pub(crate) const SOURCE: Section = Section {
    name: "source",
    keys: &["into", "P"],
    later: &[],
    example: "{ into = \"a\", P = \"100 W\" }",
    elsewhere: &[("node", "the node that is heated is `into`"), ("to", "the node that is heated is `into`")],
};

pub(crate) const CONTROL: Section = Section {
    name: "control",
    keys: &["sense", "on_above", "off_below", "on_below", "off_above", "start", "min_dwell"],
    later: &[],
    example: "{ sense = \"a\", on_above = \"60 degC\", off_below = \"55 degC\" }",
    elsewhere: &[
        ("kind", "every control is a thermostat: leave `kind` out"),
        ("type", "every control is a thermostat: leave `type` out"),
        ("node", "the node or boundary that is felt is `sense`"),
        ("of", "the node or boundary that is felt is `sense`"),
        ("sensor", "the node or boundary that is felt is `sense`"),
        (
            "setpoint",
            "give both thresholds: `on_above` and `off_below` for cooling, `on_below` and `off_above` for heating",
        ),
        (
            "hysteresis",
            "give both thresholds: `on_above` and `off_below` for cooling, `on_below` and `off_above` for heating",
        ),
        (
            "band",
            "give both thresholds: `on_above` and `off_below` for cooling, `on_below` and `off_above` for heating",
        ),
        ("initial", "whether it is on at the start is `start`"),
        ("dwell", "the least time between two switches is `min_dwell`"),
        ("P", "what it switches uses its name, which is 0 or 1: `P = \"100 [W] * name\"` of a [source]"),
    ],
};

pub(crate) const LIMIT: Section = Section {
    name: "limit",
    keys: &["of", "below", "above", "severity"],
    later: &[],
    example: "{ of = \"a.T\", below = \"110 degC\" }",
    elsewhere: &[
        ("node", "what is limited is `of`, for example `of = \"a.T\"`"),
        ("max", "the highest value that is allowed is `below`"),
        ("min", "the lowest value that is allowed is `above`"),
    ],
};

pub(crate) const MATERIAL: Section = Section {
    name: "material",
    keys: &["density", "cp", "k", "solidus", "liquidus", "latent_heat", "source"],
    later: &[],
    example: "{ density = \"7850 kg/m^3\", cp = \"475 J/(kg K)\" }",
    elsewhere: &[
        ("c", "the specific heat capacity is `cp`"),
        ("rho", "the density is `density`"),
        ("lambda", "the thermal conductivity is `k`"),
        ("mass", "the mass belongs to the node or capacitor that is made of the material"),
        ("volume", "the volume belongs to the node or capacitor that is made of the material"),
    ],
};

pub(crate) const DEFAULT: Section = Section {
    name: "default",
    keys: &["T0", "temperature_unit"],
    later: &[],
    example: "{ T0 = \"25 degC\" }",
    elsewhere: &[],
};

pub(crate) const RUN: Section = Section {
    name: "run",
    keys: &["stop", "start", "initial", "output", "select", "report", "window", "tolerance", "integrator"],
    later: &[],
    example: "{ stop = \"25 min\" }",
    elsewhere: &[
        ("every", "write `output = { every = \"5 s\" }`"),
        ("at", "write `output = { at = [\"5 s\"] }`"),
    ],
};

/// Elements from CSV files.
pub(crate) const IMPORT: Section = Section {
    name: "import",
    keys: &["nodes", "boundaries", "conductors", "sources"],
    later: &[],
    example: "{ nodes = \"nodes.csv\", conductors = \"conductors.csv\" }",
    elsewhere: &[
        ("node", "did you mean `nodes`?"),
        ("boundary", "did you mean `boundaries`?"),
        ("conductor", "did you mean `conductors`?"),
        ("resistors", "paths between two ends are `conductors`"),
        ("source", "did you mean `sources`?"),
    ],
};

pub(crate) const SIZE: Section = Section {
    name: "size",
    keys: &["minimise", "maximise", "vary", "require", "over"],
    later: &["catalogue"],
    example: "{ minimise = \"p\", vary = { p = { from = \"..\", to = \"..\" } }, require = [\"a.T <= 80 [degC]\"] }",
    elsewhere: &[
        ("minimize", "did you mean `minimise`?"),
        ("maximize", "did you mean `maximise`?"),
        ("from", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
        ("to", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
    ],
};

/// `p = { from = .., to = .. }` in `vary` of a size or fit.
pub(crate) const VARY: Section = Section {
    name: "vary",
    keys: &["from", "to"],
    later: &[],
    example: "{ from = \"1 W/K\", to = \"10 W/K\" }",
    elsewhere: &[
        ("min", "the least value is `from`"),
        ("lower", "the least value is `from`"),
        ("max", "the largest value is `to`"),
        ("upper", "the largest value is `to`"),
    ],
};

/// `climb = { from = .., to = .. }` in `window` of `[run]`.
pub(crate) const WINDOW: Section = Section {
    name: "window",
    keys: &["from", "to"],
    later: &[],
    example: "{ from = \"10 min\", to = \"20 min\" }",
    elsewhere: &[],
};

/// `output = { .. }` of `[run]`.
pub(crate) const OUTPUT: Section = Section {
    name: "output",
    keys: &["every", "at"],
    later: &[],
    example: "{ every = \"5 s\" }",
    elsewhere: &[],
};

impl Section {
    /// What to do about a key that this section does not have.
    pub(crate) fn help_for(&self, key: &str) -> String {
        if let Some((_, help)) = self.elsewhere.iter().find(|(name, _)| *name == key) {
            return (*help).to_owned();
        }
        match suggest(key, self.keys.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the keys here are {}", list(self.keys)),
        }
    }
}
