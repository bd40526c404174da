//! The distribution after a deviation: `0 ± 3 K (rectangle)`.

use std::ops::Range;

use crate::error::{UnitError, UnitErrorKind};
use crate::spread::Distribution;
use crate::suggest::suggest;

/// A distribution as written, brackets included.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    pub(crate) distribution: Distribution,
    pub(crate) span: Range<usize>,
}

/// Other names of distributions, with the one that is meant; `None` if there is none.
const OTHERS: [(&str, Option<Distribution>); 12] = [
    ("rectangular", Some(Distribution::Rectangle)),
    ("uniform", Some(Distribution::Rectangle)),
    ("limits", Some(Distribution::Rectangle)),
    ("box", Some(Distribution::Rectangle)),
    ("log-normal", Some(Distribution::Lognormal)),
    ("log normal", Some(Distribution::Lognormal)),
    ("gauss", Some(Distribution::Normal)),
    ("gaussian", Some(Distribution::Normal)),
    ("triangle", None),
    ("triangular", None),
    ("beta", None),
    ("student", None),
];

/// The distribution in brackets at the end of a text; `None` if the bracket is part of a unit.
pub(crate) fn named(text: &str) -> Result<Option<Named>, UnitError> {
    let end = text.trim_end().len();
    let Some(inside) = text.get(..end).and_then(|text| text.strip_suffix(')')) else {
        return Ok(None);
    };
    let Some(open) = inside.rfind('(') else { return Ok(None) };
    let word = inside.get(open + 1..).unwrap_or_default().trim().to_lowercase();
    let span = open..end;
    if let Some(distribution) = Distribution::of(&word) {
        return Ok(Some(Named { distribution, span }));
    }
    match OTHERS.iter().find(|(other, _)| *other == word) {
        Some(&(_, meant)) => {
            let kind = UnitErrorKind::UnknownDistribution { word, meant };
            Err(UnitError::new(kind, span))
        }
        None => match suggest(&word, Distribution::ALL.iter().map(|known| known.word())) {
            Some(near) => {
                let meant = Distribution::of(near);
                Err(UnitError::new(UnitErrorKind::UnknownDistribution { word, meant }, span))
            }
            None => Ok(None),
        },
    }
}

#[cfg(test)]
mod tests {
    use crate::parse_quantity;

    /// Brackets of a unit are not a distribution, whatever they look like.
    #[test]
    fn a_distribution_that_is_misspelt_is_one() {
        for (text, help) in [
            ("10 ± 1 s (lognormel)", Some("write `(lognormal)`")),
            ("10 ± 1 s (rectangel)", Some("write `(rectangle)`")),
            ("10 ± 1 s (nomral)", Some("leave it out: a deviation is normal by default")),
        ] {
            let found = parse_quantity(text, None).map_err(|error| error.help());
            assert_eq!(found.err().flatten().as_deref(), help, "{text}");
        }
        assert!(parse_quantity("10 ± 1 W/(m^2 K)", None).is_ok());
    }
}
