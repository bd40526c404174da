//! The shape of a grid: the lengths of a block, the radii of a cylinder.

use lptn_data::Diagnostic;
use lptn_network::{GridBlock, GridBody, GridCylinder, Input, Substance};
use lptn_units::{Dimension, Type};

use crate::fields::Fields;
use crate::format::words_of;
use crate::place::Wanted;
use crate::work::Elaboration;

/// The word of each shape; true for a round one.
const ROUND: [(&str, bool); 2] = [("block", false), ("cylinder", true)];

/// The words of `shape`.
pub(super) const SHAPES: [&str; 2] = words_of(&ROUND);

/// Keys that only a cylinder has.
const OF_CYLINDER: [&str; 4] = ["r_in", "r_out", "length", "angle"];

const LENGTH: Type = Type::of(Dimension::LENGTH);
const ANGLE: Type = Type::of(Dimension::ANGLE);

/// The lengths of a body.
pub(super) enum Lengths {
    Block([Input; 3]),
    Cylinder { r_in: Option<Input>, r_out: Input, length: Input, angle: Option<Input> },
}

/// The substance of a body, with its conductivity in each direction.
pub(super) type Made = (Substance<Input>, [Input; 3]);

impl Lengths {
    /// The body, cut into cells.
    pub(super) fn body(
        self,
        cells: Vec<usize>,
        (substance, conductivity): Made,
        initial: Option<Input>,
    ) -> GridBody {
        match self {
            Self::Block(size) => GridBlock { size, cells, conductivity, substance, initial }.into(),
            Self::Cylinder { r_in, r_out, length, angle } => {
                GridCylinder { r_in, r_out, length, angle, cells, conductivity, substance, initial }
                    .into()
            }
        }
    }
}

impl<'a> Elaboration<'a> {
    /// True for a cylinder; `None` if the shape is not known.
    pub(super) fn is_round(&mut self, fields: &Fields<'a>) -> Option<bool> {
        let radius = fields.entry("r_out").or(fields.entry("r_in"));
        if let (None, None, Some(entry)) = (fields.get("shape"), fields.get("size"), radius) {
            let message = format!("{} has `{}` but no `shape`", fields.owner.words(), entry.key);
            let problem = Diagnostic::error("netlist::missing_field", message);
            let place = entry.key_span.clone();
            self.report(problem.at(place, "").help("add `shape = \"cylinder\"`"));
            return None;
        }
        self.choice(fields, "shape", &ROUND)
    }

    /// The lengths of a body; `round` is true for a cylinder.
    pub(super) fn shape(&mut self, fields: &Fields<'a>, round: bool) -> Option<Lengths> {
        if !round {
            self.refuse_keys(fields, &OF_CYLINDER, "has no effect on a block");
            return self.lengths(fields).map(Lengths::Block);
        }
        self.refuse_keys(fields, &["size"], "has no effect on a cylinder");
        for key in ["r_out", "length"] {
            self.require(fields, key);
        }
        let mut length = |key| self.input(fields, key, Wanted::constant(LENGTH));
        let [r_in, r_out, long] = ["r_in", "r_out", "length"].map(&mut length);
        let angle = self.input(fields, "angle", Wanted::constant(ANGLE));
        Some(Lengths::Cylinder { r_in, r_out: r_out?, length: long?, angle })
    }
}
