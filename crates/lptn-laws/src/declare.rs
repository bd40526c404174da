//! Declarations of kinds of paths and of laws. All that netlists, checks, documents and analyses
//! know of them follows from here.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
pub use crate::range::Range;

/// A law: its declaration and its formula.
pub trait Law {
    /// Its name, equation, fields, range of validity and source.
    const DECLARATION: LawDeclaration;

    /// Its value in SI units, with the meaning that [`LawDeclaration::carries`] gives.
    ///
    /// * `values`: one for each of its [fields](LawDeclaration::fields), in their order, in SI
    ///   units
    /// * `ends`: temperatures of `from` and `to` in K, which only laws with
    ///   [`LawDeclaration::reads_ends`] read; for results those of the hottest and the coldest node
    ///   that a source heats
    ///
    /// A formula checks nothing: the caller refuses values outside the ranges of the fields. Inside
    /// them, value and derivatives are finite.
    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S;

    /// The values of its [groups](LawDeclaration::groups) for these values and ends, in their
    /// order; `None` for one that does not apply there.
    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let _ = (values, ends);
        Vec::new()
    }

    /// Its results in addition to its heat, by the names that results have: `NAME.pressure`.
    const RESULTS: &'static [ResultDeclaration] = &[];

    /// Its [results](Law::RESULTS) for these values and ends, in SI units, in their order.
    fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
        let _ = (values, ends);
        Vec::new()
    }

    /// True if its [results](Law::RESULTS) judge anything for these values; without load no flank
    /// scuffs, however hot it is.
    fn judges(values: &[f64], ends: [f64; 2]) -> bool {
        let _ = (values, ends);
        true
    }

    /// The key of the capacity rate of a stream that leaves the law's device at `from`, so that
    /// streams must bring as much there; `None` if `from` is not an outlet.
    const OUTLET: Option<&'static str> = None;
}

/// The properties of a law.
#[derive(Debug)]
pub struct LawDeclaration {
    /// Its name in one word; if a key selects among the laws of a kind, the word for that. Among
    /// laws with the same word, the given keys select.
    pub name: &'static str,
    /// A description in one sentence.
    pub sentence: &'static str,
    /// The equation in text.
    pub equation: &'static str,
    /// The kinds of path or source that obey it.
    pub kinds: &'static [Kind],
    /// True if its name selects it, by the [selector](KindDeclaration::selector) of its kinds;
    /// otherwise its fields do.
    pub named: bool,
    /// Its fields. Two in a row with one key are given as a list of two.
    pub fields: &'static [FieldDeclaration],
    /// The meaning of its formula's value.
    pub carries: Carries,
    /// True if its value depends on the temperatures of the ends even if all fields are constant.
    pub reads_ends: bool,
    /// The form of its value in its fields, as far as it determines if heat rises with temperature.
    pub form: Form,
    /// Pairs of keys; the value of the first has to be smaller.
    pub ordered: &'static [[&'static str; 2]],
    /// The keys whose product is the area of its surface; the first is the area itself.
    pub area: &'static [&'static str],
    /// The field to divide if the path becomes equal parallel ones.
    pub extent: Extent,
    /// Keys of other laws of its kinds that have no effect on it, and results that it does not
    /// have, with the reason.
    pub idle: &'static [(&'static str, &'static str)],
    /// Its range of validity, apart from the numbers.
    pub validity: &'static str,
    /// The numbers that limit its validity; [`Law::groups`] gives their values.
    pub groups: &'static [Group],
    /// Its publication.
    pub source: &'static str,
    /// Confidence in its formula and constants.
    pub confidence: Confidence,
}

/// The meaning of a law's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carries {
    /// A conductance G in W/K: q = G (T_from - T_to).
    Conductance,
    /// An exchange area Gr in m^2: q = sigma Gr (T_from^4 - T_to^4).
    Radiation,
    /// A capacity rate in W/K of a stream from `from` to `to`, one way.
    CapacityRate,
    /// A mass flow in kg/s of a fluid.
    MassFlow,
    /// A volume flow in m^3/s of a fluid, measured at the temperature that the field of this key
    /// gives.
    VolumeFlow(&'static str),
    /// A heat in W, positive into the nodes that it heats: not a path, but a source.
    Heat,
}

