//! `[run]`: the run to simulate.

mod declaration;

pub(crate) use declaration::RUN;

use declaration::OUTPUT;

use lptn_data::{Diagnostic, Span};
use lptn_network::{
    AfterEnd, Evaluation, IntegratorChoice, Network, OutputTimes, RunSettings, Value,
    WindowSettings,
};

use crate::fields::{Fields, Owner};
use crate::outputs::WindowPlan;
use crate::raw::{RawKind, RawValue};
use crate::reading::all;
use crate::section::SIGNAL;
use crate::setting::{Setting, TIME};
use crate::work::Elaboration;

/// `[run]` before its expressions are evaluated: `--set` may change their parameters.
#[derive(Clone, Debug)]
pub(crate) struct RunPlan {
    pub(crate) start: Option<Setting>,
    pub(crate) stop: Setting,
    pub(crate) output: Option<OutputPlan>,
    pub(crate) tolerance: Option<Setting>,
    pub(crate) balance_error: Option<Setting>,
    pub(crate) select: Vec<String>,
    /// The signals that are used, with their places: they have to last as long as the run.
    signals: Vec<(String, Span)>,
    pub(crate) windows: Vec<WindowPlan>,
    held: Vec<Option<f64>>,
    pub(crate) integrator: IntegratorChoice,
}

/// When rows are written.
#[derive(Clone, Debug)]
pub(crate) enum OutputPlan {
    Every(Setting),
    At(Vec<Setting>),
}

impl<'a> Elaboration<'a> {
    pub(crate) fn run(&mut self) -> Option<RunPlan> {
        let entry = self.raw.top.get(RUN.name)?;
        let fields = self.inner(&RUN, Owner::section(RUN.name), entry)?;
        let integrator = self.choice(&fields, "integrator", &IntegratorChoice::WORDS);
        self.word(&fields, "initial");
        self.require(&fields, "stop");
        let stop = self.optional(&fields, "stop");
        let start = self.optional(&fields, "start");
        let tolerance = self.optional(&fields, "tolerance");
        let balance_error = self.optional(&fields, "balance_error");
        let output = self.output(&fields);
        let select = self.select(&fields);
        self.reports(&fields);
        let windows = self.windows(&fields);
        let (signals, held) = (self.used_signals(), self.held());
        Some(RunPlan {
            start,
            stop: stop?,
            output,
            tolerance,
            balance_error,
            select,
            windows,
            signals,
            held,
            integrator: integrator.unwrap_or_default(),
        })
    }

    /// The signals with points that something uses.
    fn used_signals(&self) -> Vec<(String, Span)> {
        let entries = self.elements(SIGNAL.name).iter();
        let used = entries
            .filter(|entry| self.names.is_used(&entry.key) && !self.names.has_failed(&entry.key));
        used.map(|entry| (entry.key.clone(), entry.key_span.clone())).collect()
    }

    fn optional(&mut self, fields: &Fields<'a>, key: &str) -> Option<Setting> {
        self.optional_setting(fields, key)?
    }

    fn output(&mut self, fields: &Fields<'a>) -> Option<OutputPlan> {
        self.table_of(fields, ("output", "a table"))?;
        let entry = fields.entry("output")?;
        let output = self.inner(&OUTPUT, fields.owner.inside("output"), entry)?;
        match (output.get("every"), output.get("at")) {
            (Some(_), None) => self.optional(&output, "every").map(OutputPlan::Every),
            (None, Some(_)) => {
                let list = self.list(&output, ("at", "a list of times"))?;
                let times = list.iter().map(|raw| self.setting(&output.owner, ("at", raw), TIME));
                all(times).map(OutputPlan::At)
            }
            (every, _) => {
                if output.complete {
                    self.report(one_of(&entry.value, every.is_some()));
                }
                None
            }
        }
    }

    fn select(&mut self, fields: &Fields<'a>) -> Vec<String> {
        let (mut patterns, mut spans) = (Vec::new(), Vec::new());
        let list = self.list(fields, ("select", "a list of patterns"));
        for item in list.unwrap_or_default() {
            match &item.kind {
                RawKind::String { text, .. } => {
                    patterns.push(text.clone());
                    spans.push(item.span.clone());
                }
                _ => self.report(fields.wrong_shape("select", item, "a list of strings")),
            }
        }
        if list.is_some() {
            self.map.set_select(spans);
        }
        patterns
    }
}

