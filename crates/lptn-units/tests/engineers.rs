//! Units as engineers write them: each is read rightly, or refused with a text that is right.
//!
//! Reference: SI values by hand, from NIST Special Publication 811 (2008), appendix B.

use lptn_units::{parse_quantity, parse_value};

/// A text, and the same quantity in SI units.
const WRITTEN: &[(&str, &str)] = &[
    ("10 cc", "1e-5 m^3"),
    ("10 ccm", "1e-5 m^3"),
    ("5 g/cc", "5000 kg/m^3"),
    ("5 g/cm3", "5000 kg/m^3"),
    ("5 g/cm³", "5000 kg/m^3"),
    ("1 kgm2", "1 kg m^2"),
    ("1 kgm^2", "1 kg m^2"),
    ("1 kg-m2", "1 kg m^2"),
    ("1 kg*m^2", "1 kg m^2"),
    ("5 W/mK", "5 W/(m K)"),
    ("5 W/(mK)", "5 W/(m K)"),
    ("5 W/m-K", "5 W/(m K)"),
    ("5 W/m/K", "5 W/(m K)"),
    ("5 W/m K", "5 W/(m K)"),
    ("5 W/m·K", "5 W/(m K)"),
    ("5 W/(m.K)", "5 W/(m K)"),
    ("5 W/m°C", "5 W/(m K)"),
    ("5 W/m-°C", "5 W/(m K)"),
    ("5 W m-1 K-1", "5 W/(m K)"),
    ("5 W m^-1 K^-1", "5 W/(m K)"),
    ("5 mW/mK", "0.005 W/(m K)"),
    ("5 W/cm-K", "500 W/(m K)"),
    ("5 W/cmK", "500 W/(m K)"),
    ("5 W/m2K", "5 W/(m^2 K)"),
    ("5 W/m²K", "5 W/(m^2 K)"),
    ("5 W/m2-K", "5 W/(m^2 K)"),
    ("5 W/m^2K", "5 W/(m^2 K)"),
    ("5 W/m^2/K", "5 W/(m^2 K)"),
    ("5 W/m2°C", "5 W/(m^2 K)"),
    ("5 kW/m2-K", "5000 W/(m^2 K)"),
    ("5 W/cm2K", "50000 W/(m^2 K)"),
    ("5 J/kgK", "5 J/(kg K)"),
    ("5 J/kg-K", "5 J/(kg K)"),
    ("5 J/kg K", "5 J/(kg K)"),
    ("5 J/kg/K", "5 J/(kg K)"),
    ("5 J/(kgK)", "5 J/(kg K)"),
    ("5 J/(kg·K)", "5 J/(kg K)"),
    ("5 kJ/kgK", "5000 J/(kg K)"),
    ("5 J/gK", "5000 J/(kg K)"),
    ("5 J/g°C", "5000 J/(kg K)"),
    ("5 J/g-K", "5000 J/(kg K)"),
    ("5 J/kg°C", "5 J/(kg K)"),
    ("1 cal/g°C", "4184 J/(kg K)"),
    ("1 m2K/W", "1 m^2 K/W"),
    ("1 m²K/W", "1 m^2 K/W"),
    ("1 m2-K/W", "1 m^2 K/W"),
    ("5 °C/W", "5 K/W"),
    ("5 C/W", "5 K/W"),
    ("5 mK/W", "0.005 K/W"),
    ("5 K/kW", "0.005 K/W"),
    ("1 PS", "735.49875 W"),
    ("100 PS", "73549.875 W"),
    ("2 weeks", "1209600 s"),
    ("1 week", "604800 s"),
    ("2 wks", "1209600 s"),
    ("1 mmHg", "133.322387415 Pa"),
    ("1 inHg", "3386.388640341 Pa"),
    ("1 inH2O", "249.08891 Pa"),
    ("1 mmH2O", "9.80665 Pa"),
    ("1 torr", "133.322368421052632 Pa"),
    ("1 Torr", "133.322368421052632 Pa"),
    ("5 mPas", "0.005 Pa s"),
    ("5 mPa-s", "0.005 Pa s"),
    ("5 mPa.s", "0.005 Pa s"),
    ("5 cSt", "5e-6 m^2/s"),
    ("5 mm2/s", "5e-6 m^2/s"),
    ("60 l/min", "0.001 m^3/s"),
    ("60 ltr/min", "0.001 m^3/s"),
    ("36 m3/h", "0.01 m^3/s"),
    ("36 m3/hr", "0.01 m^3/s"),
    ("36 cbm/h", "0.01 m^3/s"),
    ("1 CFM", "4.719474432e-4 m^3/s"),
    ("1 GPM", "6.30901964e-5 m^3/s"),
    ("5 Nm", "5 N m"),
    ("5 N-m", "5 N m"),
    ("5 Nmm", "0.005 N m"),
    ("5 lb-ft", "6.7790897416572 N m"),
    ("5 ft-lb", "6.7790897416572 N m"),
    ("5 in-lb", "0.5649241451381 N m"),
    ("7000 RPM", "7000 rpm"),
    ("7000 U/min", "7000 rpm"),
    ("7000 1/min", "7000 1/min"),
    ("5 N/mm2", "5e6 Pa"),
    ("5 kgf/cm2", "490332.5 Pa"),
    ("5 kp", "49.03325 N"),
    ("5 PSI", "34473.8 Pa"),
    ("5 Btu/hr", "1.46535535086 W"),
    ("1 Btu/hr-ft2-F", "5.678263341114 W/(m^2 K)"),
    ("1 BTU/h-ft-°F", "1.7307346663 W/(m K)"),
    ("1 kcal/h", "1.16222222222222 W"),
    ("1 lb/ft3", "16.01846337396 kg/m^3"),
    ("1 lbm", "0.45359237 kg"),
    ("1 cuft", "0.028316846592 m^3"),
    ("1 sqft", "0.09290304 m^2"),
    ("10 micron", "1e-5 m"),
    ("10 µm", "1e-5 m"),
    ("10 thou", "2.54e-4 m"),
    ("10 mins", "600 s"),
    ("10 hrs", "36000 s"),
    ("5 kelvin", "5 K"),
    ("5 ohms", "5 ohm"),
    ("5 mΩ", "0.005 ohm"),
    ("5 deg/s", "0.0872664625997165 rad/s"),
];

