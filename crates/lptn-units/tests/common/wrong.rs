//! Checks of strings that are wrong: code, marked part and help.

use lptn_units::{Type, parse_value};

/// Text, expected type, code, part pointed to, help.
pub(crate) type Wrong =
    (&'static str, Option<Type>, &'static str, &'static str, Option<&'static str>);

/// Names that are parameters in the tests of wrong strings.
pub(crate) fn is_parameter(name: &str) -> bool {
    ["m", "fan", "T_amb"].contains(&name)
}

pub(crate) fn check_wrong(table: &[Wrong]) {
    for (text, expected, code, part, help) in table {
        let error = parse_value(text, *expected, &is_parameter).expect_err(text);
        assert_eq!(error.code(), *code, "{text}: {error}");
        assert_eq!(&text[error.span.clone()], *part, "{text}: {error}");
        assert_eq!(error.help().as_deref(), *help, "{text}: {error}");
    }
}
