//! `lptn infer --follow`: rows come from stdin, and each is answered at once.

use std::io::{BufRead as _, Write as _, stdin};

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::infer::Following;
use lptn_report::Format;

use super::InferArgs;
use crate::console::Console;

/// Refuses, in advance, output that rows cannot be given as.
pub(super) fn possible(args: &InferArgs, console: &Console) -> Result<(), Failure> {
    let asked = match args.printed.format {
        Format::Json => "--format json",
        _ if console.plot.is_some() => "--plot",
        _ if console.reports() => "--report",
        _ => return Ok(()),
    };
    let message = format!("{asked} shows a whole record, but --follow answers rows as they come");
    let help = "leave one of the two out: --follow prints csv, a line for each row";
    Err(Failure::refused("infer::follow_output", message, help))
}

/// Follows the record to its end.
pub(super) fn follow(mut following: Following, console: &Console) -> Result<Exit, Failure> {
    let mut stdin = stdin().lock();
    loop {
        let mut line = Vec::new();
        let read = stdin.read_until(b'\n', &mut line);
        if read.map_err(|error| Failure::cannot_read("<stdin>", &error, None))? == 0 {
            break;
        }
        let Some(rows) = following.line(&line, console)? else { continue };
        let text = rows.csv();
        if !console.stream(|out| out.write_all(text.as_bytes()))? {
            return Ok(Exit::Done);
        }
    }
    following.end(console).map(|()| Exit::Done)
}
