//! A unit alone, as in the header of a table: `T [degC]`.
//!
//! lptn carries the units that people write and never computes with them. `Signal::unit` and
//! `TableSymbol::units` serve headers, messages and the expansion only.

use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind};
use crate::repair;
use crate::types::Type;
use crate::unit_parser::{self, ParsedUnit};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A unit of measurement and its conversion to SI: `si = (value + offset) * scale`.
#[derive(Clone, PartialEq, Debug)]
pub struct Unit {
    /// The unit as written.
    pub text: String,
    /// Size of the unit in SI units.
    pub scale: f64,
    /// Added to a value before scaling: 273.15 for `degC` alone, 459.67 for `degF` alone, else 0.
    pub offset: f64,
    /// The type of its quantity.
    pub ty: Type,
}

impl Unit {
    /// Reads a unit: `W/(m^2 K)`, `uW/rpm^(5/3)`, `1` for plain numbers.
    ///
    /// `degC` and `degF` alone are absolute; `K`, and every temperature inside a compound unit, is
    /// a difference.
    ///
    /// # Errors
    ///
    /// An unknown unit, a product after `/` without brackets, a malformed exponent; the help shows
    /// the corrected unit.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let parsed = parse_or_repair(text)?;
        let entry = parsed.alone.filter(|entry| entry.offset > 0.0);
        let ty =
            if entry.is_some() { Type::ABSOLUTE_TEMPERATURE } else { Type::of(parsed.dimension) };
        let offset = entry.map_or(0.0, |entry| entry.offset);
        Ok(Self { text: text.trim().to_owned(), scale: parsed.scale, offset, ty })
    }

    /// A value in this unit, from SI (absolute temperatures in K).
    pub fn from_si(&self, si: f64) -> f64 {
        si / self.scale - self.offset
    }

    /// The unit in which a quantity is shown if temperatures are in this unit: this one for points
    /// on the scale, K or degR for their differences, SI for all else. Every table, file and
    /// message asks here.
    #[must_use]
    pub fn shown(&self, ty: Type) -> Self {
        match ty.dimension == Dimension::TEMPERATURE {
            true if ty.absolute => self.clone(),
            true => Self { text: self.difference().to_owned(), offset: 0.0, ty, ..*self },
            false => Self { text: ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty },
        }
    }

    /// A value of SI in that unit.
    pub fn show(&self, si: f64, ty: Type) -> f64 {
        match ty.dimension == Dimension::TEMPERATURE {
            true if ty.absolute => self.from_si(si),
            true => si / self.scale,
            false => si,
        }
    }

    /// The unit of a difference between two temperatures in this unit.
    pub fn difference(&self) -> &'static str {
        if (self.scale - 1.0).abs() < 1e-12 { "K" } else { "degR" }
    }

    /// A value in SI (absolute temperatures in K), from this unit.
    pub fn to_si(&self, value: f64) -> f64 {
        (value + self.offset) * self.scale
    }
}

/// Reads a unit; an error has the corrected unit text, if there is one.
pub(crate) fn parse_or_repair(text: &str) -> Result<Rc<ParsedUnit>, UnitError> {
    parse(text).map_err(|error| with_fix(error, text))
}

/// Reads a unit, without a search for the unit that is meant.
pub(crate) fn parse(text: &str) -> Result<Rc<ParsedUnit>, UnitError> {
    if text.trim().is_empty() {
        return Err(UnitError::new(UnitErrorKind::Empty, 0..text.len()));
    }
    if let Some(known) = KNOWN.with_borrow(|known| known.get(text).cloned()) {
        return Ok(known);
    }
    let parsed = Rc::new(unit_parser::parse(text)?);
    KNOWN.with_borrow_mut(|known| {
        if known.len() < MOST_KNOWN {
            known.insert(text.to_owned(), Rc::clone(&parsed));
        }
    });
    Ok(parsed)
}

thread_local! {
    /// Units that were read before: a file writes few of them many times.
    static KNOWN: RefCell<BTreeMap<String, Rc<ParsedUnit>>> = const { RefCell::new(BTreeMap::new()) };
}

const MOST_KNOWN: usize = 64;

fn with_fix(mut error: UnitError, text: &str) -> UnitError {
    let repaired = repair::unit(text);
    match &mut error.kind {
        UnitErrorKind::UnknownUnit { fix, .. }
        | UnitErrorKind::Millikelvin { fix }
        | UnitErrorKind::AmbiguousProduct { fix } => *fix = repaired,
        // `m-2`, `m**2`: not a unit, but plainly one with its exponent in another notation.
        UnitErrorKind::Syntax { .. } if repaired.is_some() => {
            let name = text.trim().to_owned();
            error.kind = UnitErrorKind::UnknownUnit { name, fix: repaired };
        }
        _ => {}
    }
    error
}
