//! Kind: command line. Options of `lptn plot`: part of the time, size, colours, units, days.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::picture;

use common::Folder;
use picture::Picture;

/// Three days of 1 kW, in a room that loses nothing else than by a large resistance.
const ROOM: &str = "format = 1
title = 'Room'
[param]
heat = '1 kW'
[case.cold]
set = { heat = '2 kW' }
[node]
room = { C = '1 MJ/K', T0 = '20 degC' }
[boundary]
air = { T = '20 degC' }
[resistor]
wall = { from = 'room', to = 'air', G = '50 W/K' }
[source]
heater = { into = 'room', P = 'heat' }
[state]
energy = { start = '0 J', rate = 'heat', size = '1 MJ' }
[run]
stop = '3 d'
output = { every = '1 h' }
";

fn drawn(folder: &Folder, options: &[&str]) -> Picture {
    let arguments = [&["plot", "room.toml", "-o", "x.svg"], options].concat();
    let ran = folder.run(&arguments);
    assert_eq!(ran.code, Some(0), "{arguments:?}: {}", ran.err);
    Picture::read(&folder.read("x.svg"))
}

/// 1 kW over 3 d are 72 kWh.
#[test]
fn energies_are_shown_in_kilowatt_hours() {
    let folder = Folder::with("room.toml", ROOM);
    let options = ["--select", "energy", "--energy-unit", "kWh"];
    let line = drawn(&folder, &options).lines("heat [kWh]", "series0").remove(0);
    let (_, last) = line[line.len() - 1];
    assert!((last - 72.0).abs() < 0.05, "{last}");
}

#[test]
fn a_part_of_the_time_begins_and_ends_there() {
    let folder = Folder::with("room.toml", ROOM);
    let options = ["--select", "energy", "--from", "10.5h", "--to", "20h", "--energy-unit", "kWh"];
    let line = drawn(&folder, &options).lines("heat [kWh]", "series0").remove(0);
    let near = |(x, y): (f64, f64), (u, v): (f64, f64)| {
        assert!((x - u).hypot(y - v) < 0.02, "({x}, {y}), not ({u}, {v})");
    };
    near(line[0], (10.5, 10.5));
    near(line[line.len() - 1], (20.0, 20.0));
}

/// The energy grows by 24 kWh a day: means of 12, 36 and 60 kWh in bands of 24 kWh.
#[test]
fn days_are_means_in_bands() {
    let folder = Folder::with("room.toml", ROOM);
    let options = ["--select", "energy", "--daily", "--energy-unit", "kWh"];
    let picture = drawn(&folder, &options);
    picture.says("means of days");
    let lines = picture.lines("heat [kWh]", "series0");
    let means: Vec<f64> =
        lines.iter().find(|l| l.len() == 3).unwrap().iter().map(|p| p.1).collect();
    let close = |expected: [f64; 3]| means.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.05);
    assert!(close([12.0, 36.0, 60.0]), "{means:?}");
    let band = lines.iter().find(|line| line.len() > 3).unwrap();
    let (least, most) =
        band.iter().fold((f64::INFINITY, 0.0_f64), |a, p| (a.0.min(p.1), a.1.max(p.1)));
    assert!(least.abs() < 0.05 && (most - 72.0).abs() < 0.05, "{band:?}");
}

#[test]
fn a_case_a_title_a_size_and_a_theme_are_taken() {
    let folder = Folder::with("room.toml", ROOM);
    let options =
        ["--case", "cold", "--title", "Cold & long", "--size", "160x90mm", "--theme", "dark"];
    let picture = drawn(&folder, &[&options[..], &["--select", "heater.P"]].concat());
    picture.says("Cold &amp; long");
    let line = picture.lines("heat flow [W]", "series0").remove(0);
    assert!(line.iter().all(|point| (point.1 - 2000.0).abs() < 1.0), "{line:?}");
    let svg = folder.read("x.svg");
    // 160 mm and 90 mm are 604.72 and 340.16 CSS pixels; the first path is the paper
    assert!(svg.contains("width=\"604.72\" height=\"340.16\""), "{}", &svg[..200]);
    assert!(svg.contains("fill=\"#14171c\""), "the paper is dark");
}

/// IHDR: width and height after 16 bytes.
#[test]
fn a_png_has_the_pixels_of_its_size_and_resolution() {
    let folder = Folder::with("room.toml", ROOM);
    let options = ["plot", "room.toml", "-o", "x.png", "--size", "6x4in", "--dpi", "300"];
    folder.run(&options).exits(0);
    let bytes = std::fs::read(folder.path().join("x.png")).unwrap();
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (1800, 1200));
}

/// Two files next to each other, each under its name.
#[test]
fn files_stand_in_columns() {
    let folder = Folder::with("room.toml", ROOM);
    folder.write("warm.toml", &ROOM.replace("'1 kW'", "'3 kW'"));
    let arguments = ["plot", "room.toml", "warm.toml", "--select", "room.T", "--columns", "2"];
    folder.run(&[&arguments[..], &["-o", "x.svg"]].concat()).exits(0);
    let picture = Picture::read(&folder.read("x.svg"));
    picture.says("room").says("warm");
    assert_eq!(picture.panels.len(), 2);
    let one = folder.read("x.svg");
    folder.run(&["plot", "room.toml", "--columns", "2", "-o", "x.svg"]).exits(0);
    assert!(folder.read("x.svg") != one);
}

#[test]
fn views_that_show_nothing_are_refused() {
    let folder = Folder::with("room.toml", ROOM);
    folder.run(&["run", "room.toml"]).exits(0);
    let cases: [(&[&str], &str); 8] = [
        (&["--from", "4d"], "no curve has a value between --from and --to"),
        (&["--from", "2d", "--to", "1d"], "end before it begins"),
        (&["--from", "2 K"], "--from"),
        (&["--energy-unit", "W"], "must be a unit of energy"),
        (&["--size", "3x4"], "of 100 to 20000 pixels"),
        (&["--columns", "0"], "0 is not in 1..=12"),
        (&["--theme", "red"], "--theme"),
        (&["--periodic", "--stop", "1h"], "--stop"),
    ];
    for (options, wanted) in cases {
        let ran = folder.run(&[&["plot", "room.toml"], options].concat());
        assert_eq!(ran.code, Some(2), "{options:?}: {}", ran.err);
        assert!(ran.err.contains(wanted), "{options:?}: {}", ran.err);
    }
    for option in [&["--case", "cold"][..], &["--periodic"]] {
        let ran = folder.run(&[&["plot", "out/room"], option].concat()).exits(2);
        assert!(ran.err.contains("no netlist is among the files"), "{}", ran.err);
    }
}
