//! Bands at every row.

use lptn_solve::in_parallel;

use crate::uncertainty::estimate::{moments, quantile};
use crate::uncertainty::result::Bands;
use crate::uncertainty::sample::Sample;
use crate::uncertainty::sobol::Blocks;
use crate::uncertainty::task::UncertaintyTask;

/// For each node its band; the rows are shared out over `threads`.
pub(super) fn bands(
    task: &UncertaintyTask<'_>,
    nominal: &Sample,
    blocks: &Blocks,
    threads: usize,
) -> Vec<Bands> {
    let samples: Vec<&Sample> = blocks.base().map(|(_, sample)| sample).collect();
    let places: Vec<usize> = (0..nominal.rows.len()).collect();
    let of_rows = in_parallel(&places, threads, |&place| {
        let mut values: Vec<f64> = samples.iter().map(|sample| sample.rows[place]).collect();
        let (_, deviation) = moments(&values);
        values.sort_by(f64::total_cmp);
        [deviation, quantile(&values, 0.025), quantile(&values, 0.5), quantile(&values, 0.975)]
    });
    let rows = nominal.rows.len() / task.nodes.len().max(1);
    let one = |(node, (value, found)): (_, (&[f64], &[[f64; 4]]))| {
        let column = |k: usize| found.iter().map(|numbers| numbers[k]).collect::<Vec<f64>>();
        let (deviation, low, high) = (column(0), column(1), column(3));
        Bands { node, value: value.to_vec(), deviation, low, median: Some(column(2)), high }
    };
    let chunks = nominal.rows.chunks(rows.max(1)).zip(of_rows.chunks(rows.max(1)));
    task.nodes.iter().copied().zip(chunks).map(one).collect()
}
