//! Kind: analytic. Curves between the rows: jumps, constant temperatures far away, outliers, dots.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::fit_pages::charts;
use crate::picture;

use common::Folder;
use picture::Picture;

/// 100 W from 10 min to 20 min into 1 kJ/K that 2 W/K cool: the time constant is 500 s, and rows of
/// 4 min miss both jumps.
const STEP: &str = "format = 1
[signal]
on = { t = [0, 10, 20], v = [0, 100, 0], t_unit = 'min', v_unit = 'W', interp = 'previous', after_end = 'hold' }
[node]
a = { C = '1 kJ/K', T0 = '25 degC' }
[boundary]
air = { T = '25 degC' }
[resistor]
r = { from = 'a', to = 'air', R = '0.5 K/W' }
[source]
s = { into = 'a', P = 'on' }
[run]
stop = '1 h'
output = { every = '4 min' }
";

const HEAT: &str = "heat flow [W]";
const TEMPERATURE: &str = "temperature [\u{b0}C]";

/// The values of a line at a time in min.
fn at(line: &[(f64, f64)], minutes: f64) -> Vec<f64> {
    line.iter().filter(|point| (point.0 - minutes).abs() < 1e-3).map(|point| point.1).collect()
}

fn near(found: &[f64], expected: &[f64]) {
    let close = |(a, b): (&f64, &f64)| (a - b).abs() < 0.05;
    let same = found.len() == expected.len() && found.iter().zip(expected).all(close);
    assert!(same, "{found:?}, not {expected:?}");
}

/// A jump has two points at its time, and the temperature begins to rise there:
/// T = 25 + 50 (1 - exp(-600/500)) = 59.940 degC at its end.
#[test]
fn a_jump_is_vertical_and_heat_comes_before_the_temperature_rises() {
    let folder = Folder::with("step.toml", STEP);
    for command in
        [&["plot", "step.toml", "-o", "x.svg"][..], &["run", "step.toml", "--plot", "x.svg"]]
    {
        let ran = folder.run(command);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        let picture = Picture::read(&folder.read("x.svg"));
        let heat = picture.lines(HEAT, "series1").remove(0);
        near(&at(&heat, 10.0), &[0.0, 100.0]);
        // a row is at 20 min, after the jump
        near(&at(&heat, 20.0), &[100.0, 0.0]);
        let body = picture.lines(TEMPERATURE, "series0").remove(0);
        assert!(at(&body, 10.0).iter().all(|t| (t - 25.0).abs() < 0.05), "{body:?}");
        let peak = 25.0 + 50.0 * (1.0 - (-1.2_f64).exp());
        assert!(at(&body, 20.0).iter().all(|t| (t - peak).abs() < 0.1), "{body:?}");
    }
}

/// A fan at 30 degC on, at 28 degC off: each switch of events.csv has two points in the picture.
#[test]
fn switches_between_rows_are_vertical() {
    let text = STEP.replace(
        "[run]",
        "[control.fan]\nsense = 'a'\non_above = '30 degC'\noff_below = '28 degC'\n\
         [run]",
    );
    let text = text.replace("'0.5 K/W'", "'(0.5 - 0.1 * fan) * 1 [K/W]'");
    let folder = Folder::with("fan.toml", &text);
    folder.run(&["run", "fan.toml"]).exits(0);
    folder.run(&["plot", "fan.toml", "--select", "fan", "-o", "x.svg"]).exits(0);
    let line = Picture::read(&folder.read("x.svg")).lines("fan", "series0").remove(0);
    let events = folder.read("out/fan/events.csv");
    let switches = events.lines().skip(1).filter(|row| row.contains(",control,"));
    let times: Vec<f64> =
        switches.map(|row| row.split(',').next().unwrap().parse::<f64>().unwrap() / 60.0).collect();
    assert_eq!(times.len(), 2, "{events}");
    for (time, expected) in times.iter().zip([[0.0, 1.0], [1.0, 0.0]]) {
        let sides: Vec<f64> =
            line.iter().filter(|p| (p.0 - time).abs() < 0.01).map(|p| p.1.round()).collect();
        assert_eq!(sides, expected, "at {time} min: {line:?}");
    }
}

