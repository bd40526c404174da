//! Writes a stage out: teeth and sizes as parameters, speeds and torques, meshes.

use lptn_data::{Diagnostic, Span};
use lptn_units::{Dimension, Expression, Type};

use super::declaration::OF_WHEELS;
use super::member::{Arrangement, Member, weight};
use super::model::{Gearbox, GearboxPart};
use super::stage::{Heated, Stage};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::template::Structure;

/// Sizes of the meshes that become parameters, with the type of each.
pub(super) const SIZES: [(&str, Dimension); 8] = [
    ("module", Dimension::LENGTH),
    ("width", Dimension::LENGTH),
    ("Ra", Dimension::LENGTH),
    ("X_L", Dimension::NONE),
    ("pressure_angle", Dimension::ANGLE),
    ("helix_angle", Dimension::ANGLE),
    ("tip_shortening", Dimension::NONE),
    ("centre_distance", Dimension::LENGTH),
];

/// The keys that the friction of a mesh needs.
const NEEDED: [&str; 4] = ["module", "width", "Ra", "lubricant"];

/// The parts of a stage that was written out.
pub(super) struct Made {
    pub(super) gearbox: Gearbox,
    /// Entries with their sections.
    pub(super) entries: Vec<(&'static str, RawEntry)>,
    /// The types that its parameters and signals have to have.
    pub(super) types: Vec<(String, Type)>,
    /// Kinds of its speeds and torques: parameters, or signals if the input is one.
    speed: ValueKind,
    torque: Option<ValueKind>,
}

/// Writes entries, each at a place of the block.
pub(super) struct Writer<'s, 'r> {
    pub(super) stage: &'s Stage<'r>,
    /// Its name in expressions next to it: without the path of the instance that contains it.
    pub(super) here: String,
    pub(super) made: Made,
}

impl Made {
    /// Writes out a stage, after the one that drives it.
    pub(super) fn of(
        (stage, driver): (&Stage<'_>, Option<&Made>),
        raw: &RawNetlist,
        structure: &Structure,
        problems: &mut Vec<Diagnostic>,
    ) -> Self {
        let name = stage.entry.key.clone();
        let around = structure.instance_at(&stage.entry.key_span);
        let here = around.and_then(|path| name.strip_prefix(path)?.strip_prefix('.'));
        let here = here.unwrap_or(&name).to_owned();
        let kind_of = |key: &str| stage.fields.get(key).map(|value| kind_of(value, raw, structure));
        let (speed, torque) = match driver {
            Some(driver) => (driver.speed, driver.torque),
            None => (kind_of("speed").unwrap_or(ValueKind::Parameter), kind_of("torque")),
        };
        let made = Self {
            gearbox: gearbox(stage, driver, torque.is_some()),
            entries: Vec::new(),
            types: Vec::new(),
            speed,
            torque,
        };
        let mut writer = Writer { stage, here, made };
        writer.teeth();
        writer.speeds(driver);
        writer.torques(driver);
        writer.meshes(problems);
        writer.parts(problems);
        writer.made
    }
}

fn gearbox(stage: &Stage<'_>, driver: Option<&Made>, loaded: bool) -> Gearbox {
    let teeth = stage.fields.key("teeth").unwrap_or(stage.fields.place);
    Gearbox {
        name: stage.entry.key.clone(),
        arrangement: stage.arrangement,
        held: stage.held,
        input: stage.input,
        output: stage.output,
        planets: stage.planets,
        even: stage.even,
        ratio: stage.ratio.clone(),
        loaded,
        driver: driver.map(|driver| driver.gearbox.name.clone()),
        parts: Vec::new(),
        span: stage.entry.key_span.clone(),
        teeth: teeth.clone(),
    }
}

/// A value that is a quantity or follows from parameters is one; else it is a signal.
fn kind_of(value: &RawValue, raw: &RawNetlist, structure: &Structure) -> ValueKind {
    let RawKind::String { text, .. } = &value.kind else { return ValueKind::Parameter };
    let parameters = raw.elements(ValueKind::Parameter.section());
    let is_parameter = |name: &str| {
        let full = structure.resolve(&value.span, name);
        full == "pi" || parameters.iter().any(|entry| entry.key == full)
    };
    match Expression::parse(text) {
        Ok(expression) if !expression.names().iter().all(|(name, _)| is_parameter(name)) => {
            ValueKind::Signal
        }
        _ => ValueKind::Parameter,
    }
}

impl Writer<'_, '_> {
    fn at(&self) -> &Span {
        &self.stage.entry.key_span
    }

