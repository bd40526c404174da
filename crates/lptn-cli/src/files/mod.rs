//! Files: whole or not there, and those of one run together.

mod batch;
mod commit;
mod lock;
pub(crate) mod names;

use crate::arguments;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use lptn_netlist::Diagnostic;
use lptn_study::{Environment, FileHash, SiValue};
use serde_json::{Value, json};

pub(crate) use batch::Batch;
use commit::Commit;
use lock::{Lock, NotLocked};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, reason};
pub(crate) use lptn_answer::folder::of_folder;

/// Longest wait of a process that replaces one file, for another one that does.
const MOMENT: Duration = Duration::from_secs(2);

/// A folder that files go to, which belongs to this process.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
    _lock: Lock,
}

impl Folder {
    /// Makes the folder of results and takes it for this process, in advance.
    /// The commit of a killed process is completed there, and its temporary files are removed.
    pub(crate) fn prepare(path: PathBuf) -> Result<Self, Failure> {
        Self::take(path, Duration::ZERO)
    }

    /// The same for replacing one file that is ready.
    pub(crate) fn prepare_for_a_moment(path: PathBuf) -> Result<Self, Failure> {
        Self::take(path, MOMENT)
    }

    fn take(path: PathBuf, patience: Duration) -> Result<Self, Failure> {
        let made = fs::create_dir_all(&path).map_err(NotLocked::Io);
        match made.and_then(|()| Lock::take(&path, patience)) {
            Ok(lock) => {
                Commit::finish(&path);
                sweep(&path);
                Ok(Self { path, _lock: lock })
            }
            Err(NotLocked::Busy(process)) => Err(in_use(&path, process)),
            Err(NotLocked::Io(error)) => Err(cannot_create(&path, &error)),
        }
    }

    /// Files that are to take their places together.
    pub(crate) fn batch(&self) -> Batch<'_> {
        Batch::new(self)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// Removes the unfinished files of killed processes.
/// Only the process with the lock writes there, so temporary files belong to ended processes.
fn sweep(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| entry.file_name().to_str().is_some_and(names::is_temporary))
    {
        drop(fs::remove_file(entry.path()));
    }
}

fn cannot_create(path: &Path, error: &io::Error) -> Failure {
    refused(
        "output::cannot_create",
        format!("cannot write into {}: {}", path.display(), reason(error)),
    )
}

fn in_use(path: &Path, process: Option<u32>) -> Failure {
    let process = process.map_or(String::new(), |id| format!(" (process {id})"));
    refused("output::in_use", format!("another lptn{process} is writing into {}", path.display()))
}

fn refused(code: &'static str, message: String) -> Failure {
    let help = "choose another folder with -o DIR, or write none with --no-files";
    Failure::refused(code, message, help)
}

/// Time and place of the writing of results, for their manifest; they took `wall_time` in s.
pub(crate) fn environment(wall_time: f64, phases: &[(&str, f64)]) -> Environment {
    let phase =
        |(name, seconds): &(&str, f64)| ((*name).to_owned(), SiValue::new(*seconds, "s").json());
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    Environment {
        written: lptn_study::utc(std::time::SystemTime::now()),
        host: host.trim().to_owned(),
        wall_time: SiValue::new(wall_time, "s"),
        phases: phases.iter().map(phase).collect(),
    }
}

/// The manifest of files that no single run has made.
pub(crate) fn manifest(inputs: &[FileHash], results: &[FileHash], wall_time: f64) -> Value {
    json!({
        "format": 1,
        "lptn": env!("CARGO_PKG_VERSION"),
        "arguments": arguments::words(),
        "inputs": inputs,
        "results": results,
        "environment": environment(wall_time, &[]),
    })
}

/// Writes a file at once and whole, and replaces one that exists.
pub(crate) fn replace(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let cannot = |why: &str| {
        let message = format!("cannot write {}: {why}", file.display());
        Failure::new(Exit::Failed, Diagnostic::error("output::cannot_write", message))
    };
    let place = place_of(file).map_err(|error| cannot(&reason(&error)))?;
    // a device or a pipe would be lost
    if fs::metadata(&place).is_ok_and(|found| !found.is_file()) {
        return Err(cannot("something there is not a file"));
    }
    let name = place.file_name().map(|name| name.to_string_lossy().into_owned());
    let (Some(folder), Some(name)) = (place.parent(), name) else {
        return Err(cannot("it has no name"));
    };
    let folder = Folder::prepare_for_a_moment(folder.to_owned())?;
    let mut files = folder.batch();
    files.write(&name, |out| out.write_all(bytes))?;
    files.commit(&[])
}

/// The place of a file that exists or is new. A link stays a link: its target is written.
fn place_of(file: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(file) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = fs::canonicalize(folder.unwrap_or(Path::new(".")))?;
            Ok(folder.join(file.file_name().unwrap_or_default()))
        }
        found => found,
    }
}

/// Writes a file that does not exist yet, whole or not at all.
/// `exists` is the code of the failure if it does.
pub(crate) fn write_new(path: &Path, text: &str, exists: &'static str) -> Result<(), Failure> {
    link_new(path, text).map_err(|error| {
        let path = path.display();
        let problem = match error.kind() {
            io::ErrorKind::AlreadyExists => Diagnostic::error(
                exists,
                format!("{path} exists already, and is never written over"),
            )
            .help("choose another name, or remove the file first"),
            _ => Diagnostic::error(
                "output::cannot_create",
                format!("cannot write {path}: {}", reason(&error)),
            ),
        };
        Failure::new(Exit::Input, problem)
    })
}

