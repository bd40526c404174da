//! Grids: names, places, conductances and capacities of cells, surfaces of faces, what is joined to
//! them and how.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{celsius, codes, near, quantity};
use lptn_network::{
    Conductance, ConductorFlow, ConductorKind, End, Face, Formula, GridBlock, GridFace, GridId,
    GridValue, HeatCapacity, HeatFlow, Item, Network, NetworkBuilder, Path, Properties, Resistance,
    Size, Substance, Temperature,
};

/// 0.6 m x 0.4 m x 0.2 m, 8e6 J/(m^3 K) / 2, conductivity by axis.
fn block(cells: &[usize]) -> GridBlock {
    GridBlock {
        size: ["0.6 m", "0.4 m", "0.2 m"].map(quantity),
        cells: cells.to_vec(),
        conductivity: ["10 W/(m K)", "20 W/(m K)", "30 W/(m K)"].map(quantity),
        substance: Substance::Properties {
            density: quantity("8000 kg/m^3"),
            cp: quantity("500 J/(kg K)"),
        },
        initial: Some(celsius("20 degC")),
    }
}

fn wall(cells: &[usize]) -> (NetworkBuilder, GridId) {
    let mut b = NetworkBuilder::new();
    let grid = b.grid("wall", block(cells));
    (b, grid)
}

fn conductance(network: &Network, name: &str) -> f64 {
    let Ok(Item::Conductor(id)) = network.item(name) else { panic!("{name}") };
    network.conductance(id).unwrap()
}

fn ends(network: &Network, name: &str) -> [String; 2] {
    let Ok(Item::Conductor(id)) = network.item(name) else { panic!("{name}") };
    let conductor = &network.conductors()[id.index()];
    [conductor.from, conductor.to].map(|end| network.name_of(end.into()).into_owned())
}

#[test]
fn cells_share_the_block() {
    let (b, id) = wall(&[3, 2, 2]);
    let network = b.build().unwrap();
    let grid = &network.grids()[id.index()];
    assert_eq!((grid.count(), grid.cells, grid.axes), (12, [3, 2, 2], 3));
    assert_eq!(network.nodes().len(), 12);
    let total: f64 = network.node_ids().map(|id| network.capacity(id)).sum();
    near(total, 0.6 * 0.4 * 0.2 * 4e6);
    near(network.capacity(grid.cell(&[2, 1, 2]).unwrap()), 0.6 * 0.4 * 0.2 * 4e6 / 12.0);
    assert!(network.node_ids().all(|id| (network.initial(id) - 293.15).abs() < 1e-12));
    // k A / L of one cell: along x 0.2 m x 0.1 m over 0.2 m, along y 0.2 x 0.1 over 0.2, along z
    // 0.2 x 0.2 over 0.1
    near(conductance(&network, "wall.x[1,1,1]"), 10.0 * 0.2 * 0.1 / 0.2);
    near(conductance(&network, "wall.y[3,1,2]"), 20.0 * 0.2 * 0.1 / 0.2);
    near(conductance(&network, "wall.z[2,2,1]"), 30.0 * 0.2 * 0.2 / 0.1);
    assert_eq!(ends(&network, "wall.x[2,1,2]"), ["wall[2,1,2]", "wall[3,1,2]"]);
    assert_eq!(ends(&network, "wall.y[2,1,2]"), ["wall[2,1,2]", "wall[2,2,2]"]);
    assert_eq!(ends(&network, "wall.z[3,2,1]"), ["wall[3,2,1]", "wall[3,2,2]"]);
    assert_eq!(network.conductors().len(), 2 * 2 * 2 + 3 * 2 + 3 * 2);
    let names: Vec<&str> = network.nodes().iter().take(5).map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["wall[1,1,1]", "wall[1,1,2]", "wall[1,2,1]", "wall[1,2,2]", "wall[2,1,1]"]);
    assert_eq!(network.name_of(Item::Node(grid.cell(&[2, 2, 1]).unwrap())), "wall[2,2,1]");
    for nowhere in [&[0, 1, 1][..], &[4, 1, 1], &[1, 3, 1], &[1, 1], &[1]] {
        assert_eq!(grid.cell(nowhere), None);
    }
    assert_eq!(grid.nodes().len(), 12);
    assert_eq!((network.outer_nodes().count(), network.outer_conductors().count()), (0, 0));
    assert_eq!(network.whole(Item::Node(grid.cell(&[1, 1, 1]).unwrap())), Some(Item::Grid(id)));
    assert_eq!((network.grid_ids().len(), network.face_path_ids().len()), (1, 0));
}

