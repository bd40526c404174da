//! `[lubricant]`: oils and greases, whose viscosity and density expressions call by name.

use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_network::{Context, End, Field, Input, Item, ZERO_CELSIUS};
use lptn_units::{
    Dimension, DoubleLog, Expression, Interpolation, LookupTable, Outside, Table1, TableSymbol,
    Type, Unit, format_short, suggest,
};

use crate::fields::{Fields, Oil};
use crate::format::{Role, SectionDeclaration, Takes, key, number, shaped};
use crate::library;
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::section::keys::SOURCE_OF;
use crate::work::Elaboration;

pub(crate) const LUBRICANT: SectionDeclaration = SectionDeclaration {
    name: "lubricant",
    sentence: "An oil or grease, whose viscosity `NAME.nu(T)` and density `NAME.density(T)` \
        expressions may call.",
    role: Role::Substance,
    keys: &[
        shaped(
            "viscosity",
            "list",
            Takes::List(&Takes::List(&Takes::Text, 2, 2), 2, 2),
            "kinematic viscosity at two temperatures that rise, after ASTM D341",
            "[[\"40 degC\", \"220 mm^2/s\"], [\"100 degC\", \"19 mm^2/s\"]]",
        ),
        key(
            "nu_40",
            "m^2/s",
            "instead of `viscosity`: that at 40 degC, with `VI`",
            "\"220 mm^2/s\"",
        ),
        number("VI", "with `nu_40`: the viscosity index, after ASTM D2270", "95"),
        number(
            "c",
            "the constant added to the viscosity in mm^2/s: 0.8 is DIN \
            51563",
            "0.8",
        )
        .or("0.7"),
        key("density", "kg/m^3", "density at 15 degC", "\"890 kg/m^3\""),
        key("expansion", "1/K", "with `density`: its decrease per kelvin", "\"0.00065 1/K\"")
            .or("0"),
        SOURCE_OF,
    ],
    either: &[&["viscosity", "nu_40"]],
    example: "{ viscosity = [[\"40 degC\", \"220 mm^2/s\"], [\"100 degC\", \"19 mm^2/s\"]] }",
    elsewhere: &[
        ("nu", "the viscosity is `viscosity`, at two temperatures, or `nu_40` with `VI`"),
        ("nu_100", "give both points: `viscosity = [[\"40 degC\", ..], [\"100 degC\", ..]]`"),
        ("cp", "a medium that carries heat is a [fluid]"),
    ],
    ..SectionDeclaration::NEW
};

const VISCOSITY: Type = Type::of(Dimension::KINEMATIC_VISCOSITY);
const DENSITY: Type = Type::of(Dimension::DENSITY);

/// The endings of the properties of a lubricant.
pub(super) const PROPERTIES: [&str; 2] = ["nu", "density"];

/// Viscosities in m^2/s that ASTM D341 covers.
const COVERED: [f64; 2] = [2e-6, 20.0];

/// The highest temperature of a lubricant in K, and the lowest at which it has a density.
const HOTTEST: f64 = 773.15;
const COLDEST: f64 = 173.15;

/// Temperature in K of the given density.
const OF_DENSITY: f64 = ZERO_CELSIUS + 15.0;

impl<'a> Elaboration<'a> {
    pub(crate) fn lubricants(&mut self) {
        for entry in self.elements(LUBRICANT.name) {
            if self.lubricant(entry, &entry.key_span).is_none() {
                self.names.hide_substance(LUBRICANT.name, &entry.key);
                PROPERTIES.iter().for_each(|p| self.names.fail(&format!("{}.{p}", entry.key)));
            }
        }
    }

