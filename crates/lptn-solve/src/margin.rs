//! The margin of a limit at given moments, and its derivatives by temperatures and parameters.
//!
//! They are read from the margin itself, by five values that need no solution: good to about eleven
//! digits.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{InputError, LimitId, Network, NodeId, ParameterId, Positions};

use crate::replay::Replay;
use crate::sensitive_run::step;
use crate::stencil::{slope, slope_of_size};

/// Step of a temperature in K for the derivative of a result by it.
pub(crate) const KELVIN: f64 = 0.01;

lptn_units::errors! {
/// Reason why a margin has no derivative.
#[derive(Debug)]
pub enum BentMargin {
    /// The network takes no other value of a parameter.
    Change => ChangeError;
    /// The margin has no value.
    Input => InputError;
    /// It is not smooth: to both sides it changes differently.
    Bends { name: String, by: String } = "gradient::bends",
        format!("`{name}` is not smooth here: it has no derivative by `{by}`"),
        help "begin at another value, or use a method without derivatives";
}
}

/// A state of a network at one time.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// The time in s, and one inside the segment.
    pub(crate) at: (f64, f64),
    /// `None` if nothing switches.
    pub(crate) positions: Option<Positions>,
    /// Temperature of each node in K.
    pub(crate) nodes: Vec<f64>,
    /// Weight of the margin there.
    pub(crate) weight: f64,
}

/// The margin of a limit of a system.
#[derive(Clone, Copy)]
pub(crate) struct Margin<'a> {
    pub(crate) system: &'a ThermalSystem,
    pub(crate) limit: LimitId,
}

impl Margin<'_> {
    fn network(&self) -> &Network {
        self.system.network()
    }

    fn bends(&self, by: &str) -> BentMargin {
        let name = self.network().limits()[self.limit.index()].text.clone();
        BentMargin::Bends { name, by: by.to_owned() }
    }

    /// The nodes that the limit reads, if it reads nothing else.
    pub(crate) fn nodes_alone(&self) -> Option<Vec<NodeId>> {
        let sides = self.network().limits()[self.limit.index()].sides();
        let [of, value] = sides.map(|side| self.network().nodes_alone(side));
        Some([of?, value?].concat())
    }

    /// True if both sides are a temperature or a number, so that its derivatives are constants.
    pub(crate) fn is_plain(&self) -> bool {
        let sides = self.network().limits()[self.limit.index()].sides();
        sides.iter().all(|side| side.programs().is_empty())
    }

    /// The nodes by whose temperatures it may change.
    pub(crate) fn nodes(&self) -> Vec<NodeId> {
        self.nodes_alone().unwrap_or_else(|| self.network().thermal_nodes().collect())
    }

    /// The margin at a point in SI units.
    pub(crate) fn at(&self, point: &Point) -> Result<f64, InputError> {
        self.read(&mut Replay::new(self.system), point, &point.nodes)
    }

    fn read(
        &self,
        replay: &mut Replay<'_>,
        point: &Point,
        nodes: &[f64],
    ) -> Result<f64, InputError> {
        point.positions.iter().for_each(|positions| replay.set_positions(positions));
        replay.go_to(point.at, nodes);
        replay.margin(self.limit)
    }

    /// The derivative by the temperature of each node; `nodes` are those it may change with, and
    /// `typical` is the mean size of the margin: a far smaller bend does not count.
    pub(crate) fn by_nodes(
        &self,
        point: &Point,
        (nodes, typical): (&[NodeId], f64),
    ) -> Result<Vec<f64>, BentMargin> {
        let mut replay = Replay::new(self.system);
        let mut temperatures = point.nodes.clone();
        let mut weights = vec![0.0; temperatures.len()];
        for &node in nodes {
            let own = temperatures[node.index()];
            let found = slope_of_size((KELVIN, typical), |change| {
                temperatures[node.index()] = own + change;
                self.read(&mut replay, point, &temperatures)
            })?;
            temperatures[node.index()] = own;
            let none = || self.bends(&format!("{}.T", self.network().nodes()[node.index()].name));
            weights[node.index()] = found.ok_or_else(none)?;
        }
        Ok(weights)
    }

    /// The derivative by a parameter, while temperatures stay, of the sum over these points of the
    /// margin times their weights.
    pub(crate) fn directly(
        &self,
        points: &[Point],
        parameter: ParameterId,
    ) -> Result<f64, BentMargin> {
        let own = self.network().parameter_value(parameter);
        let at = |change: f64| -> Result<f64, BentMargin> {
            let mut changed = self.network().given();
            changed.set(parameter, own + change);
            let system = self.system.with(&changed)?;
            let mut replay = Replay::new(&system);
            let one =
                |point: &Point| Ok(point.weight * self.read(&mut replay, point, &point.nodes)?);
            points.iter().map(one).sum()
        };
        let found = slope(step(self.network(), parameter), at)?;
        found.ok_or_else(|| self.bends(&self.network().parameters()[parameter.index()].name))
    }
}
