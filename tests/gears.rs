//! Kind: analytic, conservation. Stages of gears against the formulas of Willis, written here anew:
//! speeds, torques and efficiency of every arrangement, and where the heat goes.

use std::f64::consts::PI;

use lptn::prelude::*;
use lptn_netlist::{Gearbox, Member};
use lptn_study::{GearPoint, GearState, GearTask};

const SUN: f64 = 18.0;
const PLANET: f64 = 42.0;
const RING: f64 = 102.0;
const RPM: f64 = PI / 30.0;

/// A stage with what is said of it, on one node.
fn stage(more: &str) -> String {
    format!(
        "format = 1\n[node]\nbox = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \
         \"20 degC\" }}\n[resistor]\nskin = {{ from = \"box\", to = \"air\", R = \"0.1 K/W\" }}\n\
         [gearbox.stage]\ninto = \"box\"\nmodule = \"2 mm\"\nwidth = \"12 mm\"\nRa = \"0.5 um\"\n\
         lubricant = \"iso_vg_220\"\nspeed = \"3000 rpm\"\ntorque = \"10 N m\"\n{more}\n"
    )
}

const TEETH: &str = "teeth = { sun = 18, planet = 42, ring = 102 }\nplanets = 3\n";

fn state(text: &str, point: GearPoint) -> (GearState, Option<f64>, Option<f64>) {
    let netlist = lptn::parse("gears.toml", text).expect("a netlist");
    let first = netlist.gearboxes().first().expect("a gearbox");
    let stages = GearTask::train(netlist.gearboxes(), first);
    let task = GearTask { network: &netlist.network, stages, time: 0.0 };
    let state = task.at(point).expect("a state");
    let (efficiency, power) = (state.efficiency(&task), state.power(&task));
    (state, efficiency, power)
}

fn member(state: &GearState, member: Member) -> (f64, f64) {
    let found = state.members.iter().find(|m| m.member == member).expect("a member");
    (found.speed / RPM, found.torque.expect("a torque"))
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-10 * expected.abs().max(1.0), "{found}, not {expected}");
}

/// Held member, input, speeds of sun, carrier and ring for one of the input, printed by Niemann.
const ARRANGEMENTS: [(&str, &str, [f64; 3]); 6] = [
    ("ring", "sun", [1.0, SUN / (SUN + RING), 0.0]),
    ("ring", "carrier", [1.0 + RING / SUN, 1.0, 0.0]),
    ("sun", "ring", [0.0, RING / (SUN + RING), 1.0]),
    ("sun", "carrier", [0.0, 1.0, 1.0 + SUN / RING]),
    ("carrier", "sun", [1.0, 0.0, -SUN / RING]),
    ("carrier", "ring", [-RING / SUN, 0.0, 1.0]),
];

#[test]
fn members_turn_as_willis_says_and_their_torques_and_powers_balance() {
    for (held, input, speeds) in ARRANGEMENTS {
        let text = stage(&format!("{TEETH}held = \"{held}\"\ninput = \"{input}\""));
        let (state, _, _) = state(&text, GearPoint::default());
        let shafts = [Member::Sun, Member::Carrier, Member::Ring].map(|m| member(&state, m));
        for (found, expected) in shafts.iter().zip(speeds) {
            near(found.0, 3000.0 * expected);
        }
        near(shafts.iter().map(|(_, torque)| torque).sum(), 0.0);
        near(shafts.iter().map(|(speed, torque)| speed * torque).sum(), 0.0);
        // the same force in both meshes
        near(shafts[2].1 / shafts[0].1, RING / SUN);
        let planet = state.members.iter().find(|m| m.member == Member::Planet).expect("planets");
        near(planet.speed / RPM, -3000.0 * (speeds[0] - speeds[1]) * SUN / PLANET);
    }
}