    /// The name of a value of a member in expressions next to the block.
    pub(super) fn name(&self, member: Member, what: &str) -> String {
        format!("{}.{}.{what}", self.here, member.word())
    }

    fn z(&self, member: Member) -> String {
        format!("{}.z_{}", self.here, member.word())
    }

    /// A parameter or signal `stage.NAME`, and its type.
    fn value(&mut self, kind: ValueKind, name: &str, value: RawValue, ty: Type) {
        let key = format!("{}.{name}", self.stage.entry.key);
        self.made.types.push((key.clone(), ty));
        self.made.entries.push((kind.section(), RawEntry::new(&key, value)));
    }

    fn teeth(&mut self) {
        let (stage, z) = (self.stage, [("z", &self.stage.teeth)]);
        let tables = OF_WHEELS.iter().zip(&stage.profile).map(|((_, name), table)| (*name, table));
        for (what, table) in z.into_iter().chain(tables) {
            for (member, written) in table {
                let name = format!("{what}_{}", member.word());
                let value = written.value.clone();
                self.value(ValueKind::Parameter, &name, value, Type::SCALAR);
            }
        }
    }

    /// The speed of every member; that of a planet is against the carrier.
    fn speeds(&mut self, driver: Option<&Made>) {
        let (stage, kind) = (self.stage, self.made.speed);
        let ty = Type::of(Dimension::ANGULAR_VELOCITY);
        let input = self.name(stage.input, "speed");
        for member in stage.arrangement.shafts() {
            let value = match (driver, stage.fields.get("speed")) {
                _ if Some(*member) == stage.held => RawValue::text("0 rpm".to_owned(), self.at()),
                (Some(driver), _) if *member == stage.input => {
                    let from = &driver.gearbox;
                    RawValue::text(self.beside(&from.of(from.output, "speed")), self.at())
                }
                (None, Some(raw)) if *member == stage.input => raw.clone(),
                _ => {
                    let (sign, factor) = self.quotient(stage.input, *member);
                    RawValue::text(format!("{sign}{input}{factor}"), self.at())
                }
            };
            self.value(kind, &format!("{}.speed", member.word()), value, ty);
        }
        if stage.arrangement == Arrangement::Planetary {
            let [sun, carrier] = [Member::Sun, Member::Carrier].map(|m| self.name(m, "speed"));
            let [z_sun, z_planet] = [Member::Sun, Member::Planet].map(|member| self.z(member));
            let value = format!("-({sun} - {carrier}) * {z_sun} / {z_planet}");
            let value = RawValue::text(value, self.at());
            self.value(kind, "planet.speed", value, ty);
        }
    }

    /// The torque that acts on every member from outside, without losses, and the force in a mesh.
    fn torques(&mut self, driver: Option<&Made>) {
        let (stage, Some(kind)) = (self.stage, self.made.torque) else { return };
        let input = self.name(stage.input, "torque");
        for member in stage.arrangement.shafts() {
            let value = match (driver, stage.fields.get("torque")) {
                (Some(driver), _) if *member == stage.input => {
                    let from = &driver.gearbox;
                    RawValue::text(
                        format!("-{}", self.beside(&from.of(from.output, "torque"))),
                        self.at(),
                    )
                }
                (None, Some(raw)) if *member == stage.input => raw.clone(),
                _ => {
                    let (sign, factor) = self.quotient(*member, stage.input);
                    // with the sign of the member's weight, not against it
                    let sign = if sign.is_empty() { "-" } else { "" };
                    RawValue::text(format!("{sign}{input}{factor}"), self.at())
                }
            };
            let name = format!("{}.torque", member.word());
            self.value(kind, &name, value, Type::of(Dimension::TORQUE));
        }
        if stage.fields.get("module").is_some() {
            let (first, here) = (stage.arrangement.wheels()[0], &self.here);
            let torque = self.name(first, "torque");
            let helix = match stage.fields.get("helix_angle") {
                Some(_) => format!(" * cos({here}.helix_angle)"),
                None => String::new(),
            };
            let value = format!(
                "2 * abs({torque}){helix} / ({} * {} * {here}.module)",
                stage.planets,
                self.z(first)
            );
            let value = RawValue::text(value, self.at());
            self.value(kind, "force", value, Type::of(Dimension::FORCE));
        }
    }

