//! The best set of sensors of each number and the best run, against every set and every run by
//! brute force: own steps in time, derivatives as differences, own elimination.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::design::{DesignTask, design};
use lptn_netlist::parse;
use lptn_solve::Proceed;

/// alpha in W/(rad/s)^(5/3), R_internal, R_skin, C of steel.
type Values = [f64; 4];
type Row = [f64; 3];

const SPEEDS: [f64; 3] = [2000.0, 5000.0, 7000.0];
const EVERY: f64 = 10.0;
const ROWS: usize = 151;

/// Name, what it measures, noise and offset in K. The offset is known to so much beforehand.
const PLACES: [(&str, Row, f64, f64); 6] = [
    ("ring", [1.0, 0.0, 0.0], 0.1, 1.7),
    ("carrier", [1.0, 0.0, 0.0], 0.5, 0.3),
    ("house", [0.0, 1.0, 0.0], 0.1, 1.7),
    ("skin", [0.0, 1.0, 0.0], 0.3, 0.5),
    ("bed", [0.0, 0.0, 1.0], 0.1, 1.7),
    ("between", [0.5, 0.5, 0.0], 0.2, 1.0),
];

fn values() -> Values {
    [87e-6 / (std::f64::consts::PI / 30.0_f64).powf(5.0 / 3.0), 7.7e-3, 0.36, 1235.0]
}

fn course(values: Values, rpm: f64) -> Vec<Row> {
    let [alpha, inside, skin, steel] = values;
    let power = alpha * (rpm * std::f64::consts::PI / 30.0).powf(5.0 / 3.0);
    let rate = |t: Row| {
        let (flow, bed) = ((t[0] - t[1]) / inside, (t[1] - t[2]) / 1.05);
        [(power - flow) / steel, (flow - bed - t[1] / skin) / 1424.0, (bed - t[2] / 2.16) / 1670.0]
    };
    let h = 0.25;
    let moved = |t: Row, k: Row, by: f64| -> Row { std::array::from_fn(|i| t[i] + by * k[i]) };
    let (mut t, mut rows) = ([0.0; 3], vec![[0.0; 3]]);
    for _ in 1..ROWS {
        for _ in 0..(EVERY / h) as usize {
            let a = rate(t);
            let b = rate(moved(t, a, h / 2.0));
            let c = rate(moved(t, b, h / 2.0));
            let d = rate(moved(t, c, h));
            t = std::array::from_fn(|i| t[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        rows.push(t);
    }
    rows
}

/// Derivatives of every node's temperature by the four values, row by row.
fn slopes(rpm: f64) -> Vec<[Row; 4]> {
    let by = |k: usize| -> Vec<Row> {
        let step = 1e-4 * values()[k];
        let at = |sign: f64| {
            let mut moved = values();
            moved[k] += sign * step;
            course(moved, rpm)
        };
        let difference = |(up, down): (&Row, &Row)| -> Row {
            std::array::from_fn(|i| (up[i] - down[i]) / (2.0 * step))
        };
        at(1.0).iter().zip(&at(-1.0)).map(difference).collect()
    };
    let all: [Vec<Row>; 4] = std::array::from_fn(by);
    (0..ROWS).map(|row| std::array::from_fn(|k| all[k][row])).collect()
}

/// The inverse by Gauss and Jordan, with scaled unknowns.
fn inverse(a: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = a.len();
    let scale: Vec<f64> = (0..n).map(|i| a[i][i].sqrt()).collect();
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let own = (0..n).map(|j| a[i][j] / (scale[i] * scale[j]));
            own.chain((0..n).map(|j| f64::from(u8::from(i == j)))).collect()
        })
        .collect();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).unwrap();
        rows.swap(k, best);
        let pivot = rows[k][k];
        rows[k].iter_mut().for_each(|x| *x /= pivot);
        let own = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
            debug_assert!(i < n);
        }
    }
    (0..n).map(|i| (0..n).map(|j| rows[i][n + j] / (scale[i] * scale[j])).collect()).collect()
}

/// Errors of the four values, of which the last is known to 5 % beforehand.
fn errors(places: &[usize], slopes: &[[Row; 4]]) -> Values {
    let n = 4 + places.len();
    let mut a = vec![vec![0.0; n]; n];
    a[3][3] = (0.05 * values()[3]).powi(-2);
    for (k, &place) in places.iter().enumerate() {
        let (_, of, noise, offset) = PLACES[place];
        a[4 + k][4 + k] += offset.powi(-2);
        for row in slopes {
            let mut x = vec![0.0; n];
            for i in 0..4 {
                x[i] = (0..3).map(|node| of[node] * row[i][node]).sum::<f64>() / noise;
            }
            x[4 + k] = 1.0 / noise;
            for i in 0..n {
                for j in 0..n {
                    a[i][j] += x[i] * x[j];
                }
            }
        }
    }
    let inverse = inverse(&a);
    std::array::from_fn(|i| inverse[i][i].sqrt())
}

