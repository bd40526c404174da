//! Another number instead of a parameter's own; the rest of the file stays.
//!
//! A number is written into its own bytes, not through a TOML printer. Unit, comments and order
//! stay. The new text is read back and compared before the file is replaced.

use std::ops::Range;

use lptn_data::FileId;
use lptn_network::{Field, Item, ParameterId};
use lptn_units::{Unit, UnitError, UnitErrorKind, written_quantity};

use crate::netlist::Netlist;

/// The number that a file gives to a parameter.
#[derive(Clone, Debug)]
pub struct WrittenNumber {
    /// The unit it is written in.
    pub unit: Unit,
    file: FileId,
    /// Its bytes in the file.
    place: Range<usize>,
}

impl Netlist {
    /// The help for a number without a unit: the unit that the parameter has in the netlist.
    pub(crate) fn in_its_unit(
        &self,
        parameter: &str,
        value: &str,
        error: &UnitError,
    ) -> Option<String> {
        let bare =
            matches!(&error.kind, UnitErrorKind::BareNumber { wanted, .. } if !wanted.absolute);
        let id = self.network.parameter(parameter).ok().filter(|_| bare)?;
        let unit = self.written_number(id)?.unit.text;
        Some(format!("write \"{} {unit}\"", value.trim()))
    }

    /// The place and the unit of a parameter's number in the file; `None` if its value is an
    /// expression or a string with escapes.
    pub fn written_number(&self, id: ParameterId) -> Option<WrittenNumber> {
        let (item, field) = (Item::Parameter(id), Field::Value);
        let span = self.source_map.get(item, field)?;
        let text = self.files.at(&span);
        let quoted = text.starts_with(['"', '\'']);
        let content = if quoted { self.source_map.content(item, field)? } else { span.range.start };
        let inside = self.files.text(span.file).get(content..span.range.end)?;
        let inside = if quoted { inside.split(['"', '\'']).next()? } else { inside };
        let written = written_quantity(inside)?;
        let place = content + written.number.start..content + written.number.end;
        Some(WrittenNumber { unit: written.unit, file: span.file, place })
    }

    /// Another parameter whose value is written at the same place: that of another instance of a
    /// template.
    pub fn written_together(&self, id: ParameterId) -> Option<String> {
        let place = self.source_map.parameter(id)?;
        let others = self.network.parameter_ids().filter(|other| *other != id);
        let same = |other: &ParameterId| {
            self.source_map.parameter(*other).is_some_and(|there| there.is_same_text(&place))
        };
        others
            .into_iter()
            .find(same)
            .map(|other| self.network.name_of(Item::Parameter(other)).into_owned())
    }

    /// True if a number is in the netlist's own file, not in one that it includes.
    pub fn is_own(&self, written: &WrittenNumber) -> bool {
        self.inputs.first() == Some(&written.file)
    }

    /// The text of the file with `number` instead of the one written there: comments, order, unit
    /// and standard deviation stay. Another number cannot change the extent of a string or a
    /// comment, so the text is cut at the number's place rather than parsed and printed again.
    pub fn text_with_number(&self, written: &WrittenNumber, number: &str) -> String {
        self.text_with_numbers(&[(written.clone(), number.to_owned())])
    }

    /// The same for several numbers of one file, each at a separate place. Returns the text of the
    /// first one's file.
    pub fn text_with_numbers(&self, numbers: &[(WrittenNumber, String)]) -> String {
        let Some((first, _)) = numbers.first() else { return String::new() };
        let mut numbers: Vec<_> =
            numbers.iter().filter(|(written, _)| written.file == first.file).collect();
        numbers.sort_by_key(|(written, _)| written.place.start);
        let text = self.files.text(first.file);
        let (mut whole, mut end) = (String::with_capacity(text.len()), 0);
        for (written, number) in numbers {
            whole += text.get(end..written.place.start).unwrap_or_default();
            whole += number;
            end = written.place.end;
        }
        whole + text.get(end..).unwrap_or_default()
    }
}
