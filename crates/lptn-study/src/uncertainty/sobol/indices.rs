//! The shares of the variance, and the errors of all sampled numbers.

use crate::uncertainty::answer::{Answer, AnswerOf, Contribution};
use crate::uncertainty::estimate::{Estimate, moments, quantile};
use crate::uncertainty::sample::Sample;
use crate::uncertainty::sobol::regression::Regression;
use crate::uncertainty::sobol::{Blocks, Design, GROUPS};
use crate::uncertainty::task::UncertaintyTask;

/// Every answer with its uncertainty and its ranking.
pub(super) fn answers(
    task: &UncertaintyTask<'_>,
    nominal: &Sample,
    blocks: &Blocks,
    design: &Design<'_>,
) -> Vec<Answer> {
    let questions = task.questions().into_iter().enumerate();
    let regression = design.inputs.are_correlated().then(|| Regression::of(blocks, design));
    let one = |(place, of): (usize, AnswerOf)| {
        let column = Column::of(blocks, place);
        let ranking = match &regression {
            Some(regression) => regression.contributions(place),
            None => {
                (0..design.inputs.len()).map(|input| column.contribution(input, design)).collect()
            }
        };
        column.answer(of, nominal.answers[place], ranking).sorted()
    };
    questions.map(one).collect()
}

/// One answer in all runs.
struct Column {
    /// Its values in the base runs, ascending, each with its group.
    base: Vec<(f64, usize)>,
    blocks: Vec<Row>,
}

/// One answer in the runs of one base point.
struct Row {
    number: usize,
    group: usize,
    base: [Option<f64>; 2],
    mixed: Vec<Option<f64>>,
}

impl Column {
    fn of(blocks: &Blocks, place: usize) -> Self {
        let row = |(number, block): (usize, &super::Block)| {
            let base = [0, 1]
                .map(|k: usize| block.base[k].as_ref().ok().map(|sample| sample.answers[place]));
            let mixed =
                block.mixed.iter().map(|mixed| mixed.as_ref().ok().map(|answers| answers[place]));
            Row { number, group: number / blocks.per_group, base, mixed: mixed.collect() }
        };
        let blocks_of: Vec<Row> = blocks.blocks.iter().enumerate().map(row).collect();
        let mut base: Vec<(f64, usize)> =
            blocks.base().map(|(group, s)| (s.answers[place], group)).collect();
        base.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { base, blocks: blocks_of }
    }

    /// The values of the base runs except those of a group, ascending.
    fn kept(&self, left_out: Option<usize>) -> Vec<f64> {
        self.base
            .iter()
            .filter(|(_, group)| Some(*group) != left_out)
            .map(|(value, _)| *value)
            .collect()
    }

    fn rows(&self, left_out: Option<usize>) -> impl Iterator<Item = &Row> {
        self.blocks.iter().filter(move |row| Some(row.group) != left_out)
    }

    fn answer(&self, of: AnswerOf, value: f64, ranking: Vec<Contribution>) -> Answer {
        let estimate =
            |of: &dyn Fn(&[f64]) -> f64| Estimate::jackknife(GROUPS, |group| of(&self.kept(group)));
        let below = |values: &[f64]| values.iter().filter(|value| **value < 0.0).count() as f64;
        Answer {
            of,
            value,
            deviation: estimate(&|values| moments(values).1),
            low: estimate(&|values| quantile(values, 0.025)),
            median: Some(estimate(&|values| quantile(values, 0.5))),
            high: estimate(&|values| quantile(values, 0.975)),
            below_zero: estimate(&|values| below(values) / values.len() as f64),
            ranking,
        }
    }

    fn contribution(&self, input: usize, design: &Design<'_>) -> Contribution {
        let indices = |left_out| self.indices(input, left_out);
        Contribution {
            input,
            effect: self.effect(input, design),
            share: Estimate::jackknife(GROUPS, |group| indices(group)[0]),
            total: Some(Estimate::jackknife(GROUPS, |group| indices(group)[1])),
        }
    }

    /// First-order and total index: A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, table
    /// 2 (b) and (f), the first with values counted from their mean. Zero if nothing varies.
    fn indices(&self, input: usize, left_out: Option<usize>) -> [f64; 2] {
        let (mean, deviation) = moments(&self.kept(left_out));
        if deviation > 0.0 && self.blocks.iter().all(|row| row.mixed.len() == 1) {
            return [1.0; 2]; // the only parameter
        }
        let (mut sums, mut n) = ([0.0; 2], 0.0);
        for row in self.rows(left_out) {
            let ([Some(first), Some(second)], Some(mixed)) = (row.base, row.mixed[input]) else {
                continue;
            };
            sums[0] += (second - mean) * (mixed - first);
            sums[1] += 0.5 * (mixed - first) * (mixed - first);
            n += 1.0;
        }
        let variance = deviation * deviation;
        sums.map(|sum| if variance > 0.0 && n > 0.0 { sum / (n * variance) } else { 0.0 })
    }

    /// The slope of the straight line through the answers of the base runs over the parameter in
    /// standard deviations.
    fn effect(&self, input: usize, design: &Design<'_>) -> f64 {
        let point = |row: &Row, which: usize| {
            let score = design.normal(row.number, which, input);
            Some((design.inputs[input].standard(score), row.base[which]?))
        };
        let pairs = self.rows(None).flat_map(|row| [0, 1].map(|which| point(row, which)));
        let points: Vec<(f64, f64)> = pairs.flatten().collect();
        let n = points.len() as f64;
        let (z, y) = points.iter().fold((0.0, 0.0), |(z, y), p| (z + p.0 / n, y + p.1 / n));
        let products: f64 = points.iter().map(|p| (p.0 - z) * (p.1 - y)).sum();
        products / points.iter().map(|p| (p.0 - z) * (p.0 - z)).sum::<f64>()
    }
}
