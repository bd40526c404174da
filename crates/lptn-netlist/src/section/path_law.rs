//! The law of a path that its values choose, and errors if they choose none.

use lptn_data::Diagnostic;
use lptn_laws::{FieldDeclaration, Formula, Kind};
use lptn_network::Input;
use lptn_units::Type;
use smallvec::SmallVec;

use crate::fields::Fields;
use crate::raw::RawValue;

/// The values of a field: none, one, or those of a list.
pub(super) type Values = SmallVec<[Input; 1]>;

/// A field with its values.
pub(super) type Read = (&'static FieldDeclaration, Values);

/// The least and the largest number of values of a key in laws of a kind that take it.
pub(super) fn counts(kind: Kind, key: &str) -> [usize; 2] {
    let counts = || kind.laws().map(|law| count(law, key)).filter(|count| *count > 0);
    [counts().min().unwrap_or(1), counts().max().unwrap_or(1)]
}

/// Number of values of a key in a law.
pub(super) fn count(law: Formula, key: &str) -> usize {
    law.declaration().fields.iter().filter(|field| field.key == key).count()
}

/// The types of a key in the laws of a kind, if its unit chooses the law.
pub(super) fn types(kind: Kind, key: &str) -> Vec<(Type, Formula)> {
    let mut types: Vec<(Type, Formula)> = Vec::new();
    for law in kind.laws() {
        if let Some(field) =
            law.field(key).filter(|field| types.iter().all(|(ty, _)| *ty != field.ty))
        {
            types.push((field.ty, law));
        }
    }
    types
}

/// `a slab`, `an upper_side`
pub(super) fn with_article(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {name}")
}

/// The law of a group that takes these numbers and types of values.
pub(super) fn of_values(laws: &[Formula], read: &[Read]) -> Option<Formula> {
    let fits = |law: &&Formula| {
        read.iter().all(|(field, values)| match count(**law, field.key) {
            0 => true,
            most => {
                let own = law.declaration().fields.iter().filter(|own| own.key == field.key);
                let mut pairs = own.zip(values);
                most == values.len() && pairs.all(|(own, value)| value.ty().conforms_to(own.ty))
            }
        })
    };
    laws.iter().find(fits).copied()
}

/// `flow = "3 L/min"` with `flow_T = "20 degC"`
pub(super) fn written(law: Formula) -> String {
    let fields = law.declaration().fields.iter();
    let all: Vec<String> =
        fields.map(|field| format!("`{} = {}`", field.key, field.example)).collect();
    all.join(" with ")
}

/// Error for a wrong number of values of a key that takes a list in every law of its kind.
pub(super) fn not_a_list(
    fields: &Fields<'_>,
    (field, most): (&FieldDeclaration, usize),
    raw: &RawValue,
    count: usize,
) -> Diagnostic {
    let values = if count == 1 { "one value".to_owned() } else { format!("{count} values") };
    let message = format!("{} has {values} instead of {most}", fields.owner.field(field.key));
    let list = vec![field.example; most].join(", ");
    let each = if most == 2 { "one for `from`, one for `to`" } else { "one for each" };
    let help = format!("write a list, {each}: `{} = [{list}]`", field.key);
    Diagnostic::wrong("netlist::list_of_values", message, &raw.span, help)
}

pub(super) fn wrong_count(
    fields: &Fields<'_>,
    (field, most): (&FieldDeclaration, usize),
    raw: &RawValue,
    count: usize,
) -> Diagnostic {
    let message = format!("{} has {count} values", fields.owner.field(field.key));
    let laws = Formula::ALL.iter().filter(|law| {
        law.declaration().fields.iter().filter(|own| own.key == field.key).count() == most
    });
    let of = laws.map(|law| law.declaration().name.replace('_', " ")).next().unwrap_or_default();
    let list = vec![field.example; most].join(", ");
    let count_of_list = if most == 2 { "two".to_owned() } else { most.to_string() };
    Diagnostic::wrong(
        "netlist::emissivities",
        message,
        &raw.span,
        format!(
            "give one for the exchange as a whole, `{}`, or {count_of_list} for {of}, `{} = \
             [{list}]`",
            fields.sample(field.key),
            field.key
        ),
    )
}

pub(super) fn without(fields: &Fields<'_>, law: Formula, key: &str) -> Diagnostic {
    let first = law.declaration().fields[0];
    let is = first.ty.with_article();
    let message = format!("{} is {is} without `{key}`", fields.owner.field(first.key));
    let span = fields.get(first.key).map_or(fields.place, |raw| &raw.span);
    let meaning = law.field(key).map_or("", |field| field.meaning);
    let others: Vec<String> = types(law.declaration().kinds[0], first.key)
        .iter()
        .filter(|(ty, _)| *ty != first.ty)
        .map(|(ty, _)| ty.with_article())
        .collect();
    Diagnostic::wrong(
        "netlist::flow_temperature",
        message,
        span,
        format!("give the {meaning}, `{}`, or {}", fields.sample(key), others.join(" or ")),
    )
}
