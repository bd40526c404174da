//! Prepares the pages for mdBook, which calls it as a preprocessor: the book comes in as JSON on
//! stdin and goes out as JSON on stdout.
//!
//! - Equations, written as GitHub shows them (a block ` ```math `, or `` $`..`$ `` in a line),
//!   become MathML, so that a browser needs no script for them.
//! - A block that is a file, ` ```toml motor.toml `, or lines of one, ` ```toml from motor.toml `,
//!   has its name above it.
//! - A link that leads out of `docs` (`../networks/motor.toml`) becomes its text, for the book goes
//!   without the project; one to a `README.md` leads to the `index.html` that mdBook makes of it.
//!
//! An equation that cannot be read is an error that names the page. The program is outside the
//! workspace, so that only the book pays for its dependency.

use std::error::Error;
use std::io::{Read as _, Write as _};
use std::path::{Component, Path};

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, mathml::push_mathml};
use serde_json::Value;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    if std::env::args().nth(1).as_deref() == Some("supports") {
        return Ok(()); // any renderer
    }
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let mut both: Value = serde_json::from_str(&text)?;
    let book = both.get_mut(1).ok_or("mdBook sends its context and the book")?;
    chapters(book)?;
    Ok(std::io::stdout().write_all(serde_json::to_string(book)?.as_bytes())?)
}

/// Prepares every chapter below a value of the book.
fn chapters(value: &mut Value) -> Outcome<()> {
    match value {
        Value::Array(items) => items.iter_mut().try_for_each(chapters),
        Value::Object(fields) => {
            let path = fields.get("path").and_then(Value::as_str).map(str::to_owned);
            if let (Some(path), Some(Value::String(content))) = (path, fields.get_mut("content")) {
                *content = page(content, Path::new(&path))?;
            }
            fields.values_mut().try_for_each(chapters)
        }
        _ => Ok(()),
    }
}

/// A page with its equations and links; blocks of code stay as they are.
fn page(text: &str, path: &Path) -> Outcome<String> {
    let (mut out, mut words, mut block) = (String::new(), String::new(), None::<(String, String)>);
    for line in text.lines() {
        match (line.strip_prefix("```"), block.take()) {
            (Some(info), None) => {
                out += &prose(&std::mem::take(&mut words), path)?;
                block = Some((info.trim().to_owned(), String::new()));
            }
            // a paragraph may go on without an empty line, and would take the equation in
            (Some(_), Some((info, body))) if info == "math" => {
                out += &format!("\n{}\n\n", mathml(&body, DisplayMode::Block, path)?);
            }
            (Some(_), Some((info, body))) => {
                out += &format!("{}```{info}\n{body}```\n", file_name(&info));
            }
            (None, Some((info, body))) => block = Some((info, format!("{body}{line}\n"))),
            (None, None) => words += &format!("{line}\n"),
        }
    }
    if block.is_some() {
        return Err(format!("{}: a block is not closed", path.display()).into());
    }
    Ok(out + &prose(&words, path)?)
}

/// The name of the file that a block is, or from which its lines are, as a line above it.
fn file_name(info: &str) -> String {
    let words: Vec<&str> = info.split(' ').skip(1).collect();
    let name = words.iter().find(|word| word.contains('.'));
    name.map_or_else(String::new, |name| format!("\n<div class=\"file\">{name}</div>\n\n"))
}

fn prose(text: &str, path: &Path) -> Outcome<String> {
    Ok(links(&inline(text, path)?, path))
}

/// Text with its equations as MathML.
fn inline(line: &str, path: &Path) -> Outcome<String> {
    let mut out = String::new();
    let mut rest = line;
    while let Some((before, (tex, after))) =
        rest.split_once("$`").and_then(|(before, more)| Some((before, more.split_once("`$")?)))
    {
        out += before;
        out += &mathml(tex, DisplayMode::Inline, path)?;
        rest = after;
    }
    Ok(out + rest)
}

fn mathml(tex: &str, display_mode: DisplayMode, path: &Path) -> Outcome<String> {
    let storage = Storage::new();
    let mut out = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let events: Result<Vec<_>, _> = Parser::new(tex, &storage).collect();
    let events = events.map_err(|error| format!("{}: {tex}\n{error}", path.display()))?;
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut out, events, config)?;
    Ok(out.replace('\n', ""))
}

/// Text with its links as the book needs them.
fn links(line: &str, path: &Path) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some((before, more)) = rest.split_once("](") {
        let Some((target, after)) = more.split_once(')') else { break };
        let opens = before.rfind('[');
        match opens {
            Some(at) if leaves(target, path) => {
                out += &before[..at];
                out += &before[at + 1..];
            }
            _ => out += &format!("{before}]({})", target.replace("README.md", "index.md")),
        }
        rest = after;
    }
    out + rest
}

/// Whether a link of a page leads out of the book's folder.
fn leaves(target: &str, path: &Path) -> bool {
    let mut depth = path.components().count() as i64 - 1;
    if target.contains("://") || target.starts_with('#') {
        return false;
    }
    for part in Path::new(target).components() {
        depth += if part == Component::ParentDir { -1 } else { 1 };
        if depth < 0 {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_become_mathml_and_blocks_of_code_stay() {
        let text = "a $`x^2`$ b\n\n```math\n\\frac{1}{2}\n```\n```toml\nx = \"$`y`$\"\n```\n";
        let made = page(text, Path::new("a.md")).unwrap();
        assert!(made.contains("<msup>") && made.contains("<mfrac>"), "{made}");
        assert!(made.contains("x = \"$`y`$\""), "{made}");
        assert!(page("$`\\nonsense`$", Path::new("a.md")).is_err());
        let made = page("so\n```math\nx\n```\n| a |\n", Path::new("a.md")).unwrap();
        assert!(made.starts_with("so\n\n<math") && made.ends_with("</math>\n\n| a |\n"), "{made}");
        assert!(page("```\nopen", Path::new("a.md")).is_err());
    }

    #[test]
    fn blocks_that_are_files_show_their_names() {
        let shown = |info: &str| page(&format!("```{info}\nx\n```\n"), Path::new("a.md")).unwrap();
        let above = "\n<div class=\"file\">motor.toml</div>\n\n```toml";
        assert!(shown("toml motor.toml").starts_with(above));
        assert!(shown("toml from motor.toml").starts_with(above));
        assert!(shown("console by-hand").starts_with("```") && shown("toml").starts_with("```"));
    }

    #[test]
    fn links_out_of_the_book_become_text() {
        let of = |line: &str, page: &str| links(line, Path::new(page));
        assert_eq!(of("see [it](../net.toml), [b](b.md)", "a.md"), "see it, [b](b.md)");
        assert_eq!(
            of("[up](../a.md) [x](https://x.org)", "e/b.md"),
            "[up](../a.md) [x](https://x.org)"
        );
        assert_eq!(of("[far](../../x.md)", "e/b.md"), "far");
        assert_eq!(of("[all](elements/README.md#a)", "a.md"), "[all](elements/index.md#a)");
    }
}
