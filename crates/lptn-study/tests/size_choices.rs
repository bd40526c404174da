//! Objectives among results, parts with something sized for each, and parts without an answer,
//! against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{aim, demand};
use lptn_netlist::{parse, parse_with};
use lptn_study::{
    ChoiceTask, Choices, Parts, Several, SeveralTask, SizeError, choose, size_several,
};

fn several(study: &str) -> Several {
    let text = format!(
        "format = 1\n[param]\nG = '3 W/K'\n[node]\nblock = {{ C = '1 kJ/K', T0 = '20 degC' }}\n\
         [boundary]\nair = {{ T = '20 degC' }}\nwater = {{ T = '10 degC' }}\n[resistor]\n\
         skin = {{ from = 'block', to = 'air', G = '1 W/K' }}\n\
         cold = {{ from = 'block', to = 'water', G = 'G' }}\n[source]\n\
         loss = {{ into = 'block', P = '100 W' }}\n[size.s]\n\
         vary = {{ G = {{ from = '0.5 W/K', to = '20 W/K' }} }}\n{study}\n"
    );
    let netlist = parse("a.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let varied = netlist.studies.sizes[0].ranges(&netlist.network).unwrap();
    let (demand, aim) = (demand(&netlist), aim(&netlist));
    size_several(&SeveralTask { demand, aim, varied, threads: 2 }).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:e} is not {expected:e}");
}

/// At 60 degC the skin carries 40 W, so 60 W go into the water over 50 K: the least that may.
#[test]
fn a_heat_flow_is_minimised_up_to_a_requirement() {
    let found = several("minimise = 'cold.Q'\nrequire = ['block.T <= 60 [degC]']");
    near(found.design.values[0], 1.2, 1e-8);
    near(found.design.objective, 60.0, 1e-8);
    assert!(found.feasible && found.binding == [0]);
}

/// With x = G / (W/K) the block is at T = (120 + 10 x) / (1 + x) degC, 110 K / (1 + x) above the water,
/// and 110 / (1 + x) + 27.5 (1 + x) is least at x = 1, where it is 110.
#[test]
fn a_temperature_beside_what_it_costs_is_minimised_inside_the_range() {
    let found = several(
        "minimise = 'block.T - water.T + 27.5 [K] * (1 + G / 1 [W/K])'\n\
         require = ['block.T <= 100 [degC]']",
    );
    near(found.design.values[0], 1.0, 1e-4);
    near(found.design.objective, 110.0, 1e-8);
    assert!(found.feasible && found.binding.is_empty());
}

const PARTS: &str = "part,R_1 [K/W],price [-],a [1/K]\nweak,5,1,0\nsmall,1,2,0\n\
                     middle,0.6,6,0\nlarge,0.45,12,0\n";

/// 100 W over fins of R = R_1 (v / m/s)^-0.8 that keep 40 K: v = (R_1 / 0.4 K/W)^(1/0.8) m/s.
fn chosen(csv: &str, study: &str) -> Result<Choices, SizeError> {
    let text = format!(
        "format = 1\n[param]\nR_1 = '1 K/W'\nprice = 1\na = '0 1/K'\nv = '2 m/s'\n[node]\n\
         chip = {{ C = '60 J/K', T0 = '20 degC' }}\n[boundary]\nair = {{ T = '20 degC' }}\n\
         [resistor]\nfins = {{ from = 'chip', to = 'air', R = 'R_1 * (v / 1 [m/s])^-0.8' }}\n\
         [source]\nheat = {{ into = 'chip', P = '100 [W] * (1 + a * (T - 20 [degC]))' }}\n\
         [size.s]\ncatalogue = 'parts.csv'\nrequire = ['chip.T <= 60 [degC]']\n{study}\n"
    );
    let csv = csv.as_bytes().to_vec();
    let mut load = move |_: &std::path::Path| Ok(csv.clone());
    let netlist = parse_with("a.toml", &text, &mut load).unwrap_or_else(|e| panic!("{e}"));
    let (network, size) = (&netlist.network, &netlist.studies.sizes[0]);
    let catalogue = &size.catalogues[0];
    let columns = || catalogue.columns.iter();
    let parts = Parts {
        parameters: columns().map(|one| network.parameter(&one.name).unwrap()).collect(),
        values: (0..catalogue.parts.len())
            .map(|part| columns().map(|one| one.values[part]).collect())
            .collect(),
    };
    let (catalogues, varied) = ([parts], size.ranges(network).unwrap());
    let (demand, aim, varied) = (demand(&netlist), aim(&netlist), varied.as_slice());
    choose(&ChoiceTask { demand, aim, catalogues: &catalogues, varied, threads: 2 })
}

const SPEED: &str = "vary = { v = { from = '0.5 m/s', to = '8 m/s' } }\n\
                     minimise = 'price + (v / 1 [m/s])^3'";

/// Prices and cubes of speeds are 2 + 31.1, 6 + 4.6 and 12 + 1.6; the weak sink would need 23 m/s.
#[test]
fn for_each_part_the_rest_is_sized_and_the_cheapest_wins() {
    let found = chosen(PARTS, SPEED).unwrap();
    let order: Vec<usize> = found.judged.iter().map(|one| one.parts[0]).collect();
    assert_eq!((order, found.best), (vec![2, 3, 1, 0], Some(0)));
    for (choice, (r, price)) in found.judged.iter().zip([(0.6, 6.0), (0.45, 12.0), (1.0, 2.0)]) {
        let v = f64::powf(r / 0.4, 1.25);
        near(*choice.values.last().unwrap(), v, 1e-8);
        near(choice.objective, price + v.powi(3), 1e-8);
        assert!(choice.keeps());
    }
    assert!(!found.judged[3].keeps() && found.judged[3].judged.is_ok());
}

/// A loss that grows by 2 % of 100 W a kelvin over 1 W/K runs away: that part has no steady state.
#[test]
fn a_part_without_an_answer_is_listed_with_its_error() {
    let runaway = "runaway,1,1.5,0.02\n";
    let by_price = "minimise = 'price'";
    let found = chosen(&format!("{PARTS}{runaway}"), by_price).unwrap();
    let order: Vec<usize> = found.judged.iter().map(|one| one.parts[0]).collect();
    assert_eq!(order, [0, 4, 1, 2, 3]);
    let code = |choice: &lptn_study::Choice| choice.judged.as_ref().err().map(|error| error.code());
    assert_eq!(code(&found.judged[1]), Some("steady::runaway"));
    assert!(!found.judged[1].keeps() && found.judged[1].margins().is_empty());
    // at 2 m/s 0.6 and 0.45 K/W become 0.345 and 0.258 K/W
    assert_eq!(found.best, Some(3));
    // optimised among results, or beside something that is sized, it comes last
    for study in ["minimise = 'fins.Q'", SPEED] {
        let found = chosen(&format!("{PARTS}{runaway}"), study).unwrap();
        assert_eq!(found.judged.last().unwrap().parts, [4], "{study}");
    }
    // of nothing but such parts the first error is told
    let error = chosen(&format!("part,R_1 [K/W],price [-],a [1/K]\n{runaway}"), by_price);
    assert!(matches!(error.unwrap_err(), SizeError::Trial { .. }));
}
