//! The same question, asked of one verb after the other: the hottest a node becomes, the margin of
//! a limit, heats and the verdict are those of the run.

use std::collections::BTreeMap;

use serde_json::Value;

use super::compare::Case;
use super::model::{Entry, Field, Net, Piece, constant, wrapped};
use super::program::folder;
use super::random::Random;
use super::units::Kind;
use super::write::{MAIN, Texts};
use crate::common::{Folder, Ran};

/// The parameter that scales a source, the limit that is added, and how far off it is at least, in
/// bounds: nearer to it, verdicts may differ.
const FACTOR: &str = "verb_k";
const LIMIT: &str = "verb_limit";
const CLEAR: f64 = 3.0;

/// Steps of a run from which on nothing is sized.
const LONG: u64 = 400;

/// The network with a parameter that scales one source, a limit of one node, a sweep over the
/// parameter and a size of it.
pub struct Study {
    pub net: Net,
    /// The node of the limit, and its level in degC.
    node: String,
    level: f64,
    /// How far temperatures may be apart, in K, and heats for each of them, in J/K.
    bound: f64,
    slope: f64,
    /// Whether it is run so soon that it can be run twenty times.
    short: bool,
}

impl Study {
    /// `None` where there is no source to scale.
    pub fn of(case: &Case, random: &mut Random) -> Option<Self> {
        let mut net = case.net.clone();
        let node = net.of("node").find(|node| node.get("massless").is_none())?.name.clone();
        let source = net.entries.iter_mut().find(|entry| entry.section == "source")?;
        let Some(Field::Value(pieces)) = source.get_mut("P") else { return None };
        *pieces = wrapped("{value} * {}", pieces, [Piece::Name(FACTOR.into())]);
        let values = case.results.columns.get(&format!("{node}.T"))?;
        let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let away = random.decades(0.2, 10.0);
        let level = top + if random.chance(0.5) { away } else { -away };
        let raw = |text: &str| Field::Raw(text.to_owned());
        let limit = Entry::new("limit", LIMIT)
            .with("of", Field::Value(vec![Piece::Name(format!("{node}.T"))]))
            .with("below", constant(level, Kind::Temperature));
        let sweep = Entry::new("sweep", "verb_sweep")
            .with("method", Field::Word("grid".into()))
            .with("axes", raw(&format!("{{ {FACTOR} = [0.8, 1.0, 1.25] }}")))
            .with("over", Field::Word("run".into()))
            .with("report", raw(&format!("{{ top = \"max({node}.T)\" }}")));
        let size = Entry::new("size", "verb_size")
            .with("maximise", Field::Word(FACTOR.into()))
            .with("vary", raw(&format!("{{ {FACTOR} = {{ from = 0.5, to = 2 }} }}")))
            .with("require", raw(&format!("[\"{node}.T <= {level} [degC]\"]")))
            .with("over", Field::Word("run".into()));
        let factor = Entry::new("param", FACTOR).with("", Field::Raw("\"1 ± 0.001\"".into()));
        net.entries.extend([factor, limit, sweep, size]);
        let slopes: f64 = net.entries.iter().map(|entry| entry.slope).sum();
        let slope = 2.0 * slopes * net.run_value("stop");
        let short = case.results.steps < LONG;
        Some(Self { net, node, level, bound: case.bound(), slope, short })
    }

    /// The first difference.
    pub fn agrees(&self) -> Result<(), (String, Texts)> {
        let texts = self.net.texts();
        let folder = folder(&texts);
        let run = Run::of(&folder, self, "1").map_err(|words| (words, texts.clone()))?;
        let checks: [(&str, Check); 5] = [
            ("compare and rank", Self::compared),
            ("sweep", Self::swept),
            ("uncertainty", Self::banded),
            ("report", Self::reported),
            ("size", Self::sized),
        ];
        let mut asked = checks.into_iter().filter(|(verb, _)| *verb != "size" || self.short);
        asked.try_for_each(|(verb, check)| {
            check(self, &folder, &run).map_err(|words| (format!("{verb}: {words}"), texts.clone()))
        })
    }

    fn near(&self, what: &str, run: f64, found: f64) -> Result<(), String> {
        near(what, (run, found), self.bound)
    }

