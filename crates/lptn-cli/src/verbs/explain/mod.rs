//! `lptn explain`

mod args;
mod codes;
mod page;

pub(crate) use args::ExplainArgs;

use codes::Code;
use lptn_netlist::Diagnostic;
use page::Explained;

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

pub(crate) fn explain(args: &ExplainArgs, console: &Console) -> Result<Exit, Failure> {
    let codes = codes::all();
    let said = |text: &String| codes::words().find(|code| code.code.eq_ignore_ascii_case(text));
    let explained = match &args.code {
        Some(text) if said(text).is_some() => {
            Explained { codes: said(text).into_iter().collect(), named: true }
        }
        None => Explained { codes, named: false },
        Some(text) => match in_words(text, &codes) {
            found if found.is_empty() => asked(bare(text), codes)?,
            found => Explained { named: found.len() == 1, codes: found },
        },
    };
    console.show(&explained, args.printed.format)
}

/// The codes of several words, such as "limit broken": the words of verdicts among them, else the
/// codes whose names and summaries have all of them.
fn in_words(text: &str, codes: &[Code]) -> Vec<Code> {
    let lower = text.to_lowercase();
    let parts = |text: &'_ str| -> Vec<String> {
        text.split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let asked = parts(&lower);
    if text.contains("::") || !text.trim().contains(' ') {
        return Vec::new();
    }
    let of_verdict: Vec<Code> = codes::words()
        .filter(|code| parts(code.code).iter().all(|word| asked.contains(word)))
        .collect();
    if !of_verdict.is_empty() {
        return of_verdict;
    }
    let has_all = |code: &&Code| {
        let known =
            parts(&format!("{} {}", code.code.replace('_', " "), code.summary()).to_lowercase());
        asked.iter().all(|word| known.contains(word))
    };
    codes.iter().filter(has_all).cloned().collect()
}

/// The code of `error[units::syntax]`.
fn bare(text: &str) -> &str {
    let inner = text.split_once('[').map_or(text, |(_, rest)| rest);
    inner.trim_end_matches([']', ':'])
}

/// The codes of an area, or the one that is named.
fn asked(name: &str, codes: Vec<Code>) -> Result<Explained, Failure> {
    let (named, wanted): (bool, fn(&Code) -> &str) =
        if name.contains("::") { (true, |code| code.code) } else { (false, Code::area) };
    let found: Vec<Code> = codes.iter().filter(|code| wanted(code) == name).cloned().collect();
    if found.is_empty() {
        Err(unknown(name, &codes))
    } else {
        Ok(Explained { codes: found, named })
    }
}

fn unknown(name: &str, codes: &[Code]) -> Failure {
    let problem =
        Diagnostic::error("explain::unknown", format!("no diagnostic has the code `{name}`"));
    let behind: Vec<&str> =
        codes.iter().filter(|code| code.problem() == name).map(|code| code.code).collect();
    if let [first, ..] = behind.as_slice() {
        return Failure::new(
            lptn_answer::exit::Exit::Input,
            problem.help(format!("did you mean `{first}`?")),
        );
    }
    let names = codes.iter().flat_map(|code| [code.code, code.area()]);
    let all = || "`lptn explain` lists them all".into();
    Failure::new(Exit::Input, problem.did_you_mean(name, names, all))
}
