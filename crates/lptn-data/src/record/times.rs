//! The times of a record: each above the one before it, none missing for long.

use lptn_units::Unit;

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::record::Record;
use crate::record::cells::Counted;
use lptn_units::format_short as short;

/// A hole is longer than this multiple of the usual time between two rows.
const HOLE: f64 = 5.0;

/// Help for a clock that goes back.
const SET_BACK: &str = "was the clock set back, as at the end of daylight-saving time? log in UTC, \
    or write the offset behind each time, `02:00:00+02:00`; else sort the rows, or split the file";

/// The order of the rows up to now.
pub(crate) struct Order<'t> {
    text: &'t str,
    /// The unit of the times in the file.
    unit: Unit,
    /// True if the times are dates or clock times.
    clock: bool,
    first: Option<f64>,
    last: Option<(f64, Span)>,
    reversed: Counted,
    repeated: Counted,
    same: Option<(Span, usize)>,
}

impl<'t> Order<'t> {
    pub(crate) fn new(text: &'t str, unit: &Unit, clock: bool) -> Self {
        let (reversed, repeated, first, last, same) = Default::default();
        Self { text, unit: unit.clone(), clock, first, last, reversed, repeated, same }
    }

    /// False for the time of the row before it; counts rows that repeat it or go back in time.
    pub(crate) fn accepts(&mut self, time: f64, place: Span) -> bool {
        let written = |span: &Span| self.text.get(span.range.clone()).unwrap_or_default().trim();
        let accepted = match &self.last {
            Some((last, before)) if time.total_cmp(last).is_eq() => {
                if written(before) == written(&place) {
                    self.same.get_or_insert((place.clone(), 0)).1 += 1;
                } else {
                    let problem = repeated(&self.shown(time), &place, before);
                    self.repeated.add(|| problem);
                }
                false
            }
            Some((last, before)) if time < *last => {
                let problem = reversed([*last, time].map(|time| self.shown(time)), &place, before);
                let problem = if self.clock { problem.help(SET_BACK) } else { problem };
                self.reversed.add(|| problem);
                true
            }
            _ => true,
        };
        if accepted {
            self.first.get_or_insert(time);
            self.last = Some((time, place));
        }
        accepted
    }

    /// The first and the last time as in the file; `None` without rows.
    pub(crate) fn range(&self) -> Option<(String, String)> {
        Some((self.shown(self.first?), self.shown(self.last.as_ref()?.0)))
    }

    fn shown(&self, time: f64) -> String {
        format!("{} {}", short(self.unit.from_si(time)), self.unit.text)
    }

    /// The errors, and the warning.
    pub(crate) fn told(self) -> (Vec<Diagnostic>, Option<Diagnostic>) {
        let errors = [self.reversed.told("row"), self.repeated.told("row")];
        let warning = self.same.map(|(place, count)| {
            let message = match count {
                1 => "a row appears twice: the second one is left out".to_owned(),
                _ => format!("{count} rows repeat the row before them: they are left out"),
            };
            Diagnostic::warning("record::same_row", message).at(place, "as the row above")
        });
        (errors.into_iter().flatten().collect(), warning)
    }
}

fn reversed([last, time]: [String; 2], place: &Span, before: &Span) -> Diagnostic {
    Diagnostic::error("record::time_reversed", format!("the time goes back from {last} to {time}"))
        .at(place.clone(), "earlier than the row above it")
        .also(before.clone(), "the row above it")
        .help("sort the rows by their time; if one file contains two records, split it into two")
}

fn repeated(time: &str, place: &Span, before: &Span) -> Diagnostic {
    Diagnostic::error(
        "record::time_repeated",
        format!("the time {time} appears twice, with different values"),
    )
    .at(place.clone(), "again")
    .also(before.clone(), "first here")
    .help("keep one of the two rows; times that are rounded need another digit")
}

/// True if rows are further and further apart, as over decades of time: the last third of the steps
/// is much longer than the first, and hardly any step is shorter than the one before it.
fn grows(steps: &[f64]) -> bool {
    let third = (steps.len() / 3).max(1);
    let middle = |part: &[f64]| {
        let mut sorted = part.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    };
    let shorter = steps.windows(2).filter(|pair| pair[1] < 0.99 * pair[0]).count();
    let (first, last) = (middle(&steps[..third]), middle(&steps[steps.len() - third..]));
    10 * shorter <= steps.len() && last > HOLE * first
}

/// The warning about the longest time without a row, if it is long.
pub(crate) fn holes(record: &Record, text: &str) -> Option<Diagnostic> {
    let steps: Vec<f64> = record.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let median = *sorted.get(sorted.len() / 2)?;
    let is_hole = |step: f64| step > HOLE * median;
    let (longest, &step) = steps.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    if steps.len() < 3 || !is_hole(step) || grows(&steps) {
        return None;
    }
    let [from, to] = [longest, longest + 1].map(|row| record.time[row]);
    let message = format!(
        "no rows between {from} s and {to} s, but {} s apart is usual: the gap is not filled",
        short(median)
    );
    let warning = Diagnostic::warning("record::hole", message)
        .at(record.line_in(text, longest + 1), "the next row")
        .also(record.line_in(text, longest), "the last row before");
    Some(match steps.iter().filter(|&&step| is_hole(step)).count() {
        1 => warning,
        holes => warning.note(format!("{holes} such holes in all; this is the longest")),
    })
}
