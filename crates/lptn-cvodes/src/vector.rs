//! The `N_Vector` of this crate: a Rust allocation with SUNDIALS' table of operations.
//!
//! There are two reasons for it. Debian compiles SUNDIALS without optimisation, so its own vector
//! loops are 8 to 60 times slower. And `nvwrmsnorm` here is the weighted maximum, see the crate
//! documentation. Not implemented: the wrapping of foreign arrays (only difference quotients use
//! it), printing, parallel reductions, and the operations on arrays of vectors, for which SUNDIALS
//! falls back to the ones here.
//!
//! CVODE's own norm is a mean over the components, so idle nodes would dilute the tolerance. With
//! the maximum, the gearbox takes the same steps with 0 and with 10 000 idle nodes
//! (`tests/tolerance.rs`).

use std::ffi::c_int;
use std::slice;

use sundials_sys as sys;
use sys::{N_Vector, realtype, sunindextype};

use crate::context::Context;
use lptn_integrate::{IntegrateError, kernels};

/// Length of the pieces in which several vectors are combined. A piece is cleared whatever the
/// length of the vectors: at 512, that was half of all the work of a network of two nodes.
const BLOCK: usize = 64;

/// An owned vector.
pub(crate) struct Vector {
    raw: N_Vector,
}

impl Vector {
    pub(crate) fn new(context: &Context, length: usize) -> Result<Self, IntegrateError> {
        // SAFETY: the context is alive.
        let raw = unsafe { create(context.raw(), length) };
        if raw.is_null() {
            Err(IntegrateError::OutOfMemory { function: "N_VNewEmpty" })
        } else {
            Ok(Self { raw })
        }
    }

    pub(crate) fn raw(&self) -> N_Vector {
        self.raw
    }

    pub(crate) fn as_slice(&self) -> &[f64] {
        // SAFETY: the vector is one of ours, and no one writes to it while `self` is borrowed.
        unsafe { values(self.raw) }
    }

    pub(crate) fn as_mut_slice(&mut self) -> &mut [f64] {
        // SAFETY: the vector is one of ours, and `self` is borrowed for writing.
        unsafe { values_mut(self.raw) }
    }
}

impl Drop for Vector {
    fn drop(&mut self) {
        // SAFETY: made by `create`, freed once.
        unsafe { destroy(self.raw) };
    }
}

/// The values of a vector.
///
/// # Safety
/// `v` was made by `create`, and no one writes to it during `'a`.
pub(crate) unsafe fn values<'a>(v: N_Vector) -> &'a [f64] {
    // SAFETY: `content` is the `Vec` that `create` boxed.
    unsafe { (*(*v).content.cast::<Vec<f64>>()).as_slice() }
}

/// The values of a vector, to be written.
///
/// # Safety
/// `v` was made by `create`, and no one else reads or writes it during `'a`.
pub(crate) unsafe fn values_mut<'a>(v: N_Vector) -> &'a mut [f64] {
    // SAFETY: `content` is the `Vec` that `create` boxed.
    unsafe { (*(*v).content.cast::<Vec<f64>>()).as_mut_slice() }
}

/// # Safety
/// `context` is a live SUNDIALS context.
unsafe fn create(context: sys::SUNContext, length: usize) -> N_Vector {
    let mut data: Vec<f64> = Vec::new();
    if data.try_reserve_exact(length).is_err() {
        return std::ptr::null_mut();
    }
    data.resize(length, 0.0);
    // SAFETY: the context is alive; the result is null or a vector with an empty table of
    // operations.
    unsafe {
        let v = sys::N_VNewEmpty(context);
        if !v.is_null() {
            (*v).content = Box::into_raw(Box::new(data)).cast();
            fill_table(&mut *(*v).ops);
        }
        v
    }
}

fn fill_table(ops: &mut sys::_generic_N_Vector_Ops) {
    ops.nvgetvectorid = Some(kind);
    ops.nvclone = Some(clone);
    ops.nvdestroy = Some(destroy);
    ops.nvspace = Some(space);
    ops.nvgetarraypointer = Some(array_pointer);
    ops.nvgetlength = Some(length);
    ops.nvgetlocallength = Some(length);
    ops.nvlinearsum = Some(linear_sum);
    ops.nvconst = Some(fill);
    ops.nvprod = Some(product);
    ops.nvdiv = Some(quotient);
    ops.nvscale = Some(scale);
    ops.nvabs = Some(absolute);
    ops.nvinv = Some(inverse);
    ops.nvaddconst = Some(add_constant);
    ops.nvdotprod = Some(dot);
    ops.nvmaxnorm = Some(max_norm);
    ops.nvwrmsnorm = Some(weighted_max);
    ops.nvwrmsnormmask = Some(weighted_max_masked);
    ops.nvmin = Some(min);
    ops.nvwl2norm = Some(weighted_l2);
    ops.nvl1norm = Some(l1_norm);
    ops.nvcompare = Some(compare);
    ops.nvinvtest = Some(inverse_tested);
    ops.nvconstrmask = Some(constraint_mask);
    ops.nvminquotient = Some(min_quotient);
    ops.nvlinearcombination = Some(linear_combination);
    ops.nvscaleaddmulti = Some(scale_add_multi);
    ops.nvdotprodmulti = Some(dot_multi);
}