    /// A full name as expressions next to the block write it.
    fn beside(&self, full: &str) -> String {
        let prefix = self.stage.entry.key.strip_suffix(self.here.as_str()).unwrap_or("");
        full.strip_prefix(prefix).unwrap_or(full).to_owned()
    }

    /// `-` or nothing, and ` * w_a / w_b`: minus the quotient of the weights of two members.
    fn quotient(&self, a: Member, b: Member) -> (&'static str, String) {
        let weights = [a, b].map(|member| weight(member, |wheel| self.z(wheel)));
        let [(a_negative, a), (b_negative, b)] = weights;
        (if a_negative == b_negative { "-" } else { "" }, format!(" * {a} / {b}"))
    }

    /// A mesh of each planet with sun and ring, or that of a pair; none without a torque.
    fn meshes(&mut self, problems: &mut Vec<Diagnostic>) {
        let stage = self.stage;
        for (key, dimension) in SIZES {
            if let Some(raw) = stage.fields.get(key) {
                self.value(ValueKind::Parameter, key, raw.clone(), Type::of(dimension));
            }
        }
        if self.made.torque.is_none() {
            return self.useless_without_torque(problems);
        }
        let needed = NEEDED.map(|key| stage.fields.require(key, problems).is_some());
        if needed.contains(&false) {
            return;
        }
        let wheels: Vec<Member> = stage.arrangement.wheels().to_vec();
        for pair in wheels.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let name = match stage.arrangement {
                Arrangement::Planetary => format!("{}_{}", a.word(), b.word()),
                Arrangement::Pair => "mesh".to_owned(),
            };
            let Some(into) = self.halves([a, b], problems) else { continue };
            let table = self.mesh([a, b], into);
            self.part(("mesh", &name), stage.arrangement == Arrangement::Planetary, &table);
        }
    }

    /// Reports sizes of meshes that have no effect because the meshes lose nothing.
    fn useless_without_torque(&self, problems: &mut Vec<Diagnostic>) {
        for key in SIZES.map(|(key, _)| key).into_iter().chain(["addendum", "scuffing"]) {
            if let Some(span) = self.stage.fields.key(key) {
                let owner = self.stage.fields.owner.field(key);
                let message =
                    format!("{owner} is about meshes, which lose nothing without a torque");
                let help =
                    format!("add `{}`, or remove `{key}`", self.stage.fields.sample("torque"));
                problems.push(Diagnostic::wrong("netlist::useless_key", message, span, help));
            }
        }
    }

    /// The nodes that a mesh heats: half for each of its members, unless the stage heats one node.
    fn halves(&self, pair: [Member; 2], problems: &mut Vec<Diagnostic>) -> Option<RawValue> {
        if let Heated::One(raw) = self.stage.into {
            return Some(raw.clone());
        }
        let nodes = pair.map(|member| (member, self.stage.node_of(member)));
        let mut names = Vec::new();
        for (member, node) in nodes {
            match node.map(|raw| (&raw.kind, raw)) {
                Some((RawKind::String { text, .. }, raw)) => names.push((text.clone(), raw)),
                Some((_, raw)) => {
                    problems.push(self.stage.fields.wrong_shape("into", raw, "a name of a node"));
                }
                None => problems.push(self.no_node(member)),
            }
        }
        let [(a, raw), (b, second)] = <[_; 2]>::try_from(names).ok()?;
        if a == b {
            return Some(raw.clone());
        }
        let share = |at: &Span| RawValue { span: at.clone(), kind: RawKind::Float("0.5".into()) };
        let entries = [(a, raw), (b, second)];
        let entries = entries.map(|(name, raw)| RawEntry::new(&name, share(&raw.span)));
        let table = RawTable { span: raw.span.clone(), entries: entries.into() };
        Some(RawValue { span: raw.span.clone(), kind: RawKind::Table(table) })
    }

