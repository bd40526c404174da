//! Where build errors are.

use crate::error::{BuildError, BuildErrorKind};
use crate::id::{Field, Item};

impl BuildError {
    /// Where the problem is, if it is at one item: the item and its field.
    pub fn place(&self) -> Option<(Item, Field)> {
        use BuildErrorKind as K;
        Some(match self.kind {
            K::DuplicateName { second: item, .. }
            | K::NameInside { item, .. }
            | K::BadName { item }
            | K::ReservedName { item } => (item, Field::Name),
            K::WrongType { item, field, .. }
            | K::NotPositive { item, field, .. }
            | K::Negative { item, field, .. }
            | K::NotFinite { item, field, .. }
            | K::BelowAbsoluteZero { item, field, .. }
            | K::DependsOnTime { item, field }
            | K::DependsOnResult { item, field }
            | K::ComparisonNotLinear { item, field }
            | K::ComparesTemperature { item, field }
            | K::NotAFraction { item, field, .. }
            | K::TooQuick { item, field }
            | K::Evaluation { item, field, .. } => (item, field),
            K::ThresholdsCrossed { control, fields, .. } => (Item::Control(control), fields[0]),
            K::NoThermostat { control } => (Item::Control(control), Field::Name),
            K::Radii { item, .. } => (item, Field::OuterRadius),
            K::Melting { item, .. } => (item, Field::Liquidus),
            K::NotMelting { node, .. } => (Item::Node(node), Field::Initial),
            K::Shares { source, .. } => (Item::Source(source), Field::Into),
            K::WhichTemperature { source } => (Item::Source(source), Field::Power),
            K::CapacityUnknown { node, .. } => (Item::Node(node), Field::Capacity),
            K::FluidUnknown { fluid, field } => (Item::Fluid(fluid), field),
            K::PeriodTooShort { signal, .. } => (Item::Signal(signal), Field::Period),
            K::SignalPoints { signal } => (Item::Signal(signal), Field::Value),
            K::SelfLink { conductor } => (Item::Conductor(conductor), Field::To),
            K::SourceIntoBoundary { source } => (Item::Source(source), Field::Into),
            K::NoCapacity { node } | K::MasslessWithCapacity { node } | K::NoInitialTemperature { node } => {
                (Item::Node(node), Field::Name)
            }
            K::FloatingIsland { ref nodes, .. } => (Item::Node(*nodes.first()?), Field::Name),
            K::ForeignId { item } => (item, Field::Name),
            K::GridCells { grid, .. } | K::GridTooLarge { grid, .. } => (Item::Grid(grid), Field::Cells),
            K::NoProperty { item, .. } => (item, Field::Material),
            K::StreamIntoFace { item } | K::FaceCells { item, .. } | K::FaceSides { item, .. } => {
                (item, Field::To)
            }
            K::FaceArea { item, .. } => (item, Field::Area),
            K::ForeignParameters | K::Empty => return None,
        })
    }
}
