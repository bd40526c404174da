//! Reads the block of a stage: its members, the fixed one, and the input.

use lptn_data::{Diagnostic, Severity, Span, list, nearest};
use lptn_units::{Type, parse_quantity};

use super::declaration::{GEARBOX, OF_WHEELS};
use super::member::{Arrangement, Member};
use crate::fields::{Fields, Owner};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::template::Structure;

/// Largest number of planets; more are a mistake.
const MOST_PLANETS: usize = 100;

/// A wheel has at most this many teeth.
const MOST_TEETH: f64 = 10_000.0;

/// A stage as it is written.
#[derive(Debug)]
pub(super) struct Stage<'r> {
    pub(super) entry: &'r RawEntry,
    pub(super) fields: Fields<'r>,
    pub(super) arrangement: Arrangement,
    pub(super) held: Option<Member>,
    pub(super) input: Member,
    pub(super) output: Member,
    /// The teeth of every wheel.
    pub(super) teeth: Vec<(Member, &'r RawEntry)>,
    /// Profile shifts and addenda of wheels, as far as they are given.
    pub(super) profile: [Vec<(Member, &'r RawEntry)>; 2],
    pub(super) planets: usize,
    pub(super) even: bool,
    pub(super) ratio: Option<(f64, Span)>,
    pub(super) into: Heated<'r>,
    /// The stage that drives it, by its full name.
    pub(super) driver: Option<(String, &'r RawValue)>,
}

/// The nodes that the parts of a stage heat.
#[derive(Debug)]
pub(super) enum Heated<'r> {
    /// One node, or another value that `into` of a source takes.
    One(&'r RawValue),
    /// A node for each member.
    Each(Vec<(Member, &'r RawValue)>),
}

impl<'r> Stage<'r> {
    /// Reads a block and reports its errors.
    pub(super) fn read(
        entry: &'r RawEntry,
        structure: &Structure,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let before = problems.len();
        let owner = Owner::element(GEARBOX.name, &entry.key);
        let fields = Fields::of(&GEARBOX, owner, entry, problems)?;
        let mut reader = Reader { fields: &fields, problems };
        let teeth = reader.teeth();
        let into = reader.heated(teeth.as_ref().map(|(arrangement, _)| *arrangement));
        let (arrangement, teeth) = teeth?;
        let profile = OF_WHEELS.map(|(key, _)| reader.of_wheels(key, arrangement));
        let held = reader.held(arrangement);
        let input = reader.input(arrangement, held);
        let planets = reader.planets(arrangement);
        let even = reader.even();
        let ratio = reader.ratio();
        let driver = reader.driver(structure);
        let wrong = problems[before..].iter().any(|p| p.severity == Severity::Error);
        let (held, input) = (held?, input?);
        let output = arrangement.shafts().iter().find(|m| **m != input && Some(**m) != held);
        let stage = Self {
            entry,
            arrangement,
            held,
            input,
            output: *output?,
            teeth,
            profile,
            planets: planets?,
            even,
            ratio,
            into: into?,
            driver,
            fields,
        };
        (!wrong).then_some(stage)
    }

    /// The node that a member heats, if given.
    pub(super) fn node_of(&self, member: Member) -> Option<&'r RawValue> {
        match &self.into {
            Heated::One(raw) => Some(raw),
            Heated::Each(nodes) => {
                nodes.iter().find(|(known, _)| *known == member).map(|(_, raw)| *raw)
            }
        }
    }
}

/// Reads the keys and reports their errors.
struct Reader<'f, 'r> {
    fields: &'f Fields<'r>,
    problems: &'f mut Vec<Diagnostic>,
}

impl<'r> Reader<'_, 'r> {
    fn table(&mut self, key: &str, raw: &'r RawValue) -> Option<&'r RawTable> {
        match &raw.kind {
            RawKind::Table(table) => Some(table),
            _ => {
                self.problems.push(self.fields.wrong_shape(key, raw, "a table"));
                None
            }
        }
    }

    /// The teeth of every wheel; the names of the wheels determine the arrangement.
    fn teeth(&mut self) -> Option<(Arrangement, Vec<(Member, &'r RawEntry)>)> {
        let raw = self.fields.require("teeth", self.problems)?;
        let table = self.table("teeth", raw)?;
        let is_pair = table.get("pinion").is_some() || table.get("wheel").is_some();
        let arrangement = if is_pair { Arrangement::Pair } else { Arrangement::Planetary };
        let wheels = arrangement.wheels();
        let right = self.knows_wheels("teeth", table, arrangement);
        let found: Vec<_> =
            wheels.iter().filter_map(|m| Some((*m, table.get(m.word())?))).collect();
        found.iter().for_each(|(member, entry)| self.counted(*member, &entry.value));
        let missing = wheels.iter().find(|member| table.get(member.word()).is_none());
        if let Some(member) = missing.filter(|_| right) {
            let message =
                format!("{} has no `{}`", self.fields.owner.field("teeth"), member.word());
            let help = "write all wheels: `teeth = { sun = 18, planet = 42, ring = 102 }`, or \
                `teeth = { pinion = 20, wheel = 60 }`";
            self.wrong("netlist::missing_field", message, &raw.span, help);
        }
        (found.len() == wheels.len()).then_some((arrangement, found))
    }

    /// A table with numbers of some wheels.
    fn of_wheels(&mut self, key: &str, arrangement: Arrangement) -> Vec<(Member, &'r RawEntry)> {
        let Some(raw) = self.fields.get(key) else { return Vec::new() };
        let Some(table) = self.table(key, raw) else { return Vec::new() };
        self.knows_wheels(key, table, arrangement);
        let wheels = arrangement.wheels().iter();
        wheels.filter_map(|wheel| Some((*wheel, table.get(wheel.word())?))).collect()
    }

    /// Reports names in a table that no wheel has; true if there are none.
    fn knows_wheels(&mut self, key: &str, table: &RawTable, arrangement: Arrangement) -> bool {
        let words: Vec<&str> = arrangement.wheels().iter().map(|member| member.word()).collect();
        let mut right = true;
        for entry in &table.entries {
            if !words.contains(&entry.key.as_str()) {
                right = false;
                let message = format!("{} has no `{}`", self.fields.owner.field(key), entry.key);
                let help = match arrangement {
                    Arrangement::Pair => "a pair of gears has `pinion` and `wheel`".to_owned(),
                    Arrangement::Planetary => {
                        nearest(&entry.key, words.iter().copied(), "a planetary stage has")
                    }
                };
                self.wrong("netlist::unknown_key", message, &entry.key_span, &help);
            }
        }
        right
    }

    /// Checks that a number of teeth is whole and positive, if it is written as a number.
    fn counted(&mut self, member: Member, raw: &RawValue) {
        let (RawKind::Integer(text) | RawKind::Float(text)) = &raw.kind else { return };
        let whole = |z: f64| (1.0..=MOST_TEETH).contains(&z) && z.fract() == 0.0;
        if !text.parse().is_ok_and(whole) {
            let name = &self.fields.owner.words();
            let message = format!("the {} of {name} has {text} teeth", member.word());
            let help = format!("write a whole number from 1 to {MOST_TEETH}");
            self.wrong("netlist::gear_teeth", message, &raw.span, &help);
        }
    }

    /// The fixed member, by its word; `None` if it is wrong.
    fn held(&mut self, arrangement: Arrangement) -> Option<Option<Member>> {
        let why = "has no effect for a pair of gears, whose shafts both turn";
        match (arrangement, self.fields.get("held")) {
            (Arrangement::Pair, None) => Some(None),
            (Arrangement::Pair, Some(_)) => {
                self.useless("held", why);
                None
            }
            (Arrangement::Planetary, None) => Some(Some(Member::Ring)),
            (Arrangement::Planetary, Some(raw)) => {
                self.member("held", raw, arrangement.shafts()).map(Some)
            }
        }
    }

    fn input(&mut self, arrangement: Arrangement, held: Option<Option<Member>>) -> Option<Member> {
        let held = held?;
        let free: Vec<Member> =
            arrangement.shafts().iter().copied().filter(|m| Some(*m) != held).collect();
        match self.fields.get("input") {
            None => free.first().copied(),
            Some(raw) => self.member("input", raw, &free),
        }
    }

    fn member(&mut self, key: &str, raw: &'r RawValue, of: &[Member]) -> Option<Member> {
        let text = self.fields.text(key, raw, self.problems)?;
        let found = of.iter().find(|member| member.word() == text);
        if found.is_none() {
            let message = format!("{} cannot be \"{text}\"", self.fields.owner.field(key));
            let words: Vec<&str> = of.iter().map(|member| member.word()).collect();
            let help = format!("it is one of {}", list(&words));
            self.wrong("netlist::unknown_word", message, &raw.span, &help);
        }
        found.copied()
    }

    fn planets(&mut self, arrangement: Arrangement) -> Option<usize> {
        if arrangement == Arrangement::Pair {
            let why = "has no effect for a pair of gears";
            ["planets", "spacing"].into_iter().for_each(|key| self.useless(key, why));
            return Some(1);
        }
        let raw = self.fields.require("planets", self.problems)?;
        let count = match &raw.kind {
            RawKind::Integer(text) => text.parse::<usize>().ok(),
            _ => None,
        };
        let count = count.filter(|count| (1..=MOST_PLANETS).contains(count));
        if count.is_none() {
            let wanted = format!("a whole number from 1 to {MOST_PLANETS}");
            self.problems.push(self.fields.wrong_shape("planets", raw, &wanted));
        }
        count
    }

    fn even(&mut self) -> bool {
        let Some(raw) = self.fields.get("spacing") else { return true };
        let text = self.fields.text("spacing", raw, self.problems).unwrap_or("even");
        if !["even", "uneven"].contains(&text) {
            let message = format!("{} cannot be \"{text}\"", self.fields.owner.field("spacing"));
            let help = "it is one of `even` and `uneven`";
            self.wrong("netlist::unknown_word", message, &raw.span, help);
        }
        text == "even"
    }

    fn ratio(&mut self) -> Option<(f64, Span)> {
        let raw = self.fields.get("ratio")?;
        let value = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
                parse_quantity(text, Some(Type::SCALAR)).ok()
            }
            _ => None,
        };
        if value.is_none() {
            self.problems.push(self.fields.wrong_shape("ratio", raw, "a number"));
        }
        Some((value?.value, raw.span.clone()))
    }

    /// A node for all, or one for each member that is named.
    fn heated(&mut self, arrangement: Option<Arrangement>) -> Option<Heated<'r>> {
        let raw = self.fields.require("into", self.problems)?;
        let RawKind::Table(table) = &raw.kind else { return Some(Heated::One(raw)) };
        let members = arrangement?.members();
        let words: Vec<&str> = members.iter().map(|member| member.word()).collect();
        let mut nodes = Vec::new();
        for entry in &table.entries {
            match members.iter().find(|member| member.word() == entry.key) {
                Some(member) => nodes.push((*member, &entry.value)),
                None => {
                    let message =
                        format!("{} has no `{}`", self.fields.owner.field("into"), entry.key);
                    let help = nearest(
                        &entry.key,
                        words.iter().copied(),
                        "it names a node for each member: its members are",
                    );
                    self.wrong("netlist::unknown_key", message, &entry.key_span, &help);
                }
            }
        }
        Some(Heated::Each(nodes))
    }

    fn driver(&mut self, structure: &Structure) -> Option<(String, &'r RawValue)> {
        let Some(raw) = self.fields.get("driven_by") else {
            self.fields.require("speed", self.problems);
            return None;
        };
        let text = self.fields.text("driven_by", raw, self.problems)?;
        for key in ["speed", "torque"] {
            self.useless(key, "is that of the stage that drives it");
        }
        Some((structure.resolve(&raw.span, text), raw))
    }

    fn useless(&mut self, key: &str, why: &str) {
        if let Some(span) = self.fields.key(key) {
            let message = format!("{} {why}", self.fields.owner.field(key));
            self.wrong("netlist::useless_key", message, span, &format!("remove `{key}`"));
        }
    }

    fn wrong(&mut self, code: &'static str, message: String, at: &Span, help: &str) {
        self.problems.push(Diagnostic::wrong(code, message, at, help));
    }
}
