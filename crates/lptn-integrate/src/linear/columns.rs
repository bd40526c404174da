//! Solves with factors stored column by column, several times as fast as faer's, which are written
//! for every kind of number and for many right sides.
//!
//! The factors are rearranged after each factorisation. A run of equal columns is one loop. If
//! neighbouring columns have the same rows below them, those rows are read once.

use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};

/// Layout of such factors, block by block: first the inside of the block, column by column with the
/// diagonal first, then the rows below.
pub(super) struct Columns {
    runs: Vec<Run>,
    /// For each block the number of rows below the last of its columns.
    below: Vec<u32>,
    /// Those rows, one block after another.
    rows: Vec<u32>,
    /// The row of the matrix at each position of the factors.
    order: Vec<u32>,
}

/// Blocks that follow each other and are taken alike. A block is neighbouring columns with the same
/// rows below them, which are then read once for all.
#[derive(Clone, Copy)]
struct Run {
    kind: Kind,
    blocks: usize,
    /// The rows and the numbers of all.
    rows: usize,
    numbers: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Single columns with this number of rows below: in a chain all, in a body of cells those
    /// that are eliminated first.
    Short(usize),
    /// This number of columns each, with any rows below.
    Wide(usize),
}

/// The most columns of a block.
const WIDEST: usize = 4;

/// The most rows below a single column for which its loop is unrolled.
const SHORT: usize = 4;

/// Data of a run: its numbers, the number of rows below each of its blocks, and these rows.
#[derive(Clone, Copy)]
struct Part<'a> {
    entries: &'a [f64],
    below: &'a [u32],
    rows: &'a [u32],
}

impl Columns {
    /// `None` for factors that faer takes several columns at a time.
    pub(super) fn of(symbolic: &SymbolicCholesky<usize>) -> Option<Self> {
        let SymbolicCholeskyRaw::Simplicial(factor) = symbolic.raw() else { return None };
        let small = |&index: &usize| u32::try_from(index).ok();
        let order = match symbolic.perm() {
            Some(order) => order.arrays().0.iter().map(small).collect(),
            None => (0..factor.ncols()).map(|index| small(&index)).collect::<Option<Vec<u32>>>(),
        };
        let starts = factor.col_ptr();
        let mut all = Self { runs: Vec::new(), below: Vec::new(), rows: Vec::new(), order: order? };
        let mut first = 0;
        while first < factor.ncols() {
            let width = width_of_block(starts, factor.row_idx(), first);
            let last = first + width - 1;
            let below = &factor.row_idx()[starts[last] + 1..starts[last + 1]];
            all.add_block(width, below.len());
            all.below.push(small(&below.len())?);
            for row in below {
                all.rows.push(small(row)?);
            }
            first += width;
        }
        Some(all)
    }

    /// Adds a block to the last run, or to a new one.
    fn add_block(&mut self, width: usize, below: usize) {
        let kind = match width {
            1 if (1..=SHORT).contains(&below) => Kind::Short(below),
            _ => Kind::Wide(width),
        };
        if self.runs.last().is_none_or(|run| run.kind != kind) {
            self.runs.push(Run { kind, blocks: 0, rows: 0, numbers: 0 });
        }
        if let Some(run) = self.runs.last_mut() {
            run.blocks += 1;
            run.rows += below;
            run.numbers += numbers(width, below);
        }
    }

    /// Brings factors that are stored column by column into the order of [`Columns::solve`], with
    /// the reciprocals of the diagonal in its place.
    pub(super) fn arrange(&self, mut factors: &mut [f64]) {
        let (mut below, mut work) = (self.below.iter(), Vec::new());
        for run in &self.runs {
            if let Kind::Short(length) = run.kind {
                // single columns are in their order
                let (own, rest) = factors.split_at_mut(run.numbers);
                own.chunks_exact_mut(length + 1).for_each(|column| column[0] = column[0].recip());
                below.by_ref().take(run.blocks).for_each(drop);
                factors = rest;
                continue;
            }
            for &below in below.by_ref().take(run.blocks) {
                let (width, below) = (run.kind.width(), below as usize);
                let (own, rest) = factors.split_at_mut(numbers(width, below));
                work.clear();
                work.extend_from_slice(own);
                arrange_block((width, below), &work, own);
                factors = rest;
            }
        }
    }

