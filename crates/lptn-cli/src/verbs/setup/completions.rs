//! `lptn setup completions`

use clap::CommandFactory as _;
use clap_complete::Shell;

use crate::args::Args;
use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

/// Print a completion script for a shell
#[derive(Debug, clap::Args)]
pub(crate) struct CompletionsArgs {
    /// bash, zsh, fish, elvish or powershell
    #[arg(value_name = "SHELL", hide_possible_values = true)]
    pub(crate) shell: Shell,
}

pub(super) fn print(args: &CompletionsArgs, console: &Console) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "lptn", &mut script);
    console.print(&String::from_utf8_lossy(&script))
}
