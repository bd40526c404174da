//! What results are made of: heat flows by name, and reports, which are expressions over them.

use lptn_units::{Expression, Program, Type, UnitError};

use crate::builder::NetworkBuilder;
use crate::evaluation::Evaluation;
use crate::id::{BoundaryId, ConductorId, Field, Item, JointId, ReportId, SourceId};
use crate::input_error::InputError;
use crate::network::Network;
use crate::parts::Parts;
use crate::scope::Context;
use crate::value::{Input, Value};

/// A heat flow of the results, in W.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HeatOf {
    /// `NAME.Q` of a path that is no stream: positive from `from` to `to`.
    Conductor(ConductorId),
    /// `NAME.Q_from` of a stream: what its first end receives.
    ReceivedFrom(ConductorId),
    /// `NAME.Q_to` of a stream: what its second end receives.
    ReceivedTo(ConductorId),
    /// `NAME.P` of a source: positive into its nodes.
    Source(SourceId),
    /// `NAME.Q` of a boundary: what it gives to the network.
    Boundary(BoundaryId),
    /// `NAME.Q` of a path that ends at a face of a grid: the sum over its conductors.
    Joint(JointId),
}

/// A named quantity that follows from the results: a column of its own.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its name.
    pub name: String,
    /// An expression over parameters, `t`, signals, tables, temperatures and heat flows of the results.
    pub value: Value,
    /// Its type.
    pub ty: Type,
    /// The expression as it was written.
    pub text: String,
}

impl HeatOf {
    /// The name of its column, `internal.Q`.
    pub fn name(self, network: &Network) -> String {
        self.name_in(&network.parts)
    }

    /// What it is the heat of.
    pub fn item(self) -> Item {
        match self {
            Self::Conductor(id) | Self::ReceivedFrom(id) | Self::ReceivedTo(id) => Item::Conductor(id),
            Self::Source(id) => Item::Source(id),
            Self::Boundary(id) => Item::Boundary(id),
            Self::Joint(id) => Item::Joint(id),
        }
    }

    fn name_in(self, parts: &Parts) -> String {
        let ending = match self {
            Self::Conductor(_) | Self::Boundary(_) | Self::Joint(_) => "Q",
            Self::ReceivedFrom(_) => "Q_from",
            Self::ReceivedTo(_) => "Q_to",
            Self::Source(_) => "P",
        };
        format!("{}.{ending}", parts.name_of(self.item()))
    }
}

impl Parts {
    /// The heat flow of this name, if there is one.
    pub(crate) fn heat(&self, name: &str) -> Option<HeatOf> {
        let (base, ending) = name.rsplit_once('.')?;
        let stream = |id: &ConductorId| self.conductors[id.index()].law.is_stream();
        match (self.item(base)?, ending) {
            (Item::Conductor(id), "Q") if !stream(&id) => Some(HeatOf::Conductor(id)),
            (Item::Conductor(id), "Q_from") if stream(&id) => Some(HeatOf::ReceivedFrom(id)),
            (Item::Conductor(id), "Q_to") if stream(&id) => Some(HeatOf::ReceivedTo(id)),
            (Item::Source(id), "P") => Some(HeatOf::Source(id)),
            (Item::Boundary(id), "Q") => Some(HeatOf::Boundary(id)),
            (Item::Joint(id), "Q") => Some(HeatOf::Joint(id)),
            _ => None,
        }
    }

    fn heats_of(&self, id: ConductorId) -> Vec<HeatOf> {
        match self.conductors[id.index()].law.is_stream() {
            true => vec![HeatOf::ReceivedFrom(id), HeatOf::ReceivedTo(id)],
            false => vec![HeatOf::Conductor(id)],
        }
    }

    /// The names of all heat flows: paths, sources, boundaries.
    pub(crate) fn heat_names(&self) -> impl Iterator<Item = String> + '_ {
        let conductors = (0..self.conductors.len()).flat_map(|i| self.heats_of(ConductorId::from_len(i)));
        let sources = (0..self.sources.len()).map(|i| HeatOf::Source(SourceId::from_len(i)));
        let boundaries = (0..self.boundaries.len()).map(|i| HeatOf::Boundary(BoundaryId::from_len(i)));
        let joints = self.shared_joints().map(HeatOf::Joint);
        conductors.chain(sources).chain(boundaries).chain(joints).map(|heat| heat.name_in(self))
    }
}

impl NetworkBuilder {
    /// Gives a place to every heat flow (`NAME.Q`, `NAME.Q_from`, `NAME.Q_to`, `NAME.P`) and every temperature of a grid
    /// (`NAME.mean`, `NAME.x1.T`) that an expression names, so that it can be compiled for [`Context::Result`].
    pub fn name_heats(&mut self, expression: &Expression) {
        for (name, _) in expression.names() {
            if let Some(heat) = self.parts.heat(&name) {
                std::sync::Arc::make_mut(&mut self.parts.layout).add_heat(heat);
            }
            self.name_grid_value(&name);
        }
    }

    /// Compiles an expression over parameters, `t`, signals, tables, and the temperatures and heat flows of what was
    /// added so far; see [`NetworkBuilder::post_scope`].
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn post_expression(&mut self, text: &str, expected: Option<Type>) -> Result<Program, Vec<UnitError>> {
        let expression = Expression::parse(text).map_err(|e| vec![e])?;
        self.name_heats(&expression);
        expression.compile(&self.scope(Context::Result), expected)
    }

    /// Adds a report: `value`, written as `text`, becomes a column of the results. Its name is one of those that
    /// parameters, signals and tables share.
    pub fn report(&mut self, name: &str, value: Input, text: &str) -> ReportId {
        let id = ReportId::from_len(self.parts.reports.len());
        let Input { value, ty, .. } = value;
        self.parts.reports.push(Report { name: name.to_owned(), value, ty, text: text.to_owned() });
        self.register_value(name, Item::Report(id));
        id
    }
}

impl Network {
    /// The reports.
    pub fn reports(&self) -> &[Report] {
        &self.parts.reports
    }

    /// Ids of all reports.
    pub fn report_ids(&self) -> impl ExactSizeIterator<Item = ReportId> + use<> {
        (0..self.parts.reports.len()).map(ReportId::from_len)
    }

    /// The value of a report in SI units where `scope` stands, which needs temperatures and heat flows: see
    /// [`Evaluation::set_temperatures`] and [`Evaluation::set_heats`].
    ///
    /// # Errors
    /// [`InputError`] if the expression fails or gives no number.
    pub fn report_value(&self, id: ReportId, scope: &mut Evaluation) -> Result<f64, InputError> {
        let value = self.number(Item::Report(id), Field::Value, &self.reports()[id.index()].value, scope)?;
        Ok(value + 0.0) // no `-0` in columns
    }

    /// The heat flows that expressions of results name, in the order in which [`Evaluation::set_heats`] takes them.
    pub fn named_heats(&self) -> impl ExactSizeIterator<Item = HeatOf> + '_ {
        self.parts.layout.heats().iter().map(|(heat, _)| *heat)
    }

    /// The heat flows of a path: two for a stream.
    pub fn heats_of(&self, id: ConductorId) -> Vec<HeatOf> {
        self.parts.heats_of(id)
    }
}
