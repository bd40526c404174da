//! JSON with places: each value knows its place.

use std::borrow::Cow;
use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use lptn_data::{FileId, Span};

/// A JSON text that was read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Json<'a> {
    pub(crate) file: FileId,
    pub(crate) text: &'a str,
}

/// A value inside a text, not yet read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JsonValue<'a> {
    raw: &'a RawValue,
    json: Json<'a>,
}

/// The members of an object in the order of the file; a name may appear twice.
struct Members<'a>(Vec<(Cow<'a, str>, &'a RawValue)>);

impl<'a> Json<'a> {
    /// The whole value.
    ///
    /// # Errors
    /// The error, and its place.
    pub(crate) fn read(self) -> Result<JsonValue<'a>, (String, Span)> {
        let problem = |error: serde_json::Error| {
            let line: usize =
                self.text.split_inclusive('\n').take(error.line().max(1) - 1).map(str::len).sum();
            let byte = (line + error.column().saturating_sub(1)).min(self.text.len());
            // a column counts bytes and may end inside a letter
            let start = (0..=byte).rev().find(|&at| self.text.is_char_boundary(at)).unwrap_or(0);
            let whole = error.to_string();
            let words = whole.split(" at line ").next().unwrap_or_default().to_owned();
            (words, Span::new(self.file, start..start))
        };
        serde_json::from_str(self.text).map(|raw| JsonValue { raw, json: self }).map_err(problem)
    }
}

impl<'a> JsonValue<'a> {
    /// Its place.
    pub(crate) fn span(self) -> Span {
        let text = self.raw.get();
        let start = text.as_ptr().addr().saturating_sub(self.json.text.as_ptr().addr());
        Span::new(self.json.file, start..start + text.len())
    }

    /// Its members with their names, if it is an object.
    pub(crate) fn members(self) -> Option<Vec<(Cow<'a, str>, JsonValue<'a>)>> {
        let Members(members) = serde_json::from_str(self.raw.get()).ok()?;
        Some(
            members
                .into_iter()
                .map(|(name, raw)| (name, JsonValue { raw, json: self.json }))
                .collect(),
        )
    }

    /// Its items, if it is a list.
    pub(crate) fn items(self) -> Option<Vec<JsonValue<'a>>> {
        let items: Vec<&'a RawValue> = serde_json::from_str(self.raw.get()).ok()?;
        Some(items.into_iter().map(|raw| JsonValue { raw, json: self.json }).collect())
    }

    /// Its number, read to the last digit.
    pub(crate) fn number(self) -> Option<f64> {
        let text = self.raw.get();
        let begins = text.starts_with(|c: char| c == '-' || c.is_ascii_digit());
        text.parse().ok().filter(|number: &f64| begins && number.is_finite())
    }

    /// Its text, if it is a string.
    pub(crate) fn string(self) -> Option<String> {
        serde_json::from_str(self.raw.get()).ok()
    }

    /// Its text in the file.
    pub(crate) fn written(self) -> &'a str {
        self.raw.get()
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Members<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Object;

        impl<'de> Visitor<'de> for Object {
            type Value = Vec<(Cow<'de, str>, &'de RawValue)>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(members)
            }
        }

        deserializer.deserialize_map(Object).map(Members)
    }
}
