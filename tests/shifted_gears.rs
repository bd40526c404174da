//! Kind: analytic, diagnostics. Gears with profile shift in netlists: keys, what follows from them,
//! and contradictions.

use lptn::prelude::*;
use lptn_netlist::Netlist;

/// Two gears between a node and oil at 60 degC.
fn netlist(elements: &str) -> String {
    format!(
        "format = 1\n[param]\nx = 0.1817\n[node]\ngears = {{ massless = true }}\n[boundary]\noil = {{ T = \
         \"60 degC\" }}\n[resistor]\nspray = {{ from = \"gears\", to = \"oil\", G = \"1000 W/K\" }}\n\
         {elements}\n"
    )
}

/// The gears C of FZG with these keys: 16 and 24 teeth, 200 N m at 1500 rpm.
fn fzg(keys: &str) -> String {
    netlist(&format!(
        "[mesh.pair]\ninto = \"gears\"\nmodel = \"external\"\nspeed = \"1500 rpm\"\ntorque = \"200 N m\"\nz1 = \
         16\nz2 = 24\nmodule = \"4.5 mm\"\nwidth = \"14 mm\"\nRa = \"0.355 um\"\nnu = \"15.12 mm^2/s\"\n\
         density = \"878 kg/m^3\"\nX_L = 0.846\n{keys}"
    ))
}

fn read(text: &str) -> Netlist {
    lptn::parse("gears.toml", text).unwrap_or_else(|rejected| panic!("{rejected}\n{text}"))
}

fn heat(netlist: &Netlist) -> Vec<f64> {
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    SteadyState::solve(&system, 0.0).expect("a steady state").source_heat.clone()
}

fn codes(text: &str) -> Vec<&'static str> {
    match lptn::parse("gears.toml", text) {
        Ok(netlist) => netlist.warnings.iter().map(|warning| warning.code).collect(),
        Err(rejected) => rejected.diagnostics.iter().map(|problem| problem.code).collect(),
    }
}

const TIPS: &str = "addendum_1 = 1.1817\naddendum_2 = 1.1715\n";

/// GEARpie (C. Fernandes, FEUP) prints mu 0.0449, H_V 0.1986 and 31416 W for C14: 280 W. With the
/// same tips at the reference centre distance the loss is 388.9 W.
#[test]
fn shifts_or_the_centre_distance_give_the_printed_loss() {
    for keys in [
        "x_1 = \"x\"\nx_2 = 0.1715",
        "x_1 = \"x\"\nx_2 = 0.1715\ncentre_distance = \"91.5 mm\"",
        &format!("{TIPS}centre_distance = \"91.5 mm\""),
        &format!("{TIPS}x_1 = 0.1817\nx_2 = 0.1715"),
        "addendum_2 = 1.1715\nx_1 = 0.1817\nx_2 = 0.1715",
    ] {
        let netlist = read(&fzg(keys));
        let lost = heat(&netlist)[0];
        assert!((lost - 280.0).abs() < 0.1, "{lost} W with {keys}");
        assert!(!netlist.warnings.iter().any(|w| w.code == "netlist::profile_shift"), "{keys}");
        // the expansion has the same keys
        let again = heat(&read(&netlist.expanded()))[0];
        assert_eq!(again.to_bits(), lost.to_bits(), "{}", netlist.expanded());
    }
    let unshifted = read(&fzg(TIPS));
    assert!((heat(&unshifted)[0] - 388.9).abs() < 0.1);
    assert!(unshifted.warnings.iter().any(|w| w.code == "netlist::profile_shift"));
    assert!(!codes(&fzg(&format!("{TIPS}x_1 = 0"))).contains(&"netlist::profile_shift"));
    // shortened tips, k = 0.0199: H_V 0.1950 is printed for the gears REP
    let shorter = heat(&read(&fzg("x_1 = \"x\"\nx_2 = 0.1715\ntip_shortening = 0.01987")))[0];
    assert!((shorter - 280.0 * 0.1950 / 0.1986).abs() < 0.15, "{shorter}");
}

