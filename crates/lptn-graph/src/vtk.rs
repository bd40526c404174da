//! Writes a field for ParaView.

use std::fmt::Write as _;

use lptn_report::{Shortest, plain};
use lptn_units::Unit;

use crate::field::GridField;

/// Letters of a title that the format takes.
const TITLE: usize = 200;

/// A field as a legacy VTK file in ASCII (VTK File Formats, Kitware, "Simple legacy formats"): an
/// image whose cells have a temperature in `unit`. x runs fastest.
pub fn vtk(field: &GridField, title: &str, unit: &Unit) -> String {
    let mut number = Shortest::new();
    let title: String = plain(title).chars().take(TITLE).collect();
    let points = field.cells.map(|cells| (cells + 1).to_string());
    let spacing = field.spacing().map(|length| number.text(length).to_owned());
    let mut out = String::new();
    let _ = write!(
        out,
        "# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS \
         {}\nORIGIN 0 0 0\nSPACING {}\nCELL_DATA {}\nSCALARS T_{} double 1\nLOOKUP_TABLE \
         default\n",
        points.join(" "),
        spacing.join(" "),
        field.kelvin.len(),
        unit.text,
    );
    let [x, y, z] = field.cells;
    for k in 0..z {
        for j in 0..y {
            for i in 0..x {
                out.push_str(number.text(unit.from_si(field.at([i, j, k]))));
                out.push('\n');
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use lptn_units::Unit;

    use super::vtk;
    use crate::field::tests::block;

    /// The layout of Kitware's "VTK File Formats": points are one more than cells, x runs fastest.
    #[test]
    fn x_runs_fastest() {
        let text = vtk(&block(), "two\nlines", &Unit::parse("K").unwrap());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[..4],
            ["# vtk DataFile Version 3.0", "two lines", "ASCII", "DATASET STRUCTURED_POINTS"]
        );
        assert_eq!(
            lines[4..8],
            ["DIMENSIONS 3 4 5", "ORIGIN 0 0 0", "SPACING 0.01 0.02 0.005", "CELL_DATA 24"]
        );
        assert_eq!(lines[8..10], ["SCALARS T_K double 1", "LOOKUP_TABLE default"]);
        assert_eq!(lines[10..16], ["0", "100", "10", "110", "20", "120"]);
        assert_eq!((lines[16], lines.len()), ("1", 10 + 24));
    }
}
