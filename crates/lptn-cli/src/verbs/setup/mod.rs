//! `lptn setup`: files that a shell and `man` read. `lptn completions` and `lptn man`, its former
//! words, do the same for one version and name the new ones.

mod completions;
mod man;

use clap::{Args as Arguments, Subcommand};

pub(crate) use completions::CompletionsArgs;
pub(crate) use man::ManArgs;

use crate::console::Console;
use crate::options::TEMPLATE;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

const EXAMPLES: &str = "\
Examples:
  lptn setup completions bash > ~/.local/share/bash-completion/completions/lptn
  lptn setup man ~/.local/share/man/man1";

/// Write completions for a shell, or manual pages
#[derive(Debug, Arguments)]
#[command(before_help = EXAMPLES, help_template = TEMPLATE)]
pub(crate) struct SetupArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Completions(CompletionsArgs),
    Man(ManArgs),
}

pub(crate) fn setup(args: &SetupArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.what {
        What::Completions(args) => completions::print(args, console),
        What::Man(args) => man::write(args, console),
    }
}

pub(crate) mod former {
    //! The former words.

    use super::{CompletionsArgs, Console, Exit, Failure, ManArgs};

    pub(crate) fn completions(args: &CompletionsArgs, console: &Console) -> Result<Exit, Failure> {
        console.note("`lptn completions` is `lptn setup completions` now");
        super::completions::print(args, console)
    }

    pub(crate) fn man(args: &ManArgs, console: &Console) -> Result<Exit, Failure> {
        console.note("`lptn man` is `lptn setup man` now");
        super::man::write(args, console)
    }
}