#[test]
fn what_goes_in_and_is_not_lost_comes_out_and_the_nodes_receive_the_rest() {
    for (held, input, _) in ARRANGEMENTS {
        for torque in ["10 N m", "-10 N m"] {
            let text = stage(&format!("{TEETH}held = \"{held}\"\ninput = \"{input}\""));
            let text = text.replace("torque = \"10 N m\"", &format!("torque = \"{torque}\""));
            let netlist = lptn::parse("gears.toml", &text).expect("a netlist");
            let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
            let steady = SteadyState::solve(&system, 0.0).expect("a steady state");
            let (state, efficiency, power) = state(&text, GearPoint::default());
            let received: f64 = steady.source_heat.iter().sum();
            let left: f64 = steady.boundary_heat.iter().sum();
            assert!(state.loss() > 0.0);
            assert!((state.loss() - received).abs() < 1e-12 * received);
            assert!((received + left).abs() < 1e-9 * received);
            let (power, loss) = (power.expect("a power"), state.loss());
            let expected =
                if power > 0.0 { 1.0 - loss / power } else { power.abs() / (power.abs() + loss) };
            near(efficiency.expect("an efficiency"), expected);
        }
    }
}

/// eta = (1 - i0 eta0)/(1 - i0) with the sun driving: eta0 is that of the same gears with a held
/// carrier, at the same speed of the sun against it.
#[test]
fn the_efficiency_with_a_held_ring_follows_from_the_basic_efficiency() {
    let held = |temperature: f64, speed: f64| GearPoint {
        temperature: Some(temperature),
        speed: Some(speed * RPM),
        torque: None,
    };
    let rolling = 3000.0 * RING / (SUN + RING);
    let basic = stage(&format!("{TEETH}held = \"carrier\""));
    let (_, basic, _) = state(&basic, held(333.15, rolling));
    let (_, found, _) = state(&stage(TEETH), held(333.15, 3000.0));
    let (i0, eta0) = (-RING / SUN, basic.expect("an efficiency"));
    assert!((0.9..0.995).contains(&eta0), "{eta0}");
    near(found.expect("an efficiency"), (1.0 - i0 * eta0) / (1.0 - i0));
}

#[test]
fn a_pair_turns_the_other_way_and_carries_the_torque_of_its_ratio() {
    let text = stage("teeth = { pinion = 20, wheel = 60 }");
    let (state, _, power) = state(&text, GearPoint::default());
    let [(pinion, drives), (wheel, driven)] =
        [Member::Pinion, Member::Wheel].map(|m| member(&state, m));
    near(pinion, 3000.0);
    near(wheel, -1000.0);
    near(drives, 10.0);
    near(driven, 30.0);
    near(power.expect("a power"), 10.0 * 3000.0 * RPM);
}

#[test]
fn the_force_of_a_mesh_is_the_torque_of_one_planet_at_its_pitch_circle() {
    let text = stage(&format!("{TEETH}helix_angle = \"15 deg\""));
    let netlist = lptn::parse("gears.toml", &text).expect("a netlist");
    let id = netlist.network.parameter("stage.force").expect("a force");
    let radius = 0.5 * SUN * 2e-3 / (15.0 * PI / 180.0).cos();
    near(netlist.network.parameter_value(id), 10.0 / 3.0 / radius);
}

#[test]
fn two_stages_in_a_row_turn_by_the_product_of_their_ratios() {
    let second = "\n[gearbox.second]\nteeth = { pinion = 20, wheel = 60 }\ndriven_by = \"stage\"\n\
        into = \"box\"\nmodule = \"3 mm\"\nwidth = \"20 mm\"\nRa = \"0.5 um\"\nlubricant = \
        \"iso_vg_220\"";
    let text = stage(&format!("{TEETH}{second}"));
    let (state, efficiency, power) = state(&text, GearPoint::default());
    let carrier = 3000.0 * SUN / (SUN + RING);
    let torque = 10.0 * (SUN + RING) / SUN;
    near(member(&state, Member::Pinion).0, carrier);
    near(member(&state, Member::Pinion).1, torque);
    near(member(&state, Member::Wheel).0, -carrier / 3.0);
    near(member(&state, Member::Wheel).1, 3.0 * torque);
    assert_eq!(state.losses.len(), 3);
    near(efficiency.expect("an efficiency"), 1.0 - state.loss() / power.expect("a power"));
}