/// The distance without backlash by bisection of the involute function: 91.50008 mm for C, and with
/// x_1 = 0.3, x_2 = -0.5 of 20 teeth in a ring of 60, 60.57955 mm (3 mm).
#[test]
fn a_centre_distance_may_leave_backlash_and_no_interference() {
    let pair =
        |a: f64| codes(&fzg(&format!("x_1 = \"x\"\nx_2 = 0.1715\ncentre_distance = \"{a} mm\"")));
    let wrong = "netlist::centre_distance";
    for further in [-0.009, 0.0, 0.099] {
        assert!(!pair(91.50008 + 4.5 * further).contains(&wrong), "{further}");
    }
    for further in [-0.011, 0.101] {
        assert_eq!(pair(91.50008 + 4.5 * further), [wrong], "{further}");
    }
    let ring = |a: f64| {
        let text = fzg(&format!("x_1 = 0.3\nx_2 = -0.5\ncentre_distance = \"{a} mm\""));
        let text = text.replace("external", "internal").replace("z1 = 16", "z1 = 20");
        codes(&text.replace("z2 = 24", "z2 = 60").replace("4.5 mm", "3 mm"))
    };
    for closer in [-0.009, 0.0, 0.099] {
        assert!(!ring(60.57955 - 3.0 * closer).contains(&wrong), "{closer}");
    }
    for closer in [-0.011, 0.101] {
        assert_eq!(ring(60.57955 - 3.0 * closer), [wrong], "{closer}");
    }
}

/// A parameter that is set later is checked as well.
#[test]
fn a_shift_that_is_set_later_has_to_fit() {
    let mut netlist = read(&fzg("x_1 = \"x\"\nx_2 = 0.1715"));
    netlist.set(&["x = 0.2".to_owned()]).expect("it fits");
    let rejected = netlist.set(&["x = 2.5".to_owned()]).expect_err("teeth part");
    assert_eq!(rejected.diagnostics[0].code, "netlist::gear_contact");
    let mut netlist = read(&fzg("x_1 = \"x\"\nx_2 = 0.1715\ncentre_distance = \"91.5 mm\""));
    let rejected = netlist.set(&["x = 0.3".to_owned()]).expect_err("it contradicts");
    assert_eq!(rejected.diagnostics[0].code, "netlist::centre_distance");
    // sizes that change with time are not checked before the run
    for key in ["x_1 = \"0.1817 + t / 1 [h]\"\nx_2 = 0.1715", "addendum_1 = \"1 + t / 1 [h]\""] {
        read(&fzg(&format!("{key}\ncentre_distance = \"91.5 [mm] + 1 [mm/h] * t\"")));
    }
}

const STAGE: &str = "planets = 3\nspeed = \"3000 rpm\"\ntorque = \"12 N m\"\nmodule = \"3 mm\"\nwidth = \"12 \
    mm\"\nRa = \"0.5 um\"\nlubricant = \"iso_vg_220\"\nX_L = 0.8\ninto = \"gears\"\n";

