//! `winding` of a material: its properties from those of wire, enamel and resin.
//!
//! Across the wires, each wire with its enamel is a coated cylinder in resin. Both steps take the
//! Hashin-Shtrikman bound of cylinders: Z. Hashin and S. Shtrikman, J. Appl. Phys. 33 (1962) 3125;
//! for windings, N. Simpson, R. Wrobel and P. H. Mellor, IEEE Trans. Ind. Appl. 49 (2013) 2505. It
//! is exact for Hashin's assemblage of coated cylinders and a lower bound for others. Along the
//! wires all parts conduct in parallel, and their heat capacities add.
//!
//! The properties are expressions, so parameters may set the shares and the parts may depend on T.

use lptn_network::{Field, Input, Material, Value, Winding};
use lptn_units::{Dimension, Expression, Quantity, Type};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, number, text};
use crate::place::{Given, Place, Wanted};
use crate::raw::RawValue;
use crate::texture::Texture;
use crate::work::Elaboration;

pub(crate) const WINDING: SectionDeclaration = SectionDeclaration {
    name: "winding",
    sentence: "The parts of a winding of round wires.",
    role: Role::Inner,
    keys: &[
        number("fill", "share of the conductor in the volume", "0.45").needed(),
        text("wire", "name of a material", "material of the conductor", "\"copper\"").needed(),
        text("resin", "name of a material", "material between the wires", "\"peek\"").needed(),
        text("enamel", "name of a material", "material of the enamel, if any", "\"polyamide_66\""),
        number("enamel_fill", "with `enamel`: its share in the volume", "0.07"),
    ],
    example: "{ fill = 0.45, wire = \"copper\", resin = \"peek\" }",
    elsewhere: &[
        ("k", "the conductivities follow from those of the parts"),
        ("fill_factor", "the share of the conductor is `fill`"),
        ("conductor", "the material of the conductor is `wire`"),
        ("impregnation", "the material between the wires is `resin`"),
    ],
    ..SectionDeclaration::NEW
};

/// Density, specific heat, conductivity across and along the wires.
pub(super) struct Mixture {
    pub(super) density: Input,
    pub(super) cp: Input,
    pub(super) k: Input,
    pub(super) k_axis: Input,
    pub(super) winding: Winding<Input>,
}

/// A part: its share and its properties, as expressions.
struct Part {
    share: String,
    density: String,
    cp: String,
    k: String,
}

/// The Hashin-Shtrikman bound of cylinders of conductivity `inner` in `outer`, whose share in both
/// is `share`.
fn cylinders(inner: &str, outer: &str, share: &str) -> String {
    format!(
        "{outer} * ((1 + {share}) * {inner} + (1 - {share}) * {outer}) / \
         ((1 - {share}) * {inner} + (1 + {share}) * {outer})"
    )
}

/// The sum of a term over the parts.
fn sum(parts: &[Part], term: impl Fn(&Part) -> String) -> String {
    parts.iter().map(term).collect::<Vec<_>>().join(" + ")
}

/// The conductivity across the wires of wire, enamel if there is any, and resin.
fn across(parts: &[Part]) -> String {
    match parts {
        [wire, enamel, resin] => {
            let both = format!("({} + {})", wire.share, enamel.share);
            let core = format!("({} / {both})", wire.share);
            let coated = format!("({})", cylinders(&wire.k, &enamel.k, &core));
            cylinders(&coated, &resin.k, &both)
        }
        [wire, resin] => cylinders(&wire.k, &resin.k, &wire.share),
        _ => String::new(),
    }
}

impl<'a> Elaboration<'a> {
    /// The properties of a material with the key `winding`; `None` if one of its parts is wrong.
    pub(super) fn mixture(&mut self, of: &Fields<'a>) -> Option<Mixture> {
        let entry = of.entry(WINDING.name)?;
        let fields = self.inner(&WINDING, of.owner.inside(WINDING.name), entry)?;
        let fill = self.volume_share(&fields, "fill");
        let enamel_fill = self.enamel_fill(&fields);
        for key in ["wire", "resin"] {
            self.require(&fields, key);
        }
        let [wire, enamel, resin] = ["wire", "enamel", "resin"].map(|key| self.part(&fields, key));
        if fields.has("enamel") && enamel.is_none() {
            return None;
        }
        let ((fill, fill_text), (enamel_fill, enamel_text)) = (fill?, enamel_fill?);
        let rest = format!("(1 - {fill_text} - {enamel_text})");
        let (wire, resin) = (wire?, resin?);
        let winding = Winding {
            fill,
            enamel_fill,
            wire: wire.0,
            enamel: enamel.as_ref().map(|(name, _)| name.clone()),
            resin: resin.0,
        };
        let shares = [fill_text, enamel_text, rest];
        let all = [Some(wire.1), enamel.map(|(_, part)| part), Some(resin.1)];
        let parts = shares.into_iter().zip(all);
        let parts: Vec<Part> =
            parts.filter_map(|(share, part)| Some(Part { share, ..part? })).collect();
        self.mixed(&parts, winding)
    }

