//! Heat into and out of one node or boundary: every path and source that reaches it.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{ConductorId, End, FacePathId, InputError, Item, Network, Received, SourceId};

use crate::ledger::{self, Ledger};

/// Heat of one path or source.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The conductor, the path to a face of a grid, or the source.
    pub item: Item,
    /// The end that a conductor comes from, the first one of a path to a face; `None` for a source.
    pub other: Option<End>,
    /// Heat flow at the end of the run in W, positive into the node.
    pub power: f64,
    /// Heat over the run in J, positive into the node; `None` in steady state.
    pub heat: Option<f64>,
}

/// The heat balance of one node or boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// The node or boundary.
    pub of: End,
    /// Everything that reaches it, in the order of the network: conductors, then sources.
    pub terms: Vec<Term>,
    /// Stored heat in J, from its own temperature and capacity; for a boundary the heat it takes.
    /// The sum of the terms less this is the balance's residual. `None` in steady state.
    pub stored: Option<f64>,
}

impl Balance {
    /// The balance of a node or boundary with these heat flows of its paths and sources, in W.
    pub(crate) fn of_flows(
        network: &Network,
        of: End,
        received: &[Received],
        source_heat: &[f64],
    ) -> Self {
        let terms = Books::new(network, Some(of)).kinds.into_iter().map(|kind| {
            let power = match kind {
                Kind::Conductor(id, side) => received[id.index()][side],
                Kind::FacePath(id, side) => {
                    let parts = network.face_paths()[id.index()].conductors();
                    parts.map(|part| received[part.index()][side]).sum()
                }
                Kind::Source(id, share) => share * source_heat[id.index()],
            };
            kind.term(network, power, None)
        });
        Self { of, terms: terms.collect(), stored: None }
    }

    /// The sum of all heat flows in W: stored in the node or taken by the boundary.
    pub fn power(&self) -> f64 {
        self.terms.iter().map(|term| term.power).sum()
    }

    /// The sum of the heat of all terms in J.
    pub fn heat(&self) -> Option<f64> {
        self.terms.iter().map(|term| term.heat).sum()
    }

    /// The terms with the largest path first: by heat over the run, in steady state by heat flow;
    /// of equal ones in the order of the network.
    pub fn largest_first(&self) -> Vec<Term> {
        let size = |term: &Term| term.heat.unwrap_or(term.power).abs();
        let mut terms = self.terms.clone();
        terms.sort_by(|a, b| size(b).total_cmp(&size(a)));
        terms
    }

    /// Total heat exchanged, for shares: the larger of heat in and heat out, in W.
    pub fn power_turned_over(&self) -> f64 {
        turned_over(self.terms.iter().map(|term| term.power))
    }

    /// The same as [`Balance::power_turned_over`], over the run in J.
    pub fn heat_turned_over(&self) -> Option<f64> {
        self.stored?;
        Some(turned_over(self.terms.iter().filter_map(|term| term.heat)))
    }
}

/// The larger of heat in and heat out.
fn turned_over(heat: impl Iterator<Item = f64>) -> f64 {
    let (into, out) = heat.fold((0.0, 0.0), |(i, o), q: f64| (i + q.max(0.0), o + (-q).max(0.0)));
    into.max(out)
}

/// The origin of the heat of a term.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A conductor, and which of its ends the node is.
    Conductor(ConductorId, usize),
    /// A path to a face of a grid, and which of its ends the node is.
    FacePath(FacePathId, usize),
    /// A source, and the share of its heat.
    Source(SourceId, f64),
}

/// The terms of the requested node, and the running integrals of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Books {
    of: Option<End>,
    kinds: Vec<Kind>,
    /// The share of the total heat by which the ledger may be off, if the run gives one.
    error: Option<f64>,
}

