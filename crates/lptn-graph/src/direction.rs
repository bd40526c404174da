//! The end of each path that is to the left, the same in every picture of a network.
//!
//! Heat comes from sources and goes to boundaries, so the first end is that of the larger potential
//! in a network of equal conductances, in which every source gives the same heat and boundaries have
//! the potential 0. It does not depend on the state that is shown: a page has the same network at
//! two times, and a reader compares them. Order by names or by the file made the circuit of six
//! surfaces that see each other begin with the coldest. Without sources, paths keep the order that
//! the file gives, and streams always do.

use faer::Mat;
use lptn_integrate::dense::cholesky_solve;

use crate::model::{Diagram, PlaceRole};

/// Conductance from each place to a potential of 0, as a share of that of a path: a part of the
/// network without boundary has a solution too.
const LEAK: f64 = 1e-3;

/// Potentials closer than this share of the largest are equal.
const EQUAL: f64 = 1e-9;

/// The places left and right of each path.
pub(crate) fn ends(diagram: &Diagram) -> Vec<(usize, usize)> {
    let potential = if diagram.sources.is_empty() { None } else { potentials(diagram) };
    let of = |link: &crate::model::Link| {
        let ends = (link.from, link.to);
        let Some(potential) = potential.as_ref().filter(|_| !link.stream) else { return ends };
        let most = potential.iter().copied().fold(0.0, f64::max);
        let fall = potential[link.from] - potential[link.to];
        let turned = match fall.abs() > EQUAL * most {
            true => fall < 0.0,
            false => link.to < link.from,
        };
        if turned { (link.to, link.from) } else { ends }
    };
    diagram.links.iter().map(of).collect()
}

/// The potential of each place; `None` if there is none.
fn potentials(diagram: &Diagram) -> Option<Vec<f64>> {
    let count = diagram.places.len();
    let mut balance = Mat::<f64>::zeros(count, count);
    let mut heat = Mat::<f64>::zeros(count, 1);
    for (i, place) in diagram.places.iter().enumerate() {
        let fixed = place.role == PlaceRole::Boundary;
        balance[(i, i)] = if fixed { 1.0 / LEAK } else { LEAK };
    }
    for link in diagram.links.iter().filter(|link| link.from != link.to) {
        let (a, b) = (link.from, link.to);
        for (i, j) in [(a, b), (b, a)] {
            balance[(i, i)] += 1.0;
            balance[(i, j)] -= 1.0;
        }
    }
    diagram.sources.iter().for_each(|source| heat[(source.into, 0)] += 1.0);
    let found = cholesky_solve(balance.as_ref(), heat.as_ref())?;
    Some((0..count).map(|i| found[(i, 0)]).collect())
}
