//! Points of curves: lists of quantities or numbers in a netlist, columns of a CSV file.

use std::sync::Arc;

use lptn_data::{CsvFile, Diagnostic, PlacedNumbers, Places, fit};
use lptn_units::{Expression, TableError, Type, Unit, parse_quantity, written_quantity};

use crate::csv_form;
use crate::fields::{Fields, wrong_shape};
use crate::place::Place;
use crate::raw::{RawKind, RawValue};
use crate::work::Elaboration;

/// The keys of one axis: the list or column, and the unit of plain numbers.
#[derive(Clone, Copy)]
pub(crate) struct Axis<'k> {
    pub(crate) list: &'k str,
    pub(crate) unit: &'k str,
    /// The key that names a column of a CSV file.
    pub(crate) column: &'k str,
    /// Its type, if known.
    pub(crate) ty: Option<Type>,
}

/// The warning about a temperature over time that is far from its neighbours.
fn outlying(fields: &Fields<'_>, points: &PlacedNumbers) -> Option<Diagnostic> {
    let (first, text) = points.ty.absolute.then(|| points.outlying())??;
    let message = format!("{} {text}", fields.owner.words());
    let help = "a broken wire, or a digit lost? correct the cell, or remove its row";
    let warning = Diagnostic::warning("netlist::csv_outlier", message);
    Some(warning.at(points.place(first), "").help(help))
}

