//! The files of `lptn fit law FOLDER`: the tables of the paper's Figures 7, 8 and 9, and their
//! manifest.

use lptn_answer::failure::Failure;
use lptn_answer::fit::law::FitRunsAnswer;
use lptn_report::{Format, write_csv};

use crate::files::Folder;
use crate::files::names::{LAWS, MANIFEST, POWER, RISE, SLOPES, TIME_CONSTANT};

/// Names of the files.
pub(super) const NAMES: [&str; 6] = [RISE, TIME_CONSTANT, POWER, SLOPES, LAWS, MANIFEST];

pub(super) fn write(found: &FitRunsAnswer, folder: &Folder, wall_time: f64) -> Result<(), Failure> {
    let mut files = folder.batch();
    let tables = [
        (RISE, found.rises()),
        (TIME_CONSTANT, found.time_constants()),
        (POWER, found.powers()),
        (SLOPES, found.slopes()),
    ];
    for (name, table) in tables {
        files.write(name, |out| write_csv(&table, out))?;
    }
    files.page(LAWS, &found.answer, Format::Csv)?;
    files.manifest(&found.inputs, wall_time)?;
    files.commit(&[])
}
