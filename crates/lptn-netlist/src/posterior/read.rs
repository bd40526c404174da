//! `posterior.json` as it is read: whole, or not at all.

use std::borrow::Cow;

use lptn_data::{Diagnostic, FileId, Files, Span};
use lptn_units::{Correlations, Distribution, Spread};

use super::{FORMAT, Posterior, PosteriorOf, PosteriorPrior, PosteriorQuantity};
use crate::json::{Json, JsonValue};

/// Allowed relative difference between a standard error and the covariance of one file.
const SAME: f64 = 1e-6;

const HELP: &str = "use the `posterior.json` that `lptn fit network -o DIR` writes";

/// A file that was read, with its places.
#[derive(Debug)]
pub(crate) struct PosteriorFile {
    pub(crate) posterior: Posterior,
    pub(crate) places: Vec<Span>,
}

/// Error about a posterior, at its place; `named` is the place that names it in the netlist.
pub(crate) fn problem(
    code: &'static str,
    words: impl Into<String>,
    place: Span,
    named: Option<&Span>,
) -> Diagnostic {
    let problem = Diagnostic::error(code, words).at(place, "");
    match named {
        Some(named) => problem.also(named.clone(), "read here"),
        None => problem,
    }
}

type Members<'a> = Vec<(Cow<'a, str>, JsonValue<'a>)>;

/// The first error: code, words, place.
type Wrong = (&'static str, String, Span);

/// An object of the file: its name in messages, its members, its place.
struct Object<'a> {
    words: String,
    members: Members<'a>,
    place: Span,
}

impl PosteriorFile {
    /// Reads a file.
    ///
    /// # Errors
    /// The first deviation from the form that lptn writes.
    pub(crate) fn read(
        files: &Files,
        file: FileId,
        named: Option<&Span>,
    ) -> Result<Self, Diagnostic> {
        let whole = whole(Json { file, text: files.text(file) });
        whole.map_err(|(code, words, place)| problem(code, words, place, named).help(HELP))
    }
}

fn whole(json: Json<'_>) -> Result<PosteriorFile, Wrong> {
    let top = Span::new(json.file, 0..0);
    let value = json.read().map_err(|(words, place)| ("posterior::not_json", words, place))?;
    let not_json = || ("posterior::not_json", "the posterior is not an object".into(), top.clone());
    let members = value.members().ok_or_else(not_json)?;
    let object = Object { words: "the posterior".into(), members, place: top.clone() };
    if object.text("kind").ok().as_deref() != Some("posterior") {
        let words = "this file is not a posterior of a fit".to_owned();
        return Err(("posterior::format", words, top));
    }
    let format = object.get("format")?;
    if format.written() != FORMAT {
        let words =
            format!("the posterior has format {}, this lptn reads {FORMAT}", format.written());
        return Err(("posterior::format", words, format.span()));
    }
    let (mut quantities, mut places) = (Vec::new(), Vec::<Span>::new());
    for (i, value) in object.list("quantities")?.into_iter().enumerate() {
        let found = quantity(i, value)?;
        if quantities.iter().any(|other: &PosteriorQuantity| other.name == found.name) {
            let words = format!("`{}` appears twice in the posterior", found.name);
            return Err(("posterior::member", words, value.span()));
        }
        quantities.push(found);
        places.push(value.span());
    }
    let correlations = joint(&object, &mut quantities)?;
    labelled(&object, &quantities, &correlations)?;
    let (network, fit) = (object.text("network")?, object.text("fit")?);
    let posterior = Posterior { network, fit, quantities, correlations };
    Ok(PosteriorFile { posterior, places })
}

