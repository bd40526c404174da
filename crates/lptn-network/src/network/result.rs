//! Limits and reports, once temperatures and heat flows are known.

use std::sync::Arc;

use lptn_units::{Degree, Program, Type};

use crate::evaluation::Evaluation;
use crate::id::{ConductorId, End, Field, Item, LimitId, NodeId, ReportId};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::parts::functional::{Functional, History, OverTime};
use crate::parts::heat::HeatOf;
use crate::parts::layout::Holds;
use crate::parts::result::{Bound, Report};
use crate::scope::{Context, NetworkScope};
use crate::value::Value;

impl Network {
    /// Distance of a limit from being broken at the state of `scope`: positive while it is kept, in
    /// SI units of `of`, a difference in K for temperatures. `scope` needs the temperatures of the
    /// time in question, see [`Evaluation::set_temperatures`].
    ///
    /// # Errors
    /// [`InputError`] if an expression fails or gives no number.
    pub fn limit_margin(&self, id: LimitId, scope: &mut Evaluation) -> Result<f64, InputError> {
        let [low, high] = self.limit_sides(id, scope)?;
        Ok(high - low)
    }

    /// The two sides of a limit at the state of `scope`, in SI units: the one that has to be below,
    /// and the one that has to be above it.
    ///
    /// # Errors
    /// As [`Network::limit_margin`].
    pub fn limit_sides(&self, id: LimitId, scope: &mut Evaluation) -> Result<[f64; 2], InputError> {
        let sides = [self.limit_side((id, 0), scope)?, self.limit_side((id, 1), scope)?];
        Ok(self.ordered(id, sides))
    }

    /// One of the sides of a limit (0: `of`, 1: its bound) at the state of `scope`, in SI units.
    ///
    /// # Errors
    /// As [`Network::limit_margin`].
    pub fn limit_side(
        &self,
        (id, side): (LimitId, usize),
        scope: &mut Evaluation,
    ) -> Result<f64, InputError> {
        let limit = &self.limits()[id.index()];
        let field = [Field::Of, limit.bound.field()][side];
        self.number(Item::Limit(id), field, limit.sides()[side], scope)
    }

    /// The numbers over time that a limit compares, as [`Network::limit_sides`], from the time
    /// histories of its sides.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn limit_over_time(
        &self,
        id: LimitId,
        seen: &[History; 2],
        scope: &mut Evaluation,
    ) -> Result<[f64; 2], InputError> {
        let mut number = |side: usize| {
            let over_time = self.limits()[id.index()].over_time[side].as_ref();
            self.over_time((Item::Limit(id), Field::Of, over_time), &seen[side], scope)
        };
        Ok(self.ordered(id, [number(0)?, number(1)?]))
    }

    /// The number over time of a report in SI units, from the time history of its quantity.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn report_over_time(
        &self,
        id: ReportId,
        seen: &History,
        scope: &mut Evaluation,
    ) -> Result<f64, InputError> {
        let over_time = self.reports()[id.index()].over_time.as_ref();
        let number = self.over_time((Item::Report(id), Field::Value, over_time), seen, scope)?;
        Ok(number + 0.0) // no `-0` in results
    }

    /// A functional of a time history; without one its last value.
    fn over_time(
        &self,
        (item, field, over_time): (Item, Field, Option<&OverTime>),
        seen: &History,
        scope: &mut Evaluation,
    ) -> Result<f64, InputError> {
        let life = over_time.and_then(|over_time| over_time.life.as_ref());
        let life = life.map(|life| self.number(item, field, life, scope)).transpose()?;
        let functional = over_time.map_or(Functional::Value, |over_time| over_time.functional);
        Ok(functional.of(seen, life))
    }

    /// The side that has to be below, and the one that has to be above it.
    pub(super) fn ordered<T>(&self, id: LimitId, [of, value]: [T; 2]) -> [T; 2] {
        match self.limits()[id.index()].bound {
            Bound::Below => [of, value],
            Bound::Above => [value, of],
        }
    }

    /// The type of one of the sides of a limit at one moment.
    pub fn limit_side_type(&self, (id, side): (LimitId, usize)) -> Type {
        let limit = &self.limits()[id.index()];
        limit.over_time[side].as_ref().map_or(limit.ty, |over_time| over_time.of_ty)
    }

    pub(crate) fn number(
        &self,
        item: Item,
        field: Field,
        value: &Value,
        at: &mut Evaluation,
    ) -> Result<f64, InputError> {
        let problem = match value.at(at) {
            Ok(x) if x.is_finite() => return Ok(x),
            Ok(x) => InputProblem::NotFinite(x),
            Err(error) => error.into(),
        };
        let problem = self.missing(value, at).unwrap_or(problem);
        Err(self.failed(item, (field, problem), at))
    }

    /// The result of a law that a value reads and that does not exist at the state of `at`.
    fn missing(&self, value: &Value, at: &Evaluation) -> Option<InputProblem> {
        value.slots().into_iter().find_map(|slot| match self.parts.layout.holds(slot) {
            Holds::Heat(heat) if at.slot(slot).is_nan() => {
                let why = self.parts.told(heat)?.missing;
                Some(InputProblem::NoResult { name: self.parts.heat_name(heat), why })
            }
            _ => None,
        })
    }

    /// The names that expressions of results may use: parameters, `t`, and `NAME.T` of every node
    /// and boundary. Evaluate programs compiled with it in [`Network::evaluation`] after
    /// [`Evaluation::set_temperatures`].
    pub fn post_scope(&self) -> NetworkScope<'_> {
        NetworkScope::new(&self.parts, Context::Result)
    }
}

