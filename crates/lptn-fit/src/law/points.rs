//! Measured points.

use lptn_units::{Dimension, Type};

use super::error::LawError;

/// A quantity that was measured in addition to the power, and that a written law may use.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// The name by which laws use it.
    pub name: String,
    /// Its dimension, and whether it is an absolute temperature.
    pub ty: Type,
    /// One value a point, in SI units.
    pub values: Vec<f64>,
}

/// Power over speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// The speed first, then other quantities that laws may use.
    variables: Vec<Variable>,
    power: Vec<f64>,
    deviation: Option<Vec<f64>>,
    /// The highest speed in rad/s, at which a law with a free exponent has its coefficient; it
    /// stays if a point is left out.
    top: f64,
}

impl Points {
    /// Points from speeds in rad/s (above 0), powers in W, and the standard error of each power in
    /// W (above 0) if they are known.
    ///
    /// # Errors
    /// [`LawError`] if there are no points, lists of different length, or a number out of range.
    pub fn new(
        speed: Vec<f64>,
        power: Vec<f64>,
        deviation: Option<Vec<f64>>,
    ) -> Result<Self, LawError> {
        let lengths = [power.len(), deviation.as_ref().map_or(power.len(), Vec::len)];
        if let Some(&other) = lengths.iter().find(|length| **length != speed.len()) {
            return Err(LawError::Lengths { speeds: speed.len(), others: other });
        }
        if speed.is_empty() {
            return Err(LawError::NoPoints);
        }
        let wrong = |list: &[f64], right: fn(f64) -> bool| list.iter().position(|&x| !right(x));
        if let Some(point) = wrong(&speed, |x| x.is_finite() && x > 0.0) {
            return Err(LawError::Speed { point, value: speed[point] });
        }
        if let Some(point) = wrong(&power, f64::is_finite) {
            return Err(LawError::Power { point });
        }
        let sigma = deviation.as_deref().unwrap_or_default();
        if let Some(point) = wrong(sigma, |x| x.is_finite() && x > 0.0) {
            return Err(LawError::Deviation { point, value: sigma[point] });
        }
        let top = speed.iter().copied().fold(0.0, f64::max);
        let ty = Type::of(Dimension::ANGULAR_VELOCITY);
        let variables = vec![Variable { name: "omega".into(), ty, values: speed }];
        Ok(Self { variables, power, deviation, top })
    }

    /// The same points with another name for the speed, and more quantities that laws may use.
    ///
    /// # Errors
    /// [`LawError::Lengths`] if one does not have a value for every point.
    pub fn with_variables(mut self, speed: &str, others: Vec<Variable>) -> Result<Self, LawError> {
        if let Some(other) = others.iter().find(|variable| variable.values.len() != self.len()) {
            return Err(LawError::Lengths { speeds: self.len(), others: other.values.len() });
        }
        speed.clone_into(&mut self.variables[0].name);
        self.variables.extend(others);
        Ok(self)
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.power.len()
    }

    /// False: there is at least one point.
    pub fn is_empty(&self) -> bool {
        self.power.is_empty()
    }

    /// The variables that laws may use, the speed first.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// The speeds in rad/s.
    pub fn speed(&self) -> &[f64] {
        &self.variables[0].values
    }

    /// The powers in W.
    pub fn power(&self) -> &[f64] {
        &self.power
    }

    /// The standard errors of the powers in W.
    pub fn deviation(&self) -> Option<&[f64]> {
        self.deviation.as_deref()
    }

    /// Divisor of a residual in W: its standard error, or 1.
    pub(crate) fn scale(&self, point: usize) -> f64 {
        self.deviation.as_ref().map_or(1.0, |sigma| sigma[point])
    }

    /// Number of speeds that differ by more than rounding.
    pub fn distinct_speeds(&self) -> usize {
        let mut speeds = self.speed().to_vec();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|b, a| *b - *a <= 1e-9 * *b);
        speeds.len()
    }

    /// The highest speed in rad/s.
    pub fn largest_speed(&self) -> f64 {
        self.top
    }

    pub(crate) fn largest_power(&self) -> f64 {
        self.power.iter().fold(0.0, |most: f64, p| most.max(p.abs()))
    }

    /// The same points with other powers.
    pub(crate) fn with_power(&self, power: Vec<f64>) -> Self {
        Self { power, ..self.clone() }
    }

    /// Points at other speeds in rad/s, at which nothing else is known.
    pub(crate) fn at_speeds(&self, speeds: &[f64]) -> Self {
        let speed = Variable { values: speeds.to_vec(), ..self.variables[0].clone() };
        let (variables, power) = (vec![speed], vec![f64::NAN; speeds.len()]);
        Self { variables, power, deviation: None, top: self.top }
    }

    /// All points but one.
    pub(crate) fn without(&self, point: usize) -> Self {
        let left = |list: &[f64]| {
            let mut list = list.to_vec();
            list.remove(point);
            list
        };
        let variable = |v: &Variable| Variable { values: left(&v.values), ..v.clone() };
        Self {
            variables: self.variables.iter().map(variable).collect(),
            power: left(&self.power),
            deviation: self.deviation.as_deref().map(left),
            top: self.top,
        }
    }
}
