//! Quantities: a number, perhaps its standard deviation, and a unit.

use std::ops::Range;
use std::rc::Rc;

use crate::deviation::{self, Deviation};
use crate::dimension::Dimension;
use crate::distribution::{self, Named};
use crate::error::{UnitError, UnitErrorKind};
use crate::format::{number, rounded};
use crate::kinship::{
    above_absolute_zero, has_inverse, is_frequency_for_rotation, is_inverse, revolutions,
};
use crate::number::{self, Number};
use crate::separators;
use crate::spread::{Distribution, Spread};
use crate::types::Type;
use crate::unit::{self, Unit};
use crate::unit_parser::ParsedUnit;

/// A value with its type, in SI units.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quantity {
    /// The value in SI units; an absolute temperature in K.
    pub value: f64,
    /// Its uncertainty, if the text gives one.
    pub deviation: Option<Spread>,
    /// Its type: a dimension, or an absolute temperature.
    pub ty: Type,
}

impl Quantity {
    /// One standard deviation in SI units; 0 if the value is certain.
    pub fn sigma(&self) -> f64 {
        self.deviation.map_or(0.0, |spread| spread.sigma(self.value))
    }
}

/// Reads a quantity: `0.3 K/W`, `87 ± 15 uW/rpm^(5/3)`, `20 W +- 5 %`, `25.5 degC`, `0.7`.
///
/// `expected` is the type of the field, if known; the quantity must then be of this type, or have
/// exactly one radian more (see [`Type::conforms_to`]). `300 K` is an absolute temperature only if
/// one is expected. The deviation follows the number (`25 ± 0.5 degC`) or, with its own unit, is at
/// the end (`25 degC ± 0.5 K`); after a unit `± 5 %` is relative to the value. `50 ± 5 %` is
/// `0.5 ± 0.05`, as for every other unit. The distribution may come last, `0 ± 3 K (rectangle)`;
/// see [`Distribution`](crate::Distribution).
///
/// # Errors
///
/// Text that is not a quantity, an unknown or ambiguous unit, a value out of range, a negative
/// deviation, a temperature below absolute zero, and, with `expected`, a wrong type. Every error
/// names its place and, where possible, the string to write.
pub fn parse_quantity(text: &str, expected: Option<Type>) -> Result<Quantity, UnitError> {
    read(text).map_err(|error| of_quantity(error, expected))?.conclude(expected)
}

/// The same mistake, without a proposed unit of another quantity than the expected one: `2 yd` is
/// not meant if a time is expected.
pub(crate) fn of_quantity(mut error: UnitError, expected: Option<Type>) -> UnitError {
    let Some(wanted) = expected else { return error };
    if let UnitErrorKind::UnknownUnit { fix, .. } | UnitErrorKind::Millikelvin { fix } =
        &mut error.kind
    {
        let other = |fix: &String| {
            let found = read(fix).and_then(|reading| reading.conclude(Some(wanted)));
            let kind = found.err().map(|error| error.kind);
            matches!(kind, Some(UnitErrorKind::Dimension { .. } | UnitErrorKind::Rotation { .. }))
        };
        *fix = fix.take().filter(|fix| !other(fix));
    }
    error
}

/// The mistake in a whole string in kelvin, such as `300 K`, if an absolute temperature is expected
/// but the type follows from something else, like that of a parameter's new value or of a bound.
/// `K` is a difference there, as it is in the parameter itself. `None` for any other text.
pub fn kelvin_alone(text: &str) -> Option<UnitError> {
    let reading = read(text).ok()?;
    let found = reading.conclude(None).ok()?.ty;
    let difference = Type::of(Dimension::TEMPERATURE);
    (found == difference).then(|| reading.mismatch(found, Type::ABSOLUTE_TEMPERATURE))
}

/// A quantity's number and unit as written in a text.
#[derive(Clone, Debug)]
pub struct WrittenQuantity {
    /// The bytes of the number, its sign included.
    pub number: Range<usize>,
    /// The unit, `1` if none is written.
    pub unit: Unit,
}

/// The place of a quantity's number, and its unit; `None` if the text is not a quantity.
pub fn written_quantity(text: &str) -> Option<WrittenQuantity> {
    let reading = read(text).ok()?;
    let written = reading.unit_text();
    let unit = Unit::parse(if written.is_empty() { "1" } else { written }).ok()?;
    Some(WrittenQuantity { number: reading.number.span, unit })
}

