//! Checks that the wheels of a stage can be assembled.

use std::f64::consts::PI;

use lptn_data::Diagnostic;
use lptn_network::Network;
use lptn_units::format_short;

use super::member::{Arrangement, Member};
use super::model::Gearbox;

/// Allowed relative difference between a stated ratio and that of the teeth.
const RATIO_TOLERANCE: f64 = 0.01;

/// Errors about the teeth of stages, for the parameters of the network.
pub(crate) fn check(gearboxes: &[Gearbox], network: &Network) -> Vec<Diagnostic> {
    gearboxes.iter().flat_map(|gearbox| gearbox.check(network)).collect()
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
            (Arrangement::Planetary, [sun, planet, ring]) => self.planetary([*sun, *planet, *ring]),
            _ => Vec::new(),
        };
        if problems.is_empty() && self.loaded && self.arrangement == Arrangement::Planetary {
            problems.extend(self.undercut(network, teeth[2]));
        }
        if problems.is_empty() {
            problems.extend(self.stated(&teeth));
        }
        problems
    }

    fn count(&self, network: &Network, member: Member) -> Option<f64> {
        let id = network.parameter(&self.teeth_of(member)).ok()?;
        Some(network.parameter_value(id))
    }

    fn wrong(&self, code: &'static str, what: &str, help: &str) -> Diagnostic {
        let message = format!("in gearbox `{}` {what}", self.name);
        Diagnostic::wrong(code, message, &self.teeth, help)
    }

    /// Error if the tips of a ring are inside its base circle, where there is no involute.
    fn undercut(&self, network: &Network, ring: f64) -> Option<Diagnostic> {
        let angle = |key: &str, default: f64| {
            let id = network.parameter(&format!("{}.{key}", self.name));
            id.map_or(default, |id| network.parameter_value(id))
        };
        let helix = angle("helix_angle", 0.0).cos();
        let transverse = (angle("pressure_angle", PI / 9.0).tan() / helix).atan();
        let radius = 0.5 * ring / helix;
        (radius - 1.0 < radius * transverse.cos()).then(|| {
            let what = format!(
                "the tips of a ring of {} teeth lie inside its base circle",
                format_short(ring)
            );
            let help = "take more teeth, or a larger `pressure_angle`";
            self.wrong("netlist::gear_mesh", &what, help)
        })
    }

    fn planetary(&self, [sun, planet, ring]: [f64; 3]) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        let z = format_short;
        if (sun + 2.0 * planet - ring).abs() >= 1.0 {
            let fits = (ring - sun) / 2.0;
            let what = format!(
                "the wheels do not mesh: a sun of {} and planets of {} teeth need a ring of {}, not \
                 of {}",
                z(sun),
                z(planet),
                z(sun + 2.0 * planet),
                z(ring)
            );
            let help = match fits.fract() == 0.0 && fits >= 1.0 {
                true => format!(
                    "write `planet = {}`, or change `ring`; profiles are not shifted",
                    z(fits)
                ),
                false => "without shifted profiles ring = sun + 2 planet".to_owned(),
            };
            problems.push(self.wrong("netlist::gear_mesh", &what, &help));
            return problems;
        }
        #[expect(clippy::cast_precision_loss, reason = "at most 100")]
        let count = self.planets as f64;
        // tips at one module outside the pitch circle
        let room = (sun + planet) * (PI / count).sin();
        if self.planets > 1 && room <= planet + 2.0 {
            let what = format!(
                "{} planets collide: their tips reach {} modules, and there are {} from one to the \
                 next",
                self.planets,
                z(planet + 2.0),
                format_args!("{room:.1}")
            );
            let most = PI / ((planet + 2.0) / (sun + planet)).asin();
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
