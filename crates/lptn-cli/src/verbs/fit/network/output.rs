//! The files of `lptn fit network -o DIR`: what was measured beside what the fitted network
//! computes, the answer, what studies go on from, and their manifest.

use lptn_report::{Format, Look, write_csv};
use lptn_solve::Table;
use lptn_units::Type;

use super::Answer;
use super::units::Shown;
use crate::files::names::{FIT, MANIFEST, POSTERIOR, RESIDUALS};
use crate::files::{self, Folder};
use lptn_answer::about;
use lptn_answer::failure::Failure;

/// What may be written.
const NAMES: [&str; 4] = [RESIDUALS, FIT, POSTERIOR, MANIFEST];

/// Writes the files, and says which: there is a posterior only where every value is determined.
pub(crate) fn write(
    answer: &Answer<'_>,
    folder: &Folder,
    wall_time: f64,
) -> Result<Vec<String>, Failure> {
    let mut files = folder.batch();
    files.write(RESIDUALS, |out| write_csv(&residuals(answer), out))?;
    files.write(FIT, |mut out| lptn_report::write(answer, Format::Json, Look::PLAIN, &mut out))?;
    let called = (answer.input.text.stem.as_str(), answer.study.name.as_str());
    if let Some(posterior) = answer.fit.posterior(&answer.task, called, &answer.names) {
        files.write(POSTERIOR, |mut out| posterior.write(&mut out))?;
    }
    let inputs = about::hashes(&answer.input.netlist);
    let text = files::manifest(&inputs, files.written(), wall_time);
    files.write(MANIFEST, |out| out.write_all(format!("{text:#}\n").as_bytes()))?;
    let names = files.written().iter().map(|file| file.name.clone()).collect();
    files.commit(&NAMES)?;
    Ok(names)
}

/// A value of a record: which column of which, and its row.
struct Sample<'a> {
    record: &'a str,
    column: &'a str,
    /// In s.
    time: f64,
    /// In SI units.
    measured: f64,
    computed: f64,
    shown: Shown,
}

/// A row for each value, by record and column: temperatures in the unit of the netlist; where not all
/// columns are temperatures, the unit of each value stands beside it. A residual is positive where
/// more was measured than the network computes.
fn residuals(answer: &Answer<'_>) -> Table {
    let temperature = &answer.input.netlist.temperature_unit;
    let samples = answer.fit.columns.iter().flat_map(|m| {
        let run = &answer.task.runs[m.run];
        let column = &run.columns[m.column];
        let values = run.times.iter().zip(&column.values).zip(&m.modelled);
        let sample = |((&time, &measured), &computed): ((&f64, &f64), &f64)| Sample {
            record: &run.name,
            column: &column.name,
            time,
            measured,
            computed,
            shown: Shown::of(column.ty, temperature),
        };
        // gaps of the record are no values
        values.map(sample).filter(|sample| sample.measured.is_finite()).collect::<Vec<_>>()
    });
    let samples: Vec<Sample<'_>> = samples.collect();
    let mixed = answer.fit.columns.iter().any(|misfit| !answer.column(misfit).ty.absolute);
    let kelvin = Shown::of(Type::ABSOLUTE_TEMPERATURE, temperature);
    let [unit, of_differences] = match mixed {
        true => ["unit"; 2].map(str::to_owned),
        false => [kelvin.unit.text, kelvin.of_differences],
    };
    let mut table = Table::of(&samples);
    table.label("record", |s| s.record.to_owned());
    table.label("column", |s| s.column.to_owned());
    if mixed {
        table.label("unit", |s| s.shown.unit.text.clone());
    }
    table.column("time", "s", |s| s.time);
    table.column("measured", &unit, |s| s.shown.unit.from_si(s.measured));
    table.column("computed", &unit, |s| s.shown.unit.from_si(s.computed));
    let residual = |s: &Sample<'_>| (s.measured - s.computed) / s.shown.unit.scale;
    table.column("residual", &of_differences, residual);
    table.done()
}