#[test]
fn fewer_counts_have_fewer_indices() {
    let (b, id) = wall(&[4]);
    let network = b.build().unwrap();
    let grid = &network.grids()[id.index()];
    assert_eq!((grid.cells, grid.axes), ([4, 1, 1], 1));
    assert_eq!(ends(&network, "wall.x[3]"), ["wall[3]", "wall[4]"]);
    near(conductance(&network, "wall.x[1]"), 10.0 * 0.4 * 0.2 / 0.15);
    assert_eq!(network.conductors().len(), 3);
    assert_eq!(grid.face_axes(Face::X0).count(), 0);
    assert_eq!(grid.face_axes(Face::Y1).collect::<Vec<_>>(), [0]);
}

#[test]
fn faces() {
    assert_eq!(Face::ALL.map(Face::name), ["x0", "x1", "y0", "y1", "z0", "z1"]);
    assert_eq!(Face::ALL.map(Face::axis), [0, 0, 1, 1, 2, 2]);
    assert_eq!(Face::ALL.map(Face::along), [[1, 2], [1, 2], [0, 2], [0, 2], [0, 1], [0, 1]]);
    assert!(
        Face::ALL.iter().all(|face| Face::of_name(face.name()) == Some(*face))
            && Face::of_name("x2").is_none()
    );
    let (b, id) = wall(&[3, 2, 5]);
    let network = b.build().unwrap();
    let grid = &network.grids()[id.index()];
    assert_eq!(Face::ALL.map(|face| grid.face_count(face)), [10, 10, 15, 15, 6, 6]);
    assert_eq!(grid.face_name(Face::Z1), "wall.z1");
}

/// Half a cell lies between the cells of a face and its surface; what is attached is shared by
/// area.
#[test]
fn a_film_on_a_face() {
    let (mut b, grid) = wall(&[3, 2]);
    let air = b.boundary("air", Temperature(290.0));
    let at = GridFace { grid, face: Face::X1 };
    let area = b.face_area(at).unwrap();
    let film = Path::film(quantity("5 W/(m^2 K)"), area);
    let item = b.connect("film", ConductorKind::Convection, (at, air), film);
    let Item::FacePath(id) = item else { panic!("{item:?}") };
    let network = b.build().unwrap();
    assert_eq!(network.nodes().len(), 6 + 2);
    let names: Vec<&str> = network.nodes()[6..].iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["wall.x1[1]", "wall.x1[2]"]);
    near(conductance(&network, "film[1]"), 5.0 * 0.4 * 0.2 / 2.0);
    assert_eq!(ends(&network, "film[2]"), ["wall.x1[2]", "air"]);
    // from a cell to its surface: half a cell of 0.2 m
    let halves: Vec<_> = network
        .conductor_ids()
        .filter(|id| {
            let c = &network.conductors()[id.index()];
            let is = |end: End| matches!(end, End::Node(node) if node.index() >= 6);
            (is(c.from) || is(c.to)) && c.kind == ConductorKind::Conduction
        })
        .collect();
    assert_eq!(halves.len(), 2);
    for (id, cell) in halves.into_iter().zip(["wall[3,1]", "wall[3,2]"]) {
        near(network.conductance(id).unwrap(), 10.0 * 0.2 * 0.2 / 0.1);
        let c = &network.conductors()[id.index()];
        let names = [c.from, c.to].map(|end| network.name_of(end.into()).into_owned());
        assert!(names.contains(&cell.to_owned()), "{names:?}");
    }
    let joint = &network.face_paths()[id.index()];
    assert_eq!(joint.conductors().len(), 2);
    assert_eq!(joint.faces().collect::<Vec<_>>(), [at]);
    assert_eq!(network.shared_face_paths().collect::<Vec<_>>(), [id]);
    assert_eq!(
        (network.terminal_name(joint.from), network.terminal_name(joint.to)),
        ("wall.x1".into(), "air".into())
    );
    let surfaces: Vec<_> = network.grids()[0].surfaces(Face::X1).collect();
    assert_eq!(surfaces.len(), 2);
    assert_eq!(network.grids()[0].surfaces(Face::X0).len(), 0);
    assert_eq!(network.place_name(surfaces[1]), "wall.x1");
    assert_eq!(network.place_name(network.grids()[0].cell(&[1, 1]).unwrap()), "wall");
    // values: over cells, over the surface, over the cells behind a face that nothing is attached
    // to
    let temperatures: Vec<f64> = (0..8).map(|i| 300.0 + f64::from(i * i)).collect();
    let value = |value| network.grid_value(value, &temperatures);
    near(value(GridValue::Mean(grid)), 300.0 + 55.0 / 6.0);
    near(value(GridValue::Min(grid)), 300.0);
    near(value(GridValue::Max(grid)), 325.0);
    near(value(GridValue::Face(at)), 300.0 + (36.0 + 49.0) / 2.0);
    near(value(GridValue::Face(GridFace { grid, face: Face::X0 })), 300.5);
    near(
        value(GridValue::Face(GridFace { grid, face: Face::Y1 })),
        300.0 + (1.0 + 9.0 + 25.0) / 3.0,
    );
    let shown: Vec<String> = network.grid_values().map(|value| value.name(&network)).collect();
    assert_eq!(shown, ["wall.mean", "wall.min", "wall.max", "wall.x1.T"]);
    assert_eq!(network.idle_grid_values().count(), 5);
    assert_eq!(network.grid_value_members(GridValue::Face(at)), [6, 7]);
    assert_eq!(GridValue::Face(at).grid(), grid);
}