/// A stage that is driven may stand first in the file, and inside a template.
#[test]
fn a_template_holds_a_gearbox() {
    let template = "format = 1\n[template.unit]\nport = [\"oil\"]\nparam = { n = \"1000 rpm\" }\n\
        [template.unit.gearbox.stage]\nteeth = { pinion = 20, wheel = 60 }\nspeed = \"n\"\ninto = \
        \"oil\"\nseal = { lip = { on = \"wheel\", model = \"shaft\", d = \"50 mm\" } }\n[use.left]\n\
        template = \"unit\"\nconnect = { oil = \"sump\" }\n[use.right]\ntemplate = \"unit\"\nconnect \
        = { oil = \"sump\" }\nset = { n = \"3000 rpm\" }\n[node]\nsump = { C = \"500 J/K\", T0 = \"20 \
        degC\" }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nout = { from = \"sump\", to = \
        \"air\", R = \"0.3 K/W\" }\n";
    let netlist = lptn::parse("units.toml", template).expect("a netlist");
    let names: Vec<&str> = netlist.gearboxes().iter().map(|g: &Gearbox| g.name.as_str()).collect();
    assert_eq!(names, ["left.stage", "right.stage"]);
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    let steady = SteadyState::solve(&system, 0.0).expect("a steady state");
    // ISO/TR 14179-2: 7.69e-6 d^2 n
    near(steady.source_heat[0], 7.69e-6 * 2500.0 * 1000.0 / 3.0);
    near(steady.source_heat[1], 7.69e-6 * 2500.0 * 1000.0);
}

/// Speeds from a signal are held where they are asked for; the exponents of the printed formulas
/// are 5/3 and 1.
#[test]
fn a_drive_cycle_is_looked_at_by_speed_and_exponents_are_those_of_the_formulas() {
    let parts = "\nbearing = { b = { on = \"carrier\", model = \"no_load\", d_m = \"90 mm\", f0 = 2 \
        } }\nseal = { s = { on = \"sun\", model = \"shaft\", d = \"20 mm\" } }";
    let text = stage(&format!("{TEETH}{parts}"));
    let cycle = "speed = \"cycle\"";
    let text = text.replace("speed = \"3000 rpm\"", cycle);
    let text = format!(
        "{text}[signal]\ncycle = {{ t = [\"0 s\", \"1 h\"], v = [\"0 rpm\", \"6000 rpm\"] }}\n"
    );
    let point = |speed: f64| GearPoint { speed: Some(speed * RPM), ..GearPoint::default() };
    let (state, _, _) = state(&text, point(2000.0));
    near(member(&state, Member::Sun).0, 2000.0);
    let exponent = |name: &str| {
        let part = state.losses.iter().find(|part| part.name == name).expect("a part");
        part.exponent.expect("an exponent")
    };
    assert!((exponent("stage.b") - 5.0 / 3.0).abs() < 1e-6, "{}", exponent("stage.b"));
    assert!((exponent("stage.s") - 1.0).abs() < 1e-6);
}

/// Books close with every loss on while the speed goes through zero.
#[test]
fn the_ledger_closes_over_a_cycle_that_turns_back() {
    let parts = "bearing = { b = { on = \"carrier\", model = \"no_load\", d_m = \"90 mm\", f0 = 2 } \
        }\nseal = { s = { on = \"sun\", model = \"shaft\", d = \"20 mm\" } }\nchurning = { w = { on = \
        \"carrier\", part = \"sides\", D = \"90 mm\", dip = 0.3 } }";
    let text =
        stage(&format!("{TEETH}{parts}")).replace("speed = \"3000 rpm\"", "speed = \"cycle\"");
    let text = format!(
        "{text}[signal]\ncycle = {{ t = [\"0 s\", \"10 min\"], v = [\"3000 rpm\", \"-3000 rpm\"] }}\n\
         "
    );
    let netlist = lptn::parse("cycle.toml", &text).expect("a netlist");
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    let run = Transient::until(Time(600.0)).every(Time(30.0));
    let solution = run.solve(&system).expect("it runs");
    let residual = solution.ledger().relative_residual().expect("heat is turned over");
    assert!(residual.abs() <= 1e-8, "{residual:e}");
}
