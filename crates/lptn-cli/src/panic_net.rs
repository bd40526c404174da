//! Faults of the program itself.

use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::{Arc, Mutex, PoisonError};

use lptn_netlist::Diagnostic;

use crate::arguments;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::quoted;

/// Does the work of the command, and turns a panic into a failure.
/// The panic may be in a thread that it waits for. Unfinished files are dropped: temporary files
/// go, the results of earlier runs stay.
pub(crate) fn caught(work: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
    let first: Arc<Mutex<Option<String>>> = Arc::default();
    let noted = Arc::clone(&first);
    let usual = take_hook();
    set_hook(Box::new(move |panic| {
        // the first panic is the cause; that of a waiting thread follows from it
        noted
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .get_or_insert_with(|| described(panic));
        if std::env::var_os("RUST_BACKTRACE").is_some() {
            usual(panic);
        }
    }));
    let outcome = catch_unwind(AssertUnwindSafe(work));
    drop(take_hook());
    outcome.unwrap_or_else(|_| {
        let what = first.lock().unwrap_or_else(PoisonError::into_inner).take();
        Err(Failure::new(Exit::Failed, fault(&what.unwrap_or_default(), arguments::words())))
    })
}

fn described(panic: &PanicHookInfo<'_>) -> String {
    let payload = panic.payload();
    let text = payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or(payload.downcast_ref::<&str>().copied());
    let what = text.unwrap_or("no reason is given");
    panic.location().map_or_else(|| what.to_owned(), |place| format!("{what}, at {place}"))
}

/// The message to the user, with the facts that developers need.
fn fault(what: &str, arguments: Vec<String>) -> Diagnostic {
    let message = format!("lptn has stopped because of a fault in lptn, not in your input: {what}");
    let words: Vec<String> = arguments.iter().map(|word| quoted(word)).collect();
    let (version, os) = (env!("CARGO_PKG_VERSION"), std::env::consts::OS);
    Diagnostic::error("program::fault", message).help(format!(
        "result files of earlier runs are unchanged; do not use the output of this one. Please \
         report the fault with the line above, these two, and the files that the command \
         reads:\n\nlptn {version}, {os}\nlptn {}",
        words.join(" ")
    ))
}

#[cfg(test)]
mod tests {
    use super::{caught, fault};
    use crate::files::Folder;
    use crate::files::names::{RESULT, STATE};
    use crate::files::tests::Place;
    use lptn_answer::exit::Exit;

    /// One test, because a hook belongs to the whole process.
    #[test]
    fn a_panic_is_a_failure_that_leaves_old_results_whole() {
        let place = Place::new();
        place.write(RESULT, "old");
        let failure = caught(|| {
            let folder = Folder::prepare(place.0.clone())?;
            let mut files = folder.batch();
            files.write(RESULT, |out| out.write_all(b"new"))?;
            files.write(STATE, |_| panic!("row {} is missing", 0))?;
            files.commit(&[])?;
            Ok(Exit::Done)
        })
        .unwrap_err();
        assert_eq!(failure.exit, Exit::Failed);
        assert_eq!(failure.diagnostics[0].code, "program::fault");
        let message = &failure.diagnostics[0].message;
        assert!(
            message.contains("row 0 is missing") && message.contains("panic_net.rs"),
            "{message}"
        );
        assert_eq!(place.read(RESULT), "old");
        assert_eq!(place.files(), [RESULT]);

        let work = |&i: &usize| if i == 3 { panic!("worker {i}") } else { i };
        let failure = caught(|| {
            lptn_solve::in_parallel(&[0, 1, 2, 3, 4, 5], 3, work);
            Ok(Exit::Done)
        });
        let message = failure.unwrap_err().diagnostics[0].message.clone();
        assert!(message.contains("worker 3"), "{message}");
        assert_eq!(caught(|| Ok(Exit::No)).unwrap(), Exit::No);
    }

    #[test]
    fn a_report_can_be_pasted() {
        let arguments = ["run", "my motor.toml", "--set", "P=3W"].map(str::to_owned);
        let help = fault("what", arguments.to_vec()).help.unwrap();
        assert!(help.ends_with("\nlptn run 'my motor.toml' --set 'P=3W'"), "{help}");
        assert!(help.contains(concat!("\nlptn ", env!("CARGO_PKG_VERSION"))), "{help}");
    }
}
