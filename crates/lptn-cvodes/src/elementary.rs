//! Elementary functions that give the same digits on every processor.
//!
//! The C library chooses its `exp` and `pow` by the processor, with or without fused
//! multiplication, and they differ in the last digit; results would differ too, and shards of a
//! study from a mixed cluster would not merge. These definitions take the place of those of the C
//! library in the whole program, in Rust and in SUNDIALS alike. Those of the crate `pxfm` are
//! correctly rounded (after CORE-MATH: A. Sibidanov, P. Zimmermann, S. Glondu, ARITH 2022), so
//! there is one answer; those of `libm`, after FreeBSD's, have an error below one unit in the last
//! place and are the same arithmetic everywhere.
//!
//! It is a feature (`portable`) because the program decides, not a library that it uses.
//!
//! # Safety
//! A linker takes the definition of a program before that of a library, so those of the C library
//! are not used. The signatures are those of C11 (7.12) and, for `sincos`, of the GNU C library.

/// A power. The correctly rounded one takes three times as long as that of `libm`, which is the
/// same on every processor. A quarter power, as in natural convection, is two square roots. Each is
/// correctly rounded and the second halves the error of the first: 3/4 of a unit in the last place
/// in all.
#[expect(clippy::float_cmp, reason = "a quarter is this number and no other")]
fn power(x: f64, y: f64) -> f64 {
    if y == 0.25 && x > 0.0 { x.sqrt().sqrt() } else { libm::pow(x, y) }
}

/// One function after the other, with its arguments and where it comes from.
macro_rules! elementary {
    ($($name:ident($($x:ident),+) = $from:path;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name($($x: f64),+) -> f64 {
            $from($($x),+)
        }
    )*};
}

elementary! {
    exp(x) = pxfm::f_exp;
    exp2(x) = pxfm::f_exp2;
    expm1(x) = pxfm::f_expm1;
    log(x) = pxfm::f_log;
    log2(x) = pxfm::f_log2;
    log10(x) = pxfm::f_log10;
    log1p(x) = pxfm::f_log1p;
    sin(x) = pxfm::f_sin;
    cos(x) = pxfm::f_cos;
    tan(x) = pxfm::f_tan;
    asin(x) = pxfm::f_asin;
    acos(x) = pxfm::f_acos;
    atan(x) = pxfm::f_atan;
    atan2(y, x) = pxfm::f_atan2;
    sinh(x) = pxfm::f_sinh;
    cosh(x) = pxfm::f_cosh;
    tanh(x) = pxfm::f_tanh;
    cbrt(x) = pxfm::f_cbrt;
    pow(x, y) = power;
    hypot(x, y) = libm::hypot;
}

/// Both at once: compilers call it if a program needs both.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincos(x: f64, sine: *mut f64, cosine: *mut f64) {
    let (s, c) = pxfm::f_sincos(x);
    // SAFETY: the caller gives two places for a number each, as the GNU C library asks for.
    unsafe {
        sine.write(s);
        cosine.write(c);
    }
}

#[cfg(test)]
mod tests {
    use super::power;

    /// Fourth powers of whole numbers are exact below 2^53, and so are their quarter powers.
    #[test]
    fn quarter_powers_of_fourth_powers_are_exact() {
        for whole in 1..=9000_u32 {
            let x = f64::from(whole);
            assert_eq!(power(x * x * x * x, 0.25).to_bits(), x.to_bits(), "{whole}");
        }
    }

    /// Its fourth power is the number again, to four roundings of the root and three of the
    /// products; and the ends are those of C11 (F.10.4.4).
    #[test]
    fn quarter_powers_keep_their_bound_and_their_ends() {
        for k in -300..=300 {
            let x = 1.37 * 10.0_f64.powi(k);
            let root = power(x, 0.25);
            let back = (root * root) * (root * root);
            assert!((back / x - 1.0).abs() < 7.0 * f64::EPSILON, "{x}");
        }
        assert_eq!(power(f64::INFINITY, 0.25).to_bits(), f64::INFINITY.to_bits());
        assert_eq!(power(0.0, 0.25).to_bits(), 0.0_f64.to_bits());
        assert_eq!(power(-0.0, 0.25).to_bits(), 0.0_f64.to_bits());
        assert!(power(-1.0, 0.25).is_nan() && power(f64::NAN, 0.25).is_nan());
    }
}
