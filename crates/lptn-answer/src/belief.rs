//! Which fit a netlist takes the values of its parameters from.

use std::path::Path;

use lptn_netlist::{Netlist, Taken, similar_file};

use crate::failure::Failure;

/// Which fit the values of parameters are taken from.
#[derive(Debug)]
pub enum Belief<'a> {
    /// The one whose posterior the netlist names, if it names one.
    Named,
    /// The one that wrote this file; the netlist has to have all of its parameters.
    File(&'a Path),
    /// The same where a netlist need not have them all, or any.
    Shared(&'a Path),
    /// None.
    None,
}

impl<'a> Belief<'a> {
    /// That of the command line, else that of the netlist.
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
