//! One node, or a few in a row, instead of a network: as a network that runs.

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Cauer, HeatCapacity, HeatFlow, Network, NetworkBuilder, NodeId, Resistance, Temperature,
};

use crate::carried::{Carried, first};
use crate::error::ReduceError;
use crate::norton::NortonEquivalent;

/// The elements between the port and the reference.
pub(crate) struct Row {
    /// Resistance in K/W before the first capacity; 0 for none.
    pub(crate) direct: f64,
    /// Capacities in J/K with the resistances after them in K/W, port first.
    pub(crate) rungs: Vec<(f64, f64)>,
}

impl From<&Cauer> for Row {
    fn from(ladder: &Cauer) -> Self {
        Self { direct: ladder.direct, rungs: ladder.rungs.clone() }
    }
}

impl Row {
    /// One node with this capacity in J/K, or none.
    pub(crate) fn one(resistance: f64, capacity: f64) -> Self {
        if capacity > 0.0 {
            Self { direct: 0.0, rungs: vec![(capacity, resistance)] }
        } else {
            Self { direct: resistance, rungs: Vec::new() }
        }
    }
}

/// Everything but the capacities.
pub(crate) struct OneNode<'a> {
    pub(crate) system: &'a ThermalSystem,
    pub(crate) norton: &'a NortonEquivalent,
    /// Temperature of the port at the start in K.
    pub(crate) initial: f64,
    /// Start of the run in s, for the values of constant inputs.
    pub(crate) start: f64,
}

impl OneNode<'_> {
    /// The network with this row of nodes. The first has the name of the port.
    ///
    /// Constant inputs become one boundary `T_ref` at the end of the row and one source `Q_N`. If
    /// an input changes with time, every boundary stays, after the last resistance over its weight,
    /// and every source, times its weight. Expressions stay as written, and the whole is the same
    /// equivalent at every moment.
    pub(crate) fn network(&self, row: &Row) -> Result<Network, ReduceError> {
        let from = self.system.network();
        let mut builder = NetworkBuilder::new();
        let varies = from.has_time_dependent_inputs();
        let carried = self.carried();
        if varies {
            carried.parameters(&mut builder)?;
        }
        let (port, end) = self.row(&mut builder, row);
        if varies {
            self.boundaries(&mut builder, end, &carried)?;
            self.sources(&mut builder, port, &carried)?;
        } else {
            self.constants(&mut builder, port, end)?;
        }
        builder.build().map_err(|errors| ReduceError::Equivalent(first(&errors)))
    }

    /// Adds the nodes; returns the port, and the last node with the resistance after it.
    fn row(&self, builder: &mut NetworkBuilder, row: &Row) -> (NodeId, (NodeId, f64)) {
        let name = &self.system.network().nodes()[self.norton.port.index()].name;
        let start = Temperature(self.initial);
        let massless = (row.direct > 0.0).then(|| builder.massless(name));
        let mut before = massless.map(|port| (port, row.direct));
        let mut port = massless;
        for (k, &(capacity, resistance)) in (1..).zip(&row.rungs) {
            let here = if k == 1 && massless.is_none() {
                name.clone()
            } else {
                self.carried().free(&format!("n{k}"))
            };
            let node = builder.node(&here, HeatCapacity(capacity), start);
            if let Some((last, resistance)) = before {
                let between = self.carried().free(&format!("R_{k}"));
                builder.resistor(&between, last, node, Resistance(resistance));
            }
            port = port.or(Some(node));
            before = Some((node, resistance));
        }
        let end = before.unwrap_or_else(|| (builder.massless(name), self.norton.resistance));
        (port.unwrap_or(end.0), end)
    }

    fn constants(
        &self,
        builder: &mut NetworkBuilder,
        port: NodeId,
        (end, resistance): (NodeId, f64),
    ) -> Result<(), ReduceError> {
        let inputs = self.norton.inputs(self.system, self.start).map_err(ReduceError::Input)?;
        let reference =
            builder.boundary(&self.carried().free("T_ref"), Temperature(inputs.reference));
        let name = self.carried().free(if port == end { "R_eq" } else { "R_end" });
        builder.resistor(&name, end, reference, Resistance(resistance));
        if !self.system.network().sources().is_empty() {
            builder.source(&self.carried().free("Q_N"), port, HeatFlow(inputs.heat));
        }
        Ok(())
    }

    fn boundaries(
        &self,
        builder: &mut NetworkBuilder,
        (node, resistance): (NodeId, f64),
        carried: &Carried<'_>,
    ) -> Result<(), ReduceError> {
        for (place, &weight) in self.norton.boundary_weights.iter().enumerate() {
            if weight > 0.0 {
                let end = carried.boundary(builder, place)?;
                let name = &self.system.network().boundaries()[place].name;
                let name = carried.free(&format!("R_{name}"));
                builder.resistor(&name, node, end, Resistance(resistance / weight));
            }
        }
        Ok(())
    }

    fn sources(
        &self,
        builder: &mut NetworkBuilder,
        node: NodeId,
        carried: &Carried<'_>,
    ) -> Result<(), ReduceError> {
        for (place, &weight) in self.norton.source_weights.iter().enumerate() {
            if weight > 0.0 {
                carried.source(builder, (place, weight), &[(node.into(), 1.0)])?;
            }
        }
        Ok(())
    }

    /// The inputs that are kept.
    fn carried(&self) -> Carried<'_> {
        let some = |weights: &[f64]| weights.iter().map(|w| *w > 0.0).collect();
        Carried {
            system: self.system,
            boundaries: some(&self.norton.boundary_weights),
            sources: some(&self.norton.source_weights),
        }
    }
}
