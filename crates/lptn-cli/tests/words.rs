//! One test for each message that misled, drowned what mattered, or was not there.

use crate::common;

use common::{Folder, GEARBOX};

const BODY: &str = "format = 1\n[param]\nR = \"0.3 ± 0.001 K/W\"\n[node]\nbody = { C = \"100 \
    J/K\", T0 = \"20 degC\" }\n\
    [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", R \
    = \"R\" }\n\
    [source]\nheat = { into = \"body\", P = \"100 W\" }\n[run]\nstop = \"5 min\"\noutput = { every \
    = \"1 min\" }\n";

/// `check` warned of a node without a way out, `run` and `steady` did not.
#[test]
fn every_verb_warns_of_what_hangs_together_with_nothing() {
    let text = format!(
        "{BODY}\n[node.loose]\nC = \"10 J/K\"\nT0 = \"20 degC\"\n[boundary.sky]\nT = \"5 degC\"\n"
    );
    let folder = Folder::with("net.toml", &text);
    let nodes = "no path leads to a boundary from `loose`";
    let boundary = "nothing touches boundary `sky`";
    for verb in [&["run", "net.toml", "--no-files"][..], &["steady", "net.toml"]] {
        folder.run(verb).exits(0).says(nodes).says(boundary);
    }
    folder.run(&["check", "net.toml"]).exits(0).prints(nodes).prints(boundary);
    // a boundary that an expression reads is of use
    let read = text.replace("\"100 W\"", "\"1 [W/K] * (sky.T - air.T) + 115 [W]\"");
    let folder = Folder::with("net.toml", &read);
    assert!(!folder.run(&["run", "net.toml", "--no-files"]).exits(0).err.contains("sky"));
}

/// Of no sample or all samples the probability was printed as 0.0 ± 0 %.
#[test]
fn a_probability_that_no_sample_shows_is_a_bound() {
    let limits = "[limit]\nnever = { of = \"body.T\", below = \"90 degC\" }\n\
                  always = { of = \"body.T\", below = \"21 degC\", severity = \"warning\" }\n";
    let folder = Folder::with("net.toml", &format!("{BODY}{limits}"));
    let line = ["run", "net.toml", "--no-files", "--uncertainty", "sobol", "--samples"];
    // 1 - 0.05^(1/512) = 0.5834 %, 1 - 0.05^(1/64) = 4.573 %
    for (samples, bounds) in [("512", ["< 0.6 %", "> 99.4 %"]), ("64", ["< 4.6 %", "> 95.4 %"])] {
        let ran = folder.run(&[&line[..], &[samples]].concat()).exits(0);
        for (limit, bound) in ["never", "always"].iter().zip(bounds) {
            let rows = || ran.out.lines().filter(|row| row.starts_with(limit));
            assert!(rows().any(|row| row.ends_with(bound)), "no {bound} in\n{}", ran.out);
        }
    }
}

/// Every record of a column that the model does not describe had a warning of its own.
#[test]
fn a_column_that_is_not_described_is_told_once_with_its_worst_record() {
    let fit = "[fit.heating]\ndata = \
        [\"runs/mild_1.csv\", \"runs/mild_2.csv\", \"runs/bad_3.csv\"]\n\
               column = { ring = \"body.T\" }\nsigma = \"0.01 K\"\nvary = [\"R\"]\n";
    let folder = Folder::with("net.toml", &format!("{BODY}{fit}").replace(" ± 0.001", ""));
    std::fs::create_dir(folder.path().join("runs")).unwrap();
    for (name, noise) in [("mild_1", 1.0), ("mild_2", 1.2), ("bad_3", 5.0)] {
        let rows = (0..20).map(|i| {
            let t = 10.0 * f64::from(i);
            // 0.3 K/W, 30 s, with a saw on it
            let value = 50.0 - 30.0 * f64::exp(-t / 30.0) + noise * f64::from(i % 3 - 1);
            format!("{t},{value}\n")
        });
        folder.write(
            &format!("runs/{name}.csv"),
            &format!("t [s],ring [degC]\n{}", rows.collect::<String>()),
        );
    }
    let ran = folder.run(&["fit", "network", "net.toml"]).exits(0);
    assert_eq!(ran.err.matches("fit::misfit").count(), 1, "{}", ran.err);
    let ran =
        ran.says("does not describe column `ring` in 3 records").says("most in runs/bad_3.csv");
    // the table names records by what differs
    for part in ["ring (mild_1)", "ring (mild_2)", "ring (bad_3)"] {
        assert!(ran.out.contains(part), "no {part} in\n{}", ran.out);
    }
}

