//! `[uncertainty]`: joint knowledge of parameters, written or from a fit.

mod check;
mod file;
mod read;

pub(crate) use check::{check, joint, known, of_zero};
pub(crate) use file::{Found, load, only_known};
use read::POSTERIOR;

use lptn_data::Span;
use lptn_network::{Network, Parameters};

use crate::format::{Role, SectionDeclaration, Takes, shaped};
use crate::toml_text::{TomlFields, key as toml_key, string, strings};

pub(crate) const UNCERTAINTY: SectionDeclaration = SectionDeclaration {
    name: "uncertainty",
    sentence: "The joint uncertainty of parameters, in addition to the `±` of each.",
    role: Role::Study,
    keys: &[
        shaped(
            "posterior",
            "file, or table with `file` and `only`",
            Takes::Either(&[Takes::Text, Takes::Table(&POSTERIOR)]),
            "values and covariance that a fit found; `only` names the parameters that are taken",
            "\"results/posterior.json\"",
        ),
        shaped(
            "correlation",
            "table of parameters, each with a table of others",
            Takes::Each(&Takes::Each(&Takes::Number)),
            "the correlation of two parameters, more than -1 and less than 1",
            "{ R_skin = { alpha = -0.87 } }",
        ),
    ],
    example: "{ posterior = \"results/posterior.json\" }",
    elsewhere: &[
        ("method", "the method is an option: `lptn run FILE --uncertainty sobol`"),
        ("samples", "their number is an option: `lptn run FILE --uncertainty sobol --samples 512`"),
        ("covariance", "give each parameter its `±` in [param], and pairs their `correlation`"),
    ],
    ..SectionDeclaration::NEW
};

/// The file that a netlist takes a posterior from.
#[derive(Clone, Debug)]
pub(crate) struct PosteriorKey {
    /// Its path as it is written.
    pub(crate) path: String,
    /// The place of the path.
    pub(crate) span: Span,
    /// The parameters that are taken; all unless named.
    pub(crate) only: Option<Vec<(String, Span)>>,
}

/// A correlation as it is written.
#[derive(Clone, Debug)]
pub(crate) struct WrittenCorrelation {
    pub(crate) between: [String; 2],
    pub(crate) value: f64,
    pub(crate) span: Span,
}

/// `[uncertainty]` as it is written.
#[derive(Clone, Debug, Default)]
pub(crate) struct UncertaintyPlan {
    pub(crate) posterior: Option<PosteriorKey>,
    pub(crate) correlations: Vec<WrittenCorrelation>,
}

impl UncertaintyPlan {
    /// Puts the correlations into `parameters`.
    pub(crate) fn correlate(&self, network: &Network, parameters: &mut Parameters) {
        for written in &self.correlations {
            let [a, b] = [0, 1].map(|i: usize| network.parameter(&written.between[i]));
            if let (Ok(a), Ok(b)) = (a, b) {
                parameters.correlate([a, b], written.value);
            }
        }
    }

    /// Its fields as they are written; `path` names files for the text.
    pub(crate) fn fields(&self, path: &dyn Fn(&Span, &str) -> String) -> TomlFields {
        let mut fields = TomlFields::default();
        if let Some(key) = &self.posterior {
            let file = string(&path(&key.span, &key.path));
            let written = match &key.only {
                None => file,
                Some(only) => {
                    let only = strings(only.iter().map(|(name, _)| name.as_str()));
                    format!("{{ file = {file}, only = {only} }}")
                }
            };
            fields.put("posterior", written);
        }
        let mut all: Vec<(&str, Vec<String>)> = Vec::new();
        for written in &self.correlations {
            let [of, with] = &written.between;
            let one = format!("{} = {}", toml_key(with), written.value);
            match all.iter_mut().find(|(name, _)| name == of) {
                Some((_, pairs)) => pairs.push(one),
                None => all.push((of, vec![one])),
            }
        }
        let one = |(of, pairs): &(&str, Vec<String>)| {
            format!("{} = {{ {} }}", toml_key(of), pairs.join(", "))
        };
        fields.table("correlation", all.iter().map(one));
        fields
    }
}
