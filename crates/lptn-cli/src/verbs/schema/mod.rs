//! `lptn schema`

mod args;

pub(crate) use args::SchemaArgs;

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

pub(crate) fn schema(_: &SchemaArgs, console: &Console) -> Result<Exit, Failure> {
    console.print(&format!("{:#}\n", lptn_netlist::schema()))
}