impl Books {
    pub(crate) fn new(network: &Network, of: Option<End>) -> Self {
        let Some(end) = of else { return Self::default() };
        let conductors = network.conductors().iter().zip(network.conductor_ids());
        let alone = network.whole(end.into()).is_none();
        let mut kinds: Vec<Kind> = conductors
            .filter_map(|(c, id)| {
                let side = [c.from, c.to].iter().position(|&e| e == end)?;
                Some(match network.whole(Item::Conductor(id)) {
                    Some(Item::FacePath(whole)) if alone => Kind::FacePath(whole, side),
                    _ => Kind::Conductor(id, side),
                })
            })
            .collect();
        // the parts of a path to a face follow one another
        kinds.dedup_by_key(|kind| match *kind {
            Kind::FacePath(id, _) => (Some(id), None),
            Kind::Conductor(id, _) => (None, Some(Item::Conductor(id))),
            Kind::Source(id, _) => (None, Some(Item::Source(id))),
        });
        for (source, id) in network.sources().iter().zip(network.source_ids()) {
            let shares = source.into.iter().filter(|(node, _)| End::Node(*node) == end);
            kinds.extend(shares.map(|(_, share)| Kind::Source(id, *share)));
        }
        Self { of, kinds, error: None }
    }

    /// The same, with a ledger that may be off by this share of the total heat.
    pub(crate) fn allowing(self, error: Option<f64>) -> Self {
        Self { error, ..self }
    }

    /// Number of running integrals that a run needs: those of the ledger, then the terms.
    pub(crate) fn integrals(&self, system: &ThermalSystem) -> usize {
        ledger::integrals(system) + self.kinds.len()
    }

    /// Their integrands in W at the inputs of `work` and the temperatures `y` of the unknowns.
    pub(crate) fn integrands(
        &self,
        system: &ThermalSystem,
        work: &mut Workspace,
        y: &[f64],
        q: &mut [f64],
    ) -> Result<(), InputError> {
        let (of_ledger, terms) = q.split_at_mut(ledger::integrals(system));
        ledger::integrands(system, work, y, of_ledger)?;
        if self.kinds.is_empty() {
            return Ok(());
        }
        system.recover(work, y); // eliminated nodes are ends of paths too
        terms.iter_mut().zip(&self.kinds).try_for_each(|(q, kind)| {
            *q = kind.power(system, work)?;
            Ok(())
        })
    }

    /// The ledger, and the balance with the heat flows at the state of `work`.
    pub(crate) fn close(
        &self,
        system: &ThermalSystem,
        work: &mut Workspace,
        integrals: &[f64],
        (stored, tolerance): (Vec<f64>, (f64, f64)),
    ) -> (Ledger, Option<Balance>) {
        let (of_ledger, heats) = integrals.split_at(ledger::integrals(system));
        let ledger = Ledger::new(system, of_ledger, stored, tolerance).allowing(self.error);
        let balance = self.of.map(|of| {
            let stored = match of {
                End::Node(id) => ledger.warmed(system.network(), id),
                End::Boundary(id) => -ledger.boundaries[id.index()],
            };
            let network = system.network();
            let terms = self.kinds.iter().zip(heats).map(|(kind, heat)| {
                let power = kind.power(system, work).unwrap_or(f64::NAN);
                kind.term(network, power, Some(*heat))
            });
            Balance { of, terms: terms.collect(), stored: Some(stored) }
        });
        (ledger, balance)
    }
}

impl Kind {
    fn power(self, system: &ThermalSystem, work: &mut Workspace) -> Result<f64, InputError> {
        Ok(match self {
            Self::Conductor(id, side) => system.received(work, id)?[side],
            Self::FacePath(id, side) => {
                let parts = system.network().face_paths()[id.index()].conductors();
                parts
                    .map(|part| Ok(system.received(work, part)?[side]))
                    .sum::<Result<f64, InputError>>()?
            }
            Self::Source(id, share) => share * system.source_powers(work)[id.index()],
        })
    }

    fn term(self, network: &Network, power: f64, heat: Option<f64>) -> Term {
        match self {
            Self::Conductor(id, side) => {
                let conductor = &network.conductors()[id.index()];
                let other = if side == 0 { conductor.to } else { conductor.from };
                Term { item: Item::Conductor(id), other: Some(other), power, heat }
            }
            Self::FacePath(id, side) => {
                let first = network.face_paths()[id.index()].conductors().next();
                let first = first.map(|id| &network.conductors()[id.index()]);
                let other = first.map(|c| if side == 0 { c.to } else { c.from });
                Term { item: Item::FacePath(id), other, power, heat }
            }
            Self::Source(id, _) => Term { item: Item::Source(id), other: None, power, heat },
        }
    }
}
