//! `lptn sweep merge`: the parts of a sweep as one file.

use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use lptn_netlist::Diagnostic;
use lptn_study::{FileHash, Hashing};
use serde_json::Value;

use super::args::MergeArgs;
use super::growing::write_manifest;
use crate::console::Console;
use crate::files::names::{MANIFEST, SWEEP, UNFINISHED};
use crate::files::{self, Folder};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::sweep::{Lines, Shard};

/// A part that is whole.
struct Part {
    folder: PathBuf,
    /// The sweep as its manifest describes it.
    sweep: Value,
    /// The hash of its rows, as the manifest has it.
    sha256: String,
    inputs: Value,
}

pub(crate) fn merge(args: &MergeArgs, console: &Console) -> Result<Exit, Failure> {
    let parts = parts(&args.folder)?;
    one_sweep(&parts)?;
    let cases = without_gaps(&parts)?;
    for part in &parts {
        unchanged(part)?;
    }
    let folder = Folder::prepare(args.folder.clone())?;
    let sha256 = join(&folder, &parts)?;
    let results = [FileHash { name: SWEEP.to_owned(), sha256 }];
    let mut manifest = files::manifest(&[], &results, 0.0);
    let mut sweep = parts[0].sweep.clone();
    (sweep["first"], sweep["last"], sweep["shard"]) = (1.into(), cases.into(), Value::Null);
    manifest["sweep"] = sweep;
    manifest["inputs"] = parts[0].inputs.clone();
    write_manifest(&folder, &manifest)?;
    let file = args.folder.join(SWEEP);
    console.note(&format!("joined {} parts, {cases} candidates", parts.len()));
    console.note(&format!("wrote  {}", file.display()));
    Ok(Exit::Done)
}

/// The parts in a folder, in the order of their cases.
fn parts(folder: &Path) -> Result<Vec<Part>, Failure> {
    let entries = fs::read_dir(folder)
        .map_err(|error| Failure::cannot_read(folder.display(), &error, None))?;
    let mut found: Vec<(Shard, PathBuf)> = entries
        .flatten()
        .filter_map(|entry| Some((Shard::of_folder(entry.file_name().to_str()?)?, entry.path())))
        .collect();
    found.sort_by_key(|(shard, _)| (shard.n, shard.k));
    if found.is_empty() {
        let message = format!("there is no part of a sweep in {}", folder.display());
        let help = "name the folder of part-1-of-N and the others";
        return Err(Failure::refused("sweep::no_parts", message, help));
    }
    let mut parts: Vec<Part> =
        found.into_iter().map(|(_, path)| Part::read(path)).collect::<Result<_, _>>()?;
    parts.sort_by_key(Part::first);
    Ok(parts)
}

impl Part {
    fn read(folder: PathBuf) -> Result<Self, Failure> {
        let name = folder.display();
        if folder.join(UNFINISHED).exists() {
            let message = format!("{name} is not finished");
            let help = "start this part again with --resume";
            return Err(Failure::refused("sweep::part_unfinished", message, help));
        }
        let manifest = fs::read_to_string(folder.join(MANIFEST));
        let manifest = manifest.map_err(|error| {
            let help = "start this part again: it has no manifest";
            Failure::cannot_read(folder.join(MANIFEST).display(), &error, help)
        })?;
        let manifest: Value = serde_json::from_str(&manifest).unwrap_or_default();
        let hash = manifest["results"][0]["sha256"].as_str().map(str::to_owned);
        let (Some(sha256), true) = (hash, manifest["sweep"].is_object()) else {
            let message = format!("{name} is not a part of a sweep: its manifest is another one");
            return Err(Failure::refused(
                "sweep::no_parts",
                message,
                "remove the folder, or name another",
            ));
        };
        let (sweep, inputs) = (manifest["sweep"].clone(), manifest["inputs"].clone());
        Ok(Self { sweep, sha256, inputs, folder })
    }

    fn number(&self, key: &str) -> u64 {
        self.sweep[key].as_u64().unwrap_or(0)
    }

