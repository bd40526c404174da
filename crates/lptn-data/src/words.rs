//! Lists in sentences.

use lptn_units::suggest;

/// Greatest number of names in a list.
const MOST: usize = 40;

/// "`a`, `b` and `c`".
pub fn list(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => format!("`{one}`"),
        [most @ .., last] => {
            let most: Vec<String> = most.iter().map(|name| format!("`{name}`")).collect();
            format!("{} and `{last}`", most.join(", "))
        }
    }
}

/// A suggestion for `wrong`: the nearest of the names, else `all`, such as "its names are", with
/// all of them.
pub fn nearest<'n>(wrong: &str, names: impl IntoIterator<Item = &'n str>, all: &str) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    match suggest(wrong, names.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("{all} {}", list(names.get(..MOST).unwrap_or(&names))),
    }
}
