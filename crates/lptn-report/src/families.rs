//! Families: names that differ only by their indices, such as `row[1].base` to `row[24].base`.

/// Least number of members of a family that is shown as one row or one band. Fewer are shown as
/// they are: planets of a gearbox are few, and two or three rows are read faster than a range.
pub const MORE_MEMBERS: usize = 5;

/// The name of the family, and the indices of the member: `row[*].base` and `[7]`.
pub fn family(name: &str) -> Option<(String, String)> {
    let (mut whole, mut indices, mut rest) = (String::new(), String::new(), name);
    while let Some((before, behind)) = rest.split_once('[') {
        let (index, after) = behind.split_once(']')?;
        whole += &format!("{before}[*]");
        indices += &format!("[{index}]");
        rest = after;
    }
    (!indices.is_empty()).then(|| (whole + rest, indices))
}

#[cfg(test)]
mod tests {
    use super::family;

    #[test]
    fn indices_are_what_members_differ_by() {
        let parts = |name| family(name).map(|(whole, index)| format!("{whole} {index}"));
        assert_eq!(parts("row[7].base").as_deref(), Some("row[*].base [7]"));
        assert_eq!(parts("a[1].b[2,3]").as_deref(), Some("a[*].b[*] [1][2,3]"));
        assert_eq!((parts("steel"), parts("a[1")), (None, None));
    }
}
