//! Kinds of numbers, and the units in which each may be written.

/// What a number of a network is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Plain,
    /// An absolute temperature, held in degC; kelvin may stand only alone in a field that wants
    /// one.
    Temperature,
    Difference,
    /// A duration.
    Time,
    /// A time of the run: it moves with the run's start.
    Instant,
    Heat,
    Capacity,
    Resistance,
    Conductance,
    Film,
    Area,
    Length,
    Volume,
    Mass,
    Density,
    SpecificHeat,
    Conductivity,
    Latent,
    MassFlow,
    VolumeFlow,
    PerKelvin,
    Speed,
}

/// A unit: its text, its size in the first unit of its kind, and its zero in that unit.
pub type Unit = (&'static str, f64, f64);

const TEMPERATURES: [Unit; 3] =
    [("degC", 1.0, 0.0), ("degF", 5.0 / 9.0, -160.0 / 9.0), ("K", 1.0, -273.15)];

impl Kind {
    /// The units; numbers are held in the first of them.
    pub fn units(self) -> &'static [Unit] {
        match self {
            Self::Plain => &[("", 1.0, 0.0)],
            Self::Temperature => &TEMPERATURES,
            Self::Difference => &[("K", 1.0, 0.0), ("mK", 1e-3, 0.0)],
            Self::Time | Self::Instant => {
                &[("s", 1.0, 0.0), ("min", 60.0, 0.0), ("h", 3600.0, 0.0), ("ms", 1e-3, 0.0)]
            }
            Self::Heat => &[("W", 1.0, 0.0), ("kW", 1e3, 0.0), ("mW", 1e-3, 0.0)],
            Self::Capacity => &[("J/K", 1.0, 0.0), ("kJ/K", 1e3, 0.0), ("W h/K", 3600.0, 0.0)],
            Self::Resistance => &[("K/W", 1.0, 0.0), ("mK/W", 1e-3, 0.0), ("K/kW", 1e-3, 0.0)],
            Self::Conductance => &[("W/K", 1.0, 0.0), ("mW/K", 1e-3, 0.0), ("kW/K", 1e3, 0.0)],
            Self::Film => {
                &[("W/(m^2 K)", 1.0, 0.0), ("W/(cm^2 K)", 1e4, 0.0), ("kW/(m^2 K)", 1e3, 0.0)]
            }
            Self::Area => &[("m^2", 1.0, 0.0), ("cm^2", 1e-4, 0.0), ("mm^2", 1e-6, 0.0)],
            Self::Length => &[("m", 1.0, 0.0), ("mm", 1e-3, 0.0), ("cm", 1e-2, 0.0)],
            Self::Volume => &[("m^3", 1.0, 0.0), ("cm^3", 1e-6, 0.0), ("L", 1e-3, 0.0)],
            Self::Mass => &[("kg", 1.0, 0.0), ("g", 1e-3, 0.0)],
            Self::Density => &[("kg/m^3", 1.0, 0.0), ("g/cm^3", 1e3, 0.0)],
            Self::SpecificHeat => &[("J/(kg K)", 1.0, 0.0), ("kJ/(kg K)", 1e3, 0.0)],
            Self::Conductivity => &[("W/(m K)", 1.0, 0.0), ("mW/(m K)", 1e-3, 0.0)],
            Self::Latent => &[("J/kg", 1.0, 0.0), ("kJ/kg", 1e3, 0.0)],
            Self::MassFlow => {
                &[("kg/s", 1.0, 0.0), ("g/s", 1e-3, 0.0), ("kg/h", 1.0 / 3600.0, 0.0)]
            }
            Self::VolumeFlow => &[("m^3/s", 1.0, 0.0), ("L/min", 1e-3 / 60.0, 0.0)],
            Self::PerKelvin => &[("1/K", 1.0, 0.0), ("1/kK", 1e-3, 0.0)],
            Self::Speed => &[
                ("rpm", 1.0, 0.0),
                ("rad/s", 30.0 / std::f64::consts::PI, 0.0),
                ("rev/s", 60.0, 0.0),
            ],
        }
    }
}

/// A number with the unit it is written in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// In the first unit of its kind.
    pub value: f64,
    pub kind: Kind,
    /// Which unit of its kind.
    pub unit: usize,
}

impl Number {
    /// The number alone, in its unit.
    pub fn bare(&self) -> String {
        let (_, size, zero) = self.kind.units()[self.unit];
        let value = (self.value - zero) / size;
        if value.fract().abs() <= 0.0 && value.abs() < 1e15 {
            format!("{value:.1}")
        } else {
            format!("{value:?}")
        }
    }

    pub fn unit(&self) -> &'static str {
        self.kind.units()[self.unit].0
    }

    /// As a whole string, `12 W/K`.
    pub fn quantity(&self) -> String {
        format!("{} {}", self.bare(), self.unit()).trim_end().to_owned()
    }

    /// Inside an expression, `12 [W/K]`; one with a sign stands in brackets.
    pub fn literal(&self) -> String {
        let text = match self.unit() {
            "" => self.bare(),
            unit => format!("{} [{unit}]", self.bare()),
        };
        if text.starts_with('-') { format!("({text})") } else { text }
    }
}
