//! The texts to which diagnostics refer.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// One text of a [`Files`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

/// A place in a text: a range of bytes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// The text.
    pub file: FileId,
    /// The bytes.
    pub range: Range<usize>,
    /// The instance of a template for which the text is read.
    pub copy: CopyId,
}

/// An instance of a template, for which the template's text is read once more; or the text itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CopyId(u32);

impl CopyId {
    /// The text itself.
    pub const WRITTEN: Self = Self(0);

    /// The position among the instances; `None` for the text itself.
    pub fn index(self) -> Option<usize> {
        (self.0 as usize).checked_sub(1)
    }
}

impl Span {
    /// A place in `file`.
    pub fn new(file: FileId, range: Range<usize>) -> Self {
        Self { file, range, copy: CopyId::WRITTEN }
    }

    /// Other bytes of the same text, read for the same instance.
    pub fn with(&self, range: Range<usize>) -> Self {
        Self { range, ..self.clone() }
    }

    /// The same place, read for an instance.
    pub fn for_copy(&self, copy: CopyId) -> Self {
        Self { copy, ..self.clone() }
    }

    /// True if it is the same place, for any instance.
    pub fn is_same_text(&self, other: &Self) -> bool {
        self.file == other.file && self.range == other.range
    }

    /// True if it lies inside another place.
    pub fn is_inside(&self, other: &Self) -> bool {
        self.file == other.file
            && other.range.start <= self.range.start
            && self.range.end <= other.range.end
    }

    /// The sort key for the order in which a reader meets places.
    pub fn order(&self) -> (FileId, usize, usize) {
        (self.file, self.range.start, self.range.end)
    }
}

/// The range, inside the text and on borders of characters.
pub fn on_borders(text: &str, range: Range<usize>) -> Range<usize> {
    let mut start = range.start.min(text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let mut end = range.end.clamp(start, text.len());
    while !text.is_char_boundary(end) {
        end += 1;
    }
    start..end
}

#[derive(Clone, Debug)]
struct File {
    name: String,
    /// Shared with the readers of places: an imported file is long.
    text: Arc<str>,
    /// The content of the file, if that is not the text in UTF-8.
    bytes: Option<Arc<[u8]>>,
    /// Byte at which each line begins; computed when a place is first needed.
    lines: OnceLock<Vec<usize>>,
}

impl File {
    fn lines(&self) -> &[usize] {
        let count = || {
            std::iter::once(0).chain(self.text.match_indices('\n').map(|(at, _)| at + 1)).collect()
        };
        self.lines.get_or_init(count)
    }
}

/// An instance of a template.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Its name, `planet[2]`.
    pub name: String,
    /// The place that makes it: the name below `[use]`.
    pub made: Span,
}

/// All texts that a netlist was read from. The text of `--set` is one of them.
#[derive(Clone, Debug, Default)]
pub struct Files {
    files: Vec<File>,
    copies: Vec<Instance>,
}

impl Files {
    /// No texts.
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps a text under the name that diagnostics show.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>) -> FileId {
        // A netlist has a handful of files; the last id is shared in the absurd case of 2^32.
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        let (name, text) = (name.into(), text.into());
        self.files.push(File { name, text, bytes: None, lines: OnceLock::new() });
        id
    }

    /// Keeps a text that was decoded from these bytes.
    pub(crate) fn add_decoded(&mut self, name: &str, text: Arc<str>, bytes: &[u8]) -> FileId {
        let id = self.add(name, text);
        if let Some(file) = self.files.last_mut() {
            file.bytes = Some(bytes.into());
        }
        id
    }

    /// The content of the file of a text; empty for an id of other files.
    pub fn bytes(&self, id: FileId) -> &[u8] {
        self.get(id).map_or(&[], |file| file.bytes.as_deref().unwrap_or(file.text.as_bytes()))
    }

    /// Notes an instance of a template.
    pub fn add_copy(&mut self, name: String, made: Span) -> CopyId {
        self.copies.push(Instance { name, made });
        // a larger number of instances is refused earlier
        CopyId(u32::try_from(self.copies.len()).unwrap_or(u32::MAX))
    }

    /// The instance for which a place is read; `None` for the text itself.
    pub fn copy(&self, id: CopyId) -> Option<&Instance> {
        self.copies.get(id.index()?)
    }

    /// The texts, in the order they were added.
    pub fn ids(&self) -> impl Iterator<Item = FileId> + use<> {
        (0..u32::try_from(self.files.len()).unwrap_or(u32::MAX)).map(FileId)
    }

    /// The name of a text; empty for an id of other files.
    pub fn name(&self, id: FileId) -> &str {
        self.get(id).map_or("", |file| &file.name)
    }

    /// The text; empty for an id of other files.
    pub fn text(&self, id: FileId) -> &str {
        self.get(id).map_or("", |file| &file.text)
    }

    /// The text at a place; empty if there is none.
    pub fn at(&self, span: &Span) -> &str {
        self.text(span.file).get(span.range.clone()).unwrap_or("")
    }

    /// Line and column at which a place begins, both from 1; the column counts characters.
    pub fn line_column(&self, span: &Span) -> (usize, usize) {
        let Some(file) = self.get(span.file) else { return (1, 1) };
        let lines = file.lines();
        let line = lines.partition_point(|&start| start <= span.range.start);
        let start = line.checked_sub(1).and_then(|i| lines.get(i)).copied().unwrap_or(0);
        let before = file.text.get(start..span.range.start).unwrap_or("");
        // a reader does not see a byte order mark
        let before = before.strip_prefix('\u{feff}').unwrap_or(before);
        (line.max(1), before.chars().count() + 1)
    }

    fn get(&self, id: FileId) -> Option<&File> {
        self.files.get(id.0 as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{Files, Span};

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let mut files = Files::new();
        let id = files.add("a.toml", "µ = 1\r\nb = \"°C\"\n");
        let at = |start| files.line_column(&Span::new(id, start..start));
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(3), (1, 3));
        assert_eq!(at(8), (2, 1));
        assert_eq!(at(files.text(id).len()), (3, 1));
    }
}
