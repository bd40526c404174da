//! A grid as the nodes and paths that it stands for.

use super::Variant;
use crate::random::model::{Entry, Field, Net, constant};
use crate::random::random::Random;
use crate::random::units::Kind;

/// Grids along x as chains: cells `rho c V`, `k A/d` between them and `2 k A/d` to a surface.
pub fn grid_written_out(net: &Net, _: &mut Random) -> Option<Variant> {
    let grid = net.of("grid").find(|entry| counts(entry).is_some())?.clone();
    let name = grid.name.clone();
    let count = counts(&grid)?;
    let Some(Field::List(size)) = grid.get("size") else { return None };
    let length = |i: usize| match &size[i] {
        Field::Value(pieces) => match pieces[..] {
            [crate::random::model::Piece::Number(number)] => number.value,
            _ => f64::NAN,
        },
        _ => f64::NAN,
    };
    let value = |key: &str| grid.constant(key).map(|number| number.value);
    let (area, cell) = (length(1) * length(2), length(0) / count as f64);
    let between = value("k")? * area / cell;
    let capacity = value("density")? * value("cp")? * area * cell;
    let mut variant = Variant::of(net);
    let entries = &mut variant.net.entries;
    entries.retain(|entry| entry.name != name);
    let cells: Vec<String> = (1..=count).map(|i| format!("{name}_{i}")).collect();
    let start = grid.get("T0")?.clone();
    for cell in &cells {
        let node = Entry::new("node", cell).with("C", constant(capacity, Kind::Capacity));
        entries.push(node.with("T0", start.clone()));
    }
    let path = |from: &str, to: &str, g: f64| {
        let path = Entry::new("resistor", &format!("{from}_to_{to}"))
            .with("from", Field::Name(from.into()));
        path.with("to", Field::Name(to.into())).with("G", constant(g, Kind::Conductance))
    };
    for pair in cells.windows(2) {
        entries.push(path(&pair[0], &pair[1], between));
    }
    for (face, cell) in [("x0", &cells[0]), ("x1", &cells[count - 1])] {
        let surface = format!("{name}_{face}");
        entries.push(Entry::new("node", &surface).with("massless", Field::Raw("true".into())));
        entries.push(path(cell, &surface, 2.0 * between));
    }
    for entry in entries.iter_mut() {
        attach(entry, &name, (&cells, area));
    }
    let parts = cells
        .iter()
        .enumerate()
        .map(|(i, cell)| (format!("{name}[{}]", i + 1), vec![cell.clone()]));
    variant.parts.extend(parts.map(|(cell, node)| (cell, (node, false))));
    variant.parts.insert(name.clone(), (Vec::new(), false));
    Some(variant)
}

fn counts(grid: &Entry) -> Option<usize> {
    let Some(Field::Raw(text)) = grid.get("cells") else { return None };
    text.trim_matches(['[', ']']).parse().ok()
}

/// What joined the grid joins its nodes.
fn attach(entry: &mut Entry, grid: &str, (cells, area): (&[String], f64)) {
    let mut film = false;
    for (key, field) in &mut entry.fields {
        let Field::Name(name) = field else { continue };
        if name == grid && key == "into" {
            // the shares have to sum to 1
            let share = 1.0 / cells.len() as f64;
            *field = Field::Shares(cells.iter().map(|cell| (cell.clone(), share)).collect());
        } else if let Some(face) = name.strip_prefix(&format!("{grid}.")) {
            film = key != "into";
            *name = format!("{grid}_{face}");
        }
    }
    if film {
        entry.fields.push(("area".into(), constant(area, Kind::Area)));
    }
}
