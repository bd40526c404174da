//! The declarations of `[junction]` and `[branch]`.

use crate::format::{ABSOLUTE, Role, SectionDeclaration, Takes, akin, key, number, shaped, text};

pub(crate) const JUNCTION: SectionDeclaration = SectionDeclaration {
    name: "junction",
    sentence: "A place of one pressure in a flow network; its name is its pressure.",
    role: Role::Element,
    keys: &[
        key(
            "p",
            "Pa",
            "its pressure, if that is given: one junction is the reference",
            "\"0 bar\"",
        ),
        key("start", "Pa", "the pressure at which the search begins", "\"2 bar\"").or("`0 bar`"),
        key(
            "size",
            "Pa",
            "the size of its pressure, from which its tolerance follows",
            "\"100 Pa\"",
        )
        .or("`1 bar`"),
    ],
    example: "{ p = \"0 bar\" }",
    elsewhere: &[
        ("pressure", "the pressure is `p`"),
        ("flow", "a flow into a junction is a [branch] with `flow`"),
        ("inflow", "a flow into a junction is a [branch] with `flow`"),
        ("elevation", "heights have no effect: pressures are those at one height"),
        ("T", "a temperature belongs to a [node]; a [branch] names it as `flow_T`"),
    ],
    ..SectionDeclaration::NEW
};

pub(crate) const BRANCH: SectionDeclaration = SectionDeclaration {
    name: "branch",
    sentence: "A pipe, valve, orifice or pump between two junctions; its name is its mass flow.",
    role: Role::Element,
    keys: &[
        text("from", "name of a junction", "the end that a positive flow leaves", "\"tank\"")
            .needed(),
        text("to", "name of a junction", "the end that a positive flow enters", "\"rail\"")
            .needed(),
        akin(
            "flow",
            "quantity or expression",
            "its flow, which may depend on `dp`: of mass, or of volume with a density",
            "\"dp / (2e6 [Pa s/kg])\"",
        ),
        key(
            "resistance",
            "Pa s/m^3",
            "pressure difference over volume flow, laminar",
            "\"2e9 Pa s/m^3\"",
        ),
        number("zeta", "loss coefficient of the velocity in `area`", "1.5"),
        number("C_d", "discharge coefficient of an orifice of this `area`", "0.62"),
        key("area", "m^2", "with `zeta` or `C_d`: the cross-section", "\"20 mm^2\""),
        key("K_v", "m^3/s", "flow of water at 1 bar through a valve", "\"2.5 m^3/h\""),
        key("length", "m", "length of a pipe of this `diameter`", "\"1.2 m\""),
        key("diameter", "m", "with `length`: the inner diameter", "\"8 mm\""),
        key("roughness", "m", "with `length`: the roughness of the wall", "\"0.05 mm\"")
            .or("`0 m`"),
        shaped(
            "curve",
            "list",
            Takes::list(&Takes::List(&Takes::Text, 2, 2)),
            "a pump or fan: points of volume flow, rising, and pressure, falling",
            "[[\"0 l/min\", \"6 bar\"], [\"20 l/min\", \"0 bar\"]]",
        ),
        key("p_0", "Pa", "a pump or fan `p_0 - a V - b V^2`: its pressure at rest", "\"6 bar\""),
        key("a", "Pa s/m^3", "with `p_0`: the linear part", "\"1e8 Pa s/m^3\""),
        key("b", "Pa s^2/m^6", "with `p_0`: the quadratic part", "\"2e12 Pa s^2/m^6\""),
        number("speed", "speed of a pump or fan over that of its curve", "0.8").or("1"),
        number("efficiency", "of a pump or fan, for its power", "0.6").or("1"),
        key("dp_small", "Pa", "quadratic laws are laminar below this difference", "\"1 Pa\"")
            .or("`0.01 Pa`"),
        text("lubricant", "name of a lubricant", "the oil that flows, at `flow_T`", "\"oil\""),
        key("flow_T", ABSOLUTE, "with `lubricant`: temperature of the oil", "\"rail_node.T\""),
        key("density", "kg/m^3", "instead of `lubricant`: the density", "\"998 kg/m^3\""),
        key("viscosity", "Pa s", "with `density`: the dynamic viscosity", "\"1 mPa s\""),
    ],
    either: &[&["flow", "resistance", "zeta", "C_d", "K_v", "length", "curve", "p_0"]],
    example: "{ from = \"rail\", to = \"tank\", length = \"1.2 m\", diameter = \"8 mm\", \
        lubricant = \"oil\", flow_T = \"60 degC\" }",
    elsewhere: &[
        ("L", "the length of a pipe is `length`"),
        ("d", "the inner diameter is `diameter`"),
        ("D", "the inner diameter is `diameter`"),
        ("R", "the laminar resistance is `resistance`, in Pa s/m^3"),
        ("Kv", "the flow of a valve at 1 bar is `K_v`"),
        ("K", "the loss coefficient is `zeta`, with `area`"),
        ("A", "the cross-section is `area`"),
        ("rho", "the density is `density`"),
        ("mu", "the dynamic viscosity is `viscosity`"),
        ("nu", "the dynamic viscosity is `viscosity`: `nu` times the density"),
        ("fluid", "give `lubricant` with `flow_T`, or `density` and `viscosity`"),
        ("T", "the temperature of the fluid is `flow_T`"),
        ("dp", "the pressure difference follows from the junctions; a pump has `curve` or `p_0`"),
        ("mcp", "heat is carried by an [advection], whose `flow` or `mcp` reads this branch"),
    ],
    ..SectionDeclaration::NEW
};
