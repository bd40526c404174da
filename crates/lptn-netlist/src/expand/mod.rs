//! A network as a flat netlist in SI units: no includes, no templates, every value where it belongs.
//!
//! It is written from the network that was built, not from what was read, so that whatever made an element comes
//! out as the element; and it can be read again.

mod controls;
mod elements;
mod flat;
mod questions;
mod substances;
mod text;
mod values;

use crate::netlist::Netlist;
pub(crate) use text::string;

use text::Fields;

/// The netlist as far as it is written.
struct Writer<'n> {
    netlist: &'n Netlist,
    text: String,
}

impl Netlist {
    /// The network as a flat netlist, with everything that was set: includes, templates and whatever else stands for
    /// many elements are written out, quantities are in SI units, temperatures in K. Parameters and expressions are
    /// kept. Materials of the library are named, those of the file written if they are used. Read again it is the
    /// same network, and is written as the same text.
    ///
    /// A table of two arguments, and a fit, still name their CSV files, which have to be beside the text.
    pub fn expanded(&self) -> String {
        let mut writer = Writer { netlist: self, text: "format = 1\n".to_owned() };
        if let Some(title) = self.network.title() {
            writer.text += &format!("title = {}\n", string(title));
        }
        writer.parameters();
        writer.tables();
        writer.signals();
        writer.default();
        writer.materials();
        writer.fluids();
        writer.nodes();
        writer.capacitors();
        writer.boundaries();
        writer.controls();
        writer.conductors();
        writer.sources();
        writer.limits();
        writer.run();
        writer.sizes();
        writer.fits();
        writer.text
    }
}

impl Writer<'_> {
    /// A section with one line for each element; none if it is empty.
    fn section(&mut self, heading: &str, fields: &Fields) {
        if !fields.is_empty() {
            self.text += &format!("\n[{heading}]\n{}", fields.lines());
        }
    }
}
