//! The words of comments in the source: a comment begins with a noun or a verb, and private words
//! stay out. `tests/wording.rs` reads the pages.
#![allow(clippy::print_stdout, reason = "the counts")]

use crate::architecture::all_sources;

/// First words of a comment that hide its noun or its condition, and the most comments that may
/// begin with one of them: help of options repeats some. Lower the number when you can.
const FIRST: ([&str; 6], usize) = (["What", "How", "Whether", "Where", "Which", "That"], 14);

/// Words that are private to their author, or old.
const PRIVATE: [&str; 13] = [
    "anew",
    "beforehand",
    "meanwhile",
    "besides",
    "mend",
    "mended",
    "shall",
    "nobody",
    "foretell",
    "foretold",
    "reckon",
    "manieth",
    "sought",
];

/// Words that are right in some places, each with the most that there may be.
const RARE: [(&[&str], usize); 6] = [
    (&["what"], 22),
    (&["tell", "tells", "told", "telling"], 2),
    (&["hold", "holds", "held"], 20),
    (&["stand", "stands", "stood"], 9),
    (&["beside", "behind"], 3),
    (&["books", "course", "courses", "seeks"], 1),
];

/// A comment: the place of its first line, and its words.
struct Comment {
    place: String,
    words: Vec<String>,
}

/// The comments of a source file: lines that follow each other, without code.
fn comments(path: &str, text: &str) -> Vec<Comment> {
    let mut found: Vec<Comment> = Vec::new();
    let mut open = false;
    for (number, line) in text.lines().enumerate() {
        let Some(comment) = line.trim_start().strip_prefix("//") else {
            open = false;
            continue;
        };
        let comment = comment.trim_start_matches(['/', '!']);
        let code = comment.split('`').enumerate();
        let prose: String = code.map(|(k, part)| if k % 2 == 0 { part } else { "X" }).collect();
        let word = |c: char| c.is_alphanumeric() || matches!(c, '\'' | '-');
        let words = prose.split(|c| !word(c)).filter(|word| !word.is_empty());
        let words = words.map(str::to_owned);
        match found.last_mut().filter(|_| open) {
            Some(last) => last.words.extend(words),
            None => {
                let place = format!("{path}:{}", number + 1);
                found.push(Comment { place, words: words.collect() });
            }
        }
        // an empty line of a comment ends a paragraph
        open = !prose.trim().is_empty();
    }
    found
}

/// The comments of all crates, not those of their tests.
fn all() -> Vec<Comment> {
    let sources = all_sources().into_iter().filter(|(path, _)| path.contains("/src/"));
    let all: Vec<Comment> = sources.flat_map(|(path, text)| comments(&path, &text)).collect();
    assert!(all.len() > 8000, "only {} comments were found", all.len());
    all
}

#[test]
fn comments_begin_with_a_noun_or_a_verb() {
    let (words, most) = FIRST;
    let first =
        |comment: &Comment| comment.words.first().is_some_and(|w| words.contains(&w.as_str()));
    let found: Vec<String> = all().into_iter().filter(first).map(|c| c.place).collect();
    println!("{} for {most}", found.len());
    assert!(found.len() <= most, "{} for {most}\n{}", found.len(), found.join("\n"));
}

#[test]
fn private_words_stay_out_of_the_comments() {
    let mut wrong = Vec::new();
    for comment in all() {
        for word in comment.words.iter().map(|word| word.to_lowercase()) {
            if PRIVATE.contains(&word.as_str()) {
                wrong.push(format!("{}: {word}", comment.place));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn words_that_are_often_wrong_stay_rare_in_comments() {
    let all = all();
    for (words, most) in RARE {
        let is = |word: &&String| words.contains(&word.to_lowercase().as_str());
        let places = all.iter().flat_map(|c| c.words.iter().filter(is).map(|_| c.place.as_str()));
        let places: Vec<&str> = places.collect();
        println!("{words:?}: {} for {most}", places.len());
        assert!(
            places.len() <= most,
            "{words:?}: {} for {most}\n{}",
            places.len(),
            places.join("\n")
        );
    }
}
