//! `[conduction]`: bodies of simple shape.

use lptn_network::{Input, Path, Shape};
use lptn_units::{Dimension, Type};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, sample};
use crate::section::conductor::check_forms;

const FORMS: &[&[&str]] = &[&["material"], &["k"]];

/// A shape without its measures.
#[derive(Clone, Copy, PartialEq)]
enum Body {
    Slab,
    Cylinder,
    Sphere,
    Rod,
}

const BODIES: [(&str, Body); 4] =
    [("slab", Body::Slab), ("cylinder", Body::Cylinder), ("sphere", Body::Sphere), ("rod", Body::Rod)];

const MEASURES: [&str; 6] = ["area", "thickness", "r_in", "r_out", "length", "diameter"];

impl Body {
    fn measures(self) -> &'static [&'static str] {
        match self {
            Self::Slab => &["area", "thickness"],
            Self::Cylinder => &["r_in", "r_out", "length"],
            Self::Sphere => &["r_in", "r_out"],
            Self::Rod => &["diameter", "length"],
        }
    }
}

impl<'a> Elaboration<'a> {
    /// The law of a body that conducts.
    pub(crate) fn conduction(&mut self, fields: &Fields<'a>) -> Option<Path> {
        self.problems.extend(check_forms(fields, FORMS));
        let ty = Type::of(Dimension::CONDUCTIVITY);
        let given = self.law(fields, "k", ty);
        let conductivity = given.or_else(|| self.conductivity(fields)).unwrap_or_else(|| stand_in(ty));
        let shape = fields.require("shape", &mut self.problems).is_some();
        let body = self.choice(fields, "shape", &BODIES).filter(|_| shape)?;
        let measures = body.measures();
        let others: Vec<&str> = MEASURES.into_iter().filter(|key| !measures.contains(key)).collect();
        let (name, _) = BODIES.iter().find(|(_, other)| *other == body)?;
        let takes = crate::vocabulary::list(measures);
        self.refuse_keys(fields, &others, &format!("means nothing for a {name}, which takes {takes}"));
        let missing = measures.iter().find(|key| !fields.has(key));
        if let Some(key) = missing.filter(|_| fields.complete) {
            let message = format!("{} is a {name} without `{key}`", fields.owner.words());
            let problem = Diagnostic::error("netlist::missing_field", message)
                .at(fields.place.clone(), format!("`{key}` is missing"));
            self.report(problem.help(format!("add `{}`", sample(key))));
        }
        let mut measure = |key: &str| {
            let dimension = if key == "area" { Dimension::AREA } else { Dimension::LENGTH };
            self.law(fields, key, Type::of(dimension))
        };
        let values: Vec<Option<Input>> = measures.iter().map(|key| measure(key)).collect();
        let mut values = values.into_iter();
        let mut next = || values.next().flatten();
        let shape = match body {
            Body::Slab => Shape::Slab { area: next()?, thickness: next()? },
            Body::Cylinder => Shape::Cylinder { inner: next()?, outer: next()?, length: next()? },
            Body::Sphere => Shape::Sphere { inner: next()?, outer: next()? },
            Body::Rod => Shape::Rod { diameter: next()?, length: next()? },
        };
        Some(Path::Conduction(conductivity, shape))
    }

    /// The conductivity of the material.
    fn conductivity(&mut self, fields: &Fields<'a>) -> Option<Input> {
        let raw = fields.get("material")?;
        let name = fields.text("material", raw, &mut self.problems)?;
        let known = self.known_material(fields, name, raw)?;
        if !known.k {
            let problem = self.without_property(fields, (name, raw), known.id, "k");
            self.report(problem);
            return None;
        }
        self.builder.conductivity(known.id)
    }
}
