//! The files of `lptn fit network -o DIR`: what was measured beside what the fitted network
//! computes, the answer, what studies go on from, and their manifest.

use lptn_answer::about;
use lptn_answer::failure::Failure;
use lptn_answer::fit::network::FitNetworkAnswer;
use lptn_report::{Format, Look, write_csv};

use crate::files::names::{FIT, MANIFEST, POSTERIOR, RESIDUALS};
use crate::files::{self, Folder};

/// What may be written.
const NAMES: [&str; 4] = [RESIDUALS, FIT, POSTERIOR, MANIFEST];

/// Writes the files, and says which: there is a posterior only where every value is determined.
pub(super) fn write(
    answer: &FitNetworkAnswer,
    folder: &Folder,
    wall_time: f64,
) -> Result<Vec<String>, Failure> {
    let mut files = folder.batch();
    files.write(RESIDUALS, |out| write_csv(&answer.residuals(), out))?;
    files.write(FIT, |mut out| lptn_report::write(answer, Format::Json, Look::PLAIN, &mut out))?;
    if let Some(posterior) = answer.posterior() {
        files.write(POSTERIOR, |mut out| posterior.write(&mut out))?;
    }
    let inputs = about::hashes(&answer.input().netlist);
    let text = files::manifest(&inputs, files.written(), wall_time);
    files.write(MANIFEST, |out| out.write_all(format!("{text:#}\n").as_bytes()))?;
    let names = files.written().iter().map(|file| file.name.clone()).collect();
    files.commit(&NAMES)?;
    Ok(names)
}
