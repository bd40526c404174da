//! The font of pictures: Arimo, as wide as Arial and Helvetica, so that a viewer without it shows
//! the same layout. Reduced to Latin, Greek and a few signs; `font/OFL.txt` is its licence.
//!
//! Texts are measured with Arimo, so that they fit in viewers that have Arial only.

use ttf_parser::Face;

const REGULAR: &[u8] = include_bytes!("../font/Arimo-Regular-subset.ttf");
const BOLD: &[u8] = include_bytes!("../font/Arimo-Bold-subset.ttf");

/// Width of a character that the font does not have, as a share of the font size.
const UNKNOWN: f64 = 0.6;

/// The regular or bold font.
pub(crate) fn face(bold: bool) -> Option<Face<'static>> {
    Face::parse(if bold { BOLD } else { REGULAR }, 0).ok()
}

/// Width of a text in pixels for a size of the font.
pub fn width(text: &str, size: f64, bold: bool) -> f64 {
    let Some(face) = face(bold) else {
        return UNKNOWN * size * text.chars().count() as f64;
    };
    let em = f64::from(face.units_per_em());
    let advance = |c: char| {
        let glyph = face.glyph_index(c)?;
        Some(f64::from(face.glyph_hor_advance(glyph)?) / em)
    };
    size * text.chars().map(|c| advance(c).unwrap_or(UNKNOWN)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::width;

    /// Adobe's metrics of Helvetica: H 722, o 556, t 278, space 278, 0 556; of Helvetica Bold: H
    /// 722, o 611, t 333 thousandths of the size.
    #[test]
    fn widths_are_those_of_helvetica() {
        for (bold, expected) in
            [(false, 722 + 556 + 278 + 278 + 556), (true, 722 + 611 + 333 + 278 + 556)]
        {
            let found = width("Hot 0", 1000.0, bold);
            assert!((found - f64::from(expected)).abs() < 3.0, "{found} {expected}");
        }
    }

    #[test]
    fn units_and_names_have_their_letters() {
        for text in ["°C ± Δ α τ Ω µ · − ≤ ² ₁ – …", "Überströmung", "kΩ/m²"]
        {
            let face = super::face(false).unwrap();
            let missing: String = text.chars().filter(|&c| face.glyph_index(c).is_none()).collect();
            assert_eq!(missing, "", "{text}");
        }
    }
}
