//! The records of a folder and their speeds.

use std::path::{Path, PathBuf};

use lptn_fit::law::Run;
use lptn_netlist::{CsvOptions, Diagnostic, Files, Record, RecordQuery, read_record, read_sheet};
use lptn_report::significant;
use lptn_study::FileHash;
use lptn_units::{Dimension, Type, parse_quantity};

use super::super::shown::SpeedUnit;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::memory_files::MemoryFiles;

/// The sheet that gives the speeds of records.
const RUNS: &str = "runs.csv";

/// The records of a folder.
pub(super) struct Folder {
    pub(super) runs: Vec<Run>,
    /// The unit in which speeds are written.
    pub(super) unit: SpeedUnit,
    /// Every file that was read.
    pub(super) inputs: Vec<FileHash>,
    /// Warnings with their files.
    pub(super) warnings: Vec<(Files, Vec<Diagnostic>)>,
}

/// Speeds in rad/s by the names of files, and their unit.
struct Speeds {
    by_file: Vec<(String, f64)>,
    unit: Option<SpeedUnit>,
}

pub(super) fn read(
    folder: &Path,
    (csv, files): (&CsvOptions, &MemoryFiles),
) -> Result<Folder, Failure> {
    let paths = records(folder, files)?;
    let mut found = Folder {
        runs: Vec::new(),
        unit: SpeedUnit::rpm(),
        inputs: Vec::new(),
        warnings: Vec::new(),
    };
    let sheet = folder.join(RUNS);
    let speeds = if files.has(&sheet) {
        listed((&sheet, files.bytes(&sheet)?, csv), &paths, &mut found)?
    } else {
        Speeds { by_file: Vec::new(), unit: None }
    };
    for path in paths {
        let bytes = files.bytes(&path)?;
        found.inputs.push(hash(&path, &bytes));
        let (record, texts) = read_record(
            &path,
            &bytes,
            &RecordQuery { csv: csv.clone(), ..RecordQuery::default() },
        )?;
        let speed = speed(&path, (&record, &texts), &speeds)?;
        let temperatures =
            record.temperatures().map(|column| (column.name.clone(), column.values.clone()));
        found.runs.push(Run {
            name: file_name(&path),
            speed,
            columns: temperatures.collect(),
            times: record.time.clone(),
        });
        if !record.warnings.is_empty() {
            found.warnings.push((texts, record.warnings));
        }
    }
    if let Some(unit) = speeds.unit {
        found.unit = unit;
    }
    found.runs.sort_by(|a, b| a.speed.total_cmp(&b.speed).then_with(|| a.name.cmp(&b.name)));
    Ok(found)
}

