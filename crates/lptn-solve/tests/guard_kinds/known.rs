//! Networks in which an error grew without a word while the rest of the network was faster.

use super::case::{Case, Element, Kind, Node, Read, Storage};
use crate::features::{Feature, Shape};

fn node(capacity: f64, start: f64, storage: Storage) -> Node {
    Node { capacity, start, storage }
}

fn plain(kind: Kind, from: usize, to: usize, size: f64) -> Element {
    Element { kind, from, to, size, read: Read::Own, features: Vec::new() }
}

fn case(nodes: Vec<Node>, elements: Vec<Element>, stop: f64) -> Case {
    Case { nodes, elements, fan: None, stop, tolerance: 1e-5 }
}

/// The heat of a film falls behind its peak while its body becomes warmer; another body is faster.
pub(crate) fn beside_a_faster_one() -> Case {
    let peak = |at, width, size| Feature::new(Shape::Tent, (at, width, size));
    let film = Element {
        read: Read::Mean,
        features: vec![peak(27.0155, 0.12206, 1.5544), peak(23.9402, 0.66927, 1.4344)],
        ..plain(Kind::Film, 1, 2, 0.99654)
    };
    let bodies = [195.709, 95.4178].map(|c| node(c, 20.0, Storage::Constant));
    let heater = plain(Kind::Power, 0, 0, 49.4275);
    let paths = [(0, 1, 0.836448), (1, 2, 0.888411)];
    let [inner, outer] = paths.map(|(from, to, g)| plain(Kind::Conductance, from, to, g));
    case(bodies.to_vec(), vec![inner, outer, heater, film], 412.0)
}

/// The heat of a massless node follows the temperature of a body.
pub(crate) fn magnified() -> Case {
    let features = vec![Feature::new(Shape::Tent, (69.3458, 0.58047, 1.20326))];
    let read = Read::Named(0);
    let heat = Element { read, features, ..plain(Kind::Power, 1, 1, 45.4996) };
    let heater = plain(Kind::Power, 0, 0, 52.5666);
    let paths = [(0, 1, 0.698766), (1, 2, 1.475205)];
    let [inner, outer] = paths.map(|(from, to, g)| plain(Kind::Conductance, from, to, g));
    let nodes = vec![node(290.899, 20.0, Storage::Constant), node(1.0, 20.0, Storage::Massless)];
    case(nodes, vec![inner, outer, heater, heat], 798.0)
}

/// A body that cools has less and less capacity.
pub(crate) fn of_falling_capacity() -> Case {
    let ramp = |at, width, size| Feature::new(Shape::Ramp, (at, width, size));
    let ramps = vec![ramp(228.1445, 1.069, -0.17135), ramp(268.758, 9.8857, 2.906)];
    let body = node(68.8975, 283.9517, Storage::Capacity(ramps));
    case(vec![body], vec![plain(Kind::Conductance, 0, 1, 0.828)], 32.0)
}