/// Removes a file that would be taken for a result; true if there was one.
pub(crate) fn take_away(path: &Path) -> Result<bool, Failure> {
    match fs::remove_file(path) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(cannot_create(path, &error)),
    }
}

fn link_new(path: &Path, text: &str) -> io::Result<()> {
    let name =
        path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let temporary = path.with_file_name(names::temporary(&name, std::process::id()));
    let linked = fs::write(&temporary, text).and_then(|()| fs::hard_link(&temporary, path));
    drop(fs::remove_file(&temporary));
    match linked {
        Ok(()) => Ok(()),
        // a full disk, or a file system without links: there the file grows in its place
        Err(_) => File::create_new(path).and_then(|mut file| {
            io::Write::write_all(&mut file, text.as_bytes())
                .inspect_err(|_| drop(fs::remove_file(path)))
        }),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::path::PathBuf;
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::names::{MANIFEST, RESULT, STATE, WINDOWS, temporary};
    use super::{Folder, link_new};

    /// A temporary folder.
    pub(crate) struct Place(pub(crate) PathBuf);

    impl Place {
        pub(crate) fn new() -> Self {
            static COUNT: AtomicU32 = AtomicU32::new(0);
            let name = format!(
                "lptn-files-{}-{}",
                std::process::id(),
                COUNT.fetch_add(1, Ordering::Relaxed)
            );
            let path = std::env::temp_dir().join(name);
            std::fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        pub(crate) fn write(&self, name: &str, text: &str) {
            std::fs::write(self.0.join(name), text).unwrap();
        }

        pub(crate) fn read(&self, name: &str) -> String {
            std::fs::read_to_string(self.0.join(name)).unwrap()
        }

        /// The names of its files, hidden ones too, in their order.
        pub(crate) fn files(&self) -> Vec<String> {
            let entries = std::fs::read_dir(&self.0).unwrap();
            let mut names: Vec<String> =
                entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        }
    }

    impl Drop for Place {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_batch_takes_its_places_together_and_what_is_over_goes() {
        let place = Place::new();
        place.write(RESULT, "old");
        place.write(WINDOWS, "old");
        place.write("notes.txt", "mine");
        let folder = Folder::prepare(place.0.clone()).unwrap();
        let mut batch = folder.batch();
        batch.write(RESULT, |out| out.write_all(b"new")).unwrap();
        batch.write(STATE, |out| out.write_all(b"new")).unwrap();
        assert_eq!(place.read(RESULT), "old");
        batch.commit(&[RESULT, WINDOWS]).unwrap();
        drop(folder);
        assert_eq!(place.files(), ["notes.txt", RESULT, STATE]);
        assert_eq!((place.read(RESULT), place.read(STATE)), ("new".into(), "new".into()));
    }

    #[test]
    fn a_batch_that_fails_leaves_the_old_files() {
        let place = Place::new();
        place.write(RESULT, "old");
        let folder = Folder::prepare(place.0.clone()).unwrap();
        let mut batch = folder.batch();
        batch.write(RESULT, |out| out.write_all(b"new")).unwrap();
        let full = std::io::Error::from(std::io::ErrorKind::StorageFull);
        let failure = batch.write(STATE, |_| Err(full)).unwrap_err();
        assert_eq!(failure.diagnostics[0].code, "output::cannot_write");
        drop(batch);
        drop(folder);
        assert_eq!((place.files(), place.read(RESULT)), (vec![RESULT.to_owned()], "old".into()));
    }

    /// A folder is at the place of a result: noticed before the first file takes its place.
    #[test]
    fn a_place_that_cannot_be_taken_keeps_all_back() {
        let place = Place::new();
        place.write(RESULT, "old");
        std::fs::create_dir(place.0.join(MANIFEST)).unwrap();
        let folder = Folder::prepare(place.0.clone()).unwrap();
        let mut batch = folder.batch();
        batch.write(RESULT, |out| out.write_all(b"new")).unwrap();
        batch.write(MANIFEST, |out| out.write_all(b"new")).unwrap_err();
        drop(batch);
        assert_eq!(place.read(RESULT), "old");
    }

    #[test]
    fn left_over_temporaries_of_the_dead_go() {
        let place = Place::new();
        place.write(&temporary(RESULT, 7), "half");
        place.write(&temporary("motor.toml", 8), "half");
        place.write(".thesis.csv.9.tmp", "of another program");
        drop(Folder::prepare(place.0.clone()).unwrap());
        assert_eq!(place.files(), [".thesis.csv.9.tmp"]);
    }

    #[test]
    fn new_files_are_never_written_over() {
        let place = Place::new();
        let path = place.0.join("motor.toml");
        link_new(&path, "first").unwrap();
        let again = link_new(&path, "second").unwrap_err();
        assert_eq!(again.kind(), std::io::ErrorKind::AlreadyExists);
        assert_eq!(
            (place.files(), place.read("motor.toml")),
            (vec!["motor.toml".to_owned()], "first".into())
        );
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_kept() {
        use std::os::unix::fs::PermissionsExt as _;
        let place = Place::new();
        place.write(STATE, "old");
        let path = place.0.join(STATE);
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o444)).unwrap();
        let folder = Folder::prepare(place.0.clone()).unwrap();
        let mut batch = folder.batch();
        batch.write(STATE, |out| out.write_all(b"new")).unwrap();
        batch.commit(&[]).unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o444);
        assert_eq!(place.read(STATE), "new");
    }
}