/// The first text in quotes or the first code of a help.
fn first_fix(help: &str) -> Option<&str> {
    help.split('"').nth(1)
}

#[test]
fn units_of_engineers_are_read_rightly_or_refused_with_the_right_ones() {
    let mut wrong = Vec::new();
    for (text, right) in WRITTEN {
        let right = parse_quantity(right, None).expect(right);
        let found = match parse_quantity(text, None) {
            Ok(found) => Ok(found),
            Err(_) => {
                let help = parse_value(text, None, &|_| false).expect_err(text).help();
                let help = help.unwrap_or_default();
                first_fix(&help).and_then(|fix| parse_quantity(fix, None).ok()).ok_or(help)
            }
        };
        match found {
            Ok(found) if found.ty == right.ty => {
                if (found.value / right.value - 1.0).abs() > 1e-5 {
                    wrong.push(format!("{text}: {} instead of {}", found.value, right.value));
                }
            }
            Ok(found) => wrong.push(format!("{text}: {:?} instead of {:?}", found.ty, right.ty)),
            Err(help) => wrong.push(format!("{text}: {help}")),
        }
    }
    assert!(WRITTEN.len() >= 60);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// No slip makes a conductivity a conductance.
#[test]
fn millikelvin_below_the_bar_is_never_read() {
    for text in ["5 W/mK", "5 W/(mK)", "5 W mK^-1", "5 W/(s mK)", "1/mK", "5 W/mK^2", "2 J/(g mK)"]
    {
        let error = parse_quantity(text, None).expect_err(text);
        assert_eq!(error.code(), "units::millikelvin", "{text}");
    }
    for text in ["5 mK", "5 mK/W", "5 W/(1/mK)", "5 mK/mK"] {
        assert!(parse_quantity(text, None).is_ok(), "{text}");
    }
}
