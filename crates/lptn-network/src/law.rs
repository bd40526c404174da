//! How conductors carry heat: the data of each law, and its conductance on numbers or dual numbers.

use lptn_units::{EvalError, Scalar};

use crate::evaluation::Evaluation;
use crate::id::{Field, FluidId};
use crate::input_error::InputProblem;
use crate::layout::slot;
use crate::value::Value;

/// How a conductor carries heat. Heat flow is `G (T_from - T_to)` in W, positive from `from` to `to`; a stream
/// ([`Law::Advection`]) carries it one way only.
#[derive(Clone, Debug)]
pub enum Law {
    /// `G = 1/R`, R in K/W.
    Resistance(Value),
    /// `G` in W/K.
    Conductance(Value),
    /// `G = h A`: Newton's law of cooling with a film coefficient h in W/(m^2 K) and an area A in m^2. A contact
    /// obeys it too.
    Film {
        /// Film coefficient.
        coefficient: Value,
        /// Wetted area.
        area: Value,
    },
    /// Conduction through a body of simple shape; the conductivity is taken at the mean of the ends.
    Conduction {
        /// Thermal conductivity in W/(m K).
        conductivity: Value,
        /// The body.
        shape: Box<Shape>,
    },
    /// Radiation between two surfaces: `q = sigma Gr (T_from^4 - T_to^4)`.
    Radiation(Box<Exchange>),
    /// Heat carried by a stream from `from` to `to`.
    Advection(Box<Stream>),
}

/// A body that conducts between two of its faces; lengths in m, areas in m^2.
#[derive(Clone, Debug)]
pub enum Shape<T = Value> {
    /// Between the two faces of a plate.
    Slab {
        /// Area of a face.
        area: T,
        /// Distance of the faces.
        thickness: T,
    },
    /// From the inner to the outer surface of a tube.
    Cylinder {
        /// Inner radius.
        inner: T,
        /// Outer radius.
        outer: T,
        /// Length.
        length: T,
    },
    /// From the inner to the outer surface of a hollow sphere.
    Sphere {
        /// Inner radius.
        inner: T,
        /// Outer radius.
        outer: T,
    },
    /// Along a round bar.
    Rod {
        /// Diameter.
        diameter: T,
        /// Length.
        length: T,
    },
}

/// What two surfaces exchange by radiation.
#[derive(Clone, Debug)]
pub enum Exchange<T = Value> {
    /// The exchange area Gr in m^2: area, view factor and emissivities in one.
    Area(T),
    /// Emissivity, area and view factor.
    Surfaces {
        /// Emissivity.
        emissivity: Emissivity<T>,
        /// Area in m^2.
        area: T,
        /// View factor.
        view_factor: T,
    },
}

/// The emissivity of an exchange.
#[derive(Clone, Debug)]
pub enum Emissivity<T = Value> {
    /// That of the exchange as a whole.
    Effective(T),
    /// Those of two parallel plates that face each other.
    Plates(T, T),
}

/// What a stream carries.
#[derive(Clone, Debug)]
pub enum Stream<T = Value> {
    /// Its capacity rate in W/K: mass flow times specific heat, positive from `from` to `to`.
    Capacity(T),
    /// A mass flow of a fluid in kg/s, positive from `from` to `to`.
    Mass {
        /// The fluid.
        fluid: FluidId,
        /// Mass flow.
        flow: T,
    },
    /// A volume flow of a fluid in m^3/s, measured at a temperature.
    Volume {
        /// The fluid.
        fluid: FluidId,
        /// Volume flow.
        flow: T,
        /// Absolute temperature in K at which the volume is measured.
        at: T,
    },
}

