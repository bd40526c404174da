//! `lptn plot`

mod args;
mod overlay;
mod source;

pub(crate) use args::PlotArgs;

use crate::console::Console;
use crate::drawing::Drawing;
use crate::exit::Exit;
use crate::failure::Failure;
use overlay::overlay;
use source::Source;

pub(crate) fn plot(args: &PlotArgs, console: &Console) -> Result<Exit, Failure> {
    let mut exit = Exit::Done;
    let mut sources = Vec::new();
    for path in &args.sources {
        let (source, ended) = Source::of(path, args, console)?;
        sources.push(source);
        exit = if exit == Exit::Done { ended } else { exit };
    }
    let here = Drawing::Terminal;
    let drawing = args.output.as_ref().or(console.plot.as_ref()).unwrap_or(&here);
    console.draw(&[overlay(sources)], drawing)?;
    Ok(exit)
}