#[test]
fn every_law_is_shared_between_the_cells_of_a_face() {
    let k = || quantity("7 W/(m K)");
    let paths = [
        (ConductorKind::Resistor, Path::resistance(quantity("0.25 K/W")), 4.0),
        (ConductorKind::Resistor, Path::conductance(quantity("6 W/K")), 6.0),
        (
            ConductorKind::Conduction,
            Path::new(Formula::Slab, [k(), quantity("0.08 m^2"), quantity("0.1 m")]),
            7.0 * 0.08 / 0.1,
        ),
        (
            ConductorKind::Conduction,
            Path::new(Formula::Cylinder, [k(), quantity("1 m"), quantity("2 m"), quantity("3 m")]),
            2.0 * std::f64::consts::PI * 21.0 / 2.0_f64.ln(),
        ),
        (
            ConductorKind::Conduction,
            Path::new(Formula::Sphere, [k(), quantity("1 m"), quantity("2 m")]),
            4.0 * std::f64::consts::PI * 7.0 * 2.0,
        ),
    ];
    for (kind, path, whole) in paths {
        let (mut b, grid) = wall(&[3, 4]);
        let air = b.boundary("air", Temperature(290.0));
        b.connect("p", kind, (air, GridFace { grid, face: Face::X0 }), path);
        let network = b.build().unwrap();
        let parts: Vec<f64> = network.face_paths()[0]
            .conductors()
            .map(|id| network.conductance(id).unwrap())
            .collect();
        assert_eq!(parts.len(), 4);
        parts.iter().for_each(|part| near(*part, whole / 4.0));
        assert_eq!(ends(&network, "p[3]"), ["air", "wall.x0[3]"]);
    }
    for exchange in [
        Path::radiation(quantity("0.04 m^2")),
        Path::new(Formula::GreySurfaces, [quantity("0.5"), quantity("0.08 m^2"), quantity("1")]),
    ] {
        let (mut b, grid) = wall(&[3, 4]);
        let air = b.boundary("air", Temperature(290.0));
        b.connect(
            "p",
            ConductorKind::Radiation,
            (air, GridFace { grid, face: Face::X0 }),
            exchange,
        );
        let network = b.build().unwrap();
        for id in network.face_paths()[0].conductors() {
            let flow = network.flow(id);
            assert!(matches!(flow, ConductorFlow::Radiation(gr) if (gr - 0.01).abs() < 1e-15));
        }
    }
}

#[test]
fn two_faces_are_joined_cell_by_cell() {
    let (mut b, left) = wall(&[2, 3]);
    let right = b.grid("other", block(&[4, 3]));
    let (from, to) =
        (GridFace { grid: left, face: Face::X1 }, GridFace { grid: right, face: Face::X0 });
    b.connect(
        "glue",
        ConductorKind::Contact,
        (from, to),
        Path::film(quantity("100 W/(m^2 K)"), quantity("0.08 m^2")),
    );
    let network = b.build().unwrap();
    assert_eq!(ends(&network, "glue[2]"), ["wall.x1[2]", "other.x0[2]"]);
    near(conductance(&network, "glue[3]"), 100.0 * 0.08 / 3.0);
    assert_eq!(network.face_paths()[0].faces().count(), 2);
}

#[test]
fn a_path_to_the_end_of_a_rod_is_an_ordinary_conductor() {
    let (mut b, grid) = wall(&[5]);
    let air = b.boundary("air", Temperature(290.0));
    b.connect(
        "tip",
        ConductorKind::Resistor,
        (GridFace { grid, face: Face::X1 }, air),
        Conductance(2.0).into(),
    );
    let network = b.build().unwrap();
    near(conductance(&network, "tip"), 2.0);
    assert_eq!(ends(&network, "tip"), ["wall.x1", "air"]);
    assert_eq!(network.shared_face_paths().count(), 0);
    let shown: Vec<String> = network.grid_values().map(|value| value.name(&network)).collect();
    assert_eq!(
        shown,
        ["wall.mean", "wall.min", "wall.max"],
        "a single node is named as its face is"
    );
}

