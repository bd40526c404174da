//! The headings of a netlist, and a netlist that runs.

pub(crate) const TOP_KEYS: [&str; 4] = ["format", "title", "description", "include"];

/// `[param]` has no keys of its own.
pub(crate) const PARAM: &str = "param";

/// Every section there is.
pub(crate) const SECTIONS: [&str; 25] = [
    "param",
    "table",
    "signal",
    "default",
    "material",
    "fluid",
    "node",
    "grid",
    "capacitor",
    "boundary",
    "resistor",
    "conduction",
    "convection",
    "contact",
    "radiation",
    "advection",
    "source",
    "control",
    "import",
    "limit",
    "template",
    "use",
    "run",
    "size",
    "fit",
];

/// What the format has for later.
pub(crate) const SECTIONS_LATER: [&str; 1] = ["sweep"];

/// A netlist that runs.
pub(crate) const MINIMAL: &str = "a small netlist that runs:\n\
    \n\
    format = 1\n\
    \n\
    [node]\n\
    block = { T0 = \"25 degC\", C = \"500 J/K\" }\n\
    \n\
    [boundary]\n\
    air = { T = \"25 degC\" }\n\
    \n\
    [resistor]\n\
    cooling = { from = \"block\", to = \"air\", R = \"0.3 K/W\" }\n\
    \n\
    [source]\n\
    loss = { into = \"block\", P = \"100 W\" }\n\
    \n\
    [run]\n\
    stop = \"25 min\"\n";