/// `lptn help` was not a command, and a file in the place of a verb only an unknown word.
#[test]
fn help_is_a_verb_and_a_file_is_none() {
    let folder = Folder::with_gearbox();
    assert!(folder.run(&["help"]).exits(0).out.contains("compare"));
    let run = folder.run(&["help", "run"]).exits(0).out;
    assert!(run.contains("--uncertainty") && run.contains("lptn run motor.toml"), "{run}");
    assert!(folder.run(&["help", "fit", "network"]).exits(0).out.contains("--starts"));
    folder.run(&["gearbox.toml"]).exits(2).says("input::no_verb").says("`lptn run gearbox.toml`");
    folder.run(&["record.csv"]).exits(2).says("`lptn fit step record.csv`");
    folder.run(&["rnu", "gearbox.toml"]).exits(2).says("did you mean `lptn run`?");
    folder.run(&["help", "rnu"]).exits(2).says("did you mean `lptn help run`?");
    folder.write("motor", "format = 1");
    folder.run(&["motor"]).exits(2).says("motor is a file").says("`lptn run motor`");
    std::fs::create_dir(folder.path().join("results")).unwrap();
    folder.run(&["results"]).exits(2).says("`lptn report results`");
    let fit = folder.run(&["fit", "gearbox.toml"]).exits(2);
    fit.says("`lptn fit network gearbox.toml`");
}

/// An option of another verb was answered with a tip about `--`.
#[test]
fn an_option_that_a_verb_does_not_have_is_told_where_it_is() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["size", "gearbox.toml", "--temperature-unit", "K"]).exits(2);
    let ran = ran.says("`lptn size` has no option `--temperature-unit`").says("`lptn graph`");
    assert!(!ran.err.contains("-- --"), "{}", ran.err);
    let ran = folder.run(&["fit", "network", "gearbox.toml", "--quorum"]).exits(2);
    ran.says("`lptn fit network` has no option `--quorum`");
    // a slip of an option of its own is the parser's to tell
    folder.run(&["run", "gearbox.toml", "--toleranse", "1e-5K"]).exits(2).says("--tolerance");
}

/// A file was written, and only then its report refused.
#[test]
fn a_verb_without_a_report_says_so_before_it_works() {
    let folder = Folder::empty();
    folder.run(&["new", "motor", "--report"]).exits(2).says("report::nothing");
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

/// The list of verbs with a picture was written by hand, and seven were left out.
#[test]
fn verbs_with_pictures_are_those_that_draw() {
    let ran = Folder::with_gearbox().run(&["verify", "gearbox.toml", "--plot", "x.svg"]).exits(2);
    for verb in ["plot", "rank", "sweep", "infer", "plan", "impedance", "gear"] {
        assert!(ran.err.contains(verb), "{verb}: {}", ran.err);
    }
    assert!(!ran.err.contains("verify,"), "{}", ran.err);
}

/// A path in other letters of case, or with backslashes, was only said not to be there.
#[test]
fn a_path_that_leads_nowhere_is_told_the_one_that_was_meant() {
    let signal = "[signal]\npower = { csv = 'PATH', time = \"t\", value = \"power\", after_end \
        = \"hold\" }\n";
    let text = format!("{}{signal}", BODY.replace("\"100 W\"", "\"power\""));
    let folder = Folder::empty();
    std::fs::create_dir(folder.path().join("data")).unwrap();
    folder.write("data/cycle.csv", "t [s],power [W]\n0,10\n60,20\n");
    for path in ["Data/Cycle.CSV", "data\\cycle.csv", "data/cylce.csv"] {
        folder.write("net.toml", &text.replace("PATH", path));
        folder.run(&["check", "net.toml"]).exits(1).prints("did you mean \"data/cycle.csv\"?");
    }
    folder.write("net.toml", &text.replace("'PATH'", "\"data\\tcycle.csv\""));
    folder.run(&["check", "net.toml"]).exits(1).prints("write the path with `/`");
    folder.write("net.toml", &text.replace("PATH", "data/cycle.csv"));
    folder.run(&["check", "net.toml"]).exits(0);
    folder.run(&["run", "Net.TOML"]).exits(2).says("did you mean net.toml?");
    folder.run(&["run", ".\\net.toml"]).exits(2).says("did you mean ./net.toml?");
    folder.run(&["run", "."]).exits(2).says("name a netlist in it, for example ./net.toml");
}

/// Every line of a CSV file in the place of a netlist was a mistake in TOML.
#[test]
fn a_file_of_another_kind_is_named_once() {
    let folder = Folder::with_gearbox();
    let rows: String = (0..400).map(|i| format!("{i},25.5,25\n")).collect();
    folder.write("record.csv", &format!("t [s],ring [degC],bed [degC]\n{rows}"));
    let ran = folder.run(&["run", "record.csv"]).exits(2).says("netlist::not_a_netlist");
    assert_eq!(ran.err.matches("error[").count(), 1, "{}", ran.err);
    let ran = ran.says("`lptn fit step record.csv`");
    assert!(ran.err.lines().count() < 12, "{}", ran.err);
    folder.write("state.json", "{\n\"format\": 1,\n\"temperatures\": {}\n}\n");
    folder.run(&["run", "state.json"]).exits(2).says("`initial = \"state.json\"`");
    folder.run(&["fit", "step", "gearbox.toml"]).exits(2).says("`lptn fit network gearbox.toml`");
    // a netlist with a mistake stays one
    folder.write("wrong.toml", &GEARBOX.replace("T0 = \"T_amb\"", "T0 = T_amb"));
    folder.run(&["check", "wrong.toml"]).exits(2).prints("netlist::unquoted");
}
