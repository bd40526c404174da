//! The keys of `[sweep.NAME]`.

use crate::csv_form::FORMED;
use crate::format::{
    NAMES, Role, SectionDeclaration, Takes, akin, key, shaped, whole, words, words_of,
};
use crate::sweep::{SweepMethod, SweepOver};

/// Spacing of values; true for equal ratios.
pub(super) const SCALES: [(&str, bool); 2] = [("linear", false), ("log", true)];

pub(crate) const SWEEP: SectionDeclaration = SectionDeclaration {
    name: "sweep",
    sentence: "Many candidates: values of parameters, and the reports of each.",
    role: Role::Study,
    keys: &[
        words(
            "method",
            &words_of(&SweepMethod::WORDS),
            "the choice of \
            candidates",
            "\"grid\"",
        )
        .needed(),
        shaped(
            "axes",
            "table of parameters; of `csv` a list of names",
            Takes::Either(&[
                NAMES,
                Takes::Each(&Takes::Either(&[Takes::Table(&AXIS), Takes::list(&Takes::Like)])),
            ]),
            "the values, or the range, of each parameter",
            "{ G = { from = \"1 W/K\", to = \"10 W/K\", points = 10 } }",
        ),
        shaped(
            "file",
            "file",
            FORMED,
            "the candidates of `csv`, one a row: a column for each parameter",
            "\"candidates.csv\"",
        ),
        whole("samples", "the number of candidates of `latin_hypercube` or `sobol`", "1024"),
        whole("seed", "the seed of `latin_hypercube` or `sobol`", "7").or("1"),
        words(
            "over",
            &words_of(&SweepOver::WORDS),
            "the results that are reported: of the steady \
            state, of `[run]` or of the periodic steady state",
            "\"run\"",
        )
        .or("`\"steady\"`"),
        key("period", "s", "the length of the cycle of `over = \"periodic\"`", "\"10 min\"")
            .or("that of the repeated signals"),
        shaped(
            "report",
            "table of expressions of results, below a functional unless `over = \"steady\"`",
            Takes::Each(&Takes::Like),
            "the \
            results to report of each candidate",
            "{ T_max = \"max(steel.T)\" }",
        )
        .needed(),
        shaped(
            "front",
            "list of two reports",
            Takes::List(&Takes::Text, 2, 2),
            "the two reports \
             of the Pareto front: no other candidate is better in both, and less is \
             better",
            "[\"mass\", \"T_max\"]",
        ),
    ],
    example: "{ method = \"grid\", axes = { p = { from = \"..\", to = \"..\", points = 10 } }, \
              report = { T = \"a.T\" } }",
    elsewhere: &[
        ("vary", "the values of parameters are `axes`"),
        ("axis", "the values of parameters are `axes`"),
        (
            "points",
            "write it next to the range: `axes = { p = { from = \"..\", to = \"..\", points = 10 } \
             }`",
        ),
        ("csv", "the file of the candidates is `file`"),
        ("data", "the file of the candidates is `file`"),
        ("reports", "the results to report are `report`"),
        ("n", "the number of candidates is `samples`"),
        ("pareto", "the two reports of a front are `front`"),
    ],
    ..SectionDeclaration::NEW
};

/// `p = { from = …, to = … }` in `axes`.
pub(super) const AXIS: SectionDeclaration = SectionDeclaration {
    name: "axis",
    keys: &[
        akin("from", "as the parameter", "the first value", "\"1 W/K\"").needed(),
        akin("to", "as the parameter", "the last value", "\"10 W/K\"").needed(),
        whole("points", "the number of values, both ends included", "10"),
        whole("steps", "the number of steps between the ends: one value more", "9"),
        words(
            "scale",
            &words_of(&SCALES),
            "the values have the same difference or the same ratio",
            "\"log\"",
        )
        .or("`\"linear\"`"),
    ],
    example: "{ from = \"1 W/K\", to = \"10 W/K\", points = 10 }",
    elsewhere: &[
        ("min", "the first value is `from`"),
        ("max", "the last value is `to`"),
        ("n", "the number of values is `points`"),
        ("step", "write the number of values, `points`, or of steps, `steps`"),
    ],
    ..SectionDeclaration::NEW
};
