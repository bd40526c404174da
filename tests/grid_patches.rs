//! Rectangles and circles of faces of grids, by place: shares of cells, heat, films and means.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use std::f64::consts::PI;

use lptn::prelude::*;
use support::{celsius, close, heat, parsed, settled, transient};

/// A plate of 60 x 40 x 2 mm whose z0 is cooled, with a patch that loses 10 W.
fn plate(cells: [usize; 3], patch: &str) -> String {
    format!(
        r#"
format = 1
[grid.board]
size = ["60 mm", "40 mm", "2 mm"]
cells = {cells:?}
k = "150 W/(m K)"
density = "2700 kg/m^3"
cp = "900 J/(kg K)"
T0 = "20 degC"
patch = {{ chip = {{ on = "z1", {patch} }} }}
[boundary]
air = {{ T = "20 degC" }}
[convection]
cold = {{ from = "board.z0", to = "air", h = "200 W/(m^2 K)" }}
[source]
loss = {{ into = "board.chip", P = "10 W" }}
"#
    )
}

const RECTANGLE: &str = "centre = [\"15 mm\", \"24 mm\"], size = [\"10 mm\", \"8 mm\"]";
const CIRCLE: &str = "centre = [\"45 mm\", \"15 mm\"], radius = \"4 mm\"";

/// A temperature of the steady state.
fn celsius_of(text: &str, name: &str) -> f64 {
    let (netlist, steady) = settled(text);
    celsius(&netlist, &steady, name)
}

/// Mean over the heated place, in K above the air, by the double Fourier series of a plate with a
/// uniform flux on a rectangle or a circle and a film at the back (Y. S. Muzychka, J. R. Culham and
/// M. M. Yovanovich, J. Electronic Packaging 125 (2003) 178), summed by NumPy over 4000 x 4000
/// terms.
#[test]
fn a_heated_patch_agrees_with_the_fourier_series() {
    for (patch, exact) in [(RECTANGLE, 30.486_754), (CIRCLE, 32.248_82)] {
        let errors = [[30, 20, 2], [60, 40, 4], [120, 80, 8]]
            .map(|cells| celsius_of(&plate(cells, patch), "board.chip.T") - 20.0 - exact);
        assert!(errors[2].abs() < 0.03, "{patch}: {errors:?}");
        assert!(errors[2].abs() < 0.4 * errors[0].abs(), "{patch}: {errors:?}");
    }
}

/// A disc around the axis of a rod of 20 mm, 30 W, film at the other end: the series over the zeros
/// of J_1 gives 94.705409 K (SciPy, 20 000 terms).
#[test]
fn a_disc_on_a_rod_agrees_with_the_bessel_series() {
    let rod = |rings: usize, layers: usize| {
        format!(
            r#"
format = 1
[grid.rod]
shape = "cylinder"
r_out = "20 mm"
length = "10 mm"
cells = [{rings}, 1, {layers}]
k = "50 W/(m K)"
density = "7800 kg/m^3"
cp = "460 J/(kg K)"
T0 = "20 degC"
patch = {{ spot = {{ on = "z1", radius = "8 mm" }} }}
[boundary]
air = {{ T = "20 degC" }}
[convection]
cold = {{ from = "rod.z0", to = "air", h = "300 W/(m^2 K)" }}
[source]
loss = {{ into = "rod.spot", P = "30 W" }}
"#
        )
    };
    let errors = [(10, 5), (20, 10), (40, 20)]
        .map(|(rings, layers)| celsius_of(&rod(rings, layers), "rod.spot.T") - 20.0 - 94.705_409);
    assert!(errors[2].abs() < 0.08 && errors[2].abs() < 0.4 * errors[0].abs(), "{errors:?}");
}

/// A body that conducts so well that it has one temperature: P = h A (T - T_air), with A by
/// geometry, whatever the cells cut.
#[test]
fn a_film_on_a_patch_has_its_exact_area() {
    let block = r#"
format = 1
[grid.part]
size = ["60 mm", "40 mm", "2 mm"]
cells = CELLS
k = "1e9 W/(m K)"
density = "2700 kg/m^3"
cp = "900 J/(kg K)"
T0 = "20 degC"
patch = { spot = { on = "z1", PATCH } }
[boundary]
air = { T = "20 degC" }
[convection]
lid = { from = "part.spot", to = "air", h = "50 W/(m^2 K)" }
[source]
loss = { into = "part", P = "1 W" }
"#;
    let rod = block.replace(
        "size = [\"60 mm\", \"40 mm\", \"2 mm\"]",
        "shape = \"cylinder\"\nr_out = \"20 mm\"\nr_in = \"5 mm\"\nlength = \"30 mm\"",
    );
    let cases = [
        (
            block,
            "[7, 5, 1]",
            "z1",
            "centre = [\"45 mm\", \"15 mm\"], radius = \"4 mm\"",
            PI * 16e-6,
        ),
        (block, "[7, 5, 1]", "z1", "radius = \"20 mm\"", PI * 400e-6),
        (block, "[7, 5, 3]", "x1", "size = [\"13 mm\", \"1.5 mm\"]", 13e-3 * 1.5e-3),
        (block, "[1, 1, 1]", "y0", "size = [\"60 mm\", \"2 mm\"]", 60e-3 * 2e-3),
        // a window of a mantle, across the seam of the circle
        (
            &rod,
            "[3, 12, 5]",
            "outer",
            "centre = [\"0 deg\", \"10 mm\"], size = [\"100 deg\", \"9 mm\"]",
            100.0 * PI / 180.0 * 20e-3 * 9e-3,
        ),
        (&rod, "[3, 12, 5]", "inner", "size = [\"360 deg\", \"9 mm\"]", 2.0 * PI * 5e-3 * 9e-3),
        // a ring of an end, from 8 to 12 mm
        (
            &rod,
            "[4, 6, 2]",
            "z1",
            "centre = [\"10 mm\", \"30 deg\"], size = [\"4 mm\", \"90 deg\"]",
            PI / 4.0 * (144e-6 - 64e-6),
        ),
    ];
    for (text, cells, face, patch, area) in cases {
        let text = text.replace("CELLS", cells).replace("on = \"z1\"", &format!("on = \"{face}\""));
        let (netlist, steady) = settled(&text.replace("PATCH", patch));
        close(
            celsius(&netlist, &steady, "part.spot.T"),
            20.0 + 1.0 / (50.0 * area),
            1e-4 / area * 1e-3,
        );
        close(heat(&netlist, &steady, "lid"), 1.0, 1e-9);
    }
}

