//! Writes a field for ParaView.

use std::fmt::Write as _;

use lptn_report::{Shortest, plain};
use lptn_units::Unit;

use crate::field::GridField;

/// Letters of a title that the format takes.
const TITLE: usize = 200;

/// The largest angle in rad that a cell of a written cylinder spans: wider ones are written as
/// several.
const ARC: f64 = std::f64::consts::PI / 18.0;

/// A field as a legacy VTK file in ASCII (VTK File Formats, Kitware, "Simple legacy formats"): an
/// image whose cells have a temperature in `unit`. x runs fastest. A cylinder is a structured grid
/// whose axis is z; cells of more than 10 deg are written as several, with flat sides, and those
/// at the axis have corners that coincide.
pub fn vtk(field: &GridField, title: &str, unit: &Unit) -> String {
    let mut number = Shortest::new();
    let title: String = plain(title).chars().take(TITLE).collect();
    if field.is_round() {
        return cylinder(field, &title, unit);
    }
    let points = field.cells.map(|cells| (cells + 1).to_string());
    let spacing = [0, 1, 2].map(|axis| field.ends(axis)[1] / field.cells[axis] as f64);
    let spacing = spacing.map(|length| number.text(length).to_owned());
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

/// A cylinder: r runs fastest, then phi, then z.
fn cylinder(field: &GridField, title: &str, unit: &Unit) -> String {
    let mut number = Shortest::new();
    let [r, phi, z] = [0, 1, 2].map(|axis| field.along[axis].borders.as_slice());
    let arcs = ((phi[1] - phi[0]) / ARC - 1e-9).ceil().max(1.0) as usize;
    let angles = angles(phi, arcs);
    let counts = [r.len(), angles.len(), z.len()];
    let mut out = format!(
        "# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS {} {} \
         {}\nPOINTS {} double\n",
        counts[0],
        counts[1],
        counts[2],
        counts.iter().product::<usize>(),
    );
    for &height in z {
        for angle in &angles {
            for radius in r {
                for (value, end) in
                    [(radius * angle.cos(), ' '), (radius * angle.sin(), ' '), (height, '\n')]
                {
                    out.push_str(number.text(value));
                    out.push(end);
                }
            }
        }
    }
    let cells = field.kelvin.len() * arcs;
    let _ =
        write!(out, "CELL_DATA {cells}\nSCALARS T_{} double 1\nLOOKUP_TABLE default\n", unit.text);
    for k in 0..field.cells[2] {
        for piece in 0..field.cells[1] * arcs {
            for i in 0..field.cells[0] {
                out.push_str(number.text(unit.from_si(field.at([i, piece / arcs, k]))));
                out.push('\n');
            }
        }
    }
    out
}

/// The borders of cells around the axis in rad, with those of their pieces.
fn angles(borders: &[f64], pieces: usize) -> Vec<f64> {
    let inside = borders.windows(2).flat_map(|pair| {
        let step = (pair[1] - pair[0]) / pieces as f64;
        (0..pieces).map(move |i| pair[0] + step * i as f64)
    });
    inside.chain(borders.last().copied()).collect()
}

#[cfg(test)]
mod tests {
    use lptn_network::{Form, GridAxis};
    use lptn_units::Unit;

    use super::vtk;
    use crate::field::tests::block;

    /// A quarter of a ring in two cells of 45 deg is written in pieces of 9 deg: the points lie on
    /// both radii, and each piece has the temperature of its cell.
    #[test]
    fn a_cylinder_is_written_in_pieces() {
        let mut field = block();
        field.form = Form::Cylinder { solid: false, closed: false };
        field.cells = [1, 2, 1];
        field.along = [
            GridAxis { borders: vec![1.0, 2.0], nodes: vec![1.5] },
            GridAxis::even(std::f64::consts::FRAC_PI_2, 2),
            GridAxis::even(3.0, 1),
        ];
        field.kelvin = vec![300.0, 400.0];
        let text = vtk(&field, "", &Unit::parse("K").unwrap());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[3..6],
            ["DATASET STRUCTURED_GRID", "DIMENSIONS 2 11 2", "POINTS 44 double"]
        );
        assert_eq!(lines[6..8], ["1 0 0", "2 0 0"]);
        for line in &lines[6..50] {
            let point: Vec<f64> = line.split(' ').map(|x| x.parse().unwrap()).collect();
            let radius = point[0].hypot(point[1]);
            assert!((radius - 1.0).abs() < 1e-12 || (radius - 2.0).abs() < 1e-12, "{line}");
        }
        assert_eq!(lines[50], "CELL_DATA 10");
        assert_eq!(lines[53..].join(" "), format!("{}{}", "300 ".repeat(5), "400 400 400 400 400"));
    }

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
