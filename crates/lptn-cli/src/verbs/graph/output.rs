//! Destination of a picture: a file, whole or not at all, or stdout.

use std::fs;
use std::path::PathBuf;

use super::place::Place;
use crate::console::Console;
use crate::files;
use lptn_answer::failure::{Failure, reason};
use lptn_answer::input::Input;

/// Writes the bytes to their place, and reports it; among the results they have a usual name.
pub(super) fn put(
    bytes: &[u8],
    (place, name): (&Place, &str),
    input: &Input,
    console: &Console,
) -> Result<(), Failure> {
    let path = match place {
        Place::Stdout => return console.write(|out| std::io::Write::write_all(out, bytes)),
        Place::File(path) => path.clone(),
        Place::Results => {
            let folder = PathBuf::from("out").join(&input.text.stem);
            fs::create_dir_all(&folder).map_err(|error| {
                let message = format!("cannot write into {}: {}", folder.display(), reason(&error));
                Failure::refused("output::cannot_create", message, HELP)
            })?;
            folder.join(name)
        }
    };
    files::replace(&path, bytes).map_err(|failure| failure.with_help(HELP))?;
    console.note(&format!("wrote  {}", path.display()));
    Ok(())
}

const HELP: &str = "name another file with -o FILE, or print it with -o -";
