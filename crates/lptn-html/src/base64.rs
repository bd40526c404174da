//! Bytes as letters (RFC 4648).

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Four letters for three bytes.
pub(crate) fn base64(bytes: &[u8]) -> String {
    let of_three = |three: &[u8]| {
        let number = (0..3)
            .fold(0, |sum, i| (sum << 8) | u32::from(three.get(i).copied().unwrap_or_default()));
        let letter = |i: usize| match i <= three.len() {
            true => LETTERS[(number >> (18 - 6 * i)) as usize & 63] as char,
            false => '=',
        };
        [letter(0), letter(1), letter(2), letter(3)]
    };
    bytes.chunks(3).flat_map(of_three).collect()
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base64_is_that_of_the_standard() {
        let found = ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes()));
        assert_eq!(found, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }
}
