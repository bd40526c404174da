//! A drawing: paths and texts on a page, in the order in which they cover each other.

use crate::ink::Ink;

/// A drawing. Lengths are in CSS pixels (1/96 inch); x grows to the right, y downwards.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Width and height.
    pub size: (f64, f64),
    /// Description for readers who do not see the drawing.
    pub title: String,
    /// The shapes, the lowest first.
    pub shapes: Vec<Shape>,
}

/// A piece of a drawing.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A line or an area.
    Path(Path),
    /// A line of text.
    Text(Text),
}

/// A line or an area.
#[derive(Clone, Debug)]
pub struct Path {
    /// Its steps in order.
    pub steps: Vec<Step>,
    /// Style of its line.
    pub stroke: Option<Stroke>,
    /// Style of its area.
    pub fill: Option<Fill>,
    /// Tooltip of the path.
    pub tip: Option<String>,
}

/// A step of a path, to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Begins a new piece.
    Move(f64, f64),
    /// A straight line.
    Line(f64, f64),
    /// A cubic Bezier curve: two control points and the end.
    Curve([(f64, f64); 3]),
    /// A line back to the beginning of the piece.
    Close,
    /// A separate piece: a circle by its centre and radius.
    Circle((f64, f64), f64),
}

/// Style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Meaning of the line.
    pub ink: Ink,
    /// Width in pixels.
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

/// Dashes of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// A line without gaps.
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
}

/// Style of an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// Meaning of the area.
    pub ink: Ink,
    /// Opacity from 0, transparent, to 1.
    pub opacity: f64,
}

/// A line of text.
#[derive(Clone, Debug)]
pub struct Text {
    /// The characters.
    pub text: String,
    /// Position on the base line of the end that `align` names.
    pub at: (f64, f64),
    /// Font size in pixels.
    pub size: f64,
    /// Meaning of the text.
    pub ink: Ink,
    /// The end of the text that `at` gives.
    pub align: Align,
    /// True for bold type.
    pub bold: bool,
    /// True if the text reads from bottom to top.
    pub upward: bool,
}

/// The end of a text that is at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Scene {
    /// An empty page.
    pub fn new(size: (f64, f64), title: impl Into<String>) -> Self {
        let mut scene = Self { size, title: title.into(), shapes: Vec::new() };
        scene.put(rectangle((0.0, 0.0), size, 0.0).filled(Ink::Paper, 1.0));
        scene
    }

    /// Draws a line or an area on top of the existing shapes.
    pub fn put(&mut self, path: Path) {
        self.shapes.push(Shape::Path(path));
    }

    /// Draws another scene, without its paper, moved to the right and down.
    pub fn add(&mut self, other: Self, by: (f64, f64)) {
        self.shapes.extend(other.shapes.into_iter().skip(1).map(|shape| shape.moved(by)));
    }

    /// Writes a text on top of the existing shapes.
    pub fn write(&mut self, text: Text) {
        self.shapes.push(Shape::Text(text));
    }
}

impl Shape {
    /// The same shape, moved to the right and down.
    fn moved(self, (x, y): (f64, f64)) -> Self {
        let at = |point: (f64, f64)| (point.0 + x, point.1 + y);
        match self {
            Self::Text(text) => Self::Text(Text { at: at(text.at), ..text }),
            Self::Path(mut path) => {
                for step in &mut path.steps {
                    *step = match *step {
                        Step::Move(u, v) => Step::Move(u + x, v + y),
                        Step::Line(u, v) => Step::Line(u + x, v + y),
                        Step::Curve(points) => Step::Curve(points.map(at)),
                        Step::Close => Step::Close,
                        Step::Circle(centre, radius) => Step::Circle(at(centre), radius),
                    };
                }
                Self::Path(path)
            }
        }
    }
}

impl Stroke {
    /// A solid line.
    pub fn solid(ink: Ink, width: f64) -> Self {
        Self { ink, width, dash: Dash::Solid }
    }
}

impl Path {
    /// A path without line and fill.
    pub fn new(steps: Vec<Step>) -> Self {
        Self { steps, stroke: None, fill: None, tip: None }
    }

    /// Adds a line along the path.
    #[must_use]
    pub fn stroked(self, stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), ..self }
    }

    /// Fills the area.
    #[must_use]
    pub fn filled(self, ink: Ink, opacity: f64) -> Self {
        Self { fill: Some(Fill { ink, opacity }), ..self }
    }

    /// Adds a tooltip.
    #[must_use]
    pub fn tipped(self, tip: impl Into<String>) -> Self {
        Self { tip: Some(tip.into()), ..self }
    }
}

impl Text {
    /// A text of ordinary weight that begins at a point.
    pub fn new(text: impl Into<String>, at: (f64, f64), size: f64, ink: Ink) -> Self {
        let (align, bold, upward) = (Align::Start, false, false);
        Self { text: text.into(), at, size, ink, align, bold, upward }
    }

    /// Sets which end is at its point.
    #[must_use]
    pub fn aligned(self, align: Align) -> Self {
        Self { align, ..self }
    }

    /// Makes it bold.
    #[must_use]
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// Turns it to read from bottom to top.
    #[must_use]
    pub fn upward(self) -> Self {
        Self { upward: true, ..self }
    }
}

/// A line through points.
pub fn line(points: impl IntoIterator<Item = (f64, f64)>) -> Path {
    let mut steps: Vec<Step> = points.into_iter().map(|(x, y)| Step::Line(x, y)).collect();
    if let Some(first) = steps.first_mut()
        && let Step::Line(x, y) = *first
    {
        *first = Step::Move(x, y);
    }
    Path::new(steps)
}

/// An area with corners.
pub fn polygon(points: impl IntoIterator<Item = (f64, f64)>) -> Path {
    let mut path = line(points);
    path.steps.push(Step::Close);
    path
}

/// Distance of the control points of a quarter circle from its ends, as a share of its radius: the
/// curve is off by less than 0.03 %.
const KAPPA: f64 = 0.552_284_75;

/// A rectangle by its upper left corner, with corners rounded by a radius.
pub fn rectangle((x, y): (f64, f64), (width, height): (f64, f64), radius: f64) -> Path {
    let (right, bottom) = (x + width, y + height);
    let r = radius.min(width / 2.0).min(height / 2.0);
    if r <= 0.0 {
        return polygon([(x, y), (right, y), (right, bottom), (x, bottom)]);
    }
    let k = r * (1.0 - KAPPA);
    Path::new(vec![
        Step::Move(x + r, y),
        Step::Line(right - r, y),
        Step::Curve([(right - k, y), (right, y + k), (right, y + r)]),
        Step::Line(right, bottom - r),
        Step::Curve([(right, bottom - k), (right - k, bottom), (right - r, bottom)]),
        Step::Line(x + r, bottom),
        Step::Curve([(x + k, bottom), (x, bottom - k), (x, bottom - r)]),
        Step::Line(x, y + r),
        Step::Curve([(x, y + k), (x + k, y), (x + r, y)]),
        Step::Close,
    ])
}

/// A circle by its centre.
pub fn circle(centre: (f64, f64), radius: f64) -> Path {
    Path::new(vec![Step::Circle(centre, radius)])
}
