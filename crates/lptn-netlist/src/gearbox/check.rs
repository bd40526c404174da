//! Checks that the wheels of a stage can be assembled.

use std::f64::consts::PI;

use lptn_data::Diagnostic;
use lptn_network::Network;
use lptn_units::format_short;

use super::member::{Arrangement, Member};
use super::model::Gearbox;
use super::teeth;
use crate::source_map::SourceMap;

/// Allowed relative difference between a stated ratio and that of the teeth.
const RATIO_TOLERANCE: f64 = 0.01;

/// Errors about the teeth of stages and of every mesh, for the parameters of the network.
pub(crate) fn check(gearboxes: &[Gearbox], network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let (mut problems, mut wrong) = (Vec::new(), Vec::new());
    for gearbox in gearboxes {
        let found = gearbox.check(network);
        if !found.is_empty() {
            wrong.push(gearbox.name.clone());
        }
        problems.extend(found);
    }
    problems.extend(teeth::check(network, map, (gearboxes, &wrong)));
    problems
}

impl Gearbox {
    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let wheels = self.arrangement.wheels();
        let teeth: Option<Vec<f64>> = wheels.iter().map(|m| self.count(network, *m)).collect();
        let Some(teeth) = teeth else { return Vec::new() };
        let whole = teeth.iter().zip(wheels).find(|(z, _)| z.fract() != 0.0 || **z < 1.0);
        if let Some((z, member)) = whole {
            let what = format!("the {} has {} teeth", member.word(), format_short(*z));
            return vec![self.wrong("netlist::gear_teeth", &what, "write a whole number from 1")];
        }
        let mut problems = match (self.arrangement, teeth.as_slice()) {
            (Arrangement::Planetary, [sun, planet, ring]) => {
                self.planetary(network, [*sun, *planet, *ring])
            }
            _ => Vec::new(),
        };
        if problems.is_empty() {
            problems.extend(self.stated(&teeth));
        }
        problems
    }

    fn count(&self, network: &Network, member: Member) -> Option<f64> {
        let id = network.parameter(&self.teeth_of(member)).ok()?;
        Some(network.parameter_value(id))
    }

    pub(super) fn wrong(&self, code: &'static str, what: &str, help: &str) -> Diagnostic {
        let message = format!("in gearbox `{}` {what}", self.name);
        Diagnostic::wrong(code, message, &self.teeth, help)
    }

    fn planetary(&self, network: &Network, teeth: [f64; 3]) -> Vec<Diagnostic> {
        let [sun, planet, ring] = teeth;
        let shifted = self.shifted(network, teeth);
        let apart = match &shifted {
            Some(shifted) => self.unequal(shifted),
            None => self.unshifted(teeth),
        };
        if let Some(problem) = apart {
            return vec![problem];
        }
        let mut problems = Vec::new();
        let z = format_short;
        #[expect(clippy::cast_precision_loss, reason = "at most 100")]
        let count = self.planets as f64;
        // diameter over the tips, without shift one module outside the pitch circle
        let [tips, between] =
            shifted.map_or([planet + 2.0, sun + planet], |shifted| shifted.planets());
        let room = between * (PI / count).sin();
        if self.planets > 1 && room <= tips {
            let what = format!(
                "{} planets collide: their tips reach {} modules, and there are {} from one to the \
                 next",
                self.planets,
                z((tips * 1e3).round() / 1e3),
                format_args!("{room:.1}")
            );
            let most = PI / (tips / between).asin();
            let help =
                format!("at most {} planets of these sizes fit around the sun", most.floor());
            problems.push(self.wrong("netlist::planets_collide", &what, &help));
        }
        if self.even && ((sun + ring) / count).fract() != 0.0 {
            let what = format!(
                "{} planets at equal angles do not mesh: {} teeth of sun and ring are not a \
                 multiple of {}",
                self.planets,
                z(sun + ring),
                self.planets
            );
            let help = "change the teeth or the number of planets, or write `spacing = \"uneven\"`";
            problems.push(self.wrong("netlist::planet_spacing", &what, help));
        }
        problems
    }

    /// Error if wheels without shift do not mesh.
    fn unshifted(&self, [sun, planet, ring]: [f64; 3]) -> Option<Diagnostic> {
        if (sun + 2.0 * planet - ring).abs() < 1.0 {
            return None;
        }
        let (fits, z) = ((ring - sun) / 2.0, format_short);
        let what = format!(
            "the wheels do not mesh: a sun of {} and planets of {} teeth need a ring of {}, not of \
             {}",
            z(sun),
            z(planet),
            z(sun + 2.0 * planet),
            z(ring)
        );
        let help = match fits.fract() == 0.0 && fits >= 1.0 {
            true => format!("write `planet = {}`, or give the profile shifts in `shift`", z(fits)),
            false => {
                "without profile shift ring = sun + 2 planet: give the shifts in `shift`".to_owned()
            }
        };
        Some(self.wrong("netlist::gear_mesh", &what, &help))
    }

    /// Error if a stated ratio is not that of the teeth.
    fn stated(&self, teeth: &[f64]) -> Option<Diagnostic> {
        let (stated, span) = self.ratio.as_ref()?;
        let ratio = self.ratio_of(teeth);
        // without a sign only its size is stated
        let turned = *stated < 0.0 && ratio > 0.0;
        if (stated.abs() / ratio.abs() - 1.0).abs() <= RATIO_TOLERANCE && !turned {
            return None;
        }
        let message = format!(
            "gearbox `{}` states a ratio of {}, and its teeth give {}",
            self.name,
            format_short(*stated),
            format_args!("{ratio:.4}")
        );
        let help = "the ratio is the speed of the input over that of the output: check `teeth`, \
            `held` and `input`; it may be left out";
        Some(Diagnostic::wrong("netlist::gear_ratio", message, span, help))
    }

    /// Speed of the input over that of the output, from the teeth of its wheels in their order.
    fn ratio_of(&self, teeth: &[f64]) -> f64 {
        let weight = |member: Member| {
            let z = |wheel: Member| {
                let at = self.arrangement.wheels().iter().position(|known| *known == wheel);
                at.map_or(f64::NAN, |at| teeth[at])
            };
            match member {
                Member::Carrier => -(z(Member::Sun) + z(Member::Ring)),
                wheel => z(wheel),
            }
        };
        -weight(self.output) / weight(self.input)
    }
}
