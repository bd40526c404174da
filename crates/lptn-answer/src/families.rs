//! Rows of one family, such as `row[1].base` to `row[24].base`, as one row with its worst member.

use std::collections::BTreeMap;

use lptn_report::TextTableOf;

/// Least number of members of a family that is shown as one row.
const MORE_MEMBERS: usize = 5;

/// A row of a table: an item, or the worst of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<T> {
    /// The item, or the worst of its family.
    pub item: T,
    /// The name of the item, or that of the family: `row[*].base`.
    pub name: String,
    /// Index of the member and their number: `[7] of 24`; empty for a single item.
    pub member: String,
}

/// The name of the family, and the indices of the member: `row[*].base` and `[7]`.
fn family(name: &str) -> Option<(String, String)> {
    let (mut whole, mut indices, mut rest) = (String::new(), String::new(), name);
    while let Some((before, behind)) = rest.split_once('[') {
        let (index, after) = behind.split_once(']')?;
        whole += &format!("{before}[*]");
        indices += &format!("[{index}]");
        rest = after;
    }
    (!indices.is_empty()).then(|| (whole + rest, indices))
}

/// Rows of items by name and kind.
/// With `fold`, a large family is one row at its first member, with the item of the largest
/// `worst`. Items of different kinds belong to different families.
pub fn folded<T>(
    items: Vec<T>,
    fold: bool,
    name: impl Fn(&T) -> (String, u8),
    worst: impl Fn(&T) -> f64,
) -> Vec<Row<T>> {
    let of = |item: &T| {
        let (name, kind) = name(item);
        family(&name).filter(|_| fold).map(|(whole, indices)| ((whole, kind), indices))
    };
    let mut counts: BTreeMap<(String, u8), usize> = BTreeMap::new();
    items.iter().filter_map(of).for_each(|(key, _)| *counts.entry(key).or_default() += 1);
    let mut places: BTreeMap<(String, u8), usize> = BTreeMap::new();
    let mut rows: Vec<Row<T>> = Vec::new();
    for item in items {
        let found = of(&item).map(|(key, indices)| (counts.get(&key).copied(), key, indices));
        let Some((Some(count @ MORE_MEMBERS..), key, indices)) = found else {
            rows.push(Row { name: name(&item).0, item, member: String::new() });
            continue;
        };
        let member = format!("{indices} of {count}");
        let row = Row { item, name: key.0.clone(), member };
        match places.get(&key).and_then(|place| rows.get_mut(*place)) {
            Some(known) if worst(&row.item) > worst(&known.item) => *known = row,
            Some(_) => {}
            None => {
                places.insert(key, rows.len());
                rows.push(row);
            }
        }
    }
    rows
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
    use super::{Row, family, folded};

    fn rows(items: &[(&str, f64)]) -> Vec<(String, String, f64)> {
        let kind = |item: &(&str, f64)| (item.0.to_owned(), u8::from(item.1.is_nan()));
        let shown = |row: Row<(&str, f64)>| (row.name, row.member, row.item.1);
        folded(items.to_vec(), true, kind, |item| item.1).into_iter().map(shown).collect()
    }

    #[test]
    fn indices_are_what_members_differ_by() {
        let parts = |name| family(name).map(|(whole, index)| format!("{whole} {index}"));
        assert_eq!(parts("row[7].base").as_deref(), Some("row[*].base [7]"));
        assert_eq!(parts("a[1].b[2,3]").as_deref(), Some("a[*].b[*] [1][2,3]"));
        assert_eq!((parts("steel"), parts("a[1")), (None, None));
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
        // of another kind: four are left
        items[1].1 = f64::NAN;
        assert_eq!(rows(&items).len(), 8);
    }
}
