//! The files of `lptn fit compare -o DIR`: the candidates, what each misses of what it has not seen,
//! the answer, and their manifest.

use lptn_answer::failure::Failure;
use lptn_answer::fit::compare::FitCompareAnswer;
use lptn_report::{Format, Look, write_csv};

use crate::files::names::{CANDIDATES, CHOICE, MANIFEST, UNSEEN};
use crate::files::{self, Folder};

/// What is written.
pub(super) const NAMES: [&str; 4] = [CANDIDATES, UNSEEN, CHOICE, MANIFEST];

pub(super) fn write(
    answer: &FitCompareAnswer,
    folder: &Folder,
    wall_time: f64,
) -> Result<(), Failure> {
    let mut files = folder.batch();
    files.write(CANDIDATES, |out| write_csv(&answer.table(), out))?;
    files.write(UNSEEN, |out| write_csv(&answer.unseen(), out))?;
    files
        .write(CHOICE, |mut out| lptn_report::write(answer, Format::Json, Look::PLAIN, &mut out))?;
    let text = files::manifest(&answer.hashes(), files.written(), wall_time);
    files.write(MANIFEST, |out| out.write_all(format!("{text:#}\n").as_bytes()))?;
    files.commit(&[])
}
