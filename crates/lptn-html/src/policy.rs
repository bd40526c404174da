//! Policy of the page: it runs its own two scripts and nothing else.

/// Hashes of the scripts as `Content-Security-Policy` writes them; a test checks them.
const SCRIPTS: [&str; 2] = [
    "sha256-RAis6RoYtIiJmBceEi2mW5qyhxHDDxmmpZFJHFqCyvE=",
    "sha256-rpNP9Qydw5LAUQCpFQIm8rkWDpXEwHkmYxzHxWvWurg=",
];

/// The policy: nothing is loaded from anywhere.
pub(crate) fn content() -> String {
    let [charts, page] = SCRIPTS;
    format!("default-src 'none'; style-src 'unsafe-inline'; script-src '{charts}' '{page}'")
}

#[cfg(test)]
mod tests {
    use sha2::{Digest as _, Sha256};

    use super::SCRIPTS;
    use crate::page::{SCRIPT, UPLOT};

    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

    /// RFC 4648.
    fn base64(bytes: &[u8]) -> String {
        let of_three = |three: &[u8]| {
            let number = (0..3).fold(0, |sum, i| {
                (sum << 8) | u32::from(three.get(i).copied().unwrap_or_default())
            });
            let letter = |i: usize| match i <= three.len() {
                true => LETTERS[(number >> (18 - 6 * i)) as usize & 63] as char,
                false => '=',
            };
            [letter(0), letter(1), letter(2), letter(3)]
        };
        bytes.chunks(3).flat_map(of_three).collect()
    }

    #[test]
    fn base64_is_that_of_the_standard() {
        let found = ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes()));
        assert_eq!(found, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }

    /// A browser refuses a script whose hash differs.
    #[test]
    fn the_scripts_are_those_that_the_policy_names() {
        let hash = |script: &str| format!("sha256-{}", base64(&Sha256::digest(script.as_bytes())));
        assert_eq!(SCRIPTS, [UPLOT, SCRIPT].map(hash));
    }
}
