//! Values of reports and margins with their derivatives by parameters, for optimisers.
//!
//! The reports and the parameters are those of a sweep. A steady state has an adjoint, so that its
//! gradient costs one more solution. So has a run, through its events: each result costs as much as
//! one to six runs. A network without capacities has forward sensitivities. A maximum changes as
//! the quantity does at its time, an integral as the integral of the derivative.
//!
//! A report becomes a limit of the network with the bound 0: limits have a time at which they are
//! worst, and derivatives.

mod backward;
mod error;
mod followed;
mod over_run;
mod series;

pub use error::GradientError;
pub use followed::Gradients;
pub use series::GradientSeries;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Measure, SweepOver};
use lptn_network::{
    Bound, Functional, Item, Limit, LimitId, LimitSeverity, Network, ParameterId, RunSettings,
    Value,
};
use lptn_solve::{Proceed, Progress};

use crate::gradient::followed::Followed;
use crate::gradient::over_run::OverRun;
use crate::sweep::SweepTask;

impl SweepTask {
    /// The first `reports` of the study and the margins of these limits, with their derivatives by the
    /// parameters of the study at these values, all in SI units.
    ///
    /// # Errors
    /// [`GradientError`], also if a result is not smooth there.
    pub fn gradients(
        &self,
        values: &[f64],
        (reports, margins): (usize, &[LimitId]),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Gradients, GradientError> {
        let (network, ids) = self.asked_at(values, reports)?;
        let own = self.network().limits().len();
        let followed = self.followed(&network, (own, margins))?;
        let system = ThermalSystem::assemble(&network).map_err(lptn_assembly::ChangeError::from)?;
        match self.study().over {
            SweepOver::Steady => self.steady_gradients(&system, &followed, &ids),
            SweepOver::Periodic => Err(GradientError::Periodic),
            SweepOver::Run => {
                let run = self.run_for(&network, &ids)?;
                let mut moving = followed.iter().filter(|one| {
                    one.functional != Functional::Last
                        && network.result_jump_moves(Item::Limit(one.limit), &ids)
                });
                if let Some(one) = moving.next() {
                    return Err(GradientError::MovingJump { name: one.name.clone() });
                }
                // without states there is nothing to go back through
                if system.states().is_empty() {
                    return OverRun::of((&system, &ids), run, &followed, observer)?.gradients();
                }
                backward::gradients((&system, &ids), run, &followed, observer)
            }
        }
    }

    /// The network with these values and the first reports of the study as limits, and the parameters
    /// of the study.
    fn asked_at(
        &self,
        values: &[f64],
        reports: usize,
    ) -> Result<(Network, Vec<ParameterId>), GradientError> {
        // without the reports of the study, which limits replace
        let own = &self.netlist().network;
        let mut parameters = own.given();
        let ids: Vec<ParameterId> = self.cases().parameters().collect();
        ids.iter().zip(values).for_each(|(id, &value)| parameters.set(*id, value));
        let network = own.with(&parameters)?;
        Ok((network.requiring(self.study().reports.iter().take(reports).map(limit)), ids))
    }

    /// The run, whose times depend on none of the parameters.
    fn run_for(
        &self,
        network: &Network,
        ids: &[ParameterId],
    ) -> Result<&RunSettings, GradientError> {
        let run = self.netlist().run.as_ref().ok_or(GradientError::NoRun)?;
        match self.netlist().run_values().any(|value| network.depends_on(value, ids)) {
            true => Err(GradientError::Times),
            false => Ok(run),
        }
    }

    fn followed(
        &self,
        network: &Network,
        (own, margins): (usize, &[LimitId]),
    ) -> Result<Vec<Followed>, GradientError> {
        let further = network.limit_ids().skip(own);
        let report = |(limit, measure): (LimitId, &Measure)| {
            let functional = measure.functional();
            let sign =
                if network.limits()[limit.index()].bound == Bound::Below { -1.0 } else { 1.0 };
            let name = measure.text.clone();
            match functional {
                Functional::TimeOver | Functional::TimeUnder | Functional::Life => {
                    Err(GradientError::Functional { name })
                }
                _ => Ok(Followed { limit, sign, functional, name }),
            }
        };
        let margin = |&limit: &LimitId| {
            let of = &network.limits()[limit.index()];
            let name = format!("margin({})", of.name);
            if !of.is_of_moments() {
                return Err(GradientError::Functional { name });
            }
            // the least margin of a run
            Ok(Followed { limit, sign: 1.0, functional: Functional::Min, name })
        };
        further.zip(&self.study().reports).map(report).chain(margins.iter().map(margin)).collect()
    }

    fn steady_gradients(
        &self,
        system: &ThermalSystem,
        followed: &[Followed],
        ids: &[ParameterId],
    ) -> Result<Gradients, GradientError> {
        let steady = lptn_analysis::steady(system, self.start())?;
        let mut found = Gradients::default();
        for one in followed {
            let slopes = steady.margin_slopes(system, one.limit, ids)?;
            let by = slopes.by.iter().map(|slope| one.sign * slope).collect();
            found.add(one.sign * slopes.margin, by);
        }
        Ok(found)
    }
}

/// A report as a limit: its margin is the quantity, or its negative for a maximum.
fn limit(measure: &Measure) -> Limit {
    let most = measure.functional() == Functional::Max;
    Limit {
        name: measure.name.clone(),
        of: measure.of.clone(),
        ty: measure.over_time.of_ty,
        bound: if most { Bound::Below } else { Bound::Above },
        value: Value::Constant(0.0),
        compares: true,
        over_time: [None, None],
        severity: LimitSeverity::Warning,
        text: measure.text.clone(),
    }
}
