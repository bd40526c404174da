//! The data of a stage of gears after it is written out.

use foldhash::HashMap;
use lptn_data::Span;
use lptn_units::Type;

use super::member::{Arrangement, Member};

/// A stage of gears of a netlist, with the names of the items that it was written out as.
#[derive(Clone, Debug)]
pub struct Gearbox {
    /// Its full name.
    pub name: String,
    /// Its arrangement of members.
    pub arrangement: Arrangement,
    /// The fixed member; a pair of gears has none.
    pub held: Option<Member>,
    /// The member whose speed and torque are given.
    pub input: Member,
    /// The member at which the power leaves.
    pub output: Member,
    /// Number of planets; 1 for a pair of gears.
    pub planets: usize,
    /// True if the planets are at equal angles.
    pub even: bool,
    /// The ratio that was stated, with its place.
    pub ratio: Option<(f64, Span)>,
    /// True if a torque is given; without one its meshes lose nothing, and there are none.
    pub loaded: bool,
    /// The stage whose output drives it.
    pub driver: Option<String>,
    /// The parts that lose power in it.
    pub parts: Vec<GearboxPart>,
    /// The place of its name.
    pub span: Span,
    pub(crate) teeth: Span,
}

impl Gearbox {
    /// The name of a value of a member: `stage.sun.speed`.
    pub fn of(&self, member: Member, what: &str) -> String {
        format!("{}.{}.{what}", self.name, member.word())
    }

    /// The value to set instead of one that follows from others; `None` for other names.
    pub(crate) fn given_for(&self, name: &str) -> Option<String> {
        let rest = name.strip_prefix(self.name.as_str())?.strip_prefix('.')?;
        let (member, what) = rest.rsplit_once('.').unwrap_or(("", rest));
        let what = if what == "force" { "torque" } else { what };
        let known = self.arrangement.members().iter().any(|known| known.word() == member);
        let follows = (known && ["speed", "torque"].contains(&what)) || rest == "force";
        let given = self.driver.is_none() && member == self.input.word();
        (follows && !given).then(|| match &self.driver {
            Some(driver) => format!("the speed or torque of the input of `{driver}`"),
            None => format!("`{}`", self.of(self.input, what)),
        })
    }

    /// The two gears of the mesh with this name.
    pub(crate) fn gears_of(&self, mesh: &str) -> [&'static str; 2] {
        match self.arrangement {
            Arrangement::Pair => [Member::Pinion.word(), Member::Wheel.word()],
            Arrangement::Planetary if mesh.ends_with("sun_planet") => {
                [Member::Sun.word(), Member::Planet.word()]
            }
            Arrangement::Planetary => [Member::Planet.word(), Member::Ring.word()],
        }
    }

    /// The name of the parameter of its teeth.
    pub fn teeth_of(&self, member: Member) -> String {
        format!("{}.z_{}", self.name, member.word())
    }
}

/// A part that loses power in a gearbox: one element, or one for each planet.
#[derive(Clone, Debug)]
pub struct GearboxPart {
    /// Its name without the index of a planet.
    pub name: String,
    /// Its elements, which are sources.
    pub elements: Vec<String>,
}

/// The gearboxes of a netlist, and the types of the parameters and signals that they were written
/// out as.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gears {
    pub(crate) list: Vec<Gearbox>,
    pub(crate) types: HashMap<String, Type>,
}
