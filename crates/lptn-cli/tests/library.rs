//! A program that calls the library gets the bytes of the command line.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use lptn_answer::answer::Answer;
use lptn_answer::compare::CompareQuestion;
use lptn_answer::cycle::CycleQuestion;
use lptn_answer::failure::Failure;
use lptn_answer::fit::network::FitNetworkQuestion;
use lptn_answer::input::Input;
use lptn_answer::listener::{Listener, Nobody};
use lptn_answer::lumping::Detail;
use lptn_answer::modes::ModesQuestion;
use lptn_answer::rank::RankQuestion;
use lptn_answer::reduce::ReduceQuestion;
use lptn_answer::run::RunQuestion;
use lptn_answer::size::SizeQuestion;
use lptn_answer::steady::SteadyQuestion;
use lptn_answer::verify::VerifyQuestion;
use lptn_netlist::CsvOptions;
use lptn_report::Format;
use lptn_study::SortKey;

fn root() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn input(name: &str) -> Arc<Input> {
    Arc::new(Input::read(root().join("networks").join(name)).unwrap())
}

/// What the command prints on stdout.
fn printed(command: &str) -> String {
    let words = command.split(' ');
    let mut program = Command::new(env!("CARGO_BIN_EXE_lptn"));
    let output = program.args(words).arg("--no-files").current_dir(root()).output().unwrap();
    assert!(matches!(output.status.code(), Some(0 | 1)), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// An answer of the library is what the command prints.
fn same(command: &str, answer: &impl Answer, format: Format) {
    assert_eq!(answer.written(format), printed(command), "{command}");
}

#[test]
fn the_library_answers_with_the_bytes_of_the_program() {
    let run = RunQuestion { format: Format::Json, ..RunQuestion::default() };
    let run = run.ask(input("gearbox.toml"), &Nobody).unwrap();
    same("run networks/gearbox.toml --format json", &run, Format::Json);
    let table = RunQuestion::default().ask(input("gearbox_fan.toml"), &Nobody).unwrap();
    same("run networks/gearbox_fan.toml", &table, Format::Table);

    let steady = SteadyQuestion::default().ask(input("gearbox.toml"), &Nobody).unwrap();
    same("steady networks/gearbox.toml", &steady, Format::Table);
    same("steady networks/gearbox.toml --format csv", &steady, Format::Csv);

    let cycle = CycleQuestion {
        period: None,
        tolerance: None,
        select: Vec::new(),
        temperature_unit: None,
        balance: None,
        format: Format::Json,
        report: false,
        detail: Detail::Brief,
        certify: false,
    };
    let cycle = cycle.ask(input("duty_cycle.toml"), &Nobody).unwrap();
    same("steady networks/duty_cycle.toml --periodic --format json", &cycle, Format::Json);

    let rank = RankQuestion::default().ask(input("gearbox.toml"), &Nobody).unwrap();
    same("rank networks/gearbox.toml", &rank, Format::Table);

    let reduce = ReduceQuestion { port: Some("steel".into()), ..ReduceQuestion::default() };
    let reduce = reduce.ask(input("gearbox.toml"), &Nobody).unwrap();
    same("reduce networks/gearbox.toml --port steel --format json", &reduce, Format::Json);

    let modes = ModesQuestion::default().ask(input("gearbox.toml"), &Nobody).unwrap();
    same("modes networks/gearbox.toml --format json", &modes, Format::Json);

    let verify = VerifyQuestion::default().ask(input("gearbox.toml"), &Nobody).unwrap().unwrap();
    same("verify networks/gearbox.toml", &verify, Format::Table);

    let size = SizeQuestion::default().ask(input("candidates/fan.toml"), &Nobody).unwrap();
    same("size networks/candidates/fan.toml --format json", &size, Format::Json);
}

#[test]
fn the_library_compares_as_the_program_does() {
    let files = ["bare.toml", "fan.toml"].map(|name| Path::new("networks/candidates").join(name));
    let compare = CompareQuestion {
        files: files.map(|file| root().join(file)).to_vec(),
        set: Vec::new(),
        posterior: None,
        uncertainty: false,
        parts: Vec::new(),
        csv: CsvOptions::default(),
        cases: false,
        periodic: false,
        sort: SortKey::Margin,
        temperature_unit: None,
        detail: Detail::Brief,
        threads: Some(1),
        command: Vec::new(),
    };
    let answer = compare.ask(&Nobody).unwrap();
    let command = "compare networks/candidates/bare.toml networks/candidates/fan.toml";
    same(command, &answer, Format::Table);
    assert_eq!(answer.exit() as u8, 1, "bare breaks its limit");
}

/// A client keeps netlists and failures, and moves them to other threads, as it does answers
/// (`lptn-answer/src/answer.rs`).
#[test]
fn netlists_and_failures_are_owned_and_may_go_to_another_thread() {
    fn owned<T: Send + 'static>() {}
    owned::<Arc<Input>>();
    owned::<Failure>();
}

/// A listener that interrupts at once.
struct Impatient;

impl Listener for Impatient {
    fn proceed(&self) -> lptn_solve::Proceed {
        lptn_solve::Proceed::Interrupt
    }
}

#[test]
fn a_listener_may_interrupt_a_run_and_gets_what_was_finished() {
    let answer = RunQuestion::default().ask(input("gearbox.toml"), &Impatient).unwrap();
    let failure = answer.failed().expect("it did not reach its stop");
    assert_eq!(failure.diagnostics[0].code, "run::interrupted");
    assert!(answer.to_json().contains("\"ok\": false"));
    let fit = FitNetworkQuestion::default().ask(input("coffee.toml"), &Impatient);
    assert!(fit.is_err());
}
