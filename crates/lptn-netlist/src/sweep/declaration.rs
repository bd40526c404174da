//! The keys of `[sweep.NAME]`.

use crate::format::{Role, SectionDeclaration, key};

pub(crate) const SWEEP: SectionDeclaration = SectionDeclaration {
    name: "sweep",
    sentence: "Many candidates: values of parameters, and what is reported of each.",
    role: Role::Study,
    keys: &[
        key(
            "method",
            "`\"grid\"`, `\"list\"`, `\"csv\"`, `\"latin_hypercube\"`, `\"sobol\"`",
            "how the candidates are chosen",
            "\"grid\"",
        ),
        key(
            "axes",
            "table of parameters; of `csv` a list of names",
            "the values, or the range, of each parameter",
            "{ G = { from = \"1 W/K\", to = \"10 W/K\", points = 10 } }",
        ),
        key(
            "file",
            "file",
            "the candidates of `csv`, one a row: a column for each parameter",
            "\"candidates.csv\"",
        ),
        key(
            "samples",
            "whole number",
            "how many candidates `latin_hypercube` or `sobol` takes",
            "1024",
        ),
        key("seed", "whole number", "the seed of `latin_hypercube` or `sobol`", "7").or("1"),
        key(
            "over",
            "`\"steady\"`, `\"run\"`, `\"periodic\"`",
            "the results that are reported: of the steady state, of `[run]` or of the settled cycle",
            "\"run\"",
        )
        .or("`\"steady\"`"),
        key("period", "s", "the length of the cycle of `over = \"periodic\"`", "\"10 min\"")
            .or("that of the repeated signals"),
        key(
            "report",
            "table of expressions of results, below a functional unless `over = \"steady\"`",
            "what is reported of each candidate",
            "{ T_max = \"max(steel.T)\" }",
        ),
        key(
            "front",
            "list of two reports",
            "of which two the best candidates are told: those that none betters in both, less being \
             better",
            "[\"mass\", \"T_max\"]",
        ),
    ],
    example: "{ method = \"grid\", axes = { p = { from = \"..\", to = \"..\", points = 10 } }, \
              report = { T = \"a.T\" } }",
    elsewhere: &[
        ("vary", "the values of parameters are `axes`"),
        ("axis", "the values of parameters are `axes`"),
        ("points", "write it beside the range: `axes = { p = { from = \"..\", to = \"..\", points = 10 } }`"),
        ("csv", "the file of the candidates is `file`"),
        ("data", "the file of the candidates is `file`"),
        ("reports", "what is reported is `report`"),
        ("n", "the number of candidates is `samples`"),
        ("pareto", "the two reports of a front are `front`"),
    ],
    ..SectionDeclaration::NEW
};

/// `p = { from = .., to = .. }` in `axes`.
pub(super) const AXIS: SectionDeclaration = SectionDeclaration {
    name: "axis",
    keys: &[
        key("from", "as the parameter", "the first value", "\"1 W/K\""),
        key("to", "as the parameter", "the last value", "\"10 W/K\""),
        key("points", "whole number", "how many values, both ends included", "10"),
        key("steps", "whole number", "how many steps lie between the ends: one value more", "9"),
        key(
            "scale",
            "`\"linear\"`, `\"log\"`",
            "whether the values are apart by the same difference or by the same ratio",
            "\"log\"",
        )
        .or("`\"linear\"`"),
    ],
    example: "{ from = \"1 W/K\", to = \"10 W/K\", points = 10 }",
    elsewhere: &[
        ("min", "the first value is `from`"),
        ("max", "the last value is `to`"),
        ("n", "the number of values is `points`"),
        ("step", "write how many values there are, `points`, or how many steps, `steps`"),
    ],
    ..SectionDeclaration::NEW
};
