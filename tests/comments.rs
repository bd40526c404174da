//! The words of comments in the source: a comment begins with a noun or a verb, and private words
//! stay out. `tests/wording.rs` reads the pages.
#![allow(clippy::print_stdout, reason = "the counts")]

use crate::architecture::all_sources;
use crate::words::{PRIVATE, Rare, are_absent, rare, stay_rare};

/// First words of a comment that hide its noun or its condition, and the most comments that may
/// begin with one of them: help of options repeats some. Lower the number when you can.
const FIRST: ([&str; 6], usize) = (["What", "How", "Whether", "Where", "Which", "That"], 14);

/// The most of the words that are often wrong, as `words` lists them.
const MOST: [usize; 6] = [21, 143, 2, 19, 9, 3];
const OTHERS: [Rare; 2] = [(&["sought"], 0), (&["books", "course", "courses", "seeks"], 1)];

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
            for (_, better) in PRIVATE.iter().filter(|(private, _)| *private == word) {
                wrong.push(format!("{}: {word}: {better}", comment.place));
            }
        }
    }
    are_absent(&wrong);
}

#[test]
fn words_that_are_often_wrong_stay_rare_in_comments() {
    let all = all();
    stay_rare(&rare(MOST, &OTHERS), |wanted| {
        let is = |word: &&String| word.to_lowercase() == wanted;
        all.iter().flat_map(|c| c.words.iter().filter(is).map(|_| c.place.as_str())).collect()
    });
}
