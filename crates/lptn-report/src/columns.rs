//! The columns of a table as panels of a figure.

use std::collections::BTreeMap;

use lptn_plot::figure::{Axis, Curve, Panel};
use lptn_solve::{Column, Table};

use crate::families::{MORE_MEMBERS, family};
use crate::number::rounded_up;

/// Most curves that can be distinguished in one panel.
pub const MOST_CURVES: usize = 12;

/// This many families in a panel, unless of temperatures, are bands with their highest members only.
const SEVERAL: usize = 3;

/// Name of the axis of temperatures.
pub const TEMPERATURE: &str = "temperature";

/// Panels of the columns of a table over its first one, and the number of columns left out.
/// Each unit has a panel, in order of appearance. Names of temperatures lose their end `.T`. A
/// panel shows at most [`MOST_CURVES`] columns: those that reach highest. With `fold`, a large
/// family is its highest and its lowest member, in a band from the least to the largest value. A
/// column with proven errors, see [`bound_of`], is in a band as wide as these.
pub fn panels(table: &Table, fold: bool) -> (Vec<Panel>, usize) {
    let Some((first, others)) = table.columns().split_first() else {
        return (Vec::new(), 0);
    };
    let columns = others;
    let others: Vec<&Column> = columns.iter().filter(|c| !is_bound(c, columns)).collect();
    let (mut panels, mut left_out) = (Vec::new(), 0);
    let mut done: Vec<(Quantity, &str)> = Vec::new();
    for column in &others {
        let key = (Quantity::of(column), column.unit.as_str());
        if done.contains(&key) {
            continue;
        }
        done.push(key);
        let same = |other: &&Column| (Quantity::of(other), other.unit.as_str()) == key;
        let all: Vec<&Column> = others.iter().copied().filter(same).collect();
        let (bands, single) = if fold { grouped(&all) } else { (Vec::new(), all.clone()) };
        let shown = highest(&single);
        left_out += single.len() - shown.len();
        let name = key.0.name().unwrap_or(if all.len() == 1 { &column.name } else { "" });
        let mut panel = Panel::new(across(first), Axis::linear(name, key.1));
        // with several families, the name of the lowest member of each would fill the legend
        let ends = if key.0 == Quantity::Temperature || bands.len() < SEVERAL { 2 } else { 1 };
        let bands =
            bands.iter().flat_map(|members| band(first, members, key.0).into_iter().take(ends));
        panel.curves.extend(bands);
        let proven = |column: &Column| within(curve(first, column), column, columns);
        shown.into_iter().for_each(|column| add(&mut panel.curves, proven(column)));
        panels.push(panel);
    }
    let share = if panels.len() > 2 { 0.6 } else { 1.0 };
    panels.iter_mut().for_each(|panel| panel.share = share);
    (panels, left_out)
}

/// The end of the name of a column of proven errors, after that of the column they are of.
const BOUND: &str = ".bound";

/// The column of the proven errors of a column.
pub fn bound_of<'a>(column: &Column, columns: &'a [Column]) -> Option<&'a Column> {
    let is_own = |other: &&Column| other.name.strip_suffix(BOUND) == Some(column.name.as_str());
    columns.iter().find(is_own)
}

/// True for a column of proven errors of another one.
fn is_bound(column: &Column, columns: &[Column]) -> bool {
    let of = column.name.strip_suffix(BOUND);
    of.is_some_and(|of| columns.iter().any(|other| other.name == of))
}

/// A curve in the band of its proven errors, if there are any.
fn within(curve: Curve, column: &Column, columns: &[Column]) -> Curve {
    let Some(bounds) = bound_of(column, columns) else { return curve };
    // in files of older versions they are in K
    let fahrenheit = matches!(column.unit.as_str(), "degF" | "degR");
    let scale = if fahrenheit && bounds.unit == "K" { 1.8 } else { 1.0 };
    let side = |(value, bound): (&f64, &f64)| (value - scale * bound, value + scale * bound);
    let spread = column.values.iter().zip(&bounds.values).map(side).collect();
    curve.within(spread)
}

