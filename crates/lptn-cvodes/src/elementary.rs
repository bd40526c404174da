//! Elementary functions that give the same digits on every processor.
//!
//! The C library chooses its `exp` and `pow` by the processor, with or without fused
//! multiplication, and they differ in the last digit; so would results, and shards of a study from
//! a mixed cluster would not merge. These definitions take the place of those of the C library in
//! the whole program, in Rust and in SUNDIALS alike; each is that of the crate `libm`, a port of
//! musl's, with an error below one unit in the last place.
//!
//! It is a feature (`portable`) because a program decides for itself, not a library for the
//! programs that use it.
//!
//! # Safety
//! A linker takes the definition of a program before that of a library, so the C library's are not
//! looked at. The signatures are those of C11 (7.12) and, for `sincos`, of the GNU C library.

/// One function after the other, with its arguments.
macro_rules! elementary {
    ($($name:ident($($x:ident),+);)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name($($x: f64),+) -> f64 {
            libm::$name($($x),+)
        }
    )*};
}

elementary! {
    exp(x);
    exp2(x);
    expm1(x);
    log(x);
    log2(x);
    log10(x);
    log1p(x);
    pow(x, y);
    sin(x);
    cos(x);
    tan(x);
    asin(x);
    acos(x);
    atan(x);
    atan2(y, x);
    sinh(x);
    cosh(x);
    tanh(x);
    cbrt(x);
    hypot(x, y);
}

/// Both at once: compilers call it where a program asks for both.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincos(x: f64, sine: *mut f64, cosine: *mut f64) {
    let (s, c) = libm::sincos(x);
    // SAFETY: the caller gives two places for a number each, as the GNU C library asks for.
    unsafe {
        sine.write(s);
        cosine.write(c);
    }
}
