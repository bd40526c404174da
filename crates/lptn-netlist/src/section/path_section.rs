//! The sections of paths and sources, as their kinds declare them.

use std::sync::LazyLock;

use lptn_laws::{FieldDeclaration, Formula, Kind, Substance};
use lptn_network::Context;
use lptn_units::{Type, format_number};

use crate::format::{KeyDeclaration, Role, SectionDeclaration, Takes, shaped, text, words};
use crate::section::direction::DIRECTION_OF;
use crate::section::keys::{AT, FLUID_OF, LUBRICANT_OF, MATERIAL_OF};
use crate::section::path_law::{count, counts, types};

/// A kind of path or source with the consequences of its declaration, found once for all paths.
pub(crate) struct PathSection {
    pub(crate) section: SectionDeclaration,
    pub(crate) kind: Kind,
    pub(super) groups: Vec<Group>,
    /// The keys that each group needs.
    pub(super) forms: Vec<&'static [&'static str]>,
    /// Its values, each key once.
    pub(super) values: Vec<PathValue>,
}

impl PathSection {
    /// The keys that each form of it needs.
    pub(crate) fn forms(&self) -> impl Iterator<Item = &[&'static str]> {
        self.forms.iter().copied()
    }

    /// The keys of its values.
    pub(super) fn values(&self) -> impl Iterator<Item = &'static str> {
        self.values.iter().map(|value| value.field.key)
    }
}

/// A value of a path.
pub(crate) struct PathValue {
    pub(crate) field: &'static FieldDeclaration,
    /// Least and largest number of values in a list; a single one needs no list.
    counts: [usize; 2],
    /// The permitted types, if its unit chooses the law.
    pub(super) types: Vec<(Type, Formula)>,
    /// The context of expressions in it: the ends of a path, or the node of a source.
    pub(super) context: Context,
    /// True if it belongs to a law that needs no name to choose it.
    pub(super) plain: bool,
}

impl PathValue {
    /// Least and largest number of its values, in the law that a word chose.
    pub(super) fn counts(&self, law: Option<Formula>) -> [usize; 2] {
        law.map_or(self.counts, |law| [count(law, self.field.key); 2])
    }
}

/// The sections of paths and of sources, in the order of their columns.
pub(crate) static PATHS: LazyLock<Vec<PathSection>> =
    LazyLock::new(|| Kind::ALL.iter().map(|kind| path_section(*kind)).collect());

fn path_section(kind: Kind) -> PathSection {
    let declared = kind.declaration();
    let value = |field: &'static FieldDeclaration| PathValue {
        field,
        counts: counts(kind, field.key),
        types: types(kind, field.key),
        context: if kind.is_source() { Context::Source } else { Context::Link },
        plain: kind.laws_named(false).any(|law| law.field(field.key).is_some()),
    };
    let values: Vec<PathValue> = kind.fields().into_iter().map(value).collect();
    let section = SectionDeclaration {
        name: declared.section,
        sentence: declared.sentence,
        role: Role::Element,
        keys: keys(kind, &values).leak(),
        either: &[],
        later: declared.later,
        example: declared.example,
        elsewhere: declared.elsewhere,
    };
    let groups = groups(kind);
    let forms = groups.iter().map(|group| &*group.keys.clone().leak()).collect();
    PathSection { section, kind, groups, forms, values }
}

/// The ends or the heated nodes, then its fields. Substances come before their properties, `fluid`
/// before a flow, and the key that chooses a law after the keys of all laws.
fn keys(kind: Kind, values: &[PathValue]) -> Vec<KeyDeclaration> {
    let mut keys = if kind.is_source() { vec![INTO] } else { ENDS.into() };
    if joins_faces(kind) {
        keys.extend(PLACE);
    }
    if kind == Kind::Advection {
        keys.extend(STREAM);
    }
    let first = kind.laws_named(true).next().map_or("", |law| law.declaration().name);
    let mut selector = kind.declaration().selector.map(|name| {
        let mut laws: Vec<&str> = Vec::new();
        for law in kind.laws().map(|law| law.declaration().name) {
            if !laws.contains(&law) {
                laws.push(law);
            }
        }
        words(name, laws.leak(), "the law", format!("\"{first}\"").leak())
    });
    for value in values {
        let field = value.field;
        let laws = || kind.laws().filter(|law| law.field(field.key).is_some());
        let chosen = |law: Formula| law.declaration().named;
        keys.extend(selector.take_if(|_| laws().all(chosen) && !laws().eq(kind.laws())));
        let of_fluid = laws().any(|law| law.declaration().carries.is_of_fluid());
        let substance = match field.property {
            _ if of_fluid => &[STREAMS][..],
            Some(Substance::Material) => &[MATERIAL_OF, DIRECTION_OF],
            Some(Substance::Fluid) => &[FLUID_OF],
            Some(Substance::Lubricant) => &[LUBRICANT_OF, AT],
            None => &[],
        };
        for new in substance {
            if keys.iter().all(|known| known.name != new.name) {
                keys.push(*new);
            }
        }
        keys.push(key_of(value));
    }
    keys.extend(selector);
    keys
}