impl Carries {
    /// True if it is a stream, whose heat goes one way.
    pub fn is_stream(self) -> bool {
        !matches!(self, Self::Conductance | Self::Radiation | Self::Heat)
    }

    /// True if it needs a fluid.
    pub fn is_of_fluid(self) -> bool {
        matches!(self, Self::MassFlow | Self::VolumeFlow(_))
    }
}

/// The form of a value in its fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// It is their product.
    Product,
    /// It is the reciprocal of the only one.
    Reciprocal,
    /// In another way.
    Other,
}

/// The division of a path into equal parallel ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Each has a part of the fields with these keys.
    Divided(&'static [&'static str]),
    /// Each has a multiple of the field with this key.
    Multiplied(&'static str),
    /// It cannot be divided.
    Whole,
}

/// A number that limits the validity of a law, usually a dimensionless one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group {
    /// Its symbol: `Ra`.
    pub name: &'static str,
    /// Its name in words, and its unit if it has one: `Rayleigh number`.
    pub meaning: &'static str,
    /// The smallest value for which the law is known.
    pub from: f64,
    /// The largest.
    pub to: f64,
}

impl Group {
    /// True if a value is inside; NaN is not.
    pub fn contains(&self, value: f64) -> bool {
        (self.from..=self.to).contains(&value)
    }
}

/// A result of a law in addition to its heat.
#[derive(Clone, Copy, Debug)]
pub struct ResultDeclaration {
    /// The ending of its name: `pressure` of `ring_fit.pressure`.
    pub key: &'static str,
    /// Its dimension; a temperature is a difference.
    pub ty: Type,
    /// Its meaning in a few words.
    pub meaning: &'static str,
    /// The reason for a missing number, as the end of a sentence; empty if there always is one.
    pub missing: &'static str,
}

/// Confidence in a formula and its constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confidence {
    /// Read in the source and checked against its numbers.
    High,
    /// Constants that were not read in the primary source.
    Medium,
}

/// A value that a law takes.
#[derive(Clone, Copy, Debug)]
pub struct FieldDeclaration {
    /// Its key in a netlist.
    pub key: &'static str,
    /// Its type: a dimension, or an absolute temperature.
    pub ty: Type,
    /// The numbers that it may be.
    pub range: Range,
    /// Its default; `None` if it must be given.
    pub default: Option<f64>,
    /// Its meaning in a few words.
    pub meaning: &'static str,
    /// The right side of the key in a netlist, as an example.
    pub example: &'static str,
    /// Help for a number outside its range.
    pub hints: Hints,
    /// Words that may replace it, with the expressions that they mean; `OIL` in them is the
    /// lubricant.
    pub words: &'static [(&'static str, &'static str)],
    /// The kind of substance whose property it is, if any: a material, fluid or lubricant may be
    /// named instead. The expression of a path may then read `T`, the mean temperature of the ends.
    pub property: Option<Substance>,
    /// True for the conductivity of a body through which heat flows from one end to the other: its
    /// mean over the temperatures between the ends applies.
    pub along: bool,
}

lptn_units::words! {
/// A kind of substance with properties, by the key that names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Substance {
    /// `material`: of a body.
    Material = "material",
    /// `fluid`: on a surface.
    Fluid = "fluid",
    /// `lubricant`: of a loss.
    Lubricant = "lubricant",
}
/// The key that names it.
pub fn key;
}

impl FieldDeclaration {
    /// A value above 0.
    pub const fn new(
        key: &'static str,
        ty: Type,
        meaning: &'static str,
        example: &'static str,
    ) -> Self {
        let (range, hints) = (Range::Positive, Hints::SIGN);
        Self {
            key,
            ty,
            range,
            default: None,
            meaning,
            example,
            hints,
            words: &[],
            property: None,
            along: false,
        }
    }

    /// A length or an area of a body.
    pub const fn measure(
        key: &'static str,
        ty: Type,
        meaning: &'static str,
        example: &'static str,
    ) -> Self {
        Self { hints: Hints::MEASURE, ..Self::new(key, ty, meaning, example) }
    }

