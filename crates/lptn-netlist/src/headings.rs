//! The headings of a netlist, and a netlist that runs.

use std::sync::LazyLock;

use lptn_laws::Kind;

pub(crate) const TOP_KEYS: [&str; 4] = ["format", "title", "description", "include"];

/// `[param]` has no keys of its own.
pub(crate) const PARAM: &str = "param";

/// Every section there is.
pub(crate) static SECTIONS: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let before =
        ["param", "table", "signal", "default", "material", "fluid", "node", "grid", "capacitor", "boundary"];
    let after = ["source", "control", "import", "limit", "template", "use", "run", "size", "fit"];
    let paths = Kind::ALL.iter().map(|kind| kind.declaration().section);
    before.into_iter().chain(paths).chain(after).collect()
});

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
