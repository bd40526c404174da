//! The texts of CSV files.

use std::sync::Arc;

use crate::decode::{Encoding, decode};
use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Files, Span};

/// The text of a CSV file.
#[derive(Clone, Debug)]
pub struct CsvText {
    /// The text among others.
    pub file: FileId,
    /// The name that diagnostics show.
    pub name: String,
    /// The content.
    pub text: Arc<str>,
    /// The encoding of the file.
    pub encoding: Encoding,
}

impl CsvText {
    /// Keeps the text among others.
    ///
    /// # Errors
    /// If the bytes are not text in UTF-8, UTF-16 or Windows-1252.
    pub fn of(files: &mut Files, name: String, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let Some((text, encoding)) = decode(bytes) else {
            return Err(Self::refused(files, &name, bytes));
        };
        let text: Arc<str> = text.into();
        let file = match encoding {
            Encoding::Utf8 => files.add(name.as_str(), Arc::clone(&text)),
            _ => files.add_decoded(&name, Arc::clone(&text), bytes),
        };
        Ok(Self { file, name, text, encoding })
    }

    /// The error of bytes that are not text in UTF-8.
    pub(crate) fn refused(files: &mut Files, name: &str, bytes: &[u8]) -> Diagnostic {
        let text = String::from_utf8_lossy(bytes).replace('\0', " ");
        let file = files.add(name, text);
        not_text(files, file, (name, bytes))
    }
}

/// The error of a file that is not text in UTF-8.
fn not_text(files: &Files, file: FileId, (name, bytes): (&str, &[u8])) -> Diagnostic {
    let text = files.text(file);
    let at = text.find(char::REPLACEMENT_CHARACTER).unwrap_or(0);
    let end = at + text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    let wide = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    let sheet = bytes.starts_with(b"PK\x03\x04");
    let why = match (wide, sheet) {
        (true, _) => ": it looks like UTF-16",
        (_, true) => ": it looks like a workbook or a zip file",
        _ => "",
    };
    // the degree sign of the encodings of Western Europe
    let degree = bytes.contains(&0xb0) || bytes.contains(&0xf8);
    let help = match degree && !wide && !sheet {
        true => "write `degC` for the degree sign, or save it as `CSV UTF-8`",
        false => "choose `CSV UTF-8` when your program saves it",
    };
    Diagnostic::error("netlist::not_text", format!("{name} is not a text file in UTF-8{why}"))
        .at(Span::new(file, at..end), "")
        .help(help)
}
