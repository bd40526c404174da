//! The estimate at one row as the reference of the next row.

use crate::infer::model::{Model, coordinates};
use crate::infer::prior::Begins;
use crate::infer::reference::Reference;
use crate::infer::task::InferTask;
use crate::kalman::{Filter, Gaussian};

/// The estimate at a moment as the reference of the next, and the states relative to it.
pub(crate) fn carried(
    task: &InferTask,
    (model, reference): (&Model, &Reference),
    (filter, begins, k): (&Filter, &Begins, usize),
) -> (Reference, Gaussian) {
    let states = &model.states;
    let Gaussian { mean, mut covariance } = filter.state().clone();
    let nodes = &model.reference[k];
    let temperature = |i: usize| -> f64 {
        let moved = model.nodes[k][i].iter().map(|(place, weight)| weight * mean[*place]);
        nodes[i] + moved.sum::<f64>()
    };
    let courses = coordinates(task, reference, k).into_iter().zip(&task.estimated).enumerate();
    let courses = courses.map(|(j, (own, estimated))| {
        let there = own + mean[states.course(j)];
        vec![if estimated.positive { there.exp() } else { there }]
    });
    let next = Reference {
        courses: courses.collect(),
        parameters: (reference.parameters.iter().enumerate())
            .map(|(i, own)| task.uncertain[i].moved(*own, mean[states.parameter(i)]))
            .collect(),
        initial: begins.bodies.iter().map(|id| (*id, temperature(id.index()))).collect(),
        reads: (reference.reads.iter().enumerate())
            .map(|(r, own)| own + mean[states.read(r)])
            .collect(),
    };
    let mut moved = vec![0.0; mean.len()];
    for (column, _) in &states.slow {
        let Some(place) = states.shown(*column) else { continue };
        let of = task.run.columns[*column].nodes().iter();
        let there: f64 = of.map(|(id, factor)| factor * temperature(id.index())).sum();
        moved[place] = model.shown[*column][k] + mean[place] - there;
    }
    let drifts = states.drifts.iter().filter_map(|column| states.drift(*column));
    drifts.for_each(|place| moved[place] = mean[place]);
    // a body restarts as its temperature; integrals begin at 0
    let size = |i: usize| match i {
        i if i < states.bodies => {
            let own = &model.nodes[k][begins.bodies[i].index()];
            own.iter().find(|(place, _)| *place == i).map_or(1.0, |(_, slope)| *slope)
        }
        i if (0..states.estimated).any(|j| states.area(j) == i) => 0.0,
        _ => 1.0,
    };
    let count = mean.len();
    for i in 0..count {
        for j in 0..count {
            covariance[i * count + j] *= size(i) * size(j);
        }
    }
    (next, Gaussian { mean: moved, covariance })
}
