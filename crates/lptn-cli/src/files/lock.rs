//! One process at a time writes into a folder.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::names::LOCK;

/// The folder belongs to this process until this is dropped or the process ends.
/// The lock is one of the system and not the file, so none is ever left over.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    /// Closing it ends the lock.
    _file: File,
}

/// Why a folder cannot be had.
#[derive(Debug)]
pub(super) enum NotLocked {
    /// A process writes there; its number if that is known.
    Busy(Option<u32>),
    Io(io::Error),
}

/// Time between two attempts to lock a folder that another process uses for a moment.
const PAUSE: Duration = Duration::from_millis(20);

impl Lock {
    /// Takes the folder. If another process has it, tries again for as long as `patience`.
    pub(super) fn take(folder: &Path, patience: Duration) -> Result<Self, NotLocked> {
        let begun = Instant::now();
        loop {
            match Self::try_take(folder.join(LOCK)) {
                Err(NotLocked::Busy(_)) if begun.elapsed() < patience => std::thread::sleep(PAUSE),
                Ok(None) => {}
                Ok(Some(lock)) => return Ok(lock),
                Err(error) => return Err(error),
            }
        }
    }

    /// `None` if the file was removed between opening and locking, by the process that had it.
    fn try_take(path: PathBuf) -> Result<Option<Self>, NotLocked> {
        let options =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = options.map_err(NotLocked::Io)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(NotLocked::Busy(owner(&mut file))),
            // a file system without locks still takes results, and two processes at once are the
            // user's affair
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        if !is_at(&file, &path) {
            return Ok(None);
        }
        // for the message of the other one only
        drop(file.set_len(0).and_then(|()| write!(file, "{}", std::process::id())));
        Ok(Some(Self { path, _file: file }))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // while it is still locked: whoever waits for it sees that it is no longer there. Elsewhere
        // an open file cannot be removed safely, and stays
        if cfg!(unix) {
            drop(fs::remove_file(&self.path));
        }
    }
}

fn owner(file: &mut File) -> Option<u32> {
    let mut text = String::new();
    file.read_to_string(&mut text).ok()?;
    text.parse().ok()
}

/// True if an open file is the one at a path.
fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let identity = |metadata: &fs::Metadata| (metadata.dev(), metadata.ino());
        let both = (file.metadata(), fs::metadata(path));
        matches!(both, (Ok(a), Ok(b)) if identity(&a) == identity(&b))
    }
    #[cfg(not(unix))]
    {
        let _ = (file, path);
        true
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::{Lock, NotLocked};
    use crate::files::tests::Place;

    #[test]
    fn a_folder_is_had_by_one_at_a_time() {
        let place = Place::new();
        let lock = Lock::take(&place.0, Duration::ZERO).unwrap();
        let other = Lock::take(&place.0, Duration::ZERO).unwrap_err();
        assert!(
            matches!(other, NotLocked::Busy(Some(id)) if id == std::process::id()),
            "{other:?}"
        );
        drop(lock);
        assert_eq!(place.files(), [""; 0]);
        drop(Lock::take(&place.0, Duration::ZERO).unwrap());
    }

    /// Threads that take the folder and give it back: at no time do two have it.
    /// Its file comes and goes.
    #[test]
    fn the_file_that_comes_and_goes_is_no_way_around_it() {
        let place = Place::new();
        let within = std::sync::atomic::AtomicUsize::new(0);
        let turn = || {
            let lock = Lock::take(&place.0, Duration::from_secs(60)).unwrap();
            assert_eq!(within.fetch_add(1, std::sync::atomic::Ordering::SeqCst), 0);
            std::thread::yield_now();
            within.fetch_sub(1, std::sync::atomic::Ordering::SeqCst);
            drop(lock);
        };
        std::thread::scope(|scope| {
            (0..4).for_each(|_| drop(scope.spawn(|| (0..5).for_each(|_| turn()))));
        });
    }
}