    /// Error for a member without a node to heat.
    pub(super) fn no_node(&self, member: Member) -> Diagnostic {
        let fields = &self.stage.fields;
        let message = format!("{} has no `{}`", fields.owner.field("into"), member.word());
        let at = fields.get("into").map_or(fields.place, |raw| &raw.span);
        let help = format!("add the node that it heats: `{} = \"name of a node\"`", member.word());
        Diagnostic::wrong("netlist::missing_field", message, at, help)
    }

    /// The speed of a wheel is that against the carrier, and each planet carries its part of the
    /// torque.
    fn mesh(&self, [a, b]: [Member; 2], into: RawValue) -> Vec<RawEntry> {
        let (stage, here, at) = (self.stage, &self.here, self.at());
        let speed = |member: Member| self.name(member, "speed");
        let torque = |member: Member| self.name(member, "torque");
        let (speed, torque) = match a {
            Member::Sun => {
                let speed = format!("{} - {}", speed(a), speed(Member::Carrier));
                (speed, format!("{} / {}", torque(a), stage.planets))
            }
            Member::Planet => {
                let [z_sun, z_planet] = [Member::Sun, a].map(|member| self.z(member));
                let torque = format!("{} / {}", torque(Member::Sun), stage.planets);
                (speed(a), format!("{torque} * {z_planet} / {z_sun}"))
            }
            _ => (speed(a), torque(a)),
        };
        let model = if b == Member::Ring { "internal" } else { "external" };
        let mut table = vec![
            RawEntry::new("into", into),
            RawEntry::new("speed", RawValue::text(speed, at)),
            RawEntry::new("torque", RawValue::text(torque, at)),
            RawEntry::new("z1", RawValue::text(self.z(a), at)),
            RawEntry::new("z2", RawValue::text(self.z(b), at)),
            RawEntry::new("model", RawValue::text(model.to_owned(), at)),
        ];
        let sizes = SIZES.iter().filter(|(key, _)| stage.fields.get(key).is_some());
        table.extend(
            sizes.map(|(key, _)| RawEntry::new(key, RawValue::text(format!("{here}.{key}"), at))),
        );
        for ((_, what), given) in OF_WHEELS.iter().zip(&stage.profile) {
            for (number, member) in [a, b].into_iter().enumerate() {
                let Some((_, written)) = given.iter().find(|(known, _)| *known == member) else {
                    continue;
                };
                let name = format!("{here}.{what}_{}", member.word());
                let value = RawValue::text(name, &written.value.span);
                table.push(RawEntry::new(&format!("{what}_{}", number + 1), value));
            }
        }
        let oil = ["lubricant", "at", "scuffing"].into_iter();
        let oil = oil.filter_map(|key| stage.fields.entry(key));
        table.extend(oil.cloned());
        table
    }

    /// One element, or one for each planet.
    pub(super) fn part(
        &mut self,
        (section, name): (&'static str, &str),
        each_planet: bool,
        table: &[RawEntry],
    ) {
        let (name, at) = (format!("{}.{name}", self.stage.entry.key), self.at().clone());
        let elements: Vec<String> = match each_planet {
            true => (1..=self.stage.planets).map(|number| format!("{name}[{number}]")).collect(),
            false => vec![name.clone()],
        };
        for element in &elements {
            let kind = RawKind::Table(RawTable { span: at.clone(), entries: table.to_vec() });
            let entry = RawEntry::new(element, RawValue { span: at.clone(), kind });
            self.made.entries.push((section, entry));
        }
        self.made.gearbox.parts.push(GearboxPart { name, elements });
    }
}
