//! Files that a program has in memory instead of on the disk, such as its frames.

use std::io;
use std::path::{Path, PathBuf};

use lptn_netlist::{Netlist, ReadError, Rejected, parse_with, read_bytes, read_named};

use crate::failure::Failure;
use crate::folder::of_folder;
use crate::input::{self, Given};

/// Files in memory, each with its path. A file that is not among them is on the disk.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles(Vec<(PathBuf, Vec<u8>)>);

impl From<Vec<(String, Vec<u8>)>> for MemoryFiles {
    fn from(files: Vec<(String, Vec<u8>)>) -> Self {
        Self(files.into_iter().map(|(path, bytes)| (path.into(), bytes)).collect())
    }
}

impl MemoryFiles {
    fn get(&self, path: &Path) -> Option<&Vec<u8>> {
        self.0.iter().find(|(known, _)| known == path).map(|(_, bytes)| bytes)
    }

    /// True if there is a file at this path.
    pub(crate) fn has(&self, path: &Path) -> bool {
        self.get(path).is_some() || path.is_file()
    }

    /// True if some of them are in this folder.
    pub fn has_folder(&self, folder: &Path) -> bool {
        self.0.iter().any(|(path, _)| path.parent() == Some(folder))
    }

    /// The bytes of a netlist or a sheet.
    pub(crate) fn bytes(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        self.get(path).map_or_else(|| read_bytes(path), |bytes| Ok(bytes.clone()))
    }

    /// The bytes of a record and its names; `-` is stdin.
    pub(crate) fn given(&self, path: &Path) -> Result<Given, Failure> {
        self.get(path).map_or_else(
            || input::read(path),
            |bytes| Ok(Given::of(&path.display().to_string(), bytes.clone())),
        )
    }

    /// The files of a folder with this ending, by name.
    pub(crate) fn of_folder(&self, folder: &Path, ending: &str) -> Result<Vec<PathBuf>, Failure> {
        if !self.has_folder(folder) {
            return of_folder(folder, ending, None);
        }
        let inside = self.0.iter().map(|(path, _)| path).filter(|path| {
            path.parent() == Some(folder) && path.extension().is_some_and(|own| own == ending)
        });
        let mut paths: Vec<PathBuf> = inside.cloned().collect();
        paths.sort_unstable();
        Ok(paths)
    }

    /// The netlist of a text that may name them, by paths relative to its own.
    pub(crate) fn parse(&self, text: &Given) -> Result<Netlist, Rejected> {
        let whole = std::str::from_utf8(&text.bytes).ok().filter(|_| !self.0.is_empty());
        let Some(whole) = whole else { return input::parse(text) };
        let folder = Path::new(&text.name).parent().unwrap_or(Path::new(""));
        let mut loader = |asked: &Path| -> io::Result<Vec<u8>> {
            let own = self.0.iter().find(|(path, _)| folder.join(path) == asked);
            own.map_or_else(|| read_named(asked), |(_, bytes)| Ok(bytes.clone()))
        };
        parse_with(&text.name, whole, &mut loader)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::MemoryFiles;
    use crate::answer::Answer as _;
    use crate::fit::law::FitLawQuestion;
    use crate::fit::step::FitStepQuestion;
    use crate::listener::Nobody;
    use crate::loaded::Loaded;

    const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../networks");

    /// A record in memory, under the path that it has on the disk, gives the same bytes.
    #[test]
    fn a_file_in_memory_is_as_one_on_the_disk() {
        let path = format!("{ROOT}/records/coffee.csv");
        let bytes = std::fs::read(&path).unwrap();
        let files = MemoryFiles::from(vec![(path.clone(), bytes.clone())]);
        let [disk, memory] = [MemoryFiles::default(), files].map(|files| {
            let question = FitStepQuestion { files, ..FitStepQuestion::default() };
            question.ask(Path::new(&path), &Nobody).unwrap().to_json()
        });
        assert_eq!(disk, memory);
        let text = std::fs::read_to_string(format!("{ROOT}/coffee.toml")).unwrap();
        let text = text.replace("records/coffee.csv", "cups.csv");
        let files = MemoryFiles::from(vec![("cups.csv".to_owned(), bytes)]);
        let loaded = Loaded::text_with(("a/b.toml", &text), &files, &[]).unwrap();
        let study = &loaded.usual().netlist.studies.fits[0];
        assert_eq!(study.records[0].record.time.len(), 24);
        assert!(Loaded::text("a/b.toml", &text, &[]).is_err());
    }

    #[test]
    fn records_in_memory_are_a_folder() {
        let folder = Path::new("frames");
        let disk = Path::new(ROOT).join("records/synthetic_gearbox");
        let names = ["1000rpm_a.csv", "2000rpm_a.csv", "3000rpm_a.csv"];
        let file = |name: &&str| {
            let path = folder.join(name).display().to_string();
            (path, std::fs::read(disk.join(name)).unwrap())
        };
        let files = MemoryFiles::from(names.iter().map(file).collect::<Vec<_>>());
        assert!(files.has_folder(folder) && !files.has_folder(Path::new("frame")));
        assert!(files.has(&folder.join(names[0])) && !files.has(&folder.join("runs.csv")));
        let capacity = Some("2659 J/K".to_owned());
        let question = FitLawQuestion { capacity, files, ..FitLawQuestion::default() };
        let answer = question.ask_records(folder, &Nobody).unwrap();
        let runs: Vec<&str> = answer.study.runs.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(runs, names);
    }
}