    /// Gives the functions of a lubricant to the builder.
    fn lubricant(&mut self, entry: &'a RawEntry, at: &Span) -> Option<()> {
        let fields = self.fields(&LUBRICANT, entry)?;
        let c = self.input_number(&fields, "c", 0.7);
        let density = self.density(&fields);
        self.word(&fields, "source");
        let (points, raw) = self.viscosities(&fields)?;
        let line = DoubleLog::through(points, (c?, 1e-6), (COVERED[1], HOTTEST));
        let line = match line {
            Some(line) if points[1][1] >= COVERED[0] => line,
            _ => {
                self.report(wrong_points(&fields, points, raw));
                return None;
            }
        };
        self.function((&entry.key, "nu"), LookupTable::DoubleLog(line), VISCOSITY, at);
        if let Some(table) = density? {
            self.function((&entry.key, "density"), LookupTable::One(table), DENSITY, at);
        }
        Some(())
    }

    fn function(
        &mut self,
        (name, property): (&str, &str),
        table: LookupTable,
        ty: Type,
        at: &Span,
    ) {
        let unit = if property == "nu" { "mm^2/s" } else { "kg/m^3" };
        let units = ["degC", unit].map(|text| Unit::parse(text).ok());
        let symbol = TableSymbol {
            table: Arc::new(table),
            arguments: vec![Type::ABSOLUTE_TEMPERATURE],
            ty,
            units: units.into_iter().collect::<Option<_>>().unwrap_or_default(),
        };
        let id = self.builder.table(&format!("{name}.{property}"), symbol);
        self.map.insert(Item::Table(id), Field::Name, at.clone());
    }

    /// A plain number that may be left out; `None` if it is wrong.
    fn input_number(&mut self, fields: &Fields<'a>, key: &str, default: f64) -> Option<f64> {
        match fields.get(key) {
            None => Some(default),
            Some(raw) => self.constant_at(fields, (key, raw), Type::SCALAR),
        }
    }