/// A quantity as written, before its type is settled.
#[derive(Debug)]
pub(crate) struct Reading<'a> {
    pub(crate) text: &'a str,
    pub(crate) number: Number,
    pub(crate) deviation: Option<Deviation>,
    pub(crate) unit: Option<PlacedUnit>,
    /// The distribution of the deviation, if given.
    pub(crate) distribution: Option<Named>,
}

/// A unit with its place.
type PlacedUnit = (Rc<ParsedUnit>, Range<usize>);

/// Reader of a unit.
pub(crate) type ReadUnit = fn(&str) -> Result<Rc<ParsedUnit>, UnitError>;

/// Reads the text without regard to the type.
pub(crate) fn read(text: &str) -> Result<Reading<'_>, UnitError> {
    read_with(text, unit::parse_or_repair)
}

/// The same; an error has no corrected unit. Most texts that are not quantities are
/// expressions, whose error as a quantity is dropped.
pub(crate) fn read_plainly(text: &str) -> Result<Reading<'_>, UnitError> {
    read_with(text, unit::parse)
}

fn read_with(text: &str, read_unit: ReadUnit) -> Result<Reading<'_>, UnitError> {
    let start = text.len() - text.trim_start().len();
    let distribution = distribution::named(text)?;
    let end = distribution.as_ref().map_or(text.len(), |named| named.span.start);
    let body = text.get(..end).unwrap_or_default();
    let end = body.trim_end().len();
    if start >= end {
        return Err(UnitError::new(UnitErrorKind::Empty, 0..text.len()));
    }
    let Some(number) = number::scan(text, start, true)? else {
        return Err(no_number(text, start..end));
    };
    let bare = |number| Reading { text, number, deviation: None, unit: None, distribution };
    if number.span.end == end {
        let reading = bare(number);
        reading.check_deviation()?;
        return Ok(reading);
    }
    separators::check(text, &number)?;
    separators::check_fraction(text, &number)?;
    let after_number = number.span.end;
    let (mut deviation, unit_start) = deviation::leading(body, after_number)?;
    let mut unit_end = end;
    if deviation.is_none()
        && let Some(at) = deviation::plus_minus(body, unit_start)
    {
        unit_end = at.start;
        deviation = Some(deviation::trailing(body, at.end, read_unit)?);
    }
    let unit = unit_at(text, unit_start..unit_end, read_unit)?;
    let reading = Reading { deviation, unit, ..bare(number) };
    reading.check_deviation()?;
    Ok(reading)
}

fn no_number(text: &str, span: Range<usize>) -> UnitError {
    let word = text.get(span.clone()).unwrap_or_default();
    let bare = word.trim_start_matches(['+', '-']).to_lowercase();
    let first = bare.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
    if matches!(first, "nan" | "inf" | "infinity") {
        return UnitError::new(UnitErrorKind::NotFinite { text: first.to_owned() }, span);
    }
    let found = format!("`{}`", word.chars().take(20).collect::<String>());
    UnitError::new(UnitErrorKind::Syntax { wanted: "a number", found }, span)
}

pub(crate) fn skip_space(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + rest.len() - rest.trim_start().len()
}

pub(crate) fn deviation_number(text: &str, at: usize) -> Result<Number, UnitError> {
    let start = skip_space(text, at);
    let number =
        number::scan(text, start, true)?.ok_or_else(|| no_number(text, start..text.len()))?;
    separators::check(text, &number)?;
    Ok(number)
}

