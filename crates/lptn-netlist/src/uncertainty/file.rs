//! The file of a posterior, and the parameters that are taken from it.

use std::path::Path;

use lptn_data::{Diagnostic, Files};
use lptn_network::Network;

use super::read::named;
use super::{PosteriorKey, UNCERTAINTY};
use crate::include::Loader;
use crate::near_file::NamedFile;
use crate::posterior::{Believed, PosteriorFile, PosteriorOf};
use crate::raw::RawNetlist;

const NAMED: NamedFile = NamedFile {
    does: "read a posterior",
    verb: "read",
    without_folder: "posterior::without_folder",
    not_found: "posterior::not_found",
    else_help: "; `lptn fit network FILE -o DIR` writes `DIR/posterior.json`",
};

/// A posterior that a netlist names.
pub(crate) type Found = Option<Result<Believed, Diagnostic>>;

/// Reads the posterior that a netlist names, if it names one.
pub(crate) fn load(files: &mut Files, raw: &RawNetlist, loader: Option<&mut Loader<'_>>) -> Found {
    let (text, value) = named(raw.section(UNCERTAINTY.name))?;
    let from = Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new(""));
    let path = from.join(text);
    let bytes = match NAMED.load(&path, value, loader) {
        Ok(bytes) => bytes,
        Err(problem) => return Some(Err(problem)),
    };
    let Ok(text) = String::from_utf8(bytes) else {
        let message = format!("{} is not a text file in UTF-8", path.display());
        let help = "use the `posterior.json` that `lptn fit network -o DIR` writes";
        return Some(Err(Diagnostic::wrong("netlist::not_text", message, &value.span, help)));
    };
    let file = files.add(path.display().to_string(), text);
    let read = PosteriorFile::read(files, file, Some(&value.span));
    Some(read.map(|read| Believed {
        posterior: read.posterior,
        only: None,
        named: Some(value.span.clone()),
        places: read.places,
        top: lptn_data::Span::new(file, 0..0),
    }))
}

impl Believed {
    /// The same with the parameters that the netlist takes.
    pub(crate) fn taken(mut self, key: Option<&PosteriorKey>) -> Self {
        let only = key.and_then(|key| key.only.as_ref());
        self.only = only.map(|only| only.iter().map(|(name, _)| name.clone()).collect());
        self
    }

    /// The places of the parameters that are taken, among the quantities.
    pub fn chosen(&self) -> impl Iterator<Item = usize> + '_ {
        let counts = |name: &String| self.only.as_ref().is_none_or(|only| only.contains(name));
        let all = self.posterior.quantities.iter().enumerate();
        all.filter(move |(_, q)| q.of == PosteriorOf::Parameter && counts(&q.name)).map(|(i, _)| i)
    }
}

/// The parameters of a posterior that a network has.
pub(crate) fn only_known(believed: &Believed, network: &Network) -> Vec<String> {
    let all = believed.posterior.quantities.iter().map(|quantity| &quantity.name);
    all.filter(|name| network.parameter(name).is_ok()).cloned().collect()
}
