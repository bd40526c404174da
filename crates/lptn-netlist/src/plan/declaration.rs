//! The keys of `[plan.NAME]`.

use crate::format::{Role, SectionDeclaration, Takes, VALUES, key, names, number, shaped, text};

pub(super) const PLAN: SectionDeclaration = SectionDeclaration {
    name: "plan",
    sentence: "A measurement to plan: the parameters to determine, and the possible sensors and \
        runs.",
    role: Role::Study,
    keys: &[
        shaped(
            "know",
            "table of errors",
            Takes::Each(&Takes::Like),
            "the standard error to reach for each parameter",
            "{ R_int = \"5 %\" }",
        )
        .needed(),
        names("vary", "list of parameters", "the other unknown parameters", "[\"C_steel\"]")
            .or("nothing"),
        shaped(
            "place",
            "table of places",
            Takes::Each(&Takes::Table(&PLACE)),
            "the possible places of a sensor",
            "{ ring = { of = \"steel.T\", noise = \"0.1 K\" } }",
        )
        .needed(),
        key(
            "noise",
            "K",
            "the standard deviation of one sample, of places without their own",
            "\"0.1 K\"",
        ),
        key(
            "drift",
            "K",
            "the standard deviation of a slow drift in addition, of all such places",
            "\"0.05 K\"",
        )
        .or("none"),
        key("drift_time", "s", "the correlation time of that drift", "\"5 min\""),
        key("every", "s", "the time between two samples", "\"1 s\"").needed(),
        key("duration", "s", "the longest duration of a run", "\"30 min\""),
        shaped(
            "run",
            "table of runs",
            Takes::Each(&Takes::Table(&PLAN_RUN)),
            "the runs that could be measured",
            "{ fast = { set = { omega = \"7000 rpm\" } } }",
        )
        .or("one run of the network"),
        names("done", "list of names", "runs that are measured in any case", "[\"fast\"]")
            .or("none"),
        names("given", "list of names", "fits whose records exist already", "[\"heating\"]")
            .or("none"),
        shaped(
            "cost",
            "table of numbers",
            Takes::Table(&COST),
            "the cost of a run and of an hour of it",
            "{ run = 40, hour = 120 }",
        )
        .or("nothing"),
        number("budget", "the highest cost of all", "500").or("no limit"),
    ],
    example: "{ know = { R = \"5 %\" }, place = { ring = { of = \"a.T\", noise = \"0.1 K\" } }, \
              every = \"1 s\", duration = \"30 min\" }",
    elsewhere: &[
        ("sensor", "the possible places of sensors are `place`; one of them may name a [sensor]"),
        ("sensors", "the possible places of sensors are `place`"),
        ("places", "the possible places of sensors are `place`"),
        ("runs", "the runs are `run`: `run = { fast = { set = { omega = \"7000 rpm\" } } }`"),
        ("target", "the parameters to determine are `know`"),
        ("sigma", "the standard deviation of one sample is `noise`"),
        ("prior", "the prior of a parameter is in [param]: `R = \"0.3 ± 0.05 K/W\"`"),
        ("data", "records that exist already belong to a fit: `given = [\"heating\"]`"),
    ],
    ..SectionDeclaration::NEW
};

/// `ring = { of = "steel.T", noise = "0.1 K" }` in `place`.
pub(super) const PLACE: SectionDeclaration = SectionDeclaration {
    name: "place",
    keys: &[
        text(
            "of",
            "expression of results",
            "the result that a sensor there \
            measures",
            "\"steel.T\"",
        )
        .needed(),
        key("noise", "K", "the standard deviation of one sample", "\"0.1 K\""),
        key("drift", "K", "the standard deviation of a slow drift in addition", "\"0.05 K\""),
        key("drift_time", "s", "the correlation time of that drift", "\"5 min\""),
        text("sensor", "name of a sensor", "the instrument", "\"tc1\""),
        number("cost", "the cost of a sensor there", "40"),
    ],
    example: "{ of = \"steel.T\", noise = \"0.1 K\" }",
    elsewhere: &[
        ("offset", "the errors of an instrument are in [sensor]: `tc1 = { offset = \"0 ± 3 K\" }`"),
        ("sigma", "the standard deviation of one sample is `noise`"),
        ("every", "the time between two samples is one for all places: `every` of the plan"),
    ],
    ..SectionDeclaration::NEW
};

/// `fast = { set = { omega = "7000 rpm" }, duration = "30 min" }` in `run`.
pub(super) const PLAN_RUN: SectionDeclaration = SectionDeclaration {
    name: "run of a plan",
    keys: &[
        shaped(
            "set",
            "table of parameters, or of lists of their values",
            Takes::Each(&VALUES),
            "their values in this run; lists make a run of every combination",
            "{ omega = [\"3000 rpm\", \"7000 rpm\"] }",
        ),
        key("duration", "s", "its longest duration", "\"30 min\""),
        number("cost", "its cost in addition to its time", "40"),
    ],
    example: "{ set = { omega = \"7000 rpm\" } }",
    elsewhere: &[(
        "every",
        "the time between two samples is one for all runs: `every` of the plan",
    )],
    ..SectionDeclaration::NEW
};

/// `{ run = 40, hour = 120 }` in `cost`.
pub(super) const COST: SectionDeclaration = SectionDeclaration {
    name: "cost",
    keys: &[
        number("run", "the cost of a run in addition to its time", "40"),
        number("hour", "the cost of an hour of a run", "120"),
    ],
    example: "{ run = 40, hour = 120 }",
    elsewhere: &[("sensor", "the cost of a sensor is next to its place")],
    ..SectionDeclaration::NEW
};
