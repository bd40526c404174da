//! Whether laws of rise, time constant and power can be true together: as text, as JSON, and the form without points.

use lptn_report::{Align, Column, JsonWriter, TextTable, WIDTH, fixed, labelled, significant, write_csv};
use lptn_solve::Table;
use lptn_study::Scalar;
use lptn_study::fit::law::{AtSpeed, Consistency, Exponent, LawError, LawOf, Significance, StatedLaw};
use lptn_study::fit::step::Capacity;
use lptn_units::{Dimension, Type, parse_quantity};
use serde_json::{Value, json};

use super::args::LawArgs;
use super::shown::{SpeedUnit, with_error};
use super::{wrong, wrong_law};
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::wrong_unit;
use crate::options::Format;

/// Compares three laws of the command line.
pub(crate) fn laws(args: &LawArgs, capacity: Option<Capacity>, console: &Console) -> Result<Exit, Failure> {
    let law = |option: &str, of: LawOf, text: &Option<String>| {
        let text = text.as_deref().unwrap_or_default();
        StatedLaw::parse(of, text).map_err(|error| wrong_law(option, text, &error))
    };
    let stated = [
        law("--dT", LawOf::Rise, &args.laws.rise_law)?,
        law("--t_RC", LawOf::TimeConstant, &args.laws.time_constant_law)?,
        law("--P", LawOf::Power, &args.laws.power_law)?,
    ];
    let range = range(args.laws.over.as_deref().unwrap_or_default())?;
    let found = Consistency::of_laws(&stated[0], &stated[1], &stated[2], capacity, range);
    let found = found.map_err(|error| wrong(&error))?;
    let unit = SpeedUnit::rpm();
    match args.format {
        Format::Table => console.print(&text(&stated, &found, (&unit, console))).map(drop)?,
        Format::Csv => console.write(|out| write_csv(&table(&found, &unit), out))?,
        Format::Json => console.write(|out| {
            let mut json = JsonWriter::new(out);
            json.member("format", &json!(1))?;
            json.member("warnings", &json!([]))?;
            json.member("consistency", &members(&found))?;
            json.finish().map(drop)
        })?,
    }
    if found.agrees() {
        return Ok(Exit::Done);
    }
    if args.format != Format::Table {
        console.message(&verdict(&found, &unit));
    }
    Ok(Exit::No)
}

/// `1000 rpm to 7000 rpm`.
fn range(text: &str) -> Result<(f64, f64), Failure> {
    let Some((low, high)) = text.split_once(" to ").or_else(|| text.split_once("..")) else {
        return Err(wrong(&LawError::Range));
    };
    let speed = |text: &str| {
        let found = parse_quantity(text.trim(), Some(Type::of(Dimension::ANGULAR_VELOCITY)));
        found.map(|speed| speed.value).map_err(|error| wrong_unit("--over", text.trim(), &error))
    };
    Ok((speed(low)?, speed(high)?))
}

fn text(laws: &[StatedLaw; 3], found: &Consistency, (unit, console): (&SpeedUnit, &Console)) -> String {
    let over = unit.range(found.range);
    let mut lines = vec![console.title(&format!("Three laws of the speed, {over}")), String::new()];
    let exponents = [found.rise, found.time_constant, found.power];
    let table = TextTable::new(vec![
        Column::new("of", Align::Left, laws.iter().map(|law| law.of.symbol().to_owned()).collect()),
        Column::new("as stated", Align::Left, laws.iter().map(|law| law.text.clone()).collect()).names(),
        Column::new("exponent", Align::Right, exponents.iter().map(|e| fixed(e.value, 3)).collect()),
    ]);
    lines.extend(table.lines(WIDTH));
    lines.push(String::new());
    lines.extend(block(found, unit));
    lines.join("\n") + "\n"
}

/// What the comparison shows, in lines; the last of them is the verdict.
pub(crate) fn block(found: &Consistency, unit: &SpeedUnit) -> Vec<String> {
    let mut lines = at_speeds(found, unit);
    lines.push(String::new());
    let implied = with_error(found.implied.value, found.implied.standard_error);
    let power = with_error(found.power.value, found.power.standard_error);
    let mut pieces =
        vec![format!("dT / t_RC goes with omega^n, n = {implied};"), format!("P with n = {power}")];
    pieces.extend(found.exponents.map(|s| in_words(&s)));
    if found.exponents.is_none() && !found.derived {
        let apart = 100.0 * (found.spread() - 1.0);
        pieces.push(format!(
            "(stated without errors: no common factor brings the ends closer than {} %)",
            fixed(apart, 0)
        ));
    }
    lines.extend(sentence("exponents  ", &pieces));
    let level = match &found.level {
        Some(level) => {
            let mut pieces = vec![format!(
                "C dT / t_RC is {} of P in the middle",
                with_error(level.ratio, level.relative_error.map(|e| e * level.ratio))
            )];
            pieces.extend(level.significance.map(|s| in_words(&s)));
            pieces
        }
        None => vec![
            format!("not compared: with C = {} J/K,", significant(found.capacity, 4)),
            "not given, they agree in the middle".to_owned(),
        ],
    };
    lines.extend(sentence("level      ", &level));
    lines.push(String::new());
    lines.extend(sentence("", &[verdict(found, unit)]));
    lines
}

