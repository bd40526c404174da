//! `[fit.NAME]`: parameters to estimate, and the records that determine them.
//!
//! `FitStudy` keeps the text of `[fit]`; `FitStudy::plan` has its numbers, because `--set` changes
//! them.

mod data;
mod declaration;
mod read;
mod recorded;

use std::sync::Arc;

use lptn_data::{CsvOptions, Diagnostic, Record, RecordName, RecordQuery, Span};
use lptn_network::{End, Network, ParameterId, Parameters, Value, Varied};
use lptn_units::{Correlations, EvalError, Type};

use crate::csv_form;
use crate::format::SectionDeclaration;
use crate::raw::RawEntry;
use crate::study::{PathFrom, Study, type_of};
use crate::toml_text::{TomlFields, key as toml_key, like, string, value};
use crate::work::Elaboration;

pub(crate) use declaration::{COLUMNS, OUTLIERS_OF, RECORDS, SIGNALS, TIME_OF};
use declaration::{FIT, FIT_COLUMN, FIT_SIGNAL, RECORD};
pub(crate) use read::{Measured, OUTLIERS};
pub use recorded::{FitInitial, FitSignal};

/// One `[fit.NAME]`, as it is written; [`FitStudy::plan`] has its numbers.
#[derive(Clone, Debug)]
pub struct FitStudy {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The records, in file order; at least one.
    pub records: Vec<FitRecord>,
    /// The results that their columns measured; at least one.
    pub observed: Vec<Observed>,
    /// The names of the parameters to estimate, in file order; at least one, none twice.
    pub varied: Vec<VariedName>,
    /// The signals that follow columns of the records.
    pub signals: Vec<FitSignal>,
    /// True if outliers, which no time history explains, were left out.
    pub drop_outliers: bool,
    /// Initial temperatures of the measured nodes.
    pub initial: FitInitial,
    /// The column of the times, if it is named.
    pub(crate) time: Option<String>,
}

/// A record of a fit, and the network that it was measured on.
#[derive(Clone, Debug)]
pub struct FitRecord {
    /// The file, as the netlist names it.
    pub csv: String,
    /// The columns that are observed, in the order of [`FitStudy::observed`].
    pub record: Arc<Record>,
    /// Parameters with separate values for this record, by name.
    pub(crate) set: Vec<(String, Value)>,
    /// Statements about the form of the file.
    pub(crate) form: CsvOptions,
    /// The place of the file name.
    pub span: Span,
}

impl FitRecord {
    /// True if it has a separate value for a parameter.
    pub fn sets(&self, parameter: &str) -> bool {
        self.set.iter().any(|(name, _)| name == parameter)
    }
}

/// A column of the records, and the result it measures.
#[derive(Clone, Debug)]
pub struct Observed {
    /// The column.
    pub column: String,
    /// The result as it is written, `steel.T`: a temperature, a heat flow, or an expression of
    /// results.
    pub text: String,
    /// The node or boundary, if the result is its temperature.
    pub end: Option<End>,
    /// The result; it reads temperatures and heats, see
    /// [`lptn_network::Evaluation::set_temperatures`].
    pub value: Value,
    /// The type of the result.
    pub ty: Type,
    /// The standard deviation of one sample, if given.
    pub(crate) sigma: Option<Value>,
    /// The instrument, by its name, if one is named.
    pub sensor: Option<String>,
    /// Its place.
    pub span: Span,
}

/// A parameter to estimate.
#[derive(Clone, Debug)]
pub struct VariedName {
    /// Its name.
    pub name: String,
    /// The place of its name.
    pub span: Span,
    pub(crate) from: Option<Value>,
    pub(crate) to: Option<Value>,
}

impl VariedName {
    /// True if it has a least or a greatest value.
    pub fn has_range(&self) -> bool {
        self.from.is_some() || self.to.is_some()
    }
}

/// The numbers of a [`FitStudy`] for the parameters of a network, in SI units.
#[derive(Clone, Debug)]
pub struct FitPlan {
    /// The parameters to estimate, in file order.
    pub varied: Vec<Varied>,
    /// Correlations of their priors, in their order.
    pub correlations: Correlations,
    /// The standard deviation of one sample of each of [`FitStudy::observed`], in the unit of its
    /// type (K for a temperature); `None` if none is given.
    pub sigmas: Vec<Option<f64>>,
    /// For each of [`FitStudy::records`] the parameters that its run starts from: everything that
    /// was set, and the values of the record. The varied parameters are to be set in addition.
    pub parameters: Vec<Parameters>,
}

impl FitStudy {
    /// The query to read a further record: the columns that are observed, then those that signals
    /// follow.
    pub fn query(&self) -> RecordQuery {
        let named = |name: &str, ty: Type| RecordName { ty: Some(ty), ..RecordName::new(name) };
        let observed = self.observed.iter().map(|observed| named(&observed.column, observed.ty));
        let followed = self.signals.iter().map(|signal| named(&signal.column, signal.ty));
        RecordQuery {
            time: self.time.as_deref().map(RecordName::new),
            columns: observed.chain(followed).collect(),
            ..RecordQuery::default()
        }
    }

