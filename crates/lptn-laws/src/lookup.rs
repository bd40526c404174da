//! Queries of kinds and laws: which belong together, and their fields.

use std::sync::LazyLock;

use crate::declare::{Carries, FieldDeclaration};
use crate::{Formula, Kind};

impl Kind {
    /// The laws that its paths obey, in the order of the list.
    pub fn laws(self) -> impl Iterator<Item = Formula> {
        // needed for each key of each section, so found once
        static LAWS: LazyLock<Vec<Vec<Formula>>> = LazyLock::new(|| {
            let obeys = |law: &Formula, kind| law.declaration().kinds.contains(kind);
            let laws = |kind| Formula::ALL.iter().copied().filter(|law| obeys(law, kind)).collect();
            Kind::ALL.iter().map(laws).collect()
        });
        LAWS[self as usize].iter().copied()
    }

    /// True if its paths are streams, whose two ends receive different heats.
    pub fn is_stream(self) -> bool {
        self.laws().any(|law| law.declaration().carries.is_stream())
    }

    /// True if its elements are not paths between two ends, but sources that heat nodes.
    pub fn is_source(self) -> bool {
        self.laws().any(|law| law.declaration().carries == Carries::Heat)
    }

    /// The laws that are selected by their name only, or by their fields only.
    pub fn laws_named(self, named: bool) -> impl Iterator<Item = Formula> {
        self.laws().filter(move |law| law.declaration().named == named)
    }

    /// Its fields, each key once; the fields of all its laws come first.
    pub fn fields(self) -> Vec<&'static FieldDeclaration> {
        let mut fields: Vec<&'static FieldDeclaration> = Vec::new();
        for field in self.laws().flat_map(|law| law.declaration().fields) {
            if fields.iter().all(|known| known.key != field.key) {
                fields.push(field);
            }
        }
        fields.sort_by_cached_key(|field| !self.laws().all(|law| law.field(field.key).is_some()));
        fields
    }
}

impl Formula {
    /// Its field of this key.
    pub fn field(self, key: &str) -> Option<&'static FieldDeclaration> {
        self.declaration().fields.iter().find(|field| field.key == key)
    }

    /// The position of a key among its fields.
    pub fn position(self, key: &str) -> Option<usize> {
        self.declaration().fields.iter().position(|field| field.key == key)
    }

    /// The largest number of fields that a law has.
    pub const MOST_FIELDS: usize = {
        let (mut most, mut i) = (0, 0);
        while i < Self::ALL.len() {
            let count = Self::ALL[i].declaration().fields.len();
            most = if count > most { count } else { most };
            i += 1;
        }
        most
    };
}