    /// Replaces `b` by the solution of `L L' x = b`; `work` is memory to work in.
    pub(super) fn solve(&self, factors: &[f64], b: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.order.iter().map(|&row| b[row as usize]));
        self.forward(factors, work);
        self.backward(factors, work);
        for (&row, value) in self.order.iter().zip(&*work) {
            b[row as usize] = *value;
        }
    }

    fn forward(&self, entries: &[f64], work: &mut [f64]) {
        let (mut rest, mut first) = (Part { entries, below: &self.below, rows: &self.rows }, 0);
        for run in &self.runs {
            let (own, behind) = rest.split(run.numbers, run.blocks, run.rows);
            match run.kind {
                Kind::Short(1) => short::forward::<1>(own, first, work),
                Kind::Short(2) => short::forward::<2>(own, first, work),
                Kind::Short(3) => short::forward::<3>(own, first, work),
                Kind::Short(_) => short::forward::<SHORT>(own, first, work),
                Kind::Wide(1) => wide::forward::<1>(own, first, work),
                Kind::Wide(2) => wide::forward::<2>(own, first, work),
                Kind::Wide(3) => wide::forward::<3>(own, first, work),
                Kind::Wide(_) => wide::forward::<WIDEST>(own, first, work),
            }
            (rest, first) = (behind, first + run.columns());
        }
    }

    fn backward(&self, entries: &[f64], work: &mut [f64]) {
        let (mut rest, mut end) =
            (Part { entries, below: &self.below, rows: &self.rows }, work.len());
        for run in self.runs.iter().rev() {
            let (before, own) = rest.split_end(run.numbers, run.blocks, run.rows);
            match run.kind {
                Kind::Short(1) => short::backward::<1>(own, end, work),
                Kind::Short(2) => short::backward::<2>(own, end, work),
                Kind::Short(3) => short::backward::<3>(own, end, work),
                Kind::Short(_) => short::backward::<SHORT>(own, end, work),
                Kind::Wide(1) => wide::backward::<1>(own, end, work),
                Kind::Wide(2) => wide::backward::<2>(own, end, work),
                Kind::Wide(3) => wide::backward::<3>(own, end, work),
                Kind::Wide(_) => wide::backward::<WIDEST>(own, end, work),
            }
            (rest, end) = (before, end - run.columns());
        }
    }
}

impl Run {
    /// Number of columns.
    fn columns(&self) -> usize {
        self.blocks * self.kind.width()
    }
}

impl Kind {
    /// Number of columns of each block.
    fn width(self) -> usize {
        match self {
            Self::Short(_) => 1,
            Self::Wide(width) => width,
        }
    }
}

impl<'a> Part<'a> {
    /// The given counts of numbers, blocks and rows from the front, and the rest.
    fn split(self, numbers: usize, blocks: usize, rows: usize) -> (Self, Self) {
        let (own, entries) = self.entries.split_at(numbers);
        let (own_below, below) = self.below.split_at(blocks);
        let (own_rows, rows) = self.rows.split_at(rows);
        (Self { entries: own, below: own_below, rows: own_rows }, Self { entries, below, rows })
    }

    /// The same from the end: the rest, and the part at the end.
    fn split_end(self, numbers: usize, blocks: usize, rows: usize) -> (Self, Self) {
        let Part { entries, below, rows: all } = self;
        self.split(entries.len() - numbers, below.len() - blocks, all.len() - rows)
    }
}

/// Number of columns from this one on that have the rows of the one before without its first.
fn width_of_block(starts: &[usize], rows: &[usize], first: usize) -> usize {
    let column = |c: usize| starts.get(c + 1).map(|&end| &rows[starts[c]..end]);
    let follows = |c: usize| match (column(c - 1), column(c)) {
        (Some(before), Some(own)) => before.len() == own.len() + 1 && before[1..] == *own,
        _ => false,
    };
    1 + (first + 1..first + WIDEST).take_while(|&c| follows(c)).count()
}

/// Count of the numbers of a block.
fn numbers(width: usize, below: usize) -> usize {
    width * (width + 1) / 2 + width * below
}

