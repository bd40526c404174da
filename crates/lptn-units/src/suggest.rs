//! "Did you mean": the nearest name.

/// Longer names are not compared: the table below grows with the square of the length.
const LONGEST: usize = 64;

/// The candidate nearest to `name`, or `None` when nothing is near.
///
/// Near means: equal except for case, or at most one edit for every three characters (one edit for
/// names of two to five) by the Damerau-Levenshtein distance in which no part is edited twice
/// (optimal string alignment). Among equally near candidates those of the same length win, then the
/// first.
///
/// Source: R. A. Wagner and M. J. Fischer, Journal of the ACM 21 (1974) 168, with the transposition
/// of neighbours added.
pub fn suggest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = name.chars().take(LONGEST + 1).collect();
    if wanted.is_empty() || wanted.len() > LONGEST {
        return None;
    }
    let mut best: Option<(usize, &'a str)> = None;
    for candidate in candidates.filter(|c| *c != name) {
        let Some(rank) = rank(name, &wanted, candidate) else { continue };
        if best.is_none_or(|(least, _)| rank < least) {
            best = Some((rank, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// 0 for a difference in case alone, otherwise more the larger the distance; `None` when too far.
fn rank(name: &str, wanted: &[char], candidate: &str) -> Option<usize> {
    if name.eq_ignore_ascii_case(candidate) {
        return Some(0);
    }
    let length = candidate.chars().take(LONGEST + 1).count();
    let longer = wanted.len().max(length);
    let limit = if !(2..=LONGEST).contains(&longer) { 0 } else { (longer / 3).max(1) };
    // Two single letters, or a letter and a pair, have nothing in common to go by.
    let limit = if wanted.len().min(length) < 2 && longer < 3 { 0 } else { limit };
    // most candidates fall out here, before anything is copied
    if limit == 0 || wanted.len().abs_diff(length) > limit {
        return None;
    }
    let found: Vec<char> = candidate.chars().collect();
    let distance = distance(wanted, &found)?;
    (distance <= limit).then_some(2 * distance + usize::from(wanted.len() != length))
}

/// Optimal string alignment distance.
fn distance(a: &[char], b: &[char]) -> Option<usize> {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for (i, &x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, &y) in b.iter().enumerate() {
            let swapped = i > 0 && j > 0 && a[i - 1] == y && b[j - 1] == x;
            let replace = above[j] + usize::from(x != y);
            let mut least = replace.min(above[j + 1] + 1).min(row[j] + 1);
            if swapped {
                least = least.min(before[j - 1] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above.last().copied()
}

#[cfg(test)]
mod tests {
    use super::{distance, suggest};

    #[test]
    fn swapped_and_missing_letters_are_near() {
        let names = ["ambient", "aluminium", "steel"];
        assert_eq!(suggest("ambiant", names.into_iter()), Some("ambient"));
        assert_eq!(suggest("stele", names.into_iter()), Some("steel"));
        assert_eq!(suggest("aluminum", names.into_iter()), Some("aluminium"));
        assert_eq!(suggest("Steel", names.into_iter()), Some("steel"));
        assert_eq!(suggest("bronze", names.into_iter()), None);
    }

    #[test]
    fn single_letters_are_near_only_in_case() {
        assert_eq!(suggest("w", ["K", "W"].into_iter()), Some("W"));
        assert_eq!(suggest("x", ["K", "W"].into_iter()), None);
    }

    /// Wagner and Fischer's kind of examples; with "no part is edited twice" `ca` to `abc` takes
    /// three edits, not two.
    #[test]
    fn distances_are_those_of_the_literature() {
        let table = [
            ("kitten", "sitting", 3),
            ("saturday", "sunday", 3),
            ("intention", "execution", 5),
            ("ca", "abc", 3),
            ("abcd", "acbd", 1),
            ("abcdef", "bacdfe", 2),
            ("", "abc", 3),
            ("abc", "", 3),
        ];
        for (a, b, edits) in table {
            let letters = |text: &str| text.chars().collect::<Vec<char>>();
            assert_eq!(distance(&letters(a), &letters(b)), Some(edits), "{a} {b}");
            assert_eq!(distance(&letters(b), &letters(a)), Some(edits), "{b} {a}");
        }
    }

    fn near(name: &str, candidate: &str) -> bool {
        suggest(name, [candidate].into_iter()).is_some()
    }

    #[test]
    fn one_edit_is_near_for_every_three_characters() {
        assert!(
            near("abc", "abx")
                && near("ab", "ax")
                && near("abcde", "abcdx")
                && !near("abcde", "abcxy")
        );
        assert!(near("abcdef", "abcdxy") && !near("abcdef", "abcxyz"));
        assert!(near("abcdefgh", "abcdefxy") && !near("abcdefgh", "abcdexyz"));
        assert!(near("abcdefghi", "abcdefxyz"));
        // the longer of the two counts
        assert!(near("abcdefgh", "abcdefghxyz") && !near("abcdefg", "abcdefgxyz1"));
        assert!(
            !near("w", "wa")
                && !near("wa", "w")
                && !near("", "a")
                && near("ab", "abc")
                && !near("a", "abc")
        );
    }

    #[test]
    fn names_of_more_than_64_characters_are_near_only_in_case() {
        let name = "x".repeat(63);
        assert!(near(&format!("{name}a"), &format!("{name}b")));
        assert!(
            !near(&format!("{name}aa"), &format!("{name}a"))
                && !near(&format!("{name}a"), &format!("{name}aa"))
        );
        assert!(
            near(&format!("{name}a"), &format!("{name}A"))
                && !near(&format!("{name}aa"), &format!("{name}AA"))
        );
    }

    #[test]
    fn of_equally_near_names_those_of_the_same_length_win_and_then_the_first() {
        assert_eq!(suggest("abcde", ["abcdef", "abcdx", "abxde"].into_iter()), Some("abcdx"));
        assert_eq!(
            suggest("abcdef", ["abcdexyz", "abcdefg", "abcxyf"].into_iter()),
            Some("abcdefg")
        );
        assert_eq!(suggest("abcde", ["abcde", "abcdx"].into_iter()), Some("abcdx"));
        assert_eq!(suggest("abcde", ["abcdx", "ABCDE"].into_iter()), Some("ABCDE"));
    }
}
