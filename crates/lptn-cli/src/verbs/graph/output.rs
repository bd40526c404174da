//! Where a picture goes: a file, whole or not at all, or stdout.

use std::path::{Path, PathBuf};

use super::kind::Place;
use crate::console::Console;
use crate::failure::Failure;
use crate::files::Folder;
use crate::input::Input;

/// Puts the bytes where they are wanted, and says where; among the results they have a usual name.
pub(super) fn put(
    bytes: &[u8],
    (place, name): (&Place, &str),
    input: &Input,
    console: &Console,
) -> Result<(), Failure> {
    let path = match place {
        Place::Stdout => return console.write(|out| std::io::Write::write_all(out, bytes)),
        Place::File(path) => path.clone(),
        Place::Results => PathBuf::from("out").join(&input.text.stem).join(name),
    };
    file(&path, bytes).map_err(|failure| elsewhere(failure, place))?;
    console.print(&format!("wrote  {}\n", path.display())).map(drop)
}

fn file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let folder = Folder::prepare_for_a_moment(folder.to_owned())?;
    let mut files = folder.batch();
    files.write(&name, |out| out.write_all(bytes))?;
    files.commit(&[])
}

/// The help of a folder is about results of runs.
fn elsewhere(mut failure: Failure, place: &Place) -> Failure {
    let option = if *place == Place::Results { "name a file" } else { "name another file" };
    for problem in &mut failure.diagnostics {
        problem.help = Some(format!("{option} with -o FILE, or print it with -o -"));
    }
    failure
}
