//! Massless nodes that are solved for: their linear response to states and heats.
//!
//! Their balances close at every state, so that `J_aa dT_a + J_as dT_s = 0`. The Jacobian of the
//! states alone is `J_ss - J_sa J_aa^-1 J_as` (implicit function theorem).
//!
//! Massless nodes that are connected without a state between them form a group. The pattern depends
//! on the groups and not on numbers, so it is the same at every state.

use std::collections::BTreeSet;

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::Pattern;

use crate::newton::Newton;
use crate::newton_error::NewtonError;

/// The exact Jacobian at one state, with the factors of its massless part.
pub(crate) struct Algebraic<'a> {
    system: &'a ThermalSystem,
    newton: Option<Newton<'a>>,
    pattern: Pattern,
    /// `J` in W/K over all unknowns.
    values: Vec<f64>,
}

/// Entries of one column of a sparse matrix: the row and the value, rows ascending.
pub(crate) type Column = Vec<(usize, f64)>;

impl<'a> Algebraic<'a> {
    /// At temperatures of all unknowns in K, with inputs read in `work`.
    pub(crate) fn at(
        system: &'a ThermalSystem,
        work: &mut Workspace,
        unknowns: &[f64],
    ) -> Result<Self, NewtonError> {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let mut values = vec![0.0; pattern.len()];
        let taken = system.jacobian_at(work, unknowns, JacobianForm::Exact, &mut values);
        taken.map_err(NewtonError::Input)?;
        let (states, all) = (system.states().len(), unknowns.len());
        let mut newton = None;
        if states < all {
            let mut solved = Newton::new(system, (states..all).collect())?;
            solved.factorize(work, unknowns, 0.0)?;
            newton = Some(solved);
        }
        Ok(Self { system, newton, pattern, values })
    }

    /// The response of massless nodes (rows, counted from the first massless one) to the temperature
    /// of each state (columns), in K/K.
    pub(crate) fn follow(&mut self) -> Result<Vec<Column>, NewtonError> {
        let states = self.system.states().len();
        let group = self.groups();
        let mut follow = Vec::with_capacity(states);
        for state in 0..states {
            let entries = self.pattern.column(state).map(|slot| self.pattern.row_indices()[slot]);
            let touched: BTreeSet<usize> =
                entries.filter_map(|row| Some(group[row.checked_sub(states)?])).collect();
            if touched.is_empty() {
                follow.push(Column::new());
                continue;
            }
            let mut heat = vec![0.0; group.len()];
            for slot in self.pattern.column(state) {
                if let Some(node) = self.pattern.row_indices()[slot].checked_sub(states) {
                    heat[node] = self.values[slot];
                }
            }
            self.solve(&mut heat)?;
            let members = heat.into_iter().enumerate();
            follow.push(members.filter(|(node, _)| touched.contains(&group[*node])).collect());
        }
        Ok(follow)
    }

    /// The group of each massless node.
    fn groups(&self) -> Vec<usize> {
        let states = self.system.states().len();
        let count = self.pattern.size() - states;
        let mut group = vec![usize::MAX; count];
        for first in 0..count {
            let mut waiting = vec![first];
            while let Some(node) = waiting.pop() {
                if group[node] != usize::MAX {
                    continue;
                }
                group[node] = first;
                let column = self.pattern.column(states + node);
                let rows = column.map(|slot| self.pattern.row_indices()[slot]);
                waiting.extend(rows.filter_map(|row| row.checked_sub(states)));
            }
        }
        group
    }

    /// The Jacobian of the states alone in W/K, column by column; `follow` is the response of the
    /// massless nodes.
    pub(crate) fn reduced(&self, follow: &[Column]) -> Vec<Column> {
        let states = self.system.states().len();
        let (mut sum, mut is_in) = (vec![0.0; states], vec![false; states]);
        let mut columns = Vec::with_capacity(states);
        for (state, followed) in follow.iter().enumerate() {
            let mut rows = Vec::new();
            let own = [(state, 1.0)].into_iter();
            for (unknown, share) in own.chain(followed.iter().map(|&(a, x)| (states + a, x))) {
                for slot in self.pattern.column(unknown) {
                    let row = self.pattern.row_indices()[slot];
                    if row < states {
                        sum[row] += share * self.values[slot];
                        if !std::mem::replace(&mut is_in[row], true) {
                            rows.push(row);
                        }
                    }
                }
            }
            rows.sort_unstable();
            let take = |row: usize| {
                is_in[row] = false;
                (row, std::mem::take(&mut sum[row]))
            };
            columns.push(rows.into_iter().map(take).collect());
        }
        columns
    }

    /// The response to a heat into each vertex in W at constant states: temperatures of all unknowns
    /// in K, and the heat that the states then receive in W.
    pub(crate) fn respond(&mut self, heat: &[f64]) -> Result<(Vec<f64>, Vec<f64>), NewtonError> {
        let states = self.system.states().len();
        let of = |ids: &[lptn_network::NodeId]| -> Vec<f64> {
            ids.iter().map(|id| heat[id.index()]).collect()
        };
        let mut moved = of(self.system.algebraic());
        self.solve(&mut moved)?;
        let mut unknowns = vec![0.0; states];
        unknowns.extend(moved);
        let mut product = vec![0.0; unknowns.len()];
        self.pattern.multiply(&self.values, &unknowns, &mut product);
        let own = of(self.system.states());
        let received = own.iter().zip(product).map(|(heat, product)| heat + product).collect();
        Ok((unknowns, received))
    }

    /// From heats into massless nodes in W to their temperatures in K at constant states.
    fn solve(&mut self, heat: &mut [f64]) -> Result<(), NewtonError> {
        match &mut self.newton {
            Some(newton) => newton.factors.solve_in_place(heat).map_err(NewtonError::Factorization),
            None => Ok(()),
        }
    }
}
