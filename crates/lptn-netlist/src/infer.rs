//! `[infer.NAME]`: time histories of signals to estimate, and the record that determines them.

use lptn_data::{Diagnostic, Span, nearest};
use lptn_network::{Network, Value};
use lptn_units::{EvalError, Type};

use crate::fields::Fields;
use crate::fit::{COLUMNS, FitInitial, FitStudy, OUTLIERS, OUTLIERS_OF, RECORDS, SIGNALS, TIME_OF};
use crate::format::{
    NAMES, Role, SectionDeclaration, Takes, akin, flag, key, shaped, words, words_of,
};
use crate::listed::{Listed, Names};
use crate::names::ValueKind;
use crate::place::Wanted;
use crate::raw::RawEntry;
use crate::reading::all;
use crate::setting::{Setting, TIME};
use crate::study::{PathFrom, Study};
use crate::toml_text::{TomlFields, key as toml_key, value};
use crate::work::Elaboration;

const INFER: SectionDeclaration = SectionDeclaration {
    name: "infer",
    sentence: "Signals to estimate over time, and the record that determines them.",
    role: Role::Study,
    keys: &[
        shaped("data", "file", RECORDS, "the record", "\"record.csv\"").needed(),
        TIME_OF,
        COLUMNS,
        akin("sigma", "as the column", "the standard deviation of one sample", "\"0.2 K\"")
            .or("the most likely value"),
        key("drift", "K", "the standard deviation of a slow part of the noise", "\"0.05 K\"")
            .or("a part of `sigma`, the most likely value"),
        key("drift_time", "s", "the correlation time of this part", "\"5 min\""),
        shaped(
            "find",
            "names of signals, or a table",
            Takes::Either(&[NAMES, Takes::Each(&Takes::Table(&FIND))]),
            "the signals to estimate",
            "[\"P\"]",
        )
        .needed(),
        OUTLIERS_OF,
        SIGNALS,
        words(
            "initial",
            &words_of(&STARTS),
            "known initial temperatures: `T0` of all nodes; those of nodes that are not measured; \
             none",
            "\"free\"",
        )
        .or("`\"network\"`"),
    ],
    example: "{ data = \"record.csv\", column = { ring = \"steel.T\" }, find = [\"P\"] }",
    elsewhere: &[
        ("csv", "the record is `data`: `data = \"record.csv\"`"),
        ("columns", "the result that a column measures is `column = { ring = \"steel.T\" }`"),
        (
            "vary",
            "signals that change over time are `find`; parameters with a `±` are estimated \
            too",
        ),
        ("set", "a parameter has its value in [param], or by `--set`"),
        (
            "change",
            "the change of a signal is next to it: `find = { P = { change = \"50 W\", within = \"1 \
             min\" } }`",
        ),
    ],
    ..SectionDeclaration::NEW
};

/// `P = { change = "50 W", within = "1 min" }` in `find`.
const FIND: SectionDeclaration = SectionDeclaration {
    name: "find",
    keys: &[
        akin("change", "as the signal", "its usual change (1 sigma)", "\"50 W\""),
        key("within", "s", "the time for this change", "\"1 min\""),
        flag("positive", "it stays above 0: its logarithm is estimated", "true").or("`false`"),
        flag("jumps", "it may jump if the record shows a jump", "false")
            .or("`true`, but `false` with `change`"),
    ],
    example: "{ change = \"50 W\", within = \"1 min\" }",
    ..SectionDeclaration::NEW
};

/// One `[infer.NAME]`.
#[derive(Clone, Debug)]
pub struct InferStudy {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The record and the results that its columns measured: a fit that varies nothing.
    pub reads: FitStudy,
    /// The signals to be estimated, in file order; at least one, none twice.
    pub estimated: Vec<EstimatedSignal>,
    /// Knowledge of the initial temperatures.
    pub start: InferStart,
    /// Standard deviation and time of the slow part of the noise.
    drift: Option<(Setting, Setting)>,
}

/// A signal whose time history is to be estimated.
#[derive(Clone, Debug)]
pub struct EstimatedSignal {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// True if it stays above 0.
    pub positive: bool,
    /// True if it may jump when the record indicates this.
    pub jumps: bool,
    /// The place of its name.
    pub span: Span,
    /// Its usual change and the time of that change.
    change: Option<(Value, Value)>,
}

/// Knowledge of the initial temperatures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InferStart {
    /// They are `T0`.
    Network,
    /// Those of measured nodes are unknown.
    Record,
    /// All are unknown.
    Free,
}

const STARTS: [(&str, InferStart); 3] =
    [("network", InferStart::Network), ("record", InferStart::Record), ("free", InferStart::Free)];

