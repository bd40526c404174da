//! A report of a sweep about a candidate: a functional of the results.

use std::sync::Arc;

use lptn_data::Span;
use lptn_network::{Context, Value};
use lptn_units::{Dimension, Expression, Type};

use crate::place::{Given, Place, Text, Wanted};
use crate::raw::RawEntry;
use crate::sweep::SweepOver;
use crate::value::whole;
use crate::work::Elaboration;

/// A functional of a quantity over a run or a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Functional {
    /// The quantity in steady state, or one that depends on parameters alone.
    Value,
    /// Its last value.
    Last,
    /// Its largest value.
    Max,
    /// Its least value.
    Min,
    /// Its mean over time.
    Mean,
    /// Its integral over time.
    Integral,
    /// Time for which it is above a level.
    TimeOver,
    /// Time for which it is below a level.
    TimeUnder,
    /// Life of an insulation or a lubricant at this temperature, by the law of Arrhenius.
    Life,
}

impl Functional {
    /// The functionals with arguments, each with an example.
    pub const CALLED: [(&str, Self, &str); 8] = [
        ("last", Self::Last, "last(ring.T)"),
        ("max", Self::Max, "max(ring.T)"),
        ("min", Self::Min, "min(ring.T)"),
        ("mean", Self::Mean, "mean(ring.T)"),
        ("integral", Self::Integral, "integral(loss.P)"),
        ("time_over", Self::TimeOver, "time_over(ring.T, 110 [degC])"),
        ("time_under", Self::TimeUnder, "time_under(ring.T, 20 [degC])"),
        ("life", Self::Life, "life(ring.T, 20000 [h], 105 [degC], 1 [eV])"),
    ];

    /// Number of its arguments.
    fn arity(self) -> usize {
        match self {
            Self::TimeOver | Self::TimeUnder => 2,
            Self::Life => 4,
            _ => 1,
        }
    }

    /// The one of this name; `max(a, b)` is a function of two values, not a functional of a run.
    fn find(name: &str, arguments: usize) -> Option<(Self, &'static str)> {
        let found = Self::CALLED.into_iter().find(|(known, ..)| *known == name);
        let of_values = matches!(name, "max" | "min" | "mean") && arguments > 1;
        found.filter(|_| !of_values).map(|(_, functional, example)| (functional, example))
    }
}

/// A report about every candidate.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Its name, that of its column.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// Its functional.
    pub functional: Functional,
    /// The argument of the functional. For a time above or below a level: the distance from it. For
    /// a life: the rate of ageing over that at the reference.
    pub of: Value,
    /// The type of that.
    pub of_ty: Type,
    /// The type of the report.
    pub ty: Type,
    /// The life at the reference, in s.
    pub life: Option<Value>,
}

/// The parts of a measure.
struct Taken {
    functional: Functional,
    of: (Value, Type),
    ty: Type,
    life: Option<Value>,
}

/// The constant of Boltzmann in the SI since 2019 (BIPM, The International System of Units, 9th
/// edition).
const BOLTZMANN: &str = "1.380649e-23 [J/K]";

const RESERVED: [&str; 3] = ["case", "outside", "failed"];

impl<'a> Elaboration<'a> {
    /// One entry of `report`.
    pub(super) fn measure(&mut self, entry: &'a RawEntry, over: SweepOver) -> Option<Measure> {
        let owner = crate::fields::Owner::element("report", &entry.key);
        let place = Place { owner: &owner, key: "", raw: &entry.value };
        if RESERVED.contains(&entry.key.as_str()) {
            let message = format!("`{}` is a column of every sweep", entry.key);
            let help = "give the report another name";
            self.refuse("netlist::report_name", message, &entry.key_span, help);
            return None;
        }
        let text = self.names.text(place, None);
        let text = self.kept(text)?;
        let (written, taken) = match text {
            Text::Quantity(quantity) => {
                let given = Given::Quantity(quantity);
                (String::new(), self.plain(given))
            }
            Text::Expression(expression) => {
                let taken = self.taken(place, &expression, over)?;
                (whole(&expression), taken)
            }
        };
        let (name, span) = (entry.key.clone(), entry.value.span.clone());
        let Taken { functional, of: (of, of_ty), ty, life } = taken;
        Some(Measure { name, text: written, span, functional, of, of_ty, ty, life })
    }

    fn plain(&self, given: Given) -> Taken {
        let ty = given.ty();
        Taken { functional: Functional::Value, of: (given.value(), ty), ty, life: None }
    }

