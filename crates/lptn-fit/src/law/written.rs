//! Laws that a user writes.

use lptn_units::{Dimension, Dual, EvalError, Expression, Program, Quantity, Scope, Symbol, Type};

use super::error::{LawError, MOST};
use super::points::{Points, Variable};

/// A name with the value at which a search begins.
pub type Start = (String, Quantity);

/// A law as a user wrote it: `a * omega + b * omega^3`. Names that are not variables are its
/// coefficients.
#[derive(Clone, Debug)]
pub struct WrittenLaw {
    text: String,
    program: Program,
    coefficients: Vec<(String, Dimension)>,
    start: Vec<f64>,
    /// Number of variables; the slots of the coefficients follow theirs.
    variables: usize,
    /// True if a start value was given for each coefficient.
    given: bool,
}

/// The variables, then names whose dimension is known.
struct Names<'a> {
    variables: &'a [Variable],
    coefficients: &'a [(String, Dimension)],
}

impl Scope for Names<'_> {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let variables = self.variables.iter().map(|v| (v.name.as_str(), v.ty));
        let coefficients =
            self.coefficients.iter().map(|(name, of)| (name.as_str(), Type::of(*of)));
        let found =
            variables.chain(coefficients).enumerate().find(|(_, (known, _))| *known == name);
        let (slot, (_, ty)) = found?;
        Some(Symbol { slot: u32::try_from(slot).ok()?, ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        let variables = self.variables.iter().map(|v| v.name.clone());
        variables.chain(self.coefficients.iter().map(|(name, _)| name.clone())).collect()
    }
}

impl WrittenLaw {
    /// Reads a law of power over the variables of `points`. The units of the coefficients follow
    /// from the law. `starts` gives those that it leaves open, and the start of a search.
    ///
    /// # Errors
    /// [`LawError`] if the text is not an expression, its units do not give a power, or a unit
    /// stays open.
    pub fn new(text: &str, points: &Points, starts: &[Start]) -> Result<Self, LawError> {
        let refused = |errors| LawError::Units { law: text.to_owned(), errors };
        let expression = Expression::parse(text).map_err(|error| refused(error.into()))?;
        let variables = points.variables();
        let coefficients = coefficients(&expression, variables, starts)?;
        if coefficients.is_empty() {
            return Err(LawError::NoCoefficient { law: text.to_owned() });
        }
        if coefficients.len() > MOST {
            return Err(LawError::ManyCoefficients {
                law: text.to_owned(),
                count: coefficients.len(),
            });
        }
        let scope = Names { variables, coefficients: &coefficients };
        let program =
            expression.compile(&scope, Some(Type::of(Dimension::POWER))).map_err(refused)?;
        let given = |name: &str| {
            starts.iter().find(|(known, _)| known == name).map(|(_, start)| start.value)
        };
        let all_given = coefficients.iter().all(|(name, _)| given(name).is_some());
        let start = |(name, of): &(String, Dimension)| {
            given(name).unwrap_or_else(|| usual_size(*of, points))
        };
        let start = coefficients.iter().map(start).collect();
        let variables = variables.len();
        Ok(Self {
            text: text.to_owned(),
            program,
            coefficients,
            start,
            variables,
            given: all_given,
        })
    }

    /// The law as the user wrote it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Names and dimensions of the coefficients, in order of appearance.
    pub fn coefficients(&self) -> &[(String, Dimension)] {
        &self.coefficients
    }

    /// Start values of searches in SI units: the values given, or several sizes.
    pub(crate) fn starts(&self) -> Vec<Vec<f64>> {
        let factors: &[f64] = if self.given { &[1.0] } else { &[1.0, 0.1, 10.0] };
        factors
            .iter()
            .map(|factor| self.start.iter().map(|start| start * factor).collect())
            .collect()
    }

    pub(crate) fn evaluate(
        &self,
        p: &[f64],
        variables: &[Variable],
        point: usize,
    ) -> Result<(f64, Vec<f64>), EvalError> {
        let variables =
            variables.iter().take(self.variables).map(|v| Dual::<MOST>::constant(v.values[point]));
        let coefficients = p.iter().enumerate().map(|(i, &value)| Dual::variable(value, i));
        let slots: Vec<Dual<MOST>> = variables.chain(coefficients).collect();
        let result = self.program.eval(&slots, &mut Vec::new())?;
        Ok((result.value, result.derivatives.get(..p.len()).unwrap_or_default().to_vec()))
    }
}

/// The names that are not variables, with their dimensions.
fn coefficients(
    expression: &Expression,
    variables: &[Variable],
    starts: &[Start],
) -> Result<Vec<(String, Dimension)>, LawError> {
    let given: Vec<(String, Dimension)> =
        starts.iter().map(|(name, start)| (name.clone(), start.ty.dimension)).collect();
    let power = Type::of(Dimension::POWER);
    let open = expression.unknown_names(&Names { variables, coefficients: &given }, power);
    let mut found: Vec<(String, Dimension)> = Vec::new();
    for (name, _) in expression.names() {
        let known = found.iter().any(|(other, _)| *other == name)
            || variables.iter().any(|v| v.name == name);
        if known {
            continue;
        }
        let own = given.iter().chain(&found).find(|(other, _)| *other == name).map(|(_, of)| *of);
        let inferred = || open.iter().find(|(other, _)| *other == name).and_then(|(_, of)| *of);
        match own.or_else(inferred) {
            Some(dimension) => found.push((name, dimension)),
            None => return Err(LawError::OpenUnit { law: expression.text().to_owned(), name }),
        }
    }
    Ok(found)
}

/// The size that a coefficient of this dimension would have if it were all of the power, from the
/// largest power and the largest speed. It is 1 in SI units if the dimension has other parts.
fn usual_size(of: Dimension, points: &Points) -> f64 {
    let [_, mass, .., angle] = of.exponents();
    let speed = Dimension::ANGULAR_VELOCITY.checked_pow(angle);
    let power = Dimension::POWER.checked_pow(mass);
    if speed.zip(power).and_then(|(s, p)| s.checked_mul(p)) != Some(of) {
        return 1.0;
    }
    points.largest_power().powf(mass.to_f64()) * points.largest_speed().powf(angle.to_f64())
}
