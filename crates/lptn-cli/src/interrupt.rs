//! Ctrl-C.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use lptn_solve::Proceed;

/// State of Ctrl-C since this was made. A second press ends the program at once.
#[derive(Debug)]
pub(crate) struct Interrupt {
    pressed: Arc<AtomicBool>,
}

impl Interrupt {
    /// Begins to listen. If that is not possible, Ctrl-C ends the program as usual.
    pub(crate) fn listen() -> Self {
        use signal_hook::consts::SIGINT;
        let pressed = Arc::new(AtomicBool::new(false));
        // in this order: the first press finds the flag unset, the second one set
        if signal_hook::flag::register_conditional_default(SIGINT, Arc::clone(&pressed)).is_ok() {
            drop(signal_hook::flag::register(SIGINT, Arc::clone(&pressed)));
        }
        Self { pressed }
    }

    pub(crate) fn pressed(&self) -> bool {
        self.pressed.load(Ordering::Relaxed)
    }

    /// The order to a run: continue or interrupt.
    pub(crate) fn control(&self) -> Proceed {
        if self.pressed() { Proceed::Interrupt } else { Proceed::Continue }
    }
}
