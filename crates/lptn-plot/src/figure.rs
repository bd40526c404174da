//! What a figure shows, without saying how it looks.

/// A figure: panels below each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// What it is of.
    pub title: String,
    /// What a reader has to know beside it.
    pub note: String,
    /// Its panels, from top to bottom.
    pub panels: Vec<Panel>,
}

/// Curves over one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The axis to the right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// The curves; each has the ink of its place.
    pub curves: Vec<Curve>,
    /// Values that should not be passed.
    pub limits: Vec<Level>,
    /// Places on the axis to the right where something happened.
    pub moments: Vec<Moment>,
    /// Its height as a share of that of an ordinary panel.
    pub share: f64,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is measured along it.
    pub name: String,
    /// The unit of its values; empty for plain numbers, and `s` for a time, which is shown in s,
    /// min, h or d by its length.
    pub unit: String,
    /// How values become places.
    pub scale: Scale,
}

/// How values become places on an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// By their logarithms; values that are not positive are not shown.
    Log,
    /// In proportion, of seconds.
    Time,
    /// 0, 1, 2 .. are things that have names, and are apart by the same distance.
    Names(Vec<String>),
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What it is of.
    pub name: String,
    /// Its points in order. A value that is not finite interrupts it.
    pub points: Vec<(f64, f64)>,
    /// Lowest and highest value at each point: a band around a line, bars at dots. Empty where
    /// nothing is known of it.
    pub spread: Vec<(f64, f64)>,
    /// How it is drawn.
    pub look: Look,
    /// The ink, where it is not that of its place: the same thing in another panel, what was
    /// measured and what was computed.
    pub place: Option<usize>,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A line through its points.
    Line,
    /// A broken line.
    Dashed,
    /// A dot at each point.
    Dots,
    /// A dot with a line down to zero.
    Stems,
}

/// A value that should not be passed.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// What it is called.
    pub name: String,
    /// Where it is.
    pub value: f64,
}

/// A place on the axis to the right where something happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// What happened.
    pub name: String,
    /// Where.
    pub at: f64,
}

impl Axis {
    /// An axis of values in proportion.
    pub fn linear(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), scale: Scale::Linear }
    }

    /// An axis of values by their logarithms.
    pub fn log(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), scale: Scale::Log }
    }

    /// An axis of time in s.
    pub fn time() -> Self {
        Self { name: "time".into(), unit: "s".into(), scale: Scale::Time }
    }

    /// An axis of things with names.
    pub fn names(name: impl Into<String>, names: Vec<String>) -> Self {
        Self { name: name.into(), unit: String::new(), scale: Scale::Names(names) }
    }
}

impl Scale {
    /// Whether it has a place for a value.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (*self != Self::Log || value > 0.0)
    }
}

impl Panel {
    /// Whether both axes have a place for a point.
    pub fn shows(&self, (x, y): (f64, f64)) -> bool {
        self.x.scale.shows(x) && self.y.scale.shows(y)
    }

    /// A panel without anything in it.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, curves: Vec::new(), limits: Vec::new(), moments: Vec::new(), share: 1.0 }
    }
}

impl Curve {
    /// A line through points.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        let (spread, look, place) = (Vec::new(), Look::Line, None);
        Self { name: name.into(), points, spread, look, place }
    }

    /// Drawn otherwise.
    #[must_use]
    pub fn looks(self, look: Look) -> Self {
        Self { look, ..self }
    }

    /// With the ink of another place.
    #[must_use]
    pub fn as_place(self, place: usize) -> Self {
        Self { place: Some(place), ..self }
    }

    /// With a band or bars around it.
    #[must_use]
    pub fn within(self, spread: Vec<(f64, f64)>) -> Self {
        Self { spread, ..self }
    }
}
