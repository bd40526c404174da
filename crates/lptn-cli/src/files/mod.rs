//! Result files: whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use lptn_netlist::Diagnostic;
use lptn_study::{FileHash, Hashing};

use crate::exit::Exit;
use crate::failure::{Failure, reason};

/// The folder that the files of one run go to.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Makes the folder and tries to write into it, before anything is computed.
    pub(crate) fn prepare(path: PathBuf) -> Result<Self, Failure> {
        let folder = Self { path };
        let probe = folder.temporary("probe");
        let outcome = fs::create_dir_all(&folder.path).and_then(|()| File::create(&probe));
        outcome.map_err(|error| folder.cannot_create(&error))?;
        // a probe that cannot be removed does no harm
        drop(fs::remove_file(&probe));
        Ok(folder)
    }

    /// Writes a file under a temporary name, then renames it: a reader sees all of it or nothing. A file that was
    /// there keeps its owner and permissions.
    pub(crate) fn write(
        &self,
        name: &str,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<FileHash, Failure> {
        let temporary = self.temporary(name);
        let place = self.path.join(name);
        let outcome = File::create(&temporary)
            .and_then(|file| like(&place, &temporary).map(|()| file))
            .and_then(|file| write_hashed(file, content))
            .and_then(|hash| fs::rename(&temporary, &place).map(|()| hash));
        match outcome {
            Ok(sha256) => Ok(FileHash { name: name.to_owned(), sha256 }),
            Err(error) => {
                drop(fs::remove_file(&temporary));
                let message = format!("cannot write {}: {}", place.display(), reason(&error));
                let problem = Diagnostic::error("output::cannot_write", message)
                    .help("choose another folder with -o DIR, or write none with --no-files");
                Err(Failure::new(Exit::Failed, problem))
            }
        }
    }

    /// Removes the results of an earlier run, whose manifest would no longer be true.
    pub(crate) fn clear(&self, names: &[&str]) {
        for name in names {
            drop(fs::remove_file(self.path.join(name)));
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    fn temporary(&self, name: &str) -> PathBuf {
        self.path.join(format!(".{name}.{}.tmp", std::process::id()))
    }

    fn cannot_create(&self, error: &io::Error) -> Failure {
        let message = format!("cannot write into {}: {}", self.path.display(), reason(error));
        let problem = Diagnostic::error("output::cannot_create", message)
            .help("choose another folder with -o DIR, or write none with --no-files");
        Failure::new(Exit::Input, problem)
    }
}

/// Gives a new file the owner and permissions of the one whose place it takes, before anything is in it.
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
fn write_hashed(file: File, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<String> {
    let mut out = Hashing::new(BufWriter::with_capacity(1 << 16, file));
    content(&mut out)?;
    let (mut file, hash) = out.finish();
    file.flush()?;
    Ok(hash)
}
