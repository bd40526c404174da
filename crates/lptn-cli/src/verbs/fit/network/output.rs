//! The files of `lptn fit network -o DIR`: measured and computed values, the answer, the posterior
//! for further studies, and their manifest.

use lptn_answer::about;
use lptn_answer::failure::Failure;
use lptn_answer::fit::network::FitNetworkAnswer;
use lptn_report::{Format, write_csv};

use crate::files::Folder;
use crate::files::names::{FIT, MANIFEST, POSTERIOR, RESIDUALS};

/// Names of the files, of which the posterior may be missing.
const NAMES: [&str; 4] = [RESIDUALS, FIT, POSTERIOR, MANIFEST];

/// Writes the files and returns their names. The posterior needs every value to be determined.
pub(super) fn write(
    answer: &FitNetworkAnswer,
    folder: &Folder,
    wall_time: f64,
) -> Result<Vec<String>, Failure> {
    let mut files = folder.batch();
    files.write(RESIDUALS, |out| write_csv(&answer.residuals(), out))?;
    files.page(FIT, answer, Format::Json)?;
    if let Some(posterior) = answer.posterior() {
        files.write(POSTERIOR, |mut out| posterior.write(&mut out))?;
    }
    files.manifest(&about::hashes(&answer.input().netlist), wall_time)?;
    let names = files.written().iter().map(|file| file.name.clone()).collect();
    files.commit(&NAMES)?;
    Ok(names)
}
