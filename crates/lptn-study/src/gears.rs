//! A train of gears at a speed and torque: speeds, torques, powers, and losses.

use lptn_assembly::{AssemblyError, ThermalSystem};
use lptn_laws::{Engagement, GearPair, Group};
use lptn_netlist::{Gearbox, Member};
use lptn_network::{BuildErrors, Evaluation, InputError, Item, Network, SignalId, SourceId};
use lptn_solve::SteadyError;
use lptn_units::Class;

/// The step of ln(speed) to each side over which exponents are taken.
const STEP: f64 = 1e-3;

/// A train of gears in its network.
#[derive(Clone, Debug)]
pub struct GearTask<'a> {
    /// The network that its losses heat.
    pub network: &'a Network,
    /// Its stages: first the one whose speed is given, then those that it drives.
    pub stages: Vec<&'a Gearbox>,
    /// The time in s at which other inputs are read.
    pub time: f64,
}

/// An operating point of a train.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GearPoint {
    /// Speed of the input in rad/s; default: that of the network.
    pub speed: Option<f64>,
    /// Torque on the input in N m; default: that of the network.
    pub torque: Option<f64>,
    /// The temperature of all nodes in K; default: those of the steady state.
    pub temperature: Option<f64>,
}

/// The state of a train at a point.
#[derive(Clone, Debug)]
pub struct GearState {
    /// Every member of every stage that turns about a fixed axis, and the planets.
    pub members: Vec<MemberState>,
    /// The loss of each part, stage by stage.
    pub losses: Vec<PartLoss>,
    /// The temperature of every node in K.
    pub temperatures: Vec<f64>,
}

/// A member of a stage.
#[derive(Clone, Debug)]
pub struct MemberState {
    /// The stage it belongs to, as a position in [`GearTask::stages`].
    pub stage: usize,
    /// Its kind of member.
    pub member: Member,
    /// Its speed in rad/s; that of a planet is against the carrier.
    pub speed: f64,
    /// The torque that acts on it from outside in N m, without losses; `None` without a torque, and
    /// of a planet.
    pub torque: Option<f64>,
}

impl MemberState {
    /// The power that enters by it in W, without losses; below 0 it leaves.
    pub fn power(&self) -> Option<f64> {
        Some(self.speed * self.torque?)
    }
}

/// The loss of a part of a train.
#[derive(Clone, Debug)]
pub struct PartLoss {
    /// The part, without the index of a planet.
    pub name: String,
    /// The first of its elements, which are alike.
    pub source: SourceId,
    /// Number of its elements.
    pub count: usize,
    /// Heat of all of them in W, at least 0.
    pub heat: f64,
    /// d ln P / d ln speed while no temperature changes; `None` if nothing is lost.
    pub exponent: Option<f64>,
    /// The same along steady states; `None` if temperatures are fixed too.
    pub followed: Option<f64>,
    /// Groups of its law outside their range, with their values.
    pub outside: Vec<(&'static Group, f64)>,
}

/// A mesh of a train: its teeth.
#[derive(Clone, Debug)]
pub struct MeshTeeth {
    /// The part, without the index of a planet.
    pub name: String,
    /// The two gears.
    pub pair: GearPair<f64>,
    /// Working centre distance, pressure angle and contact.
    pub at: Engagement,
}

impl MeshTeeth {
    /// Transverse contact ratio `epsilon_alpha`.
    pub fn contact_ratio(&self) -> f64 {
        self.at.contact[0] + self.at.contact[1]
    }

