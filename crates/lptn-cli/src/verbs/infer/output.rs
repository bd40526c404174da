//! The files of `lptn infer -o DIR`: every moment, the answer, and their manifest.

use lptn_answer::about;
use lptn_answer::failure::Failure;
use lptn_answer::infer::InferAnswer;
use lptn_report::{Format, write_csv};

use crate::files::Folder;
use crate::files::names::{INFER, INFERRED, MANIFEST};

/// Names of the files.
pub(super) const NAMES: [&str; 3] = [INFERRED, INFER, MANIFEST];

pub(super) fn write(answer: &InferAnswer, folder: &Folder, wall_time: f64) -> Result<(), Failure> {
    let mut files = folder.batch();
    files.write(INFERRED, |out| write_csv(&answer.table(), out))?;
    files.page(INFER, answer, Format::Json)?;
    files.manifest(&about::hashes(&answer.input().netlist), wall_time)?;
    files.commit(&[])
}