/// The rows are the same whether a picture is drawn or not.
#[test]
fn rows_do_not_depend_on_a_picture() {
    let folder = Folder::with("step.toml", STEP);
    folder.run(&["run", "step.toml", "-o", "plain"]).exits(0);
    folder.run(&["run", "step.toml", "-o", "drawn", "--plot", "x.svg", "--report"]).exits(0);
    assert_eq!(folder.read("plain/result.csv"), folder.read("drawn/result.csv"));
    assert_eq!(folder.read("plain/result.csv").lines().count(), 17, "a row every 4 min");
}

/// Empty space is named, and the axis belongs to the body.
#[test]
fn a_boundary_far_away_does_not_set_the_scale() {
    let text =
        STEP.replace("air = { T = '25 degC' }", "air = { T = '25 degC' }\nspace = { T = '2.7 K' }");
    let text =
        text.replace("[source]", "far = { from = 'a', to = 'space', R = '1e6 K/W' }\n[source]");
    let folder = Folder::with("space.toml", &text);
    folder.run(&["plot", "space.toml", "--select", "*.T", "-o", "x.svg"]).exits(0);
    let picture = Picture::read(&folder.read("x.svg"));
    picture.says("space at \u{2212}270.4 \u{b0}C, below the range shown");
    let marks: Vec<f64> = picture.texts.iter().filter_map(|text| text.parse().ok()).collect();
    assert!(marks.iter().all(|mark| *mark >= 0.0), "{marks:?}");
    let terminal = folder.run(&["plot", "space.toml", "--select", "*.T"]).exits(0);
    assert!(terminal.out.contains("below the range shown"), "{}", terminal.out);
}

/// A thermocouple that was off for one reading of 200 does not flatten the others.
#[test]
fn an_outlier_of_a_record_is_named() {
    let mut record = "time [s],tc [degC]\n".to_owned();
    for i in 0..200 {
        let value = if i == 77 { 9999.0 } else { 20.0 + 0.1 * f64::from(i) };
        record += &format!("{i},{value}\n");
    }
    let folder = Folder::with("record.csv", &record);
    folder.run(&["plot", "record.csv", "-o", "x.svg"]).exits(0);
    let picture = Picture::read(&folder.read("x.svg"));
    picture.says("dots of tc outside of the range shown: 1 of 200, the farthest at 9999 \u{b0}C");
    assert_eq!(picture.dots(TEMPERATURE, "series0").len(), 199);
}

/// 300 rows fall into a cycle, even if the run asks for fewer.
#[test]
fn a_cycle_has_300_rows() {
    let duty = include_str!("../../../networks/duty_cycle.toml");
    let folder = Folder::with("duty.toml", duty);
    folder.run(&["steady", "duty.toml", "--periodic", "-o", "out"]).exits(0);
    assert!(folder.read("out/result.csv").lines().count() > 300);
    folder
        .run(&["plot", "duty.toml", "--periodic", "--select", "losses.P", "-o", "x.svg"])
        .exits(0);
    let heat = Picture::read(&folder.read("x.svg")).lines(HEAT, "series0").remove(0);
    near(&at(&heat, 3.0), &[220.0, 0.0]);
}

/// A room whose time constant is 300 s / ln(21/20): 41 kW heat it from 20 to 21 degC in 5 min, and
/// it cools back to 20 degC in 5 min. Rows are a day apart, each at the beginning of a cycle.
const EACH_TEN_MINUTES: &str = "format = 1
[node]
room = { C = '6148.7802943 kJ/K', T0 = '20 degC' }
[boundary]
outside = { T = '0 degC' }
[resistor]
walls = { from = 'room', to = 'outside', G = '1 kW/K' }
[control]
thermostat = { sense = 'room', on_below = '20 degC', off_above = '21 degC', start = 'on' }
[source]
heater = { into = 'room', P = '41 [kW] * thermostat' }
[run]
stop = '365 d'
output = { every = '1 d' }
";

