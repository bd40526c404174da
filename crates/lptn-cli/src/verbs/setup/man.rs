//! `lptn setup man`

use std::path::PathBuf;

use clap::CommandFactory as _;
use clap_mangen::Man;

use crate::args::Args;
use crate::console::Console;
use crate::files::Folder;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

/// Write manual pages
#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// The folder that they go to, such as ~/.local/share/man/man1
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
}

pub(super) fn write(args: &ManArgs, console: &Console) -> Result<Exit, Failure> {
    let mut command = Args::command();
    // gives every command its whole name and the options that all have
    command.build();
    let mut pages = Vec::new();
    collect(&command, &mut pages);
    let folder = Folder::prepare_for_a_moment(args.folder.clone())?;
    let mut files = folder.batch();
    for page in &pages {
        files.write(&page.get_filename(), |out| page.render(out))?;
    }
    files.commit(&[])?;
    let (count, folder) = (pages.len(), args.folder.display());
    console.note(&format!("wrote  {count} pages into {folder}: man lptn, man lptn-run, .."));
    Ok(Exit::Done)
}

/// A page for a command, and one for each of its verbs.
fn collect(command: &clap::Command, pages: &mut Vec<Man>) {
    pages.push(Man::new(command.clone()));
    let verbs = command.get_subcommands().filter(|verb| !verb.is_hide_set());
    verbs.filter(|verb| verb.get_name() != "help").for_each(|verb| collect(verb, pages));
}
