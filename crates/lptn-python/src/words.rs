//! Keyword arguments of Python as the words of a question.

use lptn::suggest;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

use crate::declaration::{Declaration, Kind};
use crate::trouble::Trouble;

/// A value of an option.
#[derive(Clone, Debug)]
enum Value {
    /// A text, or a number as a text.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
    /// True or false.
    Flag(bool),
}

/// The options of a question, and the values of parameters.
#[derive(Debug, Default)]
pub(crate) struct Words {
    options: Vec<(&'static str, Value)>,
    /// Parameters, such as `G_out=4 W/K`.
    pub(crate) set: Vec<String>,
}

/// Takes a word of a dictionary.
type Take<'a> = dyn FnMut(&mut Words, &str, &Bound<'_, PyAny>) -> Result<(), Trouble> + 'a;

impl Words {
    /// Sorts keyword arguments: names of options, else names of parameters.
    ///
    /// `set` is a dictionary of parameters and `options` one of options, for names that are both.
    pub(crate) fn sorted(
        verb: &Declaration,
        given: &Bound<'_, PyDict>,
        is_parameter: &dyn Fn(&str) -> bool,
    ) -> Result<Self, Trouble> {
        let mut words = Self::default();
        for (key, value) in given {
            let key = key.cast::<PyString>().map_err(PyErr::from)?.to_cow()?;
            match &*key {
                // not a word of the question
                "progress" => {}
                "set" => words.each(&value, &mut |words, name, value| words.assign(name, value))?,
                "options" => {
                    words.each(&value, &mut |words, name, value| words.option(verb, name, value))?
                }
                name if verb.option(name).is_none() => {
                    words.unknown(verb, name, &value, is_parameter)?
                }
                name if verb.sets && is_parameter(name) => {
                    return Err(Trouble::of_type(format!(
                        "`{name}` is an option of `{}` and a parameter of the netlist: write \
                         options={{'{name}': ...}} or set={{'{name}': ...}}",
                        verb.name
                    )));
                }
                name => words.option(verb, name, &value)?,
            }
        }
        Ok(words)
    }

    fn each(&mut self, given: &Bound<'_, PyAny>, take: &mut Take<'_>) -> Result<(), Trouble> {
        let given = given.cast::<PyDict>().map_err(PyErr::from)?;
        for (name, value) in given {
            take(self, &name.extract::<String>()?, &value)?;
        }
        Ok(())
    }

    /// A name that is not an option: a parameter, unless it is nearly an option.
    fn unknown(
        &mut self,
        verb: &Declaration,
        name: &str,
        value: &Bound<'_, PyAny>,
        is_parameter: &dyn Fn(&str) -> bool,
    ) -> Result<(), Trouble> {
        if verb.sets && is_parameter(name) {
            return self.assign(name, value);
        }
        match suggest(name, verb.options.iter().map(|option| option.name)) {
            None if verb.sets => self.assign(name, value),
            Some(near) => Err(Trouble::of_type(format!(
                "`{}` has no option `{name}`: did you mean `{near}`?",
                verb.name
            ))),
            None => Err(Trouble::of_type(format!("`{}` has no option `{name}`", verb.name))),
        }
    }

    fn assign(&mut self, name: &str, value: &Bound<'_, PyAny>) -> Result<(), Trouble> {
        let text = match read(name, value)? {
            Some(Value::Text(text)) => text,
            // lists are variants of a comparison
            Some(Value::Texts(texts)) => texts.join(","),
            Some(Value::Flag(_)) | None => return Err(wrong(name, "a quantity", value)),
        };
        self.set.push(format!("{name}={text}"));
        Ok(())
    }

    fn option(
        &mut self,
        verb: &Declaration,
        name: &str,
        value: &Bound<'_, PyAny>,
    ) -> Result<(), Trouble> {
        let Some(option) = verb.option(name) else {
            return Err(Trouble::of_type(format!("`{}` has no option `{name}`", verb.name)));
        };
        let Some(value_read) = read(name, value)? else { return Ok(()) };
        let taken = match (option.kind, value_read) {
            (Kind::Text | Kind::Count, Value::Text(text)) => Value::Text(text),
            (Kind::Texts, Value::Text(text)) => Value::Texts(vec![text]),
            (Kind::Texts, Value::Texts(texts)) => Value::Texts(texts),
            (Kind::Flag | Kind::FlagOrText, Value::Flag(flag)) => Value::Flag(flag),
            (Kind::FlagOrText, Value::Text(text)) => Value::Text(text),
            (Kind::FlagOrText, Value::Texts(texts)) => Value::Text(texts.join(",")),
            (kind, _) => return Err(wrong(name, kind.words(), value)),
        };
        self.options.push((option.name, taken));
        Ok(())
    }

