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

/// A time of the run as it was written, and in s.
pub type GivenTime<'t> = (RunTime, &'t str, f64);

impl Netlist {
    /// Gives the run other times. Nothing changes on an error, nor without a `[run]`.
    ///
    /// # Errors
    /// [`Rejected`] if the times do not suit `[run]`: a run that ends before it begins, a window
    /// or a row outside of it, a signal that ends earlier, too many rows.
    pub fn set_run_times(&mut self, times: &[GivenTime<'_>]) -> Result<(), Rejected> {
        let before = (self.plan.clone(), self.files.clone());
        self.replace_run_times(times);
        let run = self.plan.as_ref().map(|plan| plan.settings(&self.network)).transpose();
        match run {
            Ok(run) => {
                self.run = run;
                Ok(())
            }
            Err(problems) => {
                let (plan, files) = before;
                self.plan = plan;
                let files = std::mem::replace(&mut self.files, files);
                Err(Rejected::arranged(files, problems, 0))
            }
        }
    }

    /// Replaces times of the run unchecked. [`Netlist::set`], [`Netlist::take_case`] and
    /// [`Netlist::set_run_times`] check them together with the parameters that they set, since
    /// both may belong together.
    pub fn replace_run_times(&mut self, times: &[GivenTime<'_>]) {
        let Some(plan) = &mut self.plan else { return };
        for &(which, text, seconds) in times {
            let file = self.files.add(which.option(), text);
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
        }
    }
}
