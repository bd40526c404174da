//! The candidates that no other betters in two reports. Those that break limits do not count.

use super::row::Row;

/// The front of the rows up to now, first report rising and second falling; of equal rows the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Front {
    /// The places of the two reports among the numbers of a row; `None` without a question.
    places: Option<[usize; 2]>,
    rows: Vec<Row>,
}

impl Front {
    pub(super) fn new(places: Option<[usize; 2]>) -> Self {
        Self { places, rows: Vec::new() }
    }

    /// The same for other rows.
    pub(super) fn part(&self) -> Self {
        Self::new(self.places)
    }

    pub(super) fn places(&self) -> Option<[usize; 2]> {
        self.places
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// About `most` of its rows, evenly chosen, the first and the last among them.
    pub(super) fn some(&self, most: usize) -> Vec<&Row> {
        let stride = self.rows.len().div_ceil(most).max(1);
        let mut some: Vec<&Row> = self.rows.iter().step_by(stride).collect();
        some.extend(self.rows.last().filter(|_| stride > 1 && self.rows.len() % stride != 1));
        some
    }

    /// Takes in a row that did not fail.
    pub(super) fn add(&mut self, row: &Row) {
        let Some([first, second]) = self.places else { return };
        let of = |row: &Row| (row.numbers[first], row.numbers[second]);
        let (a, b) = of(row);
        if !(a.is_finite() && b.is_finite()) {
            return;
        }
        let after = self.rows.partition_point(|known| of(known).0 <= a);
        if after > 0 && of(&self.rows[after - 1]).1 <= b {
            return;
        }
        let begin = self.rows.partition_point(|known| of(known).0 < a);
        let worse = self.rows[begin..].iter().take_while(|known| of(known).1 >= b).count();
        self.rows.splice(begin..begin + worse, [row.clone()]);
    }

    /// Takes in those of the rows that follow.
    pub(super) fn append(&mut self, later: &Self) {
        later.rows.iter().for_each(|row| self.add(row));
    }
}

#[cfg(test)]
mod tests {
    use super::{Front, Row};

    /// In any order and any number of parts, the front equals that of a comparison of every pair.
    #[test]
    fn a_front_is_what_no_other_betters() {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 60) as f64
        };
        for _ in 0..200 {
            let rows: Vec<Row> = (0..40)
                .map(|case| Row { case, numbers: vec![next(), next()], ..Row::default() })
                .collect();
            let betters = |other: &Row, row: &Row| {
                let pairs = || other.numbers.iter().zip(&row.numbers);
                let equal = pairs().all(|(a, b)| a <= b) && pairs().all(|(a, b)| a >= b);
                pairs().all(|(a, b)| a <= b) && (!equal || other.case < row.case)
            };
            let mut expected: Vec<u64> = rows
                .iter()
                .filter(|row| !rows.iter().any(|o| o.case != row.case && betters(o, row)))
                .map(|row| row.case)
                .collect();
            let mut whole = Front::new(Some([0, 1]));
            rows.iter().for_each(|row| whole.add(row));
            let mut parts = Front::new(Some([0, 1]));
            for chunk in rows.chunks(7) {
                let mut part = parts.part();
                chunk.iter().for_each(|row| part.add(row));
                parts.append(&part);
            }
            for front in [whole, parts] {
                let mut found: Vec<u64> = front.rows().iter().map(|row| row.case).collect();
                assert!(front.rows().is_sorted_by(|a, b| a.numbers[0] < b.numbers[0]));
                found.sort_unstable();
                expected.sort_unstable();
                assert_eq!(found, expected);
            }
        }
    }
}
