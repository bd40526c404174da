//! A netlist that Python has loaded.

use std::path::{Path, PathBuf};

use lptn::{Exit, Failure, Loaded, Unit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::answer::Answer;
use crate::asking::{answered, failed};
use crate::declaration::About;
use crate::memory::Files;
use crate::trouble::Trouble;
use crate::verbs::named;
use crate::words;

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

/// The folder of a netlist, and the names of files in memory.
fn named_in(netlist: &Path, files: &Files) -> (PathBuf, Vec<String>) {
    let folder = netlist.parent().unwrap_or(Path::new("")).to_owned();
    (folder, files.iter().map(|(name, _)| name.clone()).collect())
}

/// Refuses a file in memory that a netlist does not read.
fn all_read(loaded: &Loaded, (folder, names): &(PathBuf, Vec<String>)) -> PyResult<()> {
    let files = &loaded.usual().netlist.files;
    // the first text is the netlist
    let read: Vec<&Path> = files.ids().skip(1).map(|id| Path::new(files.name(id))).collect();
    let Some(name) = names.iter().find(|name| !read.contains(&&*folder.join(name))) else {
        return Ok(());
    };
    let own = read.iter().map(|path| path.strip_prefix(folder).unwrap_or(path).display());
    let own: Vec<String> = own.map(|path| path.to_string()).collect();
    let own = if own.is_empty() { "none".to_owned() } else { own.join(", ") };
    let message = format!("the netlist reads no file `{name}`: it reads {own}");
    Err(Trouble::of_value(message).into())
}

#[pymethods]
impl Netlist {
    /// Reads a file; those that it names may be in memory.
    #[staticmethod]
    fn read(
        py: Python<'_>,
        file: PathBuf,
        set: &Bound<'_, PyDict>,
        files: Files,
    ) -> PyResult<Self> {
        let set = assignments(set)?;
        let names = named_in(&file, &files);
        let read = || Loaded::read_with(&file, &files.into(), &set);
        let loaded = py.detach(read).map_err(failed)?;
        all_read(&loaded, &names)?;
        Ok(Self { loaded, file: Some(file) })
    }

    /// Reads a text; the files that it names may be in memory.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: &str,
        name: &str,
        set: &Bound<'_, PyDict>,
        files: Files,
    ) -> PyResult<Self> {
        let set = assignments(set)?;
        let names = named_in(Path::new(name), &files);
        let read = || Loaded::text_with((name, text), &files.into(), &set);
        let loaded = py.detach(read).map_err(failed)?;
        all_read(&loaded, &names)?;
        Ok(Self { loaded, file: None })
    }

    /// The records of studies that fit or infer: section, name, and files as the netlist names them.
    fn records(&self) -> Vec<(&'static str, String, Vec<String>)> {
        let studies = &self.loaded.usual().netlist.studies;
        let fits = studies.fits.iter().map(|study| ("fit", &study.name, study));
        let inferred = studies.infers.iter().map(|study| ("infer", &study.name, &study.reads));
        let all = fits.chain(inferred).map(|(section, name, study)| {
            let csv = study.records.iter().map(|record| record.csv.clone());
            (section, name.clone(), csv.collect())
        });
        all.collect()
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
        answered(py, verb, (Some(&self.loaded), files, Vec::new()), words)
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
