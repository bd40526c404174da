//! The files of `lptn infer -o DIR`: every moment, the answer, and their manifest.

use lptn_answer::about;
use lptn_answer::failure::Failure;
use lptn_answer::infer::InferAnswer;
use lptn_report::{Format, Look, write_csv};

use crate::files::names::{INFER, INFERRED, MANIFEST};
use crate::files::{self, Folder};

/// What is written.
pub(super) const NAMES: [&str; 3] = [INFERRED, INFER, MANIFEST];

pub(super) fn write(answer: &InferAnswer, folder: &Folder, wall_time: f64) -> Result<(), Failure> {
    let mut files = folder.batch();
    files.write(INFERRED, |out| write_csv(&answer.table(), out))?;
    files
        .write(INFER, |mut out| lptn_report::write(answer, Format::Json, Look::PLAIN, &mut out))?;
    let inputs = about::hashes(&answer.input().netlist);
    let text = files::manifest(&inputs, files.written(), wall_time);
    files.write(MANIFEST, |out| out.write_all(format!("{text:#}\n").as_bytes()))?;
    files.commit(&[])
}
