//! The files of `lptn fit compare -o DIR`: the candidates, their errors on held-out records,
//! the answer, and their manifest.

use lptn_answer::failure::Failure;
use lptn_answer::fit::compare::FitCompareAnswer;
use lptn_report::{Format, write_csv};

use crate::files::Folder;
use crate::files::names::{CANDIDATES, CHOICE, MANIFEST, UNSEEN};

/// Names of the files.
pub(super) const NAMES: [&str; 4] = [CANDIDATES, UNSEEN, CHOICE, MANIFEST];

pub(super) fn write(
    answer: &FitCompareAnswer,
    folder: &Folder,
    wall_time: f64,
) -> Result<(), Failure> {
    let mut files = folder.batch();
    files.write(CANDIDATES, |out| write_csv(&answer.table(), out))?;
    files.write(UNSEEN, |out| write_csv(&answer.unseen(), out))?;
    files.page(CHOICE, answer, Format::Json)?;
    files.manifest(&answer.hashes(), wall_time)?;
    files.commit(&[])
}
