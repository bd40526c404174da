//! `posterior.json` as it is written.

use std::io::{self, Write};

use lptn_units::Spread;
use serde_json::{Map, Value, json};

use super::{FORMAT, Posterior, PosteriorQuantity};

/// The meaning of the numbers of the covariance, for readers.
const COORDINATES: &str = "rows and columns are those of `of`; \"ln x\" is the natural logarithm of \
    x over its SI unit, everything else is in the unit of the quantity";

impl Posterior {
    /// Writes the file; every number reads back as the same `f64`.
    ///
    /// # Errors
    /// The error of the stream.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = |value: Value| value.to_string();
        writeln!(out, "{{\n  \"format\": {FORMAT},\n  \"kind\": \"posterior\",")?;
        writeln!(out, "  \"network\": {},", text(json!(self.network)))?;
        writeln!(out, "  \"fit\": {},", text(json!(self.fit)))?;
        let quantities = self.quantities.iter().map(|quantity| text(member(quantity)));
        list(out, "quantities", quantities, ",\n")?;
        let of: Vec<String> =
            self.quantities.iter().filter_map(PosteriorQuantity::coordinate).collect();
        writeln!(out, "  \"coordinates\": {},", text(json!(COORDINATES)))?;
        writeln!(out, "  \"of\": {},", text(json!(of)))?;
        let rows = self.covariance();
        list(out, "covariance", rows.iter().map(|row| text(json!(row))), ",\n")?;
        let row = |i: usize| -> Vec<f64> {
            (0..of.len()).map(|j| self.correlations.between(i, j)).collect()
        };
        list(out, "correlation", (0..of.len()).map(|i| text(json!(row(i)))), "\n")?;
        writeln!(out, "}}")
    }
}

/// A member that is a list with a line for each entry.
fn list(
    out: &mut dyn Write,
    name: &str,
    lines: impl Iterator<Item = String>,
    end: &str,
) -> io::Result<()> {
    let lines: Vec<String> = lines.map(|line| format!("\n    {line}")).collect();
    let close = if lines.is_empty() { "" } else { "\n  " };
    write!(out, "  \"{name}\": [{}{close}]{end}", lines.join(","))
}

fn member(quantity: &PosteriorQuantity) -> Value {
    let finite = |value: f64| value.is_finite().then_some(value);
    let mut member = Map::new();
    let mut put = |name: &str, value: Value| member.insert(name.to_owned(), value);
    put("name", json!(quantity.name));
    put("of", json!(quantity.of.word()));
    put("value", json!(quantity.value));
    put("unit", json!(quantity.unit));
    put("standard_error", json!(quantity.spread.map(|spread| spread.sigma(quantity.value))));
    put("distribution", json!(quantity.spread.map(|spread| spread.distribution.word())));
    put("half_width_95", json!(quantity.half_width));
    put("degrees_of_freedom", json!(quantity.degrees_of_freedom.and_then(finite)));
    put("from", json!(finite(quantity.bounds.0)));
    put("to", json!(finite(quantity.bounds.1)));
    put("prior", json!(quantity.prior.map(|prior| of_prior(prior.value, prior.spread))));
    Value::Object(member)
}

fn of_prior(value: f64, spread: Spread) -> Value {
    json!({
        "value": value,
        "standard_deviation": spread.sigma(value),
        "distribution": spread.distribution.word(),
    })
}