    fn mixed(&mut self, parts: &[Part], winding: Winding<Input>) -> Option<Mixture> {
        let density = sum(parts, |p| format!("{} * {}", p.share, p.density));
        let heat = sum(parts, |p| format!("{} * {} * {}", p.share, p.density, p.cp));
        let along = sum(parts, |p| format!("{} * {}", p.share, p.k));
        let mut of = |text: &str, dimension| self.computed(text, Type::of(dimension));
        Some(Mixture {
            density: of(&density, Dimension::DENSITY)?,
            cp: of(&format!("({heat}) / ({density})"), Dimension::SPECIFIC_HEAT)?,
            k: of(&across(parts), Dimension::CONDUCTIVITY)?,
            k_axis: of(&along, Dimension::CONDUCTIVITY)?,
            winding,
        })
    }

    /// The value of an expression over parameters and `T`; a number if it names none.
    fn computed(&mut self, text: &str, ty: Type) -> Option<Input> {
        let expression = Expression::parse(text).ok()?;
        let scope = self.builder.scope(Wanted::own(ty).context);
        let program = expression.compile(&scope, Some(ty)).ok()?;
        if program.slots().is_empty() && program.table_calls().is_empty() {
            let value = program.eval::<f64>(&[], &mut Vec::new()).ok()?;
            return Some(Quantity { value, deviation: None, ty }.into());
        }
        Some(program.into())
    }

    /// A share with its text.
    fn volume_share(&mut self, fields: &Fields<'a>, key: &str) -> Option<(Input, String)> {
        let raw = self.require(fields, key)?;
        self.share_at(fields, (key, raw))
    }

    fn share_at(
        &mut self,
        fields: &Fields<'a>,
        (key, raw): (&str, &'a RawValue),
    ) -> Option<(Input, String)> {
        let place = Place { owner: &fields.owner, key, raw };
        let given = self.given(place, Wanted::constant(Type::SCALAR))?;
        let text = match &given {
            Given::Quantity(quantity) => {
                self.without_deviation(place, quantity)?;
                Expression::literal(quantity.value, Type::SCALAR).text().to_owned()
            }
            Given::Expression(program) => format!("({})", program.text().trim()),
        };
        Some((given.input(), text))
    }

    /// The share of the enamel; 0 without enamel.
    fn enamel_fill(&mut self, fields: &Fields<'a>) -> Option<(Input, String)> {
        if fields.has("enamel") {
            return self.volume_share(fields, "enamel_fill");
        }
        self.refuse_keys(fields, &["enamel_fill"], "belongs to an `enamel`, which is not given");
        Some((Input::number(0.0), "0".to_owned()))
    }

    /// A part that is named, with its properties.
    fn part(&mut self, fields: &Fields<'a>, key: &'static str) -> Option<(String, Part)> {
        let (name, raw) = self.word(fields, key)?;
        let known = self.known_material(fields, (key, name), raw)?;
        if known.texture != Texture::Even {
            let message =
                format!("{} is itself a material of layers or wires", fields.owner.field(key));
            let help = "a part of a winding conducts equally in all directions";
            self.refuse("netlist::winding_part", message, &raw.span, help);
            return None;
        }
        let needs = [("density", known.density), ("cp", known.cp), ("k", known.k)];
        if let Some((property, _)) = needs.into_iter().find(|(_, has)| !has) {
            let problem = self.without_property(fields, (name, raw), known.id, property);
            self.report(problem);
            return None;
        }
        let material = self.builder.properties_of(known.id);
        let [density, cp, k] = of_material(material);
        let (Some(density), Some(cp), Some(k)) = (density, cp, k) else {
            let message =
                format!("{} is `{name}`, which has a table over `T`", fields.owner.field(key));
            let help = "name a material whose density, cp and k are constants or expressions";
            self.refuse("netlist::winding_part", message, &raw.span, help);
            return None;
        };
        Some((name.to_owned(), Part { share: String::new(), density, cp, k }))
    }

    /// Notes the places of the shares.
    pub(super) fn note_winding(&mut self, item: lptn_network::Item, of: &Fields<'a>) {
        let Some(entry) = of.entry(WINDING.name) else { return };
        self.map.value(item, Field::Conductivity, &entry.value);
        let crate::raw::RawKind::Table(table) = &entry.value.kind else { return };
        for field in [Field::Fill, Field::EnamelFill] {
            if let Some(raw) = table.get(field.key()) {
                self.map.value(item, field, &raw.value);
            }
        }
    }
}

/// Density, specific heat and conductivity as texts; `None` for a table that has no name.
fn of_material(material: &Material) -> [Option<String>; 3] {
    let texts = [
        (&material.density, Dimension::DENSITY),
        (&material.cp, Dimension::SPECIFIC_HEAT),
        (&material.k, Dimension::CONDUCTIVITY),
    ];
    texts.map(|(value, dimension)| match value.as_ref()? {
        Value::Constant(value) => {
            Some(Expression::literal(*value, Type::of(dimension)).text().to_owned())
        }
        Value::Expression(program) if program.table_calls().is_empty() => {
            Some(format!("({})", program.text().trim()))
        }
        Value::Expression(_) | Value::Product(_) => None,
    })
}
