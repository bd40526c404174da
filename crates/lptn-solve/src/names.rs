//! Names in messages.

/// "`a`", "`a` and `b`", "`a`, `b` and 3 more nodes".
pub(crate) fn list(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => format!("`{one}`"),
        [one, two] => format!("`{one}` and `{two}`"),
        [one, two, three] => format!("`{one}`, `{two}` and `{three}`"),
        [one, two, rest @ ..] => format!("`{one}`, `{two}` and {} more nodes", rest.len()),
    }
}