    /// A constant quantity.
    pub(super) fn constant_at(
        &mut self,
        fields: &Fields<'a>,
        (key, raw): (&str, &'a RawValue),
        ty: Type,
    ) -> Option<f64> {
        let place = Place { owner: &fields.owner, key, raw };
        let text = self.kept(self.names.text(place, Some(ty)))?;
        if matches!(&text, Text::Expression(expression) if !expression.names().is_empty()) {
            let message = format!("{} must be a number, got an expression", place.words());
            let section = fields.owner.kind();
            let help = format!(
                "a {section} has numbers, so that parameters may call it: write the number"
            );
            self.refuse("netlist::not_a_number", message, &raw.span, help);
            return None;
        }
        match self.resolve(place, text, Wanted::constant(ty))? {
            Given::Quantity(quantity) => Some(quantity.value),
            Given::Expression(program) => program.eval::<f64>(&[], &mut Vec::new()).ok(),
        }
    }

    /// Two temperatures in K with the viscosities in m^2/s there.
    fn viscosities(&mut self, fields: &Fields<'a>) -> Option<([[f64; 2]; 2], &'a RawValue)> {
        let by_index = ["nu_40", "VI"].map(|key| fields.get(key).is_some());
        match (fields.get("viscosity"), by_index) {
            (Some(raw), [false, false]) => Some((self.points_of(fields, raw)?, raw)),
            (Some(_), _) => {
                let message = "has `viscosity` as well as `nu_40` with `VI`".to_owned();
                let keys = ["viscosity", "nu_40", "VI"].into_iter();
                let keys = keys.filter(|key| fields.get(key).is_some());
                let problem = fields.several("netlist::two_viscosities", message, keys);
                self.report(problem.help("keep one of them"));
                None
            }
            (None, [false, false]) => {
                self.require(fields, "viscosity");
                None
            }
            (None, _) => self.points_of_index(fields),
        }
    }

    fn points_of(&mut self, fields: &Fields<'a>, raw: &'a RawValue) -> Option<[[f64; 2]; 2]> {
        let pair = |raw: &'a RawValue| match &raw.kind {
            RawKind::Array(items) => <&[RawValue; 2]>::try_from(items.as_slice()).ok(),
            _ => None,
        };
        let Some([Some(first), Some(second)]) = pair(raw).map(|[a, b]| [pair(a), pair(b)]) else {
            let message = format!("{} must be two points", fields.owner.field("viscosity"));
            let help = format!(
                "write a list of two pairs of temperature and viscosity: `{}`",
                fields.sample("viscosity")
            );
            self.refuse("netlist::viscosity_points", message, &raw.span, help);
            return None;
        };
        let mut point = |[t, nu]: &'a [RawValue; 2]| {
            let t = self.constant_at(fields, ("viscosity", t), Type::ABSOLUTE_TEMPERATURE);
            let nu = self.constant_at(fields, ("viscosity", nu), VISCOSITY);
            Some([t?, nu?])
        };
        let (first, second) = (point(first), point(second));
        Some([first?, second?])
    }

    fn points_of_index(&mut self, fields: &Fields<'a>) -> Option<([[f64; 2]; 2], &'a RawValue)> {
        let (nu_40, index) = (self.require(fields, "nu_40"), self.require(fields, "VI"));
        let (nu_raw, raw) = (nu_40?, index?);
        let nu_40 = self.constant_at(fields, ("nu_40", nu_raw), VISCOSITY);
        let index = self.constant_at(fields, ("VI", raw), Type::SCALAR);
        let (nu_40, index) = (nu_40?, index?);
        let Some(nu_100) = lptn_laws::viscosity_at_100(nu_40 * 1e6, index) else {
            let message = format!(
                "no oil of {} mm^2/s at 40 degC has the viscosity index {} of {}",
                format_short(nu_40 * 1e6),
                format_short(index),
                fields.owner.words()
            );
            let help = "the index is defined for 2 mm^2/s and more at 100 degC; usual oils have 80 \
                to 250: check the unit of `nu_40`";
            self.refuse("netlist::viscosity_index", message, &raw.span, help);
            return None;
        };
        let at = |celsius: f64| ZERO_CELSIUS + celsius;
        Some(([[at(40.0), nu_40], [at(100.0), nu_100 * 1e-6]], raw))
    }

    /// The density over temperature, if there is one; `None` if it is wrong.
    fn density(&mut self, fields: &Fields<'a>) -> Option<Option<Table1>> {
        let expansion = fields.get("expansion");
        let Some(raw) = fields.get("density") else {
            let why = "belongs to a `density`, which is not given";
            self.refuse_keys(fields, &["expansion"], why);
            return Some(None);
        };
        let of_expansion = Type::of(Dimension::EXPANSION_COEFFICIENT);
        let density = self.constant_at(fields, ("density", raw), DENSITY);
        let expansion = match expansion {
            None => Some(0.0),
            Some(raw) => self.constant_at(fields, ("expansion", raw), of_expansion),
        };
        let (density, expansion) = (density?, expansion?);
        let at = |t: f64| density * (1.0 - expansion * (t - OF_DENSITY));
        let (x, y) = (vec![COLDEST, HOTTEST], vec![at(COLDEST), at(HOTTEST)]);
        if y.iter().any(|density| *density <= 0.0) {
            let message = format!("the density of {} is not more than zero", fields.owner.words());
            let help =
                format!("check the sign and the unit, for example `{}`", fields.sample("density"));
            self.refuse("network::not_positive", message, &raw.span, help);
            return None;
        }
        Table1::new(x, y, Interpolation::Linear, Outside::Error).ok().map(Some)
    }

    /// The lubricant that an element names, and the node or boundary whose temperature it has;
    /// default: the first that is heated.
    pub(crate) fn oil(&mut self, fields: &Fields<'a>, heated: Option<End>) -> Option<Oil> {
        let (name, raw) = self.word(fields, "lubricant")?;
        let at = match fields.get("at") {
            Some(_) => self.end(fields, "at").map(|(end, _)| end),
            None => heated,
        };
        if !self.knows_lubricant(name, &raw.span) {
            if !self.names.is_hidden_substance(LUBRICANT.name, name) {
                self.report(self.unknown_lubricant(fields, (name, raw)));
            }
            return None;
        }
        let at = self.builder.name(Item::from(at?)).into_owned();
        Some(Oil { name: name.to_owned(), at })
    }

    /// A property of the lubricant of an element, at its place.
    pub(crate) fn property_of_oil(
        &mut self,
        fields: &Fields<'a>,
        (property, ty): (&str, Type),
    ) -> Option<Input> {
        let Oil { name, at } = fields.oil.as_ref()?;
        let function = format!("{name}.{property}");
        if !self.builder.has_table(&function) {
            let message = format!(
                "{} needs `{property}` of lubricant `{name}`, which has none",
                fields.owner.words()
            );
            let place = fields.get("lubricant").map_or(fields.place, |raw| &raw.span);
            let help = format!("add `{}` to the lubricant", LUBRICANT.sample(property));
            self.refuse("netlist::no_property", message, place, help);
            return None;
        }
        let expression = Expression::parse(&format!("{function}({at}.T)")).ok()?;
        let program = expression.compile(&self.builder.scope(Context::Source), Some(ty)).ok()?;
        Some(program.into())
    }

    /// Adds a lubricant of the library whose functions an expression calls.
    pub(crate) fn learn_lubricants(&mut self, expression: &Expression, at: &Span) {
        for (call, _) in expression.calls() {
            if let Some((name, property)) = call.rsplit_once('.')
                && PROPERTIES.contains(&property)
            {
                self.knows_lubricant(name, at);
            }
        }
    }

    /// True if there is a lubricant of this name; one of the library is given to the builder.
    fn knows_lubricant(&mut self, name: &str, at: &Span) -> bool {
        self.used.insert((LUBRICANT.name, name.to_owned()));
        if self.builder.has_table(&format!("{name}.nu")) {
            return true;
        }
        let own = self.elements(LUBRICANT.name).iter().any(|entry| entry.key == name);
        let shipped = library::lubricant_entries().iter().find(|entry| entry.key == name);
        shipped.filter(|_| !own).is_some_and(|entry| self.lubricant(entry, at).is_some())
    }

    fn unknown_lubricant(&self, fields: &Fields<'_>, (name, raw): (&str, &RawValue)) -> Diagnostic {
        let owner = fields.owner.field("lubricant");
        let message = format!("no lubricant named `{name}`, which {owner} refers to");
        let problem = Diagnostic::error("netlist::unknown_lubricant", message)
            .at(raw.span.clone(), "neither in [lubricant] nor in the library");
        let own = self.elements(LUBRICANT.name).iter().chain(library::lubricant_entries());
        let names: Vec<&str> = own.map(|entry| entry.key.as_str()).collect();
        problem.help(match suggest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "the library has {}; your own belong below [lubricant], for example `{name} = {}`",
                lptn_data::list(&names),
                LUBRICANT.example
            ),
        })
    }
}

