//! Data in a script element.

use serde_json::Value;

/// JSON as the content of a script element: only the end tag of a script could end it.
pub(crate) fn json(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}
