//! Solves with factors whose columns stand one by one, several times as fast as faer's, which are
//! written for every kind of number and for many right sides.

use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};

/// Where the numbers of such factors are: column by column, the diagonal first.
pub(super) struct Columns {
    starts: Vec<usize>,
    /// None where nearly all would have a single column, as in a chain.
    blocks: Vec<Block>,
    /// The rows below the blocks, one block after another; without blocks the rows of the columns,
    /// the diagonal included.
    rows: Vec<u32>,
    /// The row of the matrix that each position of the factors stands for.
    order: Vec<u32>,
}

/// Neighbouring columns with the same rows below them, which are then looked up once for all.
struct Block {
    width: u32,
    /// Rows below the last of its columns.
    below: u32,
}

/// The most columns of a block.
const WIDEST: usize = 4;

impl Columns {
    /// `None` for factors that faer takes several columns at a time.
    pub(super) fn of(symbolic: &SymbolicCholesky<usize>) -> Option<Self> {
        let SymbolicCholeskyRaw::Simplicial(factor) = symbolic.raw() else { return None };
        let small = |&index: &usize| u32::try_from(index).ok();
        let order = match symbolic.perm() {
            Some(order) => order.arrays().0.iter().map(small).collect(),
            None => (0..factor.ncols()).map(|index| small(&index)).collect::<Option<Vec<u32>>>(),
        };
        let starts = factor.col_ptr().to_vec();
        let (mut blocks, mut rows) = (Vec::new(), Vec::new());
        let mut first = 0;
        while first < factor.ncols() {
            let width = width_of_block(&starts, factor.row_idx(), first);
            let last = first + width - 1;
            let below = &factor.row_idx()[starts[last] + 1..starts[last + 1]];
            blocks.push(Block { width: small(&width)?, below: small(&below.len())? });
            for row in below {
                rows.push(small(row)?);
            }
            first += width;
        }
        if 5 * blocks.len() > 4 * factor.ncols() {
            blocks.clear();
            rows = factor.row_idx().iter().map(small).collect::<Option<Vec<u32>>>()?;
        }
        Some(Self { starts, blocks, rows, order: order? })
    }

    /// Puts the reciprocals of the diagonal in its place, as [`Columns::solve`] wants them.
    pub(super) fn invert_diagonal(&self, factors: &mut [f64]) {
        let starts = &self.starts[..self.order.len()];
        starts.iter().for_each(|&start| factors[start] = factors[start].recip());
    }

    /// Replaces `b` by the solution of `L L' x = b`; `work` is memory to work in.
    pub(super) fn solve(&self, factors: &[f64], b: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.order.iter().map(|&row| b[row as usize]));
        if self.blocks.is_empty() {
            self.solve_by_column(factors, work);
        } else {
            self.forward(factors, work);
            self.backward(factors, work);
        }
        for (&row, value) in self.order.iter().zip(&*work) {
            b[row as usize] = *value;
        }
    }

    fn solve_by_column(&self, factors: &[f64], work: &mut [f64]) {
        for (column, ends) in self.starts.windows(2).enumerate() {
            let (first, below) = (ends[0], ends[0] + 1..ends[1]);
            let value = work[column] * factors[first];
            work[column] = value;
            for (&row, entry) in self.rows[below.clone()].iter().zip(&factors[below]) {
                work[row as usize] -= entry * value;
            }
        }
        for (column, ends) in self.starts.windows(2).enumerate().rev() {
            let (first, below) = (ends[0], ends[0] + 1..ends[1]);
            let entries = self.rows[below.clone()].iter().zip(&factors[below]);
            let sum: f64 = entries.map(|(&row, entry)| entry * work[row as usize]).sum();
            work[column] = (work[column] - sum) * factors[first];
        }
    }

    fn forward(&self, mut factors: &[f64], work: &mut [f64]) {
        let (mut rows, mut first) = (&self.rows[..], 0);
        for block in &self.blocks {
            let (width, below) = (block.width as usize, block.below as usize);
            let (these, others) = rows.split_at(below);
            let (entries, rest) = factors.split_at(numbers(width, below));
            match width {
                1 => forward::<1>(entries, these, first, work),
                2 => forward::<2>(entries, these, first, work),
                3 => forward::<3>(entries, these, first, work),
                _ => forward::<WIDEST>(entries, these, first, work),
            }
            (rows, factors, first) = (others, rest, first + width);
        }
    }

    fn backward(&self, mut factors: &[f64], work: &mut [f64]) {
        let (mut rows, mut end) = (&self.rows[..], work.len());
        for block in self.blocks.iter().rev() {
            let (width, below) = (block.width as usize, block.below as usize);
            let (others, these) = rows.split_at(rows.len() - below);
            let (rest, entries) = factors.split_at(factors.len() - numbers(width, below));
            end -= width;
            match width {
                1 => backward::<1>(entries, these, end, work),
                2 => backward::<2>(entries, these, end, work),
                3 => backward::<3>(entries, these, end, work),
                _ => backward::<WIDEST>(entries, these, end, work),
            }
            (rows, factors) = (others, rest);
        }
    }
}

/// How many columns from this one on have the rows of the one before without its first.
fn width_of_block(starts: &[usize], rows: &[usize], first: usize) -> usize {
    let column = |c: usize| starts.get(c + 1).map(|&end| &rows[starts[c]..end]);
    let follows = |c: usize| match (column(c - 1), column(c)) {
        (Some(before), Some(own)) => before.len() == own.len() + 1 && before[1..] == *own,
        _ => false,
    };
    1 + (first + 1..first + WIDEST).take_while(|&c| follows(c)).count()
}

/// How many numbers a block has.
fn numbers(width: usize, below: usize) -> usize {
    width * (width + 1) / 2 + width * below
}

/// Of each column what stands inside the block, its diagonal first, and what stands below.
fn parts<const W: usize>(mut entries: &[f64], below: usize) -> ([&[f64]; W], [&[f64]; W]) {
    let (mut inside, mut under) = ([&[][..]; W], [&[][..]; W]);
    for k in 0..W {
        let (own, rest) = entries.split_at(W - k);
        inside[k] = own;
        (under[k], entries) = rest.split_at(below);
    }
    (inside, under)
}

fn forward<const W: usize>(entries: &[f64], rows: &[u32], first: usize, work: &mut [f64]) {
    let (inside, under) = parts::<W>(entries, rows.len());
    let own = &mut work[first..first + W];
    let mut values = [0.0; W];
    for k in 0..W {
        values[k] = own[k] * inside[k][0];
        own[k] = values[k];
        for j in k + 1..W {
            own[j] -= inside[k][j - k] * values[k];
        }
    }
    let under = under.map(|entries| &entries[..rows.len()]);
    for (i, &row) in rows.iter().enumerate() {
        let left = &mut work[row as usize];
        for k in 0..W {
            *left -= under[k][i] * values[k];
        }
    }
}

fn backward<const W: usize>(entries: &[f64], rows: &[u32], first: usize, work: &mut [f64]) {
    let (inside, under) = parts::<W>(entries, rows.len());
    let under = under.map(|entries| &entries[..rows.len()]);
    let mut sums = [0.0; W];
    for (i, &row) in rows.iter().enumerate() {
        let value = work[row as usize];
        for k in 0..W {
            sums[k] += under[k][i] * value;
        }
    }
    let own = &mut work[first..first + W];
    for k in (0..W).rev() {
        let inner: f64 = (k + 1..W).map(|j| inside[k][j - k] * own[j]).sum();
        own[k] = (own[k] - sums[k] - inner) * inside[k][0];
    }
}
