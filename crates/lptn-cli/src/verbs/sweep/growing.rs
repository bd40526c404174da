//! The file of a sweep while it grows: rows are written as soon as they are known.
//! A process that is killed leaves whole rows and at most one partial one.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use lptn_netlist::Diagnostic;
use lptn_study::Hashing;
use serde_json::Value;

use crate::files::names::{BEGUN, MANIFEST, SWEEP, UNFINISHED};
use crate::files::{self, Folder};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, reason};
use lptn_answer::sweep::{Lines, SweepAsked, Tally, damaged, read_row};

/// The rows up to now, and the hash of the file.
pub(crate) struct Growing {
    path: PathBuf,
    file: Hashing<File>,
}

/// The part of a sweep that exists in a folder.
pub(crate) enum Found {
    /// Nothing: it begins.
    Nothing,
    /// Some rows.
    Rows,
    /// All of them.
    Whole,
}

impl Found {
    /// The part of this sweep that the folder contains.
    pub(crate) fn of(folder: &Folder, asked: &SweepAsked, resume: bool) -> Result<Self, Failure> {
        let (part, whole) = (folder.path().join(UNFINISHED), folder.path().join(SWEEP));
        if part.exists() {
            if !resume {
                let message = format!(
                    "{} contains a sweep that was \
                    stopped",
                    folder.path().display()
                );
                let help = "add --resume to go on with it, remove sweep.csv.part to start again, \
                            or choose another folder with -o DIR";
                return Err(Failure::refused("sweep::unfinished", message, help));
            }
            same(asked, &folder.path().join(BEGUN), |begun| begun)?;
            return Ok(Self::Rows);
        }
        if resume && whole.exists() {
            same(asked, &folder.path().join(MANIFEST), |manifest| &manifest["sweep"])?;
            return Ok(Self::Whole);
        }
        Ok(Self::Nothing)
    }
}

/// Refuses rows of another sweep.
fn same(asked: &SweepAsked, file: &Path, of: fn(&Value) -> &Value) -> Result<(), Failure> {
    let text = fs::read_to_string(file).unwrap_or_default();
    let known: Value = serde_json::from_str(&text).unwrap_or_default();
    let (known, now) = (of(&known), asked.record());
    let same = ["identity", "first", "last"].iter().all(|key| known[key] == now[key]);
    if same {
        return Ok(());
    }
    let folder = file.parent().unwrap_or(Path::new(".")).display();
    let message = format!(
        "{folder} contains rows of another sweep: the netlist, its files, the parameters that are \
         set, the version of lptn or the part differ"
    );
    let help = "choose another folder with -o DIR, or remove that one";
    Err(Failure::refused("sweep::other_inputs", message, help))
}

fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let message = format!("cannot write {}: {}", path.display(), reason(error));
    let help = "the rows that are there are kept: make room and add --resume, or choose another \
                folder with -o DIR";
    Failure::new(Exit::Failed, Diagnostic::error("output::cannot_write", message).help(help))
}

impl Growing {
    /// Begins with the heading.
    pub(crate) fn begin(folder: &Folder, asked: &SweepAsked) -> Result<Self, Failure> {
        let mut batch = folder.batch();
        let text = format!("{:#}\n", asked.record());
        batch.write(BEGUN, |out| out.write_all(text.as_bytes()))?;
        batch.commit(&[])?;
        let path = folder.path().join(UNFINISHED);
        let file = File::create(&path).map_err(|error| cannot_write(&path, &error))?;
        let mut growing = Self { path, file: Hashing::new(file) };
        growing.write(&asked.heading())?;
        Ok(growing)
    }

    /// Continues after the last whole row, and returns the number of the next case.
    /// `tally` takes in all rows up to there.
    pub(crate) fn go_on(
        folder: &Folder,
        asked: &SweepAsked,
        tally: &mut Tally,
    ) -> Result<(Self, u64), Failure> {
        let path = folder.path().join(UNFINISHED);
        let open = || OpenOptions::new().read(true).write(true).open(&path);
        let file = open().map_err(|error| cannot_write(&path, &error))?;
        let mut growing = Self { file: Hashing::new(file), path };
        let mut next = asked.range.start;
        let mut length = 0;
        let mut lines = Lines::open(&growing.path)?;
        if let Some(first) = lines.next_line()? {
            if first != asked.heading() {
                return Err(damaged(&growing.path, 1));
            }
            growing.file.holds(&first);
            length += first.len() as u64;
        }
        let shape = asked.shape();
        while let Some(line) = lines.next_line()? {
            let row = read_row(&line, shape).filter(|row| row.case == next);
            let row = row.ok_or_else(|| damaged(&growing.path, next - asked.range.start + 2))?;
            tally.row(&row);
            growing.file.holds(&line);
            length += line.len() as u64;
            next += 1;
        }
        growing.cut(length)?;
        if length == 0 {
            growing.write(&asked.heading())?;
        }
        Ok((growing, next))
    }

    /// Cuts off everything after this many bytes.
    fn cut(&mut self, length: u64) -> Result<(), Failure> {
        let file = self.file.inner();
        let cut = file.set_len(length).and_then(|()| file.seek(SeekFrom::Start(length)));
        cut.map(drop).map_err(|error| cannot_write(&self.path, &error))
    }

    /// Adds rows.
    pub(crate) fn write(&mut self, rows: &[u8]) -> Result<(), Failure> {
        self.file.write_all(rows).map_err(|error| cannot_write(&self.path, &error))
    }

    /// Puts the file in its place, with its manifest.
    /// If the process is killed on the way, all rows are under the unfinished name, or in place.
    pub(crate) fn finish(
        self,
        folder: &Folder,
        asked: &SweepAsked,
        wall_time: f64,
    ) -> Result<(), Failure> {
        let (file, sha256) = self.file.finish();
        drop(file);
        let results = [lptn_study::FileHash { name: SWEEP.to_owned(), sha256 }];
        let mut manifest = files::manifest(&asked.inputs(), &results, wall_time);
        manifest["sweep"] = asked.record();
        write_manifest(folder, &manifest)?;
        let place = folder.path().join(SWEEP);
        fs::rename(&self.path, &place).map_err(|error| cannot_write(&place, &error))?;
        drop(fs::remove_file(folder.path().join(BEGUN)));
        Ok(())
    }
}

/// Writes the manifest at once and whole.
pub(crate) fn write_manifest(folder: &Folder, manifest: &Value) -> Result<(), Failure> {
    let mut batch = folder.batch();
    let text = format!("{manifest:#}\n");
    batch.write(MANIFEST, |out| out.write_all(text.as_bytes()))?;
    batch.commit(&[])
}