/// The standard deviations of the quantities and their correlations, from the covariance.
fn joint(object: &Object<'_>, quantities: &mut [PosteriorQuantity]) -> Result<Correlations, Wrong> {
    let rows: Vec<Vec<f64>> = object.numbers("covariance")?;
    let place = object.get("covariance")?.span();
    let wrong = |words: String| ("posterior::member", words, place.clone());
    let mut uncertain: Vec<&mut PosteriorQuantity> =
        quantities.iter_mut().filter(|quantity| quantity.spread.is_some()).collect();
    let n = uncertain.len();
    if rows.len() != n || rows.iter().any(|row| row.len() != n) {
        let words = format!("the covariance has to be of {n} rows with {n} numbers each");
        return Err(wrong(words));
    }
    let mut correlations = Correlations::none(n);
    for (i, quantity) in uncertain.iter_mut().enumerate() {
        let variance = rows[i][i];
        if variance <= 0.0 {
            let words = format!("the variance of `{}` has to be more than zero", quantity.name);
            return Err(("posterior::not_definite", words, place.clone()));
        }
        let told = quantity.sigma().unwrap_or(f64::NAN);
        if (variance.sqrt() / told - 1.0).abs() > SAME || told.is_nan() {
            let name = &quantity.name;
            let words =
                format!("the standard error of `{name}` and the covariance contradict each other");
            return Err(wrong(words));
        }
        for (j, other) in rows.iter().enumerate().take(i) {
            let (lower, upper) = (rows[i][j], other[i]);
            let size = (variance * other[j]).sqrt();
            if (lower - upper).abs() > SAME * size {
                return Err(wrong("the covariance is not symmetric".to_owned()));
            }
            correlations.set(i, j, lower / size);
        }
    }
    match correlations.factor() {
        Ok(_) => Ok(correlations),
        Err(i) => {
            let words = format!(
                "the covariance is not positive definite: `{}` and those before it cannot be so \
                 correlated",
                uncertain[i].name
            );
            Err(("posterior::not_definite", words, place))
        }
    }
}

/// Checks the members next to the covariance, if present: the names of its rows, and the
/// correlations.
fn labelled(
    object: &Object<'_>,
    quantities: &[PosteriorQuantity],
    correlations: &Correlations,
) -> Result<(), Wrong> {
    let own: Vec<String> = quantities.iter().filter_map(PosteriorQuantity::coordinate).collect();
    let wrong = |name: &str, words: String| {
        object.get(name).and_then(|found| Err(("posterior::member", words, found.span())))
    };
    if object.member("of").is_some() && object.texts("of")? != own {
        let words = format!(
            "`of` names other rows of the covariance than the quantities do: those with a standard \
             error are {}, in this order",
            lptn_data::list(&own.iter().map(String::as_str).collect::<Vec<_>>())
        );
        return wrong("of", words);
    }
    if object.member("correlation").is_none() {
        return Ok(());
    }
    let (rows, n) = (object.numbers("correlation")?, own.len());
    let same = |at: usize| {
        let (i, j) = (at / n, at % n);
        let found = rows.get(i).and_then(|row| row.get(j)).copied().unwrap_or(f64::NAN);
        (found - correlations.between(i, j)).abs() <= SAME
    };
    let is_square = rows.len() == n && rows.iter().all(|row| row.len() == n);
    match (0..n * n).find(|&at| !(is_square && same(at))) {
        Some(at) => wrong(
            "correlation",
            format!(
                "`correlation` and the covariance contradict each other for {} and {}",
                own[at / n],
                own[at % n]
            ),
        ),
        None => Ok(()),
    }
}

fn quantity(i: usize, value: JsonValue<'_>) -> Result<PosteriorQuantity, Wrong> {
    let object = Object::of(format!("quantity {} of the posterior", i + 1), value)?;
    let name = object.text("name")?;
    let object = Object { words: format!("`{name}` of the posterior"), ..object };
    let of = object.word("of", PosteriorOf::of, "\"parameter\" or \"sensor\"")?;
    let sigma = object.maybe("standard_error")?;
    let found = object.number("value")?;
    let spread = match sigma {
        None => None,
        Some(sigma) => {
            let distribution = object.distribution("distribution")?;
            if sigma <= 0.0 {
                let words = format!("the standard error of `{name}` has to be more than zero");
                return Err(("posterior::member", words, object.get("standard_error")?.span()));
            }
            if distribution == Distribution::Lognormal && found <= 0.0 {
                let words = format!("`{name}` is lognormal and has to be more than zero");
                return Err(("posterior::member", words, object.get("value")?.span()));
            }
            Some(Spread::of(found, sigma, distribution))
        }
    };
    let prior = object.member("prior").filter(|prior| prior.written() != "null");
    let prior = prior.map(|prior| {
        let prior = Object::of(format!("`prior` of `{name}`"), prior)?;
        let (value, sigma) = (prior.number("value")?, prior.number("standard_deviation")?);
        let spread = Spread::of(value, sigma, prior.distribution("distribution")?);
        Ok(PosteriorPrior { value, spread })
    });
    Ok(PosteriorQuantity {
        of,
        value: found,
        unit: object.text("unit")?,
        spread,
        half_width: object.maybe("half_width_95")?,
        degrees_of_freedom: object.maybe("degrees_of_freedom")?,
        bounds: (
            object.maybe("from")?.unwrap_or(f64::NEG_INFINITY),
            object.maybe("to")?.unwrap_or(f64::INFINITY),
        ),
        prior: prior.transpose()?,
        name,
    })
}

