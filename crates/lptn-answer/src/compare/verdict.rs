//! The verdict of a comparison in words: the largest margin, by how much, and the difference.

use lptn_report::{decimals, fixed, significant};
use lptn_study::{Candidate, CandidateLimit, CompareRow, SortKey, order};

use super::{CompareAnswer, page};
use crate::words::{count, difference};

/// Margins that differ by less, in K, are the same: a run is not more accurate.
const SAME: f64 = 1e-3;

/// Shares of heat that differ by less are not a difference.
const LEAST_SHARE: f64 = 0.01;

/// Most values of netlists that the verdict names.
const MOST: usize = 3;

impl CompareAnswer {
    /// The best candidate, its margin, that of the next, and the difference between the two;
    /// `None` if fewer than two have results.
    pub fn verdict(&self) -> Option<String> {
        let candidates: Vec<_> = self.rows.iter().map(CompareRow::candidate).collect();
        let places = order(&candidates, SortKey::Margin);
        let known: Vec<usize> =
            places.into_iter().filter(|&row| candidates[row].is_some()).collect();
        let &[first, second, ..] = known.as_slice() else { return None };
        let names = page::names(&self.rows);
        let (best, next) = (candidates[first]?, candidates[second]?);
        let (name, other) = (&names[first], &names[second]);
        let lead = match (best.worst(), next.worst()) {
            (Some(a), Some(b)) => self.of_margins((name, a), (other, b), (first, second)),
            (Some(a), None) => {
                format!("{name} has {}, {other} has no limit of a temperature", self.said(a))
            }
            _ => self.of_peaks((name, best), (other, next))?,
        };
        let why: Vec<String> = [self.netlists(first, second), heat((name, best), (other, next))]
            .into_iter()
            .flatten()
            .collect();
        let why = if why.is_empty() { String::new() } else { format!("; {}", why.join("; ")) };
        Some(format!("{lead}{why}"))
    }

    fn of_margins(
        &self,
        (name, a): (&str, &CandidateLimit),
        (other, b): (&str, &CandidateLimit),
        (first, second): (usize, usize),
    ) -> String {
        let tighter = self.tighter(first, a).map_or(String::new(), |own| format!(" and {own}"));
        let head = match a.broken() {
            true => {
                format!("no candidate keeps its limits; {name} comes nearest, {}", self.said(a))
            }
            false => format!("{name} has the largest margin, {}{tighter}", self.said(a)),
        };
        let by = a.margin - b.margin;
        let broken = |row: usize| self.rows[row].status() == "broken";
        if broken(second) && !broken(first) {
            return format!("{head}; {other} is next and breaks `{}`", self.breaks(second));
        }
        if by.abs() < SAME {
            return format!("{head}, as much as {other}");
        }
        let way = if by > 0.0 { "more" } else { "less" };
        format!("{head}, {} {way} than {other}", self.by(by.abs()))
    }

    /// A warning with less margin than the limit that decides.
    fn tighter(&self, row: usize, than: &CandidateLimit) -> Option<String> {
        let limits = &self.rows[row].candidate()?.limits;
        let closer =
            limits.iter().filter(|limit| limit.is_temperature() && limit.margin < than.margin);
        closer.min_by(|a, b| a.margin.total_cmp(&b.margin)).map(|limit| self.said(limit))
    }

    /// A difference of temperatures in K: "28.1 K".
    fn by(&self, kelvin: f64) -> String {
        let by = kelvin / self.unit.scale;
        format!("{} {}", fixed(by, decimals(by, 3, 1).min(4)), difference(&self.unit))
    }

    /// "28.1 K to `lubricant`".
    fn said(&self, limit: &CandidateLimit) -> String {
        format!("{} to `{}`", self.by(limit.margin), limit.name)
    }

    /// The first limit that a row breaks.
    fn breaks(&self, row: usize) -> &str {
        let limits = self.rows[row].candidate().map_or(&[][..], |candidate| &candidate.limits);
        limits.iter().find(|limit| limit.broken()).map_or("", |limit| &limit.name)
    }

    fn of_peaks(
        &self,
        (name, a): (&str, &Candidate),
        (other, b): (&str, &Candidate),
    ) -> Option<String> {
        let (a, b) = (a.peak?.temperature, b.peak?.temperature);
        let peak = format!("{} {}", significant(self.unit.from_si(a), 4), self.unit.text);
        let by = match b - a {
            by if by.abs() < SAME => format!("as {other}"),
            by => format!("{} below {other}", self.by(by)),
        };
        Some(format!("{name} stays coolest, peak {peak}, {by}"))
    }

    /// "differ in skin.h and area".
    fn netlists(&self, first: usize, second: usize) -> Option<String> {
        let lines = self.differences(&[first, second]);
        let names: Vec<&str> = lines.iter().map(|line| line.0.as_str()).take(MOST).collect();
        let more = lines.len() - names.len();
        let rest =
            if more > 0 { format!(" and {}", count(more, "more value")) } else { String::new() };
        (!names.is_empty()).then(|| format!("they differ in {}{rest}", names.join(", ")))
    }
}

/// The receiver of heat whose share is most larger in the first candidate.
fn heat((name, a): (&str, &Candidate), (other, b): (&str, &Candidate)) -> Option<String> {
    let stored = |c: &Candidate| Some(("storage".to_owned(), c.heat.stored?));
    let shares = |c: &Candidate| -> Vec<(String, f64)> {
        let known =
            c.heat.boundaries.iter().filter_map(|(name, share)| Some((name.clone(), (*share)?)));
        stored(c).into_iter().chain(known).collect()
    };
    let others = shares(b);
    let more = |(to, share): (String, f64)| {
        let than = others.iter().find(|known| known.0 == to)?.1;
        Some((to, share, than))
    };
    let largest =
        shares(a).into_iter().filter_map(more).max_by(|x, y| (x.1 - x.2).total_cmp(&(y.1 - y.2)));
    let (to, share, than) = largest.filter(|found| found.1 - found.2 > LEAST_SHARE)?;
    let percent = |share: f64| fixed(100.0 * share, 1);
    Some(format!(
        "{to} takes {} % of the heat in {name}, {} % in {other}",
        percent(share),
        percent(than)
    ))
}
