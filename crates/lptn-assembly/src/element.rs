//! Elements that are more than a constant conductance: their heat and its derivatives, with places
//! in the Jacobian.

use lptn_network::{
    ConductorFlow, ConductorId, End, InputError, Item, Network, Received, SourceId, Vertices,
};

use crate::pattern::JacobianPattern;
use crate::slopes::Slopes;
use crate::workspace::Workspace;

/// Kind of an element, by which its heat is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A conductor that is a stream of this constant capacity rate in W/K.
    Stream(ConductorId, f64),
    /// A conductor as the network evaluates it.
    Conductor(ConductorId),
    /// A source whose heat depends on temperatures.
    Source(SourceId),
}

/// An element with the vertices that receive its heat and those it depends on.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) kind: Kind,
    /// Two ends of a conductor, the nodes of a source.
    pub(crate) receivers: Few,
    /// Slot of each pair (receiver, variable), receiver by receiver; [`NOWHERE`] if one of them is
    /// given.
    slots: Few,
    /// `None` for a conductor that depends on its ends alone.
    more: Option<Box<More>>,
}

#[derive(Clone, Debug)]
struct More {
    variables: Few,
    /// Shares of a source; empty for a conductor, whose ends each receive their own heat.
    shares: Vec<f64>,
}

/// Numbers of an element. Those of a conductor between its ends take no further memory: a body of a
/// million cells has three million conductors.
pub(crate) type Few = Vertices;

/// The derivatives of a conductor's heats by its variables, if they are known.
pub(crate) type Known<'a> = dyn Fn(ConductorId) -> Option<&'a [Received]> + 'a;

/// No place in the Jacobian.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Form of the Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JacobianForm {
    /// The derivatives as they are.
    Exact,
    /// Symmetric: each conductor with the mean of its two derivatives. Newton's method converges
    /// with it more slowly, to the same point.
    Symmetric,
}

/// The slot of an entry.
pub(crate) fn slot(pattern: &JacobianPattern, row: u32, column: u32) -> u32 {
    u32::try_from(pattern.slot(row, column)).expect("fewer than 2^32 links are in memory")
}

impl Element {
    /// True if it is a stream of a constant capacity rate.
    pub(crate) fn is_constant_stream(&self) -> bool {
        matches!(self.kind, Kind::Stream(..))
    }

    /// The conductor it is, for those that are.
    pub(crate) fn conductor(&self) -> Option<ConductorId> {
        match self.kind {
            Kind::Stream(id, _) | Kind::Conductor(id) => Some(id),
            Kind::Source(_) => None,
        }
    }

    /// The item of the network that it is.
    pub(crate) fn item(&self) -> Item {
        match self.kind {
            Kind::Stream(id, _) | Kind::Conductor(id) => Item::Conductor(id),
            Kind::Source(id) => Item::Source(id),
        }
    }

    /// Slot of the derivative of the heat that one receiver gets, by one variable.
    pub(crate) fn slot_at(&self, receiver: usize, variable: usize) -> u32 {
        self.slots[receiver * self.variables().len() + variable]
    }

    /// The vertices it depends on.
    pub(crate) fn variables(&self) -> &[u32] {
        self.more.as_ref().map_or(&self.receivers, |more| &more.variables)
    }

    /// Shares of a source; empty for a conductor, whose ends each receive their own heat.
    pub(crate) fn shares(&self) -> &[f64] {
        self.more.as_ref().map_or(&[], |more| &more.shares)
    }

    /// The elements of a network that are neither constant conductances nor radiation of a constant
    /// area, in the order of conductors, then sources.
    pub(crate) fn all_of(network: &Network) -> Vec<Self> {
        let vertex = |end: End| u32::try_from(network.vertex(end)).expect("ids are 32 bits wide");
        let conductors =
            network.conductors().iter().zip(network.conductor_ids()).filter_map(|(c, id)| {
                let ends = || Few::from_slice(&[vertex(c.from), vertex(c.to)]);
                let (kind, variables) = match network.flow(id) {
                    ConductorFlow::Conductance(_) | ConductorFlow::Radiation(_) => return None,
                    ConductorFlow::Stream(mcp) => (Kind::Stream(id, mcp), ends()),
                    ConductorFlow::Variable => {
                        (Kind::Conductor(id), network.conductor_variables(id))
                    }
                };
                let receivers = ends();
                let more = (variables != receivers)
                    .then(|| Box::new(More { variables, shares: Vec::new() }));
                Some(Self { kind, receivers, slots: Few::new(), more })
            });
        let sources = network.sources().iter().zip(network.source_ids()).filter_map(|(s, id)| {
            let variables = Few::from_slice(network.source_variables(id));
            let receivers = s.into.iter().map(|&(node, _)| vertex(End::Node(node))).collect();
            let shares = s.into.iter().map(|&(_, share)| share).collect();
            let kind = Kind::Source(id);
            (!variables.is_empty()).then(|| {
                let more = Some(Box::new(More { variables, shares }));
                Self { kind, receivers, slots: Few::new(), more }
            })
        });
        let mut all: Vec<Self> = conductors.chain(sources).collect();
        all.shrink_to_fit();
        all
    }

    /// The pairs of unknowns that meet in it; `unknown` is `u32::MAX` for a vertex that is given.
    pub(crate) fn pairs<'a>(&'a self, unknown: &'a [u32]) -> impl Iterator<Item = (u32, u32)> + 'a {
        let known = |v: &u32| unknown[*v as usize];
        let all = self
            .receivers
            .iter()
            .flat_map(move |r| self.variables().iter().map(move |v| (known(r), known(v))));
        all.filter(|&(r, v)| r != u32::MAX && v != u32::MAX)
    }

