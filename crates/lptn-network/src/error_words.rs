//! Words of build errors for items, and the parts of their sentences.

use std::fmt::Display;

use lptn_laws::Formula;
use lptn_units::{Dimension, EvalError, format_short};

use crate::id::{Field, Item};
use crate::typed::ZERO_CELSIUS;

/// Words for items in an error: a netlist calls a conductor by its section.
pub trait Naming {
    /// The word for an item.
    fn kind(&self, item: Item) -> &'static str {
        item.word()
    }

    /// The key of a field of an item.
    fn key(&self, item: Item, field: Field) -> &'static str {
        let _ = item;
        field.key()
    }

    /// The words for a field that is not the item's own, such as a default.
    fn elsewhere(&self, item: Item, field: Field) -> Option<&'static str> {
        let _ = (item, field);
        None
    }
}

/// The words for items in general.
struct Plain;

impl Naming for Plain {}

/// The words for one error.
pub struct Say<'a> {
    /// The name of the item in question.
    pub name: &'a str,
    naming: &'a dyn Naming,
}

impl<'a> Say<'a> {
    /// The words for the item of this name.
    pub fn new(name: &'a str) -> Self {
        Self { name, naming: &Plain }
    }

    /// The same with other words for items.
    pub fn with(name: &'a str, naming: &'a dyn Naming) -> Self {
        Self { name, naming }
    }

    pub(crate) fn kind(&self, item: Item) -> &'static str {
        self.naming.kind(item)
    }

    /// "resistor `wall`"
    pub(crate) fn item(&self, item: Item) -> String {
        format!("{} `{}`", self.kind(item), self.name)
    }

    /// "`R` of resistor `wall`"
    pub(crate) fn field(&self, item: Item, field: Field) -> String {
        match (self.naming.elsewhere(item, field), field) {
            (Some(words), _) => words.to_owned(),
            (None, Field::Value | Field::Name) => self.item(item),
            (None, _) => format!("`{}` of {}", self.naming.key(item, field), self.item(item)),
        }
    }
}

/// Help for a name that is taken twice.
pub(crate) fn unused_name(first: Item, name: &str) -> String {
    let kinds = match first {
        Item::Parameter(_)
        | Item::Signal(_)
        | Item::Control(_)
        | Item::Table(_)
        | Item::State(_)
        | Item::Value(_)
        | Item::Report(_) => "parameters, values, signals, controls, states, tables and reports",
        _ => "nodes and elements",
    };
    // the name of a part of a grid, such as `wall.y[3,3]`, becomes one that can be written
    let other = if name.contains('[') { without_brackets(name) } else { format!("{name}_2") };
    format!("rename one of them, for example `{other}`; {kinds} share one set of names")
}

/// A name of a part of a grid as a separate name: `wall.y[3,3]` as `wall_y_3_3`.
pub(crate) fn without_brackets(name: &str) -> String {
    name.replace(['.', '[', ','], "_").replace(']', "")
}

/// Whose part or result has the name of something else.
pub(crate) fn inside(say: &Say<'_>, item: Item, whole: Item) -> String {
    let words = say.item(item);
    match whole {
        Item::Grid(_) => {
            format!("{words} has a name that belongs to a grid, as those of its cells and faces do")
        }
        other => format!("{words} has the name of a result: that of a {}", say.kind(other)),
    }
}

/// The thresholds of a control for on and off, in K, in the wrong order.
pub(crate) fn crossed(words: &str, fields: [Field; 2], (on, off): (f64, f64)) -> String {
    let [on_key, off_key] = fields.map(Field::key);
    let celsius = |kelvin: f64| format_short(kelvin - ZERO_CELSIUS);
    if off.total_cmp(&on).is_eq() {
        return format!(
            "`{on_key}` and `{off_key}` of {words} are one temperature, {} degC",
            celsius(on)
        );
    }
    let (on, off) = (celsius(on), celsius(off));
    format!(
        "`{on_key}` and `{off_key}` of {words} are crossed over: on at {on} degC, off at {off} degC"
    )
}

