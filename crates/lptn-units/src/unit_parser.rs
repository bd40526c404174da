//! Reads unit texts: `W/(m^2 K)`, `uW/rpm^(5/3)`, `m²·K/W`.

use std::ops::Range;

use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind};
use crate::kin::Kin;
use crate::rational::Rational;
use crate::unit_table::{self, Entry};

/// Deepest nesting of brackets in a unit.
const DEPTH_LIMIT: usize = 32;

/// A unit as read.
#[derive(Clone, Debug)]
pub(crate) struct ParsedUnit {
    pub(crate) scale: f64,
    pub(crate) dimension: Dimension,
    /// The unit, when it stands alone: only then can it be an absolute temperature.
    pub(crate) alone: Option<Entry>,
    /// The names in it, as written.
    pub(crate) names: Vec<Range<usize>>,
}

/// Reads the whole text as a unit, without proposing fixes.
pub(crate) fn parse(text: &str) -> Result<ParsedUnit, UnitError> {
    let mut parser = Parser { text, at: 0, depth: 0, names: Vec::new() };
    let product = parser.product()?;
    parser.skip_space();
    if parser.at < text.len() {
        return Err(parser.unexpected("a unit, `*`, `/` or `^`"));
    }
    if !product.scale.is_finite() || product.scale <= 0.0 {
        let number = text.to_owned();
        return Err(UnitError::new(UnitErrorKind::OutOfRange { number }, 0..text.len()));
    }
    let written = |name: &Range<usize>| text.get(name.clone()) == Some(MILLIKELVIN);
    if product.millikelvins.to_f64() < 0.0
        && let Some(span) = parser.names.iter().find(|name| written(name))
    {
        return Err(UnitError::new(UnitErrorKind::Millikelvin { fix: None }, span.clone()));
    }
    let dimension = product.with_kin();
    Ok(ParsedUnit { scale: product.scale, dimension, alone: product.alone, names: parser.names })
}

#[derive(Clone, Copy)]
struct Factor {
    scale: f64,
    dimension: Dimension,
    alone: Option<Entry>,
    /// Exponents of the units of force and of length in it: both are 1 in a torque.
    lever: [Rational; 2],
    /// Exponent of the millikelvin.
    millikelvins: Rational,
}

/// Below the bar it is mostly metre kelvin.
pub(crate) const MILLIKELVIN: &str = "mK";

const ONE: Factor = Factor {
    scale: 1.0,
    dimension: Dimension::NONE,
    alone: None,
    lever: [Rational::ZERO; 2],
    millikelvins: Rational::ZERO,
};

impl Factor {
    fn named(entry: Entry) -> Self {
        let Entry { scale, dimension, .. } = entry;
        let one = |of: Dimension| if dimension == of { Rational::ONE } else { Rational::ZERO };
        let lever = [one(Dimension::FORCE), one(Dimension::LENGTH)];
        Self { scale, dimension, alone: Some(entry), lever, ..ONE }
    }

