//! The module takes its own elementary functions, not those of the Python that loads it.
//!
//! Python has linked the C library before it loads the module. Its `exp` would be found first, and
//! results would differ from those of the program in the last digit.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of_elf = std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux");
    if of_elf {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-Bsymbolic");
    }
}