/// The meshes of a stage are those that are written by hand: 2550 rpm of the sun against the carrier
/// with a third of 12 N m, its planets with 102/18 teeth of the ring.
#[test]
fn a_stage_gives_its_shifts_to_its_meshes() {
    let stage = netlist(&format!(
        "[gearbox.stage]\nteeth = {{ sun = 18, planet = 42, ring = 102 }}\nshift = {{ sun = \"x\", planet = \
         0.2, ring = -0.5817 }}\naddendum = {{ ring = 0.38 }}\ntip_shortening = 0.02\nhelix_angle = \"10 \
         deg\"\n{STAGE}"
    ));
    let stage = read(&stage);
    let sizes = "module = \"3 mm\"\nwidth = \"12 mm\"\nRa = \"0.5 um\"\nlubricant = \"iso_vg_220\"\nX_L = \
        0.8\nhelix_angle = \"10 deg\"\ntip_shortening = 0.02\ninto = \"gears\"\n";
    let by_hand = netlist(&format!(
        "[mesh.sun]\nmodel = \"external\"\nspeed = \"2550 rpm\"\ntorque = \"4 N m\"\nz1 = 18\nz2 = 42\nx_1 = \
         \"x\"\nx_2 = 0.2\n{sizes}[mesh.ring]\nmodel = \"internal\"\nspeed = \"2550 [rpm] * 18 / 42\"\n\
         torque = \"4 [N m] * 42 / 18\"\nz1 = 42\nz2 = 102\nx_1 = 0.2\nx_2 = -0.5817\naddendum_2 = 0.38\n\
         {sizes}"
    ));
    // the viscosity is that of the node, so a path of no resistance keeps both at one temperature
    let still = |text: &str| text.replace("1000 W/K", "1e9 W/K");
    let (found, expected) = (heat(&read(&still(&stage.expanded()))), heat(&read(&still(&by_hand))));
    assert_eq!(found.len(), 6);
    for (index, mesh) in [(0, 0), (3, 1)] {
        assert!((found[index] / expected[mesh] - 1.0).abs() < 1e-9, "{found:?}, {expected:?}");
    }
    let text = stage.expanded();
    assert!(text.contains("x_1 = \"stage.x_sun\"") && text.contains("stage.x_ring"), "{text}");
}

/// Without shift 18 + 2 x 41 teeth need a ring of 100. A ring of 102 meshes at the distance of sun and
/// planet if inv a_w is the same: x_r = -x_p - (inv a - inv a_w) 61 / (2 tan a).
#[test]
fn shifts_let_other_teeth_mesh() {
    let (alpha, involute) = (20f64.to_radians(), |angle: f64| angle.tan() - angle);
    let wanted = involute(alpha) + 2.0 * alpha.tan() * 0.5 / 59.0;
    let (mut low, mut high) = (0.1_f64, 1.0_f64);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if involute(middle) < wanted { low = middle } else { high = middle }
    }
    // a = 59/2 cos(alpha) / cos(low) = 61/2 cos(alpha) / cos(ring)
    let ring = (low.cos() * 61.0 / 59.0).acos();
    let shift = -0.2 + (involute(alpha) - involute(ring)) * 61.0 / (2.0 * alpha.tan());
    assert!((shift - 0.2904).abs() < 5e-5, "{shift}");
    let stage = |ring: f64| {
        netlist(&format!(
            "[gearbox.stage]\nteeth = {{ sun = 18, planet = 41, ring = 102 }}\nshift = {{ sun = 0.3, planet = \
             0.2, ring = {ring} }}\n{STAGE}"
        ))
    };
    assert!(!codes(&stage(shift)).contains(&"netlist::centre_distance"));
    // 0.01 modules of distance are 0.01 / 0.93 of the ring's shift
    assert!(!codes(&stage(shift + 0.008)).contains(&"netlist::centre_distance"));
    assert_eq!(codes(&stage(shift + 0.013)), ["netlist::centre_distance"]);
    assert_eq!(codes(&stage(0.0)), ["netlist::centre_distance"]);
    let without = stage(0.0).replace("shift = { sun = 0.3, planet = 0.2, ring = 0 }\n", "");
    assert_eq!(codes(&without), ["netlist::gear_mesh"]);
}

/// Without load nothing scuffs, however hot it is: the file says so, and no limit is kept.
#[test]
fn flanks_without_load_are_not_judged() {
    let flanks = |torque: &str| {
        fzg("x_1 = \"x\"\nx_2 = 0.1715\nscuffing = \"70 degC\"").replace("200 N m", torque)
    };
    assert!(codes(&flanks("0 N m")).contains(&"netlist::scuffing_idle"));
    assert!(!codes(&flanks("1 N m")).contains(&"netlist::scuffing_idle"));
    let idle = codes(&flanks("1 N m").replace("1500 rpm", "0 rpm"));
    assert!(idle.contains(&"netlist::scuffing_idle"));
}