/// The unit that fills this part of the text, `None` if it is blank.
pub(crate) fn unit_at(
    text: &str,
    part: Range<usize>,
    read_unit: ReadUnit,
) -> Result<Option<PlacedUnit>, UnitError> {
    let written = text.get(part.clone()).unwrap_or_default();
    // `2 * m` is a number times a unit.
    let product = written.trim_start();
    let written = product.strip_prefix(['*', '·']).unwrap_or(product).trim_start();
    let start = part.end - written.len();
    let unit = written.trim();
    if unit.is_empty() {
        return Ok(None);
    }
    let before = text.get(..start).unwrap_or_default();
    let after = text.get(part.end..).unwrap_or_default();
    let complete = |fix: &str| {
        let space = if before.ends_with(char::is_whitespace) { "" } else { " " };
        let gap = if after.is_empty() { "" } else { " " };
        format!("{before}{space}{fix}{gap}{after}").trim().to_owned()
    };
    let parsed = read_unit(unit).map_err(|e| e.shifted(start).map_fix(complete))?;
    if parsed.names.is_empty() {
        let kind = UnitErrorKind::Syntax { wanted: "a unit", found: format!("`{unit}`") };
        return Err(UnitError::new(kind, start..start + unit.len()));
    }
    Ok(Some((parsed, start..start + unit.len())))
}