    fn first(&self) -> u64 {
        self.number("first")
    }
}

/// Refuses parts of different sweeps: inputs, parameters and version must agree.
fn one_sweep(parts: &[Part]) -> Result<(), Failure> {
    let known = &parts[0];
    let other = parts.iter().find(|part| part.sweep["identity"] != known.sweep["identity"]);
    let Some(other) = other else { return Ok(()) };
    let message = format!(
        "{} and {} are of different sweeps: the netlist, its files, the parameters that were set \
         or the version of lptn differ",
        known.folder.display(),
        other.folder.display()
    );
    Err(Failure::refused("sweep::mixed_parts", message, "compute all parts from the same inputs"))
}

/// Refuses missing and double cases; returns the number of all cases.
fn without_gaps(parts: &[Part]) -> Result<u64, Failure> {
    let cases = parts[0].number("cases");
    let mut next = 1;
    for part in parts {
        let first = part.first();
        let (code, what) = match first.cmp(&next) {
            std::cmp::Ordering::Equal => {
                next = part.number("last") + 1;
                continue;
            }
            std::cmp::Ordering::Greater => {
                ("sweep::gap", format!("the cases {next} to {} are missing", first - 1))
            }
            std::cmp::Ordering::Less => (
                "sweep::double",
                format!("{} begins with case {first} again", part.folder.display()),
            ),
        };
        return Err(Failure::refused(
            code,
            what,
            "keep one folder for each part, all of one number of parts",
        ));
    }
    match next == cases + 1 {
        true => Ok(cases),
        false => Err(Failure::refused(
            "sweep::gap",
            format!("the cases {next} to {cases} are missing"),
            "compute the parts that are missing first",
        )),
    }
}

/// Refuses rows that differ from those of the manifest.
fn unchanged(part: &Part) -> Result<(), Failure> {
    let path = part.folder.join(SWEEP);
    let cannot = |error: io::Error| Failure::cannot_read(path.display(), &error, None);
    let mut file = fs::File::open(&path).map_err(cannot)?;
    let mut hash = Hashing::new(io::sink());
    let mut bytes = vec![0; 1 << 16];
    loop {
        match file.read(&mut bytes).map_err(cannot)? {
            0 => break,
            read => hash.holds(&bytes[..read]),
        }
    }
    if hash.finish().1 == part.sha256 {
        return Ok(());
    }
    let message = format!("{} is not as it was written", path.display());
    Err(Failure::refused("sweep::part_changed", message, "remove the part and compute it again"))
}

/// Writes the rows of all parts below one heading; returns the hash of the file.
fn join(folder: &Folder, parts: &[Part]) -> Result<String, Failure> {
    let mut batch = folder.batch();
    let mut failure = None;
    batch
        .write(SWEEP, |out| {
            for (place, part) in parts.iter().enumerate() {
                let copied = copy(part, place == 0, out);
                if let Err(cannot) = copied {
                    failure = Some(cannot);
                    return Err(io::ErrorKind::InvalidData.into());
                }
            }
            Ok(())
        })
        .map_err(|error| failure.unwrap_or(error))?;
    let sha256 = batch.written().first().map_or_else(String::new, |file| file.sha256.clone());
    batch.commit(&[])?;
    Ok(sha256)
}

fn copy(part: &Part, heading: bool, out: &mut dyn io::Write) -> Result<(), Failure> {
    let path = part.folder.join(SWEEP);
    let mut lines = Lines::open(&path)?;
    let first = lines.next_line()?;
    let cannot = |error: io::Error| {
        let message = format!("cannot write: {}", lptn_answer::failure::reason(&error));
        Failure::new(Exit::Failed, Diagnostic::error("output::cannot_write", message))
    };
    if let (true, Some(first)) = (heading, first) {
        out.write_all(&first).map_err(cannot)?;
    }
    while let Some(line) = lines.next_line()? {
        out.write_all(&line).map_err(cannot)?;
    }
    Ok(())
}
