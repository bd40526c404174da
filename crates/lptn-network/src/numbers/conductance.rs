//! Heat flow of each conductor, as far as the parameters determine it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use lptn_laws::Carries;

use crate::along::Along;
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, Field, Item, SourceId};
use crate::law::{At, ConductorFlow, Law};
use crate::numbers::Work;
use crate::parts::element::Conductor;
use crate::parts::overlap::{Joint, Overlap};
use crate::slot;
use crate::value::Value;
use lptn_laws::Range;

impl Work<'_> {
    pub(crate) fn flows(&mut self) -> Vec<ConductorFlow> {
        let conductors = &self.parts.conductors;
        let is_more = |conductor: &Conductor| conductor.law.number().is_none();
        let last = conductors.iter().rposition(is_more);
        let conductors = &conductors[..last.map_or(0, |last| last + 1)];
        let mut flows: Vec<ConductorFlow> = Vec::with_capacity(conductors.len());
        let apart = self.apart();
        for (i, conductor) in conductors.iter().enumerate() {
            let item = Item::Conductor(ConductorId::from_len(i));
            flows.push(match conductor.law.number() {
                Some(conductance) => ConductorFlow::Conductance(conductance),
                None if apart.contains(&i) => ConductorFlow::Conductance(0.0),
                // in a grid thousands are alike
                None if self.parts.is_like_the_last_conductor(i) => flows[i - 1],
                None => self.flow(item, conductor),
            });
        }
        flows
    }

    /// The conductors between cells that parameters moved apart.
    fn apart(&mut self) -> BTreeSet<usize> {
        let (parts, mut apart) = (self.parts, BTreeSet::new());
        for path in &parts.face_paths {
            let (Joint::Moving(cells), Some(faces)) = (&path.joint, parts.joined_blocks(path))
            else {
                continue;
            };
            let along = parts.along(faces, &path.placement, &mut self.scope);
            let touching = Overlap::of(along, &path.placement).map_or(Vec::new(), |all| all.pairs);
            let touches =
                |of: &[[usize; 2]; 2]| touching.binary_search_by_key(of, |pair| pair.cells).is_ok();
            let conductors = path.conductors().zip(cells);
            let idle = conductors.filter(|(_, of)| !touches(of));
            apart.extend(idle.map(|(id, _)| id.index()));
        }
        apart
    }

    fn flow(&mut self, item: Item, conductor: &Conductor) -> ConductorFlow {
        let law = &conductor.law;
        let errors_before = self.errors.len();
        let declared = law.formula().declaration();
        for ((field, value), declared) in law.parts().zip(declared.fields) {
            if self.parts.reads(value).is_constant() {
                self.constant(item, field, value, declared.range);
            }
        }
        self.check_order(item, law);
        if self.errors.len() > errors_before || self.parts.is_variable(conductor) {
            return ConductorFlow::Variable;
        }
        let (slots, stack) = self.scope.plain();
        let number = At::new((slots, stack)).value(law).unwrap_or(f64::NAN);
        if law.is_stream() {
            let rate = self.capacity_rate(law, number);
            return ConductorFlow::Stream(self.in_range(
                item,
                Field::law(law.formula(), 0),
                rate,
                Range::Finite,
            ));
        }
        // 1/R and h A can still leave the range of numbers
        let last = Field::law(law.formula(), declared.fields.len() - 1);
        let number = self.in_range(item, last, number, Range::Positive);
        match declared.carries {
            Carries::Radiation => ConductorFlow::Radiation(number),
            _ => ConductorFlow::Conductance(number),
        }
    }

    /// The properties of which conductors take the mean along their paths. Those that read no
    /// parameter are shared by all candidates.
    pub(crate) fn alongs(&mut self) -> Vec<Option<Arc<Along>>> {
        let parts = self.parts;
        let mut known: BTreeMap<usize, Arc<Along>> = BTreeMap::new();
        let mut alongs = parts.along.clone();
        for (own, conductor) in alongs.iter_mut().zip(&parts.conductors) {
            let Some(value) = conductor.law.along().filter(|value| parts.is_along(value)) else {
                continue;
            };
            if own.is_none() {
                let slots = self.scope.plain().0;
                let new = || Arc::new(Along::fixed(value, slots));
                *own = Some(Arc::clone(known.entry(value.address()).or_insert_with(new)));
            }
        }
        alongs
    }

    /// The conductances of bodies for a mean conductivity of 1, if nothing else changes.
    pub(crate) fn shapes(&mut self, alongs: &[Option<Arc<Along>>]) -> Vec<f64> {
        let parts = self.parts;
        let mut shapes: Vec<f64> = Vec::with_capacity(alongs.len());
        for (i, (along, conductor)) in alongs.iter().zip(&parts.conductors).enumerate() {
            let shape = match along {
                Some(_) if i > 0 && parts.is_like_the_last_conductor(i) => shapes[i - 1],
                Some(along) if along.is_fixed() => self.shape(&conductor.law),
                _ => f64::NAN,
            };
            shapes.push(shape);
        }
        shapes
    }

    /// The laws that take a mean are proportional to it.
    fn shape(&mut self, law: &Law) -> f64 {
        let fields = law.formula().declaration().fields;
        let mut values = Vec::with_capacity(fields.len());
        for (value, field) in law.values().iter().zip(fields) {
            values.push(match field.along {
                true => 1.0,
                false if self.parts.reads(value).is_constant() => {
                    value.at(&mut self.scope).unwrap_or(f64::NAN)
                }
                false => f64::NAN,
            });
        }
        law.formula().value(&values, [f64::NAN; 2])
    }

    /// Checks the lengths of sources that have an order.
    pub(crate) fn check_sources(&mut self) {
        let parts = self.parts;
        for (i, source) in parts.sources.iter().enumerate() {
            self.check_order(Item::Source(SourceId::from_len(i)), &source.law);
        }
    }

    /// A constant capacity rate in W/K, from the flow of a stream.
    fn capacity_rate(&mut self, law: &Law, flow: f64) -> f64 {
        let parts = self.parts;
        let Some(fluid) = law.fluid().map(|id| &parts.fluids[id.index()]) else { return flow };
        let mut at = |value: &Value| value.at(&mut self.scope).unwrap_or(f64::NAN);
        let density = match law.carries() {
            Carries::VolumeFlow(measured) => {
                let temperature = law.value(measured).map_or(f64::NAN, &mut at);
                self.scope.set(slot::OWN, temperature);
                fluid
                    .density
                    .as_ref()
                    .map_or(f64::NAN, |d| d.at(&mut self.scope).unwrap_or(f64::NAN))
            }
            _ => 1.0,
        };
        flow * density * fluid.cp.at(&mut self.scope).unwrap_or(f64::NAN)
    }

    /// Checks pairs of values of which one has to be smaller, if both are constant.
    pub(crate) fn check_order(&mut self, item: Item, law: &Law) {
        for keys in law.formula().declaration().ordered {
            let [inner, outer] = keys.map(|key| {
                let value = law.value(key).filter(|value| self.parts.reads(value).is_constant())?;
                value.at(&mut self.scope).ok()
            });
            let fields = keys.map(Field::of_law);
            if let ([Some(inner), Some(outer)], [Some(a), Some(b)]) = ([inner, outer], fields)
                && inner >= outer
            {
                self.error(item, BuildErrorKind::Radii { item, fields: [a, b], inner, outer });
            }
        }
    }
}
