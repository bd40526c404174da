//! Mistakes in the call of a table.

use std::ops::Range;

use super::fix::Source;
use super::function;
use super::scope::Scope;
use super::tree::{Id, Node};
use crate::error::{UnitError, UnitErrorKind as Kind};
use crate::suggest::suggest;
use crate::table::TableSymbol;
use crate::types::Type;

/// A table and its name.
type Named<'a> = (&'a str, &'a TableSymbol);

/// A name that is called but is not a table: a parameter, or an unknown name.
pub(super) fn no_table(source: &Source<'_>, scope: &dyn Scope, id: Id) -> UnitError {
    let Node::Call { function: name, name_span, arguments } = source.tree.node(id) else {
        return UnitError::new(Kind::Empty, source.tree.span(id));
    };
    if scope.symbol(name).is_some() || name == "pi" {
        let kind =
            Kind::NotATable { name: name.clone(), fix: uncalled(source, id, name, arguments) };
        return UnitError::new(kind, name_span.clone());
    }
    let known: Vec<String> =
        function::names().map(str::to_owned).chain(scope.table_names()).collect();
    let suggestion = suggest(name, known.iter().map(String::as_str)).map(str::to_owned);
    UnitError::new(Kind::UnknownFunction { name: name.clone(), suggestion }, name_span.clone())
}

/// A table with a similar name, as a call.
pub(super) fn near_table(scope: &dyn Scope, name: &str) -> Option<String> {
    let tables = scope.table_names();
    suggest(name, tables.iter().map(String::as_str)).map(|table| format!("{table}(..)"))
}

/// `P(x + 1)` was meant to be `P * (x + 1)`.
fn uncalled(source: &Source<'_>, id: Id, name: &str, arguments: &[Id]) -> String {
    let &[argument] = arguments else { return source.replace(id, name) };
    let product = format!("{name} * {}", source.factor(argument));
    let whole = id == source.tree.root();
    source.replace(id, &if whole { product } else { format!("({product})") })
}

/// A table with too many or too few arguments, or with none and without brackets. Given arguments
/// of the right types are kept; names in scope replace the missing ones.
pub(super) fn wrong_arity(
    source: &Source<'_>,
    scope: &dyn Scope,
    table: Named<'_>,
    given: (Range<usize>, &[(Id, Option<Type>)]),
) -> UnitError {
    let (name, symbol) = table;
    let (span, arguments) = given;
    let wanted: Vec<Type> =
        (0..symbol.table.dimension()).map(|index| symbol.argument(index)).collect();
    let names = scope.names();
    let of_type =
        |ty: Type| names.iter().find(|name| scope.symbol(name).is_some_and(|s| s.ty == ty));
    let texts: Option<Vec<&str>> = wanted
        .iter()
        .enumerate()
        .map(|(index, ty)| match arguments.get(index) {
            Some((id, Some(found))) if found.conforms_to(*ty) => Some(source.text_of(*id)),
            Some(_) => None,
            None => of_type(*ty).map(String::as_str),
        })
        .collect();
    let call = texts.map(|texts| format!("{name}({})", texts.join(", ")));
    let fix = call.map(|call| super::lexer::splice(source.text, &span, &call));
    UnitError::new(
        Kind::TableArity { table: name.to_owned(), wanted, found: arguments.len(), fix },
        span,
    )
}

/// One argument against its type.
pub(super) fn argument(
    source: &Source<'_>,
    table: Named<'_>,
    argument: usize,
    given: (Id, Type),
) -> Result<(), UnitError> {
    let ((name, symbol), (id, found)) = (table, given);
    let wanted = symbol.argument(argument);
    if found.conforms_to(wanted) {
        return Ok(());
    }
    let fix = source.converted(id, found, wanted);
    let (wanted, found) = (Box::new(wanted), Box::new(found));
    let kind = Kind::TableArgument { table: name.to_owned(), argument, wanted, found, fix };
    Err(UnitError::new(kind, source.tree.span(id)))
}