    /// The dimension, which is one of a torque if the unit has a force and a length: `N m`,
    /// `lbf ft`, `N m/K`. `N m/s` is a watt, written as one.
    fn with_kin(&self) -> Dimension {
        let kin = Kin::of_torque(self.dimension.exponents());
        match self.lever == [Rational::ONE; 2] && kin == Kin::Torque {
            true => self.dimension.of_kin(kin),
            false => self.dimension,
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    names: Vec<Range<usize>>,
}

#[derive(PartialEq)]
enum Joint {
    Times,
    Over,
    End,
}

impl Parser<'_> {
    /// Factors joined by `*`, a space or `/`. After a `/` only another `/` may follow.
    fn product(&mut self) -> Result<Factor, UnitError> {
        self.skip_space();
        let mut result = if self.peek() == Some('/') { ONE } else { self.first_factor()? };
        let mut divided = false;
        loop {
            let start = self.at;
            let joint = self.joint();
            if joint == Joint::End {
                return Ok(result);
            }
            let factor = self.factor()?;
            if divided && joint == Joint::Times {
                let kind = UnitErrorKind::AmbiguousProduct { fix: None };
                return Err(UnitError::new(kind, self.trimmed(start)));
            }
            divided |= joint == Joint::Over;
            result = self.join(result, factor, &joint).ok_or_else(|| self.overflow(start))?;
        }
    }

    fn trimmed(&self, start: usize) -> Range<usize> {
        let part = self.text.get(start..self.at).unwrap_or_default();
        start + part.len() - part.trim_start().len()..self.at
    }

    fn join(&self, left: Factor, right: Factor, joint: &Joint) -> Option<Factor> {
        let ([force, length], [by_force, by_length]) = (left.lever, right.lever);
        let (milli, by_milli) = (left.millikelvins, right.millikelvins);
        Some(if *joint == Joint::Over {
            let lever = [force.checked_sub(by_force)?, length.checked_sub(by_length)?];
            let dimension = left.dimension.checked_div(right.dimension)?;
            let (scale, millikelvins) = (left.scale / right.scale, milli.checked_sub(by_milli)?);
            Factor { scale, dimension, alone: None, lever, millikelvins }
        } else {
            let lever = [force.checked_add(by_force)?, length.checked_add(by_length)?];
            let dimension = left.dimension.checked_mul(right.dimension)?;
            let (scale, millikelvins) = (left.scale * right.scale, milli.checked_add(by_milli)?);
            Factor { scale, dimension, alone: None, lever, millikelvins }
        })
    }

    /// The sign that joins the factor before to the one after, if there is one after.
    fn joint(&mut self) -> Joint {
        let before = self.at;
        self.skip_space();
        match self.peek() {
            Some('/') => {
                self.advance();
                Joint::Over
            }
            Some('*' | '·' | '⋅' | '×') => {
                self.advance();
                Joint::Times
            }
            // `min(` would be a call, not a product.
            Some('(') if self.at > before => Joint::Times,
            Some(c) if is_name_start(c) => Joint::Times,
            _ => Joint::End,
        }
    }

    /// A `1` may be above the bar: `1/K`.
    fn first_factor(&mut self) -> Result<Factor, UnitError> {
        if self.peek() == Some('1') {
            self.advance();
            return Ok(ONE);
        }
        self.factor()
    }

    fn factor(&mut self) -> Result<Factor, UnitError> {
        self.skip_space();
        let start = self.at;
        let base = match self.peek() {
            Some('(') => self.group()?,
            Some(c) if is_name_start(c) => self.name()?,
            _ => return Err(self.unexpected("a unit")),
        };
        match self.exponent()? {
            None => Ok(base),
            Some(exponent) => raise(base, exponent).ok_or_else(|| self.overflow(start)),
        }
    }

    fn group(&mut self) -> Result<Factor, UnitError> {
        let start = self.at;
        self.depth += 1;
        if self.depth > DEPTH_LIMIT {
            let kind = UnitErrorKind::TooDeep { limit: DEPTH_LIMIT };
            return Err(UnitError::new(kind, start..start + 1));
        }
        self.advance();
        let inner = self.product()?;
        self.skip_space();
        if self.peek() != Some(')') {
            return Err(self.unexpected("`)`"));
        }
        self.advance();
        self.depth -= 1;
        Ok(Factor { alone: None, ..inner })
    }

    fn name(&mut self) -> Result<Factor, UnitError> {
        let start = self.at;
        while self.peek().is_some_and(|c| is_name_start(c) || c.is_ascii_digit()) {
            self.advance();
        }
        let written = self.text.get(start..self.at).unwrap_or_default();
        self.names.push(start..self.at);
        match unit_table::find(&unit_table::plain_name(written)) {
            Some(entry) if written == MILLIKELVIN => {
                Ok(Factor { millikelvins: Rational::ONE, ..Factor::named(entry) })
            }
            Some(entry) => Ok(Factor::named(entry)),
            None => {
                let kind = UnitErrorKind::UnknownUnit { name: written.to_owned(), fix: None };
                Err(UnitError::new(kind, start..self.at))
            }
        }
    }

    /// `^2`, `^-1`, `^0.5`, `^(5/3)`, `²`, `⁻¹`; `None` if there is no exponent.
    fn exponent(&mut self) -> Result<Option<Rational>, UnitError> {
        let start = self.at;
        let (body, digits) = match self.peek() {
            Some('^') => {
                self.advance();
                let body = self.exponent_text();
                let digits = body.trim_matches(['(', ')']).to_owned();
                (body, digits)
            }
            Some(c) if superscript(c).is_some() => {
                let body = self.take_while(|c| superscript(c).is_some());
                let digits = body.chars().filter_map(superscript).collect();
                (body, digits)
            }
            _ => return Ok(None),
        };
        let error =
            || UnitError::new(UnitErrorKind::Exponent { text: body.clone() }, start..self.at);
        fraction(&digits).map(Some).ok_or_else(error)
    }

    fn exponent_text(&mut self) -> String {
        if self.peek() != Some('(') {
            return self.take_while(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
        }
        let mut body = self.take_while(|c| c != ')');
        if self.peek() == Some(')') {
            self.advance();
            body.push(')');
        }
        body
    }

    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> String {
        let start = self.at;
        while self.peek().is_some_and(&keep) {
            self.advance();
        }
        self.text.get(start..self.at).unwrap_or_default().to_owned()
    }

    fn peek(&self) -> Option<char> {
        self.text.get(self.at..)?.chars().next()
    }

    fn advance(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    fn skip_space(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.advance();
        }
    }

    fn unexpected(&self, wanted: &'static str) -> UnitError {
        let (found, length) = match self.peek() {
            Some(c) => (format!("`{c}`"), c.len_utf8()),
            None => ("the end".to_owned(), 0),
        };
        UnitError::new(UnitErrorKind::Syntax { wanted, found }, self.at..self.at + length)
    }

    fn overflow(&self, start: usize) -> UnitError {
        let text = self.text.get(start..self.at).unwrap_or_default().trim().to_owned();
        UnitError::new(UnitErrorKind::Exponent { text }, start..self.at)
    }
}

/// Letters, and the signs that are units by themselves.
pub(crate) fn is_name_start(c: char) -> bool {
    (c.is_alphabetic() && superscript(c).is_none())
        || matches!(c, '°' | '˚' | '%' | '_' | '℃' | '℉')
}

fn raise(base: Factor, exponent: Rational) -> Option<Factor> {
    let scale = match exponent.as_integer() {
        Some(n) => base.scale.powi(n),
        None => base.scale.powf(exponent.to_f64()),
    };
    let [force, length] = base.lever;
    let lever = [force.checked_mul(exponent)?, length.checked_mul(exponent)?];
    let millikelvins = base.millikelvins.checked_mul(exponent)?;
    let dimension = base.dimension.checked_pow(exponent)?;
    Some(Factor { scale, dimension, alone: None, lever, millikelvins })
}

/// `5/3`, `-1`, `0.5`.
fn fraction(text: &str) -> Option<Rational> {
    match text.split_once('/') {
        Some((num, den)) => decimal(num)?.checked_div(decimal(den)?),
        None => decimal(text),
    }
}

fn decimal(text: &str) -> Option<Rational> {
    Rational::from_decimal(text.trim())
}

/// The plain form of a raised digit or minus.
pub(crate) fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴'..='⁹' => char::from_u32(u32::from(c) - u32::from('⁰') + u32::from('0'))?,
        _ => return None,
    })
}
