//! Heat flows and values of grids by their names.
//!
//! A result that a law computes in addition to its heat is `HeatOf::Told`. It is read where heat
//! flows are read, so that limits, columns, windows and reports need no second way.

use std::sync::Arc;

use lptn_laws::ResultDeclaration;
use lptn_units::{Dimension, Type};

use crate::id::{BoundaryId, ConductorId, GridId, Item, SourceId};
use crate::parts::Parts;
use crate::parts::grid::GridFace;
use crate::parts::grid_value::GridValue;
use crate::parts::heat::HeatOf;

impl Parts {
    /// The name of the column of a heat flow: `internal.Q`.
    pub(crate) fn heat_name(&self, heat: HeatOf) -> String {
        heat.named(&self.name_of(heat.item()))
    }

    /// The name of the column of a value of a grid: `wall.mean`.
    pub(crate) fn grid_value_name(&self, value: GridValue) -> String {
        value.named(&self.grids[value.grid().index()])
    }

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
            (Item::FacePath(id), "Q") => Some(HeatOf::FacePath(id)),
            (item, key) => {
                let told = self.declared(item).iter().find(|result| result.key == key)?;
                Some(HeatOf::Told(item, told.key))
            }
        }
    }

    /// The declared results of the law of a path or source in addition to its heat.
    fn declared(&self, item: Item) -> &'static [ResultDeclaration] {
        let law = match item {
            Item::Conductor(id) => &self.conductors[id.index()].law,
            Item::Source(id) => &self.sources[id.index()].law,
            _ => return &[],
        };
        law.formula().result_declarations()
    }

    /// The results of the law of a path or source, in the order of its declaration.
    pub(crate) fn told_of(&self, item: Item) -> impl Iterator<Item = HeatOf> {
        self.declared(item).iter().map(move |result| HeatOf::Told(item, result.key))
    }

    /// The type of a quantity: power, except for declared results of laws.
    pub(crate) fn heat_type(&self, heat: HeatOf) -> Type {
        self.told(heat).map_or(Type::of(Dimension::POWER), |result| result.ty)
    }

    /// The declaration of a result of a law.
    pub(crate) fn told(&self, heat: HeatOf) -> Option<&'static ResultDeclaration> {
        let HeatOf::Told(item, key) = heat else { return None };
        self.declared(item).iter().find(|result| result.key == key)
    }

    pub(crate) fn heats_of(&self, id: ConductorId) -> Vec<HeatOf> {
        match self.conductors[id.index()].law.is_stream() {
            true => vec![HeatOf::ReceivedFrom(id), HeatOf::ReceivedTo(id)],
            false => vec![HeatOf::Conductor(id)],
        }
    }

    /// The names of all heat flows: paths, sources, boundaries.
    pub(crate) fn heat_names(&self) -> impl Iterator<Item = String> + '_ {
        let conductors = (0..self.conductors.len()).flat_map(|i| {
            let id = ConductorId::from_len(i);
            self.heats_of(id).into_iter().chain(self.told_of(Item::Conductor(id)))
        });
        let sources = (0..self.sources.len()).flat_map(|i| {
            let id = SourceId::from_len(i);
            [HeatOf::Source(id)].into_iter().chain(self.told_of(Item::Source(id)))
        });
        let boundaries =
            (0..self.boundaries.len()).map(|i| HeatOf::Boundary(BoundaryId::from_len(i)));
        let joints = self.shared_face_paths().map(HeatOf::FacePath);
        conductors.chain(sources).chain(boundaries).chain(joints).map(|heat| self.heat_name(heat))
    }

    /// The value of this name, if there is one.
    pub(crate) fn grid_value(&self, name: &str) -> Option<GridValue> {
        let (base, ending) = name.rsplit_once('.')?;
        let grid = |name: &str| match self.item(name) {
            Some(Item::Grid(id)) => Some(id),
            _ => None,
        };
        Some(match ending {
            "mean" => GridValue::Mean(grid(base)?),
            "min" => GridValue::Min(grid(base)?),
            "max" => GridValue::Max(grid(base)?),
            "T" => {
                let (base, place) = base.rsplit_once('.')?;
                let (id, grid) = (grid(base)?, &self.grids[grid(base)?.index()]);
                match grid.form().face_named(place) {
                    Some(face) => GridValue::Face(GridFace { grid: id, face }),
                    None => GridValue::Patch(grid.patch_named(id, place)?),
                }
            }
            _ => return None,
        })
    }

    pub(crate) fn grid_value_members(&self, value: GridValue) -> Vec<u32> {
        self.grids[value.grid().index()].members(value)
    }

    /// The values of all grids: mean, minimum, maximum, faces and patches.
    pub(crate) fn grid_values(&self) -> impl Iterator<Item = GridValue> + '_ {
        (0..self.grids.len()).map(GridId::from_len).flat_map(|id| {
            let faces = self.grids[id.index()].form().faces();
            let faces = faces.map(move |face| GridValue::Face(GridFace { grid: id, face }));
            let patches = self.grids[id.index()].patch_ids(id).map(GridValue::Patch);
            let whole = [GridValue::Mean(id), GridValue::Min(id), GridValue::Max(id)];
            whole.into_iter().chain(faces).chain(patches)
        })
    }

    pub(crate) fn grid_value_names(&self) -> impl Iterator<Item = String> + '_ {
        self.grid_values().map(|value| self.grid_value_name(value))
    }

    /// Sets the nodes that belong to each grid value named by expressions of results.
    pub(crate) fn settle_grid_values(&mut self) {
        let values: Vec<GridValue> =
            self.layout.grid_values().iter().map(|(value, _)| *value).collect();
        let members = values.into_iter().map(|value| {
            (self.grid_value_members(value), self.grids[value.grid().index()].weights(value))
        });
        let members = members.collect();
        Arc::make_mut(&mut self.layout).set_members(members);
    }
}
