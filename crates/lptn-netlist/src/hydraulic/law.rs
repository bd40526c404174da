//! The laws of branches as expressions.
//!
//! Every flow is an explicit, rising and continuous function of the pressure difference, made of
//! `min` and `max` instead of comparisons, so that nothing switches.

use lptn_units::Type;

use crate::written_out::WrittenOut;

/// f Re^2 at a Reynolds number of 2300, up to which a flow is laminar: 64 x 2300.
const LAMINAR: &str = "147200";

/// sqrt(f) Re from which a flow is turbulent: a Reynolds number of 4000 in a smooth pipe.
const TURBULENT: &str = "800";

/// The square root of a pressure difference with its sign, over that of `dp_small`: a root beyond
/// `dp_small`, and below it the cubic with the same value and slope there.
///
/// With x = dp/dp_small and c = x within -1 and 1: 1.25 c - 0.25 c^3 + c (sqrt(max(|x|, 1)) - 1).
fn root(out: &mut WrittenOut<'_>, difference: &str) {
    let h = out.here;
    out.value("relative", Type::SCALAR, format!("{difference} / {h}.dp_small"));
    out.value("clipped", Type::SCALAR, format!("min(max({h}.relative, -1), 1)"));
    let beyond = format!("sqrt(max(abs({h}.relative), 1)) - 1");
    let root = format!("1.25 * {h}.clipped - 0.25 * {h}.clipped^3 + {h}.clipped * ({beyond})");
    out.value("root", Type::SCALAR, root);
}

/// Mass flow of a loss coefficient, an orifice or a valve.
///
/// * zeta: dp = zeta rho/2 (V/area)^2 (I. E. Idelchik, Handbook of Hydraulic Resistance, 3rd
///   edition, 1994, section 1)
/// * C_d: V = C_d area sqrt(2 dp/rho)
/// * K_v: V = K_v sqrt(dp/1 bar 1000 kg/m^3/rho) (IEC 60534-2-1)
pub(super) fn quadratic(out: &mut WrittenOut<'_>, selector: &str) -> String {
    let h = out.here;
    root(out, &format!("{h}.dp"));
    let speed = format!("2 * {h}.density * {h}.dp_small");
    let scale = match selector {
        "zeta" => format!("{h}.area * sqrt({speed} / {h}.zeta)"),
        "C_d" => format!("{h}.C_d * {h}.area * sqrt({speed})"),
        _ => format!("{h}.K_v * sqrt(1000 [kg/m^3] * {h}.density * {h}.dp_small / 1e5 [Pa])"),
    };
    format!("{scale} * {h}.root")
}

/// Mass flow of a round pipe with a fully developed flow.
///
/// The friction factor f of Darcy enters as f Re^2 = 2 rho d^3 dp/(length mu^2), which is known:
///
/// * laminar, to Re = 2300: f = 64/Re, so that Re = f Re^2/64 (Hagen and Poiseuille)
/// * turbulent, from sqrt(f) Re = 800 on: Re = -2 K lg(roughness/(3.7 d) + 2.51/K) with K =
///   sqrt(f) Re (C. F. Colebrook, J. Inst. Civ. Eng. 11 (1939) 133, which needs no iteration here)
/// * between them: a straight line over K
pub(super) fn pipe(out: &mut WrittenOut<'_>) -> String {
    let h = out.here;
    let known =
        format!("2 * {h}.density * {h}.diameter^3 * {h}.dp / ({h}.length * {h}.viscosity^2)");
    out.value("f_Re_squared", Type::SCALAR, known);
    let part = format!("min(max({h}.f_Re_squared, -{LAMINAR}), {LAMINAR})");
    out.value("laminar_part", Type::SCALAR, part);
    let k = format!("sqrt(max(abs({h}.f_Re_squared), {LAMINAR}))");
    out.value("sqrt_f_Re", Type::SCALAR, k);
    let turbulent = |k: &str| {
        format!("(-2 * {k} * ln({h}.roughness / (3.7 * {h}.diameter) + 2.51 / {k}) / ln(10))")
    };
    let (start, begun) = (format!("sqrt({LAMINAR})"), turbulent(TURBULENT));
    let slope = format!("({begun} - 2300) / ({TURBULENT} - {start})");
    let between = format!("{slope} * (min({h}.sqrt_f_Re, {TURBULENT}) - {start})");
    let beyond = turbulent(&format!("max({h}.sqrt_f_Re, {TURBULENT})"));
    let reynolds =
        format!("{h}.laminar_part * (1 / 64 + ({between} + {beyond} - {begun}) / {LAMINAR})");
    out.value("Re", Type::SCALAR, reynolds);
    format!("{h}.Re * pi * {h}.diameter * {h}.viscosity / 4")
}

/// Volume flow of a pump `p_0 - a V - b V^2` at a speed; `None` if it has neither `a` nor `b`.
///
/// The affinity laws make it p_0 s^2 - a s V - b V^2 at the speed ratio s. With the excess of the
/// pressure at rest e, V = 2 e/(a s + sqrt(a^2 s^2 + 4 b |e|)), which is as exact for a small b.
pub(super) fn parabola(out: &mut WrittenOut<'_>, given: [bool; 2]) -> Option<String> {
    let h = out.here;
    // the root refuses a speed below 0
    let excess = format!("{h}.p_0 * sqrt({h}.speed)^4 + {h}.dp");
    out.value("excess", super::PRESSURE, excess);
    Some(match given {
        [false, false] => return None,
        [true, false] => format!("{h}.excess / ({h}.a * {h}.speed)"),
        [false, true] => {
            root(out, &format!("{h}.excess"));
            format!("sqrt({h}.dp_small / {h}.b) * {h}.root")
        }
        [true, true] => {
            let size = format!("max(abs({h}.excess), {h}.dp_small)");
            let root = format!("sqrt({h}.a^2 * {h}.speed^2 + 4 * {h}.b * {size})");
            format!("2 * {h}.excess / ({h}.a * {h}.speed + {root})")
        }
    })
}
