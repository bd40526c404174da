//! How each conductor carries heat, as far as the parameters determine it.

use crate::element::Conductor;
use crate::error::BuildErrorKind;
use crate::flow::Flow;
use crate::id::{ConductorId, Field, Item};
use crate::law::{At, Law, Stream};
use crate::layout::slot;
use crate::numbers::{Range, Work, range_of_field};
use crate::value::Value;

impl Work<'_> {
    pub(crate) fn flows(&mut self) -> Vec<Flow> {
        let conductors = &self.parts.conductors;
        let mut flows: Vec<Flow> = Vec::with_capacity(conductors.len());
        for (i, conductor) in conductors.iter().enumerate() {
            let item = Item::Conductor(ConductorId::from_len(i));
            // in a grid thousands are alike
            let same = self.parts.is_like_the_last_conductor(i);
            flows.push(if same { flows[i - 1] } else { self.flow(item, conductor) });
        }
        flows
    }

    fn flow(&mut self, item: Item, conductor: &Conductor) -> Flow {
        let law = &conductor.law;
        if let Some(conductance) = law.number() {
            return Flow::Conductance(conductance);
        }
        let errors_before = self.errors.len();
        for (field, value) in law.parts() {
            if self.parts.reads(value).is_constant() {
                self.constant(item, field, value, range_of_field(field));
            }
        }
        self.check_shape(item, law);
        if self.errors.len() > errors_before || self.parts.is_variable(conductor) {
            return Flow::Variable;
        }
        let (slots, stack) = self.scope.plain();
        let mut at = At { slots, stack };
        let (flow, number) = match law {
            Law::Advection(stream) => {
                let rate = self.capacity_rate(stream);
                return Flow::Stream(self.in_range(item, stream.parts()[0].0, rate, Range::Finite));
            }
            Law::Radiation(exchange) => {
                let gr = at.exchange_area(exchange).unwrap_or(f64::NAN);
                (Flow::Radiation(gr), gr)
            }
            _ => {
                let conductance = at.conductance(law).unwrap_or(f64::NAN);
                (Flow::Conductance(conductance), conductance)
            }
        };
        // 1/R and h A can still leave the range of numbers
        let field = law.parts().last().map_or(Field::Conductance, |(field, _)| *field);
        self.in_range(item, field, number, Range::Positive);
        flow
    }

    /// A constant capacity rate in W/K.
    fn capacity_rate(&mut self, stream: &Stream) -> f64 {
        let parts = self.parts;
        let mut at = |value: &Value| value.at(&mut self.scope).unwrap_or(f64::NAN);
        let flow = at(stream.parts()[0].1);
        let Some(fluid) = stream.fluid().map(|id| &parts.fluids[id.index()]) else { return flow };
        let density = match stream {
            Stream::Volume { at: measured, .. } => {
                let temperature = at(measured);
                self.scope.set(slot::OWN, temperature);
                fluid.density.as_ref().map_or(f64::NAN, |d| d.at(&mut self.scope).unwrap_or(f64::NAN))
            }
            _ => 1.0,
        };
        flow * density * fluid.cp.at(&mut self.scope).unwrap_or(f64::NAN)
    }

    fn check_shape(&mut self, item: Item, law: &Law) {
        let parts = law.parts();
        let constant = |field: Field| {
            let (_, value) = parts.iter().find(|(f, _)| *f == field)?;
            self.parts.reads(value).is_constant().then_some(value)
        };
        let (Some(inner), Some(outer)) = (constant(Field::InnerRadius), constant(Field::OuterRadius)) else {
            return;
        };
        if let (Ok(inner), Ok(outer)) = (inner.at(&mut self.scope), outer.at(&mut self.scope))
            && inner >= outer
        {
            self.error(item, BuildErrorKind::Radii { item, inner, outer });
        }
    }
}
