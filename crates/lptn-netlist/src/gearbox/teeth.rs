//! Checks that the teeth of each mesh fit: centre distance, shifts and tips.
//!
//! A centre distance and both shifts say the same thing twice. They may differ by rounding, and the
//! shafts may be further apart for backlash. More is an error, because nothing tells which of the
//! two numbers is wrong and the loss differs by tens of percent.

use lptn_data::{Diagnostic, Span};
use lptn_laws::{Engagement, GearPair};
use lptn_network::{Field, Item, Law, Network};
use lptn_units::format_six as short;

use super::model::Gearbox;
use crate::source_map::SourceMap;

/// Centre distance below that of the shifts, in a ring above it, in modules: shifts rounded to two digits, and the
/// tolerance of a bore.
const ROUNDED: f64 = 0.01;

/// Centre distance above that of the shifts, in a ring below it, in modules. It gives a backlash of 0.07 modules, as
/// fine and plastic gears have; thinner teeth give the usual backlash at the same distance.
const BACKLASH: f64 = 0.1;

/// Allowed difference between the addenda of two gears and their sum without shift, in modules.
const USUAL: f64 = 0.005;

/// Rounding of lengths, in modules.
const EXACT: f64 = 1e-9;

/// Errors about the teeth of every mesh, for the parameters of the network.
pub(super) fn check(
    network: &Network,
    map: &SourceMap,
    (gearboxes, wrong): (&[Gearbox], &[String]),
) -> Vec<Diagnostic> {
    let sound = meshes((network, map), gearboxes)
        .filter(|mesh| mesh.stage.is_none_or(|stage| !wrong.contains(&stage.name)));
    sound.filter_map(|mesh| mesh.problem()).collect()
}

/// Warnings about meshes whose addenda indicate shifted profiles and that have no shift, and about
/// flanks that are judged without load.
pub(crate) fn doubts(network: &Network, map: &SourceMap, gearboxes: &[Gearbox]) -> Vec<Diagnostic> {
    let of_mesh = |mesh: Mesh<'_>| [mesh.doubt(), mesh.rest()].into_iter().flatten();
    meshes((network, map), gearboxes).flat_map(of_mesh).collect()
}

fn meshes<'n>(
    of: (&'n Network, &'n SourceMap),
    gearboxes: &'n [Gearbox],
) -> impl Iterator<Item = Mesh<'n>> {
    let sources = of.0.source_ids().map(Item::Source);
    sources.filter_map(move |item| Mesh::of(of, item, gearboxes))
}

/// A mesh whose dimensions are constant.
struct Mesh<'n> {
    item: Item,
    name: String,
    /// The gearbox that made it.
    stage: Option<&'n Gearbox>,
    map: &'n SourceMap,
    pair: GearPair<f64>,
    at: Engagement,
    /// Names of its two gears.
    gears: [&'static str; 2],
    /// The key that is 0 in a mesh with `scuffing`, so that its flanks carry no load or rest.
    idle: Option<&'static str>,
}

