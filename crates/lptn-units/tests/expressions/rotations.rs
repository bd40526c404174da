//! Rotations in expressions: speeds, frequencies and torques.

use lptn_units::{Dimension, Expression, Scope, Symbol, Type, Unit};

use super::common::compile;
use super::{ABSOLUTE, POWER, check_wrong};

#[test]
fn a_power_of_rad_left_over_asks_for_a_frequency_meant_as_a_speed() {
    let ask = "a power of rad is left over: is a frequency (Hz, 1/s) meant as a rotational speed?";
    let fix = |fix: &str| {
        format!("{ask} write \"{fix}\" for revolutions, or give the speed in rpm, rev/s or rad/s")
    };
    let help = |text: &str| compile(text, Some(POWER)).unwrap_err()[0].help().unwrap();
    assert_eq!(
        help("87 [uW/rpm^(5/3)] * (7000 [Hz])^(5/3)"),
        fix("87 [uW/rpm^(5/3)] * (7000 [rev/s])^(5/3)")
    );
    assert_eq!(help("1 [W s^2/rad^2] * (3000 [1/min])^2"), fix("1 [W s^2/rad^2] * (3000 [rpm])^2"));
    // the coefficient may be the one in the wrong unit
    let other = help("87 [W s^2] * omega^2");
    assert_eq!(other, format!("{ask} speeds are given in rpm, rev/s or rad/s"));
}

/// Names with the units that a CSV file gives them, whatever they are worth.
struct Columns(&'static [(&'static str, &'static str)]);

impl Scope for Columns {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = self.0.iter().position(|(known, _)| *known == name)?;
        let ty = Unit::parse(self.0[slot].1).unwrap().ty;
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        self.0.iter().map(|(name, _)| (*name).to_owned()).collect()
    }
}

const SHAFT: Columns = Columns(&[
    ("M", "N m"),
    ("E", "J"),
    ("f", "1/min"),
    ("n", "rpm"),
    ("P", "W"),
    ("r", "m"),
    ("v", "m/s"),
    ("A", "m^2"),
    ("R", "K/W"),
    ("K", "N m/rad"),
    ("c", "N m s"),
    ("T", "degC"),
    ("dt", "s"),
]);

fn of_shaft(text: &str, wanted: Dimension) -> Result<(), String> {
    let compiled = Expression::parse(text).unwrap().compile(&SHAFT, Some(Type::of(wanted)));
    compiled.map(|_| ()).map_err(|errors| errors[0].help().unwrap_or_default())
}

/// A torque is a work per radian: 20 N m at 3000 revolutions a minute are 6283 W, and 1000 W by the
/// units of 3000/min alone.
#[test]
fn a_torque_times_a_frequency_is_no_power() {
    let power = Dimension::POWER;
    for right in [
        "0.02 * n * M",
        "M * 2 * pi * n / (2 * pi)",
        "E * f",
        "0.5 * E / dt",
        "M / r * v",
        "M * v / r",
        "M * n * n / n",
        "20 [N m] * 3000 [rpm]",
        "5 [J] * 50 [Hz]",
        "20 [N m/s]",
        "pi * K * (0.1 [rad])^2 * f",
        "min(M * n, P)",
        "M / dt * dt * n",
        "P / M * M",
        "c * n * n / 1 [rad]",
    ] {
        assert_eq!(of_shaft(right, power), Ok(()), "{right}");
    }
    for (wrong, wanted) in [
        ("0.02 * f * M", power),
        ("M * f", power),
        ("0.5 * (M * 50 [Hz])", power),
        ("20 [lbf ft] * f", power),
        ("20 [kgf cm] * 50 [1/s]", power),
        ("M / dt", power),
        ("c * f * f", power),
        ("max(M * f, P)", power),
        ("P + M * f", power),
        ("if(M * f > 5 [W], P, P)", power),
        ("abs(M) * f", power),
        ("(M + E) * f", power),
        ("M * f / A", Dimension::HEAT_FLUX),
        ("M * f * R", Dimension::TEMPERATURE),
        ("M * f / P", Dimension::NONE),
    ] {
        let help = of_shaft(wrong, wanted).expect_err(wrong);
        assert!(help.contains("rpm"), "{wrong}: {help}");
    }
    // a sum of temperatures is no hiding place
    let sum = Expression::parse("T + M * f * R").unwrap();
    assert!(sum.compile(&SHAFT, Some(ABSOLUTE)).is_err());
}

