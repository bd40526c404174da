//! Standard deviations of quantities: `20 ± 5 W`, `25 degC ± 0.5 K`, `20 W ± 5 %`.

use std::ops::Range;

use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind};
use crate::format::rounded;
use crate::number::Number;
use crate::quantity::{ReadUnit, Reading, deviation_number, skip_space, unit_at};
use crate::spread::Spread;
use crate::types::Type;
use crate::unit_parser::superscript;

const PLUS_MINUS: [&str; 3] = ["±", "+/-", "+-"];

#[derive(Debug)]
pub(crate) struct Deviation {
    pub(crate) number: Number,
    pub(crate) measure: Measure,
}

/// The unit of a deviation's number.
#[derive(Debug)]
pub(crate) enum Measure {
    /// The unit that follows both numbers: `50 ± 5 %`.
    Shared,
    /// Its own unit after that of the value: scale and dimension.
    Own(f64, Dimension),
    /// No unit after it, although the value has one: `5 kW ± 1`.
    Missing,
    /// A part of the value, `20 W ± 5 %`; before the unit, `20 ± 5 % W`, it can be read in two
    /// ways.
    Percent { leading: bool },
}

/// The first `±` from `at` on.
pub(crate) fn plus_minus(text: &str, at: usize) -> Option<Range<usize>> {
    let rest = text.get(at..)?;
    // most texts have neither
    if !rest.bytes().any(|byte| byte == b'+' || byte == 0xc2) {
        return None;
    }
    PLUS_MINUS
        .iter()
        .filter_map(|sign| rest.find(sign).map(|i| at + i..at + i + sign.len()))
        .min_by_key(|range| range.start)
}

/// The deviation directly after the number, and the byte at which the unit begins.
pub(crate) fn leading(text: &str, at: usize) -> Result<(Option<Deviation>, usize), UnitError> {
    let start = skip_space(text, at);
    let Some(sign) = plus_minus(text, start).filter(|sign| sign.start == start) else {
        return Ok((None, at));
    };
    let number = deviation_number(text, sign.end)?;
    let after = skip_space(text, number.span.end);
    let unit = text.get(after..).unwrap_or_default().strip_prefix('%').map(str::trim);
    // `%` and `%/K` are units; no one writes `% W`
    let is_apart =
        |rest: &str| !rest.is_empty() && !rest.starts_with(|c| c == '/' || c == '^' || raised(c));
    Ok(match unit.filter(|rest| is_apart(rest)) {
        Some(_) => {
            (Some(Deviation { number, measure: Measure::Percent { leading: true } }), after + 1)
        }
        None => {
            let end = number.span.end;
            (Some(Deviation { number, measure: Measure::Shared }), end)
        }
    })
}

fn raised(c: char) -> bool {
    superscript(c).is_some()
}

/// `± 0.5 K` after the unit.
pub(crate) fn trailing(text: &str, at: usize, read_unit: ReadUnit) -> Result<Deviation, UnitError> {
    let number = deviation_number(text, at)?;
    let rest = number.span.end..text.len();
    if text.get(rest.clone()).unwrap_or_default().trim() == "%" {
        return Ok(Deviation { number, measure: Measure::Percent { leading: false } });
    }
    let own = unit_at(text, rest, read_unit)?;
    let measure =
        own.map_or(Measure::Missing, |(unit, _)| Measure::Own(unit.scale, unit.dimension));
    Ok(Deviation { number, measure })
}

