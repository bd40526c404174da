//! Faces of blocks that overlap in part: the pairs of cells, their areas, refusals.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{codes, near, quantity, time};
use lptn_network::{
    ConductorKind, Face, FacePathId, GridBlock, GridFace, Input, Item, Network, NetworkBuilder,
    Path, Placement, Resistance, Substance, Temperature, Terminal,
};

fn block(size: [Input; 3], cells: &[usize]) -> GridBlock {
    GridBlock {
        size,
        cells: cells.to_vec(),
        conductivity: ["10 W/(m K)"; 3].map(quantity),
        substance: Substance::Properties {
            density: quantity("8000 kg/m^3"),
            cp: quantity("500 J/(kg K)"),
        },
        initial: Some(Temperature(293.15).into()),
    }
}

/// A die on a plate of 6 m x 4 m with six cells along x and two along y, joined with 2 W/(m^2 K).
fn glued(die: ([&str; 3], &[usize]), placement: Placement<Input>) -> (NetworkBuilder, FacePathId) {
    let mut b = NetworkBuilder::new();
    let die = b.grid("die", block(die.0.map(quantity), die.1));
    let plate = b.grid("plate", block(["6 m", "4 m", "1 m"].map(quantity), &[6, 2]));
    let faces = [GridFace { grid: die, face: Face::Z0 }, GridFace { grid: plate, face: Face::Z1 }];
    let area = b.common_area(faces, &placement).unwrap_or_else(|| quantity("1 m^2"));
    let path = Path::film(quantity("2 W/(m^2 K)"), area);
    let ends = (Terminal::from(faces[0]), Terminal::from(faces[1]));
    let item = b.connect_at("glue", ConductorKind::Contact, ends, (path, placement));
    let Item::FacePath(id) = item else { panic!("{item:?}") };
    (b, id)
}

fn parts(network: &Network, id: FacePathId) -> Vec<(String, f64)> {
    let conductors = network.face_paths()[id.index()].conductors();
    let part = |id| (network.name_of(Item::Conductor(id)).into_owned(), network.conductance(id));
    conductors.map(part).map(|(name, conductance)| (name, conductance.unwrap())).collect()
}

fn placed(offset: [&str; 2], axes: [(usize, bool); 2]) -> Placement<Input> {
    Placement { offset: Some(offset.map(quantity)), axes }
}

const PLAIN: [(usize, bool); 2] = [(0, false), (1, false)];

/// Two cells of 1.5 m along x reach from 1.5 m to 4.5 m of the plate, and one of 1 m along y from
/// 1.5 m to 2.5 m.
#[test]
fn cells_share_their_common_areas() {
    let (b, id) = glued((["3 m", "1 m", "1 m"], &[2, 1]), Placement::default());
    let network = b.build().unwrap();
    let found = parts(&network, id);
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "glue[1,1,2,1]",
            "glue[1,1,2,2]",
            "glue[1,1,3,1]",
            "glue[1,1,3,2]",
            "glue[2,1,4,1]",
            "glue[2,1,4,2]",
            "glue[2,1,5,1]",
            "glue[2,1,5,2]",
        ]
    );
    // lengths along x 0.5, 1, 1, 0.5 m, along y 0.5 m
    for ((_, conductance), length) in found.iter().zip([0.5, 0.5, 1.0, 1.0, 1.0, 1.0, 0.5, 0.5]) {
        near(*conductance, 2.0 * length * 0.5);
    }
    let [die, plate] = network.touching(id).unwrap();
    near(die, 1.0);
    near(plate, 3.0 / 24.0);
}

/// Moved by 1 m along x and turned: the die's y runs along the plate's x, its x against the
/// plate's y.
#[test]
fn faces_are_moved_and_turned() {
    let turned = placed(["1 m", "0 m"], [(1, true), (0, false)]);
    let (b, id) = glued((["2 m", "1 m", "1 m"], &[2, 1]), turned);
    let found = parts(&b.build().unwrap(), id);
    // 1 m along x from 3.5 m to 4.5 m, 2 m along y from 1 m to 3 m: the first cell is the upper one
    let expected = [("glue[1,1,4,2]", 0.5), ("glue[1,1,5,2]", 0.5), ("glue[2,1,4,1]", 0.5)];
    assert_eq!(found.len(), 4);
    for ((name, conductance), (expected, area)) in found.iter().zip(expected) {
        assert_eq!(name, expected);
        near(*conductance, 2.0 * area);
    }
}

/// Half of a die that is larger than the plate along y overhangs.
#[test]
fn a_face_may_overhang() {
    let (b, id) = glued((["2 m", "8 m", "1 m"], &[1, 4]), placed(["3 m", "0 m"], PLAIN));
    let network = b.build().unwrap();
    let [die, plate] = network.touching(id).unwrap();
    near(die, 4.0 / 16.0);
    near(plate, 4.0 / 24.0);
    let sum: f64 = parts(&network, id).iter().map(|(_, conductance)| conductance).sum();
    near(sum, 2.0 * 4.0);
}

