//! Effect of broken limits on the exit code.

use lptn_answer::limits::{Judgement, Verdict};

use crate::console::Console;
use lptn_answer::exit::Exit;

/// Says which limits are broken and gives the exit code. Those that make it 1 are said last, and
/// with `--quiet` too; those of severity warning are warnings, which `--quiet` leaves out: the
/// table, JSON and the manifest have them.
pub(crate) fn conclude(judgement: &Judgement<'_>, console: &Console) -> Exit {
    let verdict = Verdict::of(judgement);
    console.warn(&judgement.netlist.files, &verdict.warnings);
    verdict.broken.iter().for_each(|broken| console.message(broken));
    if verdict.holds() { Exit::Done } else { Exit::No }
}
