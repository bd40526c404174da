//! The content of a figure, independent of its appearance.

/// A figure: panels below each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Title of the figure.
    pub title: String,
    /// A note for the reader, below the title.
    pub note: String,
    /// Its panels, from top to bottom.
    pub panels: Vec<Panel>,
}

/// Curves over one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The curves; each has the ink of its place.
    pub curves: Vec<Curve>,
    /// Values that should not be exceeded.
    pub limits: Vec<Level>,
    /// Events on the horizontal axis.
    pub moments: Vec<Moment>,
    /// Height as a share of the height of an ordinary panel.
    pub share: f64,
    /// True in a figure that is one of many alike: a page puts them next to each other.
    pub small: bool,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name of the quantity along the axis.
    pub name: String,
    /// The unit of its values: empty for plain numbers, `s` for a time, which is shown in ms, s,
    /// min, h or d by its length.
    pub unit: String,
    /// Relation between values and places.
    pub scale: Scale,
}

/// The relation between values and places on an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic; values that are not positive are not shown.
    Log,
    /// Linear, of times in s.
    Time,
    /// Named things at 0, 1, 2 …, at equal distances. Along a horizontal axis, a name may have
    /// two lines.
    Names(Vec<String>),
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of the curve.
    pub name: String,
    /// Its points in order. A value that is not finite interrupts it.
    pub points: Vec<(f64, f64)>,
    /// Lowest and highest value at each point: a band around a line, bars at dots, the two ends of
    /// a bar across. Empty if unknown.
    pub spread: Vec<(f64, f64)>,
    /// Tooltip of each point, of a line that of the whole; empty for the name of the curve.
    pub tips: Vec<String>,
    /// Its days, if they are known better than from its points.
    pub days: Vec<Day>,
    /// Its style.
    pub look: Look,
    /// True if it does not set the scale if it is far from all others, as empty space is.
    pub aside: bool,
    /// The place whose ink it has, if not its own: for the same thing in another panel, or for a
    /// measured and a computed curve.
    pub place: Option<usize>,
}

/// A curve over a day, or over a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Day {
    /// Its start in s.
    pub from: f64,
    /// Its end in s.
    pub to: f64,
    /// The mean over time.
    pub mean: f64,
    /// The least and the largest value.
    pub range: (f64, f64),
}

/// The style of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A line through its points.
    Line,
    /// A dashed line.
    Dashed,
    /// A dot at each point.
    Dots,
    /// A dot with a line down to zero.
    Stems,
    /// A bar across, from the low to the high end of its spread, in the row of its point. The axis
    /// upwards has names.
    Bars,
}

/// A value that should not be exceeded.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name of the limit.
    pub name: String,
    /// The value.
    pub value: f64,
}

/// An event on the horizontal axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Name of the event.
    pub name: String,
    /// Position on the horizontal axis.
    pub at: f64,
}

impl Axis {
    /// A linear axis.
    pub fn linear(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), scale: Scale::Linear }
    }

    /// A logarithmic axis.
    pub fn log(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), scale: Scale::Log }
    }

    /// An axis of time in s.
    pub fn time() -> Self {
        Self { name: "time".into(), unit: "s".into(), scale: Scale::Time }
    }

    /// An axis of named things.
    pub fn names(name: impl Into<String>, names: Vec<String>) -> Self {
        Self { name: name.into(), unit: String::new(), scale: Scale::Names(names) }
    }
}

impl Figure {
    /// True if it is one of many alike.
    pub fn is_small(&self) -> bool {
        self.panels.iter().any(|panel| panel.small)
    }
}

impl Scale {
    /// True if the scale has a place for a value.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (*self != Self::Log || value > 0.0)
    }
}

impl Panel {
    /// True if both axes have a place for a point.
    pub fn shows(&self, (x, y): (f64, f64)) -> bool {
        self.x.scale.shows(x) && self.y.scale.shows(y)
    }

    /// An empty panel.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            curves: Vec::new(),
            limits: Vec::new(),
            moments: Vec::new(),
            share: 1.0,
            small: false,
        }
    }
}

impl Curve {
    /// A line through points.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.into(),
            points,
            spread: Vec::new(),
            tips: Vec::new(),
            days: Vec::new(),
            look: Look::Line,
            aside: false,
            place: None,
        }
    }

    /// Sets how the curve is drawn.
    #[must_use]
    pub fn looks(self, look: Look) -> Self {
        Self { look, ..self }
    }

    /// Sets the ink to that of another place.
    #[must_use]
    pub fn as_place(self, place: usize) -> Self {
        Self { place: Some(place), ..self }
    }

    /// Adds a tooltip to each point, to a line one for the whole.
    #[must_use]
    pub fn tipped(self, tips: Vec<String>) -> Self {
        Self { tips, ..self }
    }

    /// Adds a band or bars around the curve.
    #[must_use]
    pub fn within(self, spread: Vec<(f64, f64)>) -> Self {
        Self { spread, ..self }
    }
}
