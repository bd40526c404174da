//! Round grids: names, places, conductances, capacities and areas against closed forms written out
//! here.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use std::f64::consts::{PI, TAU};

use common::{celsius, codes, near, quantity};
use lptn_network::{
    ConductorKind, Face, FilmCoefficient, Form, GridBlock, GridCylinder, GridFace, GridId,
    GridValue, Input, Item, Network, NetworkBuilder, Path, Substance, Temperature,
};

const MATERIAL: [&str; 2] = ["8000 kg/m^3", "500 J/(kg K)"];

/// From 20 to 50 mm in radius, 100 mm long, 4e6 J/(m^3 K), conductivity by direction.
fn pipe(cells: &[usize], angle: Option<&str>) -> GridCylinder {
    GridCylinder {
        r_in: Some(quantity("20 mm")),
        r_out: quantity("50 mm"),
        length: quantity("100 mm"),
        angle: angle.map(quantity),
        cells: cells.to_vec(),
        conductivity: ["10 W/(m K)", "20 W/(m K)", "30 W/(m K)"].map(quantity),
        substance: Substance::Properties {
            density: quantity(MATERIAL[0]),
            cp: quantity(MATERIAL[1]),
        },
        initial: Some(celsius("20 degC")),
    }
}

fn rod(cells: &[usize]) -> GridCylinder {
    GridCylinder { r_in: None, ..pipe(cells, None) }
}

