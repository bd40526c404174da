//! Limits of a comparison: margins, of a large family those of its worst member.

use lptn_network::LimitSeverity;
use lptn_report::{Align, Column, decimals, duration, fixed, significant};
use lptn_study::{CandidateLimit, CompareRow, HeatOver};
use lptn_units::{Type, Unit};

use crate::words::spaced;
use crate::{families, scale};

/// Cell of a value that is not known or does not exist.
pub(super) const NOTHING: &str = "-";

/// A limit of the candidates, or a large family of limits.
pub(super) struct Judged<'a> {
    /// Its name, or that of the family.
    pub(super) name: String,
    members: Vec<&'a str>,
}

/// Result of a row for the limit of a name.
type OfRow<'a> = dyn Fn(&'a CompareRow, &str) -> Option<&'a CandidateLimit>;

/// All limits of some rows; with `fold`, large families are one.
pub(super) fn limits<'a>(rows: &'a [CompareRow], fold: bool) -> Vec<Judged<'a>> {
    let named = |name: &&str| ((*name).to_owned(), 0);
    let folded = families::folded(CompareRow::limit_names(rows), fold, named, |_| 0.0);
    let one = |row: families::Row<&'a str>| Judged {
        members: row.all().copied().collect(),
        name: row.name,
    };
    folded.into_iter().map(one).collect()
}

impl Judged<'_> {
    /// The result of a row with the least margin.
    pub(super) fn worst<'a>(
        &self,
        row: &'a CompareRow,
        limit: &OfRow<'a>,
    ) -> Option<&'a CandidateLimit> {
        let results = self.members.iter().filter_map(|name| limit(row, name));
        results.min_by(|a, b| a.margin.total_cmp(&b.margin))
    }

    /// Its name, or that of the worst of its family.
    pub(super) fn worst_name(&self) -> String {
        let worst = if self.members.len() > 1 { "worst of " } else { "" };
        format!("{worst}{}", self.name)
    }

    /// The index of a member of a family after a blank; nothing for a single limit.
    fn index(&self, name: &str) -> String {
        let index = lptn_report::family(name).filter(|_| self.members.len() > 1);
        index.map_or_else(String::new, |(_, index)| format!(" {index}"))
    }

    /// Names of broken limits of severity error: the worst, and how many others.
    fn broken(&self, row: &CompareRow) -> Option<String> {
        let results = self.members.iter().filter_map(|name| row.limit(name));
        let counts =
            |limit: &&CandidateLimit| limit.broken() && limit.severity == LimitSeverity::Error;
        let broken: Vec<&CandidateLimit> = results.filter(counts).collect();
        let worst = broken.iter().min_by(|a, b| a.margin.total_cmp(&b.margin))?;
        Some(match broken.len() {
            1 => worst.name.clone(),
            n => format!("{} and {} more of {}", worst.name, n - 1, self.name),
        })
    }
}

/// A column for each limit: its margin, and when it breaks.
pub(super) fn margins<'a>(
    (rows, fold): (&'a [CompareRow], bool),
    limit: &OfRow<'a>,
    unit: &Unit,
) -> Vec<Column> {
    let column = |judged: &Judged<'_>| {
        let cell = |row| {
            let worst = judged.worst(row, limit)?;
            Some(margin(worst, unit) + &judged.index(&worst.name))
        };
        let cells = rows.iter().map(|row| cell(row).unwrap_or_else(|| NOTHING.to_owned()));
        Column::new(&judged.name, Align::Right, cells.collect())
    };
    limits(rows, fold).iter().map(column).collect()
}

/// The same over the settled cycle; none if no candidate has both a run and a cycle.
pub(super) fn settled_margins((rows, fold): (&[CompareRow], bool), unit: &Unit) -> Vec<Column> {
    let of_run = |row: &CompareRow| row.candidate().is_some_and(|c| c.heat.over == HeatOver::Run);
    match rows.iter().any(|row| row.settled().is_some() && of_run(row)) {
        true => margins((rows, fold), &CompareRow::settled_limit, unit),
        false => Vec::new(),
    }
}

fn margin(limit: &CandidateLimit, unit: &Unit) -> String {
    if limit.is_open() {
        return NOTHING.into();
    }
    let (margin, unit) = scale::in_unit(limit.margin, Type::of(limit.ty.dimension), unit);
    let number = if limit.is_temperature() {
        fixed(margin, decimals(margin, 3, 1).min(4))
    } else {
        significant(margin, 3)
    };
    let unit = spaced(&unit);
    match limit.broken_at {
        Some(time) => format!("{number}{unit} from {}", duration(time, 3)),
        None => format!("{number}{unit}"),
    }
}

/// "bare breaks steel_hot and skin, fan breaks skin".
pub(super) fn broken((rows, fold): (&[CompareRow], bool), names: &[String]) -> String {
    let judged = limits(rows, fold);
    let of_row = |(row, name): (&CompareRow, &String)| {
        let limits: Vec<String> = judged.iter().filter_map(|judged| judged.broken(row)).collect();
        (!limits.is_empty()).then(|| format!("{name} breaks {}", limits.join(" and ")))
    };
    rows.iter().zip(names).filter_map(of_row).collect::<Vec<_>>().join(", ")
}
