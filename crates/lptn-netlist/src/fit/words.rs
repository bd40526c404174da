//! The words of `[fit]`.

use crate::vocabulary::Section;

/// Parameters to find from records.
pub(crate) const FIT: Section = Section {
    name: "fit",
    keys: &["data", "time", "column", "sigma", "vary"],
    later: &[],
    example: "{ data = \"record.csv\", column = { ring = \"steel.T\" }, vary = [\"R\"] }",
    elsewhere: &[
        ("csv", "the records are `data`: `data = \"record.csv\"`"),
        ("columns", "what a column measures is `column = { ring = \"steel.T\" }`"),
        (
            "set",
            "what a record sets stands beside its file: `data = [{ csv = \"r1.csv\", set = { omega = \"1000 rpm\" } }]`",
        ),
        ("parameters", "the parameters to find are `vary`"),
        ("prior", "what is known of a parameter stands in [param]: `R = \"0.3 ± 0.05 K/W\"`"),
        ("start", "the search starts from the value in [param]"),
    ],
};

/// `ring = { of = "steel.T", sigma = "0.2 K" }` in `column` of a fit.
pub(crate) const FIT_COLUMN: Section = Section {
    name: "column",
    keys: &["of", "sigma"],
    later: &[],
    example: "{ of = \"steel.T\", sigma = \"0.2 K\" }",
    elsewhere: &[("unit", "the unit stands in the header of the file: `ring [degC]`")],
};