    fn taken(&mut self, place: Place<'_>, whole: &Expression, over: SweepOver) -> Option<Taken> {
        let call = whole.split_call();
        let found = call.and_then(|(name, arguments)| {
            let (functional, example) = Functional::find(name, arguments.len())?;
            Some((functional, example, arguments))
        });
        let Some((functional, example, arguments)) = found else {
            return self.plain_of(place, whole, over);
        };
        if over == SweepOver::Steady {
            let inner = arguments.first().map_or("", |first| first.text().trim());
            let message = format!(
                "{} needs results over time, but a steady state is one \
                moment",
                place.words()
            );
            let help = format!(
                "write `{inner}`, which is its value there, or report `over = \"run\"` or `over = \
                 \"periodic\"`"
            );
            self.refuse("netlist::sweep_report", message, &place.raw.span, help);
            return None;
        }
        if arguments.len() != functional.arity() {
            let message = format!(
                "{} has {} arguments instead of {}",
                place.words(),
                arguments.len(),
                functional.arity()
            );
            let help = format!("write it like this: `{example}`");
            self.refuse("netlist::sweep_report", message, &place.raw.span, help);
            return None;
        }
        self.functional(place, functional, arguments)
    }

    /// An expression without a functional: its value in steady state. In a run it has to be the
    /// same all the time.
    fn plain_of(&mut self, place: Place<'_>, whole: &Expression, over: SweepOver) -> Option<Taken> {
        if over == SweepOver::Steady {
            let given =
                self.resolve(place, Text::Expression(whole.clone()), Wanted::of_results())?;
            return Some(self.plain(given));
        }
        let inner = whole.called().find(|(name, count)| Functional::find(name, *count).is_some());
        let constant = |(name, _): &(String, _)| self.names.is_parameter(name);
        if inner.is_none() && whole.names().iter().all(constant) {
            let given =
                self.resolve(place, Text::Expression(whole.clone()), Wanted::parameter())?;
            return Some(self.plain(given));
        }
        let (message, help) = match inner {
            Some((name, _)) => (
                format!("{} has `{name}` inside of an expression", place.words()),
                format!("put it around the whole expression: `{name}(..)`"),
            ),
            None => (
                format!("{} varies over time: it needs a functional", place.words()),
                format!(
                    "write `max({0})`, `last({0})`, `mean({0})` or another functional around it",
                    whole.text().trim()
                ),
            ),
        };
        self.refuse("netlist::sweep_report", message, &place.raw.span, help);
        None
    }

    fn functional(
        &mut self,
        place: Place<'_>,
        functional: Functional,
        arguments: Vec<Expression>,
    ) -> Option<Taken> {
        let time = Type::of(Dimension::TIME);
        let mut arguments = arguments.into_iter();
        let first = arguments.next()?;
        let rest: Vec<Expression> = arguments.collect();
        match functional {
            Functional::TimeOver | Functional::TimeUnder => {
                let of = self.resolved(place, &first, Wanted::of_results())?.ty();
                let level = rest.first()?;
                self.resolved(place, level, Wanted { ty: Some(of), ..Wanted::of_results() })?;
                let [above, below] = [&first, level].map(Expression::meant);
                let text = match functional {
                    Functional::TimeOver => format!("({above}) - ({below})"),
                    _ => format!("({below}) - ({above})"),
                };
                let of = self.joint(&text)?;
                Some(Taken { functional, of, ty: time, life: None })
            }
            Functional::Life => self.life(place, &first, &rest),
            _ => {
                let of = self.resolved(place, &first, Wanted::of_results())?;
                let ty = match functional {
                    Functional::Integral => self.integrated(place, of.ty())?,
                    _ => of.ty(),
                };
                let of_ty = of.ty();
                Some(Taken { functional, of: (of.value(), of_ty), ty, life: None })
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
        Some(Taken { functional: Functional::Life, of, ty: time, life: Some(life?.value()) })
    }

    /// The type of an integral over time.
    fn integrated(&mut self, place: Place<'_>, of: Type) -> Option<Type> {
        let dimension = of.dimension.checked_mul(Dimension::TIME).filter(|_| !of.absolute);
        if dimension.is_none() {
            let message =
                format!("{} integrates a point on the scale of temperature", place.words());
            let help = "integrate a difference, as in `integral(ring.T - air.T)`";
            self.refuse("netlist::sweep_report", message, &place.raw.span, help);
        }
        dimension.map(Type::of)
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
