//! Text of a netlist: keys, strings, numbers in SI units.

use lptn_network::{Value, ZERO_CELSIUS, is_name};
use lptn_units::{Type, Unit, format_number};

/// A key; a path is in quotes.
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

/// A list of strings.
pub(crate) fn strings<'t>(texts: impl Iterator<Item = &'t str>) -> String {
    let texts: Vec<String> = texts.map(string).collect();
    format!("[{}]", texts.join(", "))
}

/// A number in SI units with its unit; an absolute temperature in K, for a field that wants one.
pub(crate) fn quantity(value: f64, ty: Type) -> String {
    if ty.is_scalar() {
        return format_number(value);
    }
    let unit = if ty.absolute { "K".to_owned() } else { ty.dimension.si_unit() };
    format!("\"{} {unit}\"", format_number(value))
}

/// The value of a field of this type.
pub(crate) fn value(value: &Value, ty: Type) -> String {
    match value {
        Value::Constant(number) => quantity(*number, ty),
        Value::Expression(program) => string(program.text().trim()),
        Value::Product(factors) => {
            // lumps are written by material and size; nothing else is a product
            let factors: Vec<String> =
                factors.iter().map(|f| self::value(f, Type::SCALAR)).collect();
            factors.join(" * ")
        }
    }
}

/// A constant of the same type as another value: there `K` would be a difference.
pub(crate) fn like(value: &Value, ty: Type) -> String {
    match value {
        Value::Constant(number) if ty.absolute => point(*number),
        other => self::value(other, ty),
    }
}

/// A point on the temperature scale, for any place.
pub(crate) fn point(kelvin: f64) -> String {
    format!("\"absolute({} [K])\"", format_number(kelvin))
}

/// A point on the temperature scale in degC, with the fewest digits that give back the same number
/// in K.
pub(crate) fn celsius(kelvin: f64) -> String {
    let celsius = kelvin - ZERO_CELSIUS;
    let exact = |text: &String| {
        text.parse::<f64>().is_ok_and(|value| (value + ZERO_CELSIUS).to_bits() == kelvin.to_bits())
    };
    let shortest = (0..=17).map(|digits| format!("{celsius:.digits$}")).find(exact);
    let text = shortest.unwrap_or_else(|| format!("{celsius}"));
    if text == "-0" { "0".to_owned() } else { text }
}

/// A list of numbers in their original unit, if that gives back the same numbers.
pub(crate) fn list_in(numbers: &[f64], ty: Type, unit: Option<&Unit>) -> (String, Option<String>) {
    let own = |unit: &&Unit| !ty.absolute && unit.text != "1";
    let written =
        |unit: &Unit| numbers.iter().map(|&si| exact(si, unit)).collect::<Option<Vec<String>>>();
    match unit.filter(own).and_then(|unit| Some((written(unit)?, unit))) {
        Some((written, unit)) => (format!("[{}]", written.join(", ")), Some(unit.text.clone())),
        None => list(numbers, ty),
    }
}

/// The shortest text in a unit that is read as this number to the last bit.
fn exact(si: f64, unit: &Unit) -> Option<String> {
    let value = unit.from_si(si);
    let texts = (0..17).filter_map(|digits| format!("{value:.digits$e}").parse().ok());
    let found = texts.into_iter().find(|text: &f64| unit.to_si(*text).to_bits() == si.to_bits());
    found.map(format_number)
}

/// A list of numbers, and their unit if they have one; points on the temperature scale in degC, as
/// `K` would be a difference.
pub(crate) fn list(numbers: &[f64], ty: Type) -> (String, Option<String>) {
    let written: Vec<String> =
        numbers.iter().map(|&x| if ty.absolute { celsius(x) } else { format_number(x) }).collect();
    let unit = match ty {
        ty if ty.absolute => Some("degC".to_owned()),
        ty if ty.is_scalar() => None,
        ty => Some(ty.dimension.si_unit()),
    };
    (format!("[{}]", written.join(", ")), unit)
}

/// The fields of an inline table.
#[derive(Debug, Default)]
pub(crate) struct TomlFields(Vec<String>);

impl TomlFields {
    pub(crate) fn put(&mut self, name: &str, written: impl AsRef<str>) {
        self.0.push(format!("{} = {}", key(name), written.as_ref()));
    }

    /// True if a field is there.
    pub(crate) fn has(&self, name: &str) -> bool {
        let start = format!("{} = ", key(name));
        self.0.iter().any(|field| field.starts_with(&start))
    }

    /// A field that contains a name or word.
    pub(crate) fn word(&mut self, name: &str, word: &str) {
        self.put(name, string(word));
    }

    /// A field that is left out if it is `None`.
    pub(crate) fn maybe(&mut self, name: &str, written: Option<impl AsRef<str>>) {
        if let Some(written) = written {
            self.put(name, written);
        }
    }

    /// A table of such fields, if there are any.
    pub(crate) fn table(&mut self, name: &str, fields: impl Iterator<Item = String>) {
        let fields = Self(fields.collect());
        self.maybe(name, (!fields.is_empty()).then(|| fields.inline()));
    }

    /// A list of strings, if there are any.
    pub(crate) fn strings<'t>(&mut self, name: &str, texts: impl Iterator<Item = &'t str>) {
        let mut texts = texts.peekable();
        if texts.peek().is_some() {
            self.put(name, strings(texts));
        }
    }

    /// A list with its unit.
    pub(crate) fn list(&mut self, name: &str, (list, unit): (String, Option<String>)) {
        self.put(name, list);
        if let Some(unit) = unit {
            self.word(&format!("{name}_unit"), &unit);
        }
    }

    /// `{ a = 1, b = 2 }`
    pub(crate) fn inline(&self) -> String {
        if self.0.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", self.0.join(", ")) }
    }

    /// One line for each.
    pub(crate) fn lines(&self) -> String {
        self.0.iter().map(|field| format!("{field}\n")).collect()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::{celsius, key, string};

    #[test]
    fn temperatures_come_back_to_the_last_bit() {
        for written in [25.0, -273.15, 0.0, 25.5, 1200.0, 36.6, -40.0, 0.1] {
            let kelvin: f64 = written + 273.15;
            assert_eq!(celsius(kelvin).parse::<f64>().ok().map(|c| c + 273.15), Some(kelvin));
        }
        assert_eq!(celsius(25.5 + 273.15), "25.5");
        assert_eq!(celsius(273.15), "0");
    }

    #[test]
    fn strings_are_toml() {
        assert_eq!(key("steel"), "steel");
        assert_eq!(key("planet[1].gear"), "\"planet[1].gear\"");
        assert_eq!(string("a \"b\" \\ \n\u{1}"), "\"a \\\"b\\\" \\\\ \\n\\u0001\"");
    }
}
