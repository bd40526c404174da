//! Policy of the page: it runs its own scripts and nothing else.

/// Hashes of the two scripts of every page as `Content-Security-Policy` writes them; a test checks
/// them.
const SCRIPTS: [&str; 2] = [
    "sha256-RAis6RoYtIiJmBceEi2mW5qyhxHDDxmmpZFJHFqCyvE=",
    "sha256-hBtLBoifXT/78vacTiNmXWrQJjHZ0d1mbx4nwMgROlg=",
];

/// Hash of the script of live pages.
const LIVE: &str = "sha256-eWkw5Uv82fMxM1XDMyrPY8cneA/zOfUTbRj+KD/v02w=";

/// The policy: nothing is loaded from anywhere. A live page may compile its core, in a worker whose
/// script is in the page.
pub(crate) fn content(live: bool) -> String {
    let [charts, page] = SCRIPTS;
    let more = match live {
        true => format!(" '{LIVE}' 'wasm-unsafe-eval'; worker-src blob:"),
        false => String::new(),
    };
    format!("default-src 'none'; style-src 'unsafe-inline'; script-src '{charts}' '{page}'{more}")
}

#[cfg(test)]
mod tests {
    use sha2::{Digest as _, Sha256};

    use super::{LIVE, SCRIPTS};
    use crate::base64::base64;
    use crate::live;
    use crate::page::{SCRIPT, UPLOT};

    /// A browser refuses a script whose hash differs.
    #[test]
    fn the_scripts_are_those_that_the_policy_names() {
        let hash = |script: &str| format!("sha256-{}", base64(&Sha256::digest(script.as_bytes())));
        assert_eq!(SCRIPTS, [UPLOT, SCRIPT].map(hash));
        assert_eq!(LIVE, hash(live::SCRIPT));
    }
}