/// The largest error over what it may be: 1 % of alpha, 5 % of R_internal.
fn worst(errors: &Values) -> f64 {
    (errors[0] / (0.01 * values()[0])).max(errors[1] / (0.05 * values()[1]))
}

fn text() -> String {
    let sensor = |(name, _, _, offset): &(&str, Row, f64, f64)| {
        format!("{name} = {{ offset = \"0 ± {offset} K\" }}\n")
    };
    let place = |(name, of, noise, _): &(&str, Row, f64, f64)| {
        let of = match *of {
            [one, ..] if one > 0.9 => "steel.T",
            [_, one, _] if one > 0.9 => "aluminium.T",
            [.., one] if one > 0.9 => "bed.T",
            _ => "mean(steel.T, aluminium.T)",
        };
        format!("{name} = {{ of = \"{of}\", noise = \"{noise} K\", sensor = \"{name}\" }}")
    };
    let sensors: String = PLACES.iter().map(sensor).collect();
    let places: Vec<String> = PLACES.iter().map(place).collect();
    let speeds: Vec<String> = SPEEDS.iter().map(|rpm| format!("\"{rpm} rpm\"")).collect();
    format!(
        "format = 1\n[param]\nalpha = \"87 uW/rpm^(5/3)\"\nomega = \"7000 rpm\"\n\
         R_internal = \"7.7 mK/W\"\nR_skin = \"0.36 K/W\"\nC_steel = \"1235 ± 61.75 J/K\"\n\
         [default]\nT0 = \"25.5 degC\"\n[node]\nsteel = {{ C = \"C_steel\" }}\n\
         aluminium = {{ C = \"1424 J/K\" }}\nbed = {{ C = \"1670 J/K\" }}\n[boundary]\n\
         room = {{ T = \"25.5 degC\" }}\n[resistor]\n\
         internal = {{ from = \"steel\", to = \"aluminium\", R = \"R_internal\" }}\n\
         fixture = {{ from = \"aluminium\", to = \"bed\", R = \"1.05 K/W\" }}\n\
         mill = {{ from = \"bed\", to = \"room\", R = \"2.16 K/W\" }}\n\
         skin = {{ from = \"aluminium\", to = \"room\", R = \"R_skin\" }}\n\
         [source]\nP_disp = {{ into = \"steel\", P = \"alpha * omega^(5/3)\" }}\n\
         [sensor]\n{sensors}[plan.next]\nknow = {{ alpha = \"1 %\", R_internal = \"5 %\" }}\n\
         vary = [\"R_skin\", \"C_steel\"]\nplace = {{ {} }}\nevery = \"{EVERY} s\"\n\
         duration = \"25 min\"\nrun = {{ at = {{ set = {{ omega = [{}] }} }} }}\n",
        places.join(", "),
        speeds.join(", ")
    )
}

#[test]
fn analytic_best_sets_are_those_of_brute_force() {
    let text = text();
    let netlist = parse("gearbox.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let study = &netlist.studies.plans[0];
    let task = DesignTask::of(&netlist, study, (2, &|_, _| Proceed::Continue)).unwrap();
    let found = design(&task, &|_, _| Proceed::Continue).unwrap();
    assert!(found.searched.all && found.searched.sets == 63);
    let slopes = SPEEDS.map(slopes);
    for size in 1..=PLACES.len() {
        let mut best = (f64::INFINITY, Vec::new(), 0, [0.0; 4]);
        for mask in (1..64_usize).filter(|mask| mask.count_ones() as usize == size) {
            let places: Vec<usize> = (0..6).filter(|place| mask >> place & 1 == 1).collect();
            for (run, slopes) in slopes.iter().enumerate() {
                let errors = errors(&places, slopes);
                if worst(&errors) < best.0 {
                    best = (worst(&errors), places.clone(), run, errors);
                }
            }
        }
        let set = &found.sets[size - 1];
        assert_eq!((&set.places, set.run), (&best.1, Some((best.2, ROWS))));
        for (found, expected) in set.errors.iter().zip(&best.3) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} is not {expected}");
        }
    }
}
