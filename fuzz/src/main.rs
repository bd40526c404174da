//! The targets under libFuzzer; `LPTN_FUZZ` names the one that is fuzzed.
#![no_main]

mod targets;

use std::sync::OnceLock;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    static TARGET: OnceLock<fn(&[u8])> = OnceLock::new();
    let target = TARGET.get_or_init(|| {
        let wanted = std::env::var("LPTN_FUZZ").expect("LPTN_FUZZ names a target");
        let found = targets::TARGETS.iter().find(|(name, _)| *name == wanted);
        found.unwrap_or_else(|| panic!("no target {wanted}")).1
    });
    target(bytes);
});
