//! Reads a picture back: what its dots and lines say in the units of the axes.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

/// A panel of a picture.
#[derive(Debug, Default)]
pub struct Panel {
    /// The title of the axis upwards.
    pub title: String,
    /// Pixels and values of the marks of the axis upwards.
    marks: Vec<(f64, f64)>,
    /// The same of the axis to the right, which panels below each other share.
    across: Vec<(f64, f64)>,
    /// Centres of dots in pixels, with the ink.
    dots: Vec<(String, f64, f64)>,
    /// Points of lines in pixels, with the ink.
    lines: Vec<(String, Vec<(f64, f64)>)>,
}

/// A figure, or several with one axis to the right.
#[derive(Debug, Default)]
pub struct Picture {
    pub texts: Vec<String>,
    pub panels: Vec<Panel>,
}

fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let from = line.find(&format!(" {name}=\""))? + name.len() + 3;
    line[from..].split('"').next()
}

fn number(text: &str) -> Option<f64> {
    text.replace('\u{2212}', "-").parse().ok()
}

/// The value at a pixel, by two marks.
fn value(marks: &[(f64, f64)], at: f64) -> f64 {
    let ((p, v), (q, w)) = (marks[0], marks[marks.len() - 1]);
    assert!((p - q).abs() > 1.0, "one mark alone: {marks:?}");
    v + (w - v) * (at - p) / (q - p)
}

/// Points at which a path begins or a line of it ends.
fn points(path: &str) -> Vec<(f64, f64)> {
    path.split(['M', 'L', 'Z']).filter_map(pair).collect()
}

fn pair(text: &str) -> Option<(f64, f64)> {
    let (x, y) = text.split_once(' ')?;
    Some((number(x)?, number(y)?))
}

/// The centre of a circle that begins at its left.
fn centre(path: &str) -> Option<(f64, f64)> {
    let (left, arc) = path.strip_prefix('M')?.split_once('a')?;
    let (x, y) = pair(left)?;
    Some((x + number(arc.split(' ').next()?)?, y))
}

impl Panel {
    /// How many dots of an ink it has.
    pub fn count(&self, ink: &str) -> usize {
        self.dots.iter().filter(|dot| dot.0 == ink).count()
    }
}

impl Picture {
    /// Reads an SVG whose axes are linear.
    pub fn read(svg: &str) -> Self {
        let mut picture = Self::default();
        let mut next = Panel::default();
        for line in svg.lines() {
            let ink = attribute(line, "class").unwrap_or_default();
            if line.starts_with("<text") {
                let text = line.split('>').nth(1).unwrap().split('<').next().unwrap();
                picture.texts.push(text.to_owned());
                let at = |name| attribute(line, name).and_then(number).unwrap();
                // a text stands a third of its height below its mark
                match (attribute(line, "text-anchor"), number(text)) {
                    (Some("end"), Some(value)) => next.marks.push((at("y") - 0.36 * 11.0, value)),
                    (Some("middle"), Some(value)) => next.across.push((at("x"), value)),
                    // what happened at a moment is written upwards too, from its beginning on
                    (Some("middle"), None) if line.contains("rotate(") => {
                        next.title = text.to_owned();
                        picture.panels.push(std::mem::take(&mut next));
                    }
                    _ => {}
                }
            }
            let (Some(panel), true) = (picture.panels.last_mut(), ink.contains("series")) else {
                continue;
            };
            let ink = ink[2..].to_owned();
            match attribute(line, "d") {
                Some(path) if path.contains('a') => {
                    let dots = path.split('Z').filter_map(centre);
                    panel.dots.extend(dots.map(|(x, y)| (ink.clone(), x, y)));
                }
                // not what leads to a name
                Some(path) if attribute(line, "stroke-width") != Some("0.7") => {
                    panel.lines.push((ink, points(path)));
                }
                _ => {}
            }
        }
        for i in (1..picture.panels.len()).rev() {
            if picture.panels[i - 1].across.is_empty() {
                picture.panels[i - 1].across = picture.panels[i].across.clone();
            }
        }
        picture
    }

    pub fn says(&self, text: &str) -> &Self {
        assert!(self.texts.iter().any(|found| found.contains(text)), "{text}: {:?}", self.texts);
        self
    }

    fn panel(&self, title: &str) -> &Panel {
        let found = self.panels.iter().find(|panel| panel.title == title);
        found.unwrap_or_else(|| panic!("{title}: {:?}", self.texts))
    }

    fn valued(panel: &Panel, (x, y): (f64, f64)) -> (f64, f64) {
        (value(&panel.across, x), value(&panel.marks, y))
    }

    /// The dots of an ink in the panel with this title, in the units of its axes.
    pub fn dots(&self, title: &str, ink: &str) -> Vec<(f64, f64)> {
        let panel = self.panel(title);
        let dots = panel.dots.iter().filter(|dot| dot.0 == ink);
        dots.map(|dot| Self::valued(panel, (dot.1, dot.2))).collect()
    }

    /// The lines, bars and bands of an ink in the panel with this title.
    pub fn lines(&self, title: &str, ink: &str) -> Vec<Vec<(f64, f64)>> {
        let panel = self.panel(title);
        let lines = panel.lines.iter().filter(|line| line.0 == ink);
        lines.map(|line| line.1.iter().map(|at| Self::valued(panel, *at)).collect()).collect()
    }
}