impl<T> Shape<T> {
    /// Its measures with their fields.
    pub fn parts(&self) -> Vec<(Field, &T)> {
        match self {
            Self::Slab { area, thickness } => vec![(Field::Area, area), (Field::Thickness, thickness)],
            Self::Cylinder { inner, outer, length } => {
                vec![(Field::InnerRadius, inner), (Field::OuterRadius, outer), (Field::Length, length)]
            }
            Self::Sphere { inner, outer } => {
                vec![(Field::InnerRadius, inner), (Field::OuterRadius, outer)]
            }
            Self::Rod { diameter, length } => vec![(Field::Diameter, diameter), (Field::Length, length)],
        }
    }

    /// The same body with other measures.
    pub fn map<U>(self, mut f: impl FnMut(Field, T) -> U) -> Shape<U> {
        match self {
            Self::Slab { area, thickness } => {
                Shape::Slab { area: f(Field::Area, area), thickness: f(Field::Thickness, thickness) }
            }
            Self::Cylinder { inner, outer, length } => Shape::Cylinder {
                inner: f(Field::InnerRadius, inner),
                outer: f(Field::OuterRadius, outer),
                length: f(Field::Length, length),
            },
            Self::Sphere { inner, outer } => {
                Shape::Sphere { inner: f(Field::InnerRadius, inner), outer: f(Field::OuterRadius, outer) }
            }
            Self::Rod { diameter, length } => {
                Shape::Rod { diameter: f(Field::Diameter, diameter), length: f(Field::Length, length) }
            }
        }
    }
}

impl<T> Exchange<T> {
    /// Its values with their fields.
    pub fn parts(&self) -> Vec<(Field, &T)> {
        match self {
            Self::Area(area) => vec![(Field::Exchange, area)],
            Self::Surfaces { emissivity, area, view_factor } => {
                let mut parts: Vec<(Field, &T)> = match emissivity {
                    Emissivity::Effective(e) => vec![(Field::Emissivity, e)],
                    Emissivity::Plates(a, b) => vec![(Field::Emissivity, a), (Field::Emissivity, b)],
                };
                parts.extend([(Field::Area, area), (Field::ViewFactor, view_factor)]);
                parts
            }
        }
    }

    /// The same exchange with other values.
    pub fn map<U>(self, mut f: impl FnMut(Field, T) -> U) -> Exchange<U> {
        match self {
            Self::Area(area) => Exchange::Area(f(Field::Exchange, area)),
            Self::Surfaces { emissivity, area, view_factor } => {
                let emissivity = match emissivity {
                    Emissivity::Effective(e) => Emissivity::Effective(f(Field::Emissivity, e)),
                    Emissivity::Plates(a, b) => {
                        let first = f(Field::Emissivity, a);
                        Emissivity::Plates(first, f(Field::Emissivity, b))
                    }
                };
                Exchange::Surfaces {
                    emissivity,
                    area: f(Field::Area, area),
                    view_factor: f(Field::ViewFactor, view_factor),
                }
            }
        }
    }
}

impl<T> Stream<T> {
    /// Its values with their fields.
    pub fn parts(&self) -> Vec<(Field, &T)> {
        match self {
            Self::Capacity(mcp) => vec![(Field::StreamCapacity, mcp)],
            Self::Mass { flow, .. } => vec![(Field::Flow, flow)],
            Self::Volume { flow, at, .. } => vec![(Field::Flow, flow), (Field::FlowTemperature, at)],
        }
    }

    /// The same stream with other values.
    pub fn map<U>(self, mut f: impl FnMut(Field, T) -> U) -> Stream<U> {
        match self {
            Self::Capacity(mcp) => Stream::Capacity(f(Field::StreamCapacity, mcp)),
            Self::Mass { fluid, flow } => Stream::Mass { fluid, flow: f(Field::Flow, flow) },
            Self::Volume { fluid, flow, at } => {
                let flow = f(Field::Flow, flow);
                Stream::Volume { fluid, flow, at: f(Field::FlowTemperature, at) }
            }
        }
    }