    /// The numbers for the parameters of `network`; `set` contains the values that were set in it,
    /// see [`Netlist::overrides`](crate::Netlist::overrides).
    ///
    /// # Errors
    /// The error of the evaluation of a bound, a deviation or a value of a record.
    pub fn plan(&self, network: &Network, set: &Parameters) -> Result<FitPlan, EvalError> {
        let mut scope = network.evaluation();
        let mut at = |value: &Value| value.at(&mut scope);
        let mut varied = Vec::with_capacity(self.varied.len());
        for entry in &self.varied {
            let Ok(parameter) = network.parameter(&entry.name) else { continue };
            let from = entry.from.as_ref().map_or(Ok(f64::NEG_INFINITY), &mut at)?;
            let to = entry.to.as_ref().map_or(Ok(f64::INFINITY), &mut at)?;
            let own = network.parameters()[parameter.index()].deviation;
            let value = network.parameter_value(parameter);
            let sigma = set.deviation(parameter).or(own).map(|spread| spread.sigma(value));
            let prior = sigma.filter(|sigma| *sigma > 0.0);
            varied.push(Varied { parameter, bounds: (from, to), prior });
        }
        let sigmas: Result<_, _> = self
            .observed
            .iter()
            .map(|observed| observed.sigma.as_ref().map(&mut at).transpose())
            .collect();
        let mut parameters = Vec::with_capacity(self.records.len());
        for record in &self.records {
            let mut own = set.clone();
            for (name, value) in &record.set {
                if let Ok(id) = network.parameter(name) {
                    own.set(id, at(value)?);
                }
            }
            parameters.push(own);
        }
        let ids: Vec<ParameterId> = varied.iter().map(|varied| varied.parameter).collect();
        let correlations = set.correlations_of(&ids);
        Ok(FitPlan { varied, correlations, sigmas: sigmas?, parameters })
    }

    fn check_range(
        &self,
        network: &Network,
        (entry, varied): (&VariedName, &Varied),
    ) -> Option<Diagnostic> {
        let (name, fit) = (&entry.name, &self.name);
        let at = |message: String| {
            Diagnostic::error("netlist::fit_range", message).at(entry.span.clone(), "")
        };
        let (from, to) = varied.bounds;
        if from >= to {
            let message =
                format!("`vary` of fit `{fit}`: `from` of `{name}` has to be less than `to`");
            return Some(
                at(message).help("write the least value as `from` and the largest as `to`"),
            );
        }
        let start = network.parameter_value(varied.parameter);
        if (from..=to).contains(&start) {
            return None;
        }
        let ty = network.parameters()[varied.parameter.index()].ty;
        let unit = if ty.absolute { "K".to_owned() } else { ty.dimension.si_unit() };
        let start = lptn_units::format_short(start);
        let message = format!(
            "`vary` of fit `{fit}`: the range of `{name}` does not contain its own value, {start} \
             {unit}, from which the search starts"
        );
        Some(
            at(message)
                .help("make the range wider, or give the parameter another value in [param]"),
        )
    }
}

impl Study for FitStudy {
    const SECTION: &'static SectionDeclaration = &FIT;
    const FILES: &'static str = "data";

    const UNNAMED: Option<[&'static str; 4]> =
        Some(["netlist::fit_without_name", "a fit", "below [fit]", "heat_up"]);

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.fit_study(entry)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let plan = match self.plan(network, &network.overrides()) {
            Ok(plan) => plan,
            Err(error) => {
                let message = format!("fit `{}`: {error}", self.name);
                return vec![Diagnostic::error(error.code(), message).at(self.span.clone(), "")];
            }
        };
        let mut problems = Vec::new();
        for (entry, varied) in self.varied.iter().zip(&plan.varied) {
            problems.extend(self.check_range(network, (entry, varied)));
        }
        for (observed, sigma) in self.observed.iter().zip(&plan.sigmas) {
            if sigma.is_some_and(|sigma| !(sigma > 0.0 && sigma.is_finite())) {
                let message = format!(
                    "the standard deviation of column `{}` has to be more than zero",
                    observed.column
                );
                let problem =
                    Diagnostic::error("netlist::fit_sigma", message).at(observed.span.clone(), "");
                problems.push(
                    problem
                        .help("write the scatter of one sample, for example `sigma = \"0.2 K\"`"),
                );
            }
        }
        problems
    }

    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        self.put_read(&mut fields, network, path);
        let varied = |varied: &VariedName| {
            let (mut range, ty) = (TomlFields::default(), type_of(network, &varied.name));
            range.maybe("from", varied.from.as_ref().map(|end| like(end, ty)));
            range.maybe("to", varied.to.as_ref().map(|end| like(end, ty)));
            format!("{} = {}", toml_key(&varied.name), range.inline())
        };
        fields.table("vary", self.varied.iter().map(varied));
        self.put_recorded(&mut fields);
        fields
    }
}

impl FitStudy {
    /// Writes the records and the results that their columns measured.
    pub(crate) fn put_read(&self, fields: &mut TomlFields, network: &Network, path: &PathFrom<'_>) {
        let record = |record: &FitRecord| {
            let csv = path(record.span.file, &record.csv);
            let own = record.set.iter();
            let own = own.map(|(name, own)| {
                format!("{} = {}", toml_key(name), like(own, type_of(network, name)))
            });
            csv_form::written_with(&csv, &record.form, ("set", own.collect()))
        };
        let records: Vec<String> = self.records.iter().map(record).collect();
        fields.put("data", format!("[{}]", records.join(", ")));
        fields.maybe("time", self.time.as_deref().map(string));
        let column = |observed: &Observed| {
            let (name, of) = (toml_key(&observed.column), string(&observed.text));
            let mut more = TomlFields::default();
            more.put("of", &of);
            let sigma = observed.sigma.as_ref();
            more.maybe("sigma", sigma.map(|sigma| value(sigma, Type::of(observed.ty.dimension))));
            more.maybe("sensor", observed.sensor.as_deref().map(string));
            match (&observed.sigma, &observed.sensor) {
                (None, None) => format!("{name} = {of}"),
                _ => format!("{name} = {}", more.inline()),
            }
        };
        fields.table("column", self.observed.iter().map(column));
    }
}
