//! The words of messages: strings of the sources that have a space. Private words stay out, and words
//! that are often wrong stay rare. `tests/wording.rs` reads the pages, `tests/comments.rs` comments.
use crate::architecture::all_sources;
use crate::words::{FOR_USERS, PRIVATE, are_absent, rare, stay_rare};

/// The most of the words that are often wrong, as `words` lists them.
const MOST: [usize; 6] = [5, 5, 0, 3, 1, 1];

/// A string in lower case: its place, and its words between spaces.
struct Message {
    place: String,
    text: String,
}

impl Message {
    fn count(&self, phrase: &str) -> usize {
        self.text.matches(&format!(" {phrase} ")).count()
    }
}

/// A string without names in backticks and values in braces.
fn plain(text: &str) -> String {
    let code = text.split('`').enumerate();
    let text: String = code.map(|(k, part)| if k % 2 == 0 { part } else { "x" }).collect();
    let mut plain = String::new();
    let mut inside = 0_usize;
    for letter in text.chars() {
        match letter {
            '{' => inside += 1,
            '}' => inside = inside.saturating_sub(1),
            _ if inside == 0 => plain.push(letter),
            _ => {}
        }
    }
    let words =
        plain.split(|c: char| !(c.is_alphanumeric() || matches!(c, '-' | '\'' | '_' | '"')));
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    format!(" {} ", words.join(" ").to_lowercase())
}

/// The strings of a file, without its comments and tests.
fn messages(path: &str, text: &str) -> Vec<Message> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"));
    let of_line = |(number, line): (usize, &str)| {
        let line = line.replace("\\\"", "'");
        let strings = line.split('"').skip(1).step_by(2).filter(|string| string.contains(' '));
        let message = |s: &str| Message { place: format!("{path}:{}", number + 1), text: plain(s) };
        strings.map(message).collect::<Vec<_>>()
    };
    lines.flat_map(of_line).collect()
}

fn all() -> Vec<Message> {
    let sources = all_sources().into_iter().filter(|(path, _)| {
        path.contains("/src/") && !path.contains("/tests") && !path.ends_with("tests.rs")
    });
    let all: Vec<Message> = sources.flat_map(|(path, text)| messages(&path, &text)).collect();
    assert!(all.len() > 3000, "only {} messages were found", all.len());
    all
}

#[test]
fn private_words_stay_out_of_the_messages() {
    let mut wrong = Vec::new();
    for message in all() {
        for (phrase, better) in PRIVATE.iter().chain(&FOR_USERS) {
            if message.count(phrase) > 0 {
                wrong.push(format!("{}: {phrase}: {better}", message.place));
            }
        }
    }
    are_absent(&wrong);
}

#[test]
fn words_that_are_often_wrong_stay_rare_in_messages() {
    let all = all();
    stay_rare(&rare(MOST, &[]), |phrase| {
        all.iter()
            .flat_map(|message| std::iter::repeat_n(message.place.as_str(), message.count(phrase)))
            .collect()
    });
}