    fn compared(&self, folder: &Folder, run: &Run) -> Result<(), String> {
        let ran = folder.run(&["compare", MAIN, "--format", "json"]);
        let row = row(&json(&ran)?)?;
        let number = |name: &str| {
            row.get(name).and_then(Value::as_f64).ok_or_else(|| format!("no {name} in {row:?}"))
        };
        self.near("margin", run.margin, number(&format!("{LIMIT}.margin"))?)?;
        self.ranked(folder, run, &row)?;
        // the limits of the network are warnings
        let status = row.get("status").and_then(Value::as_str).unwrap_or("?");
        if (status == "broken") == run.kept && run.margin.abs() > CLEAR * self.bound {
            return Err(format!("{status}, and in the run {}", run.margin));
        }
        let heat = number("heat")?;
        let bound = 1e-6 * run.turned_over + self.slope * self.bound;
        for (name, taken) in &run.boundaries {
            let Some(share) = row.get(&format!("{name}.share")).and_then(Value::as_f64) else {
                continue; // several paths, each with its own
            };
            let taken = f64::max(-taken, 0.0);
            near(&format!("heat to {name}"), (taken, share * heat), bound)?;
        }
        Ok(())
    }

    fn swept(&self, folder: &Folder, run: &Run) -> Result<(), String> {
        let ran = folder.run(&["sweep", MAIN, "--no-files", "--format", "csv"]);
        if ran.code != Some(0) {
            return Err(format!("exit {:?}: {}", ran.code, ran.err));
        }
        let mut reader = csv::Reader::from_reader(ran.out.as_bytes());
        let row = reader.records().filter_map(Result::ok).find(|row| row.get(1) == Some("1"));
        let found = row.as_ref().and_then(|row| row.get(2)?.parse().ok());
        self.near("top", run.top, found.ok_or_else(|| format!("no row of 1 in {}", ran.out))?)
    }

    /// Both know the hottest node and its peak, which no row exceeds.
    fn ranked(&self, folder: &Folder, run: &Run, row: &Row) -> Result<(), String> {
        let ran = folder.run(&["rank", MAIN, "--over", "run", "--format", "json"]);
        let found = json(&ran)?;
        let peak = value(&found, &["temperature"])?;
        let compared = row.get("peak").and_then(Value::as_f64).unwrap_or(f64::NAN);
        self.near("peak", peak, compared)?;
        if peak < run.highest - self.bound {
            return Err(format!("the peak is {peak}, and a row has {}", run.highest));
        }
        for node in [row.get("hottest").unwrap_or(&Value::Null), &found["node"]] {
            if *node == self.node.as_str() {
                self.near("top", run.top, peak)?;
            }
        }
        Ok(())
    }

    /// Bands change no temperature.
    fn banded(&self, folder: &Folder, run: &Run) -> Result<(), String> {
        let all = ["run", MAIN, "--no-files", "--uncertainty", "linear", "--format", "json"];
        let found = json(&folder.run(&all))?;
        self.near("margin", run.margin, value(&found, &["limits", LIMIT, "margin"])?)
    }

    /// The page shows the line of the limit that the run prints.
    fn reported(&self, folder: &Folder, run: &Run) -> Result<(), String> {
        let ran = folder.run(&["report", "out/net"]);
        if ran.code != Some(0) {
            return Err(format!("exit {:?}: {}", ran.code, ran.err));
        }
        let plotted = folder.run(&["plot", "out/net", "-o", "net.svg"]);
        if plotted.code != Some(0) {
            return Err(format!("plot: exit {:?}: {}", plotted.code, plotted.err));
        }
        let page = folder.read("out/net/report.html");
        let text = words(&page);
        // the page is wider, and has a column more
        let (head, _) = run.line.split_once(" K ").unwrap_or((&run.line, ""));
        let verdict = if run.kept { "kept" } else { "BROKEN" };
        let says = |rest: &str| rest.chars().take(40).collect::<String>().contains(verdict);
        if text.split(head).skip(1).any(says) {
            return Ok(());
        }
        let near: String = text.split(LIMIT).nth(1).unwrap_or("nothing").chars().take(90).collect();
        Err(format!("the run prints {}, the page {LIMIT}{near}", run.line))
    }

    /// A run of the answer keeps the limit, and has no room left where it binds.
    fn sized(&self, folder: &Folder, run: &Run) -> Result<(), String> {
        let ran = folder.run(&["size", MAIN, "--format", "json"]);
        if ran.code == Some(1) {
            // not feasible: the smallest heat breaks the limit too
            let least = Run::of(folder, self, "0.5")?;
            let kept = least.margin > CLEAR * self.bound;
            return if kept { Err(format!("none, and 0.5 has {}", least.margin)) } else { Ok(()) };
        }
        let found = json(&ran)?;
        let answer = value(&found, &["values", FACTOR])?;
        let margin = value(&found, &["margin"])?;
        let again = Run::of(folder, self, &format!("{answer:?}"))?;
        self.near(&format!("margin at {answer}"), again.margin, margin)?;
        if answer < 1.0 && run.margin > CLEAR * self.bound && found["breaks_again"].is_null() {
            return Err(format!("{answer} at most, and 1 has {}", run.margin));
        }
        Ok(())
    }
}