    /// A plain number from a catalogue or a drawing, above 0.
    pub const fn given(key: &'static str, meaning: &'static str, example: &'static str) -> Self {
        Self { hints: Hints::GIVEN, ..Self::new(key, Type::SCALAR, meaning, example) }
    }

    /// The unit to write it in, and the size of that in SI units: an angle in degrees.
    pub fn unit(&self) -> (String, f64) {
        match self.ty {
            ty if ty == Type::of(Dimension::ANGLE) => ("deg".to_owned(), PI / 180.0),
            ty => (ty.usual_unit(), 1.0),
        }
    }

    /// The same with this default.
    pub const fn or(self, default: f64) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The same as a count: whole, at least 1.
    pub const fn counted(self) -> Self {
        Self { range: Range::Count, ..self }
    }

    /// The same angle, between these degrees.
    pub const fn degrees(self, from: i16, to: i16) -> Self {
        Self { range: Range::Degrees(from, to), ..self }
    }

    /// The same that may be 0.
    pub const fn from_zero(self) -> Self {
        Self { range: Range::NotNegative, ..self }
    }

    /// The same that may have either sign.
    pub const fn signed(self) -> Self {
        Self { range: Range::Finite, ..self }
    }
}

/// Help for a number that is not above 0.
#[derive(Clone, Copy, Debug)]
pub struct Hints {
    /// It is 0.
    pub zero: &'static str,
    /// It is negative.
    pub negative: &'static str,
    /// It is not finite.
    pub infinite: &'static str,
}

impl Hints {
    /// For a value whose sign may be wrong.
    pub const SIGN: Self = Self {
        zero: "check the sign: heat flows from the warm to the cold end, whichever is named first",
        negative: "check the sign: heat flows from the warm to the cold end, whichever is named \
            first",
        infinite: "something is divided by zero, or a number is too large",
    };
    /// For a value that carries the more heat the larger it is.
    pub const CONDUCTS: Self =
        Self { zero: "leave the path out if no heat flows through it", ..Self::SIGN };
    /// For a value that carries the less heat the larger it is.
    pub const RESISTS: Self = Self {
        zero: "two places without resistance between them are one node: make them one",
        infinite: "leave the path out if no heat flows through it",
        ..Self::SIGN
    };
    /// For a dimension of a body.
    pub const MEASURE: Self = Self {
        zero: "a body has dimensions of more than zero",
        negative: "a body has dimensions of more than zero",
        ..Self::SIGN
    };
    /// For a number that a catalogue or a drawing gives.
    pub const GIVEN: Self = Self {
        zero: "the catalogue or the drawing has a number of more than zero",
        negative: "the catalogue or the drawing has a number of more than zero",
        ..Self::SIGN
    };
    /// For a property of a fluid.
    pub const FLUID: Self = Self {
        zero: "a fluid has properties of more than zero",
        negative: "a fluid has properties of more than zero",
        ..Self::SIGN
    };
    /// For a property of a body.
    pub const PROPERTY: Self = Self {
        zero: "a body has a mass, a volume and properties of more than zero",
        negative: "a body has a mass, a volume and properties of more than zero",
        ..Self::SIGN
    };
}

/// The properties of a kind of path or source: a section of the netlist.
#[derive(Debug)]
pub struct KindDeclaration {
    /// The section, which is also the word for an element of it.
    pub section: &'static str,
    /// A description in one sentence.
    pub sentence: &'static str,
    /// The key whose word selects among its [named](LawDeclaration::named) laws.
    pub selector: Option<&'static str>,
    /// The right side of an element of it, for help.
    pub example: &'static str,
    /// Keys that belong elsewhere, with what to write instead.
    pub elsewhere: &'static [(&'static str, &'static str)],
    /// Keys that are decided but not supported yet.
    pub later: &'static [&'static str],
    /// The kind of surface of a body, if it is one.
    pub surface: Option<SurfaceKind>,
}

/// The way in which a surface of a body gives off heat. A surface that convects also radiates:
/// their areas are the same skin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceKind {
    /// It convects.
    Wetted,
    /// It touches another body.
    Touching,
    /// It radiates.
    Seen,
}
