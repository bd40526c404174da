//! What is to be drawn: paths and texts on a page, in the order in which they cover each other.

use crate::ink::Ink;

/// A drawing. Lengths are in CSS pixels (1/96 inch); x grows to the right, y downwards.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Width and height.
    pub size: (f64, f64),
    /// What it shows, for readers that do not see it.
    pub title: String,
    /// What is on it, the lowest first.
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
    /// Where it goes.
    pub steps: Vec<Step>,
    /// How its line is drawn.
    pub stroke: Option<Stroke>,
    /// How its area is filled.
    pub fill: Option<Fill>,
    /// What a reader that points at it is told.
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
    /// Back to where the piece began.
    Close,
    /// A piece of its own: a circle by its centre and radius.
    Circle((f64, f64), f64),
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// What it means.
    pub ink: Ink,
    /// Its width.
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Into dashes.
    Dashed,
    /// Into dots.
    Dotted,
}

/// How an area is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// What it means.
    pub ink: Ink,
    /// From 0, not at all, to 1.
    pub opacity: f64,
}

/// A line of text.
#[derive(Clone, Debug)]
pub struct Text {
    /// What it says.
    pub text: String,
    /// Where: the base line, at the end that `align` names.
    pub at: (f64, f64),
    /// Height of a line of the font.
    pub size: f64,
    /// What it means.
    pub ink: Ink,
    /// Which end of it `at` is.
    pub align: Align,
    /// Whether it is heavy.
    pub bold: bool,
    /// Whether it reads from bottom to top.
    pub upward: bool,
}

/// Which end of a text is at its point.
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

    /// Draws a line or an area on top of what there is.
    pub fn put(&mut self, path: Path) {
        self.shapes.push(Shape::Path(path));
    }

    /// Writes on top of what there is.
    pub fn write(&mut self, text: Text) {
        self.shapes.push(Shape::Text(text));
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

    /// With a line.
    #[must_use]
    pub fn stroked(self, stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), ..self }
    }

    /// With its area filled.
    #[must_use]
    pub fn filled(self, ink: Ink, opacity: f64) -> Self {
        Self { fill: Some(Fill { ink, opacity }), ..self }
    }

    /// With a text for readers that point at it.
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

    /// With its point at another end.
    #[must_use]
    pub fn aligned(self, align: Align) -> Self {
        Self { align, ..self }
    }

    /// Heavy.
    #[must_use]
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// From bottom to top.
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

/// A share of its radius by which the control points of a quarter of a circle lie beside its ends:
/// the curve is off by less than 0.03 %.
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
