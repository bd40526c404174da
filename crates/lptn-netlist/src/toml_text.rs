//! Keys and strings as TOML has them.

use lptn_network::is_name;

/// A key; a path stands in quotes.
pub(crate) fn key(name: &str) -> String {
    if is_name(name) { name.to_owned() } else { string(name) }
}

/// A basic string of TOML.
pub(crate) fn string(text: &str) -> String {
    let mut written = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => written += "\\\"",
            '\\' => written += "\\\\",
            '\n' => written += "\\n",
            '\t' => written += "\\t",
            '\r' => written += "\\r",
            c if c.is_control() => written += &format!("\\u{:04X}", u32::from(c)),
            c => written.push(c),
        }
    }
    written + "\""
}

#[cfg(test)]
mod tests {
    use super::{key, string};

    #[test]
    fn strings_are_toml() {
        assert_eq!(key("steel"), "steel");
        assert_eq!(key("planet[1].gear"), "\"planet[1].gear\"");
        assert_eq!(string("a \"b\" \\ \n\u{1}"), "\"a \\\"b\\\" \\\\ \\n\\u0001\"");
    }
}
