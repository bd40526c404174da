//! Planetary stages with profile shift: sun and planets are as far apart as planets and ring.

use lptn_data::Diagnostic;
use lptn_laws::{Engagement, GearPair, Profile};
use lptn_network::Network;
use lptn_units::format_six as short;

use super::member::Member;
use super::model::Gearbox;

/// Largest difference between the distances of the two meshes in modules: shifts rounded to two
/// digits.
const ROUNDED: f64 = 0.01;

/// The two meshes of a planet, in units of one module.
pub(super) struct Shifted {
    meshes: [GearPair<f64>; 2],
    at: [Engagement; 2],
}

impl Shifted {
    /// Diameter of the planets over their tips, and twice their distance from the axis, in modules.
    pub(super) fn planets(&self) -> [f64; 2] {
        [2.0 * self.at[0].tip[1], 2.0 * self.at[0].distance]
    }
}

impl Gearbox {
    /// Its meshes, if profile shifts or a centre distance are given.
    pub(super) fn shifted(&self, network: &Network, teeth: [f64; 3]) -> Option<Shifted> {
        let given = |key: &str| {
            let id = network.parameter(&format!("{}.{key}", self.name)).ok()?;
            Some(network.parameter_value(id))
        };
        let wheels = [Member::Sun, Member::Planet, Member::Ring];
        let of = |what: &str, member: Member| given(&format!("{what}_{}", member.word()));
        let any = wheels.iter().any(|m| of("x", *m).is_some());
        if !any && given("centre_distance").is_none() {
            return None;
        }
        let module = given("module").unwrap_or(1.0);
        let mesh = |first: usize| {
            let pair = [wheels[first], wheels[first + 1]];
            GearPair {
                teeth: [teeth[first], teeth[first + 1]],
                internal: first == 1,
                module: 1.0,
                width: 1.0,
                pressure: given("pressure_angle").unwrap_or(20f64.to_radians()),
                helix: given("helix_angle").unwrap_or(0.0),
                profile: Profile {
                    shifts: pair.map(|member| of("x", member).unwrap_or(0.0)),
                    addenda: pair.map(|member| of("addendum", member)),
                    shortening: given("tip_shortening").unwrap_or(0.0),
                    distance: given("centre_distance").map(|distance| distance / module),
                },
            }
        };
        let meshes = [mesh(0), mesh(1)];
        Some(Shifted { meshes, at: meshes.map(|mesh| mesh.engagement()) })
    }

    /// Error if the two meshes need different distances of the shafts. A given distance is compared
    /// with the shifts of each mesh.
    pub(super) fn unequal(&self, of: &Shifted) -> Option<Diagnostic> {
        let [inner, outer] = of.at.map(|at| at.distance);
        if of.meshes[0].profile.distance.is_some() || (inner - outer).abs() <= ROUNDED {
            return None;
        }
        let [planet, _] = of.meshes[1].profile.shifts;
        // the shift of the ring at the distance of sun and planet
        let distance = Some(inner);
        let there = Profile { distance, ..of.meshes[1].profile };
        let sum = GearPair { profile: there, ..of.meshes[1] }.engagement().sum;
        let words = |number: f64| match number.is_nan() {
            true => "no".to_owned(),
            false => short(number),
        };
        let what = format!(
            "the shifts of sun and planet give a centre distance of {} modules, those of planet and \
             ring {}",
            words(inner),
            words(outer)
        );
        let ring = ((sum - planet) * 1e4).round() / 1e4;
        let help = match ring.is_nan() {
            true => {
                "check the signs of `shift`: that of a ring is positive towards its axis".to_owned()
            }
            false => format!("with `ring = {}` in `shift` both are equal", short(ring)),
        };
        Some(self.wrong("netlist::centre_distance", &what, &help))
    }
}
