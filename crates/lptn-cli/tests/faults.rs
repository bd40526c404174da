//! Faults from outside: a process that is killed, a full disk, a folder that cannot be written, two
//! processes at once. What is there afterwards are the old results or the new ones, whole.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use common::{Folder, Ran, endless};
use sha2::{Digest as _, Sha256};

/// A block of 100 J/K behind 1 K/W, heated with `power`; a run that writes more than it computes.
fn block(power: &str, extra: &str) -> String {
    format!(
        "format = 1\n[node]\nblock = {{ C = \"100 J/K\", T0 = \"20 degC\" }}\n[boundary]\nroom = \
         {{ T = \"20 degC\" }}\n\
         [resistor]\nfoot = {{ from = \"block\", to = \"room\", R = \"1 K/W\" }}\n\
         [source]\nloss = {{ into = \"block\", P = \"{power}\" }}\n[limit]\nhot = {{ of \
         = \"block.T\", below = \"90 degC\" }}\n\
         [run]\nstop = \"1000 s\"\noutput = {{ every = \"0.2 s\" }}\n{extra}"
    )
}

/// All files below a folder with their bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    entries.filter_map(|path| Some((name(&path), std::fs::read(&path).ok()?))).collect()
}

/// The results of one run: what a folder holds after it, the manifest by the hashes that it names.
#[derive(PartialEq)]
struct Results {
    files: BTreeMap<String, Vec<u8>>,
    hashes: BTreeMap<String, String>,
}

const MANIFEST: &str = "manifest.json";

fn hashes(manifest: &[u8]) -> BTreeMap<String, String> {
    let manifest: serde_json::Value = serde_json::from_slice(manifest).unwrap();
    let hash = |of: &serde_json::Value| {
        (of["name"].as_str().unwrap().to_owned(), of["sha256"].as_str().unwrap().to_owned())
    };
    manifest["results"].as_array().unwrap().iter().map(hash).collect()
}

impl Results {
    /// What lies in the folder, whose manifest is that of its files.
    fn of(mut files: BTreeMap<String, Vec<u8>>) -> Self {
        let hashes = hashes(&files.remove(MANIFEST).unwrap());
        let hash =
            |bytes: &[u8]| Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        let found: BTreeMap<String, String> =
            files.iter().map(|(name, bytes)| (name.clone(), hash(bytes))).collect();
        assert!(hashes == found, "a manifest of other results: {hashes:?} beside {found:?}");
        Self { files, hashes }
    }
}

/// Numbers from 0 to 1 in an order that is always the same (Marsaglia's xorshift, 2003).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Kills a run in the middle of its computing or of its writing: after a while, or when a file
/// appears.
fn kill(mut child: Child, out: &Path, when: &Moment) {
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        let now = match when {
            Moment::After(time) => begun.elapsed() >= *time,
            Moment::Sees(file) => out.join(file.replace("PID", &child.id().to_string())).exists(),
        };
        if now {
            child.kill().unwrap(); // SIGKILL: nothing can be done about it
            break;
        }
        std::thread::yield_now();
    }
    child.wait().unwrap();
}

enum Moment {
    After(Duration),
    Sees(&'static str),
}

/// After every kill each file is that of one of the two runs, whole; unless the record of a commit
/// says that one is under way they are all of the same run. Nothing is left over when the next run
/// has ended.
#[test]
fn a_run_that_is_killed_leaves_old_or_new_results() {
    let folder = Folder::with(
        "old.toml",
        &block("10 W", "window = { late = { from = \"500 s\", to = \"900 s\" } }\n"),
    );
    folder.write("new.toml", &block("20 W", ""));
    let out = folder.path().join("out");
    let run = |deck: &str| {
        folder.command(&["run", deck, "-q", "-o", "out"]).stdout(Stdio::null()).spawn().unwrap()
    };
    let decks = ["new.toml", "old.toml"];
    let begun = Instant::now();
    let known = decks.map(|deck| {
        assert!(run(deck).wait().unwrap().success());
        Results::of(contents(&out))
    });
    let took = begun.elapsed() / 2;
    assert!(known[0] != known[1] && known[1].files.contains_key("windows.csv"));
    let mut chance = Chance(20_261_122);
    let seen = [
        ".result.csv.PID.tmp",
        ".state.json.PID.tmp",
        ".manifest.json.PID.tmp",
        ".commit.json",
        ".commit.json.PID.tmp",
    ];
    let mut under_way = 0;
    for round in 0..50 {
        // the other one than lies there
        let lies = contents(&out);
        let deck = decks[usize::from(lies["state.json"] == known[0].files["state.json"])];
        let moment = match round % 2 {
            0 => Moment::After(took.mul_f64(1.1 * chance.next())),
            _ => Moment::Sees(seen[(chance.next() * seen.len() as f64) as usize]),
        };
        kill(run(deck), &out, &moment);
        let mut left = contents(&out);
        let recorded = left.contains_key(".commit.json");
        under_way += usize::from(recorded);
        left.retain(|name, _| !name.starts_with('.'));
        for (name, bytes) in left.iter().filter(|(name, _)| *name != MANIFEST) {
            assert!(
                known.iter().any(|run| run.files.get(name) == Some(bytes)),
                "{round}: half a {name}"
            );
        }
        assert!(left.contains_key("state.json"), "{round}: the state is lost");
        let manifest = hashes(&left[MANIFEST]);
        assert!(known.iter().any(|run| run.hashes == manifest), "{round}: half a manifest");
        if !recorded {
            let left = Results::of(left);
            assert!(known.contains(&left), "{round}: a mixture");
        }
    }
    println!("{under_way} of 50 kills met the renames");
    assert!(run("new.toml").wait().unwrap().success());
    assert!(Results::of(contents(&out)) == known[0], "something is left over");
}

/// The limit on the size of files plays a disk that is full: the error is the same but for its
/// words.
#[test]
fn a_disk_that_fills_up_in_the_second_run_leaves_the_results_of_the_first() {
    let folder = Folder::with("block.toml", &block("10 W", ""));
    let chain = |text: String| folder.write("block.toml", &text.replace("0.2 s", "100 s"));
    chain(block("10 W", ""));
    folder.run(&["run", "block.toml", "-q"]).exits(0);
    let out = folder.path().join("out/block");
    let old = contents(&out);
    folder.write("block.toml", &block("20 W", "initial = \"out/block/state.json\"\n"));
    // the rows do not fit, or not even what follows them; the first run was smaller
    for blocks in [1, 8] {
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" run block.toml -q");
        let mut command = Command::new("sh");
        command.args(["-c", &script, env!("CARGO_BIN_EXE_lptn")]).current_dir(folder.path());
        Ran::of(command.output().unwrap()).exits(3).says("output::cannot_write");
        assert!(contents(&out) == old, "the old results are not what they were");
    }
    folder.run(&["run", "block.toml", "-q"]).exits(0);
}

