//! The encoding of a text file: UTF-8, UTF-16, or the Western European one of Windows.
//!
//! Loggers write the degree sign and umlauts in the encoding of their country. A text that is not
//! UTF-8 is taken for Windows-1252 only if every byte is a character of it. Other single-byte
//! encodings differ in letters and in the degree sign; a unit with a wrong sign is refused as
//! unknown, and numbers are the same in all of them.

use std::borrow::Cow;

/// The encoding of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-8, with or without a byte order mark.
    #[default]
    Utf8,
    /// UTF-16 of either byte order.
    Utf16,
    /// Windows-1252, which contains Latin-1.
    Windows1252,
}

impl Encoding {
    /// Its name, if it is not UTF-8.
    pub(crate) fn foreign(self) -> Option<&'static str> {
        match self {
            Self::Utf8 => None,
            Self::Utf16 => Some("UTF-16"),
            Self::Windows1252 => Some("Windows-1252"),
        }
    }
}

/// The characters of the bytes 0x80 to 0x9f in Windows-1252; those without one are `\0`.
const UPPER: [char; 32] = [
    '€', '\0', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\0', 'Ž', '\0', '\0', '‘',
    '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\0', 'ž', 'Ÿ',
];

/// The text of a file; `None` if the bytes are not a text.
pub(crate) fn decode(bytes: &[u8]) -> Option<(Cow<'_, str>, Encoding)> {
    if let Ok(text) = std::str::from_utf8(bytes)
        && !text.contains('\0')
    {
        return Some((Cow::Borrowed(text), Encoding::Utf8));
    }
    if let Some(text) = wide(bytes) {
        return Some((Cow::Owned(text), Encoding::Utf16));
    }
    let marked = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    let text = if marked { None } else { western(bytes) };
    Some((Cow::Owned(text?), Encoding::Windows1252))
}

/// Number of bytes in which the zeros of UTF-16 without a byte order mark are counted.
const PROBE: usize = 200;

/// A text in UTF-16. Without a byte order mark, most of its first characters have to be ASCII.
fn wide(bytes: &[u8]) -> Option<String> {
    let (little, rest) = match bytes {
        [0xff, 0xfe, rest @ ..] => (true, rest),
        [0xfe, 0xff, rest @ ..] => (false, rest),
        _ => {
            let probe = &bytes[..bytes.len().min(PROBE)];
            let zeros = |odd: usize| probe.iter().skip(odd).step_by(2).filter(|b| **b == 0).count();
            match (zeros(0), zeros(1)) {
                (0, odd) if 3 * odd > probe.len() => (true, bytes),
                (even, 0) if 3 * even > probe.len() => (false, bytes),
                _ => return None,
            }
        }
    };
    let pairs = rest.chunks_exact(2);
    if !pairs.remainder().is_empty() {
        return None;
    }
    let unit = |pair: &[u8]| match little {
        true => u16::from_le_bytes([pair[0], pair[1]]),
        false => u16::from_be_bytes([pair[0], pair[1]]),
    };
    let units: Vec<u16> = pairs.map(unit).collect();
    String::from_utf16(&units).ok().filter(|text| !text.contains('\0'))
}

fn western(bytes: &[u8]) -> Option<String> {
    let control = |byte: u8| byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c);
    let character = |byte: &u8| match *byte {
        byte if control(byte) || byte == 0x7f => None,
        byte @ 0x80..0xa0 => {
            Some(UPPER[usize::from(byte - 0x80)]).filter(|character| *character != '\0')
        }
        byte => Some(char::from(byte)),
    };
    bytes.iter().map(character).collect()
}

#[cfg(test)]
mod tests {
    use super::{Encoding, decode};

    fn read(bytes: &[u8]) -> Option<(String, Encoding)> {
        decode(bytes).map(|(text, encoding)| (text.into_owned(), encoding))
    }

    /// Bytes of "°C €\n" by the code charts of Unicode and of Windows-1252.
    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "a °C €\n";
        assert_eq!(read(text.as_bytes()), Some((text.into(), Encoding::Utf8)));
        let western = b"a \xb0C \x80\n";
        assert_eq!(read(western), Some((text.into(), Encoding::Windows1252)));
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for (mark, bytes) in
            [(&[0xff_u8, 0xfe][..], &little), (&[0xfe, 0xff], &big), (&[], &little)]
        {
            let bytes = [mark, bytes].concat();
            assert_eq!(read(&bytes), Some((text.into(), Encoding::Utf16)), "{mark:?}");
        }
    }

    #[test]
    fn other_bytes_are_no_text() {
        assert_eq!(read(b"PK\x03\x04\xff"), None);
        assert_eq!(read(b"a\0b"), None);
        assert_eq!(read(b"\xff\xfea"), None);
        assert_eq!(read(b"caf\x81"), None);
    }
}