impl<'n> Mesh<'n> {
    fn of(
        (network, map): (&Network, &'n SourceMap),
        item: Item,
        gearboxes: &'n [Gearbox],
    ) -> Option<Self> {
        let law = network.law(item)?;
        law.value("z1").and(law.value("centre_distance"))?;
        let values = constants(network, law);
        let pair = law.formula().gears(&values)?;
        let zero =
            |key: &&str| law.parts().zip(&values).any(|((f, _), v)| f.key() == *key && *v == 0.0);
        let idle = law.value("scuffing").and_then(|_| ["torque", "speed"].into_iter().find(zero));
        let name = network.name_of(item).to_string();
        let made = gearboxes.iter().find_map(|stage| {
            let part = stage.parts.iter().find(|part| part.elements.contains(&name))?;
            Some((stage, part))
        });
        // planets are alike: the first of them is enough
        if made.is_some_and(|(_, part)| part.elements.first() != Some(&name)) {
            return None;
        }
        if !is_constant(&pair) {
            return None;
        }
        let at = pair.engagement();
        let gears = match made {
            Some((stage, part)) => stage.gears_of(&part.name),
            None if pair.internal => ["pinion", "ring"],
            None => ["pinion", "wheel"],
        };
        Some(Self { item, name, stage: made.map(|(stage, _)| stage), map, pair, at, gears, idle })
    }

    fn problem(&self) -> Option<Diagnostic> {
        self.apart().or_else(|| self.disagreement()).or_else(|| self.tips())
    }

    fn is_written(&self, key: &str) -> bool {
        Field::of_law(key).is_some_and(|field| self.map.get(self.item, field).is_some())
    }

    /// The place of the first of these keys that is written, else the name.
    fn place(&self, keys: &[&str]) -> Option<Span> {
        let place = |key: &&str| self.map.get(self.item, Field::of_law(key)?);
        keys.iter().find_map(place).or_else(|| self.map.name(self.item))
    }

    fn wrong(
        &self,
        code: &'static str,
        keys: &[&str],
        message: String,
        help: String,
    ) -> Diagnostic {
        Diagnostic::error(code, message).at(self.place(keys), "").help(help)
    }

    /// `x_2 = 0.17`, or `planet = 0.17` in `shift`.
    fn remedy(&self, key: &str, gear: usize, value: f64) -> String {
        let (value, table) = (short(value), if key == "x" { "shift" } else { key });
        match self.stage {
            Some(_) => format!("`{} = {value}` in `{table}`", self.gears[gear]),
            None => format!("`{key}_{} = {value}`", gear + 1),
        }
    }

    /// Warning if the addenda do not sum to 2 modules, and no shift says why.
    fn doubt(&self) -> Option<Diagnostic> {
        let profile = &self.pair.profile;
        let is_given = ["x_1", "x_2", "centre_distance"].iter().any(|key| self.is_written(key));
        let addenda = profile.addenda.map(|addendum| addendum.unwrap_or(1.0));
        let sum = addenda[0] + addenda[1];
        // the teeth of a ring are often made shorter, without a shift
        let usual = (sum - 2.0).abs() <= USUAL || self.pair.internal && sum < 2.0;
        if is_given || usual || profile.shortening != 0.0 {
            return None;
        }
        let message = format!(
            "the addenda of mesh `{}` sum to {} modules and no profile shift is given: its loss is \
             that at the reference centre distance",
            self.name,
            short(sum)
        );
        let [first, second] = [0, 1].map(|gear| self.remedy("x", gear, addenda[gear] - 1.0));
        let help = format!(
            "if they come from shifts, add {first} and {second}; if not, {} says so",
            self.remedy("x", 0, 0.0)
        );
        let warning = Diagnostic::warning("netlist::profile_shift", message);
        Some(warning.at(self.place(&["addendum_1", "addendum_2"]), "").help(help))
    }

    /// Warning if the flanks are to be judged without load or motion.
    fn rest(&self) -> Option<Diagnostic> {
        let key = self.idle?;
        let message = format!(
            "the {key} of mesh `{}` is 0: without load its flanks have no flash temperature, and \
             its scuffing is not judged",
            self.name
        );
        let help = format!("give the {key} at which they may scuff, or remove `scuffing`");
        let warning = Diagnostic::warning("netlist::scuffing_idle", message);
        Some(warning.at(self.place(&[key]), "").help(help))
    }

    /// Error if there is no working pressure angle.
    fn apart(&self) -> Option<Diagnostic> {
        let (pair, code) = (&self.pair, "netlist::centre_distance");
        let usual = GearPair { profile: lptn_laws::Profile::standard(), ..*pair }.engagement();
        if let Some(distance) = pair.profile.distance {
            let least = usual.distance * usual.angle.cos();
            return (distance <= least).then(|| {
                let message = format!(
                    "the shafts of mesh `{}` are {} apart, and its base circles touch at {}",
                    self.name,
                    mm(distance),
                    mm(least)
                );
                let help = format!(
                    "without profile shift the distance is `centre_distance = \"{}\"`",
                    mm(usual.distance)
                );
                self.wrong(code, &["centre_distance"], message, help)
            });
        }
        self.at.free.is_nan().then(|| {
            let [x1, x2] = pair.profile.shifts;
            let inv = usual.angle.tan() - usual.angle;
            let [z1, z2] = pair.teeth;
            let (less, joined) =
                if pair.internal { ("below", z2 - z1) } else { ("above", -z1 - z2) };
            let bound = 0.5 * inv * joined / pair.pressure.tan();
            let message = format!(
                "the shifts of mesh `{}` sum to {}: at no distance of the shafts do its teeth mesh",
                self.name,
                short(x1 + x2)
            );
            let help = format!("the sum has to be {less} {}: check their signs", short(bound));
            self.wrong(code, &["x_1", "x_2"], message, help)
        })
    }

    /// Error if centre distance and shifts contradict each other.
    fn disagreement(&self) -> Option<Diagnostic> {
        let profile = &self.pair.profile;
        let distance = profile.distance?;
        let written = [self.is_written("x_1"), self.is_written("x_2")];
        let [x1, x2] = profile.shifts;
        let tips = profile.addenda[0].is_some() && profile.addenda[1].is_some();
        // a ring has backlash if the shafts are closer
        let side = if self.pair.internal { -1.0 } else { 1.0 };
        let further = side * (distance - self.at.free) / self.pair.module;
        if tips && written == [false; 2] || (-ROUNDED..=BACKLASH).contains(&further) {
            return None;
        }
        let sum = round(self.at.sum, 1e4);
        let keys = ["centre_distance", "x_1", "x_2"];
        let (message, help) = match written {
            [false, false] => (
                format!(
                    "the shafts of mesh `{}` are {} apart, and its profile shifts are not given",
                    self.name,
                    mm(distance)
                ),
                format!(
                    "the shifts sum to {}: give {} from the drawing, or both addenda",
                    short(sum),
                    self.both_shifts()
                ),
            ),
            [true, false] => (self.half(0), format!("add {}", self.remedy("x", 1, sum - x1))),
            [false, true] => (self.half(1), format!("add {}", self.remedy("x", 0, sum - x2))),
            [true, true] => (
                format!(
                    "the shafts of mesh `{}` are {} apart, and its shifts of {} and {} give {}",
                    self.name,
                    mm(distance),
                    short(x1),
                    short(x2),
                    mm(self.at.free)
                ),
                format!(
                    "write `centre_distance = \"{}\"`, or shifts that sum to {}",
                    mm(self.at.free),
                    short(sum)
                ),
            ),
        };
        Some(self.wrong("netlist::centre_distance", &keys, message, help))
    }

    fn both_shifts(&self) -> String {
        match self.stage {
            Some(_) => format!("`{}` and `{}` in `shift`", self.gears[0], self.gears[1]),
            None => "`x_1` and `x_2`".to_owned(),
        }
    }

    fn half(&self, given: usize) -> String {
        format!(
            "mesh `{}` has a centre distance and the profile shift of its {}, and not of its {}",
            self.name,
            self.gears[given],
            self.gears[1 - given]
        )
    }

    /// Error about the tips of a gear.
    fn unfit(&self, gear: usize, what: &str, help: String) -> Option<Diagnostic> {
        let [own, other] =
            [gear + 1, 2 - gear].map(|n| [format!("addendum_{n}"), format!("x_{n}")]);
        let keys: Vec<&str> = own.iter().chain(&other).map(String::as_str).collect();
        let message =
            format!("the tips of the {} of mesh `{}` {what}", self.gears[gear], self.name);
        Some(self.wrong("netlist::gear_contact", &keys, message, help))
    }

    /// Error if tips do not fit.
    fn tips(&self) -> Option<Diagnostic> {
        let below = |length: f64| length < -EXACT * self.pair.module;
        for gear in 0..2 {
            let length = self.at.tip[gear] - self.at.base[gear];
            if below(length) {
                let what = format!(
                    "are {} inside its base circle, in which no involute exists",
                    mm(-length)
                );
                let help = match self.pair.internal && gear == 1 {
                    true => self.longest(gear),
                    false => "give longer addenda, or more profile shift".to_owned(),
                };
                return self.unfit(gear, &what, help);
            }
        }
        // the tip of each gear against the flank of the other
        for (gear, length) in [(1, self.at.curvature[0]), (0, self.at.curvature[1])] {
            if below(length) {
                let other = self.gears[1 - gear];
                let what =
                    format!("reach {} past the end of the involute of the {other}", mm(-length));
                return self.unfit(gear, &what, self.longest(gear));
            }
        }
        self.pointed().or_else(|| self.short_path())
    }

    /// Error if teeth are pointed below their tips. Their thickness is known if their shift is.
    fn pointed(&self) -> Option<Diagnostic> {
        let known = |gear: &usize| {
            let key = if *gear == 0 { "x_1" } else { "x_2" };
            self.pair.profile.addenda[*gear].is_none() || self.is_written(key)
        };
        let gear = (0..2).filter(known).find(|gear| self.at.thickness[*gear] < 0.0)?;
        let help = "give a smaller shift, or a shorter addendum".to_owned();
        self.unfit(gear, "are beyond the point at which the flanks of a tooth meet", help)
    }

    /// The largest addendum that meets the involute of the other gear.
    fn longest(&self, gear: usize) -> String {
        let inner = self.pair.internal && gear == 1;
        let radius = 0.5 * self.pair.module / self.pair.helix.cos() * self.pair.teeth[gear];
        let line = self.at.distance * self.at.angle.sin();
        let tip = (self.at.base[gear].powi(2) + line * line).sqrt();
        let longest = (if inner { radius - tip } else { tip - radius }) / self.pair.module;
        let most = (longest * 1e3).floor() * 1e-3;
        if most <= 0.0 {
            return format!("take more teeth for the {}, or another shift", self.gears[1 - gear]);
        }
        let other = self.gears[1 - gear];
        let written = self.remedy("addendum", gear, most);
        format!("write at most {written}, or give the {other} more profile shift")
    }

    /// Error if the path of contact ends before the pitch point or before the next pair of teeth.
    fn short_path(&self) -> Option<Diagnostic> {
        let [e1, e2] = self.at.contact;
        if let Some(gear) = self.at.contact.iter().position(|ratio| *ratio < -EXACT) {
            let what =
                "do not reach the pitch point, and the loss factor is known for tips that do";
            let help = "give longer addenda, or shifts that differ less".to_owned();
            return self.unfit(gear, what, help);
        }
        let ratio = e1 + e2 + self.at.overlap;
        (ratio < 1.0 - EXACT).then(|| {
            let message = format!(
                "the contact ratio of mesh `{}` is {}: teeth part before the next ones meet",
                self.name,
                short(round(ratio, 1e3))
            );
            let help =
                "give longer addenda, less profile shift or a smaller centre distance; 1 is \
                the least"
                    .to_owned();
            let keys = ["addendum_1", "addendum_2", "x_1", "x_2", "centre_distance"];
            self.wrong("netlist::gear_contact", &keys, message, help)
        })
    }
}

/// True if no dimension changes with time or temperature.
fn is_constant(pair: &GearPair<f64>) -> bool {
    let profile = &pair.profile;
    let sizes = [pair.module, pair.width, pair.pressure, pair.helix, profile.shortening];
    let given = profile.addenda.iter().flatten().chain(&profile.distance);
    let mut all = sizes.iter().chain(&pair.teeth).chain(&profile.shifts).chain(given);
    all.all(|size| !size.is_nan())
}

/// The constant values of a law; NaN for others.
fn constants(network: &Network, law: &Law) -> Vec<f64> {
    let mut scope = network.evaluation();
    let mut number = |value| {
        let constant = network.is_constant(value).then(|| value.at(&mut scope).ok());
        constant.flatten().unwrap_or(f64::NAN)
    };
    law.values().iter().map(&mut number).collect()
}

fn round(value: f64, parts: f64) -> f64 {
    // without a negative zero
    (value * parts).round() / parts + 0.0
}

/// A length in mm to 1 um, from m.
fn mm(length: f64) -> String {
    format!("{} mm", short(round(1e3 * length, 1e3)))
}
