//! The words of README and docs: those that a reader does not know in this sense stay out, and
//! sentences stay short. `docs/codes` and `docs/keys.md` repeat the program's own messages.

use crate::pages;
use crate::words::{FOR_USERS, PRIVATE, Rare, are_absent, rare, stay_rare};

use std::path::{Path, PathBuf};

use pages::{blocks, lines, pages};

/// The most of the words that are often wrong, as `words` lists them.
const MOST: [usize; 6] = [38, 23, 2, 16, 2, 1];
const OTHERS: [Rare; 2] = [
    (&["in place of", "in the place of", "unless said"], 1),
    (&["book", "books", "course", "courses", "sought", "seeks", "looked at", "looks at"], 3),
];

/// The most words of a sentence; half of them have fewer than the second number.
const LONG: usize = 40;
const MEDIAN: usize = 15;

/// A sentence in lower case, its words, and where it is.
struct Sentence {
    place: String,
    text: String,
    words: Vec<String>,
}

impl Sentence {
    /// How often a phrase is in it.
    fn count(&self, phrase: &str) -> usize {
        let phrase: Vec<&str> = phrase.split(' ').collect();
        self.words.windows(phrase.len()).filter(|window| *window == phrase).count()
    }

    /// "is no path", but not "there is no path", "is no longer" or "the answer is no,".
    fn negates_a_noun(&self) -> bool {
        let words: Vec<&str> = self.text.split_whitespace().collect();
        let one = |part: &[&str]| {
            matches!(part[1], "is" | "are" | "was" | "were" | "be")
                && part[2] == "no"
                && !matches!(
                    part[0].trim_matches(|c: char| !c.is_alphabetic()).to_lowercase().as_str(),
                    "there" | "answer"
                )
                && !matches!(part[3], "longer" | "more")
        };
        words.windows(4).any(one)
    }

    /// Equations are as long as they are.
    fn is_prose(&self) -> bool {
        self.words.len() > 2 && !self.text.contains(" = ")
    }
}

/// Pages that people write.
fn written() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = pages(root);
    pages.extend(["ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| root.join(name)));
    let generated = [root.join("docs/codes"), root.join("docs/keys.md")];
    pages.retain(|page| !generated.iter().any(|repeated| page.starts_with(repeated)));
    pages
}

/// Prose without code: blocks, comments, inline code and targets of links.
fn plain(line: &str) -> String {
    let mut text = String::new();
    for (k, part) in line.split('`').enumerate() {
        text.push_str(if k % 2 == 0 { part } else { "X" });
    }
    let mut plain = String::new();
    for (k, part) in text.split("](").enumerate() {
        let rest = if k == 0 { part } else { part.split_once(')').map_or("", |(_, rest)| rest) };
        plain.push_str(rest);
    }
    plain
}

/// The paragraphs of a page, each with the number of its first line: an item of a list, a cell of a
/// table or lines that follow each other.
fn paragraphs(page: &Path) -> Vec<(usize, String)> {
    let lines = lines(page);
    let blocks = blocks(&lines);
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut open = false;
    for (number, line) in lines.iter().enumerate() {
        let text = plain(line.trim());
        let code = line.starts_with("```") || blocks.iter().any(|b| b.lines.contains(&number));
        if code || text.is_empty() || text.starts_with('#') || text.starts_with("<!--") {
            open = false;
        } else if text.starts_with('|') {
            found.extend(text.trim_matches('|').split('|').map(|cell| (number, cell.to_owned())));
            open = false;
        } else {
            let item = text.starts_with("- ") || text.starts_with(|c: char| c.is_ascii_digit());
            match found.last_mut().filter(|_| open && !item) {
                Some((_, paragraph)) => *paragraph += &format!(" {text}"),
                None => found.push((number, text.trim_start_matches("- ").to_owned())),
            }
            open = true;
        }
    }
    found
}

fn sentences() -> Vec<Sentence> {
    let mut found = Vec::new();
    for page in written() {
        for (number, paragraph) in paragraphs(&page) {
            for text in paragraph.replace(['!', '?', ';', ':'], ".").split(". ") {
                let word = |c: char| c.is_alphanumeric() || matches!(c, '\'' | '-' | '/' | '%');
                let words = text.split(|c| !word(c)).filter(|word| !word.is_empty());
                found.push(Sentence {
                    place: format!("{}:{}", page.display(), number + 1),
                    text: text.trim().to_owned(),
                    words: words.map(str::to_lowercase).collect(),
                });
            }
        }
    }
    found
}

#[test]
fn private_words_stay_out_of_the_pages() {
    let mut wrong = Vec::new();
    for sentence in sentences() {
        for (phrase, better) in PRIVATE.iter().chain(&FOR_USERS) {
            if sentence.count(phrase) > 0 {
                wrong.push(format!("{}: \"{phrase}\": {better}", sentence.place));
            }
        }
        if sentence.negates_a_noun() {
            wrong.push(format!("{}: \"is no\": \"is not a\"", sentence.place));
        }
        if sentence.text.starts_with("Of ") {
            wrong.push(format!("{}: a sentence that begins with \"Of\"", sentence.place));
        }
        if sentence.text.contains(" .. ") || sentence.text.ends_with(" ..") {
            wrong.push(format!("{}: \"..\": \"…\", and say what is left out", sentence.place));
        }
    }
    are_absent(&wrong);
}

#[test]
fn words_that_are_often_wrong_stay_rare() {
    let sentences = sentences();
    stay_rare(&rare(MOST, &OTHERS), |phrase| {
        sentences
            .iter()
            .flat_map(|s| std::iter::repeat_n(s.place.as_str(), s.count(phrase)))
            .collect()
    });
}

#[test]
fn sentences_are_short() {
    let sentences = sentences();
    let prose: Vec<&Sentence> = sentences.iter().filter(|s| s.is_prose()).collect();
    let mut lengths: Vec<usize> = prose.iter().map(|s| s.words.len()).collect();
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    let long: Vec<String> = prose
        .iter()
        .filter(|sentence| sentence.words.len() > LONG)
        .map(|s| format!("{}: {} words: {}", s.place, s.words.len(), s.text))
        .collect();
    println!("median {median}, {} over {} words", long.len(), LONG);
    assert!(median <= MEDIAN && long.is_empty(), "median {median}\n{}", long.join("\n"));
}
