//! Two forms of the thermal impedance at a port, Foster chain and Cauer ladder, and the way from
//! one to the other.
//!
//! [`Foster`] is the sum of exponentials that data sheets print (R-tau table), [`Cauer`] the chain
//! of capacities and resistances with the same impedance. A Cauer ladder may be joined to further
//! parts; a Foster chain has no inner nodes and may not. Both describe
//!
//! ```text
//! Z(s) = direct + sum over k of R_k / (1 + s tau_k)                     Foster
//! Z(s) = direct + 1/(s C_1 + 1/(R_1 + 1/(s C_2 + 1/(R_2 + ...))))       Cauer
//! ```
//!
//! # Foster to Cauer, without a subtraction
//!
//! Rates `x_k = 1/tau_k` and weights `w_k = R_k/tau_k` are a measure whose Stieltjes transform is
//! `Z(s) = sum of w_k/(s + x_k) = W (e1, (s + T)^-1 e1)`, `W` the sum of the weights and `T` its
//! Jacobi matrix. For a ladder, `T = C^-1/2 G C^-1/2` with
//!
//! ```text
//! T_ii = q_i + e_(i-1)     q_i = g_i/C_i         g_i = 1/R_i
//! T_i,i+1^2 = q_i e_i      e_i = g_i/C_(i+1)     e_0 = 0
//! ```
//!
//! so `q` and `e` are the quotients and differences of H. Rutishauser (`T` is similar to a product
//! `L R` of bidiagonal matrices), and the ladder follows from them by quotients alone:
//! `C_1 = 1/W`, `g_i = q_i C_i`, `C_(i+1) = g_i/e_i`. They are built by adding the poles from the
//! fastest to the slowest, with the origin always at the last:
//!
//! 1. *The origin moves* from the last pole to the next, by `d = (tau' - tau)/(tau' tau) > 0`:
//!    `q'_i = q_i + d_i`, `e'_i = q_i e_i/q'_i`, `d_(i+1) = d_i e_i/q'_i + d`, `d_1 = d`. This is
//!    the stationary transform; it follows from `q'_i e'_i = q_i e_i` and
//!    `q'_i + e'_(i-1) = q_i + e_(i-1) + d`.
//! 2. *A pole of weight `w` comes to the origin.* The measure times `x` does not see it, and that
//!    measure has the matrix with the factors exchanged, `R L`. So `q_i + e_i` and `q_(i+1) e_i` do
//!    not change while the mean `q_1` falls to `q'_1 = q_1 W/(W + w)`. With `f_1 = q_1 w/(W + w)`:
//!    `e'_i = e_i + f_i`, `q'_(i+1) = q_(i+1) e_i/e'_i`, `f_(i+1) = q_(i+1) f_i/e'_i`; the new last
//!    one is `q'_(m+1) = 0`.
//!
//! At the end the origin moves to zero by the rate of the slowest. Every number is a sum, product
//! or quotient of positive ones and no difference is taken but that of two time constants as they
//! are given, so each element of the ladder has a relative error of at most a small multiple of
//! rounding for each pole, however close they are or however far they spread.
//!
//! # Cauer to Foster
//!
//! `q` and `e` are quotients. The rates are the eigenvalues of `T`, found by the progressive
//! transform with shifts below the least (dqds), which finds each of them to a relative error of
//! rounding times the number of rungs. The weights are the squared first entries of the
//! eigenvectors, from the factorisation of `T - x` from both ends that meet where the entry is
//! largest (twisted factorisation). Peeling the poles off by the inverse of the two steps above has
//! no subtractions but the shift, and is still useless: if the slowest mode is weak at the far end,
//! `q_m` depends on its rate by more digits than there are (errors of 10^3 percent at 100 close
//! poles were measured).
//!
//! # Measured
//!
//! Largest relative error of an element, against mpmath with 2200 digits (`tools/ladder.py`), and
//! of a term after
//! Foster to Cauer to Foster:
//!
//! | poles | Cauer | by rotations (RKPW) | there and back |
//! |---|---|---|---|
//! | 200 over 8 decades | 3e-14 | 5e-13 | 4e-14 |
//! | 200 over 16 decades | 2e-14 | 2e-12 | 3e-14 |
//! | 100 of `1 + 0.01 k` s | 1e-14 | 3e-14 | 3e-14 |
//! | 100 with ratio 1.02 | 9e-15 | 2e-14 | 2e-14 |
//!
//! 200 poles take 0.3 ms there and 3 ms back. The rotations of Rutishauser, Kahan, Pal and Walker
//! have the fastest pole first there; the other way round they lose every digit over 16 decades.
//!
//! Long division, the obvious way, loses every digit at 30 close poles.
//!
//! # Sources
//!
//! H. Rutishauser, Der Quotienten-Differenzen-Algorithmus, ZAMP 5 (1954) 233. K. V. Fernando and
//! B. N. Parlett, Accurate singular values and differential qd algorithms, Numer. Math. 67 (1994)
//! 191. I. S. Dhillon and B. N. Parlett, Multiple representations to compute orthogonal
//! eigenvectors of symmetric tridiagonal matrices, Linear Algebra Appl. 387 (2004) 1. D. P. Laurie,
//! Accurate recovery of recursion coefficients from Gaussian quadrature formulas, J. Comput. Appl.
//! Math. 112 (1999) 165. W. B. Gragg and W. J. Harwood, The numerically stable reconstruction of
//! Jacobi matrices from spectral data, Numer. Math. 44 (1984) 317 (the rotations).

mod cauer;
mod convert;
mod error;
mod foster;
mod quotients;
mod rates;
mod shares;

pub use cauer::Cauer;
pub use error::LadderError;
pub use foster::Foster;