// The functions below are called by SUNDIALS only, with vectors made by `create` of equal lengths.
// "In place" means that two arguments are the same vector; SUNDIALS never hands over two that
// overlap in another way.

unsafe extern "C" fn kind(_: N_Vector) -> sys::N_Vector_ID {
    sys::N_Vector_ID_SUNDIALS_NVEC_CUSTOM
}

unsafe extern "C" fn clone(v: N_Vector) -> N_Vector {
    // SAFETY: `v` is ours and alive, hence so is its context.
    unsafe { create((*v).sunctx, values(v).len()) }
}

unsafe extern "C" fn destroy(v: N_Vector) {
    if v.is_null() {
        return;
    }
    // SAFETY: the content was boxed by `create`; SUNDIALS destroys a vector once.
    unsafe {
        drop(Box::from_raw((*v).content.cast::<Vec<f64>>()));
        (*v).content = std::ptr::null_mut();
        sys::N_VFreeEmpty(v);
    }
}

unsafe extern "C" fn space(v: N_Vector, reals: *mut sunindextype, integers: *mut sunindextype) {
    // SAFETY: SUNDIALS passes two places to write to.
    unsafe {
        *reals = length(v);
        *integers = 3;
    }
}

unsafe extern "C" fn array_pointer(v: N_Vector) -> *mut realtype {
    // SAFETY: `v` is ours; the pointer is used while no one else uses the vector.
    unsafe { values_mut(v).as_mut_ptr() }
}

unsafe extern "C" fn length(v: N_Vector) -> sunindextype {
    // SAFETY: `v` is ours. A length always fits, an allocation being at most `isize::MAX` bytes.
    unsafe { values(v).len() as sunindextype }
}

unsafe extern "C" fn linear_sum(a: realtype, x: N_Vector, b: realtype, y: N_Vector, z: N_Vector) {
    // SAFETY: the in-place cases are separated before any slice is made, so the mutable one is the
    // only one of `z`.
    unsafe {
        match (z == x, z == y) {
            (true, true) => kernels::map_in_place(values_mut(z), |z| a * z + b * z),
            (true, false) => kernels::scale_and_add(a, values_mut(z), b, values(y)),
            (false, true) => kernels::scale_and_add(b, values_mut(z), a, values(x)),
            (false, false) => kernels::linear_sum(a, values(x), b, values(y), values_mut(z)),
        }
    }
}

unsafe extern "C" fn fill(c: realtype, z: N_Vector) {
    // SAFETY: the only slice.
    unsafe { values_mut(z).fill(c) }
}

/// # Safety
/// As for all functions of the table.
unsafe fn unary(x: N_Vector, z: N_Vector, f: impl Fn(f64) -> f64) {
    // SAFETY: one mutable slice, and a shared one only of another vector.
    unsafe {
        if x == z {
            kernels::map_in_place(values_mut(z), f)
        } else {
            kernels::map(values(x), values_mut(z), f)
        }
    }
}

/// # Safety
/// As for all functions of the table.
unsafe fn binary(x: N_Vector, y: N_Vector, z: N_Vector, f: impl Fn(f64, f64) -> f64) {
    // SAFETY: one mutable slice, and shared ones only of other vectors.
    unsafe {
        match (z == x, z == y) {
            (true, true) => kernels::map_in_place(values_mut(z), |z| f(z, z)),
            (true, false) => kernels::zip_in_place(values_mut(z), values(y), f),
            (false, true) => kernels::zip_in_place(values_mut(z), values(x), |z, x| f(x, z)),
            (false, false) => kernels::zip(values(x), values(y), values_mut(z), f),
        }
    }
}

unsafe extern "C" fn product(x: N_Vector, y: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { binary(x, y, z, |x, y| x * y) }
}

unsafe extern "C" fn quotient(x: N_Vector, y: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { binary(x, y, z, |x, y| x / y) }
}

unsafe extern "C" fn scale(c: realtype, x: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table; copying needs two different ones.
    unsafe {
        if c.to_bits() == 1.0_f64.to_bits() && x != z {
            values_mut(z).copy_from_slice(values(x));
        } else {
            unary(x, z, |x| c * x);
        }
    }
}

unsafe extern "C" fn absolute(x: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { unary(x, z, f64::abs) }
}

unsafe extern "C" fn inverse(x: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { unary(x, z, f64::recip) }
}