impl Reading<'_> {
    /// The uncertainty after `±`, of this value in SI units.
    pub(crate) fn spread(&self, value: f64, ty: Type) -> Result<Option<Spread>, UnitError> {
        let Some(deviation) = &self.deviation else { return Ok(None) };
        if let Some(kind) = self.doubt(deviation, ty) {
            return Err(UnitError::new(kind, deviation.number.span.clone()));
        }
        let (size, distribution) = (deviation.number.value, self.distribution(value, ty)?);
        let absolute = |size: f64| Spread::of(value, size / distribution.written(), distribution);
        let spread = match deviation.measure {
            Measure::Percent { .. } => Spread::of_percent(value, size, distribution),
            Measure::Own(scale, _) => absolute(size * scale),
            Measure::Shared | Measure::Missing => absolute(size * self.scale()),
        };
        self.in_range(spread.sigma(value))?;
        Ok(Some(spread))
    }

    /// The reason why a deviation cannot be read in one way only.
    fn doubt(&self, deviation: &Deviation, ty: Type) -> Option<UnitErrorKind> {
        let dimension = self.unit.as_ref().map_or(Dimension::NONE, |(unit, _)| unit.dimension);
        let (x, y) = (self.number.value, deviation.number.value);
        Some(match deviation.measure {
            Measure::Percent { .. } if ty.absolute => {
                let size = rounded((x * y / 100.0).abs(), 12);
                let fix = format!("{} ± {size} {}", self.number_text(), self.unit_text());
                UnitErrorKind::RelativeDeviation { fix: Some(fix) }
            }
            // no share of 0 is a deviation
            Measure::Percent { .. } if x.abs() <= 0.0 && y.abs() > 0.0 => {
                let (number, unit) = (self.number_text(), self.unit_text());
                UnitErrorKind::DeviationOfZero {
                    example: format!("{number} ± 1 {unit}").trim_end().to_owned(),
                }
            }
            Measure::Percent { leading: true } => UnitErrorKind::PercentDeviation {
                points: format!("{} {}", plain(x / 100.0, y / 100.0), self.unit_text()),
                part: format!(
                    "{} {} ± {} %",
                    self.number_text(),
                    self.unit_text(),
                    self.text_of(deviation)
                ),
            },
            Measure::Percent { leading: false } if self.is_percent() => {
                UnitErrorKind::PercentDeviation {
                    points: percent(x, y),
                    part: percent(x, (x * y / 100.0).abs()),
                }
            }
            // a factor with a deviation in percent could be taken for a share
            Measure::Shared if self.is_percent() && !is_share(x, y) => {
                UnitErrorKind::PercentDeviation {
                    points: plain(x / 100.0, y / 100.0),
                    part: plain(x, (x * y / 100.0).abs()),
                }
            }
            Measure::Missing if self.is_percent() => {
                UnitErrorKind::BareDeviation { fix: percent(x, y) }
            }
            Measure::Missing => {
                let fix = format!(
                    "{} ± {} {}",
                    self.number_text(),
                    self.text_of(deviation),
                    self.unit_text()
                );
                UnitErrorKind::BareDeviation { fix }
            }
            Measure::Own(_, own) if own != dimension => UnitErrorKind::Dimension {
                wanted: Box::new(Type::of(dimension)),
                found: Box::new(Type::of(own)),
                fix: None,
            },
            _ => return None,
        })
    }

    fn text_of(&self, deviation: &Deviation) -> &str {
        self.text.get(deviation.number.span.clone()).unwrap_or_default()
    }

    /// `0.8 ± 5 %` if a value with a unit is expected.
    pub(crate) fn percent_of_bare_number(&self, wanted: Type) -> Option<String> {
        let shared = |deviation: &&Deviation| matches!(deviation.measure, Measure::Shared);
        let deviation = self
            .deviation
            .as_ref()
            .filter(shared)
            .filter(|_| self.is_percent() && !wanted.absolute)?;
        Some(format!(
            "{} {} ± {} %",
            self.number_text(),
            wanted.usual_unit(),
            self.text_of(deviation)
        ))
    }

    fn is_percent(&self) -> bool {
        self.unit.as_ref().and_then(|(unit, _)| unit.alone).is_some_and(|entry| entry.name == "%")
    }
}

/// True if two numbers before `%` are a share and its deviation, not a factor and a part of it.
fn is_share(x: f64, y: f64) -> bool {
    x.abs() > 1.0 && y <= x.abs()
}

/// `x ± y` percent, in a form with only one reading.
fn percent(x: f64, y: f64) -> String {
    if is_share(x, y) { format!("{} %", plain(x, y)) } else { plain(x / 100.0, y / 100.0) }
}

fn plain(x: f64, y: f64) -> String {
    format!("{} ± {}", rounded(x, 12), rounded(y, 12))
}