    /// Factor of gear loss `H_V`.
    pub fn loss_factor(&self) -> f64 {
        self.pair.loss_factor()
    }
}

lptn_units::errors! {
/// Why a train of gears has no results.
#[derive(Debug)]
pub enum GearError {
    /// The network has no such numbers.
    Network(errors: BuildErrors) = "gear::network",
        format!("there is no network at this point: {errors}");
    /// It cannot be assembled.
    Assembly => AssemblyError;
    /// There is no steady state.
    Steady => SteadyError as Class::not_an_answer;
    /// An input has no value.
    Input => InputError;
    /// A torque is requested, and the gearbox has none.
    NoTorque(name: String) = "gear::no_torque",
        format!("gearbox `{name}` has no torque: its meshes are left out"),
        help "give it `torque`, `module`, `width`, `Ra` and `lubricant`";
}
}

impl<'a> GearTask<'a> {
    /// The stages that a gearbox drives, itself first.
    pub fn train(all: &'a [Gearbox], first: &Gearbox) -> Vec<&'a Gearbox> {
        let mut stages: Vec<&Gearbox> = Vec::new();
        for gearbox in all {
            let driven = gearbox.driver.as_ref();
            let follows = driven.is_some_and(|name| stages.iter().any(|s| s.name == *name));
            if gearbox.name == first.name || follows {
                stages.push(gearbox);
            }
        }
        stages
    }

    /// Speed of the input in rad/s as the network has it.
    pub fn speed(&self) -> f64 {
        let first = self.stages[0];
        value(self.network, &self.scope(self.network), &first.of(first.input, "speed"))
    }

    /// The state of the train at a point.
    ///
    /// # Errors
    /// [`GearError`], in particular if the losses have no steady state.
    pub fn at(&self, point: GearPoint) -> Result<GearState, GearError> {
        let speed = point.speed.unwrap_or_else(|| self.speed());
        // the network's torque may depend on the speed
        let driven = |factor: f64| self.driven(speed * factor, point.torque);
        if point.torque.is_some() && !self.stages[0].loaded {
            return Err(GearError::NoTorque(self.stages[0].name.clone()));
        }
        let network = driven(1.0)?;
        let vertices = self.vertices(&network, point.temperature)?;
        let members = self.members(&network);
        let mut losses = self.losses(&network, &vertices)?;
        if speed != 0.0 {
            let beside = [-STEP, STEP].map(|step| driven(step.exp()));
            let [below, above] = beside;
            let (below, above) = (below?, above?);
            let held = [self.heats(&below, &vertices)?, self.heats(&above, &vertices)?];
            let followed = match point.temperature {
                Some(_) => None,
                None => Some([self.settled(&below)?, self.settled(&above)?]),
            };
            for (at, loss) in losses.iter_mut().enumerate() {
                loss.exponent = exponent([held[0][at], held[1][at]]);
                loss.followed = followed.as_ref().and_then(|f| exponent([f[0][at], f[1][at]]));
            }
        }
        let temperatures = vertices[..network.nodes().len()].to_vec();
        Ok(GearState { members, losses, temperatures })
    }

    /// The network with another speed and torque of the input.
    fn driven(&self, speed: f64, torque: Option<f64>) -> Result<Network, GearError> {
        let first = self.stages[0];
        let named = [("speed", Some(speed)), ("torque", torque)];
        let named = named.map(|(what, value)| Some((first.of(first.input, what), value?)));
        let (mut parameters, mut signals) = (self.network.given(), Vec::new());
        for (name, value) in named.into_iter().flatten() {
            match (self.network.parameter(&name), signal(self.network, &name)) {
                (Ok(id), _) => parameters.set(id, value),
                (_, Some(id)) => signals.push((id, value)),
                _ => {}
            }
        }
        let network = self.network.with(&parameters).map_err(GearError::Network)?;
        match signals.is_empty() {
            true => Ok(network),
            false => network.held(&signals).map_err(GearError::Network),
        }
    }

    /// The temperatures of nodes and boundaries.
    fn vertices(&self, network: &Network, held: Option<f64>) -> Result<Vec<f64>, GearError> {
        let Some(temperature) = held else {
            let system = ThermalSystem::assemble(network)?;
            let steady = lptn_analysis::steady(&system, self.time)?;
            return Ok([&steady.temperatures[..], &steady.boundary_temperatures].concat());
        };
        let mut vertices = vec![temperature; network.nodes().len() + network.boundaries().len()];
        let mut scope = self.scope(network);
        network.boundary_temperatures(&mut scope, &mut vertices[network.nodes().len()..])?;
        Ok(vertices)
    }

    fn scope(&self, network: &Network) -> Evaluation {
        let mut scope = network.evaluation();
        scope.set_time(self.time, self.time);
        scope
    }

    /// The heats in the steady state of a network.
    fn settled(&self, network: &Network) -> Result<Vec<f64>, GearError> {
        self.heats(network, &self.vertices(network, None)?)
    }

    fn members(&self, network: &Network) -> Vec<MemberState> {
        let scope = self.scope(network);
        let of = |(stage, gearbox): (usize, &Gearbox), member: Member| {
            let shaft = gearbox.arrangement.shafts().contains(&member);
            let torque = (gearbox.loaded && shaft).then(|| gearbox.of(member, "torque"));
            MemberState {
                stage,
                member,
                speed: value(network, &scope, &gearbox.of(member, "speed")),
                torque: torque.map(|name| value(network, &scope, &name)),
            }
        };
        let stages = self.stages.iter().enumerate();
        let all = stages.flat_map(|(at, gearbox)| {
            gearbox.arrangement.members().iter().map(move |member| ((at, *gearbox), *member))
        });
        all.map(|(stage, member)| of(stage, member)).collect()
    }

    /// The elements of every part, stage by stage.
    fn parts(&self) -> impl Iterator<Item = (&'a str, Vec<SourceId>)> {
        let parts = self.stages.iter().flat_map(|gearbox| &gearbox.parts);
        let network = self.network;
        parts.map(move |part| {
            let ids = part.elements.iter().filter_map(|name| match network.item(name) {
                Ok(Item::Source(id)) => Some(id),
                _ => None,
            });
            (part.name.as_str(), ids.collect())
        })
    }

    /// The teeth of every mesh, at the values of the network.
    pub fn meshes(&self) -> Vec<MeshTeeth> {
        let network = self.network;
        let mut scope = self.scope(network);
        let mut mesh = |(name, elements): (&str, Vec<SourceId>)| {
            let law = network.law(Item::Source(*elements.first()?))?;
            let mut number = |value| {
                let constant = network.is_constant(value).then(|| value.at(&mut scope).ok());
                constant.flatten().unwrap_or(f64::NAN)
            };
            let values: Vec<f64> = law.values().iter().map(&mut number).collect();
            let pair = law.formula().gears(&values)?;
            Some(MeshTeeth { name: name.to_owned(), pair, at: pair.engagement() })
        };
        self.parts().filter_map(&mut mesh).collect()
    }

    fn heats(&self, network: &Network, vertices: &[f64]) -> Result<Vec<f64>, GearError> {
        let mut scope = self.scope(network);
        let parts = self.parts().map(|(_, elements)| {
            let mut heat = 0.0;
            for id in elements {
                heat += network.source_heat(id, &mut scope, vertices)?;
            }
            Ok(heat)
        });
        parts.collect()
    }

    fn losses(&self, network: &Network, vertices: &[f64]) -> Result<Vec<PartLoss>, GearError> {
        let (mut scope, mut losses) = (self.scope(network), Vec::new());
        let heats = self.heats(network, vertices)?;
        for ((name, elements), heat) in self.parts().zip(heats) {
            let Some(&source) = elements.first() else { continue };
            let values = network.groups(Item::Source(source), &mut scope, vertices)?;
            let law = network.law(Item::Source(source));
            let groups = law.map_or(&[][..], |law| law.formula().declaration().groups);
            let outside = groups.iter().zip(values).filter_map(|(g, value)| Some((g, value?)));
            losses.push(PartLoss {
                name: name.to_owned(),
                source,
                count: elements.len(),
                heat,
                exponent: None,
                followed: None,
                outside: outside.filter(|(group, value)| !group.contains(*value)).collect(),
            });
        }
        Ok(losses)
    }
}

impl GearState {
    /// The total loss in W.
    pub fn loss(&self) -> f64 {
        self.losses.iter().map(|loss| loss.heat).sum()
    }