#[test]
fn sources_are_shared_by_volume_and_by_area() {
    let (mut b, grid) = wall(&[3, 4]);
    let volume = b.shares_of_volume(grid);
    let face = b.shares_of_face(GridFace { grid, face: Face::Y0 });
    assert_eq!((volume.len(), face.len()), (12, 3));
    volume.iter().for_each(|(_, share)| near(*share, 1.0 / 12.0));
    face.iter().for_each(|(_, share)| near(*share, 1.0 / 3.0));
    b.shared_source("heat", &volume, HeatFlow(12.0));
    b.shared_source("sun", &face, HeatFlow(3.0));
    let network = b.build().unwrap();
    assert_eq!(network.sources()[1].into[2].0.index(), 14);
}

/// Names of cells and inner paths are not stored, but they are found, they are those that the items
/// have, and they are taken.
#[test]
fn names_of_cells_and_inner_paths_are_known() {
    for counts in [&[3, 4, 2][..], &[5, 2], &[6], &[1, 3, 1]] {
        let (b, _) = wall(counts);
        let network = b.build().unwrap();
        let nodes = network.node_ids().map(Item::Node);
        let paths = network.conductor_ids().map(Item::Conductor);
        let mut names = std::collections::HashSet::new();
        for item in nodes.chain(paths) {
            let name = network.name_of(item).into_owned();
            assert_eq!(network.item(&name), Ok(item), "{name}");
            assert!(names.insert(name));
        }
    }
    let (mut b, _) = wall(&[3, 4]);
    let air = b.boundary("air", Temperature(290.0));
    let wrong = ["wall[0,1]", "wall[01,1]", "wall[4,1]", "wall[1]", "wall[1,1,1]", "wall.x[3,1]"];
    for name in wrong.into_iter().chain(["wall.z[1,1]", "wall.w[1,1]", "wall.x[+1,1]", "air[1]"]) {
        assert_eq!(b.node_named(name), None, "{name}");
    }
    let cell = b.node_named("wall[3,4]").unwrap();
    b.resistor("wall.y[3,3]", cell, air, Resistance(1.0));
    let errors = b.build().unwrap_err();
    assert!(errors.0.iter().all(|error| error.code() == "network::duplicate_name"));
    assert!(errors.0.iter().all(|error| error.help().unwrap().contains("`wall_y_3_3`")));
    // the names of its cells have to be possible
    for (name, code) in [("import.conductor", "reserved_name"), ("a[1]", "bad_name")] {
        let mut b = NetworkBuilder::new();
        b.grid(name, block(&[4]));
        assert_eq!(codes(b), [format!("network::{code}")], "{name}");
    }
    // whichever was first
    for name in ["wall[2,1]", "wall.x[2,4]"] {
        let mut b = NetworkBuilder::new();
        b.node(name, HeatCapacity(1.0), Temperature(290.0));
        b.grid("wall", block(&[3, 4]));
        assert_eq!(codes(b), ["network::duplicate_name"], "{name}");
    }
}

#[test]
fn a_grid_of_a_material() {
    let material = |b: &mut NetworkBuilder, density: bool, cp: bool| {
        let density = density.then(|| quantity("1000 kg/m^3"));
        b.material(
            "m",
            Properties {
                density,
                cp: cp.then(|| quantity("2000 J/(kg K)")),
                ..Properties::default()
            },
        )
    };
    let with = |density: bool, cp: bool| {
        let mut b = NetworkBuilder::new();
        let m = material(&mut b, density, cp);
        b.grid("wall", GridBlock { substance: Substance::Material(m), ..block(&[4, 2]) });
        b
    };
    let network = with(true, true).build().unwrap();
    near(network.capacity(network.node("wall[2,2]").unwrap()), 0.048 * 2e6 / 8.0);
    near(network.mass(network.node("wall[2,2]").unwrap()).unwrap(), 48.0 / 8.0);
    for (density, cp) in [(false, true), (true, false), (false, false)] {
        assert_eq!(codes(with(density, cp)), ["network::no_property"]);
    }
    let mut b = NetworkBuilder::new();
    let m = material(&mut b, true, false);
    assert!(b.lump(m, Size::Mass(quantity("1 kg"))).is_none());
}

