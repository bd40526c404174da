//! Shipped networks that are cases of the validation set too: what they say is compared with the
//! same values.

#![allow(clippy::print_stdout, reason = "the table of results, shown with --nocapture")]

use crate::support;
use crate::validation_helper as validation;

use lptn_solve::Proceed;
use lptn_study::{Demand, Moments, SizeTask, size};
use support::shipped;
use validation::{Report, judge_network, own_folder};

/// A file, its case, and where names differ, those of the case with those of the file.
type Pair = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const PAIRS: [Pair; 23] = [
    ("bridge_unbalanced", "bridge_steady", &[]),
    ("chip", "incropera_3_2_chip", &[]),
    ("coolant_reversal", "msl_fhf_one_mass", &[]),
    ("duty_cycle", "duty_cycle_one_node", &[]),
    ("falling_loss", "ntc_loss_two_node", &[]),
    ("gearbox", "gearbox_two_node", &[("alum", "aluminium")]),
    ("heated_tube", "pipe_const_wall_upwind", &[]),
    ("hot_pipe", "incropera_1_2_pipe", &[]),
    ("into_space", "rad_cool_to_zero", &[]),
    ("kirchhoff_wall", "kirchhoff_wall", &[]),
    ("melting", "pcm_apparent_heat", &[]),
    ("motor", "msl_motor", &[]),
    ("motor_housing", "emach_resistance_network", &[]),
    ("natural_convection", "natural_convection_power", &[("q", "plate"), ("t", "wall")]),
    ("ramp_and_sine", "ramp_and_sine_inputs", &[]),
    ("rc_ladder", "rc_ladder", &[]),
    ("room_heavy", "vdi6007_tc1", &[]),
    ("room_light", "vdi6007_tc4", &[]),
    ("room_sunny", "vdi6007_tc5", &[]),
    ("thermocouple", "incropera_5_1_thermocouple", &[]),
    ("thermostat", "thermostat_one_node", &[]),
    ("through_flow", "msl_fhf_simple_cooling", &[]),
    ("two_masses", "msl_two_masses", &[("mass1", "hot"), ("mass2", "cold")]),
];

#[test]
fn shipped_networks_say_what_their_cases_expect() {
    println!("{}", Report::heading());
    let mut complaints = Vec::new();
    for (file, case, names) in PAIRS {
        let (netlist, _) = shipped(&format!("{file}.toml"));
        let report = judge_network(case, &netlist.network, names);
        print!("{report}");
        assert!(
            report.counts()[0] > 0 || !report.complaints().is_empty(),
            "{file}: nothing was checked"
        );
        complaints.extend(report.complaints().iter().map(|text| format!("{file}.toml: {text}")));
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// `fuel_cell_fan.toml` asks for the speed of the air; the case for the film coefficient, 10.9
/// V^0.8 in the book.
#[test]
fn the_fan_is_sized_as_its_case_expects() {
    let (netlist, _) = shipped("fuel_cell_fan.toml");
    let (network, study) = (&netlist.network, &netlist.studies.sizes[0]);
    let task = SizeTask {
        demand: Demand {
            network,
            netlist: &netlist,
            cases: &[],
            requirements: &study.requirements,
            moments: Moments::Steady(0.0),
            doubt: None,
            watcher: &|_| Proceed::Continue,
        },
        parameter: network.parameter("speed").expect("the speed of the air"),
        range: study.ranges(network).expect("a range")[0].1,
        goal: study.goal,
    };
    let sizing = size(&task).expect("it can be sized");
    assert!(sizing.feasible());
    let film = 10.9 * sizing.trial.value.powf(0.8);
    let case = validation::json(&own_folder(), "incropera_1_4_fan_sizing");
    let expected = case["expected"].as_array().expect("a list");
    assert_eq!(expected.len(), 2);
    for expected in expected {
        let of = |key: &str| expected[key].as_f64().unwrap_or(0.0);
        let allowed = of("tol_abs").max(of("tol_rel") * of("value"));
        assert!((film - of("value")).abs() <= allowed, "{film} but {expected}");
    }
}

/// The first lines of a shipped network say what it shows, and where its numbers are from.
#[test]
fn every_network_of_a_case_says_where_its_numbers_come_from() {
    for (file, case, _) in
        PAIRS.into_iter().chain([("fuel_cell_fan", "incropera_1_4_fan_sizing", &[][..])])
    {
        let path = support::networks().join(format!("{file}.toml"));
        let text = std::fs::read_to_string(&path).expect("a network");
        let head: String = text.lines().take_while(|line| line.starts_with('#')).collect();
        assert!(
            head.contains("Numbers: ") && head.contains(case),
            "{file}.toml names no source: {head}"
        );
    }
}
