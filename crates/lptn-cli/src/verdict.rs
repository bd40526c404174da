//! Effect of broken limits on the exit code.

use lptn_answer::limits::{Judgement, Verdict};

use crate::console::Console;
use lptn_answer::exit::Exit;

/// Prints the broken limits and returns the exit code. Those that make it 1 come last.
/// With `--quiet` they are printed too, but those of severity warning are not. The table, JSON and
/// the manifest have them all.
pub(crate) fn conclude(judgement: &Judgement<'_>, console: &Console) -> Exit {
    let verdict = Verdict::of(judgement);
    console.warn(&judgement.netlist.files, &verdict.warnings);
    verdict.broken.iter().for_each(|broken| console.message(broken));
    if verdict.holds() { Exit::Done } else { Exit::No }
}
