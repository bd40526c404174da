//! Products or sums of parameters that are determined if the parameters themselves are not.

/// Coefficients of a combination are whole numbers up to this.
const LARGEST: i32 = 2;

/// Largest number of parameters in one combination.
const MOST: usize = 3;

/// A combination lies across an undetermined direction if their angle is this close to a right one
/// (cosine).
const ACROSS: f64 = 1e-3;

/// Form of a determined combination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CombinationKind {
    /// A product of powers.
    Product,
    /// A sum of multiples.
    Sum,
}

/// The simplest whole-numbered combinations of `count` parameters that lie across every one of the
/// `unseen` directions: one for each determined direction, or nothing if there are fewer. In
/// logarithms they are exponents of products.
pub(crate) fn combinations(unseen: &[Vec<f64>], count: usize) -> Option<Vec<Vec<i32>>> {
    let wanted = count.checked_sub(unseen.len())?;
    let across = |c: &Vec<i32>| unseen.iter().all(|direction| cosine(direction, c).abs() < ACROSS);
    let mut found: Vec<Vec<i32>> = candidates(count).into_iter().filter(across).collect();
    found.sort_by_key(|c| complexity(c));
    let mut chosen: Vec<Vec<i32>> = Vec::new();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for candidate in found {
        if chosen.len() < wanted && is_independent(&mut basis, &candidate) {
            chosen.push(candidate);
        }
    }
    (chosen.len() == wanted).then_some(chosen)
}

fn cosine(direction: &[f64], c: &[i32]) -> f64 {
    let dot: f64 = direction.iter().zip(c).map(|(d, &c)| d * f64::from(c)).sum();
    let lengths = direction.iter().map(|d| d * d).sum::<f64>()
        * c.iter().map(|&c| f64::from(c * c)).sum::<f64>();
    dot / lengths.sqrt()
}

/// Few parameters first, small numbers before large ones, products before quotients, then the order
/// of the parameters.
fn complexity(c: &[i32]) -> (usize, i32, usize, Vec<usize>) {
    let used: Vec<usize> = (0..c.len()).filter(|&i| c[i] != 0).collect();
    let negative = c.iter().filter(|&&c| c < 0).count();
    (used.len(), c.iter().map(|c| c.abs()).sum(), negative, used)
}

/// All combinations of up to [`MOST`] parameters whose first coefficient is positive.
fn candidates(count: usize) -> Vec<Vec<i32>> {
    let mut all = Vec::new();
    let mut started = vec![(vec![0; count], 0)];
    while let Some((c, from)) = started.pop() {
        let used = c.iter().filter(|&&c| c != 0).count();
        if used > 0 {
            all.push(c.clone());
        }
        if used == MOST {
            continue;
        }
        for i in from..count {
            let least = if used == 0 { 1 } else { -LARGEST };
            for coefficient in (least..=LARGEST).filter(|&k| k != 0) {
                let mut next = c.clone();
                next[i] = coefficient;
                started.push((next, i + 1));
            }
        }
    }
    all.retain(|c| c.iter().fold(0, |divisor, &c| gcd(divisor, c.abs())) == 1);
    all
}

fn gcd(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Adds the new part of a combination to an orthogonal basis; false if there is nothing new.
fn is_independent(basis: &mut Vec<Vec<f64>>, c: &[i32]) -> bool {
    let mut rest: Vec<f64> = c.iter().map(|&c| f64::from(c)).collect();
    for known in basis.iter() {
        let share = rest.iter().zip(known).map(|(r, k)| r * k).sum::<f64>()
            / known.iter().map(|k| k * k).sum::<f64>();
        rest.iter_mut().zip(known).for_each(|(r, k)| *r -= share * k);
    }
    let new = rest.iter().any(|r| r.abs() > 1e-6);
    if new {
        basis.push(rest);
    }
    new
}

#[cfg(test)]
mod tests {
    use super::combinations;

    #[test]
    fn a_power_a_resistance_and_a_capacity_are_known_as_two_products() {
        // temperatures stay if P and C grow as R shrinks
        let found = combinations(&[vec![0.577, -0.577, 0.577]], 3);
        assert_eq!(found, Some(vec![vec![1, 1, 0], vec![0, 1, 1]]));
    }

    #[test]
    fn two_that_stand_for_each_other_are_known_as_their_sum() {
        assert_eq!(combinations(&[vec![0.7, -0.7]], 2), Some(vec![vec![1, 1]]));
        assert_eq!(combinations(&[vec![0.4, -0.8]], 2), Some(vec![vec![2, 1]]));
    }

    #[test]
    fn two_directions_at_once_and_ones_without_whole_numbers() {
        // of a, b, c only a b c is determined: anything across it is undetermined
        let unseen = [vec![1.0, -1.0, 0.0], vec![1.0, 1.0, -2.0]];
        assert_eq!(combinations(&unseen, 3), Some(vec![vec![1, 1, 1]]));
        assert_eq!(combinations(&[vec![1.0, -0.37]], 2), None);
        assert_eq!(combinations(&[vec![1.0, 0.0], vec![0.0, 1.0]], 2), Some(vec![]));
    }
}