    /// The fluid, if it is named.
    pub fn fluid(&self) -> Option<FluidId> {
        match self {
            Self::Capacity(_) => None,
            Self::Mass { fluid, .. } | Self::Volume { fluid, .. } => Some(*fluid),
        }
    }
}

impl Law {
    /// Whether it is a constant resistance or conductance, as nearly all of a large network are.
    pub(crate) fn is_number(&self) -> bool {
        matches!(self, Self::Resistance(Value::Constant(_)) | Self::Conductance(Value::Constant(_)))
    }

    /// The conductance in W/K of a constant resistance or conductance that is as it should be.
    pub(crate) fn number(&self) -> Option<f64> {
        let conductance = match self {
            Self::Conductance(Value::Constant(conductance)) => *conductance,
            Self::Resistance(Value::Constant(resistance)) if *resistance > 0.0 => 1.0 / resistance,
            _ => return None,
        };
        (conductance.is_finite() && conductance > 0.0).then_some(conductance)
    }

    /// Its values with their fields.
    pub fn parts(&self) -> Vec<(Field, &Value)> {
        match self {
            Self::Resistance(r) => vec![(Field::Resistance, r)],
            Self::Conductance(g) => vec![(Field::Conductance, g)],
            Self::Film { coefficient, area } => {
                vec![(Field::FilmCoefficient, coefficient), (Field::Area, area)]
            }
            Self::Conduction { conductivity, shape } => {
                let mut parts = vec![(Field::Conductivity, conductivity)];
                parts.extend(shape.parts());
                parts
            }
            Self::Radiation(exchange) => exchange.parts(),
            Self::Advection(stream) => stream.parts(),
        }
    }

    /// The same law with other values.
    pub(crate) fn map(self, mut f: impl FnMut(Field, Value) -> Value) -> Self {
        match self {
            Self::Resistance(r) => Self::Resistance(f(Field::Resistance, r)),
            Self::Conductance(g) => Self::Conductance(f(Field::Conductance, g)),
            Self::Film { coefficient, area } => {
                Self::Film { coefficient: f(Field::FilmCoefficient, coefficient), area: f(Field::Area, area) }
            }
            Self::Conduction { conductivity, shape } => Self::Conduction {
                conductivity: f(Field::Conductivity, conductivity),
                shape: Box::new(shape.map(f)),
            },
            Self::Radiation(exchange) => Self::Radiation(Box::new(exchange.map(f))),
            Self::Advection(stream) => Self::Advection(Box::new(stream.map(f))),
        }
    }
}

impl Law {
    /// Whether it is the same law with the same values; `false` where that is not looked at.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let (own, others) = (self.parts(), other.parts());
        let comparable = !matches!(self, Self::Advection(_))
            && std::mem::discriminant(self) == std::mem::discriminant(other)
            && own.len() == others.len();
        comparable && own.iter().zip(&others).all(|(a, b)| a.0 == b.0 && a.1.is_same(b.1))
    }

    /// The conductance in W/K where `scope` stands; 0 for a stream.
    ///
    /// # Errors
    /// What the evaluation of an expression reports; a value that its field cannot have counts as no number.
    pub fn conductance(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        let (slots, stack) = scope.plain();
        At { slots, stack }.conductance(self).map_err(|(_, problem)| match problem {
            InputProblem::Evaluation(error) => *error,
            _ => EvalError::NotFinite { value: f64::NAN, span: 0..0 },
        })
    }
}

/// What is wrong with a value of a field that may change during a run.
fn impossible(field: Field, value: f64) -> Option<InputProblem> {
    match field {
        Field::StreamCapacity | Field::Flow => None,
        Field::Emissivity | Field::ViewFactor if !(0.0..=1.0).contains(&value) => {
            Some(InputProblem::NotAFraction(value))
        }
        Field::Conductance if value < 0.0 => Some(InputProblem::NegativeConductance(value)),
        Field::Resistance if value < 0.0 => Some(InputProblem::NegativeConductance(value.recip())),
        Field::FlowTemperature if value < 0.0 => Some(InputProblem::BelowAbsoluteZero(value)),
        _ if value < 0.0 => Some(InputProblem::Negative(value)),
        _ => None,
    }
}

