//! A comparison as a table for files.

use lptn_solve::{Table, TableOf};
use lptn_units::{Type, Unit};

use crate::compare::candidate::Candidate;
use crate::compare::doubt::Scatter;
use crate::compare::heat::{HeatOut, HeatOver, PathShare};
use crate::compare::limits::CandidateLimit;
use crate::compare::reports::CandidateReport;
use crate::compare::settled::Settled;
use crate::standing::standing;

/// A candidate with its names.
#[derive(Debug)]
pub struct CompareRow {
    /// The file it was read from.
    pub file: String,
    /// Its title; may be empty.
    pub title: String,
    /// Its results, or the code of the problem for which there are none.
    pub outcome: Result<Candidate, String>,
}

impl CompareRow {
    /// Its results; `None` if it has a problem instead.
    pub fn candidate(&self) -> Option<&Candidate> {
        self.outcome.as_ref().ok()
    }

    /// `none` without limits, `kept`, `warning` if only limits of that severity are broken,
    /// `broken`, `not judged` if inputs change with time and there is no run, or the code of the
    /// problem.
    pub fn status(&self) -> &str {
        let candidate = match &self.outcome {
            Ok(candidate) => candidate,
            Err(code) => return code,
        };
        standing(candidate.limits.iter().map(|limit| (limit.margin, limit.severity)))
    }

    /// Its result for the limit of this name, if it has one.
    pub fn limit(&self, name: &str) -> Option<&CandidateLimit> {
        self.candidate()?.limits.iter().find(|limit| limit.name == name)
    }

    /// Its number for the report of this name, if it has one.
    pub fn report(&self, name: &str) -> Option<&CandidateReport> {
        self.candidate()?.reports.iter().find(|report| report.name == name)
    }

    /// The share that the boundary or path of this name takes of the heat, if it has one.
    pub fn share(&self, name: &str) -> Option<f64> {
        let heat = &self.candidate()?.heat;
        let boundary = heat.boundaries.iter().find(|(boundary, _)| boundary == name);
        let path = || heat.paths.iter().find(|path| path.name == name);
        boundary.map_or_else(|| path()?.share, |(_, share)| *share)
    }

    /// The effect of the `±` of parameters on it, if requested.
    pub fn scatter(&self) -> Option<&Scatter> {
        self.candidate()?.scatter.as_ref()
    }

    /// One standard deviation of the margin of the limit of this name in SI units, and the
    /// probability that it is broken.
    pub fn scatter_of(&self, name: &str) -> Option<(f64, f64)> {
        let place = self.candidate()?.limits.iter().position(|limit| limit.name == name)?;
        self.scatter()?.limits.get(place).copied()
    }

    /// Its periodic steady state, if it has one.
    pub fn settled(&self) -> Option<&Settled> {
        self.candidate()?.settled.as_ref()?.as_ref().ok()
    }

    /// Its result for the limit of this name in the periodic steady state.
    pub fn settled_limit(&self, name: &str) -> Option<&CandidateLimit> {
        self.settled()?.limits.iter().find(|limit| limit.name == name)
    }
}

