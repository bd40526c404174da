//! Live pages: a panel of parameters, and the core that solves the netlist again.
//!
//! A live page is the page of a report with additions: a panel after the claims, the contents and
//! the core as data, and a third script with its hash in the policy. The script shows parts that
//! the core writes ([`claims`](crate::claims), [`figures`](crate::figures),
//! [`results`](crate::results)); it computes nothing itself.

use serde_json::Value;

use crate::base85::base85;
use crate::script;

/// Script of the panel, after the function that unpacks the core.
pub(crate) const SCRIPT: &str =
    concat!(include_str!("../assets/unlzma.js"), include_str!("../assets/live.js"));

/// Style of the panel.
pub(crate) const STYLE: &str = include_str!("../assets/live.css");

/// The additions to a page that make it live.
#[derive(Clone, Copy, Debug)]
pub struct Live<'a> {
    /// The members `file` (the name of the netlist), `words` (those of the command after it),
    /// `parameters` (each with `name`, `text`, `value`, `unit`, `range` and `log`) and `contents`,
    /// with which the core is opened.
    pub contents: &'a Value,
    /// The core as WebAssembly, packed by `xz --format=lzma`.
    pub core: &'a [u8],
}

/// The panel, which the script fills.
pub(crate) const PANEL: &str = "<section class=\"tune\">\n<h2>Change parameters</h2>\n\
     <p class=\"hint\">This page solves the network again for these values, without a server.</p>\n\
     <noscript><p class=\"fails\">The browser runs no scripts: nothing can be changed.</p></noscript>\n\
     <div class=\"rows\"></div>\n<div class=\"state\"><button type=\"button\">reset</button>\n\
     <span class=\"said\" role=\"status\">The solver starts.</span></div>\n\
     <p>The same by the program: <code></code></p>\n\
     <div class=\"problems\" role=\"alert\"></div>\n\
     <h3>Steady state</h3>\n<div class=\"steady\"></div>\n</section>\n";

/// The data of the script.
pub(crate) fn data(live: &Live<'_>) -> String {
    let (contents, core) = (script::json(live.contents), base85(live.core));
    format!(
        "<script type=\"application/json\" id=\"contents\">{contents}</script>\n\
         <script type=\"application/x-lzma\" id=\"core\">{core}</script>\n"
    )
}