impl InferStudy {
    /// For each signal its usual change per root of a second (1 sigma, in SI units, or a factor if
    /// it stays above 0); `None` if it is not given.
    ///
    /// # Errors
    /// The error of the evaluation of a change or a time.
    pub fn changes(&self, network: &Network) -> Result<Vec<Option<f64>>, EvalError> {
        let mut scope = network.evaluation();
        let mut one = |estimated: &EstimatedSignal| match &estimated.change {
            None => Ok(None),
            Some((change, within)) => {
                Ok(Some(change.at(&mut scope)? / within.at(&mut scope)?.sqrt()))
            }
        };
        self.estimated.iter().map(&mut one).collect()
    }

    /// Standard deviation in K and time in s of the slow part of the noise; `None` if not given.
    ///
    /// # Errors
    /// The error of the evaluation of either.
    pub fn drift(&self, network: &Network) -> Result<Option<(f64, f64)>, EvalError> {
        let mut scope = network.evaluation();
        let mut at = |setting: &Setting| setting.value.at(&mut scope);
        self.drift.as_ref().map(|(drift, time)| Ok((at(drift)?, at(time)?))).transpose()
    }

    /// The error of the drift.
    fn unsound_drift(&self, network: &Network) -> Option<Diagnostic> {
        let (drift, time) = self.drift.as_ref()?;
        let setting = match self.drift(network) {
            Err(error) => {
                let message = format!("infer `{}`: {error}", self.name);
                return Some(Diagnostic::error(error.code(), message).at(drift.span.clone(), ""));
            }
            Ok(Some((deviation, _))) if !(deviation >= 0.0 && deviation.is_finite()) => drift,
            Ok(Some((_, lasts))) if !(lasts > 0.0 && lasts.is_finite()) => time,
            Ok(_) => return None,
        };
        let message = format!("{} has to be more than zero", setting.words);
        let problem = Diagnostic::error("netlist::infer_drift", message);
        let help = "`drift = \"0 K\"` means that all noise is white; leave both keys out if it is \
                    not known";
        Some(problem.at(setting.span.clone(), "").help(help))
    }
}

impl Study for InferStudy {
    const SECTION: &'static SectionDeclaration = &INFER;
    const FILES: &'static str = "data";

    const UNNAMED: Option<[&'static str; 4]> =
        Some(["netlist::infer_without_name", "an inference", "", "power"]);

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.infer_study(entry)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let mut problems = self.reads.check(network);
        problems.extend(self.unsound_drift(network));
        let wrong = |message: String, span: &Span| {
            Diagnostic::error("netlist::infer_change", message).at(span.clone(), "")
        };
        match self.changes(network) {
            Err(error) => problems.push(
                Diagnostic::error(error.code(), format!("infer `{}`: {error}", self.name))
                    .at(self.span.clone(), ""),
            ),
            Ok(changes) => {
                for (estimated, change) in self.estimated.iter().zip(changes) {
                    if change.is_some_and(|change| !(change > 0.0 && change.is_finite())) {
                        let message = format!(
                            "the change of `{}` and its time have to be more than zero",
                            estimated.name
                        );
                        let help = "write for example `{ change = \"50 W\", within = \"1 min\" }`; \
                                    a constant is a parameter of `lptn fit network`";
                        problems.push(wrong(message, &estimated.span).help(help));
                    }
                }
            }
        }
        problems
    }

    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        self.reads.put_read(&mut fields, network, path);
        let estimated = |estimated: &EstimatedSignal| {
            let mut own = TomlFields::default();
            if let Some((change, within)) = &estimated.change {
                own.put("change", value(change, change_of(estimated.ty, estimated.positive)));
                own.put("within", value(within, TIME));
            }
            if estimated.positive {
                own.put("positive", "true");
            }
            if estimated.jumps != estimated.change.is_none() {
                own.put("jumps", estimated.jumps.to_string());
            }
            format!("{} = {}", toml_key(&estimated.name), own.inline())
        };
        if let Some((drift, time)) = &self.drift {
            fields.put("drift", drift.written());
            fields.put("drift_time", time.written());
        }
        fields.table("find", self.estimated.iter().map(estimated));
        self.reads.put_recorded(&mut fields);
        if let Some((word, _)) = STARTS[1..].iter().find(|(_, start)| *start == self.start) {
            fields.word("initial", word);
        }
        fields
    }
}

/// The type of a change of a signal.
fn change_of(ty: Type, positive: bool) -> Type {
    if positive { Type::SCALAR } else { Type::of(ty.dimension) }
}

