//! A network as data that can be changed: what a relation turns into another one that means the
//! same.

use super::units::{Kind, Number};

/// A part of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    Text(String),
    Number(Number),
    /// A name with what stands behind it, `n1.T`.
    Name(String),
    /// The time of the run.
    Time,
}

/// What stands behind a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    /// A quantity or an expression.
    Value(Vec<Piece>),
    /// A name, in quotes.
    Name(String),
    /// Names with their shares.
    Shares(Vec<(String, f64)>),
    /// A text, in quotes.
    Word(String),
    /// TOML as it stands.
    Raw(String),
    List(Vec<Field>),
    Table(Vec<(String, Field)>),
    /// A table whose keys are names too.
    Links(Vec<(String, Field)>),
}

/// An element, or a line of a section.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub section: String,
    pub name: String,
    /// One with an empty key is the whole entry: `name = value`.
    pub fields: Vec<(String, Field)>,
    /// For heat flows and reports: a bound on how much they change for 1 K, per K.
    pub slope: f64,
    /// Whether it is written as a table of its own, `[section.name]`.
    pub long: bool,
    /// Whether it stands in the file that is included.
    pub included: bool,
}

/// A file beside the netlist.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// Columns of numbers.
    Numbers(Vec<(String, Vec<Number>)>),
    Text(String),
}

/// A network and its run.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Net {
    pub entries: Vec<Entry>,
    pub sides: Vec<(String, Side)>,
    /// What it is made of, for the count of what is covered.
    pub features: Vec<&'static str>,
    /// Whether temperatures are linear in heat, boundaries and start.
    pub linear: bool,
}

pub const TOLERANCE: f64 = 1e-5;

impl Entry {
    pub fn new(section: &str, name: &str) -> Self {
        Self {
            section: section.into(),
            name: name.into(),
            fields: Vec::new(),
            slope: 0.0,
            long: false,
            included: false,
        }
    }

    pub fn with(mut self, key: &str, field: Field) -> Self {
        self.fields.push((key.into(), field));
        self
    }

    pub fn slope(mut self, slope: f64) -> Self {
        self.slope = slope;
        self
    }

    pub fn get(&self, key: &str) -> Option<&Field> {
        self.fields.iter().find(|(name, _)| name == key).map(|(_, field)| field)
    }

    pub fn get_mut(&mut self, key: &str) -> Option<&mut Field> {
        self.fields.iter_mut().find(|(name, _)| name == key).map(|(_, field)| field)
    }

    /// The name that a field holds.
    pub fn end(&self, key: &str) -> Option<&str> {
        if let Some(Field::Name(name)) = self.get(key) { Some(name) } else { None }
    }

    /// The section without the template around it.
    pub fn kind(&self) -> &str {
        self.section.strip_prefix("template.part.").unwrap_or(&self.section)
    }

    /// The number of a field that is a constant.
    pub fn constant(&self, key: &str) -> Option<Number> {
        match self.get(key)? {
            Field::Value(pieces) => match pieces[..] {
                [Piece::Number(number)] => Some(number),
                _ => None,
            },
            _ => None,
        }
    }
}

impl Field {
    /// Visits every number.
    pub fn numbers(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        match self {
            Self::Value(pieces) => pieces.iter_mut().for_each(|piece| {
                if let Piece::Number(number) = piece {
                    visit(number);
                }
            }),
            Self::List(list) => list.iter_mut().for_each(|field| field.numbers(visit)),
            Self::Table(table) | Self::Links(table) => {
                table.iter_mut().for_each(|(_, field)| field.numbers(visit));
            }
            _ => {}
        }
    }

    /// Visits every expression and quantity.
    pub fn values(&mut self, visit: &mut dyn FnMut(&mut Vec<Piece>)) {
        match self {
            Self::Value(pieces) => visit(pieces),
            Self::List(list) => list.iter_mut().for_each(|field| field.values(visit)),
            Self::Table(table) | Self::Links(table) => {
                table.iter_mut().for_each(|(_, field)| field.values(visit));
            }
            _ => {}
        }
    }

    /// Visits every name.
    pub fn names(&mut self, visit: &mut dyn FnMut(&mut String)) {
        match self {
            Self::Name(name) => visit(name),
            Self::Shares(shares) => shares.iter_mut().for_each(|(name, _)| visit(name)),
            Self::Value(pieces) => pieces.iter_mut().for_each(|piece| {
                if let Piece::Name(name) = piece {
                    visit(name);
                }
            }),
            Self::List(list) => list.iter_mut().for_each(|field| field.names(visit)),
            Self::Table(table) => table.iter_mut().for_each(|(_, field)| field.names(visit)),
            Self::Links(table) => table.iter_mut().for_each(|(key, field)| {
                visit(key);
                field.names(visit);
            }),
            Self::Word(_) | Self::Raw(_) => {}
        }
    }
}

impl Net {
    /// Visits every name that stands in a field.
    pub fn names(&mut self, visit: &mut dyn FnMut(&mut String)) {
        self.fields(&mut |field| field.names(visit));
    }

    pub fn fields(&mut self, visit: &mut dyn FnMut(&mut Field)) {
        self.entries
            .iter_mut()
            .flat_map(|entry| &mut entry.fields)
            .for_each(|(_, field)| visit(field));
    }

    pub fn of(&self, kind: &str) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.kind() == kind)
    }

    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    pub fn run(&mut self) -> &mut Entry {
        self.entries
            .iter_mut()
            .find(|entry| entry.section == "run")
            .expect("every network has a run")
    }

    pub fn run_value(&self, key: &str) -> f64 {
        let run = self.entries.iter().find(|entry| entry.section == "run");
        run.and_then(|run| run.constant(key)).map_or(0.0, |number| number.value)
    }

    pub fn has(&self, section: &str) -> bool {
        self.entries.iter().any(|entry| entry.section.starts_with(section))
    }
}

/// The first name of a path: `wall` of `wall.x1` and of `wall[2]`.
pub fn base(name: &str) -> &str {
    name.split(['.', '[']).next().unwrap_or(name)
}

pub fn number(value: f64, kind: Kind) -> Number {
    Number { value, kind, unit: 0 }
}

pub fn piece(value: f64, kind: Kind) -> Piece {
    Piece::Number(number(value, kind))
}

pub fn constant(value: f64, kind: Kind) -> Field {
    Field::Value(vec![piece(value, kind)])
}

pub fn name(text: impl Into<String>) -> Piece {
    Piece::Name(text.into())
}

/// An expression from a text in which `{}` stands for the parts, one after the other.
pub fn expression(text: &str, parts: impl IntoIterator<Item = Piece>) -> Vec<Piece> {
    let mut parts = parts.into_iter();
    let mut pieces = Vec::new();
    for (i, words) in text.split("{}").enumerate() {
        if i > 0 {
            pieces.push(parts.next().expect("a part for every place"));
        }
        if !words.is_empty() {
            pieces.push(Piece::Text(words.into()));
        }
    }
    pieces
}

/// `(before) value (after)`: something done to a whole value.
pub fn wrapped(text: &str, value: &[Piece], parts: impl IntoIterator<Item = Piece>) -> Vec<Piece> {
    let (before, after) = text.split_once("{value}").expect("a place for the value");
    let mut pieces = vec![Piece::Text(format!("{before}("))];
    pieces.extend_from_slice(value);
    pieces.push(Piece::Text(")".into()));
    pieces.extend(expression(after, parts));
    pieces
}