impl Network {
    /// The reports that are numbers over time and not columns.
    pub fn reports_over_time(&self) -> impl Iterator<Item = ReportId> + '_ {
        self.report_ids().filter(|id| self.reports()[id.index()].over_time.is_some())
    }

    /// The same network with further reports, known to the caller only, and their ids. Their values
    /// were compiled for this network, whose own numbers over time are not followed.
    pub fn reporting(&self, further: Vec<Report>) -> (Self, Vec<ReportId>) {
        let mut parts = (*self.parts).clone();
        parts.reports.iter_mut().for_each(|report| report.over_time = None);
        let first = parts.reports.len();
        parts.reports.extend(further);
        let ids = (first..parts.reports.len()).map(ReportId::from_len).collect();
        (Self { parts: Arc::new(parts), numbers: Arc::clone(&self.numbers) }, ids)
    }

    /// The value of a report in SI units at the state of `scope`, which needs temperatures and heat
    /// flows: see [`Evaluation::set_temperatures`] and [`Evaluation::set_heats`].
    ///
    /// # Errors
    /// [`InputError`] if the expression fails or gives no number.
    pub fn report_value(&self, id: ReportId, scope: &mut Evaluation) -> Result<f64, InputError> {
        let value =
            self.number(Item::Report(id), Field::Value, &self.reports()[id.index()].value, scope)?;
        Ok(value + 0.0) // no `-0` in columns
    }

    /// The nodes whose temperatures determine a value, if nothing else does: no parameter, time, heat
    /// flow or boundary.
    pub fn nodes_alone(&self, value: &Value) -> Option<Vec<NodeId>> {
        let node = |slot| match self.parts.layout.holds(slot) {
            Holds::Temperature(End::Node(id)) => Some(id),
            _ => None,
        };
        let conditional = |p: &Arc<Program>| !p.comparisons().is_empty();
        let plain = !value.programs().into_iter().any(conditional);
        value.slots().into_iter().map(node).collect::<Option<_>>().filter(|_| plain)
    }

    /// The heat flows that expressions of results name, in the order in which
    /// [`Evaluation::set_heats`] takes them.
    pub fn named_heats(&self) -> impl ExactSizeIterator<Item = HeatOf> + '_ {
        self.parts.layout.heats().iter().map(|(heat, _)| *heat)
    }

    /// The heat flows of a path: two for a stream.
    pub fn heats_of(&self, id: ConductorId) -> Vec<HeatOf> {
        self.parts.heats_of(id)
    }
}

impl Network {
    /// True if a result reads a temperature or heat flow, and not only numbers known in advance.
    pub fn reads_results(&self, result: &Value) -> bool {
        let is_result = |slot: &u32| {
            let holds = self.parts.layout.holds(*slot);
            matches!(holds, Holds::Temperature(_) | Holds::Grid(_) | Holds::Heat(_))
        };
        result.slots().iter().any(is_result)
    }

    /// The nodes whose temperatures results read, ascending: also those of grids, and those at the
    /// ends of a path whose heat flow they read.
    pub fn nodes_read_by(&self, results: &[&Value]) -> Vec<NodeId> {
        let node = |end: End| if let End::Node(id) = end { Some(id) } else { None };
        let of_slot = |slot: u32| -> Vec<NodeId> {
            match self.parts.layout.holds(slot) {
                Holds::Temperature(end) => node(end).into_iter().collect(),
                Holds::Grid(value) => {
                    self.grid_value_members(value).into_iter().map(NodeId).collect()
                }
                Holds::Heat(of) => match of.item() {
                    Item::Conductor(id) => {
                        let conductor = &self.parts.conductors[id.index()];
                        [conductor.from, conductor.to].into_iter().filter_map(node).collect()
                    }
                    _ => Vec::new(),
                },
                _ => Vec::new(),
            }
        };
        let slots = results.iter().flat_map(|result| result.slots());
        let mut nodes: Vec<NodeId> = slots.flat_map(of_slot).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// True if a result reads temperatures of nodes, and means of grids, and nothing else, each in
    /// the first degree at most. This follows from its code and not from its numbers: a parameter
    /// that happens to be 0 is read all the same.
    pub fn reads_node_temperatures_only(&self, result: &Value) -> bool {
        let is_node = |slot: &u32| {
            matches!(
                self.parts.layout.holds(*slot),
                Holds::Temperature(End::Node(_)) | Holds::Grid(_)
            )
        };
        let affine = |slot: &u32| {
            result.programs().iter().all(|program| program.degree_in(*slot) <= Degree::Affine)
        };
        result.slots().iter().all(|slot| is_node(slot) && affine(slot))
    }
}

impl HeatOf {
    /// The name of its column, `internal.Q`.
    pub fn name(self, network: &Network) -> String {
        network.parts.heat_name(self)
    }

    /// Its type: power, except for results that a law declares.
    pub fn ty(self, network: &Network) -> Type {
        network.parts.heat_type(self)
    }
}