fn hash(path: &Path, bytes: &[u8]) -> FileHash {
    FileHash { name: path.display().to_string(), sha256: lptn_study::sha256(bytes) }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The CSV files of the folder but the sheet of speeds, by name.
fn records(folder: &Path, files: &MemoryFiles) -> Result<Vec<PathBuf>, Failure> {
    let mut paths = files.of_folder(folder, "csv")?;
    paths.retain(|path| file_name(path) != RUNS);
    if paths.is_empty() {
        let message = format!("{} contains no records: no file ends with .csv", folder.display());
        return Err(Failure::new(Exit::Input, Diagnostic::error("fit::law_no_records", message)));
    }
    Ok(paths)
}

/// The speeds of `runs.csv`: a column of file names, and one of speeds.
fn listed(
    (path, bytes, csv): (&Path, Vec<u8>, &CsvOptions),
    records: &[PathBuf],
    found: &mut Folder,
) -> Result<Speeds, Failure> {
    found.inputs.push(hash(path, &bytes));
    let (sheet, files) = read_sheet(path, &bytes, csv)?;
    found.warnings.extend(sheet.note.clone().map(|note| (files.clone(), vec![note])));
    let speed = Type::of(Dimension::ANGULAR_VELOCITY);
    let column = sheet.columns.iter().find(|column| column.unit.ty == speed);
    let names = sheet.words.iter().find(|(name, _)| name == "file").or_else(|| sheet.words.first());
    let (Some(column), Some((_, names))) = (column, names) else {
        let problem =
            Diagnostic::error("fit::law_runs", "the sheet has to give files and their speeds");
        let problem = problem.at(sheet.header.clone(), "").help("begin it with `file,omega [rpm]`");
        return Err(Failure::at(Exit::Input, files, problem));
    };
    let there: Vec<String> = records.iter().map(|record| file_name(record)).collect();
    if let Some(name) = names.iter().find(|name| !there.contains(name)) {
        let message = format!("the sheet gives a speed to `{name}`, which is not in the folder");
        let problem = Diagnostic::error("fit::law_runs", message).at(sheet.header.clone(), "");
        let near = lptn_units::suggest(name, there.iter().map(String::as_str));
        let help = near.map_or_else(
            || "take its row out of the sheet, or put the record into the folder".to_owned(),
            |near| format!("did you mean `{near}`?"),
        );
        return Err(Failure::at(Exit::Input, files, problem.help(help)));
    }
    let by_file = names.iter().cloned().zip(column.values.iter().copied()).collect();
    Ok(Speeds { by_file, unit: Some(SpeedUnit(column.unit.clone())) })
}

/// The speed of a record: from the sheet, a line `# omega = 1000 rpm`, or the name of the file.
/// They may not differ.
fn speed(path: &Path, (record, files): (&Record, &Files), speeds: &Speeds) -> Result<f64, Failure> {
    let name = file_name(path);
    let listed = speeds.by_file.iter().find(|(file, _)| *file == name).map(|(_, speed)| *speed);
    let said = record.comments.iter().find_map(|comment| of_comment(comment));
    let unread = record.comments.iter().find(|comment| is_speed(comment));
    let found: Vec<f64> =
        [listed, said, of_name(&name)].into_iter().flatten().filter(|s| !s.is_nan()).collect();
    let refused = |code, message: String, help: &str| {
        Err(Failure::at(Exit::Input, files.clone(), Diagnostic::error(code, message).help(help)))
    };
    if let (None, Some(comment)) = (said, unread) {
        let message = format!("{}: `# {}` gives no speed", path.display(), comment.trim());
        let help = "write a rotation with its unit, for example `# omega = 1000 rpm`";
        return refused("fit::law_comment", message, help);
    }
    match found.as_slice() {
        [] => refused(
            "fit::law_no_speed",
            format!("{}: its speed is not given", path.display()),
            "write a line `# omega = 1000 rpm` above its header, put the speed into its name \
             (`1000rpm.csv`), or add a sheet runs.csv with `file,omega [rpm]`",
        ),
        [first, others @ ..]
            if others.iter().any(|other| (other - first).abs() > 1e-9 * first.abs()) =>
        {
            refused(
                "fit::law_two_speeds",
                format!(
                    "{}: its name, its comments or runs.csv give different speeds: {}",
                    path.display(),
                    in_rpm(&found)
                ),
                "correct the wrong one",
            )
        }
        [first, ..] => Ok(*first),
    }
}

/// Speeds in rad/s as a text in rpm.
fn in_rpm(speeds: &[f64]) -> String {
    let unit = SpeedUnit::rpm().0;
    let all = speeds.iter().map(|s| format!("{} rpm", significant(unit.from_si(*s), 6)));
    all.collect::<Vec<String>>().join(", ")
}

/// True if a comment gives the speed: `omega = 50 Hz`.
fn is_speed(comment: &str) -> bool {
    let name = comment.split_once(['=', ':']).map(|(name, _)| name.trim());
    name.is_some_and(|name| ["omega", "speed"].contains(&name))
}

/// `omega = 1000 rpm`.
fn of_comment(comment: &str) -> Option<f64> {
    let (_, value) = comment.split_once(['=', ':'])?;
    let speed = parse_quantity(value.trim(), Some(Type::of(Dimension::ANGULAR_VELOCITY))).ok()?;
    Some(speed.value)
}

/// `run_1000rpm_a.csv`, `1000 rpm.csv`.
fn of_name(name: &str) -> Option<f64> {
    let lower = name.to_ascii_lowercase();
    let before = lower.get(..lower.find("rpm")?)?.trim_end_matches(['_', ' ', '-']);
    let digits =
        before.len() - before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    let number: f64 = before.get(before.len() - digits..)?.parse().ok()?;
    Some(SpeedUnit::rpm().0.to_si(number))
}

#[cfg(test)]
mod tests {
    use super::{is_speed, of_comment, of_name};

    #[test]
    fn speeds_stand_in_names_and_comments() {
        let rpm = |n: f64| n * std::f64::consts::TAU / 60.0;
        let near = |found: Option<f64>, n: f64| assert!((found.unwrap() - rpm(n)).abs() < 1e-9);
        near(of_name("1000rpm_a.csv"), 1000.0);
        near(of_name("run2_3500.5 RPM.csv"), 3500.5);
        near(of_comment("omega = 1000 rpm"), 1000.0);
        near(of_comment("speed: 2 rev/s"), 120.0);
        assert!(of_name("first.csv").is_none() && of_name("rpm.csv").is_none());
        assert!(is_speed("omega = 50 Hz") && is_speed("speed: 2000") && !is_speed("C = 5 J/K"));
        assert!(of_comment("C = 5 J/K").is_none() && of_comment("a remark").is_none());
    }
}
