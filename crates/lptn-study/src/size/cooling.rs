//! The cooling that is needed, from a power and two temperatures alone.

/// Heat, the temperature that must not be exceeded, and the temperature of the surroundings.
/// Temperatures in K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoolingTask {
    /// Heat to be taken away in W.
    pub power: f64,
    /// Highest temperature allowed.
    pub limit: f64,
    /// Temperature of the surroundings, and of a coolant where it enters.
    pub ambient: f64,
    /// Largest temperature rise of a coolant from inlet to outlet.
    pub rise: f64,
}

/// A coolant's properties where they are needed: specific heat in J/(kg K), density in kg/m^3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coolant {
    /// Specific heat at constant pressure.
    pub specific_heat: f64,
    /// Density where it enters, as fans and pumps are rated.
    pub density: f64,
}

/// A flow of coolant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoolantFlow {
    /// Mass flow in kg/s.
    pub mass: f64,
    /// Volume flow in m^3/s where the coolant enters.
    pub volume: f64,
}

/// The cooling that is needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cooling {
    /// `limit - ambient` in K, the temperature difference that is available. If it is not positive,
    /// no cooling without refrigeration keeps the limit.
    pub available: f64,
    /// Largest thermal resistance to the surroundings in K/W.
    pub resistance: f64,
}

lptn_units::errors! {
/// Why the question has no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoolingError {
    /// The power in W is not positive and finite.
    Power(power: f64) = "size::power", format!("the power has to be more than 0 W, got {power} W"),
        help "write for example --power \"223 W\"";
    /// The rise in K is not positive and finite.
    Rise(rise: f64) = "size::rise",
        format!("the rise of the coolant has to be more than 0 K, got {rise} K"),
        help "write for example --rise \"10 K\"";
}
}

impl CoolingTask {
    /// The resistance that carries `power` with `limit - ambient` across it:
    /// `R_max = (limit - ambient) / P`, the definition of a thermal resistance (F. P. Incropera et
    /// al., Fundamentals of Heat and Mass Transfer). Its inverse is the product of film coefficient
    /// and area.
    ///
    /// # Errors
    /// [`CoolingError`] for a power or rise that is not positive.
    pub fn cooling(&self) -> Result<Cooling, CoolingError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if !positive(self.power) {
            return Err(CoolingError::Power(self.power));
        }
        if !positive(self.rise) {
            return Err(CoolingError::Rise(self.rise));
        }
        let available = self.limit - self.ambient;
        Ok(Cooling { available, resistance: available / self.power })
    }

    /// The flow that takes the heat away while it warms by `rise`: `P = m cp rise`, the energy
    /// equation of a steady flow without work (Incropera et al.). `None` if the coolant would have
    /// to leave warmer than the limit.
    pub fn flow(&self, coolant: Coolant) -> Option<CoolantFlow> {
        if self.rise > self.limit - self.ambient {
            return None;
        }
        let mass = self.power / (coolant.specific_heat * self.rise);
        Some(CoolantFlow { mass, volume: mass / coolant.density })
    }
}
