//! Files whose first line names their form: nothing in them has to be guessed.
//!
//! LabVIEW: National Instruments, Specification for the LabVIEW Measurement File (.lvm). A header and
//! the description of a segment each end with `***End_of_Header***`; the names of the columns follow.
//! `X_Value` is in the unit of `X_Dimension`, seconds for `Time`. Only the first row needs a comment.
//!
//! Yokogawa: GX10/GX20/GP10/GP20 User's Manual, IM 04L51B01-01EN, appendix on text files (`YREC`).
//! The lines `Ch` and `Unit` are above `Sampling Data`. A block of messages may follow the rows.

use std::ops::Range;

use crate::dialect::Dialect;
use crate::numeral::Decimal;

/// The program or instrument that wrote a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Maker {
    LabView,
    PicoLog,
    Yokogawa,
}

/// The end of a header of LabVIEW.
const MARK: &str = "***End_of_Header***";

impl Maker {
    fn of(text: &str) -> Option<Self> {
        let first = text.trim_start_matches('\u{feff}').lines().next()?.trim_end();
        match first {
            "LabVIEW Measurement" => Some(Self::LabView),
            "YREC" => Some(Self::Yokogawa),
            _ => None,
        }
    }

    /// Words for its form.
    pub(crate) fn told(self) -> &'static str {
        match self {
            Self::LabView => "the header of LabVIEW",
            Self::PicoLog => "`C` as degC",
            Self::Yokogawa => "the header of a Yokogawa recorder",
        }
    }
}

/// The dialect of a file of a known maker.
pub(crate) fn known(text: &str) -> Option<Dialect> {
    match Maker::of(text)? {
        Maker::LabView => labview(text),
        Maker::Yokogawa => yokogawa(text),
        Maker::PicoLog => None, // its header shows it
    }
}

fn labview(text: &str) -> Option<Dialect> {
    let mut marks = lines(text).filter(|line| text[line.clone()].trim_end() == MARK);
    let first = marks.next()?;
    // the description of the first segment may be left out
    let end = marks.next().unwrap_or_else(|| first.clone());
    let tag = |name: &str| tagged(text, 0..first.start, name).and_then(|line| value(text, line));
    let segment = first.end..end.start.max(first.end);
    let header =
        lines(text).find(|line| line.start > end.start && !text[line.clone()].trim().is_empty())?;
    let seconds = tagged(text, segment.clone(), "X_Dimension")
        .is_none_or(|line| text[line].split_whitespace().skip(1).all(|word| word == "Time"));
    Some(Dialect {
        separator: if tag("Separator") == Some("Comma") { b',' } else { b'\t' },
        stated: Some(if tag("Decimal_Separator") == Some(",") {
            Decimal::Comma
        } else {
            Decimal::PointOnly
        }),
        start: header.start,
        units: tagged(text, segment, "Y_Unit_Label"),
        seconds: seconds.then_some("X_Value"),
        remark: Some("Comment"),
        maker: Some(Maker::LabView),
        ..Dialect::PLAIN
    })
}

fn yokogawa(text: &str) -> Option<Dialect> {
    let data = tagged(text, 0..text.len(), "Sampling Data")?;
    let header = tagged(text, 0..data.start, "Ch")?;
    let separator = *text.as_bytes().get(header.start + "Ch".len())?;
    let messages = ["Massage Data", "Message Data"];
    let end = messages.iter().find_map(|name| tagged(text, data.end..text.len(), name));
    Some(Dialect {
        separator,
        start: header.start,
        units: tagged(text, header.end..data.start, "Unit"),
        rows: lines(text).map(|line| line.start).find(|start| *start > data.start),
        end: end.map(|line| line.start),
        maker: Some(Maker::Yokogawa),
        ..Dialect::PLAIN
    })
}

/// The lines of a text, without their ends.
fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut at = 0;
    text.split_inclusive('\n').map(move |line| {
        let start = at;
        at += line.len();
        start..start + line.trim_end_matches(['\n', '\r']).len()
    })
}

/// The line of a part of a text whose first cell is this tag.
fn tagged(text: &str, part: Range<usize>, tag: &str) -> Option<Range<usize>> {
    let found = lines(text.get(part.clone())?).find(|line| {
        let rest = text[part.start + line.start..part.start + line.end].strip_prefix(tag);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['\t', ',', ';']))
    })?;
    Some(part.start + found.start..part.start + found.end)
}

/// The second cell of a line.
fn value(text: &str, line: Range<usize>) -> Option<&str> {
    let (_, value) = text[line].split_once(['\t', ','])?;
    Some(value.trim_end_matches('\t'))
}
