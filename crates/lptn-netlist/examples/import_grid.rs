//! Writes a plate of SIDE x SIDE cells as CSV files with the netlist that imports them: SIDE^2
//! nodes, 3 SIDE^2 conductors, SIDE sources.
//! `cargo run --release -p lptn-netlist --example import_grid -- 1000 big`
#![allow(clippy::print_stdout)]

use std::fs::{File, create_dir_all};
use std::io::{self, BufWriter, Write};
use std::path::Path;

const NETLIST: &str = "format = 1
title = \"A plate from CSV files\"

[default]
T0 = \"20 degC\"

[import]
nodes = \"nodes.csv\"
boundaries = \"boundaries.csv\"
conductors = \"conductors.csv\"
sources = \"sources.csv\"

[run]
stop = \"60 s\"
select = [\"n1.T\", \"air.Q\"]
";

fn main() -> io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let side = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(1000);
    let folder = arguments.next().unwrap_or_else(|| "big".to_owned());
    let folder = Path::new(&folder);
    create_dir_all(folder)?;
    let create = |name: &str| File::create(folder.join(name)).map(BufWriter::new);
    create("big.toml")?.write_all(NETLIST.as_bytes())?;
    nodes(create("nodes.csv")?, side)?;
    create("boundaries.csv")?.write_all(b"name,T [degC]\nair,20\nframe,15\n")?;
    conductors(create("conductors.csv")?, side)?;
    sources(create("sources.csv")?, side)?;
    println!("lptn check {}", folder.join("big.toml").display());
    Ok(())
}

fn nodes(mut out: impl Write, side: usize) -> io::Result<()> {
    writeln!(out, "name,C [J/K],T0 [degC]")?;
    (0..side * side)
        .try_for_each(|k| writeln!(out, "n{},{:.3},20", k + 1, 0.5 + (k % 97) as f64 * 1e-3))?;
    out.flush()
}

/// Each cell to its neighbours and to the air; the left and the right edge to the frame.
fn conductors(mut out: impl Write, side: usize) -> io::Result<()> {
    writeln!(out, "from,to,G [W/K]")?;
    for k in 0..side * side {
        let (row, column, name) = (k / side, k % side, k + 1);
        let g = 1.0 + (k % 89) as f64 * 1e-3;
        match column + 1 < side {
            true => writeln!(out, "n{name},n{},{g:.3}", name + 1)?,
            false => writeln!(out, "n{name},frame,{g:.3}")?,
        }
        if row + 1 < side {
            writeln!(out, "n{name},n{},{g:.3}", name + side)?;
        }
        if column == 0 {
            writeln!(out, "n{name},frame,{g:.3}")?;
        }
        writeln!(out, "n{name},air,{:.5}", 1e-3 * g)?;
    }
    out.flush()
}

fn sources(mut out: impl Write, side: usize) -> io::Result<()> {
    writeln!(out, "into,P [W]")?;
    (0..side).try_for_each(|i| {
        writeln!(out, "n{},{:.2}", i * (side + 1) + 1, 0.5 + (i % 11) as f64 * 0.05)
    })?;
    out.flush()
}
