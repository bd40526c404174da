//! The keys of `[fit.NAME]`.

use crate::csv_form::{DATES, DECIMAL, START, UNITS};
use crate::fit::read::OUTLIERS;
use crate::format::{
    KeyDeclaration, NAMES, Role, SectionDeclaration, Takes, akin, shaped, text, words, words_of,
};
use crate::size::VARY;

/// The column of the times.
pub(crate) const TIME_OF: KeyDeclaration =
    text("time", "name of a column", "the column of the times", "\"t\"")
        .or("the first in a unit of time");

/// The results that columns measure.
pub(crate) const COLUMNS: KeyDeclaration = shaped(
    "column",
    "table of results",
    Takes::Each(&Takes::Either(&[Takes::Text, Takes::Table(&FIT_COLUMN)])),
    "the result that each column measures",
    "{ ring = \"steel.T\" }",
)
.needed();

/// Treatment of outliers.
pub(crate) const OUTLIERS_OF: KeyDeclaration =
    words("outliers", &words_of(&OUTLIERS), "values far from their neighbours", "\"drop\"")
        .or("`\"keep\"`");

/// Signals that follow columns.
pub(crate) const SIGNALS: KeyDeclaration = shaped(
    "signal",
    "table of columns",
    Takes::Each(&Takes::Either(&[Takes::Text, Takes::Table(&FIT_SIGNAL)])),
    "signals that follow a column of the record",
    "{ speed = \"omega\" }",
)
.or("their own values over time");

pub(super) const FIT: SectionDeclaration = SectionDeclaration {
    name: "fit",
    sentence: "Parameters to estimate from records.",
    role: Role::Study,
    keys: &[
        shaped(
            "data",
            "file, or a list of files",
            RECORDS,
            "the records; one may `set` parameters",
            "\"record.csv\"",
        )
        .needed(),
        TIME_OF,
        COLUMNS,
        akin("sigma", "as the column", "the standard deviation of one sample", "\"0.2 K\""),
        shaped(
            "vary",
            "table of ranges, or names",
            Takes::Either(&[NAMES, Takes::Each(&Takes::Table(&VARY))]),
            "the parameters to estimate",
            "{ p = { from = \"1 W/K\", to = \"10 W/K\" } }",
        )
        .needed(),
        OUTLIERS_OF,
        SIGNALS,
        text(
            "initial",
            "`\"record\"`, or s",
            "start of measured nodes: the first row, or the mean over this time",
            "\"record\"",
        )
        .or("`T0`"),
    ],
    example: "{ data = \"record.csv\", column = { ring = \"steel.T\" }, vary = [\"R\"] }",
    elsewhere: &[
        ("csv", "the records are `data`: `data = \"record.csv\"`"),
        ("columns", "the result that a column measures is `column = { ring = \"steel.T\" }`"),
        (
            "set",
            "write the values that a record sets next to its file: `data = [{ csv = \"r1.csv\", \
             set = { omega = \"1000 rpm\" } }]`",
        ),
        ("parameters", "the parameters to estimate are `vary`"),
        ("prior", "the prior of a parameter is in [param]: `R = \"0.3 ± 0.05 K/W\"`"),
        ("start", "the search starts from the value in [param]"),
    ],
    ..SectionDeclaration::NEW
};

/// `{ csv = "r1.csv", set = { omega = "1000 rpm" } }` in `data`.
pub(super) const RECORD: SectionDeclaration = SectionDeclaration {
    name: "record",
    keys: &[
        text("csv", "file", "the record", "\"record.csv\"").needed(),
        shaped(
            "set",
            "table of parameters",
            Takes::Each(&Takes::Like),
            "the parameters with other values in its run",
            "{ omega = \"1000 rpm\" }",
        ),
        DECIMAL,
        DATES,
        START,
        UNITS,
    ],
    example: "{ csv = \"r1.csv\", set = { omega = \"1000 rpm\" } }",
    ..SectionDeclaration::NEW
};
const ONE_RECORD: Takes = Takes::Either(&[Takes::Text, Takes::Table(&RECORD)]);

/// Records: one, or a list of them.
pub(crate) const RECORDS: Takes =
    Takes::Either(&[Takes::Text, Takes::Table(&RECORD), Takes::list(&ONE_RECORD)]);

/// `ring = { of = "steel.T", sigma = "0.2 K" }` in `column` of a fit.
pub(super) const FIT_COLUMN: SectionDeclaration = SectionDeclaration {
    name: "column",
    keys: &[
        text(
            "of",
            "expression of results",
            "the result that the column \
            measures",
            "\"steel.T\"",
        )
        .needed(),
        akin("sigma", "as the column", "the standard deviation of one sample", "\"0.2 K\""),
        text("sensor", "name of a sensor", "the instrument that gave it", "\"tc1\""),
    ],
    example: "{ of = \"steel.T\", sigma = \"0.2 K\" }",
    elsewhere: &[
        ("offset", "the errors of an instrument are in [sensor]: `tc1 = { offset = \"0 ± 3 K\" }`"),
        ("unit", "the unit is in the header of the file: `ring [degC]`"),
    ],
    ..SectionDeclaration::NEW
};

/// `bed = { column = "mill_bed", sensor = "tc3" }` in `signal` of a fit.
pub(super) const FIT_SIGNAL: SectionDeclaration = SectionDeclaration {
    name: "signal",
    keys: &[
        text(
            "column",
            "name of a column",
            "the column that the signal \
            follows",
            "\"mill_bed\"",
        )
        .needed(),
        text("sensor", "name of a sensor", "the instrument that gave it", "\"tc3\""),
    ],
    example: "{ column = \"mill_bed\", sensor = \"tc3\" }",
    elsewhere: &[(
        "offset",
        "the errors of an instrument are in [sensor]: `tc3 = { offset = \"0 ± 3 K\" }`",
    )],
    ..SectionDeclaration::NEW
};