unsafe extern "C" fn add_constant(x: N_Vector, b: realtype, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { unary(x, z, |x| x + b) }
}

unsafe extern "C" fn dot(x: N_Vector, y: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::dot(values(x), values(y)) }
}

unsafe extern "C" fn max_norm(x: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::max_norm(values(x)) }
}

unsafe extern "C" fn weighted_max(x: N_Vector, w: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::weighted_max(values(x), values(w)) }
}

unsafe extern "C" fn weighted_max_masked(x: N_Vector, w: N_Vector, mask: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::weighted_max_masked(values(x), values(w), values(mask)) }
}

unsafe extern "C" fn min(x: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::min(values(x)) }
}

unsafe extern "C" fn weighted_l2(x: N_Vector, w: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { values(x).iter().zip(values(w)).map(|(x, w)| (x * w).powi(2)).sum::<f64>().sqrt() }
}

unsafe extern "C" fn l1_norm(x: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { values(x).iter().map(|x| x.abs()).sum() }
}

unsafe extern "C" fn compare(c: realtype, x: N_Vector, z: N_Vector) {
    // SAFETY: vectors of the table.
    unsafe { unary(x, z, |x| f64::from(u8::from(x.abs() >= c))) }
}

unsafe extern "C" fn inverse_tested(x: N_Vector, z: N_Vector) -> sys_boolean {
    // SAFETY: the shared slice is gone before the mutable one is made. Zero components are left as
    // they are.
    unsafe {
        let all = values(x).iter().all(|x| x.abs() > 0.0);
        unary(x, z, |x| if x.abs() > 0.0 { x.recip() } else { x });
        c_int::from(all)
    }
}

unsafe extern "C" fn constraint_mask(c: N_Vector, x: N_Vector, mask: N_Vector) -> sys_boolean {
    // SAFETY: three different vectors; SUNDIALS writes the mask into its own temporary.
    unsafe { c_int::from(kernels::constraints_hold(values(c), values(x), values_mut(mask))) }
}

unsafe extern "C" fn min_quotient(x: N_Vector, y: N_Vector) -> realtype {
    // SAFETY: only read.
    unsafe { kernels::min_quotient(values(x), values(y)) }
}

/// SUNDIALS' truth value, an `int` in 6 and 7.
#[allow(non_camel_case_types)]
type sys_boolean = c_int;

/// `z = sum c[i] x[i]`; `z` may be one of the `x`. Block by block into a buffer, so that `z` is
/// written only after the same block of every `x` was read.
unsafe extern "C" fn linear_combination(
    n: c_int,
    c: *mut realtype,
    x: *mut N_Vector,
    z: N_Vector,
) -> c_int {
    let n = usize::try_from(n).unwrap_or(0);
    // SAFETY: SUNDIALS passes `n` coefficients and `n` vectors. The shared slice of each block ends
    // before the mutable one begins.
    unsafe {
        let (c, x) = (slice::from_raw_parts(c, n), slice::from_raw_parts(x, n));
        let length = values(z).len();
        for start in (0..length).step_by(BLOCK) {
            let range = start..length.min(start + BLOCK);
            let mut buffer = [0.0; BLOCK];
            let sum = &mut buffer[..range.len()];
            for (&c, &x) in c.iter().zip(x) {
                kernels::scale_and_add(1.0, sum, c, &values(x)[range.clone()]);
            }
            values_mut(z)[range].copy_from_slice(sum);
        }
    }
    0
}

/// `z[i] = a[i] x + y[i]`, usually with `z[i] == y[i]`.
unsafe extern "C" fn scale_add_multi(
    n: c_int,
    a: *mut realtype,
    x: N_Vector,
    y: *mut N_Vector,
    z: *mut N_Vector,
) -> c_int {
    let n = usize::try_from(n).unwrap_or(0);
    // SAFETY: SUNDIALS passes arrays of `n` entries; `linear_sum` sorts out which vectors are the
    // same.
    unsafe {
        let a = slice::from_raw_parts(a, n);
        let (y, z) = (slice::from_raw_parts(y, n), slice::from_raw_parts(z, n));
        for i in 0..n {
            linear_sum(a[i], x, 1.0, y[i], z[i]);
        }
    }
    0
}

unsafe extern "C" fn dot_multi(
    n: c_int,
    x: N_Vector,
    y: *mut N_Vector,
    results: *mut realtype,
) -> c_int {
    let n = usize::try_from(n).unwrap_or(0);
    // SAFETY: SUNDIALS passes arrays of `n` entries, the second one to be written.
    unsafe {
        let (y, results) = (slice::from_raw_parts(y, n), slice::from_raw_parts_mut(results, n));
        for (result, &y) in results.iter_mut().zip(y) {
            *result = kernels::dot(values(x), values(y));
        }
    }
    0
}

#[cfg(test)]
#[path = "vector_tests.rs"]
mod tests;
