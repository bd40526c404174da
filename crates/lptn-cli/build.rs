//! Puts the core of live pages into the program, if `LPTN_LIVE` names its file (`make live`).

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=LPTN_LIVE");
    println!("cargo::rustc-check-cfg=cfg(live_core)");
    let Some(core) = std::env::var("LPTN_LIVE").ok().filter(|core| !core.is_empty()) else {
        return;
    };
    println!("cargo::rerun-if-changed={core}");
    println!("cargo::rustc-cfg=live_core");
    println!("cargo::rustc-env=LPTN_LIVE_CORE={core}");
}
