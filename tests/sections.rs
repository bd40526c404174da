//! Property: what follows from the declaration of a section, for each of them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use lptn_laws::Kind;
use lptn_netlist::{Role, SectionDeclaration, format};

fn is_path(section: &SectionDeclaration) -> bool {
    Kind::ALL.iter().any(|kind| kind.declaration().section == section.name)
}

#[test]
fn every_section_and_key_says_what_it_is() {
    for section in &format().sections {
        assert!(
            section.sentence.ends_with('.') && section.sentence.len() > 12,
            "[{}]",
            section.name
        );
        assert!(!section.example.is_empty(), "[{}]", section.name);
        for key in section.keys {
            let said = !key.takes().is_empty() && key.meaning.len() > 4 && !key.example.is_empty();
            assert!(said, "`{}` of [{}]", key.name, section.name);
            assert!(
                section.elsewhere.iter().all(|(other, _)| *other != key.name),
                "`{}`",
                key.name
            );
        }
    }
}

#[test]
fn a_key_that_is_misspelt_is_refused_with_what_there_is() {
    let element = |section: &SectionDeclaration, key: &str| match section.role {
        Role::Default | Role::Import => format!("format = 1\n[{}]\n{key} = 1\n", section.name),
        _ if ["run", "uncertainty"].contains(&section.name) => {
            format!("format = 1\n[{}]\n{key} = 1\n", section.name)
        }
        _ => format!("format = 1\n[{}.a]\n{key} = 1\n", section.name),
    };
    let sections =
        format().sections.iter().filter(|s| !s.keys.is_empty() && s.role != Role::Template);
    for section in sections {
        let rejected = lptn::parse("a.toml", &element(section, "qqqqqq")).unwrap_err().to_string();
        for key in section.keys {
            assert!(
                rejected.contains(&format!("`{}`", key.name)),
                "[{}]: {rejected}",
                section.name
            );
        }
    }
}

/// The heading, sentence and keys of a section that has no page in `docs/elements`.
fn with_keys(section: &SectionDeclaration) -> String {
    let mut text = format!("\n## `[{}]`\n{}\n", section.name, section.sentence);
    if !section.keys.is_empty() {
        text += "\n| Key | Takes | Meaning | Default | Example |\n|---|---|---|---|---|\n";
    }
    for key in section.keys {
        let default = if key.default.is_empty() { "" } else { &format!(" {}", key.default) };
        text += &format!(
            "| `{}` | {} | {} |{default} | `{}` |\n",
            key.name,
            key.takes(),
            key.meaning,
            key.example
        );
    }
    text
}

fn page() -> String {
    let mut text = "# Sections and keys\n\
        Every section of a netlist with its keys, as they are declared. \
        [The reference](netlist.md) says\nhow they belong together. \
        `LPTN_BLESS=1 cargo test --test all sections::` writes this page.\n"
        .to_owned();
    let (paths, others): (Vec<_>, Vec<_>) = format().sections.iter().partition(|s| is_path(s));
    text += &others.into_iter().map(with_keys).collect::<String>();
    text += "\n## Paths and sources\n\n| Section: keys and laws | Describes |\n|---|---|\n";
    for section in paths {
        let (name, sentence) = (section.name, section.sentence.trim_end_matches('.'));
        text += &format!("| [`[{name}]`](elements/{name}.md) | {sentence} |\n");
    }
    text
}

/// `LPTN_BLESS=1` writes the page anew.
#[test]
fn every_key_stands_in_the_page() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/keys.md");
    if std::env::var_os("LPTN_BLESS").is_some() {
        std::fs::write(&path, page()).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap_or_default(), page(), "LPTN_BLESS=1 writes it");
}
