//! A netlist that is read once and asked many times.

use std::path::Path;
use std::sync::Arc;

use lptn_netlist::Netlist;

use crate::belief::Belief;
use crate::failure::Failure;
use crate::input::{self, Given, Input};
use crate::memory_files::MemoryFiles;

/// A netlist that is read once and asked many times, each time with other values.
///
/// A question with its values gets the same [`Input`] as if the file were read for it.
#[derive(Clone, Debug)]
pub struct Loaded {
    text: Arc<Given>,
    /// The netlist without any value that is set.
    netlist: Netlist,
    /// Values that are set in every question, before its own.
    set: Vec<String>,
    /// The netlist with these values.
    usual: Arc<Input>,
}

impl Loaded {
    /// Reads a netlist; `set` are values for every question, such as `G_fan = 2 W/K`.
    ///
    /// # Errors
    /// All problems of the netlist or of the values.
    pub fn read(file: impl AsRef<Path>, set: &[String]) -> Result<Self, Failure> {
        Self::read_with(file, &MemoryFiles::default(), set)
    }

    /// The same for a netlist that names files in memory.
    ///
    /// # Errors
    /// As [`Loaded::read`].
    pub fn read_with(
        file: impl AsRef<Path>,
        files: &MemoryFiles,
        set: &[String],
    ) -> Result<Self, Failure> {
        let text = input::read(file.as_ref())?;
        let netlist = files.parse(&text)?;
        Self::of(text, netlist, set)
    }

    /// The same for a text; files that it names are relative to the place of its name.
    ///
    /// # Errors
    /// As [`Loaded::read`].
    pub fn text(name: &str, text: &str, set: &[String]) -> Result<Self, Failure> {
        Self::text_with((name, text), &MemoryFiles::default(), set)
    }

    /// The same for a text that names files in memory.
    ///
    /// # Errors
    /// As [`Loaded::read`].
    pub fn text_with(
        (name, text): (&str, &str),
        files: &MemoryFiles,
        set: &[String],
    ) -> Result<Self, Failure> {
        let text = Given::of(name, text.into());
        let netlist = files.parse(&text)?;
        Self::of(text, netlist, set)
    }

    fn of(text: Given, netlist: Netlist, set: &[String]) -> Result<Self, Failure> {
        let text = Arc::new(text);
        let usual = Input::of((Arc::clone(&text), netlist.clone()), &Belief::Named, (None, set))?;
        Ok(Self { text, netlist, set: set.to_vec(), usual: Arc::new(usual) })
    }

    /// The netlist with the values of every question.
    pub fn usual(&self) -> &Arc<Input> {
        &self.usual
    }

    /// The values of every question.
    pub fn set(&self) -> &[String] {
        &self.set
    }

    /// The netlist with further values: those of a fit, of a load case, then these assignments.
    ///
    /// # Errors
    /// A case that does not exist, and values that do not fit the netlist.
    pub fn input(
        &self,
        belief: &Belief<'_>,
        (case, assignments): (Option<&str>, &[String]),
    ) -> Result<Arc<Input>, Failure> {
        match (belief, case, assignments) {
            (Belief::Named, None, []) => Ok(Arc::clone(&self.usual)),
            (Belief::Named, None, _) => {
                let mut input = Input::clone(&self.usual);
                input.netlist.set(assignments)?;
                input.set.extend_from_slice(assignments);
                Ok(Arc::new(input))
            }
            _ => {
                let set = [&self.set, assignments].concat();
                let read = (Arc::clone(&self.text), self.netlist.clone());
                Ok(Arc::new(Input::of(read, belief, (case, &set))?))
            }
        }
    }
}

impl Given {
    /// The bytes of a text of this name.
    pub(crate) fn of(name: &str, bytes: Vec<u8>) -> Self {
        let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        Self { bytes, name: name.into(), stem: stem.unwrap_or_else(|| "netlist".into()) }
    }
}
