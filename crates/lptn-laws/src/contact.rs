//! `[contact]`: joints between solids, which obey the law of a film.

use crate::declare::{KindDeclaration, SurfaceKind};

/// `[contact]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Contact: KindDeclaration = KindDeclaration {
    section: "contact",
    sentence: "A joint between two solids.",
    selector: None,
    example: "{ from = \"a\", to = \"b\", h = \"3000 W/(m^2 K)\", area = \"20 cm^2\" }",
    elsewhere: &[
        ("R", "a path given by `R` belongs in [resistor]"),
        ("G", "a path given by `G` belongs in [resistor]"),
        ("A", "the area is `area`"),
    ],
    later: &[],
    surface: Some(SurfaceKind::Touching),
};
