//! Reads functionals over time: the same names with the same meaning in limits, requirements and
//! sweeps.

use std::sync::Arc;

use lptn_network::{Context, Functional, OverTime, Value};
use lptn_units::{Dimension, Expression, Type};

use crate::place::{Given, Place, Text, Wanted};
use crate::work::Elaboration;

/// A functional as it is called.
pub(crate) struct Called {
    pub(crate) functional: Functional,
    example: &'static str,
    pub(crate) arguments: Vec<Expression>,
}

/// A number over time.
pub(crate) struct Taken {
    /// The quantity that is followed. For a time above or below a level: the distance from it. For
    /// a life: the rate of ageing over that at the reference.
    pub(crate) of: (Value, Type),
    /// The type of the number.
    pub(crate) ty: Type,
    pub(crate) over_time: OverTime,
}

impl Taken {
    /// A functional whose value has the type of its argument, or another one.
    fn new(functional: Functional, of: (Value, Type), (ty, life): (Type, Option<Value>)) -> Self {
        let over_time = OverTime { functional, of_ty: of.1, life };
        Self { of, ty, over_time }
    }
}

/// The constant of Boltzmann in the SI since 2019 (BIPM, The International System of Units, 9th
/// edition).
const BOLTZMANN: &str = "1.380649e-23 [J/K]";

impl Elaboration<'_> {
    /// The functional that an expression is as a whole, `max(ring.T)`, if it is one.
    pub(crate) fn called(&self, expression: &Expression) -> Option<Called> {
        let (name, arguments) = expression.split_call()?;
        let (functional, example) = self.functional_named((name, arguments.len()))?;
        Some(Called { functional, example, arguments })
    }

    /// The functional of this name and number of arguments, with its example, unless a table or
    /// function has its name.
    pub(crate) fn functional_named(
        &self,
        (name, arguments): (&str, usize),
    ) -> Option<(Functional, &'static str)> {
        let own = self.names.kind_of(name).is_some() || self.names.is_parameter(name);
        Functional::find(name, arguments).filter(|_| !own)
    }

    /// A number over time; `None` after a problem, which is reported.
    pub(crate) fn over_time(&mut self, place: Place<'_>, called: Called) -> Option<Taken> {
        let Called { functional, example, arguments } = called;
        if arguments.len() != functional.arity() {
            let message = format!(
                "{} has {} arguments instead of {}",
                place.words(),
                arguments.len(),
                functional.arity()
            );
            let help = format!("write it like this: `{example}`");
            self.refuse("netlist::functional", message, &place.raw.span, help);
            return None;
        }
        let (first, rest) = arguments.split_first()?;
        let time = Type::of(Dimension::TIME);
        match functional {
            Functional::TimeOver | Functional::TimeUnder => {
                let of = self.resolved(place, first, Wanted::of_results())?.ty();
                let level = rest.first()?;
                self.resolved(place, level, Wanted { ty: Some(of), ..Wanted::of_results() })?;
                let [above, below] = [first, level].map(Expression::meant);
                let text = match functional {
                    Functional::TimeOver => format!("({above}) - ({below})"),
                    _ => format!("({below}) - ({above})"),
                };
                Some(Taken::new(functional, self.joint(&text)?, (time, None)))
            }
            Functional::Life => self.life(place, first, rest),
            _ => {
                let of = self.resolved(place, first, Wanted::of_results())?;
                let ty = match functional {
                    Functional::Integral => self.integrated(place, of.ty())?,
                    _ => of.ty(),
                };
                let of_ty = of.ty();
                Some(Taken::new(functional, (of.value(), of_ty), (ty, None)))
            }
        }
    }

    /// The life at a changing temperature. Ageing has the rate `exp(-Ea / (k T))` (S. Arrhenius, Z.
    /// phys. Chem. 4 (1889) 226), and its mean determines the life.
    fn life(&mut self, place: Place<'_>, of: &Expression, rest: &[Expression]) -> Option<Taken> {
        let [life, reference, energy] = rest else { return None };
        let (point, time) = (Type::ABSOLUTE_TEMPERATURE, Type::of(Dimension::TIME));
        let wanted = Wanted { ty: Some(point), ..Wanted::of_results() };
        let of_given = self.resolved(place, of, wanted);
        let life = self.resolved(place, life, Wanted::constant(time));
        let at = self.resolved(place, reference, Wanted::constant(point));
        let barrier = self.resolved(place, energy, Wanted::constant(Type::of(Dimension::ENERGY)));
        of_given.and(at).and(barrier)?;
        let [of, at, energy] = [of, reference, energy].map(Expression::meant);
        let text = format!("exp(({energy}) / {BOLTZMANN} * (1 / kelvin({at}) - 1 / kelvin({of})))");
        let of = self.joint(&text)?;
        Some(Taken::new(Functional::Life, of, (time, Some(life?.value()))))
    }

    /// The type of an integral over time.
    fn integrated(&mut self, place: Place<'_>, of: Type) -> Option<Type> {
        let dimension = of.dimension.checked_mul(Dimension::TIME).filter(|_| !of.absolute);
        if dimension.is_none() {
            let message =
                format!("{} integrates a point on the scale of temperature", place.words());
            let help = "integrate a difference, as in `integral(ring.T - air.T)`";
            self.refuse("netlist::functional", message, &place.raw.span, help);
        }
        dimension.map(Type::of)
    }

    /// Refuses a functional in a place for a value of one moment.
    pub(crate) fn no_functional(&mut self, place: Place<'_>, name: &str) -> Option<Given> {
        let message = format!(
            "{} has the functional `{name}` over time, but a value of one moment is needed",
            place.words()
        );
        let help = match name {
            "mean" | "max" | "min" => format!(
                "{ELSEWHERE}, or give `[run]` a window; of several values at every moment it is \
                 `{name}(a.T, b.T)`"
            ),
            "integral" => format!("{ELSEWHERE}; an integral up to now is a `[state]`"),
            _ => ELSEWHERE.to_owned(),
        };
        self.refuse("netlist::functional", message, &place.raw.span, help);
        None
    }

    fn resolved(
        &mut self,
        place: Place<'_>,
        expression: &Expression,
        wanted: Wanted,
    ) -> Option<Given> {
        self.resolve(place, Text::Expression(expression.clone()), wanted)
    }

    /// Several expressions, each of which is sound, as one.
    fn joint(&self, text: &str) -> Option<(Value, Type)> {
        let expression = Expression::parse(text).ok()?;
        let program = expression.compile(&self.builder.scope(Context::Result), None).ok()?;
        let ty = program.ty();
        Some((Value::Expression(Arc::new(program)), ty))
    }
}

const ELSEWHERE: &str = "put it around the whole `of` of `[limit]`, a whole side of `require` or a \
                         whole report of `[run]` or `[sweep]`";
