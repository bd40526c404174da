//! `lptn new`

mod args;

pub(crate) use args::NewArgs;

use std::io::ErrorKind;
use std::path::PathBuf;

use lptn_netlist::{Diagnostic, parse_bytes};

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::{Failure, reason};
use crate::files;
use crate::input::quoted;
use crate::written::proven;

const TEMPLATE: &str = include_str!("new.toml");

pub(crate) fn new(args: &NewArgs, console: &Console) -> Result<Exit, Failure> {
    let path = PathBuf::from(format!("{}.toml", args.name.strip_suffix(".toml").unwrap_or(&args.name)));
    let name = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    let usual = |c: char| c.is_alphanumeric() || "_-. ".contains(c);
    if name.trim().is_empty() || name.starts_with('.') || !name.chars().all(usual) {
        let problem = Diagnostic::error("new::bad_name", format!("`{}` is no name for a netlist", args.name));
        return Err(Failure::new(
            Exit::Input,
            problem.help("use letters, digits, `_` and `-`: lptn new motor"),
        ));
    }
    let typed = quoted(&path.display().to_string());
    let text = TEMPLATE.replace("FILE", &typed).replace("NAME", &name);
    let network = parse_bytes(&path.display().to_string(), text.as_bytes())?.network;
    let text = proven(text, &path, &network, None)?;
    files::write_new(&path, &text).map_err(|error| cannot_write(&path, &error))?;
    console.print(&format!("wrote {}: a motor with a winding and a housing in a room\n", path.display()))?;
    console.note(&format!("next   lptn run {typed}"));
    Ok(Exit::Done)
}

fn cannot_write(path: &std::path::Path, error: &std::io::Error) -> Failure {
    let path = path.display();
    let problem = match error.kind() {
        ErrorKind::AlreadyExists => {
            Diagnostic::error("new::exists", format!("{path} exists already, and is never written over"))
                .help("choose another name, or remove the file first")
        }
        _ => Diagnostic::error("output::cannot_create", format!("cannot write {path}: {}", reason(error))),
    };
    Failure::new(Exit::Input, problem)
}
