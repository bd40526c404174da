//! The fit from which a netlist takes its parameter values.

use std::path::Path;

use lptn_netlist::{Netlist, Taken, similar_file};

use crate::failure::Failure;

/// Fit from which the values of parameters are taken.
#[derive(Debug)]
pub enum Belief<'a> {
    /// The one whose posterior the netlist names, if it names one.
    Named,
    /// The one that wrote this file; the netlist must have all of its parameters.
    File(&'a Path),
    /// The same, but the netlist may lack some or all of them.
    Shared(&'a Path),
    /// None.
    None,
}

impl<'a> Belief<'a> {
    /// The fit of the command line if there is one, else that of the netlist.
    pub fn of(file: Option<&'a Path>) -> Self {
        file.map_or(Self::Named, Self::File)
    }

    /// Gives a netlist the values, if there are any.
    pub fn take(&self, netlist: &mut Netlist) -> Result<(), Failure> {
        let named = match self {
            Self::None => return Ok(()),
            Self::Named => None,
            Self::File(file) => Some((file, Taken::All)),
            Self::Shared(file) => Some((file, Taken::Known)),
        };
        if let Some((file, taken)) = named {
            let unread = |error: &std::io::Error| {
                let near =
                    similar_file(file).map(|near| format!("did you mean {}?", near.display()));
                let help = near.unwrap_or_else(|| {
                    "`lptn fit network FILE -o DIR` writes `DIR/posterior.json`".to_owned()
                });
                Failure::cannot_read(file.display(), error, help)
            };
            let bytes = std::fs::read(file).map_err(|error| unread(&error))?;
            netlist.take_posterior(file, &bytes, taken)?;
        }
        Ok(netlist.believe()?)
    }
}
