//! What the network's builder found, said about the file.

use lptn_network::{BuildError, BuildErrorKind as Kind, Field, Item, NodeId, ZERO_CELSIUS};
use lptn_units::{Dimension, EvalError, format_number};

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::source_map::SourceMap;
use crate::vocabulary::MINIMAL;

/// The error with its places in the file.
pub(crate) fn describe(error: &BuildError, map: &SourceMap) -> Diagnostic {
    let diagnostic = Diagnostic::error(error.code(), message(error, map));
    let diagnostic = places(diagnostic, error, map);
    match imported(error, map).or_else(|| help(error)) {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

/// Whose part or result has the name of something else.
fn inside(words: &str, whole: Item, map: &SourceMap) -> String {
    match whole {
        Item::Grid(_) => {
            format!("{words} has a name that belongs to a grid, as those of its cells and faces do")
        }
        other => format!("{words} has the name of a result: that of a {}", map.kind(other)),
    }
}

fn message(error: &BuildError, map: &SourceMap) -> String {
    let name = &error.name;
    let words = |item: Item| format!("{} `{name}`", map.kind(item));
    let field = |item: Item, field: Field| match field {
        Field::Value | Field::Name => words(item),
        Field::Initial if map.is_default(item) => "`T0` of [default]".to_owned(),
        _ => format!("`{}` of {}", field.key(), words(item)),
    };
    match &error.kind {
        Kind::DuplicateName { first, second } => match (map.kind(*first), map.kind(*second)) {
            (a, b) if a == b => format!("two {a}s are named `{name}`"),
            (a, b) => format!("the name `{name}` is taken twice: by a {a} and by a {b}"),
        },
        Kind::NameInside { item, whole } => inside(&words(*item), *whole, map),
        Kind::BadName { item } => format!("{} has a name that cannot be used", words(*item)),
        Kind::ReservedName { item } => {
            format!("{} has a name with a meaning of its own in expressions", words(*item))
        }
        Kind::WrongType { item, field: f, wanted, found } => {
            format!("{} must be {wanted}, got {found}", field(*item, *f))
        }
        Kind::NotPositive { item, field: f, value } if value.is_finite() => {
            format!("{} must be more than zero, got {}", field(*item, *f), in_unit(*value, *f))
        }
        Kind::NotPositive { item, field: f, value } | Kind::NotFinite { item, field: f, value } => {
            format!("{} must be finite, got {value}", field(*item, *f))
        }
        Kind::BelowAbsoluteZero { item, field: f, value } => {
            format!("{} is below absolute zero: {} K", field(*item, *f), short(*value))
        }
        Kind::DependsOnTime { item, field: f } => {
            format!("{} has to be constant, but depends on the time `t`", field(*item, *f))
        }
        Kind::ComparisonNotLinear { item, field: f } => {
            format!("{} compares something that is not linear in the time `t`", field(*item, *f))
        }
        Kind::DependsOnResult { item, field: f } => {
            format!("{} cannot depend on the temperature of a node or boundary", field(*item, *f))
        }
        Kind::ComparesTemperature { item, field: f } => {
            format!(
                "{} compares temperatures, or what switches, where the change cannot be followed",
                field(*item, *f)
            )
        }
        Kind::Evaluation { item, field: f, error: EvalError::NotFinite { value, .. } } => {
            format!("{} comes out as {value}, which is not finite", field(*item, *f))
        }
        Kind::Evaluation { item, field: f, error } => format!("{}: {error}", field(*item, *f)),
        Kind::SelfLink { conductor } => {
            format!("{} leads from a place to itself", words(Item::Conductor(*conductor)))
        }
        Kind::NoInitialTemperature { node } => {
            format!("{} has no temperature at the start", words(Item::Node(*node)))
        }
        Kind::SourceIntoBoundary { source } => format!("{} heats a boundary", words(Item::Source(*source))),
        _ => message_of_physics(error, map),
    }
}

/// What contradicts the physics of an element.
fn message_of_physics(error: &BuildError, map: &SourceMap) -> String {
    let words = |item: Item| format!("{} `{}`", map.kind(item), error.name);
    let field = |item: Item, field: Field| format!("`{}` of {}", field.key(), words(item));
    match &error.kind {
        Kind::NotAFraction { item, field: f, value } => {
            format!("{} must be above 0 and at most 1, got {}", field(*item, *f), short(*value))
        }
        Kind::Radii { item, inner, outer } => format!(
            "`r_out` of {}, {} m, must be larger than its `r_in`, {} m",
            words(*item),
            short(*outer),
            short(*inner)
        ),
        Kind::Melting { item, solidus, liquidus } => format!(
            "`liquidus` of {}, {} K, is below its `solidus`, {} K",
            words(*item),
            short(*liquidus),
            short(*solidus)
        ),
        Kind::Shares { source, sum } => {
            format!("the shares of {} must sum to 1, got {}", words(Item::Source(*source)), short(*sum))
        }
        Kind::WhichTemperature { source } => {
            format!("`P` of {} depends on `T`, but it heats several nodes", words(Item::Source(*source)))
        }
        Kind::CapacityUnknown { node, temperature } => format!(
            "the capacity of {} is not known and positive at its start, {} K",
            words(Item::Node(*node)),
            short(*temperature)
        ),
        Kind::TooQuick { item, field: f } => {
            format!("{} changes too quickly with temperature to be integrated", field(*item, *f))
        }
        Kind::FluidUnknown { fluid, field: f } => {
            format!("{} is not known and positive at any usual temperature", field(Item::Fluid(*fluid), *f))
        }
        Kind::ThresholdsCrossed { control, fields, on, off } => {
            crossed(&words(Item::Control(*control)), *fields, (*on, *off))
        }
        Kind::Negative { item, field: f, value } => {
            format!("{} must not be negative, got {}", field(*item, *f), in_unit(*value, *f))
        }
        Kind::PeriodTooShort { signal, period, span } => format!(
            "the period of {}, {} s, is shorter than its points reach, {} s",
            words(Item::Signal(*signal)),
            short(*period),
            short(*span)
        ),
        _ => error.to_string(),
    }
}

/// The thresholds of a control for on and off, in K, in the wrong order.
fn crossed(words: &str, fields: [Field; 2], (on, off): (f64, f64)) -> String {
    let [on_key, off_key] = fields.map(Field::key);
    let celsius = |kelvin: f64| short(kelvin - ZERO_CELSIUS);
    if off.total_cmp(&on).is_eq() {
        return format!("`{on_key}` and `{off_key}` of {words} are one temperature, {} degC", celsius(on));
    }
    let (on, off) = (celsius(on), celsius(off));
    format!("`{on_key}` and `{off_key}` of {words} are crossed over: on at {on} degC, off at {off} degC")
}

/// Without the noise of binary arithmetic.
pub(crate) fn short(value: f64) -> String {
    format!("{value:.9e}").parse().map_or_else(|_| value.to_string(), format_number)
}

fn in_unit(value: f64, field: Field) -> String {
    let dimension = match field {
        Field::Capacity => Dimension::CAPACITY,
        Field::Resistance => Dimension::RESISTANCE,
        Field::Conductance => Dimension::CONDUCTANCE,
        Field::FilmCoefficient => Dimension::FILM_COEFFICIENT,
        Field::Area => Dimension::AREA,
        Field::Mass => Dimension::MASS,
        Field::Volume => Dimension::VOLUME,
        Field::Density => Dimension::DENSITY,
        Field::SpecificHeat => Dimension::SPECIFIC_HEAT,
        Field::Conductivity => Dimension::CONDUCTIVITY,
        Field::Exchange => Dimension::AREA,
        Field::Thickness
        | Field::InnerRadius
        | Field::OuterRadius
        | Field::Length
        | Field::Diameter
        | Field::Size
        | Field::CharacteristicLength => Dimension::LENGTH,
        Field::LatentHeat => Dimension::SPECIFIC_ENERGY,
        Field::MinDwell => Dimension::TIME,
        _ => return short(value),
    };
    format!("{} {}", short(value), dimension.si_unit())
}

fn places(diagnostic: Diagnostic, error: &BuildError, map: &SourceMap) -> Diagnostic {
    let also = |d: Diagnostic, span: Option<Span>, text: &str| match span {
        Some(span) => d.also(span, text),
        None => d,
    };
    match &error.kind {
        Kind::DuplicateName { .. } => match map.duplicate(&error.kind) {
            Some((first, second)) => diagnostic.at(second, "named again").also(first, "first named here"),
            None => diagnostic,
        },
        Kind::NameInside { item, whole } => {
            let grid = if matches!(whole, Item::Grid(_)) { "the grid" } else { "the element" };
            also(at(diagnostic, map.name(*item), "named here"), map.name(*whole), grid)
        }
        Kind::FloatingIsland { nodes, .. } => island(diagnostic, nodes, map),
        Kind::Evaluation { item, field, error } => match map.part(*item, *field, &error.span()) {
            Some(span) => diagnostic.at(span, ""),
            None => at(diagnostic, map.nearest(*item, *field), ""),
        },
        Kind::ThresholdsCrossed { control, fields: [on, off], .. } => {
            let item = Item::Control(*control);
            let diagnostic = at(diagnostic, map.nearest(item, *on), "on");
            also(diagnostic, map.get(item, *off), "off")
        }
        Kind::MasslessWithCapacity { node } => {
            let item = Item::Node(*node);
            let capacity = map.get(item, Field::Capacity);
            let capacity = capacity
                .or_else(|| map.get(item, Field::Material))
                .or_else(|| map.capacitor_of(*node).cloned());
            let diagnostic = at(diagnostic, map.name(item), "declared massless");
            also(diagnostic, capacity, "given a capacity here")
        }
        Kind::SelfLink { conductor } => {
            let item = Item::Conductor(*conductor);
            let diagnostic = at(diagnostic, map.get(item, Field::To), "the same place");
            also(diagnostic, map.get(item, Field::From), "leads from here")
        }
        Kind::FaceArea { item, face, .. } => {
            let diagnostic = at(diagnostic, map.get(*item, Field::Area), "not the area of the face");
            also(diagnostic, map.get(Item::Grid(face.grid), Field::Size), "which is as large as this says")
        }
        Kind::FaceCells { item, faces, .. } | Kind::FaceSides { item, faces, .. } => {
            let field = if matches!(error.kind, Kind::FaceCells { .. }) { Field::Cells } else { Field::Size };
            let diagnostic = at(diagnostic, map.get(*item, Field::To), "");
            let [a, b] = faces.map(|face| map.get(Item::Grid(face.grid), field));
            also(also(diagnostic, a, "from this grid"), b, "to this grid")
        }
        kind => match error.place() {
            Some((item, field)) => at(diagnostic, map.nearest(item, field), label(kind)),
            None => at(diagnostic, map.top().cloned(), ""),
        },
    }
}

fn at(diagnostic: Diagnostic, span: Option<Span>, text: &str) -> Diagnostic {
    match span {
        Some(span) => diagnostic.at(span, text),
        None => diagnostic,
    }
}

fn label(kind: &Kind) -> &'static str {
    match kind {
        Kind::NoCapacity { .. } => "no `C`, and no [capacitor] belongs to it",
        Kind::NoInitialTemperature { .. } => "no `T0` here, and none in [default]",
        Kind::SourceIntoBoundary { .. } => "a boundary",
        _ => "",
    }
}

/// Every node of the island, as far as a reader can take them in.
fn island(mut diagnostic: Diagnostic, nodes: &[NodeId], map: &SourceMap) -> Diagnostic {
    for (n, span) in nodes.iter().take(8).filter_map(|node| map.name(Item::Node(*node))).enumerate() {
        diagnostic = if n == 0 {
            diagnostic.at(span, "not determined")
        } else {
            diagnostic.also(span, "connected to it")
        };
    }
    diagnostic
}

fn help(error: &BuildError) -> Option<String> {
    let zero = |value: f64| value.abs() < f64::MIN_POSITIVE;
    Some(match &error.kind {
        Kind::Empty => format!("add a section [node]; {MINIMAL}").trim_end().to_owned(),
        Kind::DuplicateName { first, .. } => {
            let kinds = match first {
                Item::Parameter(_)
                | Item::Signal(_)
                | Item::Control(_)
                | Item::Table(_)
                | Item::Report(_) => "parameters, signals, controls, tables and reports",
                _ => "nodes and elements",
            };
            format!("rename one of them, for example `{}_2`; {kinds} share one set of names", error.name)
        }
        Kind::NameInside { .. } => {
            let free = error.name.replace(['.', '[', ','], "_").replace(']', "");
            format!("rename one of them, for example `{free}`")
        }
        Kind::NotPositive { field, value, .. } if value.is_nan() || value.is_infinite() => match field {
            Field::Resistance => "leave the path out if no heat flows through it".into(),
            _ => "something is divided by zero, or a number is too large".into(),
        },
        Kind::NotPositive { field, value, .. } => not_positive(*field, zero(*value)).to_owned(),
        Kind::Negative { field: Field::MinDwell, .. } => {
            "leave it out where it may switch again at once".into()
        }
        Kind::Radii { inner, outer, .. } if inner <= outer => {
            "a wall has a thickness: make `r_out` larger".into()
        }
        Kind::NotAFraction { .. } => "it is a part of a whole: write `0.8` for 80 %".into(),
        Kind::NotFinite { .. } => "something is divided by zero, or a number is too large".into(),
        Kind::Evaluation { error, .. } => evaluation(error)?.to_owned(),
        Kind::BadName { .. } => format!("use letters, digits and `_`: `{}`", usable(&error.name)),
        Kind::BelowAbsoluteZero { .. } => "0 K is -273.15 degC".into(),
        Kind::NoCapacity { .. } => format!(
            "give it a capacity, `{0} = {{ C = \"500 J/K\" }}`, or make it a junction, `{0} = {{ massless = true }}`",
            error.name
        ),
        _ => return error.help(),
    })
}

/// What to do about a row, where it is not what to do about a field.
fn imported(error: &BuildError, map: &SourceMap) -> Option<String> {
    error.place().filter(|(item, _)| map.is_imported(*item))?;
    Some(match &error.kind {
        Kind::NotPositive { field: Field::Capacity, value, .. } if value.abs() < f64::MIN_POSITIVE => {
            "leave the cell empty for a node that stores nothing".to_owned()
        }
        Kind::NoInitialTemperature { .. } => {
            "fill in the column `T0`, or add `T0 = \"25 degC\"` to [default]".to_owned()
        }
        _ => return None,
    })
}

fn not_positive(field: Field, zero: bool) -> &'static str {
    match field {
        Field::Resistance if zero => "two places without resistance between them are one node: make them one",
        Field::Conductance | Field::FilmCoefficient | Field::Area | Field::Exchange if zero => {
            "leave the path out if no heat flows through it"
        }
        Field::Capacity if zero => "a node that stores nothing is `{ massless = true }`",
        Field::Capacity => "check the sign: heat that is stored makes a body warmer",
        Field::Mass | Field::Volume | Field::Density | Field::SpecificHeat | Field::Conductivity => {
            "a body has a mass, a volume and properties of more than zero"
        }
        Field::Thickness
        | Field::InnerRadius
        | Field::OuterRadius
        | Field::Length
        | Field::Diameter
        | Field::Size
        | Field::CharacteristicLength => "a body has measures of more than zero",
        Field::LatentHeat => "melting takes up heat: give it as a positive number",
        _ => "check the sign: heat flows from the warm to the cold end, whichever is named first",
    }
}

fn evaluation(error: &EvalError) -> Option<&'static str> {
    match error {
        EvalError::NotFinite { .. } => Some("something is divided by zero, or a number is too large"),
        EvalError::NegativeBase { .. } => {
            Some("a negative number has no such power; use `abs(..)` if the sign does not count")
        }
        EvalError::Domain { .. } => Some("check the sign of its argument"),
        EvalError::OutsideTable { .. } => error.help(),
        _ => None,
    }
}

/// A name that is like this one and can be used.
fn usable(name: &str) -> String {
    let letters = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let name: String = letters.collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() { format!("_{name}") } else { name }
}
