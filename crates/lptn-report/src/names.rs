//! Names that must be short, and texts that must be harmless.

use unicode_width::UnicodeWidthStr;

/// A name of at most `room` columns, `planetary_..ring_17`: the ends of names distinguish them.
pub fn shortened(name: &str, room: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if name.width() <= room {
        return name.to_owned();
    }
    let keep = room.saturating_sub(2);
    let (head, tail) = (keep / 2, keep - keep / 2);
    let start: String = letters[..head.min(letters.len())].iter().collect();
    let end: String = letters[letters.len() - tail.min(letters.len())..].iter().collect();
    format!("{start}..{end}")
}

/// The parts in which names differ, between word boundaries.
/// Those of `runs/1000rpm.csv` and `runs/7000rpm.csv` are `1000rpm` and `7000rpm`. Returns the
/// names themselves if a part would be empty or all are equal.
pub fn differing(names: &[String]) -> Vec<String> {
    let Some(first) = names.first() else { return Vec::new() };
    let is_border = |c: char| !c.is_alphanumeric();
    let same = |length: usize, end: bool| {
        names.iter().all(|name| match end {
            false => name.get(..length) == first.get(..length),
            true => {
                name.len() >= length
                    && name.get(name.len() - length..) == first.get(first.len() - length..)
            }
        })
    };
    let borders = || first.char_indices().filter(|(_, c)| is_border(*c));
    let head =
        borders().map(|(at, c)| at + c.len_utf8()).filter(|&length| same(length, false)).max();
    let tail = borders().map(|(at, _)| first.len() - at).filter(|&length| same(length, true)).max();
    let (head, tail) = (head.unwrap_or(0), tail.unwrap_or(0));
    let part = |name: &String| Some(name.get(head..name.len().checked_sub(tail)?)?.to_owned());
    let parts: Option<Vec<String>> =
        names.iter().map(|name| part(name).filter(|p| !p.is_empty())).collect();
    parts.unwrap_or_else(|| names.to_vec())
}

/// Names of files without the folders that all have in common: `a/1.csv` and `b/1.csv` of
/// `runs/a/1.csv` and `runs/b/1.csv`. They distinguish files of one name and are whole.
pub fn without_folders(names: &[String]) -> Vec<String> {
    let folders = |name: &str| name.rfind(['/', '\\']).map_or(0, |at| at + 1);
    let Some(first) = names.first() else { return Vec::new() };
    let shared = |at: &usize| names.iter().all(|name| name.get(..*at) == first.get(..*at));
    let ends = first[..folders(first)].match_indices(['/', '\\']).map(|(at, _)| at + 1);
    let head = ends.take_while(shared).last().unwrap_or(0);
    names.iter().map(|name| name[head..].to_owned()).collect()
}

/// A text on one line without control characters, so that no file can steer the terminal.
pub fn plain(text: &str) -> String {
    let one_line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    one_line.chars().filter(|c| !c.is_control()).collect()
}

#[cfg(test)]
mod tests {
    use super::{differing, plain, without_folders};
    use crate::layout::{Align, Column};

    #[test]
    fn files_of_one_name_keep_the_folders_that_differ() {
        let names = |all: &[&str]| all.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        for (all, expected) in [
            (names(&["runs/spring/1.csv", "runs/autumn/1.csv"]), ["spring/1.csv", "autumn/1.csv"]),
            (names(&["runs/1000rpm.csv", "runs/1000rpm_b.csv"]), ["1000rpm.csv", "1000rpm_b.csv"]),
            (names(&["1.csv", "runs/1.csv"]), ["1.csv", "runs/1.csv"]),
            (names(&["a/x.csv", "a/x.csv"]), ["x.csv", "x.csv"]),
        ] {
            assert_eq!(without_folders(&all), expected);
        }
        assert_eq!(without_folders(&names(&["a\\b\\c.csv"])), ["c.csv"]);
    }

    #[test]
    fn names_are_told_apart_by_the_part_that_differs() {
        let names = |all: &[&str]| all.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let records = names(&["runs/1000rpm_a.csv", "runs/7000rpm_a.csv"]);
        assert_eq!(differing(&records), ["1000rpm", "7000rpm"]);
        for alone in [names(&["a.csv"]), names(&["a.csv", "a.csv"]), names(&["ab", "abc"])] {
            assert_eq!(differing(&alone), alone);
        }
        let middle = names(&[
            "records_of_spring/1000rpm_run/logger_7_of_8.csv",
            "records_of_spring/2000rpm_run/logger_7_of_8.csv",
        ]);
        let mut column = Column::new("record", Align::Left, middle).names();
        column.shorten(20);
        assert_eq!(column.cells, ["1000rpm", "2000rpm"]);
    }

    #[test]
    fn titles_cannot_steer_the_terminal() {
        assert_eq!(plain("a\u{1b}[31mred\n\tb"), "a[31mred b");
    }
}
