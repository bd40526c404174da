//! Bearings, seals and gears in oil of a stage: their speed follows from the member that they are
//! on.

use lptn_data::{Diagnostic, list};
use lptn_laws::{Kind, Substance};

use super::declaration::{AGAINST, ON, PARTS};
use super::make::{SIZES, Writer};
use super::member::Member;
use crate::fields::Owner;
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

impl Writer<'_, '_> {
    /// The parts of every section.
    pub(super) fn parts(&mut self, problems: &mut Vec<Diagnostic>) {
        for section in PARTS {
            let Some(raw) = self.stage.fields.get(section) else { continue };
            let RawKind::Table(table) = &raw.kind else {
                problems.push(self.stage.fields.wrong_shape(section, raw, "a table"));
                continue;
            };
            for written in &table.entries {
                self.written(section, written, problems);
            }
        }
    }

    fn written(
        &mut self,
        section: &'static str,
        written: &RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) {
        let owner = Owner::element(section, format!("{}.{}", self.stage.entry.key, written.key));
        if self.is_own(&written.key) {
            let message = format!("{} has a name that gearboxes use themselves", owner.words());
            let help = format!("choose another one, for example `{}_1`", written.key);
            let at = &written.key_span;
            return problems.push(Diagnostic::wrong("network::reserved_name", message, at, help));
        }
        let RawKind::Table(table) = &written.value.kind else {
            let message = format!("{} must be a table of fields", owner.words());
            let help = format!("write it like this: `{}`", self.stage.fields.sample(section));
            let at = &written.value.span;
            return problems.push(Diagnostic::wrong("netlist::not_a_table", message, at, help));
        };
        let Some((member, speed)) = self.turning((&owner, written), table, problems) else {
            return;
        };
        let own = table.entries.iter().filter(|e| ![ON, AGAINST].contains(&e.key.as_str()));
        let mut entries: Vec<RawEntry> = own.cloned().collect();
        entries.push(RawEntry::new("speed", RawValue::text(speed, &written.key_span)));
        if table.get("into").is_none() {
            let Some(node) = self.stage.node_of(member) else {
                return problems.push(self.no_node(member));
            };
            entries.push(RawEntry::new("into", node.clone()));
        }
        if takes_oil(section, table) {
            let keys = ["lubricant", "at"].into_iter().filter(|key| table.get(key).is_none());
            entries.extend(keys.filter_map(|key| self.stage.fields.entry(key)).cloned());
        }
        self.part((section, &written.key), member == Member::Planet, &entries);
    }

    /// True if the block makes an item of this name itself.
    fn is_own(&self, name: &str) -> bool {
        let own = ["force", "mesh", "sun_planet", "planet_ring"];
        let size = SIZES.iter().any(|(key, _)| *key == name);
        let member = self.members().iter().any(|member| member.word() == name);
        let of_wheel = ["z_", "x_", "addendum_"].iter().any(|start| name.starts_with(start));
        own.contains(&name) || size || member || of_wheel
    }

    /// The member that a part is on, and its speed against the housing; against the carrier for a
    /// planet.
    fn turning(
        &self,
        (owner, written): (&Owner<'_>, &RawEntry),
        table: &RawTable,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<(Member, String)> {
        let before = problems.len();
        if let Some(own) = table.get("speed") {
            let message = format!("{} follows from the member that it is on", owner.field("speed"));
            let help = format!("write `{ON} = \"{}\"` instead", self.stage.input.word());
            problems.push(Diagnostic::wrong("netlist::useless_key", message, &own.key_span, help));
        }
        let [on, against] =
            [ON, AGAINST].map(|key| table.get(key).map(|e| (e, self.member(owner, e, problems))));
        let Some((on_entry, on)) = on else {
            let message = format!("{} has no `{ON}`", owner.words());
            let words: Vec<&str> = self.members().iter().map(|member| member.word()).collect();
            let help = format!("name the member that it is on: {}", list(&words));
            let at = &written.key_span;
            problems.push(Diagnostic::wrong("netlist::missing_field", message, at, help));
            return None;
        };
        let on = on?;
        let mut speed = self.name(on, "speed");
        if let Some((entry, against)) = against {
            let against = against?;
            if on == against || on == Member::Planet || against == Member::Planet {
                let message = format!(
                    "{} cannot be \"{}\" for a part on \"{}\"",
                    owner.field(AGAINST),
                    against.word(),
                    on.word()
                );
                let help = "a planet turns in the carrier, which needs no word; other members turn \
                    in the housing, or in another one of them";
                let at = &entry.value.span;
                problems.push(Diagnostic::wrong("netlist::gear_member", message, at, help));
            }
            speed = format!("{speed} - {}", self.name(against, "speed"));
        } else if Some(on) == self.stage.held {
            let message = format!("{} is fixed: a part on it does not turn", owner.field(ON));
            let help = format!(
                "name a member that turns, or with `{AGAINST}` the member that \
                turns in it"
            );
            let at = &on_entry.value.span;
            problems.push(Diagnostic::wrong("netlist::gear_member", message, at, help));
        }
        (problems.len() == before).then_some((on, speed))
    }

    fn members(&self) -> &'static [Member] {
        self.stage.arrangement.members()
    }

    fn member(
        &self,
        owner: &Owner<'_>,
        entry: &RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Member> {
        let words: Vec<&str> = self.members().iter().map(|member| member.word()).collect();
        let help = format!("it is one of {}", list(&words));
        let RawKind::String { text, .. } = &entry.value.kind else {
            let message = format!("{} must be the name of a member", owner.field(&entry.key));
            let at = &entry.value.span;
            problems.push(Diagnostic::wrong("netlist::wrong_shape", message, at, help));
            return None;
        };
        let found = self.members().iter().find(|member| member.word() == text);
        if found.is_none() {
            let message = format!("{} cannot be \"{text}\"", owner.field(&entry.key));
            let at = &entry.value.span;
            problems.push(Diagnostic::wrong("netlist::unknown_word", message, at, help));
        }
        found.copied()
    }
}

/// True if the law of a part reads the lubricant and its table does not give it.
fn takes_oil(section: &str, table: &RawTable) -> bool {
    let Some(kind) = Kind::ALL.iter().find(|kind| kind.declaration().section == section) else {
        return false;
    };
    let selector = kind.declaration().selector.and_then(|key| table.get(key));
    let Some(RawKind::String { text: word, .. }) = selector.map(|entry| &entry.value.kind) else {
        return false;
    };
    kind.laws().filter(|law| law.declaration().name == word).any(|law| {
        let mut fields = law.declaration().fields.iter();
        fields.any(|f| f.property == Some(Substance::Lubricant) && table.get(f.key).is_none())
    })
}