/// Caption of a figure with bands of proven errors: the largest one of each unit. `None` without
/// bands.
pub fn proven_caption(table: &Table) -> Option<String> {
    let columns = table.columns();
    let mut largest: Vec<(&str, f64)> = Vec::new();
    for column in columns.iter().filter(|column| is_bound(column, columns)) {
        match largest.iter_mut().find(|(unit, _)| *unit == column.unit) {
            Some((_, known)) => *known = known.max(peak(column)),
            None => largest.push((&column.unit, peak(column))),
        }
    }
    let most = |(unit, bound): &(&str, f64)| {
        let unit = if *unit == "1" { String::new() } else { format!(" {unit}") };
        format!("{}{unit}", rounded_up(*bound))
    };
    let most: Vec<String> = largest.iter().map(most).collect();
    (!most.is_empty()).then(|| format!("bands: proven errors, at most {}", most.join(", ")))
}

/// Quantity of a column, which names its axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Temperature,
    HeatFlow,
    Heat,
    Other,
}

impl Quantity {
    fn of(column: &Column) -> Self {
        match column.unit.as_str() {
            "degC" | "degF" => Self::Temperature,
            "K" | "degR" if column.name.ends_with(".T") => Self::Temperature,
            "W" => Self::HeatFlow,
            "J" => Self::Heat,
            _ => Self::Other,
        }
    }

    fn name(self) -> Option<&'static str> {
        match self {
            Self::Temperature => Some(TEMPERATURE),
            Self::HeatFlow => Some("heat flow"),
            Self::Heat => Some("heat"),
            Self::Other => None,
        }
    }
}

fn across(column: &Column) -> Axis {
    if column.name == "time" && column.unit == "s" {
        return Axis::time();
    }
    Axis::linear(&column.name, &column.unit)
}

/// The curve of a column. A temperature has the name of its node.
fn curve(first: &Column, column: &Column) -> Curve {
    let name = column.name.strip_suffix(".T").unwrap_or(&column.name);
    let points = first.values.iter().copied().zip(column.values.iter().copied()).collect();
    // a constant temperature, such as that of empty space, may be far from all others
    let is_constant = column.values.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits());
    let aside = is_constant && Quantity::of(column) == Quantity::Temperature;
    Curve { aside, ..Curve::line(name, points) }
}

/// The names that the column of a curve of a run may have, and whose columns do not differ.
pub fn column_names(curve: &Curve) -> impl Iterator<Item = String> + '_ {
    let name = curve.name.split(", ").next().unwrap_or_default();
    [format!("{name}.T"), name.to_owned()].into_iter()
}

/// The members of each large family, and the other columns.
fn grouped<'a>(columns: &[&'a Column]) -> (Vec<Vec<&'a Column>>, Vec<&'a Column>) {
    let mut families: BTreeMap<String, Vec<&Column>> = BTreeMap::new();
    let whole = |column: &Column| family(&column.name).map(|(whole, _)| whole);
    for column in columns {
        if let Some(whole) = whole(column) {
            families.entry(whole).or_default().push(column);
        }
    }
    families.retain(|_, members| members.len() >= MORE_MEMBERS);
    let single = |column: &&&Column| !whole(column).is_some_and(|w| families.contains_key(&w));
    let single = columns.iter().filter(single).copied().collect();
    (families.into_values().collect(), single)
}

/// The highest and the lowest member of a family, the highest in the band of all.
fn band(first: &Column, members: &[&Column], quantity: Quantity) -> Vec<Curve> {
    let words = match quantity {
        Quantity::Temperature => ["hottest", "coldest"],
        _ => ["highest", "lowest"],
    };
    // members often start at one temperature: their sums decide
    let sum = |column: &Column| column.values.iter().filter(|x| x.is_finite()).sum::<f64>();
    let higher =
        |a: &&&Column, b: &&&Column| peak(a).total_cmp(&peak(b)).then(sum(a).total_cmp(&sum(b)));
    let lower = |a: &&&Column, b: &&&Column| sum(a).total_cmp(&sum(b));
    let (Some(high), Some(low)) = (members.iter().max_by(higher), members.iter().min_by(lower))
    else {
        return Vec::new();
    };
    let side = |row: usize| {
        let values = members.iter().filter_map(|column| column.values.get(row).copied());
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let named = |column: &Column, word: &str| {
        let curve = curve(first, column);
        Curve { name: format!("{}, {word} of {}", curve.name, members.len()), ..curve }
    };
    let sides = (0..high.values.len()).map(side).collect();
    let band = named(high, words[0]).within(sides);
    let other = (!std::ptr::eq(*high, *low)).then(|| named(low, words[1]));
    std::iter::once(band).chain(other).collect()
}

/// Adds a curve. If it equals another, both become one with both names.
fn add(curves: &mut Vec<Curve>, curve: Curve) {
    match curves.iter_mut().find(|other| other.points == curve.points) {
        Some(other) => other.name += &format!(", {}", curve.name),
        None => curves.push(curve),
    }
}

/// The largest value of a column.
fn peak(column: &Column) -> f64 {
    let finite = column.values.iter().copied().filter(|value| value.is_finite());
    finite.fold(f64::NEG_INFINITY, f64::max)
}

/// The columns that reach highest, in the order of the table.
fn highest<'a>(columns: &[&'a Column]) -> Vec<&'a Column> {
    let mut places: Vec<usize> = (0..columns.len()).collect();
    places.sort_by(|&a, &b| peak(columns[b]).total_cmp(&peak(columns[a])));
    places.truncate(MOST_CURVES);
    places.sort_unstable();
    places.into_iter().map(|place| columns[place]).collect()
}