    /// The torque on the input in N m, if there is one.
    pub fn torque(&self, task: &GearTask<'_>) -> Option<f64> {
        let input = task.stages[0].input;
        self.members.iter().find(|m| m.stage == 0 && m.member == input)?.torque
    }

    /// The power at the input in W without losses: above 0 it drives, below 0 it is driven.
    pub fn power(&self, task: &GearTask<'_>) -> Option<f64> {
        let input = task.stages[0].input;
        self.members.iter().find(|m| m.stage == 0 && m.member == input)?.power()
    }

    /// Power out over power in; `None` at no load, and if more is lost than goes in.
    pub fn efficiency(&self, task: &GearTask<'_>) -> Option<f64> {
        let (power, loss) = (self.power(task)?, self.loss());
        let efficiency = if power > 0.0 { (power - loss) / power } else { -power / (loss - power) };
        (power != 0.0 && efficiency >= 0.0).then_some(efficiency)
    }

    /// The drag torque in N m: the losses over the input speed; `None` at rest.
    pub fn drag(&self, task: &GearTask<'_>) -> Option<f64> {
        let input = task.stages[0].input;
        let shaft = self.members.iter().find(|m| m.stage == 0 && m.member == input)?;
        (shaft.speed != 0.0).then(|| self.loss() / shaft.speed.abs())
    }
}

/// The slope of ln P over ln speed between two heats, a step to each side.
fn exponent([below, above]: [f64; 2]) -> Option<f64> {
    (below > 0.0 && above > 0.0).then(|| (above / below).ln() / (2.0 * STEP))
}

fn signal(network: &Network, name: &str) -> Option<SignalId> {
    network.signal_ids().find(|id| network.signals()[id.index()].name == name)
}

/// The value of a parameter or signal.
fn value(network: &Network, scope: &Evaluation, name: &str) -> f64 {
    match (network.parameter(name), signal(network, name)) {
        (Ok(id), _) => network.parameter_value(id),
        (_, Some(id)) => scope.signal(id),
        _ => f64::NAN,
    }
}
