//! A netlist that Python has loaded.

use std::path::PathBuf;

use lptn::{Exit, Failure, Loaded, Unit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::Answer;
use crate::asking::{answered, failed};
use crate::declaration::About;
use crate::trouble::Trouble;
use crate::verbs::named;
use crate::words;

/// Bytes of a number.
const SIZE: usize = size_of::<f64>();

/// A netlist with the values that were set when it was loaded.
#[pyclass(frozen, module = "lptn._lptn")]
pub(crate) struct Netlist {
    pub(crate) loaded: Loaded,
    file: Option<PathBuf>,
}

/// Assignments of a dictionary.
fn assignments(set: &Bound<'_, PyDict>) -> PyResult<Vec<String>> {
    let one = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let text = words::text(&value)?;
        let wrong = || Trouble::of_type(format!("`{name}` takes a quantity such as \"4 W/K\""));
        Ok(format!("{name}={}", text.ok_or_else(wrong)?))
    };
    set.iter().map(one).collect()
}

#[pymethods]
impl Netlist {
    /// Reads a file.
    #[staticmethod]
    fn read(py: Python<'_>, file: PathBuf, set: &Bound<'_, PyDict>) -> PyResult<Self> {
        let set = assignments(set)?;
        let loaded = py.detach(|| Loaded::read(&file, &set)).map_err(failed)?;
        Ok(Self { loaded, file: Some(file) })
    }

    /// Reads a text.
    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, name: &str, set: &Bound<'_, PyDict>) -> PyResult<Self> {
        let set = assignments(set)?;
        let loaded = py.detach(|| Loaded::text(name, text, &set)).map_err(failed)?;
        Ok(Self { loaded, file: None })
    }

    /// Reads a text that names a file of candidates, which has this name, these headings, and a
    /// column of numbers, each 8 bytes, for each of them.
    #[staticmethod]
    fn with_candidates(
        py: Python<'_>,
        text: (&str, &str),
        file: &str,
        columns: Vec<(String, Vec<u8>)>,
        set: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let set = assignments(set)?;
        let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_ne_bytes);
        let columns = columns.into_iter().map(|(heading, bytes)| {
            (heading, bytes.chunks_exact(SIZE).map(number).collect::<Vec<f64>>())
        });
        let columns: Vec<_> = columns.collect();
        let read = || Loaded::with_columns(text, (file, &columns), &set);
        Ok(Self { loaded: py.detach(read).map_err(failed)?, file: None })
    }

    /// Asks a question of this name; `others` are further netlists of a comparison.
    fn ask(
        &self,
        py: Python<'_>,
        name: &str,
        others: Vec<PathBuf>,
        words: &Bound<'_, PyDict>,
    ) -> PyResult<Answer> {
        let verb = named(name, |about| about != About::Nothing)?;
        let mut files = Vec::new();
        if verb.declared.about == About::Netlists {
            let text =
                || Trouble::of_type(format!("`{name}` reads files: load the network from a file"));
            files.push(self.file.clone().ok_or_else(text)?);
            files.extend(others);
        }
        answered(py, verb, (Some(&self.loaded), files), words)
    }

    /// The doubts about the netlist as JSON; `None` without doubts.
    fn doubts(&self) -> Option<String> {
        let netlist = &self.loaded.usual().netlist;
        let json = || lptn::problems_as_json(&netlist.files, &netlist.warnings).to_string();
        (!netlist.warnings.is_empty()).then(json)
    }

    /// The title, or the name of the file.
    fn title(&self) -> String {
        self.loaded.usual().title()
    }

    /// Names, values and units of the parameters.
    fn parameters(&self) -> Vec<(String, f64, String)> {
        let input = self.loaded.usual();
        let network = &input.netlist.network;
        let one = |id| {
            let (unit, value) = (input.unit_of(id), network.parameter_value(id));
            let name = network.parameters()[id.index()].name.clone();
            (name, unit.from_si(value), unit.text)
        };
        network.parameter_ids().map(one).collect()
    }

    /// Names of the nodes.
    fn nodes(&self) -> Vec<String> {
        let network = &self.loaded.usual().netlist.network;
        network.thermal_nodes().map(|id| network.nodes()[id.index()].name.clone()).collect()
    }

    /// The flat netlist of the same network, if there is one.
    fn to_toml(&self) -> PyResult<String> {
        let netlist = &self.loaded.usual().netlist;
        match netlist.not_flat() {
            Some(problem) => Err(failed(Failure::at(Exit::No, netlist.files.clone(), problem))),
            None => Ok(netlist.expanded()),
        }
    }
}

/// Scale, offset and SI unit of a unit: `si = (value + offset) * scale`.
#[pyfunction]
pub(crate) fn unit(text: &str) -> PyResult<(f64, f64, String)> {
    let unit = Unit::parse(text).map_err(|error| Trouble::of_value(error.to_string()))?;
    let si = if unit.offset > 0.0 { "K".to_owned() } else { unit.ty.dimension.si_unit() };
    Ok((unit.scale, unit.offset, si))
}

/// The text of a quantity of an option, as every question takes it; `None` for `None`.
#[pyfunction]
pub(crate) fn quantity_text(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let wrong = || Trouble::of_type(format!("`{name}` takes a quantity such as \"10 min\""));
    if value.is_none() {
        return Ok(None);
    }
    Ok(Some(words::text(value)?.ok_or_else(wrong)?))
}