/// What is wrong with the wall after this.
fn refused(fault: &dyn Fn(&mut NetworkBuilder, GridId)) -> Vec<&'static str> {
    let (mut b, grid) = wall(&[3, 4]);
    fault(&mut b, grid);
    codes(b)
}

#[test]
fn wrong_grids_and_joints_are_refused_once_for_the_whole() {
    for (counts, code) in [
        (&[][..], "network::grid_cells"),
        (&[0], "network::grid_cells"),
        (&[2, 2, 2, 2], "network::grid_cells"),
        (&[1000, 1000, 1000], "network::grid_too_large"),
        (&[usize::MAX, 3], "network::grid_too_large"),
    ] {
        assert_eq!(codes(wall(counts).0), [code], "{counts:?}");
    }
    let side = |grid| GridFace { grid, face: Face::X0 };
    let film = |area: &str| Path::film(quantity("5 W/(m^2 K)"), quantity(area));
    assert_eq!(refused(&|_, _| {}), [""; 0]);
    let area = |text: &'static str| {
        refused(&move |b, grid| {
            let air = b.boundary("air", Temperature(290.0));
            b.connect("film", ConductorKind::Convection, (side(grid), air), film(text));
        })
    };
    assert_eq!(area("0.08005 m^2"), [""; 0]);
    assert_eq!(area("0.0803 m^2"), ["network::face_area"]);
    assert_eq!(area("0.0797 m^2"), ["network::face_area"]);
    let stream = refused(&|b, grid| {
        let air = b.boundary("air", Temperature(290.0));
        let path = Path::stream(Conductance(1.0));
        b.connect("s", ConductorKind::Advection, (side(grid), air), path);
    });
    assert_eq!(stream, ["network::stream_into_face"]);
    let many = refused(&|b, grid| {
        let air = b.boundary("air", Temperature(290.0));
        let [h, area] = [quantity("5 W/(m^2 K)"), quantity("0.08 m^2")];
        let path = Path::new(Formula::Film, [h.clone(), area, h]);
        b.connect("film", ConductorKind::Convection, (side(grid), air), path);
    });
    assert_eq!(many, ["network::law_values"]);
    let joined = |other: GridBlock| {
        refused(&move |b, grid| {
            let other = b.grid("other", other.clone());
            b.connect(
                "glue",
                ConductorKind::Radiation,
                (side(grid), side(other)),
                Path::radiation(quantity("0.04 m^2")),
            );
        })
    };
    assert_eq!(joined(block(&[7, 4])), [""; 0]);
    assert_eq!(joined(block(&[3, 3])), ["network::face_cells"]);
    let sized = |size: [&str; 3]| GridBlock { size: size.map(quantity), ..block(&[3, 4]) };
    assert_eq!(joined(sized(["9 m", "0.4 m", "0.2 m"])), [""; 0]);
    assert_eq!(joined(sized(["0.6 m", "0.5 m", "0.2 m"])), ["network::face_sides"]);
    assert_eq!(joined(sized(["0.6 m", "0.4 m", "0.21 m"])), ["network::face_sides"]);
}

#[test]
fn wrong_values_of_a_block_are_refused_once() {
    let one = |change: &dyn Fn(GridBlock) -> GridBlock| {
        let mut b = NetworkBuilder::new();
        b.grid("wall", change(block(&[3, 4])));
        codes(b)
    };
    let flat = |text: &'static str| {
        move |b: GridBlock| GridBlock { size: ["0.6 m", text, "0.2 m"].map(quantity), ..b }
    };
    assert_eq!(one(&flat("0 m")), ["network::not_positive"]);
    let k = one(&|b| GridBlock {
        conductivity: ["1 W/(m K)", "-1 W/(m K)", "1 W/(m K)"].map(quantity),
        ..b
    });
    assert_eq!(k, ["network::not_positive"]);
    assert_eq!(
        one(&|b| GridBlock { initial: Some(Temperature(-4.0).into()), ..b }),
        ["network::below_absolute_zero"]
    );
    assert_eq!(one(&|b| GridBlock { initial: None, ..b }), ["network::no_initial_temperature"]);
    let substance = |density: &str, cp: &str| Substance::Properties {
        density: quantity(density),
        cp: quantity(cp),
    };
    let of = |density: &'static str, cp: &'static str| {
        one(&move |b| GridBlock { substance: substance(density, cp), ..b })
    };
    assert_eq!(of("-1 kg/m^3", "500 J/(kg K)"), ["network::not_positive"]);
    assert_eq!(of("1 kg/m^3", "-500 J/(kg K)"), ["network::not_positive"]);
    assert_eq!(of("1 kg", "500 J/(kg K)"), ["network::wrong_type"]);
}
