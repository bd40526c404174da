//! Order in the columns, such that few wires cross.

/// Number of sweeps through all columns.
const SWEEPS: usize = 12;

/// For each vertex, the vertices that it is joined to in the columns before and after its own.
pub(crate) type Neighbours = [Vec<Vec<usize>>; 2];

/// Orders every column by the mean position of the vertices that its own are joined to. Keeps the
/// best order found.
pub(crate) fn reduce_crossings(layers: &mut Vec<Vec<usize>>, neighbours: &Neighbours) {
    let mut best = (crossings(layers, &neighbours[1]), layers.clone());
    for sweep in 0..SWEEPS {
        let forth = sweep % 2 == 0;
        let count = layers.len();
        for k in 0..count {
            let layer = if forth { k } else { count - 1 - k };
            sort(layers, layer, &neighbours[usize::from(!forth)]);
        }
        let found = crossings(layers, &neighbours[1]);
        if found < best.0 {
            best = (found, layers.clone());
        }
    }
    *layers = best.1;
    exchange(layers, neighbours, &|_, _| true);
}

/// Exchanges neighbours of a column that may be exchanged, as long as fewer wires cross.
pub(crate) fn exchange(
    layers: &mut [Vec<usize>],
    neighbours: &Neighbours,
    may: &dyn Fn(usize, usize) -> bool,
) {
    for _ in 0..SWEEPS {
        let mut moved = false;
        for layer in 0..layers.len() {
            let at = places(layers, neighbours[0].len());
            for i in 1..layers[layer].len() {
                let (a, b) = (layers[layer][i - 1], layers[layer][i]);
                let pairs = |a: usize, b: usize| {
                    let of = |side: &Vec<Vec<usize>>| {
                        let after = |y: &usize| side[b].iter().filter(|z| at[**z] < at[*y]).count();
                        side[a].iter().map(after).sum::<usize>()
                    };
                    neighbours.iter().map(of).sum::<usize>()
                };
                if may(a, b) && pairs(b, a) < pairs(a, b) {
                    layers[layer].swap(i - 1, i);
                    moved = true;
                }
            }
        }
        if !moved {
            break;
        }
    }
}

/// The place of each vertex in its column.
fn places(layers: &[Vec<usize>], count: usize) -> Vec<usize> {
    let mut at = vec![0; count];
    for layer in layers {
        layer.iter().enumerate().for_each(|(i, v)| at[*v] = i);
    }
    at
}

/// Position of each vertex in its column, from 0, the first, to 1.
fn positions(layers: &[Vec<usize>], count: usize) -> Vec<f64> {
    let mut at = vec![0.0; count];
    for layer in layers {
        for (i, v) in layer.iter().enumerate() {
            at[*v] = (i as f64 + 0.5) / layer.len() as f64;
        }
    }
    at
}

fn sort(layers: &mut [Vec<usize>], layer: usize, joined: &[Vec<usize>]) {
    let at = positions(layers, joined.len());
    let wish = |v: usize| match joined[v].as_slice() {
        [] => at[v],
        all => all.iter().map(|other| at[*other]).sum::<f64>() / all.len() as f64,
    };
    layers[layer].sort_by(|a, b| wish(*a).total_cmp(&wish(*b)));
}

/// Number of pairs of wires that cross.
fn crossings(layers: &[Vec<usize>], after: &[Vec<usize>]) -> usize {
    let at = places(layers, after.len());
    layers.iter().map(|layer| inversions(layer, after, &at)).sum()
}

/// Pairs of wires after a column whose ends are in the opposite order to their beginnings.
fn inversions(layer: &[usize], after: &[Vec<usize>], at: &[usize]) -> usize {
    // a Fenwick tree over the positions of the next column
    let most = layer.iter().flat_map(|v| &after[*v]).map(|v| at[*v] + 1).max().unwrap_or(0);
    let mut tree = vec![0_usize; most + 1];
    let (mut total, mut sum) = (0, 0);
    for v in layer {
        for other in &after[*v] {
            let (mut k, mut not_after) = (at[*other] + 1, 0);
            while k > 0 {
                not_after += tree[k];
                k &= k - 1;
            }
            sum += total - not_after;
        }
        for other in &after[*v] {
            let mut k = at[*other] + 1;
            while k < tree.len() {
                tree[k] += 1;
                k += k & k.wrapping_neg();
            }
            total += 1;
        }
    }
    sum
}
