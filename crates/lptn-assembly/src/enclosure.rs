//! Bounds on the heat flow of a system along a way, and on its Jacobian in a box.

use lptn_network::{End, InputBounds, Item};
use lptn_units::{Bounded, Scalar, Taylor};

use crate::element::{Element, Kind, NOWHERE};
use crate::system::ThermalSystem;

/// Bounds on the Jacobian of the flow, in the slots of its pattern, while the unknowns are in a
/// box.
#[derive(Clone, Debug)]
pub struct BoxSlopes {
    /// In W/K.
    pub low: Vec<f64>,
    /// In W/K.
    pub high: Vec<f64>,
    /// For each unknown the most by which the heat in W of those elements can differ in the box
    /// whose slopes have no bound, such as a film coefficient that rises as a root of `dT` at
    /// `dT = 0`. They are not part of the slopes.
    pub jumps: Vec<f64>,
}

impl BoxSlopes {
    /// The slopes in W/K that let an error grow most: the diagonal from above, the others in
    /// absolute value.
    pub fn worst(&self, system: &ThermalSystem) -> Vec<f64> {
        let magnitude = |(low, high): (&f64, &f64)| low.abs().max(high.abs());
        let mut worst: Vec<f64> = self.low.iter().zip(&self.high).map(magnitude).collect();
        for unknown in 0..self.jumps.len() {
            let slot = system.pattern.diagonal_slot(unknown);
            worst[slot] = self.high[slot];
        }
        worst
    }
}

/// Bounds on the flow of a system along a way.
#[derive(Clone, Debug)]
pub struct FlowBounds {
    /// Heat into each unknown in W.
    pub flow: Vec<Taylor>,
    /// For each unknown the range in W of the heat of those elements whose slopes along the way
    /// have no bound. In `flow` they have the middle of their range.
    pub spread: Vec<f64>,
}

/// Bounds while the vertices go a way: all vertices, and the numbers that expressions read.
struct Way<'a> {
    inputs: &'a mut InputBounds,
    /// Bounds on the temperature of each vertex in K: nodes, then boundaries.
    vertices: Vec<Taylor>,
}

impl ThermalSystem {
    /// Bounds on the heat flow into each unknown in W, and on its Taylor coefficients, while the
    /// unknowns go the way `y`, in K.
    ///
    /// # Errors
    /// The first element without bounds: its law decides by a value, as between two regimes.
    pub fn enclose_flow(&self, inputs: &mut InputBounds, y: &[Taylor]) -> Result<FlowBounds, Item> {
        let mut way = self.way(inputs, y)?;
        let mut heat = self.enclose_inputs(&mut way)?;
        let mut spread = vec![0.0; heat.len()];
        for radiation in self.radiation.iter() {
            let [from, to] = radiation.ends.map(|end| Bounded::from(way.vertices[end as usize]));
            let leaves = radiation.leaves(from, to).taylor();
            add(&mut heat, radiation.ends[0], -leaves);
            add(&mut heat, radiation.ends[1], leaves);
        }
        for element in self.elements.iter() {
            self.enclose_element(element, &mut way, (&mut heat, &mut spread))?;
        }
        let mut flow: Vec<Taylor> = self.unknowns.iter().map(|id| heat[id.index()]).collect();
        for link in self.links.iter() {
            let (a, b) = (link.a as usize, link.b as usize);
            let leaves = (y[a] - y[b]) * Taylor::constant(link.g);
            flow[a] = flow[a] - leaves;
            flow[b] = flow[b] + leaves;
        }
        for tie in self.ties.iter() {
            let a = tie.a as usize;
            let enters = (way.vertices[tie.b as usize] - y[a]) * Taylor::constant(tie.g);
            flow[a] = flow[a] + enters;
        }
        let spread = self.unknowns.iter().map(|id| spread[id.index()]).collect();
        Ok(FlowBounds { flow, spread })
    }

    /// For each unknown a sum of bounds in W, `rest` of each heat that is not linear in the unknowns
    /// and of each input, while the unknowns go the way `y`, in K.
    ///
    /// # Errors
    /// As [`ThermalSystem::enclose_flow`].
    pub fn enclose_rest(
        &self,
        inputs: &mut InputBounds,
        y: &[Taylor],
        rest: &dyn Fn(&Taylor) -> f64,
    ) -> Result<Vec<f64>, Item> {
        let mut way = self.way(inputs, y)?;
        let mut rests = vec![0.0; way.vertices.len()];
        self.for_each_input(&mut way, |vertex, power, share| {
            rests[vertex as usize] += share.abs() * rest(&power);
        })?;
        self.elimination().distribute(&mut rests);
        for radiation in self.radiation.iter() {
            let [from, to] = radiation.ends.map(|end| Bounded::from(way.vertices[end as usize]));
            let rest = rest(&radiation.leaves(from, to).taylor());
            radiation.ends.iter().for_each(|end| rests[*end as usize] += rest);
        }
        for element in self.elements.iter() {
            let received = self.enclose_received(element, way.inputs, &way.vertices);
            if received.is_empty() {
                return Err(element.item());
            }
            for (to, bounds) in element.receivers.iter().zip(received) {
                bounds.range().ok_or_else(|| element.item())?;
                rests[*to as usize] += rest(&bounds);
            }
        }
        let mut rests_of_unknowns: Vec<f64> =
            self.unknowns.iter().map(|id| rests[id.index()]).collect();
        for tie in self.ties.iter() {
            rests_of_unknowns[tie.a as usize] += tie.g * rest(&way.vertices[tie.b as usize]);
        }
        Ok(rests_of_unknowns)
    }