type Check = fn(&Study, &Folder, &Run) -> Result<(), String>;

/// What the others have to agree with.
struct Run {
    /// The largest value of the limit's node, in degC, and the margin, in K.
    top: f64,
    margin: f64,
    kept: bool,
    /// The largest of all nodes and rows.
    highest: f64,
    /// Heat from each boundary, and all that moved, in J.
    boundaries: BTreeMap<String, f64>,
    turned_over: f64,
    /// What the table prints of the limit.
    line: String,
}

impl Run {
    fn of(folder: &Folder, study: &Study, factor: &str) -> Result<Self, String> {
        let set = format!("{FACTOR}={factor}");
        let found = json(&folder.run(&["run", MAIN, "--set", &set, "--format", "json"]))?;
        let margin = value(&found, &["limits", LIMIT, "margin"])?;
        let kept = found["limits"][LIMIT]["kept"] == true;
        let top = value(&found, &["limits", LIMIT, "worst"])?;
        near("level less margin", (top, study.level - margin), 1e-9 * (1.0 + top.abs()))?;
        if kept != (margin >= 0.0) {
            return Err(format!("kept: {kept}, with a margin of {margin}"));
        }
        let printed = folder.run(&["run", MAIN, "--set", &set, "--no-files"]);
        if printed.code != Some(i32::from(!kept)) {
            return Err(format!("exit {:?} where kept is {kept}: {}", printed.code, printed.err));
        }
        let line = printed.out.lines().find(|line| line.starts_with(LIMIT)).unwrap_or("");
        let heats = found["ledger"]["boundaries"].as_object().cloned().unwrap_or_default();
        let heat = |(name, heat): (&String, &Value)| Some((name.clone(), heat["value"].as_f64()?));
        Ok(Self {
            top,
            margin,
            kept,
            highest: highest(&found, &study.net),
            boundaries: heats.iter().filter_map(heat).collect(),
            turned_over: value(&found, &["ledger", "turned_over"])?,
            line: words(line),
        })
    }
}

/// One candidate by its columns.
type Row = BTreeMap<String, Value>;

fn row(found: &Value) -> Result<Row, String> {
    let names = found["columns"].as_array().into_iter().flatten();
    let names = names.map(|column| column["name"].as_str().unwrap_or("?").to_owned());
    let row = found["rows"][0].as_array().ok_or("no row")?;
    Ok(names.zip(row.iter().cloned()).collect())
}

/// The JSON of a study that came to its end, its limits kept or not.
fn json(ran: &Ran) -> Result<Value, String> {
    if !matches!(ran.code, Some(0 | 1)) {
        return Err(format!("exit {:?}: {}", ran.code, ran.err));
    }
    serde_json::from_str(&ran.out).map_err(|error| error.to_string())
}

/// The number behind some keys, with its unit or without.
fn value(found: &Value, keys: &[&str]) -> Result<f64, String> {
    let at = keys.iter().fold(found, |at, key| &at[*key]);
    at["value"].as_f64().or_else(|| at.as_f64()).ok_or_else(|| format!("no {keys:?}"))
}

/// The largest temperature of a node in any row.
fn highest(found: &Value, net: &Net) -> f64 {
    let boundary = |name: &str| net.of("boundary").any(|entry| entry.name == name);
    let names = found["columns"].as_array().into_iter().flatten();
    let names = names.map(|column| column["name"].as_str().unwrap_or("?"));
    let of_nodes: Vec<usize> = names
        .enumerate()
        .filter(|(_, name)| name.strip_suffix(".T").is_some_and(|name| !boundary(name)))
        .map(|(i, _)| i)
        .collect();
    let rows = found["rows"].as_array().into_iter().flatten();
    let all = rows.flat_map(|row| of_nodes.iter().filter_map(|&i| row[i].as_f64()));
    all.fold(f64::NEG_INFINITY, f64::max)
}

fn near(what: &str, (run, found): (f64, f64), bound: f64) -> Result<(), String> {
    if (run - found).abs() <= bound {
        return Ok(());
    }
    let apart = (run - found).abs();
    Err(format!("{what} is {found}, and in the run {run}: {apart:.2e} apart, {bound:.1e} allowed"))
}

/// The words of a text or a page, one blank between them.
fn words(page: &str) -> String {
    let parts = page.split('<').map(|part| part.split_once('>').map_or(part, |(_, text)| text));
    let text = parts.collect::<Vec<_>>().join(" ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