#[cfg(test)]
mod tests {
    use lptn_solve::Table;

    use super::{panels, proven_caption};

    /// 0.01 K is 0.018 degF on either side of 68 degF.
    #[test]
    fn proven_errors_are_bands_with_a_caption() {
        let mut table = Table::of(&[0.0, 60.0]);
        table.column("time", "s", |t| *t);
        table.column("steel.T", "degF", |_| 68.0);
        table.column("skin.Q", "W", |_| 5.0);
        table.column("steel.T.bound", "K", |t| if *t > 0.0 { 0.01 } else { 0.0 });
        table.column("skin.Q.bound", "W", |_| 0.25);
        let table = table.done();
        let (panels, _) = panels(&table, false);
        assert_eq!(panels.len(), 2);
        let (low, high) = panels[0].curves[0].spread[1];
        assert!((low - 67.982).abs() < 1e-12 && (high - 68.018).abs() < 1e-12, "{low} {high}");
        assert_eq!(panels[1].curves[0].spread[0], (4.75, 5.25));
        let caption = proven_caption(&table).unwrap_or_default();
        assert_eq!(caption, "bands: proven errors, at most 0.01 K, 0.25 W");
    }

    #[test]
    fn a_unit_has_a_panel_and_the_highest_columns_stay() {
        let mut table = Table::of(&[0.0, 60.0]);
        table.column("time", "s", |time| *time);
        table.column("bed.Q", "W", |time| *time);
        for i in 0..14 {
            table.column(format!("n{i}.T"), "degC", move |time| f64::from(i) + time);
        }
        let (panels, left_out) = panels(&table.done(), true);
        let named: Vec<&str> = panels.iter().map(|panel| panel.y.name.as_str()).collect();
        assert_eq!((named, left_out), (vec!["heat flow", "temperature"], 2));
        assert_eq!(panels[0].curves[0].points, [(0.0, 0.0), (60.0, 60.0)]);
        let temperatures: Vec<&str> =
            panels[1].curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!((temperatures.len(), temperatures[0]), (12, "n2"));
    }

    #[test]
    fn curves_that_lie_on_each_other_are_one() {
        let mut table = Table::of(&[0.0, 60.0]);
        table.column("time", "s", |time| *time);
        table.column("bed.T", "degC", |_| 25.0);
        table.column("air.T", "degC", |_| 25.0);
        let curves = panels(&table.done(), true).0.remove(0).curves;
        assert_eq!((curves.len(), curves[0].name.as_str()), (1, "bed, air"));
    }

    /// Six lines from one point: the last one is highest at the end, the first one lowest.
    #[test]
    fn a_family_is_a_band_with_its_highest_and_lowest_member() {
        let mut table = Table::of(&[0.0, 60.0]);
        table.column("time", "s", |time| *time);
        table.column("air.T", "degC", |_| 25.0);
        for i in 1..=6_i32 {
            let slope = f64::from(i - 1);
            table.column(format!("cell[{i}].T"), "degC", move |time| 1.0 + slope * time);
        }
        let curves = panels(&table.done(), true).0.remove(0).curves;
        let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!(names, ["cell[6], hottest of 6", "cell[1], coldest of 6", "air"]);
        assert_eq!(curves[0].spread, [(1.0, 1.0), (1.0, 301.0)]);
        assert!(curves[1].spread.is_empty());
    }
}
