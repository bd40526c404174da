//! `csv = ["a.csv", "b.csv"]` of a table: a curve for each of several numbered parts.

use std::sync::Arc;

use lptn_data::{Diagnostic, PlacedNumbers};
use lptn_units::{Interpolation, LookupTable, Outside, Table1, Table2, TableSymbol, Type};

use crate::fields::Fields;
use crate::points::Axis;
use crate::raw::{RawKind, RawValue};
use crate::section::table::{INTERPOLATIONS, OUTSIDE, units};
use crate::work::Elaboration;

/// A curve, and the points it was made from.
type Curve = (Table1, [PlacedNumbers; 2]);

impl<'a> Elaboration<'a> {
    /// A table over the number of a file, from 1, and over the argument of the files.
    pub(super) fn curves_of_files(&mut self, fields: &Fields<'a>) -> Option<TableSymbol> {
        let keys = ["y", "x_unit", "y_unit"];
        self.refuse_keys(fields, &keys, "does not belong to curves from several files");
        let outside = self.straight(fields);
        let raw = fields.get("csv")?;
        let RawKind::Array(files) = &raw.kind else { return None };
        if files.len() < 2 || files.iter().any(|file| !matches!(file.kind, RawKind::String { .. }))
        {
            self.report(fields.wrong_shape("csv", raw, "a CSV file, or a list of two or more"));
            return None;
        }
        let names = ["x", "value"].map(|key| self.column_name(fields, key));
        let names = [names[0]?, names[1]?];
        self.check_form(fields);
        let (mut curves, mut types): (Vec<Curve>, _) = (Vec::new(), [None, None]);
        let mut complete = true;
        for file in files {
            match self.curve_of_file(fields, file, (names, types)) {
                Some(curve) => {
                    types = curve.1.each_ref().map(|points| Some(points.ty));
                    curves.push(curve);
                }
                None => complete = false,
            }
        }
        let outside = outside.filter(|_| complete)?;
        let Some(knots) = knots(&curves, outside) else {
            let message =
                format!("the curves of {} have no arguments in common", fields.owner.words());
            let help = "give each curve the same range, or write `outside = \"hold\"`";
            self.refuse("netlist::curves_apart", message, &raw.span, help);
            return None;
        };
        let value = |curve: &Curve, at: f64| curve.0.value_and_slope(at).map(|(value, _)| value);
        let values: Option<Vec<f64>> =
            curves.iter().flat_map(|curve| knots.iter().map(move |at| value(curve, *at))).collect();
        let numbers = (1..).map(f64::from).take(curves.len()).collect();
        let table = Table2::new(numbers, knots, values?, outside).ok()?;
        let [x, y] = &curves.first()?.1;
        let number = lptn_units::Unit::parse("1").ok();
        let of = units([x, y]);
        let units = number.filter(|_| !of.is_empty()).into_iter().chain(of).collect();
        let table = Arc::new(LookupTable::Two(table));
        Some(TableSymbol { table, arguments: vec![Type::SCALAR, x.ty], ty: y.ty, units })
    }

    fn curve_of_file(
        &mut self,
        fields: &Fields<'a>,
        file: &'a RawValue,
        (names, types): ([(&'a str, &'a RawValue); 2], [Option<Type>; 2]),
    ) -> Option<Curve> {
        let file = self.csv.get(file)?;
        let file = self.kept(file)?;
        self.problems.extend(file.note(None));
        let axis = |key: &'static str, ty| Axis { list: key, unit: "", column: key, ty };
        let x = self.column(fields, &file, axis("x", types[0]), Some(names[0]));
        let y = self.column(fields, &file, axis("value", types[1]), Some(names[1]));
        let (x, y) = (x?, y?);
        let (numbers, values) = (x.numbers.clone(), y.numbers.clone());
        match Table1::new(numbers, values, Interpolation::Linear, Outside::Hold) {
            Ok(table) => Some((table, [x, y])),
            Err(error) => {
                self.report_points(fields, (&x, &y), ("the arguments", &error));
                None
            }
        }
    }
}

/// The arguments of all curves, each once; unless the end values continue, only those that every
/// curve covers. `None` if there are fewer than two.
fn knots(curves: &[Curve], outside: Outside) -> Option<Vec<f64>> {
    let arguments = || curves.iter().map(|(_, [x, _])| x.numbers.as_slice());
    let ends = arguments().filter_map(|x| Some((*x.first()?, *x.last()?)));
    let (low, high) = ends
        .fold((f64::NEG_INFINITY, f64::INFINITY), |(low, high), (first, last)| {
            (low.max(first), high.min(last))
        });
    let held = outside == Outside::Hold;
    let mut all: Vec<f64> = arguments().flatten().copied().collect();
    all.retain(|x| held || (low..=high).contains(x));
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    (all.len() > 1).then_some(all)
}

impl<'a> Elaboration<'a> {
    /// The values outside a table of two arguments, which is bilinear.
    pub(super) fn straight(&mut self, fields: &Fields<'a>) -> Option<Outside> {
        let outside = self.choice(fields, "outside", &OUTSIDE);
        let interpolation = self.choice(fields, "interp", &INTERPOLATIONS);
        if let (Some(Interpolation::Pchip), Some(raw)) = (interpolation, fields.get("interp")) {
            let message =
                format!("{} of two arguments is not supported yet", fields.owner.field("interp"));
            let help = "a table of two arguments is bilinear: leave `interp` out";
            let problem = Diagnostic::wrong("netlist::not_supported_yet", message, &raw.span, help);
            self.report(problem);
            return None;
        }
        outside
    }
}