/// A temperature that is linear along x has its mean in the middle of a patch, also of one that
/// cuts cells: T = 20 degC + 1 K / (k A) x, 6 W along 60 mm.
#[test]
fn the_mean_of_a_linear_temperature_is_that_of_the_middle() {
    let text = r#"
format = 1
[grid.bar]
size = ["60 mm", "40 mm", "2 mm"]
cells = [60, 4, 1]
k = "100 W/(m K)"
density = "2700 kg/m^3"
cp = "900 J/(kg K)"
T0 = "20 degC"
patch = { a = { on = "z1", centre = ["15 mm", "20 mm"], size = ["10 mm", "7 mm"] }, b = { on = "z1", centre = ["40 mm", "20 mm"], radius = "10 mm" } }
[boundary]
cold = { T = "20 degC" }
[contact]
end = { from = "bar.x0", to = "cold", h = "1e9 W/(m^2 K)" }
[source]
loss = { into = "bar.x1", P = "6 W" }
"#;
    let (netlist, steady) = settled(text);
    let slope = 6.0 / (100.0 * 40e-3 * 2e-3);
    let film = 6.0 / (1e9 * 40e-3 * 2e-3);
    close(celsius(&netlist, &steady, "bar.a.T"), 20.0 + film + slope * 15e-3, 1e-9);
    close(celsius(&netlist, &steady, "bar.b.T"), 20.0 + film + slope * 40e-3, 1e-9);
}

/// Both halves of a face are the face: the same heat into each cell.
#[test]
fn two_patches_that_fill_a_face_are_the_face() {
    let whole = plate([9, 7, 2], "size = [\"60 mm\", \"40 mm\"]");
    let halves = whole.replace(
        "chip = { on = \"z1\", size = [\"60 mm\", \"40 mm\"] }",
        "a = { on = \"z1\", centre = [\"7.5 mm\", \"20 mm\"], size = [\"15 mm\", \"40 mm\"] }, \
         b = { on = \"z1\", centre = [\"37.5 mm\", \"20 mm\"], size = [\"45 mm\", \"40 mm\"] }",
    );
    let halves = halves.replace("\"board.chip\"", "{ \"board.a\" = 0.25, \"board.b\" = 0.75 }");
    let face = whole.replace("board.chip", "board.z1");
    let [whole, halves, face] =
        [whole, halves, face].map(|text| settled(&text).1.temperatures.clone());
    assert_eq!(whole.len(), face.len());
    for ((a, b), c) in whole.iter().zip(&halves).zip(&face) {
        close(*a, *c, 1e-10);
        close(*b, *c, 1e-10);
    }
}

/// The plate and its patch grow together: the shares stay. A patch that moves is refused.
#[test]
fn parameters_may_scale_a_patch_but_not_move_it() {
    let text = plate([6, 4, 1], "centre = [\"0.25 * a\", \"24 mm\"], size = [\"a / 6\", \"8 mm\"]")
        .replace("size = [\"60 mm\"", "size = [\"a\"")
        .replace("format = 1", "format = 1\n[param]\na = \"60 mm\"\nb = \"24 mm\"");
    let (mut netlist, _) = parsed(&text);
    netlist.set(&["a=120 mm".to_owned()]).unwrap();
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let grown = SteadyState::solve(&system, 0.0).unwrap();
    let written = settled(&text.replace("a = \"60 mm\"", "a = \"120 mm\""));
    for (a, b) in grown.temperatures.iter().zip(&written.1.temperatures) {
        close(*a, *b, 1e-10);
    }
    let (mut netlist, _) = parsed(&text.replace("\"24 mm\"]", "\"b\"]"));
    let refused = netlist.set(&["b=28 mm".to_owned()]).unwrap_err();
    assert!(refused.to_string().contains("covers other cells"), "{refused}");
}

/// A patch in a template and in a run: energy balance, and the steady state at the end.
#[test]
fn a_run_with_a_patch_in_each_instance() {
    let (netlist, system) = parsed(
        r#"
format = 1
[template.module]
param = { P = "5 W" }
port = ["air"]
[template.module.grid.base]
size = ["30 mm", "20 mm", "3 mm"]
cells = [6, 5, 2]
material = "copper"
T0 = "20 degC"
patch = { die = { on = "z1", radius = "6 mm" } }
[template.module.convection]
cold = { from = "base.z0", to = "air", h = "3000 W/(m^2 K)" }
[template.module.source]
loss = { into = "base.die", P = "P" }
[boundary]
water = { T = "20 degC" }
[use.m]
template = "module"
count = 3
connect = { air = "water" }
[limit]
hot = { of = "max(m[*].base.die.T)", below = "90 degC" }
[run]
stop = "1 min"
"#,
    );
    let run = transient(&netlist).tolerance(1e-6).solve(&system).unwrap();
    assert!(run.ledger().closes());
}
