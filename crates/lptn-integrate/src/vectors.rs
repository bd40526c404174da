//! Sums over vectors in the order of their components, as the small matrices of fits and reductions
//! take them. [`kernels`](crate::kernels) has sums in several parts, for long vectors.

/// Sum of `x[i] y[i]`.
#[inline]
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The length of a vector.
#[inline]
pub fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// `sum += factor x`
#[inline]
pub fn add(sum: &mut [f64], factor: f64, x: &[f64]) {
    sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += factor * x);
}

/// Takes the parts along orthonormal vectors off `x`, one after the other. Rounding leaves a part
/// of them; a second time removes it ("twice is enough": B. N. Parlett, The Symmetric Eigenvalue
/// Problem (1998), section 6.9).
pub fn take_off<'a>(x: &mut [f64], basis: impl IntoIterator<Item = &'a Vec<f64>>) {
    basis.into_iter().for_each(|vector| add(x, -dot(vector, x), vector));
}
