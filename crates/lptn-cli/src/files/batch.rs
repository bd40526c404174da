//! The files of one run on their way.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use lptn_netlist::Diagnostic;
use lptn_report::{Format, Look, Page};
use lptn_study::{FileHash, Hashing};

use super::commit::Commit;
use super::names::{COMMIT, MANIFEST, temporary};
use super::{Folder, manifest};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, reason};

/// Files under temporary names, until all of them are whole and take their places together.
/// If this is dropped before, by an error or a panic, they are removed and the old files stay.
pub(crate) struct Batch<'a> {
    folder: &'a Folder,
    /// Temporary names of every file that was begun.
    temporaries: Vec<PathBuf>,
    written: Vec<FileHash>,
    decided: bool,
}

impl<'a> Batch<'a> {
    pub(super) fn new(folder: &'a Folder) -> Self {
        Self { folder, temporaries: Vec::new(), written: Vec::new(), decided: false }
    }

    /// Writes one file. It gets the owner and the permissions of the one that it replaces.
    pub(crate) fn write(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let place = self.folder.path.join(name);
        if place.is_dir() {
            return Err(self.cannot_write(name, &io::ErrorKind::IsADirectory.into()));
        }
        let path = self.folder.path.join(temporary(name, std::process::id()));
        self.temporaries.push(path.clone());
        let outcome = File::create(&path)
            .and_then(|file| like(&place, &path).map(|()| file))
            .and_then(|file| write_hashed(file, content));
        let sha256 = outcome.map_err(|error| self.cannot_write(name, &error))?;
        self.written.push(FileHash { name: name.to_owned(), sha256 });
        Ok(())
    }

    /// Writes a page, without colours.
    pub(crate) fn page(
        &mut self,
        name: &str,
        page: &dyn Page,
        format: Format,
    ) -> Result<(), Failure> {
        self.write(name, |mut out| lptn_report::write(page, format, Look::PLAIN, &mut out))
    }

    /// Writes the manifest of the files that are written up to now.
    pub(crate) fn manifest(&mut self, inputs: &[FileHash], wall_time: f64) -> Result<(), Failure> {
        let text = manifest(inputs, &self.written, wall_time);
        self.write(MANIFEST, |out| out.write_all(format!("{text:#}\n").as_bytes()))
    }

    /// The files that are written up to now.
    pub(crate) fn written(&self) -> &[FileHash] {
        &self.written
    }

    /// Puts every file into its place, and removes files of an earlier run.
    /// These are the names in `ours`, which runs of this kind write, without those of this run.
    pub(crate) fn commit(mut self, ours: &[&str]) -> Result<(), Failure> {
        let rename: Vec<String> = self.written.iter().map(|file| file.name.clone()).collect();
        let is_over = |name: &&&str| {
            !rename.iter().any(|own| own == **name) && self.folder.path.join(name).exists()
        };
        let remove = ours.iter().filter(is_over).map(|name| (*name).to_owned()).collect();
        let commit = Commit { process: std::process::id(), rename, remove };
        let outcome = commit.carry_out(&self.folder.path);
        // a commit that is decided is left for the next process to finish
        self.decided = outcome.is_ok() || self.folder.path.join(COMMIT).exists();
        outcome.map_err(|error| self.cannot_write("", &error))
    }

    fn cannot_write(&self, name: &str, error: &io::Error) -> Failure {
        let message =
            format!("cannot write {}: {}", self.folder.path.join(name).display(), reason(error));
        let problem = Diagnostic::error("output::cannot_write", message)
            .help("choose another folder with -o DIR, or write none with --no-files");
        Failure::new(Exit::Failed, problem)
    }
}

impl Drop for Batch<'_> {
    fn drop(&mut self) {
        for path in self.temporaries.iter().filter(|_| !self.decided) {
            drop(fs::remove_file(path));
        }
    }
}

/// Gives a new file the owner and permissions of the one that it replaces, before it is written.
fn like(old: &Path, new: &Path) -> io::Result<()> {
    let Ok(old) = fs::metadata(old) else { return Ok(()) };
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt as _, chown};
        // only root may give a file away
        drop(chown(new, Some(old.uid()), Some(old.gid())));
    }
    fs::set_permissions(new, old.permissions())
}

/// Writes a file and gives the SHA-256 of its content.
fn write_hashed(
    file: File,
    content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<String> {
    let mut out = Hashing::new(BufWriter::with_capacity(1 << 16, file));
    content(&mut out)?;
    let (mut file, hash) = out.finish();
    file.flush()?;
    Ok(hash)
}