    fn value(&self, name: &str) -> Option<&Value> {
        self.options.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// The text of an option.
    pub(crate) fn text(&self, name: &str) -> Option<String> {
        match self.value(name)? {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    /// The texts of an option; none if it is not given.
    pub(crate) fn texts(&self, name: &str) -> Vec<String> {
        match self.value(name) {
            Some(Value::Texts(texts)) => texts.clone(),
            _ => Vec::new(),
        }
    }

    /// True if a flag is given.
    pub(crate) fn flag(&self, name: &str) -> bool {
        matches!(self.value(name), Some(Value::Flag(true)))
    }

    /// The value of an option that may stand without one: `foster=True` or `foster=3`.
    pub(crate) fn flag_or_text(&self, name: &str) -> Option<Option<String>> {
        match self.value(name)? {
            Value::Flag(false) => None,
            Value::Flag(true) => Some(None),
            _ => Some(self.text(name)),
        }
    }

    /// A whole number.
    pub(crate) fn count<T: std::str::FromStr>(&self, name: &str) -> Result<Option<T>, Trouble> {
        self.text(name).map(|text| whole(name, &text)).transpose()
    }

    /// One of a list of words.
    pub(crate) fn one_of<T: Copy>(
        &self,
        name: &str,
        all: &[T],
        key: fn(T) -> &'static str,
    ) -> Result<Option<T>, Trouble> {
        let Some(text) = self.text(name) else { return Ok(None) };
        let found = all.iter().copied().find(|choice| key(*choice) == text);
        let keys = || all.iter().map(|choice| key(*choice)).collect::<Vec<_>>().join(", ");
        let no = || Trouble::of_value(format!("`{name}` is one of {}, not `{text}`", keys()));
        found.map(Some).ok_or_else(no)
    }
}

/// A whole number in a text.
pub(crate) fn whole<T: std::str::FromStr>(name: &str, text: &str) -> Result<T, Trouble> {
    let no = |_| Trouble::of_value(format!("`{name}` must be a whole number, got `{text}`"));
    text.parse().map_err(no)
}

fn wrong(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> Trouble {
    let class = value.get_type();
    let class = class.name().map_or_else(|_| "this".to_owned(), |name| name.to_string());
    Trouble::of_type(format!("`{name}` takes {wanted}, not {class}"))
}

/// A value of Python; `None` for `None`.
fn read(name: &str, value: &Bound<'_, PyAny>) -> Result<Option<Value>, Trouble> {
    if value.is_none() {
        return Ok(None);
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Some(Value::Flag(flag.is_true())));
    }
    if let Some(text) = text(value)? {
        return Ok(Some(Value::Text(text)));
    }
    if !(value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>()) {
        return Err(wrong(name, "a text, or a number with its unit: (10, \"min\")", value));
    }
    let each = |item: PyResult<Bound<'_, PyAny>>| {
        let item = item?;
        text(&item)?.ok_or_else(|| wrong(name, "texts in its list", &item))
    };
    Ok(Some(Value::Texts(value.try_iter()?.map(each).collect::<Result<_, _>>()?)))
}

/// The text of a text, a path, a number, a `timedelta`, or a number with its unit: `(4.5, "W/K")`, a
/// result.
pub(crate) fn text(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Some(text.to_cow()?.into_owned()));
    }
    if let Ok(pair) = value.cast::<PyTuple>()
        && pair.len() == 2
        && let Some(number) = number(&pair.get_item(0)?)
        && let Ok(unit) = pair.get_item(1)?.cast::<PyString>()
    {
        return Ok(Some(format!("{number} {unit}")));
    }
    if let Some(number) = number(value) {
        let unit = value.getattr_opt("unit")?.filter(|unit| !unit.is_none());
        return Ok(Some(unit.map_or_else(|| number.clone(), |unit| format!("{number} {unit}"))));
    }
    if let Some(seconds) = value.getattr_opt("total_seconds")? {
        return Ok(Some(format!("{:?} s", seconds.call0()?.extract::<f64>()?)));
    }
    match value.getattr_opt("__fspath__")? {
        Some(path) => path.call0()?.extract().map(Some),
        None => Ok(None),
    }
}

/// The digits of a number that read back as the same number.
fn number(value: &Bound<'_, PyAny>) -> Option<String> {
    if value.is_instance_of::<PyInt>() {
        return value.str().ok().map(|text| text.to_string());
    }
    let is_number = value.is_instance_of::<PyFloat>() || value.hasattr("__float__").ok()?;
    let number = is_number.then(|| value.extract::<f64>().ok()).flatten()?;
    Some(format!("{number:?}"))
}