/// What is offered is a speed: revolutions, or the radians that 2π has made of them.
#[test]
fn the_speed_that_is_offered_is_the_one_that_is_meant() {
    let offered = |text: &str, wanted: Dimension| {
        let help = of_shaft(text, wanted).unwrap_err();
        help.split('"').nth(1).map(str::to_owned)
    };
    let (power, speed) = (Dimension::POWER, Dimension::ANGULAR_VELOCITY);
    for (text, wanted, fix) in [
        ("0.02 * f * M", power, Some("0.02 * (f * 1 [rev]) * M")),
        ("M * 3000 [1/min]", power, Some("M * 3000 [rpm]")),
        ("2 * pi * f * M", power, Some("2 * pi * (f * 1 [rad]) * M")),
        ("2 * pi * 50 [Hz] * M", power, Some("2 * pi * (50 [Hz] * 1 [rad]) * M")),
        ("M * f * pi * (2 [m])^2 / A", power, None),
        ("M / dt", power, None),
        ("f", speed, Some("f * 1 [rev]")),
        ("2 * pi * f", speed, Some("(2 * pi * f) * 1 [rad]")),
        ("P / M", speed, Some("(P / M) * 1 [rad]")),
        ("0.5 * P / M", speed, Some("(0.5 * P / M) * 1 [rad]")),
        ("1 / dt", speed, Some("(1 / dt) * 1 [rev]")),
    ] {
        assert_eq!(offered(text, wanted).as_deref(), fix, "{text}");
        assert!(fix.is_none_or(|fix| of_shaft(fix, wanted).is_ok()), "{text}");
    }
}

#[test]
fn torques_have_a_name_and_a_unit_of_their_own() {
    assert_eq!(Type::of(Dimension::TORQUE).to_string(), "torque (N m)");
    assert_eq!(Type::of(Dimension::ENERGY).to_string(), "energy (J)");
    assert_eq!(Dimension::TORQUE, Dimension::ENERGY);
    assert_eq!(Unit::parse("lbf ft").unwrap().ty.usual_unit(), "N m");
    assert_eq!(Unit::parse("W s").unwrap().ty.usual_unit(), "J");
}

#[test]
fn errors_of_rotations_and_results() {
    let resistance = Some(Type::of(Dimension::RESISTANCE));
    let rotation = Some(Type::of(Dimension::ANGULAR_VELOCITY));
    check_wrong(&[
        (
            "omega + 50 [Hz]",
            None,
            "units::rotation",
            "50 [Hz]",
            Some("write \"omega + 50 [rev/s]\" for revolutions, or use rad/s, deg/s or rpm"),
        ),
        (
            "if(omega > 3 [kHz], 1, 2)",
            None,
            "units::rotation",
            "3 [kHz]",
            Some(
                "write \"if(omega > 3000 [rev/s], 1, 2)\" for revolutions, or use rad/s, deg/s or \
                 rpm",
            ),
        ),
        (
            "50 [1/s]",
            rotation,
            "units::rotation",
            "50 [1/s]",
            Some("write \"50 [rev/s]\" for revolutions, or use rad/s, deg/s or rpm"),
        ),
        ("P * 2", resistance, "units::dimension", "P * 2", Some("the value must come out in K/W")),
        (
            "P / (T - T_amb)",
            resistance,
            "units::dimension",
            "P / (T - T_amb)",
            Some("write \"1 / (P / (T - T_amb))\""),
        ),
        (
            "torque * omega * omega",
            Some(POWER),
            "units::dimension",
            "torque * omega * omega",
            Some("the value must come out in W"),
        ),
    ]);
}
