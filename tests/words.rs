//! Words that pages, messages and comments avoid, for `wording`, `message_words` and `comments`.
#![allow(clippy::print_stdout, reason = "the counts")]

/// Words that are private to their author, or old, with what to write.
pub(crate) const PRIVATE: [(&str, &str); 14] = [
    ("anew", "again"),
    ("beforehand", "before"),
    ("meanwhile", "while"),
    ("besides", "in addition"),
    ("mend", "correct"),
    ("mends", "corrects"),
    ("mended", "corrected"),
    ("shall", "must"),
    ("nobody", "no one, or passive voice"),
    ("foretell", "predict"),
    ("foretells", "predicts"),
    ("foretold", "predicted"),
    ("reckon", "compute"),
    ("manieth", "every N-th"),
];

/// The same for what users read: pages and messages. Comments may name the type `Ledger`.
pub(crate) const FOR_USERS: [(&str, &str); 11] = [
    ("for ever", "without end"),
    ("ledger", "energy balance"),
    ("of its own", "its own, separate"),
    ("of their own", "their own, separate"),
    ("of his own", "separate"),
    ("of your own", "your own"),
    ("so many", "the number"),
    ("so much", "the number"),
    ("so long", "the number"),
    ("so often", "the number"),
    ("told apart", "distinguished"),
];

/// Words that are right in some places and were used in many wrong ones.
const OFTEN_WRONG: [&[&str]; 6] = [
    &["what"],
    &["where"],
    &["tell", "tells", "told", "telling"],
    &["hold", "holds", "held"],
    &["stand", "stands", "stood"],
    &["beside", "behind"],
];

/// Words with the most that there may be of them together. Lower a number when you can.
pub(crate) type Rare = (&'static [&'static str], usize);

/// The words that are often wrong, with the most of each group, and other groups.
pub(crate) fn rare(most: [usize; 6], others: &[Rare]) -> Vec<Rare> {
    OFTEN_WRONG.into_iter().zip(most).chain(others.iter().copied()).collect()
}

/// Words stay rare; `places` gives the place of each occurrence of one.
pub(crate) fn stay_rare<'a>(groups: &[Rare], places: impl Fn(&str) -> Vec<&'a str>) {
    for (phrases, most) in groups {
        let found: Vec<&str> = phrases.iter().flat_map(|phrase| places(phrase)).collect();
        let said = format!("{phrases:?}: {} for {most}", found.len());
        println!("{said}");
        assert!(found.len() <= *most, "{said}\n{}", found.join("\n"));
    }
}

/// Findings of words that are not there at all.
pub(crate) fn are_absent(found: &[String]) {
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}
