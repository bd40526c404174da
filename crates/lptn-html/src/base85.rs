//! Bytes as letters, five for four bytes: 16 letters for every 17 of base64.
//!
//! As Adobe's Ascii85 (PostScript Language Reference, 3rd ed., section 3.13.3), with letters that
//! mean nothing in HTML and in scripts, and without its short form of zeros.

/// The letters from `!` to `~` but nine.
fn letters() -> Vec<char> {
    ('!'..='~').filter(|letter| !"\"$&'<>\\`~".contains(*letter)).collect()
}

/// Five letters for four bytes; of the last one to three bytes one letter more than bytes.
pub(crate) fn base85(bytes: &[u8]) -> String {
    let letters = letters();
    let of_four = |four: &[u8]| {
        let number = (0..4)
            .fold(0, |sum, i| (sum << 8) | u32::from(four.get(i).copied().unwrap_or_default()));
        let places = [85_u32.pow(4), 85_u32.pow(3), 85_u32.pow(2), 85, 1];
        places.map(|place| letters[(number / place % 85) as usize]).into_iter().take(four.len() + 1)
    };
    bytes.chunks(4).flat_map(of_four).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a letter that is none has failed")]

    use super::{base85, letters};

    /// The letters of Ascii85, from `!` to `u`, of these ones.
    fn adobe(text: &str) -> String {
        let letters = letters();
        let place = |letter: char| letters.iter().position(|known| *known == letter).unwrap();
        base85(text.as_bytes()).chars().map(|l| (b'!' + place(l) as u8) as char).collect()
    }

    /// "Man " is `9jqo^` and "sure." is `F*2M7/c` in Ascii85, by Python's `base64.a85encode` too.
    #[test]
    fn base85_is_ascii85_in_other_letters() {
        assert_eq!(letters().len(), 85);
        assert_eq!(adobe("Man "), "9jqo^");
        assert_eq!(adobe("sure."), "F*2M7/c");
        assert_eq!(base85(&[]), "");
    }
}
