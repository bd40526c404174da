//! Finds out which SUNDIALS is linked, before anything is compiled against a wrong guess.
//!
//! sundials-sys tells its dependants nothing about the version it found, and where it finds no
//! headers it quietly builds its own copy as shared libraries, which a finished program cannot
//! load. Therefore this script looks for the header itself; `src/version.rs` compares what it found
//! with the bindings when the crate is compiled.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const HEADER: &str = "sundials/sundials_config.h";

const NOT_FOUND: &str = "no SUNDIALS 6 or later found: install its headers and libraries (Debian \
    and Ubuntu: apt install libsundials-dev), or set SUNDIALS_INCLUDE_DIR and \
    SUNDIALS_LIBRARY_DIR, or use the cargo feature `bundled`";

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed=build.rs");
    for name in ["SUNDIALS_INCLUDE_DIR", "SUNDIALS_LIBRARY_DIR", "CPATH", "C_INCLUDE_PATH"] {
        println!("cargo::rerun-if-env-changed={name}");
    }
    println!("cargo::rustc-check-cfg=cfg(sundials7)");
    // The copy inside sundials-sys 0.6 is a SUNDIALS 7; an empty version means "compare the major
    // number only".
    let version = if env::var_os("CARGO_FEATURE_BUNDLED").is_some() {
        Some(String::new())
    } else {
        system_version()
    };
    match version.as_deref().map(|text| (text, major(text))) {
        Some((text, number)) if number >= 6 => {
            println!("cargo::rustc-env=LPTN_SUNDIALS_HEADER={text}");
            if number >= 7 {
                println!("cargo::rustc-cfg=sundials7");
            }
            ExitCode::SUCCESS
        }
        _ => {
            println!("cargo::error={NOT_FOUND}");
            ExitCode::FAILURE
        }
    }
}

/// The version in the first header on the search path of the C compiler, or nothing if there is
/// none.
fn system_version() -> Option<String> {
    let header = include_directories()
        .into_iter()
        .map(|folder| folder.join(HEADER))
        .find(|path| path.is_file())?;
    println!("cargo::rerun-if-changed={}", header.display());
    version_in(&header)
}

fn include_directories() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        env::var_os("SUNDIALS_INCLUDE_DIR").map(PathBuf::from).into_iter().collect();
    for name in ["CPATH", "C_INCLUDE_PATH"] {
        folders.extend(env::var_os(name).iter().flat_map(env::split_paths));
    }
    folders.push("/usr/local/include".into());
    if let (Ok(arch), Ok(os)) = (env::var("CARGO_CFG_TARGET_ARCH"), env::var("CARGO_CFG_TARGET_OS"))
    {
        folders.push(format!("/usr/include/{arch}-{os}-gnu").into());
    }
    folders.push("/usr/include".into());
    folders
}

/// The text between the quotes of `#define SUNDIALS_VERSION "6.4.1"`.
fn version_in(header: &Path) -> Option<String> {
    let text = fs::read_to_string(header).ok()?;
    let line = text.lines().find(|line| line.starts_with("#define SUNDIALS_VERSION "))?;
    line.split('"').nth(1).map(str::to_owned)
}

fn major(version: &str) -> u32 {
    match version.split('.').next() {
        Some("") => 7,
        Some(number) => number.parse().unwrap_or(0),
        None => 0,
    }
}
