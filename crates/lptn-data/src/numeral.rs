//! Numbers as loggers write them: a decimal comma, thousands in groups, a blank after the sign.

/// The decimal sign of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Decimal {
    /// A point. `1,234` is not a number: the comma may be a decimal one.
    #[default]
    Point,
    /// A point, as other numbers of the file show or a key says: `1,234` is 1234.
    PointOnly,
    /// A comma: `25,5`. `1.234` is 1234.
    Comma,
}

/// Decimal signs by the text of their key.
pub const DECIMALS: [(&str, Decimal); 2] = [(".", Decimal::PointOnly), (",", Decimal::Comma)];

/// A number that is not written as Rust reads one.
pub(crate) fn foreign(cell: &str, decimal: Decimal) -> Option<f64> {
    let (sign, digits) = match cell.strip_prefix(['+', '-']) {
        Some(rest) => (&cell[..1], rest.trim_start()),
        None => ("", cell),
    };
    if !digits.starts_with(|c: char| c.is_ascii_digit() || ".,".contains(c)) {
        return None;
    }
    let (point, group) = if decimal == Decimal::Comma { (',', '.') } else { ('.', ',') };
    let (whole, rest) = match digits.find([point, 'e', 'E']) {
        Some(at) => digits.split_at(at),
        None => (digits, ""),
    };
    if rest.contains(group) {
        return None;
    }
    let whole = match whole.contains(group) {
        false => whole.to_owned(),
        true if decimal != Decimal::Point || rest.starts_with(point) => grouped(whole, group)?,
        true => return None,
    };
    format!("{sign}{whole}{}", rest.replacen(point, ".", 1)).parse().ok()
}

/// The digits of a number in groups of three.
fn grouped(whole: &str, group: char) -> Option<String> {
    let mut groups = whole.split(group);
    let first = groups.next()?;
    let digits = |part: &str| part.chars().all(|c| c.is_ascii_digit());
    let sound = (1..=3).contains(&first.len()) && digits(first) && !first.starts_with('0');
    (sound && groups.all(|part| part.len() == 3 && digits(part))).then(|| whole.replace(group, ""))
}

/// The decimal signs that a cell allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shows {
    /// It has no comma.
    Nothing,
    /// It has a decimal point and no comma.
    APoint,
    /// Its comma or its point is a decimal one, or parts thousands.
    Either,
    /// Only this sign gives a number.
    Only(Decimal),
}

/// The evidence of a cell that a number may be in.
pub(crate) fn shows(cell: &str) -> Shows {
    if !cell.contains(',') {
        let digits = cell.trim_start_matches(['+', '-']);
        return match cell.contains('.') && cell.parse::<f64>().is_ok() {
            true if grouped(digits, '.').is_some() => Shows::Either,
            true => Shows::APoint,
            false => Shows::Nothing,
        };
    }
    let comma = foreign(cell, Decimal::Comma).is_some();
    match (comma, foreign(cell, Decimal::PointOnly).is_some()) {
        (true, true) => Shows::Either,
        (true, false) => Shows::Only(Decimal::Comma),
        (false, true) => Shows::Only(Decimal::PointOnly),
        (false, false) => Shows::Nothing,
    }
}

#[cfg(test)]
mod tests {
    use super::{Decimal, Shows, foreign, shows};

    #[test]
    fn signs_are_decimal_or_part_thousands() {
        let comma = |cell| foreign(cell, Decimal::Comma);
        assert_eq!(comma("25,5"), Some(25.5));
        assert_eq!(comma("-0,125"), Some(-0.125));
        assert_eq!(comma("1.234.567,5"), Some(1_234_567.5));
        assert_eq!(comma("2,5E-3"), Some(0.0025));
        assert_eq!(comma("+ 23,4"), Some(23.4));
        assert_eq!(comma("1.234"), Some(1234.0));
        for none in ["1.2345", "1,2,3", "12.34,5", "25,5 C", "", ",", "-", "inf"] {
            assert_eq!(comma(none), None, "{none}");
        }
        let point = |cell| foreign(cell, Decimal::PointOnly);
        assert_eq!(point("1,234"), Some(1234.0));
        assert_eq!(point("- 1,234.5"), Some(-1234.5));
        assert_eq!(point("25,5"), None);
        assert_eq!(foreign("1,234", Decimal::Point), None);
        assert_eq!(foreign("1,234.5", Decimal::Point), Some(1234.5));
    }

    #[test]
    fn a_cell_shows_its_decimal_sign() {
        assert_eq!(shows("25"), Shows::Nothing);
        assert_eq!(shows("25.5"), Shows::APoint);
        assert_eq!(shows("0.125"), Shows::APoint);
        assert_eq!(shows("-1.234"), Shows::Either);
        assert_eq!(shows("1,234"), Shows::Either);
        assert_eq!(shows("0,234"), Shows::Only(Decimal::Comma));
        assert_eq!(shows("25,5"), Shows::Only(Decimal::Comma));
        assert_eq!(shows("1,234.5"), Shows::Only(Decimal::PointOnly));
        assert_eq!(shows("1,234,567"), Shows::Only(Decimal::PointOnly));
    }
}
