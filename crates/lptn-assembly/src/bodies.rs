//! Bodies of one conductivity over temperature, cut into many cells.
//!
//! Their paths are elements like others. Heat and derivatives of all of them come from one
//! potential a cell (Kirchhoff's transformation), a tenth of the time that as many means along
//! paths take. If the conductivity is not known at a cell, each path evaluates its own heat and
//! reports its error.

use std::collections::BTreeMap;

use lptn_network::{Conductivity, InputError, Network};

use crate::element::{Element, JacobianForm};
use crate::positions::number;
use crate::workspace::Workspace;

/// Bodies of fewer paths are not worth the bookkeeping.
const LEAST: usize = 32;

/// All bodies of a network.
#[derive(Clone, Debug)]
pub(crate) struct Bodies {
    bodies: Vec<Body>,
    /// Positions of the elements that belong to none.
    others: Vec<u32>,
}

/// The paths of one conductivity.
#[derive(Clone, Debug)]
struct Body {
    conductivity: Conductivity,
    /// The ends of its paths, ascending.
    vertices: Vec<u32>,
    paths: Vec<Path>,
}

/// A path between two of the vertices.
#[derive(Clone, Copy, Debug)]
struct Path {
    element: u32,
    /// Positions of its ends among the vertices of the body.
    ends: [u32; 2],
    /// Conductance in W/K for a conductivity of 1 W/(m K).
    shape: f64,
}

impl Path {
    /// The heat from its first end to its second in W.
    fn heat(&self, potentials: &[f64]) -> f64 {
        let [from, to] = self.ends.map(|end| potentials[end as usize]);
        self.shape * (from - to)
    }
}

impl Bodies {
    /// Those of all elements of a network, or of some by their positions, ascending.
    pub(crate) fn of(
        network: &Network,
        elements: &[Element],
        positions: impl Iterator<Item = usize>,
    ) -> Self {
        let (mut bodies, mut places) = (Vec::<Body>::new(), BTreeMap::new());
        // positions with their body, if they have one
        let mut all = Vec::new();
        for i in positions {
            let element = &elements[i];
            let known = element.conductor().and_then(|id| network.conductivity(id));
            let own = known.map(|(conductivity, shape)| {
                let body = *places.entry(conductivity.key()).or_insert(bodies.len());
                if body == bodies.len() {
                    bodies.push(Body { conductivity, vertices: Vec::new(), paths: Vec::new() });
                }
                let ends = [element.receivers[0], element.receivers[1]];
                bodies[body].paths.push(Path { element: number(i), ends, shape });
                number(body)
            });
            all.push((number(i), own));
        }
        let is_body = |body: &Body| body.paths.len() >= LEAST;
        let alone = |own: Option<u32>| own.is_none_or(|body| !is_body(&bodies[body as usize]));
        let others = all.into_iter().filter(|(_, own)| alone(*own)).map(|(i, _)| i).collect();
        bodies.retain(is_body);
        bodies.iter_mut().for_each(|body| body.paths.shrink_to_fit());
        bodies.iter_mut().for_each(Body::number_vertices);
        Self { bodies, others }
    }

    /// Positions of the elements that belong to no body.
    pub(crate) fn others(&self) -> impl Iterator<Item = usize> + '_ {
        self.others.iter().map(|&i| i as usize)
    }

    /// Adds the heat of all paths to that of their ends in W.
    pub(crate) fn add_heat(
        &self,
        (network, elements): (&Network, &[Element]),
        work: &mut Workspace,
    ) -> Result<(), InputError> {
        for body in &self.bodies {
            let Workspace { temperature, potentials, element_heat, .. } = &mut *work;
            if !body.conductivity.integrals(temperature, &body.vertices, potentials) {
                let mut elements = body.paths.iter().map(|path| path.element(elements));
                elements.try_for_each(|element| element.add_heat(network, work))?;
                continue;
            }
            for path in &body.paths {
                let heat = path.heat(potentials);
                let [from, to] = path.ends.map(|end| body.vertices[end as usize] as usize);
                element_heat[from] -= heat;
                element_heat[to] += heat;
            }
        }
        Ok(())
    }

    /// Adds their derivatives to the values of the Jacobian.
    pub(crate) fn add_slopes(
        &self,
        (network, elements): (&Network, &[Element]),
        work: &mut Workspace,
        (form, values): (JacobianForm, &mut [f64]),
    ) -> Result<(), InputError> {
        for body in &self.bodies {
            let Workspace { temperature, potentials, slopes, .. } = &mut *work;
            if !body.conductivity.values(temperature, &body.vertices, potentials) {
                for path in &body.paths {
                    path.element(elements).add_slopes(network, work, form, values)?;
                }
                continue;
            }
            for path in &body.paths {
                let [from, to] = path.ends.map(|end| path.shape * potentials[end as usize]);
                slopes.ends.clear();
                slopes.ends.extend([[-from, from], [to, -to]]);
                path.element(elements).add_evaluated(slopes, form, values);
            }
        }
        Ok(())
    }
}

impl Path {
    fn element<'a>(&self, elements: &'a [Element]) -> &'a Element {
        &elements[self.element as usize]
    }
}

impl Body {
    /// Renumbers the ends of paths from the vertices of the network to those of the body.
    fn number_vertices(&mut self) {
        self.vertices = self.paths.iter().flat_map(|path| path.ends).collect();
        self.vertices.sort_unstable();
        self.vertices.dedup();
        for path in &mut self.paths {
            let place = |vertex: u32| self.vertices.partition_point(|other| *other < vertex);
            path.ends = path.ends.map(|vertex| number(place(vertex)));
        }
    }
}
