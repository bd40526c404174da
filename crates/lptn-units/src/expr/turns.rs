//! Turns of a result: it stops rising and falls from there on, or the reverse.

use super::program::Program;
use crate::taylor::Taylor;

/// A part of a path, as shares of it from 0 to 1.
type Part = [f64; 2];

/// Greatest number of times that bounds are computed.
const LOOKS: usize = 20_000;

/// Values that differ by less than this part of their size are one value.
const SAME: f64 = 1e-8;

/// A value close to a turn counts as that of the turn up to this share of the fall or rise there.
const NEAR: f64 = 0.1;

/// Halvings in the search for that distance.
const HALVINGS: usize = 40;

impl Program {
    /// The turns of the result while each slot that it reads goes straight from the first number of
    /// `ways` to the second. Each is a part of the path, between 0 and 1 and ascending, in which
    /// the value is about that of the turn, which lies inside. Between two of them the result never
    /// falls, or never rises. That follows from bounds, not from samples, so that nothing wider
    /// than `least`, a share of the path, can be hidden.
    ///
    /// If bounds are not known, as beyond the end of a table, no turn is reported.
    pub fn turns(&self, ways: &dyn Fn(u32) -> [f64; 2], least: f64) -> Vec<[f64; 2]> {
        let mut walk = Walk {
            program: self,
            ways,
            least,
            looks: LOOKS,
            last: None,
            turns: Vec::new(),
            flats: Vec::new(),
        };
        let ends = self.corners(ways);
        ends.windows(2).for_each(|part| walk.look([part[0], part[1]]));
        walk.turns.iter().enumerate().map(|(k, turn)| walk.widened(*turn, walk.around(k))).collect()
    }

    /// The ends of the path and the shares at which an argument that goes straight meets a kink or
    /// a knot, ascending.
    fn corners(&self, ways: &dyn Fn(u32) -> [f64; 2]) -> Vec<f64> {
        let mut corners = vec![0.0, 1.0];
        let mut add = |argument: &Program, knots: &[f64]| {
            let [a, b] = [0, 1].map(|end| argument.at_slots(&|slot| ways(slot)[end]));
            let shares = knots.iter().map(|knot| (knot - a) / (b - a));
            corners.extend(shares.filter(|share| *share > 0.0 && *share < 1.0));
        };
        self.kinks.iter().for_each(|kink| add(kink, &[0.0]));
        for call in &self.table_calls {
            for (axis, argument) in call.arguments.iter().enumerate() {
                add(argument, call.table.knots(axis));
            }
        }
        corners.sort_by(f64::total_cmp);
        corners.dedup();
        corners
    }

    /// The result for these numbers; NaN if it has none.
    fn at_slots(&self, of: &dyn Fn(u32) -> f64) -> f64 {
        let size = self.slots.last().map_or(0, |last| *last as usize + 1);
        let mut slots = vec![f64::NAN; size];
        self.slots.iter().for_each(|&slot| slots[slot as usize] = of(slot));
        self.eval(&slots, &mut Vec::new()).unwrap_or(f64::NAN)
    }
}

struct Walk<'a> {
    program: &'a Program,
    ways: &'a dyn Fn(u32) -> [f64; 2],
    least: f64,
    looks: usize,
    /// The place of the last rise or fall, and true for a rise.
    last: Option<(f64, bool)>,
    turns: Vec<Part>,
    /// Parts in which it is level.
    flats: Vec<Part>,
}

impl Walk<'_> {
    fn value(&self, share: f64) -> f64 {
        self.program.at_slots(&|slot| {
            let [from, to] = (self.ways)(slot);
            from + share * (to - from)
        })
    }

    /// Processes the next part of the path.
    fn look(&mut self, [from, to]: Part) {
        self.looks = self.looks.saturating_sub(1);
        let bounds = self.program.enclosed(&|slot| Taylor::on_way((self.ways)(slot), [from, to]));
        let slope = bounds.slope();
        if bounds.value().is_bounded() {
            if bounds.value().width() <= SAME * bounds.value().magnitude() {
                return self.flats.push([from, to]);
            }
        } else if [from, to].iter().all(|share| self.value(*share).is_nan()) {
            return;
        }
        if slope.low >= 0.0 && slope.high <= 0.0 {
            return self.flats.push([from, to]);
        }
        if slope.low >= 0.0 || slope.high <= 0.0 {
            return self.goes([from, to], slope.low >= 0.0);
        }
        if to - from > self.least && self.looks > 0 {
            let middle = from.midpoint(to);
            self.look([from, middle]);
            return self.look([middle, to]);
        }
        let (a, b) = (self.value(from), self.value(to));
        if (b - a).abs() > SAME * a.abs().max(b.abs()) {
            self.goes([from, to], b > a);
        }
    }

    fn goes(&mut self, [from, to]: Part, rises: bool) {
        if let Some((end, rose)) = self.last
            && rose != rises
        {
            self.turns.push([end, from]);
        }
        self.last = Some((to, rises));
    }

    /// The nearest turns or level parts on both sides of a turn, or the ends of the path.
    fn around(&self, turn: usize) -> Part {
        let [from, to] = self.turns[turn];
        let before = turn.checked_sub(1).map_or(0.0, |before| self.turns[before][1]);
        let behind = self.turns.get(turn + 1).map_or(1.0, |behind| behind[0]);
        let first = self.flats.partition_point(|flat| flat[1] <= from);
        let next = first + self.flats[first..].partition_point(|flat| flat[0] < to);
        let level = first.checked_sub(1).map_or(0.0, |flat| self.flats[flat][1]);
        let falls_to = self.flats.get(next).map_or(1.0, |flat| flat[0]);
        [before.max(level), behind.min(falls_to)]
    }

    /// A turn with the values close to it, in relation to the smaller of the two falls or rises to
    /// its neighbours.
    fn widened(&self, turn: Part, others: Part) -> Part {
        let falls = [0, 1].map(|side| (self.value(others[side]) - self.value(turn[side])).abs());
        let most = NEAR * falls[0].min(falls[1]);
        [self.beside(turn[0], others[0], most), self.beside(turn[1], others[1], most)]
    }

    /// The place between a turn and another place up to which the value changes by at most `most`.
    fn beside(&self, turn: f64, other: f64, most: f64) -> f64 {
        let top = self.value(turn);
        let mut way = other - turn;
        for _ in 0..HALVINGS {
            way *= 0.5;
            if (self.value(turn + way) - top).abs() <= most {
                break;
            }
        }
        turn + way
    }
}