/// Runs a script in a name space where it may mount what it likes; `None` where the system does not
/// allow that, which the continuous integration does.
fn mounting(folder: &Folder, script: &str) -> Option<String> {
    let able =
        Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"]).output();
    if !able.is_ok_and(|able| able.status.success()) {
        assert!(std::env::var_os("LPTN_REQUIRE_ORACLES").is_none(), "name spaces are required");
        return None;
    }
    let script = format!("set -e; {script}");
    let mut command = Command::new("unshare");
    command
        .args(["-rm", "sh", "-c", &script, env!("CARGO_BIN_EXE_lptn")])
        .current_dir(folder.path());
    Some(Ran::of(command.output().unwrap()).exits(0).out)
}

/// A disk of 200 kB in memory: the first run fits, the second one does not, the third one goes on
/// from the first.
#[test]
fn a_full_disk_does_not_break_a_chain_of_runs() {
    let folder = Folder::with("large.toml", &block("20 W", "initial = \"out/state.json\"\n"));
    folder.write("first.toml", &block("10 W", "").replace("0.2 s", "10 s"));
    folder.write(
        "third.toml",
        &block("10 W", "initial = \"out/state.json\"\n").replace("0.2 s", "10 s"),
    );
    let script = "mkdir disk; mount -t tmpfs -o size=200k tmpfs disk; cp *.toml disk; cd disk; \
                  \"$0\" run first.toml -q -o out > /dev/null; cp -r out ../before; \"$0\" run \
                  large.toml -q -o out > /dev/null || echo \"exit $?\"; diff -r out ../before && \
                  echo same; \"$0\" run third.toml -q -o out > /dev/null; ls -A out";
    if let Some(out) = mounting(&folder, script) {
        assert_eq!(out, "exit 3\nsame\nevents.csv\nmanifest.json\nresult.csv\nstate.json\n");
    }
}

/// For root no folder is protected by its permissions; one that is mounted for reading is.
#[test]
fn a_folder_for_reading_keeps_its_results() {
    let folder = Folder::with("block.toml", &block("10 W", ""));
    folder.run(&["run", "block.toml", "-q", "-o", "out"]).exits(0);
    let old = contents(&folder.path().join("out"));
    let script = "mount --bind out out; mount -o remount,ro,bind out; \"$0\" run block.toml -q -o \
                  out 2>&1 > /dev/null || echo \"exit $?\"";
    if let Some(out) = mounting(&folder, script) {
        assert!(out.contains("output::cannot_create") && out.ends_with("exit 2\n"), "{out}");
    }
    assert!(contents(&folder.path().join("out")) == old);
}

/// The second of two processes is told so; the lock of one that was killed is none.
#[test]
fn a_folder_is_written_by_one_process_at_a_time() {
    let folder = Folder::with("long.toml", &endless());
    folder.write("block.toml", &block("10 W", ""));
    let out = folder.path().join("out");
    let mut first = folder
        .command(&["run", "long.toml", "-q", "-o", "out"])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while std::fs::read_to_string(out.join(".lptn.lock")).map_or(true, |text| text.is_empty()) {
        std::thread::yield_now();
    }
    let second =
        folder.run(&["run", "block.toml", "-q", "-o", "out"]).exits(2).says("output::in_use");
    assert!(second.err.contains(&format!("process {}", first.id())), "{}", second.err);
    first.kill().unwrap();
    first.wait().unwrap();
    folder.run(&["run", "block.toml", "-q", "-o", "out"]).exits(0);
    assert!(
        Results::of(contents(&out)).files.len() == 3,
        "nothing is left over, not even the lock"
    );
}

/// Of four that begin at once each gets the folder or is told that it does not; what is there in
/// the end is of one.
#[test]
fn of_several_at_once_the_results_are_of_one() {
    let folder = Folder::with("a.toml", &block("10 W", ""));
    folder.write("b.toml", &block("20 W", ""));
    for _ in 0..5 {
        let decks = ["a.toml", "b.toml", "a.toml", "b.toml"];
        let start = |deck| {
            let mut command = folder.command(&["run", deck, "-q", "-o", "out"]);
            command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        };
        let all = decks.map(start).map(|child| Ran::of(child.wait_with_output().unwrap()));
        assert!(all.iter().any(|ran| ran.code == Some(0)));
        let others = all.iter().filter(|ran| ran.code != Some(0));
        others.for_each(|ran| {
            assert!(ran.code == Some(2) && ran.err.contains("output::in_use"), "{}", ran.err)
        });
        Results::of(contents(&folder.path().join("out")));
    }
}