impl<'a> Elaboration<'a> {
    fn infer_study(&mut self, entry: &'a RawEntry) -> Option<InferStudy> {
        let fields = self.fields(&INFER, entry)?;
        self.all_there(&fields, &[])?;
        let estimated = self.estimated_signals(&fields);
        let drift = self.optional_setting(&fields, "drift");
        let time = self.optional_setting(&fields, "drift_time");
        let place = (&fields.owner, &entry.key_span, "netlist::infer_drift");
        let drift = match (drift, time) {
            (Some(drift), Some(time)) => self.drift(place, (drift, time)),
            _ => None,
        };
        let start = self.choice(&fields, "initial", &STARTS);
        let drop_outliers = self.choice(&fields, "outliers", &OUTLIERS);
        let reads = self.recorded_columns(&fields, drop_outliers == Some(true))?;
        if reads.records.len() > 1 {
            let words = fields.owner.field("data");
            let message = format!("{words} names {} records", reads.records.len());
            let span = &reads.records[1].span;
            let help = "name one: several runs need several inferences";
            self.refuse("netlist::infer_records", message, span, help);
            return None;
        }
        let estimated = estimated?;
        for signal in &reads.signals {
            if let Some(both) = estimated.iter().find(|estimated| estimated.name == signal.name) {
                let message = format!(
                    "{} follows a column of the record and is to be estimated",
                    fields.owner.field(&signal.name)
                );
                let problem = Diagnostic::error("netlist::infer_signal", message)
                    .at(both.span.clone(), "to be estimated")
                    .also(signal.span.clone(), "follows this column");
                self.report(problem.help("leave it out of `signal`, or out of `find`"));
                return None;
            }
        }
        let (name, span) = (entry.key.clone(), entry.key_span.clone());
        let reads =
            FitStudy { drop_outliers: drop_outliers?, initial: FitInitial::Network, ..reads };
        Some(InferStudy { name, span, reads, estimated, start: start?, drift: drift? })
    }

    /// `find = ["P"]` or `find = { P = { change = "50 W", within = "1 min" } }`.
    fn estimated_signals(&mut self, fields: &Fields<'a>) -> Option<Vec<EstimatedSignal>> {
        let wanted = Names::Either("a list of signals, or a table of them");
        let names = self.listed(fields, "find", wanted)?;
        let all = all(names.into_iter().map(|one| self.estimated_entry(fields, one)))?;
        for (i, own) in all.iter().enumerate() {
            if all[..i].iter().any(|other| other.name == own.name) {
                let message = format!("{} names `{}` twice", fields.owner.field("find"), own.name);
                self.refuse("netlist::infer_find", message, &own.span, "name each signal once");
                return None;
            }
        }
        Some(all)
    }

    fn estimated_entry(&mut self, fields: &Fields<'a>, one: Listed<'a>) -> Option<EstimatedSignal> {
        let estimated = self.estimated_signal(fields, (one.name, one.span))?;
        let Some(entry) = one.entry else { return Some(estimated) };
        let owner = fields.owner.inside("find").inside(&entry.key);
        let inner = self.inner(&FIND, owner.clone(), entry)?;
        let positive = self.yes_or_no(&inner, "positive")?.unwrap_or(false);
        let jumps = self.yes_or_no(&inner, "jumps")?;
        let (change, within) = (inner.get("change"), inner.get("within"));
        let change = match (change, within) {
            (None, None) => None,
            (Some(change), Some(within)) => {
                let wanted = Wanted::constant(change_of(estimated.ty, positive));
                let change = self.exactly_inside(&owner, ("change", change), wanted);
                let within =
                    self.exactly_inside(&owner, ("within", within), Wanted::constant(TIME));
                Some((change?, within?))
            }
            (one, _) => {
                let missing = if one.is_some() { "within" } else { "change" };
                let message = format!("{} has no `{missing}`", owner.words());
                let problem = inner.missing(missing, message);
                self.report(problem);
                return None;
            }
        };
        let jumps = jumps.unwrap_or(change.is_none());
        Some(EstimatedSignal { positive, jumps, change, ..estimated })
    }

    fn estimated_signal(
        &mut self,
        fields: &Fields<'a>,
        (name, span): (&str, &Span),
    ) -> Option<EstimatedSignal> {
        let kind = self.names.values.get(name).map(|(kind, ..)| *kind);
        if kind != Some(ValueKind::Signal) {
            let message =
                format!("{} names `{name}`, which is not a signal", fields.owner.field("find"));
            let signals = self.elements(ValueKind::Signal.section()).iter();
            let signals: Vec<&str> = signals.map(|entry| entry.key.as_str()).collect();
            let help = match (kind, signals.is_empty()) {
                (Some(ValueKind::Parameter), _) => format!(
                    "`{name}` is a parameter, which does not change in a run: move its line from \
                     [param] to [signal]"
                ),
                (_, true) => format!(
                    "write one to begin with, `[signal]` with `{name} = \"200 W\"`, and use it in \
                     the network, for example `P = \"{name}\"` of a source"
                ),
                (_, false) => nearest(name, signals, "the signals are"),
            };
            self.refuse("netlist::infer_find", message, span, help);
            return None;
        }
        let ty = self.type_here(name)?;
        let (name, span) = (name.to_owned(), span.clone());
        Some(EstimatedSignal { name, ty, positive: false, jumps: true, span, change: None })
    }
}
