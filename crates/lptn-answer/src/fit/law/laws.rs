//! Consistency of laws of rise, time constant and power: as text, as JSON, and as a question
//! without points.

use std::io;

use lptn_fit::law::{AtSpeed, Consistency, Exponent, LawError, LawOf, Significance, StatedLaw};
use lptn_netlist::{Diagnostic, Files};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Rows, Text, TextTable, fixed, significant};
use lptn_solve::Table;
use lptn_study::SiValue;
use lptn_units::{Dimension, Type};
use serde_json::{Value, json};

use super::shown::{SpeedUnit, chance, with_error};
use super::{capacity, wrong_law};
use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::quantity;

/// Asks if three laws of the speed can be true together.
#[derive(Clone, Debug, Default)]
pub struct StatedLawsQuestion {
    /// The law of the temperature rise: `0.0084 ± 0.0011 K/rpm`, or an expression in `omega`.
    pub rise: String,
    /// The law of the time constant: `18.6 ± 3.8 min`.
    pub time_constant: String,
    /// The law of the power: `87 ± 15 uW/rpm^(5/3)`.
    pub power: String,
    /// Range of speeds to compare: `1000 rpm to 7000 rpm`.
    pub over: String,
    /// The heat capacity, `2659 J/K ± 5 %`; `None` for one that is not known.
    pub capacity: Option<String>,
}

/// Three laws and their consistency.
#[derive(Debug)]
pub struct StatedLawsAnswer {
    pub(super) laws: [StatedLaw; 3],
    /// Consistency of rise, time constant and power.
    pub found: Consistency,
    pub(super) unit: SpeedUnit,
    files: Files,
}

impl StatedLawsQuestion {
    /// Asks.
    ///
    /// # Errors
    /// A law, a range or a capacity that cannot be read or compared.
    pub fn ask(&self) -> Result<StatedLawsAnswer, Failure> {
        let capacity = capacity(self.capacity.as_deref())?;
        let law = |option: &str, of: LawOf, text: &str| {
            StatedLaw::parse(of, text).map_err(|error| wrong_law(option, text, &error))
        };
        let laws = [
            law("--dT", LawOf::Rise, &self.rise)?,
            law("--t_RC", LawOf::TimeConstant, &self.time_constant)?,
            law("--P", LawOf::Power, &self.power)?,
        ];
        let range = range(&self.over)?;
        let found = Consistency::of_laws(&laws[0], &laws[1], &laws[2], capacity, range);
        let found = found.map_err(|error| Failure::of(&error))?;
        Ok(StatedLawsAnswer { laws, found, unit: SpeedUnit::rpm(), files: Files::new() })
    }
}

impl Answer for StatedLawsAnswer {
    fn files(&self) -> &Files {
        &self.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

impl Page for StatedLawsAnswer {
    fn text(&self) -> Text {
        let over = self.unit.range(self.found.range);
        let mut text = Text::titled(format!("Three laws of the speed, {over}"));
        let exponents = [self.found.rise, self.found.time_constant, self.found.power];
        let rows: Vec<_> = self.laws.iter().zip(exponents).collect();
        text.section().table(
            TextTable::of(&rows)
                .left("of", |(law, _)| law.of.symbol())
                .left("as stated", |(law, _)| law.text.as_str())
                .names()
                .right("exponent", |(_, exponent)| fixed(exponent.value, 3)),
        );
        sections(&mut text, &self.found, &self.unit);
        text
    }

    /// The comparison at three speeds.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&self.found.at);
        table.column("omega", &self.unit.0.text, |at| self.unit.0.from_si(at.speed));
        table.column("dT", "K", |at| at.rise);
        table.column("t_RC", "s", |at| at.time_constant);
        table.column("P_implied", "W", |at| at.implied);
        table.column("P", "W", |at| at.power);
        table.column("t_RC_needed", "s", |at| at.needed);
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        json.member("format", &1)?;
        json.member("warnings", &json!([]))?;
        json.member("consistency", &members(&self.found))
    }

    fn no(&self) -> Option<String> {
        (!self.found.agrees()).then(|| verdict(&self.found, &self.unit))
    }
}

/// `1000 rpm to 7000 rpm`.
fn range(text: &str) -> Result<(f64, f64), Failure> {
    let Some((low, high)) = text.split_once(" to ").or_else(|| text.split_once("..")) else {
        return Err(Failure::of(&LawError::Range));
    };
    let speed = |text: &str| {
        quantity("--over", text.trim(), Type::of(Dimension::ANGULAR_VELOCITY))
            .map(|speed| speed.value)
    };
    Ok((speed(low)?, speed(high)?))
}

/// Adds the comparison in sections, of which the last is the verdict.
pub(super) fn sections(text: &mut Text, found: &Consistency, unit: &SpeedUnit) {
    text.section().table(at_speeds(found, unit));
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
    text.section().sentence("exponents  ", &pieces.join(" "));
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
    text.sentence("level      ", &level.join(" "));
    text.section().sentence("", &verdict(found, unit));
}

fn in_words(found: &Significance) -> String {
    format!("(z = {}, {})", fixed(found.z, 1), chance(found.probability))
}

fn at_speeds(found: &Consistency, unit: &SpeedUnit) -> TextTable {
    TextTable::of(&found.at)
        .right(format!("omega [{}]", unit.0.text), |at| significant(unit.0.from_si(at.speed), 4))
        .right("dT [K]", |at| fixed(at.rise, 1))
        .right("t_RC [min]", |at| fixed(at.time_constant / 60.0, 1))
        .right("C dT / t_RC [W]", |at| fixed(at.implied, 1))
        .right("P [W]", |at| fixed(at.power, 1))
        .right("C dT / P [min]", |at| fixed(at.needed / 60.0, 1))
        .into()
}

/// One sentence with the answer.
pub(super) fn verdict(found: &Consistency, unit: &SpeedUnit) -> String {
    let [low, _, high] = &found.at;
    if found.exponents_contradict() {
        let time = |at: &AtSpeed| {
            format!("{} min at {}", fixed(at.needed / 60.0, 1), unit.speed(at.speed))
        };
        return format!(
            "contradiction: dT and t_RC imply a power that goes with {}, not {}; all three agree \
             only if t_RC goes with {}: {} and {}",
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
        return "the power was computed from dT and t_RC of the same points, so their agreement \
            proves nothing"
            .to_owned();
    }
    if let Some(error) =
        found.level.and_then(|level| level.relative_error).filter(|error| *error > TOO_ROUGH)
    {
        let percent = significant(100.0 * error, 2);
        return format!(
            "nothing is contradicted and nothing is tested: C dT / t_RC over P is known to \
             {percent} % only"
        );
    }
    "dT, t_RC and P agree: P = C dT / t_RC is true at all speeds, within their errors".to_owned()
}

/// Relative standard error from which a ratio is meaningless.
const TOO_ROUGH: f64 = 0.5;

/// A power of the speed in a sentence: `omega^(-0.67)`, `omega`.
fn power(value: f64) -> String {
    match significant((value * 100.0).round() / 100.0, 3).as_str() {
        "1" => "omega".to_owned(),
        text if text.contains(['.', '-']) => format!("omega^({text})"),
        text => format!("omega^{text}"),
    }
}

/// The comparison as JSON.
pub(super) fn members(found: &Consistency) -> Value {
    let exponent =
        |e: &Exponent| json!({ "value": e.value, "unit": "1", "standard_error": e.standard_error });
    let scalar = SiValue::new;
    let tested =
        |s: &Option<Significance>| s.map(|s| json!({ "z": s.z, "probability": s.probability }));
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
