//! Ctrl-C in the middle of the work.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, Ran};

/// Far longer than half a second of CPU takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(600);

/// Starts the program and presses Ctrl-C when it has used half a second of CPU, far more than the
/// gearbox needs.
pub(crate) fn interrupted(folder: &Folder, arguments: &[&str]) -> Ran {
    interrupted_after(50, folder, arguments)
}

/// The same after so many hundredths of a second of CPU.
pub(crate) fn interrupted_after(ticks: u64, folder: &Folder, arguments: &[&str]) -> Ran {
    let child =
        folder.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while cpu_ticks(&child).is_none_or(|used| used < ticks) && begun.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(10));
    }
    let signal = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(signal.success());
    Ran::of(child.wait_with_output().unwrap())
}

/// User time in hundredths of a second, where the system says.
fn cpu_ticks(child: &Child) -> Option<u64> {
    let text = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    text.rsplit_once(") ")?.1.split(' ').nth(11)?.parse().ok()
}