/// Every name that `names` gives for any row, in the order in which they first appear.
pub(crate) fn union<'a>(
    rows: &'a [CompareRow],
    names: impl Fn(&'a Candidate) -> Vec<&'a str>,
) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    for name in rows.iter().filter_map(CompareRow::candidate).flat_map(names) {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

impl CompareRow {
    /// The names of all limits of some rows.
    pub fn limit_names(rows: &[Self]) -> Vec<&str> {
        union(rows, |candidate| candidate.limits.iter().map(|limit| limit.name.as_str()).collect())
    }

    /// The names of all reports over time of some rows.
    pub fn report_names(rows: &[Self]) -> Vec<&str> {
        union(rows, |candidate| candidate.reports.iter().map(|r| r.name.as_str()).collect())
    }

    /// The names of all boundaries of some rows.
    pub fn boundary_names(rows: &[Self]) -> Vec<&str> {
        union(rows, |candidate| {
            candidate.heat.boundaries.iter().map(|(name, _)| name.as_str()).collect()
        })
    }

    /// The names of paths to boundaries that have several paths in any row. The share of a single
    /// path is that of its boundary.
    pub fn path_names(rows: &[Self]) -> Vec<&str> {
        let paths = rows.iter().filter_map(Self::candidate).map(|c| c.heat.paths.as_slice());
        let shared: Vec<&str> = paths
            .flat_map(|paths| {
                let again = |(i, path): (usize, &'_ PathShare)| {
                    paths[..i].iter().any(|other| other.to == path.to)
                };
                paths.iter().enumerate().filter(move |one| again(*one)).map(|(_, p)| p.to.as_str())
            })
            .collect();
        let counts = |path: &&PathShare| shared.contains(&path.to.as_str());
        union(rows, |c| c.heat.paths.iter().filter(counts).map(|p| p.name.as_str()).collect())
    }
}

/// One line for each row: its names and status, then its numbers, temperatures in `unit`; NaN for
/// numbers that a candidate does not have.
pub fn compare_table(rows: &[CompareRow], unit: &Unit) -> Table {
    let hottest =
        |row: &CompareRow| row.candidate().and_then(|c| c.hottest.clone()).unwrap_or_default();
    let worst = |row: &CompareRow| {
        row.candidate().and_then(Candidate::worst).map_or(String::new(), |limit| limit.name.clone())
    };
    let cycles = rows.iter().any(|row| row.settled().is_some());
    let mut table = Table::of(rows);
    table.label("file", |row| row.file.clone());
    table.label("title", |row| row.title.clone());
    table.label("status", |row| row.status().to_owned());
    table.label("hottest", hottest);
    table.label("worst_limit", worst);
    if cycles {
        let node = |row: &CompareRow| row.settled().and_then(|s| s.hottest.clone());
        table.label("settled_hottest", move |row| node(row).unwrap_or_default());
    }
    general(rows, unit, &mut table);
    for name in CompareRow::limit_names(rows) {
        of_limit(rows, name, &mut table);
    }
    for name in CompareRow::report_names(rows) {
        of_report(rows, (name, unit), &mut table);
    }
    scatter(rows, &mut table);
    of_heat(rows, &mut table);
    let named = CompareRow::boundary_names(rows);
    let paths = CompareRow::path_names(rows).into_iter().filter(|path| !named.contains(path));
    for name in named.iter().copied().chain(paths.collect::<Vec<_>>()) {
        table.column(format!("{name}.share"), "-", |row| row.share(name).unwrap_or(f64::NAN));
    }
    table.done()
}

/// The numbers that every candidate has.
fn general(rows: &[CompareRow], unit: &Unit, table: &mut TableOf<'_, CompareRow>) {
    let mut of = |name: &str, unit: &str, value: &dyn Fn(&Candidate) -> Option<f64>| {
        table.column(name, unit, |row| row.candidate().and_then(value).unwrap_or(f64::NAN));
    };
    of("worst_margin", "K", &|c| c.worst().map(|limit| limit.margin));
    of("peak", &unit.text, &|c| c.peak.map(|peak| unit.from_si(peak.temperature)));
    of("peak_at", "s", &|c| c.peak?.at);
    of("steady", &unit.text, &|c| c.steady.map(|kelvin| unit.from_si(kelvin)));
    if rows.iter().any(|row| row.settled().is_some()) {
        let settled = |c: &Candidate| c.settled.as_ref()?.as_ref().ok().cloned();
        of("settled", &unit.text, &|c| Some(unit.from_si(settled(c)?.peak?.temperature)));
        of("settled_at", "s", &|c| settled(c)?.peak?.at);
        of("period", "s", &|c| settled(c).map(|settled| settled.period));
    }
    of("time_to_95", "s", &|c| c.time_to_95);
    of("duty", "W", &|c| Some(c.heat.duty));
    of("length", "s", &|c| c.heat.length);
    of("capacity", "J/K", &|c| Some(c.capacity));
    if rows.iter().filter_map(CompareRow::candidate).any(|candidate| candidate.mass.is_some()) {
        of("mass", "kg", &|c| c.mass);
    }
}

/// Deviations of peaks and margins, and the difference of each peak from that of the first row.
fn scatter(rows: &[CompareRow], table: &mut TableOf<'_, CompareRow>) {
    let Some(first) = rows.iter().find_map(CompareRow::scatter) else { return };
    fn of(row: &CompareRow, value: impl Fn(&Scatter) -> f64) -> f64 {
        row.scatter().map_or(f64::NAN, value)
    }
    table.column("peak_sd", "K", |row| of(row, |scatter| scatter.peak));
    table.column("above_first", "K", |row| of(row, |scatter| scatter.above(first).by));
    table.column("above_first_sd", "K", |row| of(row, |s| s.above(first).deviation));
    table.column("P_above_first", "-", |row| of(row, |s| s.above(first).probability));
    for name in CompareRow::limit_names(rows) {
        let judged = |row: &CompareRow| row.scatter_of(name);
        let unit = rows.iter().find_map(|row| row.limit(name)).map(|l| l.ty.dimension.si_unit());
        let unit = unit.unwrap_or_default();
        table.column(format!("{name}.margin_sd"), &unit, |row| {
            judged(row).map_or(f64::NAN, |j| j.0)
        });
        table.column(format!("{name}.P_broken"), "-", |row| judged(row).map_or(f64::NAN, |j| j.1));
    }
}

/// Heat as a whole.
fn of_heat(rows: &[CompareRow], table: &mut TableOf<'_, CompareRow>) {
    fn heat(row: &CompareRow) -> Option<&HeatOut> {
        row.candidate().map(|c| &c.heat).filter(|heat| heat.over != HeatOver::Steady)
    }
    if rows.iter().any(|row| heat(row).is_some()) {
        table.column("heat", "J", |row| heat(row).map_or(f64::NAN, |heat| heat.all));
        let stored = |row: &CompareRow| heat(row).and_then(|heat| heat.stored);
        table.column("stored", "-", |row| stored(row).unwrap_or(f64::NAN));
    }
}

/// The numbers of the reports of a name. Candidates may mean different quantities by one name:
/// each type has its own column, distinguished by the unit.
fn of_report(
    rows: &[CompareRow],
    (name, unit): (&str, &Unit),
    table: &mut TableOf<'_, CompareRow>,
) {
    let mut types: Vec<Type> = Vec::new();
    for found in rows.iter().filter_map(|row| row.report(name)).map(|report| report.ty) {
        if !types.contains(&found) {
            types.push(found);
        }
    }
    for of in types {
        let text = if of.absolute { unit.text.clone() } else { of.dimension.si_unit() };
        let shown = |si: f64| if of.absolute { unit.from_si(si) } else { si };
        let own = |row: &CompareRow| {
            let report = row.report(name).filter(|report| report.ty == of);
            report.map_or(f64::NAN, |report| shown(report.value))
        };
        table.column(format!("{name}.report"), text, own);
    }
}

/// The margins of the limits of a name and when they break. Candidates may mean different
/// quantities by one name: each quantity has its own column, distinguished by the unit.
fn of_limit(rows: &[CompareRow], name: &str, table: &mut TableOf<'_, CompareRow>) {
    let unit = |limit: &CandidateLimit| limit.ty.dimension.si_unit();
    let mut units: Vec<String> = Vec::new();
    for found in rows.iter().filter_map(|row| row.limit(name)).map(unit) {
        if !units.contains(&found) {
            units.push(found);
        }
    }
    for of in &units {
        let own = |row: &CompareRow| {
            row.limit(name).filter(|l| unit(l) == *of).map_or(f64::NAN, |l| l.margin)
        };
        table.column(format!("{name}.margin"), of, own);
    }
    for of in units.iter().filter(|_| rows.iter().any(|row| row.settled_limit(name).is_some())) {
        let margin = |row: &CompareRow| {
            let own = row.settled_limit(name).filter(|l| unit(l) == *of);
            own.map_or(f64::NAN, |l| l.margin)
        };
        table.column(format!("{name}.settled_margin"), of, margin);
    }
    let broken =
        |row: &CompareRow| row.limit(name).and_then(|limit| limit.broken_at).unwrap_or(f64::NAN);
    table.column(format!("{name}.broken_at"), "s", broken);
}
