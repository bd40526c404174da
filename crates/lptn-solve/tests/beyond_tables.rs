//! The value that is outside its table at the answer is the reason of a failure, not the first one
//! that fails at the temperatures at which the search begins.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{SteadyState, Transient};

/// 60 W through two paths of 1 and 2 W/K, whose tables reach from 0 to 100 degC, to `outside`.
fn text(outside: &str, more: &str) -> String {
    let table = "{ x = [\"0 degC\", \"100 degC\"], y = [\"1 W/K\", \"1 W/K\"] }";
    format!(
        "format = 1\n[table]\nfirst = {table}\nsecond = {table}\n[boundary]\noutside = {{ T = \
         \"{outside}\" }}\n[node]\nhot = {{ massless = true }}\ncold = {{ massless = true }}\n{more}\
         [resistor]\ninner = {{ from = \"hot\", to = \"cold\", G = \"first(T_mean)\" }}\nouter = {{ from \
         = \"cold\", to = \"outside\", G = \"2 * second(T_mean)\" }}\n[source]\nheat = {{ into = \"hot\", \
         P = \"60 W\" }}\n"
    )
}

fn system(text: &str) -> ThermalSystem {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|r| panic!("{r}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

/// By hand: outside at -30 degC, cold at 0 degC, hot at 60 degC; the means are 30 and -15 degC.
#[test]
fn a_steady_state_names_the_path_that_is_outside_at_the_answer() {
    let error = SteadyState::solve(&system(&text("-30 degC", "")), 0.0).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("`outer`") && message.contains("got -15 degC"), "{message}");
}

/// The zero-capacity nodes of a run start in the same state.
#[test]
fn a_run_names_the_path_that_is_outside_at_its_start() {
    let body = "body = { C = \"1 J/K\", T0 = \"20 degC\" }\n[contact]\nfar = { from = \"body\", to = \
        \"outside\", h = \"1 W/(m^2 K)\", area = \"1 m^2\" }\n";
    let error = Transient::until(Time(1.0)).solve(&system(&text("-30 degC", body))).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("`outer`") && message.contains("got -15 degC"), "{message}");
}

/// By hand: outside at -10 degC, cold at 20 degC, hot at 80 degC: nothing is outside.
#[test]
fn an_answer_inside_all_tables_is_found_from_outside() {
    let system = system(&text("-10 degC", ""));
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let hot = steady[system.network().node("hot").unwrap()];
    assert!((hot - 353.15).abs() < 1e-6, "{hot}");
}