/// Analytic: each day of the year has the mean 20.5 degC and half of 41 kW, the thermostat is on for
/// half of it, and the room is between 20 and 21 degC. 105,120 switches are in no row.
#[test]
fn days_of_a_thermostat_have_the_means_of_the_solver() {
    let folder = Folder::with("room.toml", EACH_TEN_MINUTES);
    folder.run(&["run", "room.toml", "--no-files", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    assert!(!page.contains("straight between rows"));
    let panels = charts(&page).remove(0);
    let expected = [("room", [20.5, 20.0, 21.0], 1e-3), ("heater.P", [20_500.0, 0.0, 41e3], 5.0)];
    let expected = expected.into_iter().chain([("thermostat", [0.5, 0.0, 1.0], 1e-4)]);
    for (name, [mean, low, high], error) in expected {
        let mut curves = panels["panels"].as_array().unwrap().iter().flat_map(|panel| {
            panel["curves"].as_array().unwrap().iter().filter(|curve| curve["name"] == name)
        });
        let curve = curves.next().unwrap();
        for (key, expected) in [("y", mean), ("low", low), ("high", high)] {
            let values = curve[key].as_array().unwrap();
            assert_eq!(values.len(), 365, "{name}: {key}");
            for value in values.iter().map(|value| value.as_f64().unwrap()) {
                assert!((value - expected).abs() <= error, "{name}: {key} {value}");
            }
        }
    }
    folder.run(&["plot", "room.toml", "--daily", "--select", "*.P", "-o", "x.svg"]).exits(0);
    let lines = Picture::read(&folder.read("x.svg")).lines(HEAT, "series0");
    let heat = lines.iter().find(|line| line.len() == 365).unwrap();
    assert!(heat.iter().all(|point| (point.1 - 20_500.0).abs() < 50.0));
}

/// A part of the year of 100,000 switches has all of its own. Its curve ends 2 min after the start of
/// a cycle, at `41 - 21 (20/21)^(2/5)` degC.
#[test]
fn a_part_of_many_switches_has_each_of_its_own() {
    let folder = Folder::with("room.toml", EACH_TEN_MINUTES);
    let part = ["--from", "200d", "--to", "4802.0333333333h", "-o", "x.svg"];
    folder.run(&[&["plot", "room.toml"], &part[..]].concat()).exits(0);
    let picture = Picture::read(&folder.read("x.svg"));
    let switch = picture.lines("thermostat", "series0").remove(0);
    let edges = switch.windows(2).filter(|pair| (pair[0].1 - pair[1].1).abs() > 0.5).count();
    assert_eq!(edges, 24, "12 cycles: {switch:?}");
    let room = picture.lines(TEMPERATURE, "series0").remove(0);
    let last = room[room.len() - 1];
    let end = 41.0 - 21.0 * (20.0_f64 / 21.0).powf(0.4);
    assert!((last.1 - end).abs() < 0.003, "{last:?} {end}");
    let middle: Vec<f64> = room.iter().map(|point| point.1).collect();
    assert!(middle.iter().all(|t| (19.95..=21.05).contains(t)) && room.len() > 300);
}

/// Rows alone know no more: the picture of an earlier run says so.
#[test]
fn days_of_rows_are_straight_between_them() {
    let folder = Folder::with("room.toml", EACH_TEN_MINUTES);
    folder.run(&["run", "room.toml", "--stop", "5d", "-o", "out"]).exits(0);
    folder.run(&["plot", "out", "--daily", "-o", "x.svg"]).exits(0);
    Picture::read(&folder.read("x.svg"))
        .says("means of days, bands from the lowest to the highest value, straight between rows");
}