#[test]
fn faces_apart_are_refused_once() {
    let size = ["2 m", "1 m", "1 m"];
    for (offset, expected) in [("3.9 m", None), ("4.1 m", Some("network::faces_apart"))] {
        let (b, _) = glued((size, &[2, 1]), placed([offset, "0 m"], PLAIN));
        assert_eq!(codes(b), Vec::from_iter(expected), "{offset}");
    }
    let (b, _) = glued((size, &[2, 1]), placed(["1 s", "0 m"], PLAIN));
    assert_eq!(codes(b), ["network::wrong_type"]);
}

/// Cells of 1 m each on a plate of three; the parameter moves the die along x.
#[test]
fn parameters_move_a_face() {
    let mut b = NetworkBuilder::new();
    b.parameter("x", quantity("0.25 m"));
    let die = b.grid("die", block(["1 m", "1 m", "1 m"].map(quantity), &[1, 1]));
    let plate = b.grid("plate", block(["3 m", "1 m", "1 m"].map(quantity), &[3]));
    let faces = [GridFace { grid: die, face: Face::Z0 }, GridFace { grid: plate, face: Face::Z1 }];
    let offset = Some([time(&b, "x"), quantity("0 m")]);
    let placement = Placement { offset, axes: PLAIN };
    let area = b.common_area(faces, &placement).unwrap();
    let path = Path::film(quantity("2 W/(m^2 K)"), area);
    let ends = (faces[0].into(), faces[1].into());
    let Item::FacePath(id) =
        b.connect_at("glue", ConductorKind::Contact, ends, (path, placement.clone()))
    else {
        panic!()
    };
    let mut refused = b.clone();
    let network = b.build().unwrap();
    for (x, areas) in
        [("0.25 m", [0.0, 0.75, 0.25]), ("-0.5 m", [0.5, 0.5, 0.0]), ("1.5 m", [0.0, 0.0, 0.5])]
    {
        let moved = network.with(&network.overrides().with("x", x).unwrap()).unwrap();
        let found = parts(&moved, id);
        assert_eq!(found.len(), 3);
        for ((_, conductance), area) in found.iter().zip(areas) {
            assert!((conductance - 2.0 * area).abs() < 1e-12, "{x}: {found:?}");
        }
        near(moved.touching(id).unwrap()[0], areas.iter().sum());
    }
    let away = network.with(&network.overrides().with("x", "2.1 m").unwrap()).unwrap_err();
    assert_eq!(away.0.iter().map(|e| e.code()).collect::<Vec<_>>(), ["network::faces_apart"]);
    // a resistance would have to be infinite between cells that do not touch
    let resistance = (Path::from(Resistance(1.0)), placement);
    refused.connect_at("more", ConductorKind::Resistor, ends, resistance);
    assert_eq!(codes(refused), ["network::faces_moving"]);
}

/// The stream passes the rows of cells against x; the film of each cell ends at the fluid of its
/// row.
#[test]
fn a_stream_flows_along_a_face() {
    let mut b = NetworkBuilder::new();
    let plate = b.grid("plate", block(["6 m", "4 m", "1 m"].map(quantity), &[3, 2]));
    let at = GridFace { grid: plate, face: Face::Z0 };
    let inlet = b.boundary("inlet", Temperature(290.0));
    let water = b.face_stream("water", at, (0, true)).unwrap();
    assert!(b.face_stream("other", at, (2, false)).is_none());
    let flow = Path::stream(quantity("5 W/K"));
    let ends = (inlet.into(), inlet.into());
    let conductors = b.flow_along(water, ConductorKind::Advection, ends, flow);
    let film = Path::film(quantity("2 W/(m^2 K)"), b.face_area(at).unwrap());
    b.connect("film", ConductorKind::Convection, (at, Terminal::Stream(water)), film.clone());
    let mut refused = b.clone();
    let network = b.build().unwrap();
    let named = |name: &str| {
        let Ok(Item::Conductor(id)) = network.item(name) else { panic!("{name}") };
        let conductor = &network.conductors()[id.index()];
        [conductor.from, conductor.to].map(|end| network.name_of(end.into()).into_owned())
    };
    assert_eq!(conductors.len(), 4);
    assert_eq!(named("water.x[1]"), ["inlet", "water[1]"]);
    assert_eq!(named("water.x[3]"), ["water[2]", "water[3]"]);
    assert_eq!(named("water"), ["water[3]", "inlet"]);
    assert_eq!(named("film[1,2]"), ["plate.z0[1,2]", "water[3]"]);
    assert_eq!(named("film[3,1]"), ["plate.z0[3,1]", "water[1]"]);
    // y1 has three cells along x, x1 none
    for (face, expected) in [(Face::Y1, vec![]), (Face::X1, vec!["network::stream_rows"])] {
        let mut b = refused.clone();
        let at = GridFace { grid: plate, face };
        b.connect("more", ConductorKind::Convection, (at, Terminal::Stream(water)), film.clone());
        let found = codes(b);
        assert!(expected.is_empty() || found == expected, "{found:?}");
    }
    let node = refused.node_named("plate[1,1]").unwrap();
    let ends = (Terminal::from(node), Terminal::Stream(water));
    refused.connect("more", ConductorKind::Convection, ends, film);
    assert_eq!(codes(refused), ["network::stream_rows"]);
}
