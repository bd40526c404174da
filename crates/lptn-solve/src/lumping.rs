//! Checks of lumped nodes: Biot number and diffusion time of every node that has a characteristic
//! length.
//!
//! The film coefficient of a node is the heat that all its surfaces give off for 1 K, over their
//! area: h = sum of G / A. A surface that convects radiates too, so the larger of the two areas
//! counts, and in addition that of contacts.

use std::collections::BTreeMap;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_laws::{SurfaceKind, biot, diffusion_time};
use lptn_network::{
    ConductorId, ConductorKind, End, Evaluation, Field, InputError, MaterialId, Network,
    NoMaterial, NodeId,
};

use crate::newton_error::NewtonError;
use crate::solution::Solution;
use crate::times::just_after;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;

/// A jump of an input changes it by more than this part of its size; less is rounding.
const JUMP: f64 = 1e-9;

/// The largest Biot number of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biot {
    /// h L / k.
    pub number: f64,
    /// h in W/(m^2 K): conductance of all surfaces over their area.
    pub coefficient: f64,
    /// k of its material in W/(m K).
    pub conductivity: f64,
    /// Its time in s.
    pub time: f64,
}

/// Reason why something could not be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotChecked {
    /// Its capacity is a number without a material.
    NoMaterial,
    /// Its parts are of several materials.
    SeveralMaterials,
    /// Its material has no conductivity, or none at its temperature.
    NoConductivity,
    /// Its material has no density or specific heat.
    NoHeatCapacity,
    /// No convection, contact or radiation leads from it.
    NoSurface,
    /// This surface has no area: it is given by `R` or `Gr`.
    NoArea(ConductorId),
    /// A value of its surfaces cannot be computed.
    NoValue,
}

/// Results of one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LumpCheck {
    /// The node.
    pub node: NodeId,
    /// Its characteristic length in m.
    pub length: f64,
    /// Its largest Biot number.
    pub biot: Result<Biot, NotChecked>,
    /// Its longest diffusion time L^2 / alpha in s.
    pub diffusion: Result<f64, NotChecked>,
}

/// A part of a run in which no input jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its beginning in s.
    pub from: f64,
    /// Its end in s.
    pub to: f64,
}

/// Lump checks of the nodes of a network.
#[derive(Clone, Debug, PartialEq)]
pub struct Lumping {
    /// The nodes with a characteristic length, ascending.
    pub checks: Vec<LumpCheck>,
    /// The other nodes with a capacity, ascending: they cannot be checked.
    pub without_length: Vec<NodeId>,
    /// The shortest part of the run in which no source and no boundary jumps; `None` if no run is
    /// known.
    pub shortest: Option<Stretch>,
}

impl Lumping {
    /// A Biot number above this is not a lump's: Incropera et al., 6th edition, equation 5.10.
    pub const MOST_BIOT: f64 = 0.1;

    /// The largest part of the shortest stretch that a diffusion time may be: within it the
    /// temperature of the lump is not that of the body's surface or middle, so more would reach
    /// into every result.
    pub const MOST_PART: f64 = 0.1;

    /// With the temperatures at the start, in s, of a run until `stop` if one is known.
    ///
    /// # Errors
    /// [`Unsolved`] if a value cannot be computed at the start, or the balances of massless nodes
    /// have no solution there.
    pub fn at_start(
        system: &ThermalSystem,
        start: f64,
        stop: Option<f64>,
    ) -> Result<Self, Unsolved> {
        let mut checker = Checker::new(system);
        if !checker.bodies.is_empty() {
            let unsolved = |error| Unsolved::new(system, error);
            let mut work = system.workspace();
            checker.go_to_start(&mut work, start).map_err(unsolved)?;
            checker.look(&mut work, start);
        }
        let span = stop.map(|stop| (start, stop));
        Ok(checker.into_lumping(span))
    }

    /// Checks at every row of a run; if not every node was recorded, at its start and its end.
    pub fn of_run(solution: &Solution) -> Self {
        let system = &solution.system;
        let mut checker = Checker::new(system);
        let span = (solution.times().first().copied().unwrap_or(0.0), solution.last().time);
        if !checker.bodies.is_empty() && solution.is_whole() {
            let mut times = solution.times().iter();
            solution.replay(|at| {
                if let Some(&time) = times.next() {
                    checker.look(at.work(), time);
                }
            });
        } else if !checker.bodies.is_empty() {
            let mut work = system.workspace();
            if checker.go_to_start(&mut work, span.0).is_ok() {
                checker.look(&mut work, span.0);
            }
            let end = system.read_inputs(&mut work, span.1, span.1);
            if end.is_ok() {
                system.place(&mut work, &solution.last().temperatures);
                checker.look(&mut work, span.1);
            }
        }
        checker.into_lumping((span.1 > span.0).then_some(span))
    }