/// Points through which no curve of an oil goes.
fn wrong_points(fields: &Fields<'_>, points: [[f64; 2]; 2], raw: &RawValue) -> Diagnostic {
    let owner = fields.owner.words();
    let [[t0, nu0], [t1, nu1]] = points;
    let celsius = |kelvin: f64| format!("{} degC", format_short(kelvin - ZERO_CELSIUS));
    let mm = |nu: f64| format!("{} mm^2/s", format_short(nu * 1e6));
    let covered = |nu: f64| (COVERED[0]..=COVERED[1]).contains(&nu);
    let (message, help) = if t0 >= t1 {
        (
            format!("the points of {owner} go from {} to {}", celsius(t0), celsius(t1)),
            "write the colder point first".to_owned(),
        )
    } else if nu1 >= nu0 {
        (
            format!("the viscosity of {owner} does not fall: {} and then {}", mm(nu0), mm(nu1)),
            "an oil is thinner if it is warmer: exchange the two viscosities".to_owned(),
        )
    } else if !(covered(nu0) && covered(nu1)) {
        let wrong = if covered(nu0) { nu1 } else { nu0 };
        (
            format!("a viscosity of {owner} is {}", mm(wrong)),
            "ASTM D341 covers 2 mm^2/s to 2e7 mm^2/s: check the unit".to_owned(),
        )
    } else {
        (
            format!("the points of {owner} make no curve up to {}", celsius(HOTTEST)),
            "check the temperatures, and `c`, which is 0.7 or 0.8".to_owned(),
        )
    };
    Diagnostic::wrong("netlist::viscosity", message, &raw.span, help)
}
