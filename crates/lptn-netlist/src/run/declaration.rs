//! The keys of `[run]`.

use lptn_network::IntegratorChoice;

use crate::format::{
    Role, SectionDeclaration, Takes, key, names, number, shaped, text, words, words_of,
};
use crate::outputs::WINDOW;

/// `[run]`.
pub(crate) const RUN: SectionDeclaration = SectionDeclaration {
    name: "run",
    sentence: "The simulation over time.",
    role: Role::Study,
    keys: &[
        key("stop", "s", "when the run ends", "\"25 min\"").needed(),
        key("start", "s", "when it begins", "\"0 s\"").or("0 s"),
        text(
            "initial",
            "file",
            "the state of another run, which it starts from",
            "\"out/gearbox/state.json\"",
        ),
        shaped(
            "output",
            "table",
            Takes::Table(&OUTPUT),
            "when rows are written: at intervals of `every`, or `at` listed times",
            "{ every = \"5 s\" }",
        )
        .or("301 rows"),
        names("select", "list of patterns", "which columns are written", "[\"*.T\"]").or("all"),
        shaped(
            "report",
            "table of expressions of results",
            Takes::Each(&Takes::Like),
            "further columns, or numbers over time by a functional",
            "{ rise = \"steel.T - air.T\" }",
        ),
        shaped(
            "window",
            "table",
            Takes::Each(&Takes::Table(&WINDOW)),
            "parts of the run with means and extremes: `from` and `to`",
            "{ climb = { from = \"10 min\", to = \"20 min\" } }",
        ),
        key("tolerance", "K", "the accuracy of temperatures", "\"1e-5 K\"").or("1e-5 K"),
        number(
            "balance_error",
            "largest error of the energy balance, as a share of the heat exchanged",
            "1e-10",
        )
        .or("1e-8, and 10 tolerances times all capacities"),
        words(
            "integrator",
            &words_of(&IntegratorChoice::WORDS),
            "the method: `one_step` is for linear networks, `esdirk` for inputs of many points",
            "\"cvode\"",
        )
        .or("`\"auto\"`"),
    ],
    example: "{ stop = \"25 min\" }",
    elsewhere: &[
        ("end", STOP),
        ("duration", STOP),
        ("t_end", STOP),
        ("t_stop", STOP),
        ("t_max", STOP),
        ("time", STOP),
        ("t_start", "the time of the start is `start`"),
        ("dt", EVERY),
        ("time_step", EVERY),
        ("interval", EVERY),
        ("rtol", TOLERANCE),
        ("atol", TOLERANCE),
        ("every", "write `output = { every = {value} }`"),
        ("step", EVERY),
        ("at", "write `output = { at = [{value}] }`"),
    ],
    ..SectionDeclaration::NEW
};

const STOP: &str = "the end of a run is `stop`: write `stop = {value}`";
const EVERY: &str = "write `output = { every = {value} }`; the solver chooses its own steps";
const TOLERANCE: &str = "the error is at most `tolerance`, in K: `tolerance = \"1e-3 K\"`";

/// `output = { … }` of `[run]`.
pub(super) const OUTPUT: SectionDeclaration = SectionDeclaration {
    name: "output",
    keys: &[
        key("every", "s", "the time between two rows", "\"5 s\""),
        shaped(
            "at",
            "list of times",
            Takes::list(&Takes::Quantity("s")),
            "the times of the rows, rising",
            "[\"0 s\", \"5 s\"]",
        ),
    ],
    example: "{ every = \"5 s\" }",
    ..SectionDeclaration::NEW
};
