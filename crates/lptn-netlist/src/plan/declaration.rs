//! The keys of `[plan.NAME]`.

use crate::format::{Role, SectionDeclaration, Takes, VALUES, key, names, number, shaped, text};

pub(super) const PLAN: SectionDeclaration = SectionDeclaration {
    name: "plan",
    sentence: "A measurement to come: what it shall tell, and the sensors and runs that it may take.",
    role: Role::Study,
    keys: &[
        shaped(
            "know",
            "table of errors",
            Takes::Each(&Takes::Like),
            "to which standard error each parameter shall be known",
            "{ R_int = \"5 %\" }",
        )
        .needed(),
        names("vary", "list of parameters", "what else is not known", "[\"C_steel\"]")
            .or("nothing"),
        shaped(
            "place",
            "table of places",
            Takes::Each(&Takes::Table(&PLACE)),
            "where a sensor could be",
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
            "the standard deviation of a slow drift beside it, of all such places",
            "\"0.05 K\"",
        )
        .or("none"),
        key("drift_time", "s", "the time after which that drift has forgotten itself", "\"5 min\""),
        key("every", "s", "the time between two samples", "\"1 s\"").needed(),
        key("duration", "s", "how long a run may last at most", "\"30 min\""),
        shaped(
            "run",
            "table of runs",
            Takes::Each(&Takes::Table(&PLAN_RUN)),
            "the runs that could be measured",
            "{ fast = { set = { omega = \"7000 rpm\" } } }",
        )
        .or("one, as the network stands"),
        names("done", "list of names", "runs that are measured in any case", "[\"fast\"]")
            .or("none"),
        names("given", "list of names", "fits whose records are there already", "[\"heating\"]")
            .or("none"),
        shaped(
            "cost",
            "table of numbers",
            Takes::Table(&COST),
            "what a run and an hour of it cost",
            "{ run = 40, hour = 120 }",
        )
        .or("nothing"),
        number("budget", "what all may cost", "500").or("no limit"),
    ],
    example: "{ know = { R = \"5 %\" }, place = { ring = { of = \"a.T\", noise = \"0.1 K\" } }, \
              every = \"1 s\", duration = \"30 min\" }",
    elsewhere: &[
        ("sensor", "where sensors could be is `place`; one of them may name a [sensor]"),
        ("sensors", "where sensors could be is `place`"),
        ("places", "where sensors could be is `place`"),
        ("runs", "the runs are `run`: `run = { fast = { set = { omega = \"7000 rpm\" } } }`"),
        ("target", "what shall be known is `know`"),
        ("sigma", "the standard deviation of one sample is `noise`"),
        ("prior", "what is known of a parameter stands in [param]: `R = \"0.3 ± 0.05 K/W\"`"),
        ("data", "records that are there already belong to a fit: `given = [\"heating\"]`"),
    ],
    ..SectionDeclaration::NEW
};

/// `ring = { of = "steel.T", noise = "0.1 K" }` in `place`.
pub(super) const PLACE: SectionDeclaration = SectionDeclaration {
    name: "place",
    keys: &[
        text("of", "expression of results", "what a sensor there measures", "\"steel.T\"").needed(),
        key("noise", "K", "the standard deviation of one sample", "\"0.1 K\""),
        key("drift", "K", "the standard deviation of a slow drift beside it", "\"0.05 K\""),
        key("drift_time", "s", "the time after which that drift has forgotten itself", "\"5 min\""),
        text("sensor", "name of a sensor", "the instrument", "\"tc1\""),
        number("cost", "what a sensor there costs", "40"),
    ],
    example: "{ of = \"steel.T\", noise = \"0.1 K\" }",
    elsewhere: &[
        ("offset", "what an instrument adds stands in [sensor]: `tc1 = { offset = \"0 ± 3 K\" }`"),
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
        key("duration", "s", "how long it may last at most", "\"30 min\""),
        number("cost", "what it costs beside its time", "40"),
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
        number("run", "what a run costs beside its time", "40"),
        number("hour", "what an hour of a run costs", "120"),
    ],
    example: "{ run = 40, hour = 120 }",
    elsewhere: &[("sensor", "what a sensor costs stands beside its place")],
    ..SectionDeclaration::NEW
};