    /// The checks with a Biot number that is not a lump's, the largest first.
    pub fn too_thick(&self) -> Vec<(&LumpCheck, Biot)> {
        let checks = self.checks.iter().filter_map(|check| Some((check, check.biot.ok()?)));
        let mut found: Vec<_> = checks.filter(|(_, biot)| biot.number > Self::MOST_BIOT).collect();
        found.sort_by(|a, b| b.1.number.total_cmp(&a.1.number));
        found
    }

    /// The checks with a diffusion time that is not small against the shortest stretch, the longest
    /// first.
    pub fn too_slow(&self) -> Vec<(&LumpCheck, f64, Stretch)> {
        let Some(stretch) = self.shortest else { return Vec::new() };
        let most = Self::MOST_PART * (stretch.to - stretch.from);
        let checks =
            self.checks.iter().filter_map(|check| Some((check, check.diffusion.ok()?, stretch)));
        let mut found: Vec<_> = checks.filter(|(_, time, _)| *time > most).collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found
    }
}

/// A node that is checked.
struct Body {
    check: LumpCheck,
    material: Result<MaterialId, NotChecked>,
    surfaces: Vec<ConductorId>,
}

struct Checker<'a> {
    system: &'a ThermalSystem,
    bodies: Vec<Body>,
    scope: Evaluation,
}

impl<'a> Checker<'a> {
    fn new(system: &'a ThermalSystem) -> Self {
        let network = system.network();
        let stores = network.thermal_nodes().filter(|id| !network.nodes()[id.index()].massless);
        let mut bodies: Vec<Body> = stores.filter_map(|id| Body::new(network, id)).collect();
        let places: BTreeMap<NodeId, usize> =
            bodies.iter().enumerate().map(|(i, body)| (body.check.node, i)).collect();
        if places.is_empty() {
            return Self { system, bodies, scope: network.evaluation() };
        }
        for (conductor, id) in network.conductors().iter().zip(network.conductor_ids()) {
            for end in [conductor.from, conductor.to] {
                if let End::Node(node) = end
                    && let (Some(&place), true) = (places.get(&node), is_surface(conductor.kind))
                {
                    bodies[place].surfaces.push(id);
                }
            }
        }
        Self { system, bodies, scope: network.evaluation() }
    }

    fn go_to_start(&self, work: &mut Workspace, start: f64) -> Result<(), NewtonError> {
        self.system.read_inputs(work, start, just_after(start)).map_err(NewtonError::Input)?;
        let mut unfold = Unfold::at_start(self.system)?;
        let temperatures = unfold.temperatures(work, &self.system.initial())?;
        self.system.recover(work, temperatures);
        Ok(())
    }

    /// Takes in the temperatures at one time.
    fn look(&mut self, work: &mut Workspace, time: f64) {
        let Self { system, bodies, scope } = self;
        for body in bodies {
            let temperature = system.node_temperatures(work)[body.check.node.index()];
            let mut property = |field| {
                let material = body.material?;
                Ok(system.network().property((material, field), temperature, scope))
            };
            let diffusion = diffusion(body.check.length, &mut property);
            let conductivity = property(Field::Conductivity);
            let biot = conductivity.and_then(|conductivity| {
                let conductivity = conductivity.ok_or(NotChecked::NoConductivity)?;
                let coefficient = body.coefficient(system, work)?;
                let number = biot(coefficient, body.check.length, conductivity);
                Ok(Biot { number, coefficient, conductivity, time })
            });
            keep_larger(&mut body.check.biot, biot, |biot| biot.number);
            keep_larger(&mut body.check.diffusion, diffusion, |time| *time);
        }
    }

    fn into_lumping(self, run: Option<(f64, f64)>) -> Lumping {
        let network = self.system.network();
        let lacks = |id: &NodeId| {
            let node = &network.nodes()[id.index()];
            !node.massless && node.length.is_none()
        };
        let shortest = run.filter(|_| !self.bodies.is_empty()).map(|run| shortest(network, run));
        let checks = self.bodies.into_iter().map(|body| body.check).collect();
        Lumping {
            checks,
            without_length: network.thermal_nodes().filter(lacks).collect(),
            shortest,
        }
    }
}

