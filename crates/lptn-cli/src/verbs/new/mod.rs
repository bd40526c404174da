//! `lptn new`

mod args;

pub(crate) use args::NewArgs;

use std::path::PathBuf;

use lptn_netlist::parse_bytes;

use crate::console::Console;
use crate::files;
use crate::written::proven;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::quoted;

const TEMPLATE: &str = include_str!("new.toml");

pub(crate) fn new(args: &NewArgs, console: &Console) -> Result<Exit, Failure> {
    let path =
        PathBuf::from(format!("{}.toml", args.name.strip_suffix(".toml").unwrap_or(&args.name)));
    let name = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    let usual = |c: char| c.is_alphanumeric() || "_-. ".contains(c);
    if name.trim().is_empty() || name.starts_with('.') || !name.chars().all(usual) {
        let message = format!("`{}` is not a name for a netlist", args.name);
        let help = "use letters, digits, `_` and `-`: lptn new motor";
        return Err(Failure::refused("new::bad_name", message, help));
    }
    let typed = quoted(&path.display().to_string());
    let text = TEMPLATE.replace("FILE", &typed).replace("NAME", &name);
    let network = parse_bytes(&path.display().to_string(), text.as_bytes())?.network;
    let text = proven(text, &path, &network, None)?;
    files::write_new(&path, &text, "new::exists")?;
    console.print(&format!(
        "wrote {}: a motor with a winding and a housing in a room\n",
        path.display()
    ))?;
    console.next(&format!("lptn check {typed}"));
    Ok(Exit::Done)
}
