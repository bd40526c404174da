//! The adjoint of a network along a run, as a system of differential equations in `-t`.

use lptn_integrate::{OdeSystem, Pattern, Retry};
use lptn_network::NodeId;

use super::error::BackwardError;
use super::moment::Moment;
use crate::margin::{Margin, Point};
use crate::trajectory::Stretch;

/// The adjoint: `x_i` is the change of the result with a heat into node `i`, in its unit per J,
/// times a scale. Going back, `C_i(T) dx_i/d(-t) = sum over j of J_ji x_j + w_i`, with the weight
/// `w_i` of a temperature in an integrated result, and massless nodes obey the same with `C = 0`.
///
/// The running integrals are the derivatives by the parameters: of the heats at fixed temperatures,
/// `x dq/dp`, less those of the heat contents at fixed temperatures, `dx/d(-t) dH/dp`.
pub(super) struct Adjoint<'a> {
    pub(super) moment: Moment<'a>,
    stretch: &'a Stretch,
    /// The margin that is integrated and the nodes that it reads; `None` for a result of one moment.
    integrated: Option<(Margin<'a>, Vec<NodeId>)>,
    /// Mean of the absolute value of an integrated margin.
    pub(super) typical: f64,
    pub(super) scale: f64,
    parameters: usize,
    /// True for constant coefficients and weights, without running integrals.
    pub(super) constant: bool,
    /// True if the Jacobian was taken in this stretch.
    linearised: bool,
    /// The time in s of the run at which the moment is.
    now: f64,
    state: Vec<f64>,
    /// Weights of the temperatures of all nodes times the scale, and as weights of the unknowns.
    weights: Vec<f64>,
    handed: Vec<f64>,
    /// The adjoint of all unknowns.
    unknowns: Vec<f64>,
    rows: Vec<f64>,
    pub(super) failure: Option<BackwardError>,
}

impl<'a> Adjoint<'a> {
    pub(super) fn new(
        moment: Moment<'a>,
        stretch: &'a Stretch,
        (integrated, parameters): (Option<Margin<'a>>, usize),
    ) -> Self {
        let system = moment.system;
        let (states, all) = (system.states().len(), system.unknowns().len());
        let steady = integrated.is_none_or(|margin| margin.is_plain());
        let constant = steady && moment.is_constant();
        let mut adjoint = Self {
            moment,
            stretch,
            integrated: integrated.map(|margin| (margin, margin.nodes())),
            typical: 0.0,
            scale: 1.0,
            parameters,
            constant,
            linearised: false,
            now: f64::NAN,
            state: vec![0.0; states],
            weights: vec![0.0; system.network().nodes().len()],
            handed: vec![0.0; all],
            unknowns: vec![0.0; all],
            rows: vec![0.0; states],
            failure: None,
        };
        adjoint.enter(stretch);
        adjoint
    }

    /// Goes on in a stretch of the run.
    pub(super) fn enter(&mut self, stretch: &'a Stretch) {
        self.stretch = stretch;
        self.moment.set_positions(stretch.positions.as_ref());
        (self.now, self.linearised) = (f64::NAN, false);
    }

    /// The margin is read again, at another scale.
    pub(super) fn rescale(&mut self, scale: f64) {
        (self.scale, self.now) = (scale, f64::NAN);
    }

    /// Goes to a time in s of the run.
    pub(super) fn go(&mut self, time: f64) -> Result<(), BackwardError> {
        if (self.now - time).abs() <= 0.0 {
            return Ok(());
        }
        self.stretch.at(time, &mut self.state);
        self.moment.stand(self.stretch.branch(time));
        self.moment.go((time, self.stretch.inside), &self.state)?;
        if !(self.constant && self.linearised) {
            self.moment.linearise()?;
            self.linearised = true;
        }
        if let Some((margin, nodes)) = &self.integrated {
            let point = self.point(time);
            self.weights = margin.by_nodes(&point, (nodes, self.typical))?;
            self.weights.iter_mut().for_each(|weight| *weight *= self.scale);
            self.handed = self.moment.handed(&self.weights);
        }
        self.now = time;
        Ok(())
    }

    /// The largest rate of the adjoint while it is zero, in 1/(J s) times the unit of the result.
    pub(super) fn rate(&mut self, time: f64) -> Result<f64, BackwardError> {
        self.balance(time, &vec![0.0; self.rows.len()])?;
        let capacities = self.moment.system.capacity().iter();
        let rates = self.rows.iter().zip(capacities).map(|(row, capacity)| row / capacity);
        Ok(rates.fold(0.0, |most, rate| most.max(rate.abs())))
    }

    /// The run at the moment.
    fn point(&self, time: f64) -> Point {
        Point {
            at: (time, self.stretch.inside),
            positions: self.stretch.positions.clone(),
            nodes: self.moment.nodes().to_vec(),
            weight: 1.0,
        }
    }

    /// `C_i dx_i/d(-t)` of the states.
    fn balance(&mut self, time: f64, x: &[f64]) -> Result<(), BackwardError> {
        self.go(time)?;
        self.unknowns[..x.len()].copy_from_slice(x);
        self.moment.balance(&self.handed, &mut self.unknowns, &mut self.rows)?;
        let slopes = self.moment.unfolded().iter();
        self.rows.iter_mut().zip(slopes).for_each(|(row, slope)| *row *= slope);
        Ok(())
    }

    /// Writes the rates of the derivatives by the parameters.
    pub(super) fn integrands(
        &mut self,
        time: f64,
        x: &[f64],
        q: &mut [f64],
    ) -> Result<(), BackwardError> {
        q.fill(0.0);
        if self.constant && !self.moment.changes_contents() {
            self.go(time)?;
            self.unknowns.copy_from_slice(x);
            return self.moment.add_driven((&self.weights, &self.unknowns), &[], q);
        }
        self.balance(time, x)?;
        let capacities = self.moment.system.capacity().iter();
        let held: Vec<f64> = self.rows.iter().zip(capacities).map(|(row, c)| -row / c).collect();
        self.moment.add_driven((&self.weights, &self.unknowns), &held, q)
    }

    fn done<T>(&mut self, result: Result<T, BackwardError>) -> Result<T, Retry> {
        result.map_err(|error| {
            self.failure = Some(error);
            Retry::Stop
        })
    }
}

impl OdeSystem for Adjoint<'_> {
    fn size(&self) -> usize {
        self.state.len()
    }

    fn mass(&self) -> &[f64] {
        self.moment.system.mass()
    }

    fn flow(&mut self, t: f64, x: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        let balanced = self.balance(-t, x);
        self.done(balanced)?;
        f.copy_from_slice(&self.rows);
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        self.moment.turned.pattern()
    }

    fn symmetric(&self) -> bool {
        self.constant && self.moment.system.is_symmetric()
    }

    fn jacobian_is_constant(&self) -> bool {
        self.constant
    }

    fn jacobian(&mut self, t: f64, _: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        let gone = self.go(-t);
        self.done(gone)?;
        values.copy_from_slice(self.moment.turned.values());
        let (pattern, slopes) = (self.moment.turned.pattern(), self.moment.unfolded());
        for (value, row) in values.iter_mut().zip(pattern.row_indices()) {
            *value *= slopes.get(*row).copied().unwrap_or(1.0);
        }
        Ok(())
    }

    fn quadrature_count(&self) -> usize {
        if self.constant { 0 } else { self.parameters }
    }

    fn quadrature(&mut self, t: f64, x: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        let taken = self.integrands(-t, x, q);
        self.done(taken)
    }
}