fn arrange_block((width, below): (usize, usize), columns: &[f64], block: &mut [f64]) {
    let (inside, under) = block.split_at_mut(numbers(width, 0));
    let (mut inside, mut from) = (inside.iter_mut(), 0);
    for column in 0..width {
        let (own, after) = (&columns[from..][..width - column], from + width - column);
        for (at, (value, entry)) in own.iter().zip(inside.by_ref()).enumerate() {
            *entry = if at == 0 { value.recip() } else { *value };
        }
        let entries = under.iter_mut().skip(column).step_by(width);
        entries.zip(&columns[after..]).for_each(|(entry, value)| *entry = *value);
        from = after + below;
    }
}

/// Blocks of `W` columns.
mod wide {
    use super::{Part, numbers};

    // each in its own function, whose few variables fit into registers
    #[inline(never)]
    pub(super) fn forward<const W: usize>(part: Part<'_>, first: usize, work: &mut [f64]) {
        let (mut entries, mut rows, mut first) = (part.entries, part.rows, first);
        for &below in part.below {
            let (own, behind) = entries.split_at(numbers(W, below as usize));
            let (own_rows, others) = rows.split_at(below as usize);
            let (inside, under) = own.split_at(numbers(W, 0));
            let values = inside_forward::<W>(inside, &mut work[first..first + W]);
            for (&row, entries) in own_rows.iter().zip(under.as_chunks::<W>().0) {
                let left = &mut work[row as usize];
                for k in 0..W {
                    *left -= entries[k] * values[k];
                }
            }
            (entries, rows, first) = (behind, others, first + W);
        }
    }

    #[inline(never)]
    pub(super) fn backward<const W: usize>(part: Part<'_>, end: usize, work: &mut [f64]) {
        let (mut entries, mut rows, mut first) = (part.entries, part.rows, end);
        for &below in part.below.iter().rev() {
            let (before, own) = entries.split_at(entries.len() - numbers(W, below as usize));
            let (others, own_rows) = rows.split_at(rows.len() - below as usize);
            let (inside, under) = own.split_at(numbers(W, 0));
            let mut sums = [0.0; W];
            for (&row, entries) in own_rows.iter().zip(under.as_chunks::<W>().0) {
                let value = work[row as usize];
                for k in 0..W {
                    sums[k] += entries[k] * value;
                }
            }
            first -= W;
            inside_backward(inside, sums, &mut work[first..first + W]);
            (entries, rows) = (before, others);
        }
    }

    fn inside_forward<const W: usize>(inside: &[f64], own: &mut [f64]) -> [f64; W] {
        let (mut values, mut at) = ([0.0; W], 0);
        for k in 0..W {
            values[k] = own[k] * inside[at];
            own[k] = values[k];
            for j in k + 1..W {
                own[j] -= inside[at + j - k] * values[k];
            }
            at += W - k;
        }
        values
    }

    fn inside_backward<const W: usize>(inside: &[f64], sums: [f64; W], own: &mut [f64]) {
        let mut at = inside.len();
        for k in (0..W).rev() {
            at -= W - k;
            let inner: f64 = (k + 1..W).map(|j| inside[at + j - k] * own[j]).sum();
            own[k] = (own[k] - sums[k] - inner) * inside[at];
        }
    }
}

/// Single columns with `B` rows below each, few enough to be written out.
mod short {
    use super::Part;

    #[inline(never)]
    pub(super) fn forward<const B: usize>(part: Part<'_>, first: usize, work: &mut [f64]) {
        let columns = part.entries.chunks_exact(B + 1).zip(part.rows.as_chunks::<B>().0);
        for (column, (entries, rows)) in (first..).zip(columns) {
            let value = work[column] * entries[0];
            work[column] = value;
            for k in 0..B {
                work[rows[k] as usize] -= entries[k + 1] * value;
            }
        }
    }

    #[inline(never)]
    pub(super) fn backward<const B: usize>(part: Part<'_>, end: usize, work: &mut [f64]) {
        let columns = part.entries.chunks_exact(B + 1).zip(part.rows.as_chunks::<B>().0);
        let first = end - columns.len();
        for ((entries, rows), column) in columns.rev().zip((first..end).rev()) {
            let mut sum = 0.0;
            for k in 0..B {
                sum += entries[k + 1] * work[rows[k] as usize];
            }
            work[column] = (work[column] - sum) * entries[0];
        }
    }
}