    pub(crate) fn place(&mut self, unknown: &[u32], pattern: &JacobianPattern) {
        let mut slots = Few::with_capacity(self.receivers.len() * self.variables().len());
        for &receiver in &self.receivers {
            for &variable in self.variables() {
                let (row, column) = (unknown[receiver as usize], unknown[variable as usize]);
                let given = row == u32::MAX || column == u32::MAX;
                slots.push(if given { NOWHERE } else { slot(pattern, row, column) });
            }
        }
        self.slots = slots;
    }

    /// True if its derivatives have a symmetric form: a conductor between its ends, or one node's
    /// own heat.
    pub(crate) fn is_symmetric(&self, network: &Network) -> bool {
        match self.kind {
            Kind::Stream(..) => false,
            Kind::Conductor(id) => {
                !network.conductors()[id.index()].law.is_stream() && self.variables().len() == 2
            }
            Kind::Source(_) => self.variables() == &self.receivers[..],
        }
    }

    /// The heat that both ends of a conductor receive in W.
    pub(crate) fn received(
        &self,
        network: &Network,
        work: &mut Workspace,
    ) -> Result<Received, InputError> {
        let at = |k: usize| work.temperature[self.receivers[k] as usize];
        Ok(match self.kind {
            Kind::Stream(_, mcp) => {
                let (from, to) = (at(0), at(1));
                // adding 0 leaves no negative zero to be printed
                [
                    lptn_laws::advection_from(mcp, from, to) + 0.0,
                    lptn_laws::advection_to(mcp, from, to) + 0.0,
                ]
            }
            Kind::Conductor(id) => network.exchange(id, &mut work.scope, &work.temperature)?,
            Kind::Source(_) => [0.0; 2],
        })
    }

    /// Adds its heat to that of every vertex in W; a source's power is kept.
    pub(crate) fn add_heat(
        &self,
        network: &Network,
        work: &mut Workspace,
    ) -> Result<(), InputError> {
        if let Kind::Source(id) = self.kind {
            let power = network.source_heat(id, &mut work.scope, &work.temperature)?;
            work.power[id.index()] = power;
            for (&vertex, share) in self.receivers.iter().zip(self.shares()) {
                work.element_heat[vertex as usize] += share * power;
            }
            return Ok(());
        }
        let heat = self.received(network, work)?;
        for (&vertex, q) in self.receivers.iter().zip(heat) {
            work.element_heat[vertex as usize] += q;
        }
        Ok(())
    }

    /// Adds its derivatives to the values of the Jacobian.
    pub(crate) fn add_slopes(
        &self,
        network: &Network,
        work: &mut Workspace,
        form: JacobianForm,
        values: &mut [f64],
    ) -> Result<(), InputError> {
        self.add_slopes_with((network, work), form, &|_| None, values)
    }

    /// The same with its derivatives if they are known.
    pub(crate) fn add_slopes_with(
        &self,
        (network, work): (&Network, &mut Workspace),
        form: JacobianForm,
        known: &Known<'_>,
        values: &mut [f64],
    ) -> Result<(), InputError> {
        match self.conductor().and_then(known) {
            Some(slopes) => {
                work.slopes.ends.clear();
                work.slopes.ends.extend_from_slice(slopes);
            }
            None => self.evaluate_slopes(network, work)?,
        }
        self.add_evaluated(&mut work.slopes, form, values);
        Ok(())
    }

    /// Adds derivatives that are known to the values of the Jacobian.
    pub(crate) fn add_evaluated(
        &self,
        slopes: &mut Slopes,
        form: JacobianForm,
        values: &mut [f64],
    ) {
        if form == JacobianForm::Symmetric && self.shares().is_empty() {
            let g = self.symmetric_conductance(&slopes.ends);
            slopes.ends[0] = [-g, g];
            slopes.ends[1] = [g, -g];
        }
        let mut slots = self.slots.iter();
        for row in 0..self.receivers.len() {
            for column in 0..self.variables().len() {
                let Some(&slot) = slots.next().filter(|slot| **slot != NOWHERE) else { continue };
                values[slot as usize] += match self.shares().get(row) {
                    Some(share) => share * slopes.source[column],
                    None => slopes.ends[column][row],
                };
            }
        }
    }

    /// The conductance in W/K that replaces both derivatives of a conductor: their mean, or the
    /// exact one if the other end is given. Never negative, so that the matrix stays definite.
    fn symmetric_conductance(&self, ends: &[Received]) -> f64 {
        let given = |k: usize| self.slots[3 * k] == NOWHERE; // its place on the diagonal
        let g = match (given(0), given(1)) {
            (false, true) => -ends[0][0],
            (true, false) => -ends[1][1],
            _ => 0.5 * (ends[0][1] - ends[1][1]),
        };
        g.max(0.0)
    }

    fn evaluate_slopes(&self, network: &Network, work: &mut Workspace) -> Result<(), InputError> {
        let Workspace { scope, temperature, slopes, .. } = work;
        match self.kind {
            Kind::Stream(_, mcp) => {
                let (forward, backward) = (mcp.max(0.0), (-mcp).max(0.0));
                slopes.ends.clear();
                slopes.ends.extend([[-backward, forward], [backward, -forward]]);
            }
            Kind::Conductor(id) => {
                network.exchange_slopes(id, scope, temperature, &mut slopes.ends)?;
            }
            Kind::Source(id) => {
                network.source_slopes(id, scope, temperature, &mut slopes.source)?;
            }
        }
        Ok(())
    }
}
