//! Melting and solidification of a lump of uniform temperature, by the enthalpy method.
//!
//! Source: V. R. Voller, C. R. Swaminathan, B. G. Thomas, Fixed grid techniques for phase change problems: a review,
//! International Journal for Numerical Methods in Engineering 30 (1990) 875-898: one enthalpy function of
//! temperature, a melt that is linear between solidus and liquidus, capacities mixed by the melted fraction.

use lptn_units::Scalar;

/// Melted fraction as a function of temperature: 0 to the solidus, 1 from the liquidus, linear between.
///
/// * `t`, `solidus`, `liquidus`: temperatures in K, solidus <= liquidus
///
/// Where both are equal (a pure substance) temperature does not tell the fraction: it is 0 up to and at the
/// melting point and 1 above; [`Melting::melted`] tells it from enthalpy. Derivatives are those of the side
/// taken, 0 at solidus and liquidus.
///
/// Source: Voller, Swaminathan, Thomas (1990), linear melt.
pub fn melt_fraction<S: Scalar>(t: S, solidus: S, liquidus: S) -> S {
    if t.value() <= solidus.value() {
        S::from_f64(0.0)
    } else if t.value() >= liquidus.value() {
        S::from_f64(1.0)
    } else {
        (t - solidus) / (liquidus - solidus)
    }
}

/// A lump that melts: capacities in J/K and latent heat in J of the whole lump, or all of them per kg.
///
/// Enthalpy is 0 where the lump is solid at the solidus. With the melted fraction f, its range D = liquidus -
/// solidus and the mixed capacity (1 - f) C_solid + f C_liquid:
///
/// ```text
/// solid    H = C_solid (T - solidus)                                T <= solidus
/// mushy    H = L f + D (C_solid f + (C_liquid - C_solid) f^2 / 2)   T = solidus + D f
/// liquid   H = L + D (C_solid + C_liquid) / 2 + C_liquid (T - liquidus)
/// ```
///
/// T(H) is continuous and never falls, so a node with latent heat is integrated in H. D = 0, melting at one
/// temperature, needs no other formula.
///
/// Source: Voller, Swaminathan, Thomas (1990).
///
/// ```
/// use lptn_laws::Melting;
///
/// let ice = Melting { c_solid: 2100.0, c_liquid: 4200.0, latent_heat: 336e3, solidus: 273.15, liquidus: 273.15 };
/// assert_eq!(ice.temperature(-2100.0), 272.15);
/// assert_eq!((ice.temperature(168e3), ice.melted(168e3)), (273.15, 0.5));
/// assert_eq!(ice.temperature_slope(168e3), 0.0);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Melting<S> {
    /// Capacity of the solid in J/K, or specific heat in J/(kg K), above 0.
    pub c_solid: S,
    /// Capacity of the liquid in J/K, or specific heat in J/(kg K), above 0.
    pub c_liquid: S,
    /// Latent heat in J, or J/kg, at least 0.
    pub latent_heat: S,
    /// Temperature in K at which melting begins.
    pub solidus: S,
    /// Temperature in K at which all is molten, at least `solidus`.
    pub liquidus: S,
}

impl<S: Scalar> Melting<S> {
    /// Enthalpy H in J (or J/kg) at the temperature `t` in K; solid where `t` is the one melting point.
    pub fn enthalpy(&self, t: S) -> S {
        if t.value() <= self.solidus.value() {
            return self.c_solid * (t - self.solidus);
        }
        if t.value() >= self.liquidus.value() {
            return self.heat_of_melting() + self.c_liquid * (t - self.liquidus);
        }
        let fraction = melt_fraction(t, self.solidus, self.liquidus);
        fraction * (self.start() + self.bend() * fraction)
    }

    /// Temperature in K at the enthalpy `h` in J (or J/kg).
    pub fn temperature(&self, h: S) -> S {
        if h.value() < 0.0 {
            return self.solidus + h / self.c_solid;
        }
        let above = h - self.heat_of_melting();
        if above.value() >= 0.0 {
            return self.liquidus + above / self.c_liquid;
        }
        self.solidus + (self.liquidus - self.solidus) * self.fraction(h)
    }

    /// Slope dT/dH in K/J (or K kg/J) at the enthalpy `h`: the reciprocal of the capacity, 0 while a pure
    /// substance melts. Where two slopes meet it is the one above.
    pub fn temperature_slope(&self, h: S) -> S {
        let one = S::from_f64(1.0);
        if h.value() < 0.0 {
            one / self.c_solid
        } else if h.value() >= self.heat_of_melting().value() {
            one / self.c_liquid
        } else {
            (self.liquidus - self.solidus) / self.root(h)
        }
    }

    /// Melted fraction, 0 to 1, at the enthalpy `h` in J (or J/kg).
    pub fn melted(&self, h: S) -> S {
        if h.value() < 0.0 {
            S::from_f64(0.0)
        } else if h.value() >= self.heat_of_melting().value() {
            S::from_f64(1.0)
        } else {
            self.fraction(h)
        }
    }

    /// Heat from the first melt at the solidus to the last at the liquidus: L + D (C_solid + C_liquid) / 2.
    pub fn heat_of_melting(&self) -> S {
        self.start() + self.bend()
    }

    /// dH/df at f = 0.
    fn start(&self) -> S {
        self.latent_heat + (self.liquidus - self.solidus) * self.c_solid
    }

    /// Half of d2H/df2.
    fn bend(&self) -> S {
        S::from_f64(0.5) * (self.liquidus - self.solidus) * (self.c_liquid - self.c_solid)
    }

    /// dH/df at an enthalpy between solidus and liquidus.
    fn root(&self, h: S) -> S {
        let start = self.start();
        (start * start + S::from_f64(4.0) * self.bend() * h).sqrt()
    }

    /// The root of H(f) = h between solidus and liquidus, in the form that does not cancel and takes a bend of 0.
    fn fraction(&self, h: S) -> S {
        S::from_f64(2.0) * h / (self.start() + self.root(h))
    }
}