pub(crate) fn in_unit(value: f64, field: Field) -> String {
    let dimension = match field {
        Field::Capacity => Dimension::CAPACITY,
        Field::Mass => Dimension::MASS,
        Field::Volume => Dimension::VOLUME,
        Field::Density => Dimension::DENSITY,
        Field::SpecificHeat => Dimension::SPECIFIC_HEAT,
        Field::Conductivity | Field::AxialConductivity => Dimension::CONDUCTIVITY,
        Field::Size | Field::CharacteristicLength | Field::Radius => Dimension::LENGTH,
        Field::Law(law) if !law.ty.absolute && !law.ty.is_scalar() => {
            let (unit, scale) = law.unit();
            return format!("{} {unit}", format_short(value / scale));
        }
        Field::LatentHeat => Dimension::SPECIFIC_ENERGY,
        Field::MinDwell => Dimension::TIME,
        Field::Sector => return format!("{} deg", format_short(value.to_degrees())),
        _ => return format_short(value),
    };
    format!("{} {}", format_short(value), dimension.si_unit())
}

/// A value that is not finite and more than zero.
pub(crate) fn above_zero(say: &Say<'_>, (item, field): (Item, Field), value: f64) -> String {
    let of = say.field(item, field);
    match value.is_finite() {
        true => format!("{of} must be more than zero, got {}", in_unit(value, field)),
        false => format!("{of} must be finite, got {value}"),
    }
}

pub(crate) fn not_positive(field: Field, value: f64) -> &'static str {
    let zero = value.abs() < f64::MIN_POSITIVE;
    match field {
        Field::Law(law) if !value.is_finite() => law.hints.infinite,
        _ if !value.is_finite() => "something is divided by zero, or a number is too large",
        Field::Law(law) if zero => law.hints.zero,
        Field::Law(law) => law.hints.negative,
        Field::Capacity if zero => "a node that stores nothing is `{ massless = true }`",
        Field::Capacity => "check the sign: a heat capacity is positive",
        Field::Mass
        | Field::Volume
        | Field::Density
        | Field::SpecificHeat
        | Field::AxialConductivity
        | Field::Conductivity => "a body has a mass, a volume and properties of more than zero",
        Field::Radius => "a circle has a radius of more than zero",
        Field::Size | Field::CharacteristicLength => "a body has dimensions of more than zero",
        Field::Fill => "a winding has a conductor: its share is above 0",
        Field::Sector => "leave `angle` out for the full circle, or give one above 0 deg",
        Field::Every => "give the time from one sample to the next, such as \"0.1 s\"",
        Field::LatentHeat => "melting takes up heat: give it as a positive number",
        _ => "check the sign: heat flows from the warm to the cold end, whichever is named first",
    }
}

/// Two radii in SI units of which the second must be the larger.
pub(crate) fn radii(
    say: &Say<'_>,
    (item, [small, large]): (Item, [Field; 2]),
    [inner, outer]: [f64; 2],
) -> String {
    format!(
        "{}, {}, must be larger than its `{}`, {}",
        say.field(item, large),
        in_unit(outer, large),
        small.key(),
        in_unit(inner, small)
    )
}

/// Help for two radii of which the second is not the larger.
pub(crate) fn other_radii([small, large]: [Field; 2], [inner, outer]: [f64; 2]) -> String {
    match inner <= outer {
        true => format!("a wall has a thickness: make `{}` larger", large.key()),
        false => format!("exchange `{}` and `{}`", small.key(), large.key()),
    }
}

/// An expression of a field that could not be evaluated.
pub(crate) fn not_evaluated(of: &str, error: &EvalError) -> String {
    match error {
        EvalError::NotFinite { value, .. } => {
            format!("{of} comes out as {value}, which is not finite")
        }
        _ => format!("{of}: {error}"),
    }
}

