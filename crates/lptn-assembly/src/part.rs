//! The balances of some unknowns by themselves: the paths and sources that reach them, and no
//! others.
//!
//! The massless surfaces of a body are balanced at every evaluation of its heat, in a few rounds
//! each, and again for every row. The paths inside the body do not matter. They made up 70 %
//! of a run of 10 x 10 x 10 cells whose conductivity depends on temperature.
//!
//! Sums run in the order of the whole system, so that both give the same numbers.

use std::collections::BTreeSet;

use lptn_network::InputError;

use crate::bodies::Bodies;
use crate::element::JacobianForm;
use crate::positions::{chosen, number};
use crate::system::ThermalSystem;
use crate::together::Together;
use crate::workspace::Workspace;

/// Some unknowns of a system, with the paths and sources that reach them or read them.
#[derive(Clone, Debug)]
pub struct Part {
    /// Unknowns whose temperature is read, each with its vertex; those of the part among them.
    unknowns: Vec<(u32, u32)>,
    /// Other vertices that elements give heat to.
    given: Vec<u32>,
    /// Positions of links, ties, radiation and elements in the lists of the system.
    links: Vec<u32>,
    ties: Vec<u32>,
    radiation: Vec<u32>,
    bodies: Bodies,
    together: Together,
    /// Those in no body, each with true if it is evaluated together with others.
    elements: Vec<(u32, bool)>,
}

impl ThermalSystem {
    /// The part of the system with the balances of these unknowns, given by their numbers.
    pub fn part(&self, unknowns: &[usize]) -> Part {
        let mut known = vec![false; self.unknowns.len()];
        let mut meets = vec![false; self.network.nodes().len() + self.network.boundaries().len()];
        for &i in unknowns {
            known[i] = true;
            meets[self.unknowns[i].index()] = true;
        }
        let meet = |vertices: &[u32]| vertices.iter().any(|&v| meets[v as usize]);
        let links = chosen(&self.links, |link| known[link.a as usize] || known[link.b as usize]);
        let ties = chosen(&self.ties, |tie| known[tie.a as usize]);
        let radiation = chosen(&self.radiation, |r| meet(&r.ends));
        let elements = chosen(&self.elements, |e| meet(&e.receivers) || meet(e.variables()));
        for link in links.iter().map(|&i| &self.links[i as usize]) {
            (known[link.a as usize], known[link.b as usize]) = (true, true);
        }
        let ends = radiation.iter().flat_map(|&i| &self.radiation[i as usize].ends);
        let elements_of = || elements.iter().map(|&i| &self.elements[i as usize]);
        let receivers: BTreeSet<u32> =
            ends.chain(elements_of().flat_map(|e| &e.receivers)).copied().collect();
        let read = elements_of().flat_map(|e| e.variables()).chain(&receivers);
        read.for_each(|&v| meets[v as usize] = true);
        let vertex = |i: usize| self.unknowns[i].index();
        let read = (0..known.len()).filter(|&i| known[i] || meets[vertex(i)]);
        let unknowns: Vec<(u32, u32)> = read.map(|i| (number(i), number(vertex(i)))).collect();
        unknowns.iter().for_each(|&(_, vertex)| meets[vertex as usize] = false);
        let given = receivers.into_iter().filter(|&v| meets[v as usize]).collect();
        let positions = elements.iter().map(|&i| i as usize);
        let bodies = Bodies::of(&self.network, &self.elements, positions);
        let together = Together::of(&self.network, (&self.elements, &self.outer), bodies.others());
        let evaluated: BTreeSet<u32> = together.elements().collect();
        let elements = bodies.others().map(number).map(|i| (i, evaluated.contains(&i))).collect();
        Part { unknowns, given, links, ties, radiation, bodies, together, elements }
    }

    /// Like [`ThermalSystem::flow`] for the unknowns of a part; the other values are incomplete.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`], of the elements that meet the part.
    pub fn flow_of(
        &self,
        part: &Part,
        work: &mut Workspace,
        y: &[f64],
        flow: &mut [f64],
    ) -> Result<(), InputError> {
        self.put_part(part, work, y);
        for &(unknown, vertex) in &part.unknowns {
            flow[unknown as usize] = work.heat[vertex as usize];
            work.element_heat[vertex as usize] = 0.0;
        }
        part.links.iter().for_each(|&i| self.links[i as usize].add_heat(y, flow));
        for tie in part.ties.iter().map(|&i| &self.ties[i as usize]) {
            flow[tie.a as usize] += tie.g * (work.temperature[tie.b as usize] - y[tie.a as usize]);
        }
        part.given.iter().for_each(|&vertex| work.element_heat[vertex as usize] = 0.0);
        for radiation in part.radiation.iter().map(|&i| &self.radiation[i as usize]) {
            radiation.add_heat(&work.temperature, &mut work.element_heat);
        }
        part.bodies.add_heat((&self.network, &self.elements), work)?;
        part.together.evaluate(work, self.elements.len(), false);
        for &(i, is_known) in &part.elements {
            match is_known {
                true => self.add_known(work, i as usize)?,
                false => self.elements[i as usize].add_heat(&self.network, work)?,
            }
        }
        for &(unknown, vertex) in &part.unknowns {
            flow[unknown as usize] += work.element_heat[vertex as usize];
        }
        Ok(())
    }

    /// Like [`ThermalSystem::jacobian_at`] for the derivatives of the part and for all derivatives
    /// by its unknowns; the others are incomplete.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow_of`].
    pub fn jacobian_of(
        &self,
        part: &Part,
        work: &mut Workspace,
        y: &[f64],
        values: &mut [f64],
    ) -> Result<(), InputError> {
        values.fill(0.0);
        part.links.iter().for_each(|&i| self.add_link_slopes(i as usize, values));
        for tie in part.ties.iter().map(|&i| &self.ties[i as usize]) {
            values[self.pattern.diagonal_slot(tie.a as usize)] -= tie.g;
        }
        self.put_part(part, work, y);
        let form = JacobianForm::Exact;
        for radiation in part.radiation.iter().map(|&i| &self.radiation[i as usize]) {
            radiation.add_slopes(&work.temperature, form, values);
        }
        part.bodies.add_slopes((&self.network, &self.elements), work, (form, values))?;
        let mut elements = part.elements.iter().map(|&(i, _)| &self.elements[i as usize]);
        elements.try_for_each(|element| element.add_slopes(&self.network, work, form, values))
    }

    /// Takes the temperatures that the part reads.
    fn put_part(&self, part: &Part, work: &mut Workspace, y: &[f64]) {
        for &(unknown, vertex) in &part.unknowns {
            work.temperature[vertex as usize] = y[unknown as usize];
        }
    }
}