impl<'a> Elaboration<'a> {
    /// The points of a curve, from lists or from a CSV file.
    pub(crate) fn curve(
        &mut self,
        fields: &Fields<'a>,
        axes: [Axis<'_>; 2],
    ) -> Option<[PlacedNumbers; 2]> {
        let [x, y] = axes;
        if fields.get("csv").is_none() {
            self.refuse_keys(fields, &["time", "value"], "names a column, but there is no `csv`");
            self.refuse_keys(fields, &csv_form::KEYS, "is about a CSV file, but there is no `csv`");
            let (x, y) = (self.points(fields, x), self.points(fields, y));
            return Some([x?, y?]);
        }
        let lists = [x.list, y.list].into_iter().filter(|key| *key != x.column && *key != y.column);
        let mut keys: Vec<&str> = lists.collect();
        keys.extend([x.unit, y.unit]);
        self.refuse_keys(fields, &keys, "is for lists, but the points come from a CSV file");
        let file = self.csv_file(fields);
        let names = [x, y].map(|axis| self.column_name(fields, axis.column));
        let file = file?;
        self.problems.extend(file.note(names[0].map(|(name, _)| name)));
        let timed = x.column == "time";
        let [x, y] = [(x, names[0]), (y, names[1])]
            .map(|(axis, name)| self.column(fields, &file, axis, name));
        let (x, y) = (x?, y?);
        self.problems.extend(outlying(fields, &y).filter(|_| timed));
        Some([x, y])
    }

    /// The file that `csv` names.
    pub(crate) fn csv_file(&mut self, fields: &Fields<'a>) -> Option<Arc<CsvFile>> {
        let (_, raw) = self.word(fields, "csv")?;
        self.check_form(fields);
        let file = self.csv.get(raw)?;
        self.kept(file)
    }

    /// Reports wrong statements about the form of the file.
    pub(crate) fn check_form(&mut self, fields: &Fields<'a>) {
        for wrong in csv_form::options(fields.table()).1 {
            let problem = wrong.told(&fields.owner);
            self.report(problem);
        }
    }

    /// The name of a column.
    pub(crate) fn column_name(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
    ) -> Option<(&'a str, &'a RawValue)> {
        let raw = fields.get(key);
        if raw.is_none() && fields.complete {
            let message = format!("{} has no `{key}`", fields.owner.words());
            let help = format!("name the column: `{key} = \"name of the column\"`");
            self.report(fields.missing(key, message).help(help));
        }
        let raw = raw?;
        match &raw.kind {
            RawKind::String { text, .. } => Some((text, raw)),
            _ => {
                let example = format!("{key} = \"name of the column\"");
                self.report(wrong_shape(
                    &fields.owner.field(key),
                    raw,
                    "the name of a column",
                    &example,
                ));
                None
            }
        }
    }

    /// The numbers of a column.
    pub(crate) fn column(
        &mut self,
        fields: &Fields<'a>,
        file: &Arc<CsvFile>,
        axis: Axis<'_>,
        name: Option<(&str, &RawValue)>,
    ) -> Option<PlacedNumbers> {
        let (name, raw) = name?;
        let place = Place { owner: &fields.owner, key: axis.column, raw };
        let points = match axis.column {
            "time" => file.times(name, &place.asked()),
            _ => file.column(name, axis.ty, &place.asked()),
        };
        points.map_err(|problems| self.problems.extend(problems)).ok()
    }

    fn points(&mut self, fields: &Fields<'a>, axis: Axis<'_>) -> Option<PlacedNumbers> {
        let raw = self.require(fields, axis.list);
        let unit = fields.get(axis.unit).map(|raw| self.unit(fields, axis, raw));
        let raw = raw?;
        let place = Place { owner: &fields.owner, key: axis.list, raw };
        let RawKind::Array(items) = &raw.kind else {
            self.report(fields.wrong_shape(axis.list, raw, "a list"));
            return None;
        };
        let unit = match unit {
            None => None,
            Some(unit) => Some(unit?),
        };
        let ty = axis.ty.or(unit.as_ref().map(|unit| unit.ty));
        let (mut numbers, mut places) = (Vec::new(), Vec::new());
        let mut of = ty.unwrap_or(Type::SCALAR);
        let before = self.problems.len();
        for (n, item) in items.iter().enumerate() {
            let known = ty.or((n > 0).then_some(of));
            match self.point((place, item), unit.as_ref(), (axis, known)) {
                Some((number, found)) => {
                    of = known.unwrap_or(found);
                    numbers.push(number);
                    places.push(item.span.clone());
                }
                None if n == 0 && ty.is_none() => return None, // the others cannot be judged
                None => {}
            }
        }
        let (places, whole) = (Places::Items(places), raw.span.clone());
        let unit = unit.or_else(|| first_unit(items));
        let points = PlacedNumbers { numbers, ty: of, places, whole, unit };
        (self.problems.len() == before).then_some(points)
    }

    /// One item of a list in SI units, and its type.
    fn point(
        &mut self,
        (list, item): (Place<'_>, &RawValue),
        unit: Option<&Unit>,
        (axis, known): (Axis<'_>, Option<Type>),
    ) -> Option<(f64, Type)> {
        let place = Place { raw: item, ..list };
        let problem = match (&item.kind, unit) {
            (RawKind::Integer(number) | RawKind::Float(number), Some(unit)) => {
                match parse_quantity(number, Some(Type::SCALAR)) {
                    Ok(quantity) if unit.ty.absolute && unit.to_si(quantity.value) < 0.0 => {
                        cold(place)
                    }
                    Ok(quantity) => return Some((unit.to_si(quantity.value), unit.ty)),
                    Err(error) => place.unit_error(&error),
                }
            }
            (RawKind::Integer(number) | RawKind::Float(number), None) => {
                match parse_quantity(number, Some(Type::SCALAR)) {
                    Ok(quantity) if known.is_none_or(|ty| ty.is_scalar()) => {
                        return Some((quantity.value, Type::SCALAR));
                    }
                    Ok(_) if axis.ty.is_none() => mixed(place, axis, (known, Type::SCALAR)),
                    Ok(_) => no_unit(place, axis, known.unwrap_or(Type::SCALAR)),
                    Err(error) => place.unit_error(&error),
                }
            }
            (RawKind::String { .. }, Some(_)) => two_units(place, axis),
            (RawKind::String { text, .. }, None) => match parse_quantity(text, known) {
                Ok(quantity) => return Some((quantity.value, quantity.ty)),
                Err(_) if is_expression(text) => not_constant(place),
                Err(error) => match parse_quantity(text, None) {
                    Ok(quantity) if axis.ty.is_none() => mixed(place, axis, (known, quantity.ty)),
                    _ => place.unit_error(&error),
                },
            },
            _ => {
                let wanted = "a list of quantities or numbers";
                wrong_shape(&list.words(), item, wanted, &list.owner.sample(axis.list))
            }
        };
        self.report(problem);
        None
    }

    /// The unit of plain numbers.
    fn unit(&mut self, fields: &Fields<'a>, axis: Axis<'_>, raw: &'a RawValue) -> Option<Unit> {
        let text = fields.text(axis.unit, raw, &mut self.problems)?;
        let place = Place { owner: &fields.owner, key: axis.unit, raw };
        let problem = match Unit::parse(text) {
            Err(error) => place.unit_error(&error),
            Ok(unit) => match fit(unit, axis.ty) {
                Ok(unit) => return Some(unit),
                Err((wanted, found)) => {
                    let message = format!(
                        "{} must be {}, got {}",
                        place.words(),
                        wanted.with_article(),
                        found.with_article()
                    );
                    let example = format!("{} = \"{}\"", axis.unit, wanted.usual_unit());
                    Diagnostic::wrong(
                        "units::dimension",
                        message,
                        &raw.span,
                        format!("write it like this: `{example}`"),
                    )
                }
            },
        };
        self.report(problem);
        None
    }

    /// Reports the error in the points of a curve, at its place; `arguments` names the values that
    /// have to rise.
    pub(crate) fn report_points(
        &mut self,
        fields: &Fields<'a>,
        (x, y): (&PlacedNumbers, &PlacedNumbers),
        (arguments, error): (&str, &TableError),
    ) {
        let words = fields.owner.words();
        let at_list = |message: String| {
            Diagnostic::error(error.code(), message)
                .at(y.whole.clone(), "")
                .also(fields.place.clone(), "read here")
        };
        let problem = match error {
            TableError::NotIncreasing { index } => rising(&words, arguments, x, *index)
                .also(fields.place.clone(), "read here")
                .help("sort the points by their argument, each argument once"),
            TableError::TooShort => at_list(format!("{words} needs two points or more"))
                .help("a value that never changes is a parameter"),
            TableError::LengthsDiffer => {
                let (n, m) = (x.numbers.len(), y.numbers.len());
                at_list(format!("{words} has {n} arguments but {m} values"))
                    .help("give one value for each")
            }
            other => at_list(format!("{words}: {other}")).help(other.help()),
        };
        self.report(problem);
    }
}

/// The unit of the first of some quantities.
fn first_unit(items: &[RawValue]) -> Option<Unit> {
    match &items.first()?.kind {
        RawKind::String { text, .. } => written_quantity(text).map(|written| written.unit),
        _ => None,
    }
}

fn rising(words: &str, arguments: &str, x: &PlacedNumbers, index: usize) -> Diagnostic {
    let repeated = x.numbers[index] >= x.numbers[index - 1];
    let says = if repeated {
        "the same value appears \
            twice"
    } else {
        "this one is below the one before it"
    };
    Diagnostic::error(
        TableError::NotIncreasing { index }.code(),
        format!("{arguments} of {words} must rise, but {says}"),
    )
    .at(x.place(index), if repeated { "again" } else { "falls" })
    .also(x.place(index - 1), "the one before it")
}

fn cold(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "units::below_absolute_zero",
        format!("{} goes below absolute zero", place.words()),
        &place.raw.span,
        "0 K is -273.15 degC",
    )
}

fn no_unit(place: Place<'_>, axis: Axis<'_>, ty: Type) -> Diagnostic {
    let unit = ty.usual_unit();
    Diagnostic::wrong(
        "units::bare_number",
        format!("{} must be {}, got a plain number", place.words(), ty.with_article()),
        &place.raw.span,
        format!("give the unit once for the whole list: `{} = \"{unit}\"`", axis.unit),
    )
}

/// Error for a list with items of two types.
fn mixed(place: Place<'_>, axis: Axis<'_>, (first, found): (Option<Type>, Type)) -> Diagnostic {
    let first = first.unwrap_or(Type::SCALAR);
    let message = format!(
        "{} begins with {}, but this is {}",
        place.words(),
        first.with_article(),
        found.with_article()
    );
    let problem = Diagnostic::error("netlist::mixed_list", message).at(place.raw.span.clone(), "");
    match first.is_scalar() || found.is_scalar() {
        true => problem.help(format!(
            "give every value its unit in quotes, or none: `{}` then gives the unit of all",
            axis.unit
        )),
        false => problem.help(
            "a list contains values of one kind; `min` and `h` may be in one list, `W` and `J` not",
        ),
    }
}

fn two_units(place: Place<'_>, axis: Axis<'_>) -> Diagnostic {
    let message =
        format!("{} contains a string, but `{}` is for plain numbers", place.words(), axis.unit);
    Diagnostic::wrong(
        "netlist::two_units",
        message,
        &place.raw.span,
        format!(
            "write the number without quotes and unit, or remove `{}` and give every number its \
             unit",
            axis.unit
        ),
    )
}

fn is_expression(text: &str) -> bool {
    Expression::parse(text).is_ok_and(|e| !(e.names().is_empty() && e.calls().is_empty()))
}

fn not_constant(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::point_not_constant",
        format!("{} contains an expression", place.words()),
        &place.raw.span,
        "points are numbers or quantities; multiply the curve when it is used: `scale * name(x)`",
    )
}