impl<'a> Object<'a> {
    fn of(words: String, value: JsonValue<'a>) -> Result<Self, Wrong> {
        let place = value.span();
        match value.members() {
            Some(members) => Ok(Self { words, members, place }),
            None => Err(("posterior::member", format!("{words} is not an object"), place)),
        }
    }

    fn member(&self, name: &str) -> Option<JsonValue<'a>> {
        self.members.iter().find(|(found, _)| found == name).map(|(_, value)| *value)
    }

    fn get(&self, name: &str) -> Result<JsonValue<'a>, Wrong> {
        let words = || format!("{} has no `{name}`", self.words);
        self.member(name).ok_or_else(|| ("posterior::member", words(), self.place.clone()))
    }

    fn wrong(&self, name: &str, wanted: &str, found: JsonValue<'_>) -> Wrong {
        let words = format!("`{name}` of {} has to be {wanted}", self.words);
        ("posterior::member", words, found.span())
    }

    fn text(&self, name: &str) -> Result<String, Wrong> {
        let found = self.get(name)?;
        found.string().ok_or_else(|| self.wrong(name, "a text", found))
    }

    fn word<T>(
        &self,
        name: &str,
        of: impl Fn(&str) -> Option<T>,
        wanted: &str,
    ) -> Result<T, Wrong> {
        let found = self.get(name)?;
        let word = found.string().and_then(|word| of(&word));
        word.ok_or_else(|| self.wrong(name, wanted, found))
    }

    fn distribution(&self, name: &str) -> Result<Distribution, Wrong> {
        self.word(name, Distribution::of, "\"normal\", \"lognormal\" or \"rectangle\"")
    }

    fn number(&self, name: &str) -> Result<f64, Wrong> {
        let found = self.get(name)?;
        found.number().ok_or_else(|| self.wrong(name, "a number", found))
    }

    /// A number; `None` for `null`.
    fn maybe(&self, name: &str) -> Result<Option<f64>, Wrong> {
        match self.member(name) {
            None => Ok(None),
            Some(found) if found.written() == "null" => Ok(None),
            Some(_) => self.number(name).map(Some),
        }
    }

    fn list(&self, name: &str) -> Result<Vec<JsonValue<'a>>, Wrong> {
        let found = self.get(name)?;
        found.items().ok_or_else(|| self.wrong(name, "a list", found))
    }

    /// Words.
    fn texts(&self, name: &str) -> Result<Vec<String>, Wrong> {
        let text = |item: JsonValue<'a>| {
            item.string().ok_or_else(|| self.wrong(name, "a list of texts", item))
        };
        self.list(name)?.into_iter().map(text).collect()
    }

    /// Rows of numbers.
    fn numbers(&self, name: &str) -> Result<Vec<Vec<f64>>, Wrong> {
        let wrong = |found: JsonValue<'_>| self.wrong(name, "rows of numbers", found);
        let row = |row: JsonValue<'a>| {
            let items = row.items().ok_or_else(|| wrong(row))?;
            items.into_iter().map(|item| item.number().ok_or_else(|| wrong(item))).collect()
        };
        self.list(name)?.into_iter().map(row).collect()
    }
}