/// Slots on numbers or dual numbers, with the stack that programs need.
pub(crate) struct At<'a, S> {
    pub(crate) slots: &'a mut [S],
    pub(crate) stack: &'a mut Vec<S>,
}

impl<S: Scalar> At<'_, S> {
    /// A value, which has to be one that its field can have.
    pub(crate) fn get(&mut self, field: Field, value: &Value) -> Result<S, (Field, InputProblem)> {
        let evaluated = value.on(self.slots, self.stack);
        let result = evaluated.map_err(|error| (field, error.into()))?;
        match impossible(field, result.value()) {
            Some(problem) => Err((field, problem)),
            None => Ok(result),
        }
    }

    /// The conductance of a law that is no stream, in W/K, where the slots stand.
    pub(crate) fn conductance(&mut self, law: &Law) -> Result<S, (Field, InputProblem)> {
        match law {
            Law::Resistance(r) => Ok(S::from_f64(1.0) / self.get(Field::Resistance, r)?),
            Law::Conductance(g) => self.get(Field::Conductance, g),
            Law::Film { coefficient, area } => {
                let h = self.get(Field::FilmCoefficient, coefficient)?;
                Ok(lptn_laws::film(h, self.get(Field::Area, area)?))
            }
            Law::Conduction { conductivity, shape } => self.conduction(conductivity, shape),
            Law::Radiation(exchange) => {
                let gr = self.exchange_area(exchange)?;
                let (from, to) = (self.slots[slot::FROM as usize], self.slots[slot::TO as usize]);
                Ok(lptn_laws::radiation_conductance(gr, from, to))
            }
            Law::Advection(_) => Ok(S::from_f64(0.0)),
        }
    }

    fn conduction(&mut self, conductivity: &Value, shape: &Shape) -> Result<S, (Field, InputProblem)> {
        let k = self.get(Field::Conductivity, conductivity)?;
        Ok(match shape {
            Shape::Slab { area, thickness } => {
                let area = self.get(Field::Area, area)?;
                lptn_laws::slab(k, area, self.get(Field::Thickness, thickness)?)
            }
            Shape::Cylinder { inner, outer, length } => {
                let inner = self.get(Field::InnerRadius, inner)?;
                let outer = self.get(Field::OuterRadius, outer)?;
                lptn_laws::cylinder(k, inner, outer, self.get(Field::Length, length)?)
            }
            Shape::Sphere { inner, outer } => {
                let inner = self.get(Field::InnerRadius, inner)?;
                lptn_laws::sphere(k, inner, self.get(Field::OuterRadius, outer)?)
            }
            Shape::Rod { diameter, length } => {
                let diameter = self.get(Field::Diameter, diameter)?;
                lptn_laws::rod(k, diameter, self.get(Field::Length, length)?)
            }
        })
    }

    /// The exchange area Gr in m^2.
    pub(crate) fn exchange_area(&mut self, exchange: &Exchange) -> Result<S, (Field, InputProblem)> {
        match exchange {
            Exchange::Area(gr) => self.get(Field::Exchange, gr),
            Exchange::Surfaces { emissivity, area, view_factor } => {
                let emissivity = match emissivity {
                    Emissivity::Effective(e) => self.get(Field::Emissivity, e)?,
                    Emissivity::Plates(a, b) => {
                        let first = self.get(Field::Emissivity, a)?;
                        let second = self.get(Field::Emissivity, b)?;
                        lptn_laws::effective_emissivity_parallel_plates(first, second)
                    }
                };
                let area = self.get(Field::Area, area)?;
                Ok(lptn_laws::radiation_exchange_area(
                    emissivity,
                    area,
                    self.get(Field::ViewFactor, view_factor)?,
                ))
            }
        }
    }
}
