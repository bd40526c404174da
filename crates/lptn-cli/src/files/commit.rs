//! Puts results under temporary names into their places, all of them or none, even if the process
//! ends on the way.
//!
//! Every file replaces the old one by a rename, so none is ever half written. But several renames
//! are several moments: a process that is killed between two of them would leave new results next
//! to old ones. So the files to rename and to remove are recorded first, under a name that itself
//! appears by a rename. Before that moment the old results are valid and the new ones are waste.
//! After it the new ones are valid, and the next process that writes into the folder completes the
//! commit. Until then the record is visible, and the manifest, which is renamed last, names hashes
//! that are not those of the new files.
//!
//! An exchange of folders would need `unsafe` and would move the user's own files as well. Nothing
//! is synced: this protects against the end of a process, not against a loss of power. The lock
//! belongs to the system; its file is only a handle.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

use serde_json::{Value, json};

use super::names::{COMMIT, is_result, temporary};

/// Renames and removals that are to be done.
#[derive(Debug, PartialEq)]
pub(super) struct Commit {
    /// The process in the temporary names.
    pub(super) process: u32,
    /// The files that take their places, in this order.
    pub(super) rename: Vec<String>,
    /// Files of an earlier run that this one does not have.
    pub(super) remove: Vec<String>,
}

impl Commit {
    /// Does it. From its first step on it will be completed, by this process or by the next.
    pub(super) fn carry_out(&self, folder: &Path) -> io::Result<()> {
        if self.rename.len() + self.remove.len() == 1 {
            return self.apply(folder);
        }
        let record = folder.join(temporary(COMMIT, self.process));
        let written = fs::write(&record, format!("{:#}\n", self.json()));
        written
            .and_then(|()| fs::rename(&record, folder.join(COMMIT)))
            .inspect_err(|_| drop(fs::remove_file(&record)))?;
        self.apply(folder)?;
        fs::remove_file(folder.join(COMMIT))
    }

    /// Completes the commit of a process that was killed on the way.
    /// A step that fails now would fail later too.
    pub(super) fn finish(folder: &Path) {
        let place = folder.join(COMMIT);
        let Ok(text) = fs::read_to_string(&place) else { return };
        if let Some(mut commit) =
            serde_json::from_str(&text).ok().and_then(|record| Self::read(&record))
        {
            commit.rename.retain(|name| folder.join(temporary(name, commit.process)).exists());
            drop(commit.apply(folder));
        }
        drop(fs::remove_file(place));
    }

    /// Renames and removes; the first error does not stop the rest.
    fn apply(&self, folder: &Path) -> io::Result<()> {
        let rename = |name: &String| {
            fs::rename(folder.join(temporary(name, self.process)), folder.join(name))
        };
        let renames = self.rename.iter().map(rename);
        let removals =
            self.remove.iter().map(|name| unless_missing(fs::remove_file(folder.join(name))));
        renames.chain(removals).fold(Ok(()), io::Result::and)
    }

    fn json(&self) -> Value {
        let Self { process, rename, remove, .. } = self;
        json!({ "format": 1, "process": process, "rename": rename, "remove": remove })
    }

    /// The record; `None` if it is not one, or if it names a file that is not a result.
    fn read(record: &Value) -> Option<Self> {
        let names = |key: &str| -> Option<Vec<String>> {
            let name =
                |value: &Value| value.as_str().filter(|name| is_result(name)).map(str::to_owned);
            record[key].as_array()?.iter().map(name).collect()
        };
        let process = u32::try_from(record["process"].as_u64()?).ok()?;
        Some(Self { process, rename: names("rename")?, remove: names("remove")? })
    }
}

fn unless_missing(outcome: io::Result<()>) -> io::Result<()> {
    outcome.or_else(|error| if error.kind() == ErrorKind::NotFound { Ok(()) } else { Err(error) })
}

#[cfg(test)]
mod tests {
    use super::Commit;
    use crate::files::names::{COMMIT, EVENTS, MANIFEST, RESULT, WINDOWS, temporary};
    use crate::files::tests::Place;

    /// A process that was killed after the first of two renames.
    #[test]
    fn the_next_process_finishes_what_was_decided() {
        let place = Place::new();
        let [rename, remove] = [vec![RESULT, MANIFEST], vec![WINDOWS, EVENTS]];
        let own = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
        let commit = Commit { process: 17, rename: own(rename), remove: own(remove) };
        assert_eq!(Commit::read(&commit.json()).as_ref(), Some(&commit));
        place.write(COMMIT, &commit.json().to_string());
        place.write(RESULT, "new");
        place.write(MANIFEST, "old");
        place.write(WINDOWS, "old");
        place.write(&temporary(MANIFEST, 17), "new");
        Commit::finish(&place.0);
        assert_eq!(place.files(), [MANIFEST, RESULT]);
        assert_eq!((place.read(MANIFEST), place.read(RESULT)), ("new".into(), "new".into()));
    }

    /// A record that someone puts into a folder cannot move or remove other files.
    #[test]
    fn records_of_other_files_are_not_followed() {
        let place = Place::new();
        place.write("thesis.csv", "years");
        let record = r#"{ "format": 1, "process": 1, "rename": [], "remove": ["thesis.csv"] }"#;
        for text in [record, "half a rec", "[]"] {
            place.write(COMMIT, text);
            Commit::finish(&place.0);
            assert_eq!(place.files(), ["thesis.csv"]);
        }
    }
}