impl Reading<'_> {
    fn check_deviation(&self) -> Result<(), UnitError> {
        match &self.deviation {
            Some(deviation) if deviation.number.value < 0.0 => {
                let span = deviation.number.span.clone();
                let text = self.text.get(span.clone()).unwrap_or_default().to_owned();
                Err(UnitError::new(UnitErrorKind::NegativeDeviation { text }, span))
            }
            None => match &self.distribution {
                Some(named) => Err(self.alone(named)),
                None => Ok(()),
            },
            Some(_) => Ok(()),
        }
    }

    /// A distribution without a deviation.
    fn alone(&self, named: &Named) -> UnitError {
        let word = named.distribution.word();
        UnitError::new(UnitErrorKind::DistributionAlone { word }, named.span.clone())
    }

    /// The distribution; only a value above zero that is not absolute can be lognormal.
    pub(crate) fn distribution(&self, value: f64, ty: Type) -> Result<Distribution, UnitError> {
        let Some(named) = &self.distribution else { return Ok(Distribution::Normal) };
        if named.distribution == Distribution::Lognormal && (ty.absolute || value <= 0.0) {
            return Err(UnitError::new(UnitErrorKind::Lognormal, named.span.clone()));
        }
        Ok(named.distribution)
    }

    /// The unit names, as written.
    pub(crate) fn unit_names(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        self.unit.iter().flat_map(|(unit, span)| {
            unit.names.iter().filter_map(|name| {
                let range = span.start + name.start..span.start + name.end;
                Some((self.text.get(range.clone())?, range))
            })
        })
    }

    /// The text as it is, without surrounding space.
    pub(crate) fn plain_text(&self) -> &str {
        self.text.trim()
    }

    /// The text with a space instead of an operator between number and unit.
    pub(crate) fn as_plain_quantity(&self) -> String {
        let unit = self.unit_text().trim_start_matches(['*', '·', ' ']);
        let bar = if unit.starts_with('/') { "1" } else { "" };
        format!("{} {bar}{}", self.amount_text(), unit.replace("/ ", "/"))
    }

    /// Settles the type and converts to SI.
    pub(crate) fn conclude(&self, expected: Option<Type>) -> Result<Quantity, UnitError> {
        let (found, offset) = self.found_type(expected);
        let ty = match expected {
            Some(wanted) if !found.conforms_to(wanted) => return Err(self.mismatch(found, wanted)),
            Some(wanted) => wanted,
            None => found,
        };
        let mut value = self.in_range((self.number.value + offset) * self.scale())?;
        if ty.absolute {
            value = above_absolute_zero(value, self.number.span.clone())?;
        }
        Ok(Quantity { value, deviation: self.spread(value, ty)?, ty })
    }

    pub(crate) fn scale(&self) -> f64 {
        self.unit.as_ref().map_or(1.0, |(unit, _)| unit.scale)
    }

    /// The type by the unit alone, and the offset of an absolute temperature.
    fn found_type(&self, expected: Option<Type>) -> (Type, f64) {
        let Some((unit, _)) = &self.unit else { return (Type::SCALAR, 0.0) };
        let wants_absolute = expected == Some(Type::ABSOLUTE_TEMPERATURE);
        let absolute = unit.alone.filter(|entry| {
            entry.dimension == Dimension::TEMPERATURE && (entry.offset > 0.0 || wants_absolute)
        });
        match absolute {
            Some(entry) => (Type::ABSOLUTE_TEMPERATURE, entry.offset),
            None => (Type::of(unit.dimension), 0.0),
        }
    }

    pub(crate) fn in_range(&self, value: f64) -> Result<f64, UnitError> {
        if value.is_finite() {
            return Ok(value);
        }
        let number = self.text.trim().to_owned();
        Err(UnitError::new(UnitErrorKind::OutOfRange { number }, self.number.span.clone()))
    }

    pub(crate) fn number_text(&self) -> &str {
        self.text.get(self.number.span.clone()).unwrap_or_default()
    }

    pub(crate) fn unit_text(&self) -> &str {
        self.unit.as_ref().and_then(|(_, span)| self.text.get(span.clone())).unwrap_or_default()
    }

    /// Number and deviation as written, without the unit.
    fn amount_text(&self) -> &str {
        let end = self.unit.as_ref().map_or(self.body_end(), |(_, span)| span.start);
        self.text.get(..end).unwrap_or_default().trim().trim_end_matches('*').trim_end()
    }

    fn whole_span(&self) -> Range<usize> {
        skip_space(self.text, 0)..self.text.trim_end().len()
    }

    /// The end of the text, without its distribution and the space before it.
    fn body_end(&self) -> usize {
        let end = self.distribution.as_ref().map_or(self.text.len(), |named| named.span.start);
        self.text.get(..end).unwrap_or_default().trim_end().len()
    }

    /// The text after the unit: a deviation with its own unit, a distribution.
    fn tail(&self) -> &str {
        let end = self.unit.as_ref().map_or(self.body_end(), |(_, span)| span.end);
        self.text.get(end..).unwrap_or_default().trim_end()
    }

    fn mismatch(&self, found: Type, wanted: Type) -> UnitError {
        let (amount, tail) = (self.amount_text(), self.tail());
        let kind = if let Some(fix) = self.percent_of_bare_number(wanted) {
            UnitErrorKind::BareNumber { wanted, fix }
        } else if self.unit.is_none() {
            UnitErrorKind::BareNumber {
                wanted,
                fix: format!("{amount} {}{tail}", wanted.usual_unit()),
            }
        } else if wanted.absolute && found.dimension == Dimension::TEMPERATURE {
            UnitErrorKind::AbsoluteWanted { fix: format!("{amount} degC{tail}"), celsius: None }
        } else if found.absolute && wanted.dimension == Dimension::TEMPERATURE {
            UnitErrorKind::DifferenceWanted { fix: self.as_difference() + tail }
        } else if is_frequency_for_rotation(found, wanted) {
            UnitErrorKind::Rotation { fix: self.in_revolutions() }
        } else {
            let fix = self.mismatch_fix(found, wanted);
            UnitErrorKind::Dimension { wanted: Box::new(wanted), found: Box::new(found), fix }
        };
        UnitError::new(kind, self.whole_span())
    }

    /// `5 degF` as a difference is `5 degR`.
    fn as_difference(&self) -> String {
        let fahrenheit = self.unit_text().ends_with(['F', '℉']);
        format!("{} {}", self.amount_text(), if fahrenheit { "degR" } else { "K" })
    }

    /// `None` for a deviation that would not be converted.
    fn in_revolutions(&self) -> Option<String> {
        let (scale, tail) = (self.scale(), self.tail());
        if let Some(unit) = revolutions(scale) {
            return Some(format!("{} {unit}{tail}", self.amount_text()));
        }
        let complete = self.deviation.is_none() || tail.ends_with('%');
        complete.then(|| format!("{} rev/s{tail}", rounded(self.number.value * scale, 12)))
    }

    /// The inverse of the expected type, if both are in use. A unit without a known quantity is a
    /// slip; for a unit of another quantity the intended one is unknown.
    fn mismatch_fix(&self, found: Type, wanted: Type) -> Option<String> {
        if is_inverse(found, wanted) {
            let inverse = || format!("1 / ({} [{}])", number(self.number.value), self.unit_text());
            return (self.deviation.is_none() && has_inverse(found, wanted)).then(inverse);
        }
        let slip = !found.absolute && found.dimension.quantity_name().is_none();
        let fix = || {
            format!("{} {}", self.amount_text(), wanted.usual_unit())
                .trim_end_matches(" 1")
                .to_owned()
        };
        slip.then(|| fix() + self.tail())
    }
}