pub(crate) fn evaluation(error: &EvalError) -> Option<String> {
    let help = match error {
        EvalError::NotFinite { .. } => "something is divided by zero, or a number is too large",
        EvalError::NegativeBase { .. } => {
            "a negative number has no such power; use `abs(..)` if the sign does not count"
        }
        EvalError::Domain { .. } => "check the sign of its argument",
        EvalError::OutsideTable { .. } => return error.help(),
        _ => return None,
    };
    Some(help.to_owned())
}

/// A name that is like this one and can be used.
pub(crate) fn usable(name: &str) -> String {
    let letters = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let name: String = letters.collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() {
        format!("_{name}")
    } else {
        name
    }
}

/// "1 x 2": counts or lengths along the axes.
pub(crate) fn by(numbers: &[impl Display]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" x ")
}

/// "0.1 x 0.2 m = 0.02 m^2"
pub(crate) fn area(sides: [f64; 2]) -> String {
    let rounded = |value: f64| format!("{value:.9e}").parse().unwrap_or(value);
    format!("{} m = {} m^2", by(&sides.map(rounded)), rounded(sides[0] * sides[1]))
}

/// "`joint` joins `die.z0` to `plate.z1`, but …"
pub(crate) fn joins_but(say: &Say<'_>, [from, to]: &[String; 2], but: &str) -> String {
    format!("`{}` joins `{from}` to `{to}`, {but}", say.name)
}

/// The cells of two faces that are joined.
pub(crate) fn joins_cells(
    say: &Say<'_>,
    [from, to]: &[String; 2],
    [a, b]: &[[usize; 2]; 2],
) -> String {
    let (a, b) = (by(a), by(b));
    format!("`{}` joins `{from}` of {a} cells to `{to}` of {b} cells", say.name)
}

/// The lengths in m of two faces that are joined.
pub(crate) fn joins_sides(
    say: &Say<'_>,
    [from, to]: &[String; 2],
    [a, b]: &[[f64; 2]; 2],
) -> String {
    let (a, b) = (area(*a), area(*b));
    format!("`{}` joins `{from}`, {a}, to `{to}`, {b}", say.name)
}

/// The largest distance between the middles of two faces that overlap, in m.
pub(crate) fn most_offset(most: [f64; 2]) -> String {
    let [a, b] = most.map(|length| format_short(length * 1e3));
    format!(
        "`offset` is the distance between the middles of both: the faces overlap within {a} mm and \
         {b} mm"
    )
}

/// Help for faces that parameters cannot move.
pub(crate) fn most_pairs() -> String {
    "give `size` and `offset` as numbers, or fewer cells: a path that follows parameters has at \
     most 100000 pairs of cells, and `G` instead of `R`"
        .to_owned()
}

/// Help for a stream that ends at a face.
pub(crate) fn stream_help() -> Option<String> {
    let help = "let the stream pass a node, and join that to the face by a [convection]; one that \
        warms from row to row has `along` and `direction`";
    Some(help.to_owned())
}

/// A law of a whole part at the cells of a face.
pub(crate) fn whole_law(say: &Say<'_>, law: &str) -> String {
    format!("`{}` ends at a face, but the cells of a face cannot share a `{law}`", say.name)
}

pub(crate) fn whole_law_help() -> Option<String> {
    let help = "join the face to a massless node by a [contact], and this path to that node";
    Some(help.to_owned())
}

/// A path to a stream from something without its rows.
pub(crate) fn stream_rows(say: &Say<'_>, stream: &str, rows: usize) -> String {
    format!(
        "`{}` joins the stream `{stream}` to something else than a face with {rows} rows of cells \
         along it",
        say.name
    )
}

/// An area in m^2 that is not that of its face.
pub(crate) fn face_area(say: &Say<'_>, given: f64, (of, area): (&str, f64)) -> String {
    let [given, area] = [given, area].map(format_short);
    format!("the area of `{}`, {given} m^2, is not that of {of}, {area} m^2", say.name)
}

/// The keys of a law's fields.
pub(crate) fn keys(formula: Formula) -> String {
    let keys = formula.declaration().fields.iter().map(|field| format!("`{}`", field.key));
    keys.collect::<Vec<_>>().join(", ")
}
