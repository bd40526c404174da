//! The table of operations through SUNDIALS' own entry points, in place and not.
#![expect(clippy::float_cmp, reason = "the results are exact")]

use super::*;

/// Longer than 20 blocks, and a prime.
const N: usize = 1301;

fn vector(context: &Context, f: impl Fn(f64) -> f64) -> Vector {
    let mut v = Vector::new(context, N).unwrap();
    v.as_mut_slice().iter_mut().enumerate().for_each(|(i, v)| *v = f(i as f64));
    v
}

fn is(v: &Vector, f: impl Fn(f64) -> f64) -> bool {
    v.as_slice().iter().enumerate().all(|(i, &v)| v == f(i as f64))
}

#[test]
fn sums_and_products_in_place_and_not() {
    let context = Context::new().unwrap();
    let (x, y, z) =
        (vector(&context, |i| i), vector(&context, |i| i + 1.0), vector(&context, |_| 0.0));
    // SAFETY: vectors of this crate, alive, and no slice of them exists.
    unsafe {
        sys::N_VLinearSum(2.0, x.raw(), 3.0, y.raw(), z.raw());
        assert!(is(&z, |i| 2.0 * i + 3.0 * (i + 1.0)));
        sys::N_VLinearSum(2.0, z.raw(), 1.0, x.raw(), z.raw());
        assert!(is(&z, |i| 11.0 * i + 6.0));
        sys::N_VLinearSum(1.0, x.raw(), -1.0, z.raw(), z.raw());
        assert!(is(&z, |i| -10.0 * i - 6.0));
        sys::N_VLinearSum(1.0, z.raw(), 1.0, z.raw(), z.raw());
        assert!(is(&z, |i| -20.0 * i - 12.0));
        sys::N_VAbs(z.raw(), z.raw());
        sys::N_VDiv(z.raw(), y.raw(), z.raw());
        assert!(is(&z, |i| (20.0 * i + 12.0) / (i + 1.0)));
        sys::N_VProd(x.raw(), y.raw(), z.raw());
        sys::N_VProd(y.raw(), z.raw(), z.raw());
        assert!(is(&z, |i| (i + 1.0) * (i * (i + 1.0))));
        sys::N_VConst(4.0, z.raw());
        sys::N_VInv(z.raw(), z.raw());
        sys::N_VAddConst(z.raw(), 1.0, z.raw());
        sys::N_VScale(8.0, z.raw(), z.raw());
        assert!(is(&z, |_| 10.0));
        sys::N_VScale(1.0, x.raw(), z.raw());
        assert!(is(&z, |i| i));
        sys::N_VCompare(1300.0, x.raw(), z.raw());
        assert!(is(&z, |i| if i >= 1300.0 { 1.0 } else { 0.0 }));
    }
}

#[test]
fn fused_operations_with_the_result_among_the_operands() {
    let context = Context::new().unwrap();
    let (x, y, z) =
        (vector(&context, |i| i), vector(&context, |i| 2.0 * i), vector(&context, |_| 1.0));
    let mut c = [10.0, 100.0, 1000.0];
    let mut all = [z.raw(), x.raw(), y.raw()];
    // SAFETY: as above; the arrays have as many entries as stated.
    unsafe {
        assert_eq!(sys::N_VLinearCombination(3, c.as_mut_ptr(), all.as_mut_ptr(), z.raw()), 0);
        assert!(is(&z, |i| 10.0 + 2100.0 * i));
        let mut targets = [y.raw(), z.raw()];
        assert_eq!(
            sys::N_VScaleAddMulti(
                2,
                c.as_mut_ptr(),
                x.raw(),
                targets.as_mut_ptr(),
                targets.as_mut_ptr()
            ),
            0
        );
        assert!(is(&y, |i| 12.0 * i) && is(&z, |i| 10.0 + 2200.0 * i));
    }
}

#[test]
fn norms_clones_and_lengths() {
    let context = Context::new().unwrap();
    let (x, w) = (vector(&context, |i| i - 1000.0), vector(&context, |_| 0.5));
    // SAFETY: as above; the clone is destroyed once.
    unsafe {
        assert_eq!(sys::N_VWrmsNorm(x.raw(), w.raw()), 500.0);
        assert_eq!(sys::N_VWrmsNormMask(x.raw(), w.raw(), x.raw()), 150.0);
        assert_eq!(sys::N_VMaxNorm(x.raw()), 1000.0);
        assert_eq!(sys::N_VMin(x.raw()), -1000.0);
        assert_eq!(sys::N_VGetLength(x.raw()), N as i64);
        let copy = sys::N_VClone(x.raw());
        assert_eq!(values(copy), vec![0.0; N]);
        assert_eq!(sys::N_VInvTest(x.raw(), copy), 0);
        assert_eq!(values(copy)[0], -1e-3);
        sys::N_VDestroy(copy);
    }
}
