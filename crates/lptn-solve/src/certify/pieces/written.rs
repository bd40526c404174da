//! The bounds of a piece, written to the rows and results.

use lptn_network::ControlId;

use super::Pieces;
use crate::certify::bound::Line;
use crate::certify::way::{self, SAMPLES};

impl Pieces<'_> {
    /// Writes the bounds of rows and results up to the end of a piece, and of the run up to now: the
    /// larger ones of some lines, while a control may have either state if one is given.
    pub(super) fn write(
        &mut self,
        (from, to): (f64, f64),
        lines: &[Line],
        open: Option<ControlId>,
    ) {
        let most = most(lines);
        self.write_most((from, to), &most);
        if let Some(results) = &mut self.results {
            results.take(&mut self.scope, (from, to), (&self.way, &most), open);
        }
        let way = &self.way;
        for row in self.rows.up_to(to) {
            let time = self.rows.time(row).max(from);
            let part = self.course.step_at(time);
            let here: Vec<_> = lines.iter().map(|line| line.at(time - from)).collect();
            let line = |i: usize| here.iter().map(|line| line(i)).fold(0.0, f64::max);
            let place = (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0);
            let apart = |i: usize| part.at(i, time) - way.at(i, place);
            self.rows.push(apart);
            self.rows.add(row, line);
            if let Some(results) = &mut self.results {
                let state: Vec<f64> = (0..way.len()).map(|i| part.at(i, time)).collect();
                let bounds: Vec<f64> = (0..way.len()).map(|i| line(i) + apart(i).abs()).collect();
                results.row(&mut self.scope, (time, open), (&state, &bounds));
            }
        }
    }

    /// Writes the bounds of the run up to now.
    fn write_most(&mut self, (from, to): (f64, f64), most: &dyn Fn(usize) -> f64) {
        let way = &self.way;
        let place = |time: f64| (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0);
        let mut far = vec![0.0_f64; self.rows.asked()];
        let largest = &self.largest;
        for part in self.course.steps().iter().filter(|part| part.from < to && part.to > from) {
            let (first, last) = (part.from.max(from), part.to.min(to));
            let times = way::places::<SAMPLES>().map(|s| first + 0.5 * (1.0 + s) * (last - first));
            self.rows.for_each_unknown(|node, i| {
                let apart = times.map(|time| part.at(i, time) - way.at(i, place(time)));
                let most = apart.iter().fold(0.0_f64, |most, apart| most.max(apart.abs()));
                // most steps add nothing to the largest one
                if 2.21 * most > far[node] {
                    far[node] = far[node].max(largest.of(&apart));
                }
            });
        }
        self.rows.note(most, &far);
    }
}

/// The larger of the bounds of some lines.
pub(super) fn most(lines: &[Line]) -> impl Fn(usize) -> f64 + '_ {
    let all: Vec<_> = lines.iter().map(Line::most).collect();
    move |unknown| all.iter().map(|most| most(unknown)).fold(0.0, f64::max)
}
