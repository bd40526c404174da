//! Rows of one family, such as `row[1].base` to `row[24].base`, as one row with its worst member.
//!
//! Every table for people folds its rows here; CSV and JSON have all of them.

use std::collections::BTreeMap;

use lptn_report::{Flow, MORE_MEMBERS, TextTableOf, family};

/// A row of a table: an item, or the worst of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<T> {
    /// The item, or the worst of its family.
    pub item: T,
    /// The other members of its family.
    pub others: Vec<T>,
    /// The name of the item, or that of the family: `row[*].base`.
    pub name: String,
    /// Index of the member and their number: `[7] of 24`; empty for a single item.
    pub member: String,
}

impl<T> Row<T> {
    fn single(name: String, item: T) -> Self {
        Self { item, others: Vec::new(), name, member: String::new() }
    }

    /// Every member of the family.
    pub fn all(&self) -> impl Iterator<Item = &T> {
        std::iter::once(&self.item).chain(&self.others)
    }

    /// The range of a number over the family, `24.1 to 36.9`; one number if all are shown alike.
    pub fn range(&self, value: impl Fn(&T) -> f64, shown: impl Fn(f64) -> String) -> String {
        let values = || self.all().map(&value).filter(|value| !value.is_nan());
        if self.others.is_empty() || values().next().is_none() {
            return shown(value(&self.item));
        }
        let low = shown(values().fold(f64::INFINITY, f64::min));
        let high = shown(values().fold(f64::NEG_INFINITY, f64::max));
        if low == high { high } else { format!("{low} to {high}") }
    }
}

/// Rows of items by name and kind.
/// With `fold`, a large family is one row at its first member, with the item of the largest
/// `worst`. Items of different kinds belong to different families.
pub fn folded<T, K: Clone + Ord>(
    items: Vec<T>,
    fold: bool,
    name: impl Fn(&T) -> (String, K),
    worst: impl Fn(&T) -> f64,
) -> Vec<Row<T>> {
    let of = |item: &T| {
        let (name, kind) = name(item);
        family(&name).filter(|_| fold).map(|(whole, indices)| ((whole, kind), indices))
    };
    let mut counts: BTreeMap<(String, K), usize> = BTreeMap::new();
    items.iter().filter_map(of).for_each(|(key, _)| *counts.entry(key).or_default() += 1);
    let mut places: BTreeMap<(String, K), usize> = BTreeMap::new();
    let mut rows: Vec<Row<T>> = Vec::new();
    for item in items {
        let found = of(&item).map(|(key, indices)| (counts.get(&key).copied(), key, indices));
        let Some((Some(count @ MORE_MEMBERS..), key, indices)) = found else {
            rows.push(Row::single(name(&item).0, item));
            continue;
        };
        let member = format!("{indices} of {count}");
        match places.get(&key).and_then(|place| rows.get_mut(*place)) {
            Some(known) if worst(&item) > worst(&known.item) => {
                known.others.push(std::mem::replace(&mut known.item, item));
                known.member = member;
            }
            Some(known) => known.others.push(item),
            None => {
                places.insert(key.clone(), rows.len());
                rows.push(Row { member, ..Row::single(key.0, item) });
            }
        }
    }
    rows
}

/// Heat of sources and boundaries, with one sum for each large family whose heat has one sign.
pub fn sums(flows: Vec<Flow>, fold: bool) -> Vec<Flow> {
    let named = |flow: &Flow| (flow.name.clone(), u8::from(flow.heat < 0.0));
    let rows = folded(flows, fold, named, |flow| flow.heat.abs());
    let sum = |row: Row<Flow>| Flow { heat: row.all().map(|flow| flow.heat).sum(), name: row.name };
    rows.into_iter().map(sum).collect()
}

/// Adds the column of members if a row has any, under a title that says which one is shown.
pub fn members<'a, T>(
    table: TextTableOf<'a, Row<T>>,
    rows: &[Row<T>],
    title: &str,
) -> TextTableOf<'a, Row<T>> {
    if rows.iter().all(|row| row.member.is_empty()) {
        return table;
    }
    table.left(title, |row: &Row<T>| row.member.as_str())
}

#[cfg(test)]
mod tests {
    use super::{Row, folded};

    fn rows(items: &[(&str, f64)]) -> Vec<(String, String, f64)> {
        let kind = |item: &(&str, f64)| (item.0.to_owned(), u8::from(item.1.is_nan()));
        let shown = |row: Row<(&str, f64)>| (row.name, row.member, row.item.1);
        folded(items.to_vec(), true, kind, |item| item.1).into_iter().map(shown).collect()
    }

    #[test]
    fn a_large_family_is_its_worst_member_and_a_small_one_is_shown() {
        let hot = ["hot[1]", "hot[2]", "hot[3]", "hot[4]", "hot[5]"];
        let mut items: Vec<(&str, f64)> = vec![("a", 0.0)];
        items.extend(hot.iter().zip([1.0, 3.0, 9.0, 3.0, 1.0]).map(|(name, x)| (*name, x)));
        items.extend([("b[1]", 1.0), ("b[2]", 2.0)]);
        let shown = rows(&items);
        let names: Vec<&str> = shown.iter().map(|row| row.0.as_str()).collect();
        assert_eq!(names, ["a", "hot[*]", "b[1]", "b[2]"]);
        assert_eq!((shown[1].1.as_str(), shown[1].2), ("[3] of 5", 9.0));
        // values that cannot be compared do not hide the range
        let row =
            folded(items.clone(), true, |item| (item.0.to_owned(), 0), |item| item.1).remove(1);
        assert_eq!(row.range(|item| item.1, |x| format!("{x:.0}")), "1 to 9");
        // of another kind: four are left
        items[1].1 = f64::NAN;
        assert_eq!(rows(&items).len(), 8);
    }
}