fn in_words(found: &Significance) -> String {
    let probability = match found.probability {
        p if p < 1e-4 => "p < 0.0001".to_owned(),
        p => format!("p = {}", significant(p, 2)),
    };
    format!("(z = {}, {probability})", fixed(found.z, 1))
}

/// A sentence behind a label, wrapped between words.
pub(crate) fn sentence(label: &str, pieces: &[String]) -> Vec<String> {
    let words: Vec<String> = pieces.join(" ").split(' ').map(str::to_owned).collect();
    labelled(label, &words, WIDTH)
}

fn at_speeds(found: &Consistency, unit: &SpeedUnit) -> Vec<String> {
    let column = |title: &str, cell: &dyn Fn(&AtSpeed) -> String| {
        Column::new(title, Align::Right, found.at.iter().map(cell).collect())
    };
    let table = TextTable::new(vec![
        column(&format!("omega [{}]", unit.0.text), &|at| significant(unit.0.from_si(at.speed), 4)),
        column("dT [K]", &|at| fixed(at.rise, 1)),
        column("t_RC [min]", &|at| fixed(at.time_constant / 60.0, 1)),
        column("C dT / t_RC [W]", &|at| fixed(at.implied, 1)),
        column("P [W]", &|at| fixed(at.power, 1)),
        column("C dT / P [min]", &|at| fixed(at.needed / 60.0, 1)),
    ]);
    table.lines(WIDTH)
}

/// One sentence with the answer.
pub(crate) fn verdict(found: &Consistency, unit: &SpeedUnit) -> String {
    let [low, _, high] = &found.at;
    if found.exponents_contradict() {
        let time = |at: &AtSpeed| format!("{} min at {}", fixed(at.needed / 60.0, 1), unit.speed(at.speed));
        return format!(
            "contradiction: dT and t_RC imply a power that goes with {}, not {}; all three hold only if t_RC goes with \
             {}: {} and {}",
            power(found.implied.value),
            power(found.power.value),
            power(found.rise.value - found.power.value),
            time(low),
            time(high),
        );
    }
    if let Some(level) = found.level.filter(|_| found.levels_contradict()) {
        let ratio = significant(level.ratio, 3);
        return format!(
            "contradiction: C dT / t_RC is {ratio} times P at every speed: is the capacity right?"
        );
    }
    if found.derived {
        return "the power was computed from dT and t_RC of the same points, so their agreement proves nothing"
            .to_owned();
    }
    if let Some(error) = found.level.and_then(|level| level.relative_error).filter(|error| *error > TOO_ROUGH)
    {
        let percent = significant(100.0 * error, 2);
        return format!(
            "nothing is contradicted and nothing is tested: C dT / t_RC over P is known to {percent} % only"
        );
    }
    "dT, t_RC and P agree: P = C dT / t_RC holds at all speeds, within their errors".to_owned()
}

/// A relative standard error from which on a ratio tells nothing.
const TOO_ROUGH: f64 = 0.5;

/// A power of the speed in a sentence: `omega^(-0.67)`, `omega`.
fn power(value: f64) -> String {
    match significant((value * 100.0).round() / 100.0, 3).as_str() {
        "1" => "omega".to_owned(),
        text if text.contains(['.', '-']) => format!("omega^({text})"),
        text => format!("omega^{text}"),
    }
}

/// The comparison at three speeds.
fn table(found: &Consistency, unit: &SpeedUnit) -> Table {
    let mut table = Table::of(&found.at);
    table.column("omega", &unit.0.text, |at| unit.0.from_si(at.speed));
    table.column("dT", "K", |at| at.rise);
    table.column("t_RC", "s", |at| at.time_constant);
    table.column("P_implied", "W", |at| at.implied);
    table.column("P", "W", |at| at.power);
    table.column("t_RC_needed", "s", |at| at.needed);
    table.done()
}

/// The comparison as JSON.
pub(crate) fn members(found: &Consistency) -> Value {
    let exponent =
        |e: &Exponent| json!({ "value": e.value, "unit": "1", "standard_error": e.standard_error });
    let scalar = |value: f64, unit: &str| Scalar::new(value, unit).json();
    let tested = |s: &Option<Significance>| s.map(|s| json!({ "z": s.z, "probability": s.probability }));
    let at = |at: &AtSpeed| {
        json!({
            "speed": scalar(at.speed, "rad/s"),
            "dT": scalar(at.rise, "K"),
            "t_RC": scalar(at.time_constant, "s"),
            "P_implied": scalar(at.implied, "W"),
            "P": scalar(at.power, "W"),
            "t_RC_needed": scalar(at.needed, "s"),
        })
    };
    let level = found.level.map(|level| {
        json!({
            "ratio": { "value": level.ratio, "unit": "1",
                       "standard_error": level.relative_error.map(|e| e * level.ratio) },
            "test": tested(&level.significance),
        })
    });
    json!({
        "agrees": found.agrees(),
        "exponents": {
            "dT": exponent(&found.rise),
            "t_RC": exponent(&found.time_constant),
            "P_implied": exponent(&found.implied),
            "P": exponent(&found.power),
            "difference": exponent(&found.difference),
            "test": tested(&found.exponents),
        },
        "spread": found.spread(),
        "capacity": scalar(found.capacity, "J/K"),
        "level": level,
        "derived": found.derived,
        "at": found.at.iter().map(at).collect::<Vec<_>>(),
    })
}