/// A value of a law; several in a list if a law of the kind takes several.
fn key_of(value: &PathValue) -> KeyDeclaration {
    let field = value.field;
    let (unit, scale) = field.unit();
    let (one, said) = match value.types.iter().any(|(ty, _)| ty.is_scalar()) {
        true => (Takes::Number, "number"),
        false => (Takes::Quantity(""), &*unit.leak()),
    };
    let [least, most] = value.counts;
    let takes = match (least, most) {
        (_, 0 | 1) => one,
        (2.., _) => Takes::List(leak(one), most, most),
        _ => Takes::Either(vec![one, Takes::List(leak(one), most, most)].leak()),
    };
    let default = field.default.map_or(String::new(), |value| match one {
        Takes::Number => format_number(value),
        _ => format!("{} {said}", format_number(value / scale)),
    });
    shaped(field.key, said, takes, field.meaning, field.example).or(default.leak())
}

/// Makes a declaration last as long as the program.
fn leak(takes: Takes) -> &'static Takes {
    Box::leak(Box::new(takes))
}

/// The fluid of a stream.
const STREAMS: KeyDeclaration = text(
    "fluid",
    "name of a fluid",
    "the fluid that \
    flows",
    "\"water\"",
);

const END: &str = "name of a node or boundary";

const ENDS: [KeyDeclaration; 2] = [
    text("from", END, "the end that positive heat leaves", "\"name of a node or boundary\"")
        .needed(),
    text(
        "to",
        END,
        "the end that positive heat \
        enters",
        "\"name of another node or boundary\"",
    )
    .needed(),
];

/// The keys of the place of a face on another one.
pub(crate) const OFFSET: &str = "offset";
pub(crate) const AXES: &str = "axes";

const PLACE: [KeyDeclaration; 2] = [
    shaped(
        OFFSET,
        "list of two lengths",
        Takes::List(&Takes::Quantity("m"), 2, 2),
        "of two faces of blocks: from the middle of `to` to that of `from`, along the axes of `to`",
        "[\"5 mm\", \"-2 mm\"]",
    )
    .or("one middle"),
    shaped(
        AXES,
        "list of two axes",
        Takes::List(&Takes::Text, 2, 2),
        "of two faces of blocks: the axis of `to` along each axis of `from`, `\"-x\"` if it runs \
         against it",
        "[\"y\", \"-x\"]",
    )
    .or("in the order x, y, z"),
];

/// The keys of a stream along a face.
pub(crate) const ALONG: &str = "along";
pub(crate) const DIRECTION: &str = "direction";

const STREAM: [KeyDeclaration; 2] = [
    text(
        ALONG,
        "face of a grid",
        "a face along which the stream flows, row by row",
        "\"plate.z0\"",
    ),
    text(
        DIRECTION,
        "axis",
        "the axis along the face in which it flows, `\"-x\"` against it",
        "\"x\"",
    ),
];

/// True for paths that two faces may share in part.
pub(crate) fn joins_faces(kind: Kind) -> bool {
    matches!(kind, Kind::Contact | Kind::Resistor | Kind::Conduction | Kind::Convection)
}

const INTO: KeyDeclaration = shaped(
    "into",
    "name, or table of shares",
    Takes::Either(&[Takes::Text, Takes::Each(&Takes::Number)]),
    "the node, grid or face that is heated",
    "\"name of a node\"",
)
.needed();

/// Laws that begin with the same field, and the keys that all of them need.
pub(super) struct Group {
    pub(super) laws: Vec<Formula>,
    pub(super) keys: Vec<&'static str>,
}

fn required(law: Formula) -> Vec<&'static str> {
    let declared = law.declaration();
    let fluid = declared.carries.is_of_fluid().then_some("fluid");
    let fields =
        declared.fields.iter().filter(|field| field.default.is_none()).map(|field| field.key);
    let mut keys: Vec<&str> = fluid.into_iter().chain(fields).collect();
    keys.dedup();
    keys
}

fn groups(kind: Kind) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for law in kind.laws_named(false) {
        let (first, keys) = (law.declaration().fields[0].key, required(law));
        match groups.iter_mut().find(|group| group.laws[0].declaration().fields[0].key == first) {
            Some(group) => {
                group.laws.push(law);
                group.keys.retain(|key| keys.contains(key));
            }
            None => groups.push(Group { laws: vec![law], keys }),
        }
    }
    groups
}