fn one_of(raw: &RawValue, both: bool) -> Diagnostic {
    let message = if both { "has both `every` and `at`" } else { "has neither `every` nor `at`" };
    Diagnostic::wrong(
        "netlist::run_output",
        format!("`output` of [run] {message}"),
        &raw.span,
        "write `output = { every = \"5 s\" }` or `output = { at = [\"0 s\", \"5 s\"] }`",
    )
}

impl RunPlan {
    /// The settings for the parameters that `network` has.
    pub(crate) fn settings(&self, network: &Network) -> Result<RunSettings, Vec<Diagnostic>> {
        let mut check = Check { scope: network.evaluation(), problems: Vec::new() };
        let start = self.start.as_ref().map_or(0.0, |start| check.number(start));
        let stop = check.number(&self.stop);
        if check.problems.is_empty() && stop <= start {
            check.problems.push(ends_early(self, start, stop));
        } else if check.problems.is_empty() {
            let short =
                self.signals.iter().filter_map(|signal| self.short(network, signal, (start, stop)));
            check.problems.extend(short);
        }
        let tolerance =
            self.tolerance.as_ref().map_or(RunSettings::USUAL_TOLERANCE, |t| check.positive(t));
        let balance_error = self.balance_error.as_ref().map(|share| check.positive(share));
        let output = check.output(self.output.as_ref(), (start, stop));
        let windows =
            self.windows.iter().filter_map(|plan| check.window(plan, (start, stop))).collect();
        if check.problems.is_empty() {
            let (select, held) = (self.select.clone(), self.held.clone());
            let integrator = self.integrator;
            Ok(RunSettings {
                start,
                stop,
                output,
                select,
                windows,
                tolerance,
                balance_error,
                integrator,
                held,
            })
        } else {
            Err(check.problems)
        }
    }
}

impl RunPlan {
    /// Everything that it evaluates.
    pub(crate) fn values(&self) -> impl Iterator<Item = &Value> {
        let output: &[Setting] = match &self.output {
            None => &[],
            Some(OutputPlan::Every(every)) => std::slice::from_ref(every),
            Some(OutputPlan::At(times)) => times,
        };
        let windows = self.windows.iter().flat_map(WindowPlan::ends);
        let own =
            self.start.iter().chain([&self.stop]).chain(&self.tolerance).chain(&self.balance_error);
        own.chain(output).chain(windows).map(|setting| &setting.value)
    }

    /// The place of `start`, if given.
    pub(crate) fn start_place(&self) -> Option<&Span> {
        self.start.as_ref().map(|start| &start.span)
    }

    /// Error for a signal that has no value during a part of the run.
    fn short(
        &self,
        network: &Network,
        (name, span): &(String, Span),
        (start, stop): (f64, f64),
    ) -> Option<Diagnostic> {
        let course = &network.signals().iter().find(|signal| signal.name == *name)?.course;
        let (first, last) = course.span();
        // rounding does not count, as when it is read
        let margin = 1e-9 * (last - first).max(first.abs().max(last.abs()) * 1e-3);
        let problem = |message: String| {
            Diagnostic::error("netlist::signal_too_short", message).at(span.clone(), "")
        };
        if start < first - margin {
            let message = format!("signal `{name}` begins at {first} s, but the run at {start} s");
            let start = self.start.as_ref().unwrap_or(&self.stop).span.clone();
            let help =
                format!("give it a point there, or begin the run later: `start = \"{first} s\"`");
            return Some(problem(message).also(start, "the run").help(help));
        }
        if stop > last + margin && course.after() == AfterEnd::Error {
            let message = format!("signal `{name}` ends at {last} s, but the run at {stop} s");
            return Some(problem(message).also(self.stop.span.clone(), "the run ends here").help(
                "write `after_end = \"hold\"` to keep its last value or `after_end = \"repeat\"`, \
                 or stop the run earlier",
            ));
        }
        None
    }
}

