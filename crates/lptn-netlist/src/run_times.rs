//! `--stop` and `--every`: other times for a run, checked like those of the file.

use lptn_data::{Rejected, Span};
use lptn_network::Value;

use crate::netlist::Netlist;
use crate::run::OutputPlan;
use crate::setting::Setting;

lptn_units::words! {
/// A time of a run that may be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunTime {
    /// When it ends.
    Stop = "--stop",
    /// The time between two rows; it replaces rows at listed times.
    Every = "--every",
}
/// The option of the command line.
pub fn option;
}

impl Netlist {
    /// Gives the run another time of `seconds`, written as `text`. Nothing changes on an error, nor
    /// without a `[run]`.
    ///
    /// # Errors
    /// [`Rejected`] if the time does not suit `[run]`: a run that ends before it begins, a window
    /// or a row outside of it, a signal that ends earlier, too many rows.
    pub fn set_run_time(
        &mut self,
        which: RunTime,
        text: &str,
        seconds: f64,
    ) -> Result<(), Rejected> {
        let Some(mut plan) = self.plan.clone() else { return Ok(()) };
        let mut files = self.files.clone();
        let file = files.add(which.option(), text);
        let setting = Setting {
            value: Value::Constant(seconds),
            span: Span::new(file, 0..text.len()),
            words: format!("`{}`", which.option()),
            unit: "s".into(),
            help: format!("write it like this: {} \"10 min\"", which.option()),
        };
        match which {
            RunTime::Stop => plan.stop = setting,
            RunTime::Every => plan.output = Some(OutputPlan::Every(setting)),
        }
        let run = plan.settings(&self.network);
        let run = run.map_err(|diagnostics| Rejected::arranged(files.clone(), diagnostics, 0))?;
        (self.plan, self.run, self.files) = (Some(plan), Some(run), files);
        Ok(())
    }
}
