//! Doubts in several netlists or records, as those of one answer.

use lptn_netlist::{Diagnostic, FileId, Files, Span};

/// Doubts whose places are in one set of files.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gathered {
    /// The texts that places are in.
    pub(crate) files: Files,
    /// The doubts, in the order in which they were added.
    pub(crate) doubts: Vec<Diagnostic>,
}

impl Gathered {
    /// Adds doubts with places in other files, and copies the texts of these places.
    pub(crate) fn add(&mut self, files: &Files, doubts: &[Diagnostic]) {
        let mut known: Vec<(FileId, FileId)> = Vec::new();
        for doubt in doubts {
            let mut doubt = doubt.clone();
            for label in &mut doubt.labels {
                let old = label.span.file;
                let found = known.iter().find(|(other, _)| *other == old).map(|(_, new)| *new);
                let new = found.unwrap_or_else(|| {
                    let new = self.files.add(files.name(old), files.text(old));
                    known.push((old, new));
                    new
                });
                label.span = Span::new(new, label.span.range.clone());
            }
            self.doubts.push(doubt);
        }
    }
}

#[cfg(test)]
mod tests {
    use lptn_netlist::{Diagnostic, Files, Span};

    use super::Gathered;

    #[test]
    fn places_stay_in_their_texts() {
        let mut gathered = Gathered::default();
        for text in ["first", "second"] {
            let mut files = Files::new();
            files.add("other.toml", "before it");
            let file = files.add("a.toml", text);
            let doubt = Diagnostic::warning("fit::drift", "").at(Span::new(file, 1..3), "");
            gathered.add(&files, &[doubt.clone(), doubt]);
        }
        let texts: Vec<&str> =
            gathered.doubts.iter().map(|d| gathered.files.at(d.place().unwrap())).collect();
        assert_eq!(texts, ["ir", "ir", "ec", "ec"]);
    }
}