    /// Bounds on the temperatures of all vertices in K, nodes, then boundaries, while the unknowns go
    /// the way `y`. The rounding of eliminated nodes is not in them.
    ///
    /// # Errors
    /// A boundary or source without bounds.
    pub fn enclose_vertices(
        &self,
        inputs: &mut InputBounds,
        y: &[Taylor],
    ) -> Result<Vec<Taylor>, Item> {
        let mut way = self.way(inputs, y)?;
        let heat = self.enclose_inputs(&mut way)?;
        self.elimination().recover_bounds(&heat, &mut way.vertices);
        Ok(way.vertices)
    }

    fn way<'a>(&self, inputs: &'a mut InputBounds, y: &[Taylor]) -> Result<Way<'a>, Item> {
        let network = &self.network;
        let nodes = network.nodes().len();
        let unknown = Taylor::between(&[[f64::NEG_INFINITY, f64::INFINITY]]);
        let mut vertices = vec![unknown; nodes + network.boundaries().len()];
        self.unknowns.iter().zip(y).for_each(|(id, bounds)| vertices[id.index()] = *bounds);
        for (id, place) in network.boundary_ids().zip(nodes..) {
            let bounds = network.enclose_boundary(id, inputs);
            vertices[place] = bounds.ok_or(Item::Boundary(id))?;
        }
        Ok(Way { inputs, vertices })
    }

    /// The heat of the sources that read no temperature into each vertex, that of eliminated nodes
    /// passed on.
    fn enclose_inputs(&self, way: &mut Way<'_>) -> Result<Vec<Taylor>, Item> {
        let mut heat = vec![Taylor::constant(0.0); way.vertices.len()];
        self.for_each_input(way, |vertex, power, share| {
            add(&mut heat, vertex, power * Taylor::constant(share));
        })?;
        self.elimination().distribute_bounds(&mut heat);
        Ok(heat)
    }

    /// Calls with each vertex that a source enters which reads no temperature, with its heat in W
    /// and the share of the vertex.
    fn for_each_input(
        &self,
        way: &mut Way<'_>,
        mut each: impl FnMut(u32, Taylor, f64),
    ) -> Result<(), Item> {
        let network = &self.network;
        for (id, source) in network.source_ids().zip(network.sources()) {
            if network.source_variables(id).is_empty() {
                let power = network.enclose_source(id, way.inputs, &|_| Taylor::constant(0.0));
                let power = power.filter(|p| p.range().is_some()).ok_or(Item::Source(id))?;
                for (node, share) in &source.into {
                    each(self.vertex_of(End::Node(*node)), power, *share);
                }
            }
        }
        Ok(())
    }

    fn vertex_of(&self, end: End) -> u32 {
        u32::try_from(self.network.vertex(end)).unwrap_or(u32::MAX)
    }

    fn enclose_element(
        &self,
        element: &Element,
        way: &mut Way<'_>,
        (heat, spread): (&mut [Taylor], &mut [f64]),
    ) -> Result<(), Item> {
        let received = self.enclose_received(element, way.inputs, &way.vertices);
        if received.is_empty() {
            return Err(element.item());
        }
        for (to, bounds) in element.receivers.iter().zip(received) {
            let [low, high] = bounds.range().ok_or_else(|| element.item())?;
            if bounds.term(1).iter().all(|slope| slope.is_finite()) {
                add(heat, *to, bounds);
            } else {
                add(heat, *to, Taylor::constant(0.5 * (low + high)));
                spread[*to as usize] += high - low;
            }
        }
        Ok(())
    }

    /// Heat that each receiver of an element gets; empty if there are no bounds.
    fn enclose_received(
        &self,
        element: &Element,
        inputs: &mut InputBounds,
        vertices: &[Taylor],
    ) -> Vec<Taylor> {
        let at = |vertex: u32| vertices[vertex as usize];
        match element.kind {
            Kind::Stream(_, mcp) => {
                let [from, to] = [0, 1].map(|end| Bounded::from(at(element.receivers[end])));
                let ends = [
                    lptn_laws::advection_from(Bounded::from_f64(mcp), from, to),
                    lptn_laws::advection_to(Bounded::from_f64(mcp), from, to),
                ];
                ends.map(Bounded::taylor).to_vec()
            }
            Kind::Conductor(id) => {
                let received = self.network.enclose_exchange(id, inputs, &at);
                received.map_or_else(Vec::new, |ends| ends.to_vec())
            }
            Kind::Source(id) => {
                let power = self.network.enclose_source(id, inputs, &at);
                let shares = element.shares().iter();
                power.map_or_else(Vec::new, |power| {
                    shares.map(|share| power * Taylor::constant(*share)).collect()
                })
            }
        }
    }

    /// Bounds on the error of every node in K from those of the unknowns: an eliminated node is a
    /// mean of its neighbours, and so is its error.
    pub fn spread_bounds(&self, unknowns: &[f64]) -> Vec<f64> {
        let nodes = self.network.nodes().len();
        let mut bounds = vec![0.0; nodes + self.network.boundaries().len()];
        self.unknowns.iter().zip(unknowns).for_each(|(id, bound)| bounds[id.index()] = *bound);
        let no_heat = vec![0.0; bounds.len()];
        self.elimination().recover(&no_heat, &mut bounds);
        bounds.truncate(nodes);
        bounds
    }

    /// Bounds on the Jacobian while each unknown stays in its range in `y`, in K; the numbers that
    /// expressions read have those of `inputs`, which do not change along a way.
    ///
    /// # Errors
    /// As [`ThermalSystem::enclose_flow`].
    pub fn enclose_slopes(
        &self,
        inputs: &mut InputBounds,
        y: &[[f64; 2]],
    ) -> Result<BoxSlopes, Item> {
        let still: Vec<Taylor> = y.iter().map(|range| Taylor::between(&[*range])).collect();
        let mut way = self.way(inputs, &still)?;
        let mut low = vec![0.0; self.pattern.entries()];
        self.jacobian(&mut low);
        let mut slopes = BoxSlopes { high: low.clone(), low, jumps: vec![0.0; y.len()] };
        for radiation in self.radiation.iter() {
            let ends = radiation.ends.map(|end| way.vertices[end as usize].range());
            let [from, to] = ends.map(|range| radiation.slopes_within(range.unwrap_or_default()));
            let mut put = |place: usize, [low, high]: [f64; 2]| {
                let slot = radiation.slot(place);
                if slot != NOWHERE {
                    slopes.low[slot as usize] += low;
                    slopes.high[slot as usize] += high;
                }
            };
            put(0, [-from[1], -from[0]]);
            put(1, to);
            put(2, from);
            put(3, [-to[1], -to[0]]);
        }
        let mut number = vec![NOWHERE; way.vertices.len()];
        (0..).zip(self.unknowns.iter()).for_each(|(i, id)| number[id.index()] = i);
        for element in self.elements.iter() {
            self.add_box(element, (&mut way, &number), &mut slopes)?;
        }
        Ok(slopes)
    }

    /// Adds the bounds of one element, one variable after the other.
    fn add_box(
        &self,
        element: &Element,
        (way, number): (&mut Way<'_>, &[u32]),
        slopes: &mut BoxSlopes,
    ) -> Result<(), Item> {
        let variables = element.variables();
        let mut found = Vec::with_capacity(variables.len());
        for &variable in variables {
            let place = variable as usize;
            if number[place] == NOWHERE {
                found.push(vec![[0.0; 2]; element.receivers.len()]);
                continue;
            }
            let still = way.vertices[place];
            let range = still.range().unwrap_or_default();
            way.vertices[place] = Taylor::between(&[range, [1.0, 1.0]]).first_order();
            let received = self.enclose_received(element, way.inputs, &way.vertices);
            way.vertices[place] = still;
            found.push(received.iter().map(|bounds| bounds.term(1)).collect());
        }
        let known = |column: &Vec<[f64; 2]>| {
            column.len() == element.receivers.len()
                && column.iter().flatten().all(|slope| slope.is_finite())
        };
        if !found.iter().all(known) {
            return self.add_jump(element, (way, number), slopes);
        }
        for (row, _) in element.receivers.iter().enumerate() {
            for (column, bounds) in found.iter().enumerate() {
                let slot = element.slot_at(row, column);
                if slot != NOWHERE {
                    slopes.low[slot as usize] += bounds[row][0];
                    slopes.high[slot as usize] += bounds[row][1];
                }
            }
        }
        Ok(())
    }

    /// Adds the range of the heat of an element in the box instead of its slopes.
    fn add_jump(
        &self,
        element: &Element,
        (way, number): (&mut Way<'_>, &[u32]),
        slopes: &mut BoxSlopes,
    ) -> Result<(), Item> {
        let received = self.enclose_received(element, way.inputs, &way.vertices);
        if received.is_empty() {
            return Err(element.item());
        }
        for (receiver, bounds) in element.receivers.iter().zip(received) {
            let [low, high] = bounds.range().ok_or_else(|| element.item())?;
            if let Some(jump) = slopes.jumps.get_mut(number[*receiver as usize] as usize) {
                *jump += high - low;
            }
        }
        Ok(())
    }
}

fn add(heat: &mut [Taylor], vertex: u32, bounds: Taylor) {
    let place = vertex as usize;
    heat[place] = heat[place] + bounds;
}