fn is_surface(kind: ConductorKind) -> bool {
    kind.declaration().surface.is_some()
}

impl Body {
    fn new(network: &Network, node: NodeId) -> Option<Self> {
        let length = network.length(node)?;
        let material = network.material_of(node).map_err(|none| match none {
            NoMaterial::Unnamed => NotChecked::NoMaterial,
            NoMaterial::Several => NotChecked::SeveralMaterials,
        });
        let unknown = NotChecked::NoValue;
        let check = LumpCheck { node, length, biot: Err(unknown), diffusion: Err(unknown) };
        Some(Self { check, material, surfaces: Vec::new() })
    }

    /// The film coefficient of all surfaces together in W/(m^2 K).
    fn coefficient(&self, system: &ThermalSystem, work: &mut Workspace) -> Result<f64, NotChecked> {
        let (mut conductance, mut skin, mut seen, mut touching) = (0.0, 0.0, 0.0, 0.0);
        for &id in &self.surfaces {
            let surface = system.surface(work, id).map_err(|_: InputError| NotChecked::NoValue)?;
            let Some(surface) = surface else { continue };
            let area = surface.area.ok_or(NotChecked::NoArea(id))?;
            conductance += surface.conductance;
            match system.network().conductors()[id.index()].kind.declaration().surface {
                Some(SurfaceKind::Seen) => seen += area,
                Some(SurfaceKind::Touching) => touching += area,
                _ => skin += area,
            }
        }
        let area = f64::max(skin, seen) + touching;
        if area > 0.0 { Ok(conductance / area) } else { Err(NotChecked::NoSurface) }
    }
}

/// L^2 / alpha in s of a body whose properties are read.
fn diffusion(
    length: f64,
    property: &mut dyn FnMut(Field) -> Result<Option<f64>, NotChecked>,
) -> Result<f64, NotChecked> {
    let conductivity = property(Field::Conductivity)?.ok_or(NotChecked::NoConductivity)?;
    match (property(Field::Density)?, property(Field::SpecificHeat)?) {
        (Some(density), Some(cp)) => Ok(diffusion_time(length, conductivity, density, cp)),
        _ => Err(NotChecked::NoHeatCapacity),
    }
}

fn keep_larger<T>(
    known: &mut Result<T, NotChecked>,
    new: Result<T, NotChecked>,
    size: impl Fn(&T) -> f64,
) {
    let larger = match (&*known, &new) {
        (Ok(known), Ok(new)) => size(new) > size(known),
        (Err(_), _) => true,
        (Ok(_), Err(_)) => false,
    };
    if larger {
        *known = new;
    }
}

/// The shortest part of a run between two jumps of inputs; the start is one of them.
fn shortest(network: &Network, (start, stop): (f64, f64)) -> Stretch {
    let breakpoints = network.breakpoints(start, stop).unwrap_or_default();
    let inside = breakpoints.into_iter().filter(|time| *time > start && *time < stop);
    let times: Vec<f64> = [start].into_iter().chain(inside).chain([stop]).collect();
    let mut scope = network.evaluation();
    let mut shortest = Stretch { from: start, to: stop };
    let mut from = start;
    for three in times.windows(3).map(|three| [three[0], three[1], three[2]]) {
        if jumps(network, three, &mut scope) {
            shortest = shortest.or(Stretch { from, to: three[1] });
            from = three[1];
        }
    }
    shortest.or(Stretch { from, to: stop })
}

impl Stretch {
    /// The shorter of two.
    fn or(self, other: Self) -> Self {
        if other.to - other.from < self.to - self.from { other } else { self }
    }
}

/// True if a source or boundary jumps at the second of three neighbouring times.
fn jumps(network: &Network, [last, now, next]: [f64; 3], scope: &mut Evaluation) -> bool {
    let count = network.sources().len();
    let mut read = |inside: f64| {
        scope.set_time(now, inside);
        let mut values = vec![0.0; count + network.boundaries().len()];
        let (power, temperature) = values.split_at_mut(count);
        // a missing value stops the run, which reports it
        network.source_powers(scope, power).ok()?;
        network.boundary_temperatures(scope, temperature).ok().map(|()| values)
    };
    let (Some(before), Some(after)) = (read(0.5 * (last + now)), read(0.5 * (now + next))) else {
        return false;
    };
    before.iter().zip(&after).any(|(a, b)| (a - b).abs() > JUMP * a.abs().max(b.abs()))
}
