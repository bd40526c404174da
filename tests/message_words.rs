//! The words of messages: strings of the sources that have a space. Private words stay out, and words
//! that are often wrong stay rare. `tests/wording.rs` reads the pages, `tests/comments.rs` comments.
#![allow(clippy::print_stdout, reason = "the counts")]

use crate::architecture::all_sources;

/// Words and phrases that are private to their author, or old.
const PRIVATE: [&str; 19] = [
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
    "ledger",
    "of its own",
    "of their own",
    "so many",
    "so much",
    "so long",
    "so often",
];

/// Words that are right in some places, each with the most that there may be. Lower a number when
/// you can.
const RARE: [(&[&str], usize); 6] = [
    (&["what"], 9),
    (&["where"], 7),
    (&["tell", "tells", "told", "telling"], 3),
    (&["hold", "holds", "held"], 5),
    (&["stand", "stands", "stood"], 1),
    (&["beside", "behind"], 1),
];

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
        for phrase in PRIVATE.iter().filter(|phrase| message.count(phrase) > 0) {
            wrong.push(format!("{}: {phrase}", message.place));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn words_that_are_often_wrong_stay_rare_in_messages() {
    let all = all();
    for (phrases, most) in RARE {
        let places = all.iter().flat_map(|message| {
            let count = phrases.iter().map(|phrase| message.count(phrase)).sum();
            std::iter::repeat_n(message.place.as_str(), count)
        });
        let places: Vec<&str> = places.collect();
        let said = format!("{phrases:?}: {} for {most}", places.len());
        println!("{said}");
        assert!(places.len() <= most, "{said}\n{}", places.join("\n"));
    }
}
