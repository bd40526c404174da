//! Limits on input and messages, and the error of a refused file.

use std::fmt;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use lptn_units::Problem;

use crate::diagnostic::{Diagnostic, Severity, arrange};
use crate::file::{FileId, Files, Span};

/// The longest netlist in bytes; anything longer is a device or not a netlist.
pub const MOST_BYTES: u64 = 100_000_000;

/// The longest CSV file in bytes: 10^7 rows take about 300 MB.
pub const MOST_CSV_BYTES: u64 = 2_000_000_000;

/// Number of problems of one file that are shown; the rest are counted.
pub const MOST_PROBLEMS: usize = 50;

/// A netlist, a record or a sheet that cannot be used, with every reason.
#[derive(Clone, Debug)]
pub struct Rejected {
    /// The texts that places refer to.
    pub files: Files,
    /// The problems in file order, at least one error.
    pub diagnostics: Vec<Diagnostic>,
    /// True if the text is not even valid TOML.
    pub syntax: bool,
}

impl Rejected {
    /// Sorts the problems by place and keeps each once, as many as are shown; `dropped` is the
    /// number of those dropped before.
    pub fn arranged(files: Files, mut diagnostics: Vec<Diagnostic>, dropped: usize) -> Self {
        arrange(&files, &mut diagnostics);
        shorten(&mut diagnostics, dropped);
        Self { files, diagnostics, syntax: false }
    }

    /// Sorts the problems by place and keeps as many as are shown.
    pub(crate) fn new(files: Files, mut diagnostics: Vec<Diagnostic>) -> Self {
        diagnostics.sort_by_key(|diagnostic| diagnostic.place().map(Span::order));
        shorten(&mut diagnostics, 0);
        Self { files, diagnostics, syntax: false }
    }
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.diagnostics.iter().enumerate() {
            let separator = if i > 0 { "\n" } else { "" };
            write!(f, "{separator}{}", self.files.plain(diagnostic))?;
        }
        Ok(())
    }
}

impl std::error::Error for Rejected {}

impl Problem for Rejected {
    fn code(&self) -> &'static str {
        self.diagnostics.first().map_or("netlist::rejected", |first| first.code)
    }

    fn help(&self) -> Option<String> {
        self.diagnostics.first()?.help.clone()
    }
}

lptn_units::errors! {
/// Why a file cannot be used.
#[derive(Debug)]
pub enum ReadError {
    /// The file could not be read.
    Io { path: PathBuf, error: io::Error } = "io::error",
        format!("cannot read {}: {error}", path.display()), source error;
    /// Its content cannot be used.
    Rejected => Rejected;
}
}

/// The bytes of a file, which need not be text, up to [`MOST_BYTES`]; an endless input is not read
/// further.
///
/// # Errors
/// [`ReadError::Io`] if the file cannot be read; [`ReadError::Rejected`] with `netlist::too_long`
/// if it is longer, or with `netlist::not_a_file` if it is a device.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let name = path.display().to_string();
    let failed = |error| ReadError::Io { path: path.to_owned(), error };
    let kind = std::fs::metadata(path).map_err(failed)?.file_type();
    if is_device(kind) {
        let error = Diagnostic::error("netlist::not_a_file", format!("{name} is a device"));
        return Err(refused(&name, error.help("name a netlist, a TOML file")));
    }
    let file = std::fs::File::open(path).map_err(failed)?;
    match limited(file, MOST_BYTES).map_err(failed)? {
        Some(bytes) => Ok(bytes),
        None => {
            let message = format!("{name} is longer than {} MB", MOST_BYTES / 1_000_000);
            let error = Diagnostic::error("netlist::too_long", message);
            Err(refused(
                &name,
                error.help("a netlist of a million elements takes less: is this one?"),
            ))
        }
    }
}

/// The bytes of a file that a netlist names: up to [`MOST_CSV_BYTES`], for it may be a CSV file of
/// a network.
///
/// # Errors
/// That of the system, or of a device; [`io::ErrorKind::FileTooLarge`] if the file is longer.
pub fn read_named(path: &Path) -> io::Result<Vec<u8>> {
    let metadata = std::fs::metadata(path)?;
    if is_device(metadata.file_type()) {
        return Err(io::Error::other("it is a device"));
    }
    let message = format!("it is longer than {} MB", MOST_CSV_BYTES / 1_000_000);
    let too_long = || io::Error::new(io::ErrorKind::FileTooLarge, message);
    if metadata.len() > MOST_CSV_BYTES {
        return Err(too_long()); // before gigabytes are read in vain
    }
    limited(std::fs::File::open(path)?, MOST_CSV_BYTES)?.ok_or_else(too_long)
}

/// All bytes, or `None` if there are more than `most`; at most one byte more is read.
fn limited(from: impl Read, most: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    from.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

/// Pipes may be netlists, as in `lptn run <(generate)`; disks and `/dev/zero` may not.
#[cfg(unix)]
fn is_device(kind: std::fs::FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    kind.is_block_device() || kind.is_char_device()
}

#[cfg(not(unix))]
fn is_device(_: std::fs::FileType) -> bool {
    false
}

fn refused(name: &str, error: Diagnostic) -> ReadError {
    let mut files = Files::new();
    files.add(name, "");
    ReadError::Rejected(Rejected { files, diagnostics: vec![error], syntax: false })
}

/// Keeps the first problems of each file, errors before warnings. Counts the others and those
/// `dropped` before.
pub fn shorten(diagnostics: &mut Vec<Diagnostic>, dropped: usize) {
    if diagnostics.len() <= MOST_PROBLEMS && dropped == 0 {
        return;
    }
    let all = diagnostics.len();
    let mut kept: std::collections::BTreeMap<Option<FileId>, usize> =
        std::collections::BTreeMap::new();
    let mut keep = vec![false; all];
    for severity in [Severity::Error, Severity::Warning, Severity::Note] {
        for (diagnostic, keep) in diagnostics.iter().zip(&mut keep) {
            let count = kept.entry(diagnostic.place().map(|span: &Span| span.file)).or_default();
            if diagnostic.severity == severity && *count < MOST_PROBLEMS {
                *count += 1;
                *keep = true;
            }
        }
    }
    let mut keep = keep.into_iter();
    let errors_before = errors(diagnostics);
    diagnostics.retain(|_| keep.next().unwrap_or(false));
    let left = all - diagnostics.len() + dropped;
    if left > 0 {
        let message = if left == 1 {
            "and one more problem".into()
        } else {
            format!("and {left} more problems")
        };
        let more = match errors_before + dropped > errors(diagnostics) {
            true => Diagnostic::error("netlist::more", message),
            false => Diagnostic::warning("netlist::more", message),
        };
        diagnostics.push(more);
    }
}

fn errors(diagnostics: &[Diagnostic]) -> usize {
    diagnostics.iter().filter(|d| d.severity == Severity::Error).count()
}

#[cfg(test)]
mod tests {
    use super::limited;

    #[test]
    fn an_endless_input_is_read_up_to_the_limit() -> std::io::Result<()> {
        assert_eq!(limited(std::io::repeat(b'x'), 1000)?, None);
        assert_eq!(limited(&b"abc"[..], 3)?, Some(b"abc".to_vec()));
        assert_eq!(limited(&b"abcd"[..], 3)?, None);
        Ok(())
    }
}
