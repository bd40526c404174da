//! `[enclosure]`: grey, diffuse surfaces that see each other, written out as Oppenheim's network of
//! radiosities before anything is read.
//!
//! Surface i has a massless node of its radiosity J_i = sigma T_J^4, a path e A / (1 - e) to it, and
//! a path A_i F_ij from it to each other radiosity. A black surface is its own radiosity.

mod read;
mod surface;
mod view;

use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_laws::Kind;

use crate::format::{Role, SectionDeclaration, Takes, key, number, shaped};
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::section::NODE;
use crate::template::Structure;
use crate::written_out::here;
use read::Read;
use surface::{Emissivity, Surface};

/// `[enclosure]`, as netlists declare it.
pub(crate) const ENCLOSURE: SectionDeclaration = SectionDeclaration {
    name: "enclosure",
    sentence: "Grey, diffuse surfaces that see each other and nothing else.",
    role: Role::Element,
    keys: &[
        shaped(
            "surfaces",
            "table of surfaces",
            Takes::Each(&Takes::Table(&SURFACE)),
            "its surfaces, by the names of their nodes or boundaries",
            "{ part = { area = \"0.2 m^2\", emissivity = 0.8 }, walls = { area = \"3 m^2\", \
             emissivity = 0.6 } }",
        )
        .needed(),
        shaped(
            "view_factors",
            "list of [from, to, F]",
            Takes::list(&Takes::List(&Takes::Like, 3, 3)),
            "the share of the radiation of a surface that reaches another one, or itself",
            "[[\"part\", \"walls\", 1], [\"walls\", \"walls\", 0.9333]]",
        )
        .needed(),
    ],
    example: "{ surfaces = { part = { area = \"0.2 m^2\", emissivity = 0.8 }, walls = { area = \
              \"3 m^2\", emissivity = 0.6 } }, view_factors = [[\"part\", \"walls\", 1], \
              [\"walls\", \"walls\", 0.9333]] }",
    elsewhere: &[
        ("F", "view factors are in `view_factors`"),
        ("view_factor", "view factors are in `view_factors`, a list of [from, to, F]"),
        ("emissivity", "each surface has its own: `surfaces = { part = { area, emissivity } }`"),
        ("area", "each surface has its own: `surfaces = { part = { area, emissivity } }`"),
    ],
    ..SectionDeclaration::NEW
};

const SURFACE: SectionDeclaration = SectionDeclaration {
    name: "surface",
    sentence: "A surface of an enclosure.",
    keys: &[
        key("area", "m^2", "area of the surface, a number", "\"0.2 m^2\"").needed(),
        number("emissivity", "above 0, at most 1; an expression below 1", "0.8").needed(),
    ],
    example: "{ area = \"0.2 m^2\", emissivity = 0.8 }",
    elsewhere: &[("epsilon", "the emissivity is `emissivity`"), ("A", "the area is `area`")],
    ..SectionDeclaration::NEW
};

/// Replaces every enclosure by massless nodes and radiation paths.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &mut Arc<Structure>,
    problems: &mut Vec<Diagnostic>,
) {
    for entry in raw.take(ENCLOSURE.name) {
        let Some(read) = Read::of(&entry, problems) else { continue };
        let here = here(structure, &entry);
        let written = Written { full: &entry.key, here, at: &entry.key_span, raw };
        let areas = written.all(&read);
        if !areas.is_empty() {
            let structure = Arc::make_mut(structure);
            for (path, surface) in areas {
                structure.note_surface_area(path, surface.area, surface.area_at);
            }
        }
    }
}

/// An enclosure that is being written out.
struct Written<'w> {
    /// Its name, and the one inside its template.
    full: &'w str,
    here: &'w str,
    at: &'w Span,
    raw: &'w mut RawNetlist,
}

impl Written<'_> {
    /// Writes it; the paths that end at a surface itself, each with the surface.
    fn all<'r>(mut self, read: &'r Read<'r>) -> Vec<(String, &'r Surface<'r>)> {
        let mut areas = Vec::new();
        for surface in &read.surfaces {
            areas.extend(self.surface(surface).map(|path| (path, surface)));
        }
        for &(i, j, exchange) in &read.exchange {
            let [a, b] = [&read.surfaces[i], &read.surfaces[j]];
            let name = format!("{}.{}.{}", self.full, a.name, b.name);
            let ends = [self.radiosity(a), self.radiosity(b)];
            self.path(&name, ends, format!("{exchange} m^2"), self.at);
            areas.extend([a, b].into_iter().find(|s| s.is_black()).map(|surface| (name, surface)));
        }
        areas
    }

    /// The radiosity of a grey surface, and the path to it, given by its exchange area: a law with the
    /// emissivity as a field would have a second field that depends on it. The name of the path.
    fn surface(&mut self, surface: &Surface<'_>) -> Option<String> {
        let area = surface.area;
        let exchange = match &surface.emissivity {
            Emissivity::Black => return None,
            Emissivity::Number(e) => format!("{} m^2", area * e / (1.0 - e)),
            Emissivity::Follows(text) => format!("({text}) / (1 - ({text})) * {area} [m^2]"),
        };
        let massless = RawValue { span: self.at.clone(), kind: RawKind::Boolean(true) };
        let name = format!("{}.{}", self.full, surface.name);
        let fields = vec![RawEntry::new("massless", massless)];
        self.raw
            .push(NODE.name, RawEntry::new(&format!("{name}.J"), RawValue::table(fields, self.at)));
        let ends = [RawValue::text(surface.name.to_owned(), surface.at), self.radiosity(surface)];
        self.path(&name, ends, exchange, surface.emissivity_at);
        Some(name)
    }

    /// The end that stands for the radiosity of a surface.
    fn radiosity(&self, surface: &Surface<'_>) -> RawValue {
        match surface.emissivity {
            Emissivity::Black => RawValue::text(surface.name.to_owned(), surface.at),
            Emissivity::Number(_) | Emissivity::Follows(_) => {
                RawValue::text(format!("{}.{}.J", self.here, surface.name), self.at)
            }
        }
    }

    fn path(&mut self, name: &str, [from, to]: [RawValue; 2], exchange: String, at: &Span) {
        let fields = vec![
            RawEntry::new("from", from),
            RawEntry::new("to", to),
            RawEntry::new("Gr", RawValue::text(exchange, at)),
        ];
        self.raw.push(
            Kind::Radiation.declaration().section,
            RawEntry::new(name, RawValue::table(fields, self.at)),
        );
    }
}