fn ends_early(plan: &RunPlan, start: f64, stop: f64) -> Diagnostic {
    let message = format!("the run ends at {stop} s, but begins at {start} s");
    let error =
        Diagnostic::error("netlist::run_stop", message).at(plan.stop.span.clone(), "ends here");
    let error = match &plan.start {
        Some(start) => error.also(start.span.clone(), "begins here"),
        None => error,
    };
    error.help("`stop` has to be after `start`, which is 0 s by default: `stop = \"25 min\"`")
}

/// Evaluates settings and collects their errors.
struct Check {
    scope: Evaluation,
    problems: Vec<Diagnostic>,
}

impl Check {
    fn number(&mut self, setting: &Setting) -> f64 {
        let failed = match setting.value.at(&mut self.scope) {
            Ok(value) if value.is_finite() => return value,
            Ok(value) => Diagnostic::error(
                "netlist::run_not_finite",
                format!("{} must be finite, got {value}", setting.words),
            ),
            Err(error) => Diagnostic::error(error.code(), format!("{}: {error}", setting.words)),
        };
        self.problems.push(failed.at(setting.span.clone(), "").help(&setting.help));
        f64::NAN
    }

    fn positive(&mut self, setting: &Setting) -> f64 {
        let value = self.number(setting);
        if value <= 0.0 {
            let message =
                format!("{} must be more than zero, got {value} {}", setting.words, setting.unit);
            let error = Diagnostic::error("netlist::run_not_positive", message);
            self.problems.push(error.at(setting.span.clone(), "").help(&setting.help));
        }
        value
    }

    fn window(&mut self, plan: &WindowPlan, run: (f64, f64)) -> Option<WindowSettings> {
        let before = self.problems.len();
        let [from, to] = plan.ends().map(|end| self.number(end));
        if self.problems.len() > before || run.1 <= run.0 {
            return None;
        }
        plan.settings((from, to), run).map_err(|problem| self.problems.push(problem)).ok()
    }

    fn output(&mut self, plan: Option<&OutputPlan>, (start, stop): (f64, f64)) -> OutputTimes {
        match plan {
            None => OutputTimes::Every((stop - start) / OutputTimes::USUAL_INTERVALS),
            Some(OutputPlan::Every(setting)) => {
                let every = self.positive(setting);
                if every > 0.0 && (stop - start) / every > OutputTimes::MOST_ROWS {
                    self.problems.push(too_many(setting, (stop - start) / every));
                }
                OutputTimes::Every(every)
            }
            Some(OutputPlan::At(times)) => OutputTimes::At(self.times(times, (start, stop))),
        }
    }

    fn times(&mut self, settings: &[Setting], (start, stop): (f64, f64)) -> Vec<f64> {
        let mut times: Vec<f64> = Vec::with_capacity(settings.len());
        for setting in settings {
            // an end of the run in another unit differs by rounding
            let time = self.number(setting);
            let time = [start, stop].into_iter().find(|end| same(*end, time)).unwrap_or(time);
            let says = if time < start || time > stop {
                Some(format!("{time} s is outside the run, which lasts from {start} s to {stop} s"))
            } else if times.last().is_some_and(|last| time <= *last) {
                Some(format!(
                    "the times of `at` have to ascend, but {time} s does not come after the one \
                     before"
                ))
            } else {
                None
            };
            if let Some(says) = says {
                let error =
                    Diagnostic::error("netlist::run_output", says).at(setting.span.clone(), "");
                self.problems.push(
                    error.help(
                        "list each time once, in order, for example `at = [\"0 s\", \"5 s\"]`",
                    ),
                );
            }
            times.push(time);
        }
        times
    }
}

/// True if two times are equal but for rounding.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs())
}

fn too_many(setting: &Setting, rows: f64) -> Diagnostic {
    let message =
        format!("{} makes {rows:.0} rows, more than {:.0}", setting.words, OutputTimes::MOST_ROWS);
    Diagnostic::wrong(
        "netlist::too_many_rows",
        message,
        &setting.span,
        "write a longer time, or leave `output` out for 301 rows",
    )
}