fn built(body: GridCylinder) -> (Network, GridId) {
    let mut b = NetworkBuilder::new();
    let grid = b.grid("body", body);
    (b.build().unwrap(), grid)
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

/// Where two rings with nodes at these radii meet: the flow `2 pi k L / ln(b / a)` is that of a
/// temperature `r^2` there.
fn border(a: f64, b: f64) -> f64 {
    ((b * b - a * a) / (2.0 * (b / a).ln())).sqrt()
}

#[test]
fn rings_share_the_body() {
    let (network, id) = built(pipe(&[3, 4, 2], None));
    let grid = &network.grids()[id.index()];
    assert_eq!((grid.count(), grid.cells), (24, [3, 4, 2]));
    assert_eq!(grid.form(), Form::Cylinder { solid: false, closed: true });
    let total: f64 = network.node_ids().map(|id| network.capacity(id)).sum();
    near(total, PI * (0.05 * 0.05 - 0.02 * 0.02) * 0.1 * 4e6);
    // nodes at 25, 35 and 45 mm
    let outer = border(0.035, 0.045);
    let ring = PI * (0.05 * 0.05 - outer * outer) * 0.1 / 8.0;
    near(network.capacity(grid.cell(&[3, 2, 1]).unwrap()), ring * 4e6);
    // the textbook resistance of a hollow cylinder, a quarter of it around and a half along
    near(conductance(&network, "body.r[1,1,1]"), TAU * 10.0 * 0.1 / 8.0 / (35_f64 / 25.0).ln());
    // an arc conducts k L ln(r_2 / r_1) / angle
    let arc = 20.0 * 0.05 * (0.05 / outer).ln() / (PI / 2.0);
    near(conductance(&network, "body.phi[3,4,2]"), arc);
    near(conductance(&network, "body.z[3,4,1]"), 30.0 * ring / 0.05 / 0.05);
    assert_eq!(ends(&network, "body.r[2,3,1]"), ["body[2,3,1]", "body[3,3,1]"]);
    assert_eq!(ends(&network, "body.phi[2,3,1]"), ["body[2,3,1]", "body[2,4,1]"]);
    assert_eq!(ends(&network, "body.phi[2,4,1]"), ["body[2,4,1]", "body[2,1,1]"]);
    assert_eq!(network.conductors().len(), 2 * 8 + 24 + 12);
    assert!(network.item("body.x[1,1,1]").is_err());
}

#[test]
fn a_sector_is_open() {
    let (network, id) = built(pipe(&[2, 3], Some("90 deg")));
    let grid = &network.grids()[id.index()];
    assert_eq!(grid.form(), Form::Cylinder { solid: false, closed: false });
    let total: f64 = network.node_ids().map(|id| network.capacity(id)).sum();
    near(total, PI / 4.0 * (0.05 * 0.05 - 0.02 * 0.02) * 0.1 * 4e6);
    assert!(network.item("body.phi[1,3]").is_err());
    assert_eq!(network.conductors().len(), 3 + 4);
    // the arcs of both rings side by side are the arc of the whole wall, whatever the rings
    let arcs: f64 =
        ["body.phi[1,1]", "body.phi[2,1]"].map(|n| conductance(&network, n)).iter().sum();
    near(arcs, 20.0 * 0.1 * (50_f64 / 20.0).ln() / (PI / 6.0));
}

#[test]
fn a_body_without_a_hole_has_a_disc_inside() {
    let (network, id) = built(rod(&[5]));
    let grid = &network.grids()[id.index()];
    assert_eq!(grid.form(), Form::Cylinder { solid: true, closed: true });
    let first = border(0.005, 0.015);
    near(network.capacity(grid.cell(&[1]).unwrap()), PI * first * first * 0.1 * 4e6);
    let names: Vec<&str> = grid.form().faces().map(|face| grid.form().face_name(face)).collect();
    assert_eq!(names, ["outer", "z0", "z1"]);
    // a radius of 0 and an angle of 360 deg are the same body
    let zero = GridCylinder {
        r_in: Some(quantity("0 mm")),
        angle: Some(quantity("360 deg")),
        ..rod(&[5])
    };
    assert_eq!(built(zero).0.grids()[0].form(), grid.form());
}

/// Faces of a connected body: areas, and the parts of each cell.
#[test]
fn faces_are_as_large_as_the_body() {
    let mut b = NetworkBuilder::new();
    let grid = b.grid("body", pipe(&[3, 2, 2], Some("90 deg")));
    let air = b.boundary("air", Temperature(290.0));
    // inner and outer arcs, the cuts, the ends
    let end = PI / 4.0 * (0.05 * 0.05 - 0.02 * 0.02);
    let arc = PI / 2.0 * 0.1;
    let areas = [0.02 * arc, 0.05 * arc, 0.03 * 0.1, 0.03 * 0.1, end, end];
    let mut paths = Vec::new();
    for (face, area) in Face::ALL.into_iter().zip(areas) {
        let at = GridFace { grid, face };
        let film = Path::film(FilmCoefficient(5.0), b.face_area(at).unwrap());
        let name = format!("film{}", face as usize);
        b.connect(&name, ConductorKind::Convection, (at, air), film);
        paths.push((name, area));
    }
    let network = b.build().unwrap();
    for (name, area) in paths {
        let Ok(Item::FacePath(id)) = network.item(&name) else { panic!("{name}") };
        let parts = network.face_paths()[id.index()].conductors();
        let whole: f64 = parts.map(|id| network.conductance(id).unwrap()).sum();
        near(whole, 5.0 * area);
    }
    near(conductance(&network, "film5[3,1]") / 5.0, {
        let outer = border(0.035, 0.045);
        PI / 8.0 * (0.05 * 0.05 - outer * outer)
    });
    // the last half ring of one cell: a quarter of the circle over two, the length over two
    let half = TAU * 10.0 * 0.1 / 16.0 / (50_f64 / 45.0).ln();
    near(conductance(&network, "body.outer.cell[2,2]"), half);
    near(conductance(&network, "body.inner.cell[1,1]"), TAU * 10.0 * 0.1 / 16.0 / 1.25_f64.ln());
    assert_eq!(ends(&network, "body.phi1.cell[3,2]"), ["body[3,2,2]", "body.phi1[3,2]"]);
}

/// The mean counts each ring by its volume, that of an end by its area.
#[test]
fn means_count_rings_by_their_size() {
    let (network, grid) = built(rod(&[2, 1, 1]));
    let first = border(0.0125, 0.0375) / 0.05;
    let share = first * first;
    let kelvin = [400.0, 300.0];
    near(network.grid_value(GridValue::Mean(grid), &kelvin), 300.0 + 100.0 * share);
    let end = GridFace { grid, face: Face::Z1 };
    near(network.grid_value(GridValue::Face(end), &kelvin), 300.0 + 100.0 * share);
    let mantle = GridFace { grid, face: Face::OUTER };
    near(network.grid_value(GridValue::Face(mantle), &kelvin), 300.0);
}

/// A uniform heat goes into cells by their volume; the part between the last node and a connected
/// mantle goes where the flow takes it.
#[test]
fn heat_of_the_volume_is_shared() {
    let mut b = NetworkBuilder::new();
    let grid = b.grid("body", rod(&[2]));
    let inside = border(0.0125, 0.0375).powi(2) / 0.0025;
    let shares: Vec<f64> = b.shares_of_volume(grid).into_iter().map(|(_, share)| share).collect();
    near(shares[0], inside);
    near(shares[1], 1.0 - inside);
    b.surfaces(grid, Face::OUTER);
    let shares: Vec<f64> = b.shares_of_volume(grid).into_iter().map(|(_, share)| share).collect();
    let outside = border(0.0375, 0.05).powi(2) / 0.0025;
    near(shares[1], outside - inside);
    near(shares[2], 1.0 - outside);
    assert_eq!(shares.len(), 3);
    assert!(b.surfaces(grid, Face::INNER).is_empty());
}

#[test]
fn wrong_bodies() {
    let refused = |body: GridCylinder| {
        let mut b = NetworkBuilder::new();
        b.grid("body", body);
        codes(b)
    };
    let larger = GridCylinder { r_in: Some(quantity("60 mm")), ..pipe(&[3], None) };
    assert_eq!(refused(larger), ["network::radii"]);
    let negative = GridCylinder { r_in: Some(quantity("-1 mm")), ..pipe(&[3], None) };
    assert_eq!(refused(negative), ["network::not_positive"]);
    assert_eq!(refused(pipe(&[3], Some("400 deg"))), ["network::grid_angle"]);
    assert_eq!(refused(pipe(&[3], Some("0 deg"))), ["network::not_positive"]);
}

/// A face that the body does not have, and joints of faces that cannot touch.
#[test]
fn wrong_joints() {
    let joint = |faces: [Face; 2], other: GridCylinder| {
        let mut b = NetworkBuilder::new();
        let one = b.grid("one", rod(&[2]));
        let two = b.grid("two", other);
        let [a, c] = [(one, faces[0]), (two, faces[1])].map(|(grid, face)| GridFace { grid, face });
        b.connect("joint", ConductorKind::Resistor, (a, c), Path::resistance(quantity("1 K/W")));
        b
    };
    assert!(joint([Face::Z1, Face::Z0], rod(&[2])).build().is_ok());
    assert_eq!(codes(joint([Face::INNER, Face::OUTER], rod(&[2]))), ["network::no_face"]);
    assert_eq!(codes(joint([Face::OUTER, Face::Z0], rod(&[2]))), ["network::face_shapes"]);
    assert_eq!(codes(joint([Face::OUTER, Face::OUTER], rod(&[2]))), ["network::face_shapes"]);
    assert_eq!(codes(joint([Face::Z1, Face::Z0], pipe(&[2], None))), ["network::face_sides"]);
    assert_eq!(codes(joint([Face::OUTER, Face::INNER], pipe(&[2], None))), ["network::face_sides"]);
    let mut b = NetworkBuilder::new();
    let round = b.grid("round", rod(&[2]));
    let block = b.grid(
        "block",
        GridBlock {
            size: ["50 mm", "50 mm", "50 mm"].map(quantity),
            cells: vec![2],
            conductivity: ["10 W/(m K)", "20 W/(m K)", "30 W/(m K)"].map(quantity),
            substance: rod(&[2]).substance,
            initial: Some(celsius("20 degC")),
        },
    );
    let ends = [(round, Face::Z0), (block, Face::Z1)].map(|(grid, face)| GridFace { grid, face });
    b.connect(
        "joint",
        ConductorKind::Resistor,
        (ends[0], ends[1]),
        Path::resistance(quantity("1 K/W")),
    );
    assert_eq!(codes(b), ["network::face_shapes"]);
}

/// Radii may follow a parameter as long as their ratio stays.
#[test]
fn a_ratio_of_radii_stays() {
    let network = |r_in: &str| {
        let mut b = NetworkBuilder::new();
        b.parameter("r", quantity("50 mm"));
        let expression = |text: &str| Input::from(b.expression(text, None).unwrap());
        let body = GridCylinder {
            r_in: Some(expression(r_in)),
            r_out: expression("r"),
            ..pipe(&[3], None)
        };
        b.grid("body", body);
        b.build().unwrap()
    };
    let set = |network: &Network| network.with(&network.overrides().with("r", "100 mm").unwrap());
    let larger = set(&network("0.4 * r")).unwrap();
    let total: f64 = larger.node_ids().map(|id| larger.capacity(id)).sum();
    near(total, PI * (0.1 * 0.1 - 0.04 * 0.04) * 0.1 * 4e6);
    let error = set(&network("20 [mm]")).unwrap_err();
    assert_eq!(error.0[0].code(), "network::grid_ratio");
}

/// Without a hole the flows of a uniform gradient balance: `r cos(phi)` at the nodes, with the flow
/// that it has at the radius between two of them.
#[test]
fn a_uniform_gradient_is_steady_without_a_hole() {
    let (network, _) = built(GridCylinder {
        conductivity: ["10 W/(m K)", "10 W/(m K)", "10 W/(m K)"].map(quantity),
        ..rod(&[4, 400])
    });
    let step = TAU / 400.0;
    let node = |ring: f64| 0.05 * (ring - 0.5) / 4.0;
    for ring in [1, 2] {
        let at = f64::from(ring);
        let radial =
            |from: f64, name: &str| conductance(&network, name) * (node(from + 1.0) - node(from));
        let outward = radial(at, &format!("body.r[{ring},1]"));
        let inward =
            if ring > 1 { radial(at - 1.0, &format!("body.r[{},1]", ring - 1)) } else { 0.0 };
        let around = conductance(&network, &format!("body.phi[{ring},1]"));
        let lost = around * 2.0 * (1.0 - step.cos()) * node(at);
        assert!((outward - inward - lost).abs() < 1e-4 * outward, "{outward} {inward} {lost}");
    }
}

/// A derivative by a parameter that changes the ratio of the radii is refused.
#[test]
fn a_ratio_of_radii_has_no_derivative() {
    let tangents = |r_in: &str| {
        let mut b = NetworkBuilder::new();
        let r = b.parameter("r", quantity("50 mm"));
        let expression = |text: &str| Input::from(b.expression(text, None).unwrap());
        let (r_in, r_out) = (Some(expression(r_in)), expression("r"));
        b.grid("body", GridCylinder { r_in, r_out, ..pipe(&[3], None) });
        b.build().unwrap().tangents(&[r]).map(|_| ())
    };
    assert!(tangents("0.4 * r").is_ok());
    assert_eq!(tangents("20 [mm]").unwrap_err().code(), "sensitivity::rings");
}
