//! Writes SVG, and nothing that the caller passes as text or value can become an element of it.

use std::fmt::{self, Write as _};

use crate::ink::Theme;
use crate::scene::{Align, Dash, Path, Scene, Shape, Step, Text};

/// A drawing as SVG in the colours of paper. Each line has the class `s-KEY` and each area and text
/// `f-KEY` of its [`Ink`](crate::Ink). A page can set other colours by these classes.
pub fn write(scene: &Scene) -> String {
    write_in(scene, Theme::Light)
}

/// The same in the colours of a theme.
pub fn write_in(scene: &Scene, theme: Theme) -> String {
    let (width, height) = (length(scene.size.0), length(scene.size.1));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{FONT}\">\n\
         <title>{}</title>\n",
        escaped(&scene.title)
    );
    for shape in &scene.shapes {
        // writing to a `String` cannot fail
        let _ = match shape {
            Shape::Path(path) => write_path(&mut out, path, theme),
            Shape::Text(text) => write_text(&mut out, text, theme),
        };
    }
    out.push_str("</svg>\n");
    out
}

fn write_path(out: &mut String, path: &Path, theme: Theme) -> fmt::Result {
    out.push_str("<path d=\"");
    for step in &path.steps {
        match *step {
            Step::Move(x, y) => write!(out, "M{} {}", length(x), length(y))?,
            Step::Line(x, y) => write!(out, "L{} {}", length(x), length(y))?,
            Step::Curve(points) => {
                let points = points.map(|(x, y)| format!("{} {}", length(x), length(y)));
                write!(out, "C{}", points.join(" "))?;
            }
            Step::Close => out.push('Z'),
            Step::Circle((x, y), r) => {
                let (left, y, r, d) = (length(x - r), length(y), length(r), length(2.0 * r));
                write!(out, "M{left} {y}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0Z")?;
            }
        }
    }
    let mut classes = Vec::new();
    match path.fill {
        Some(fill) => {
            classes.push(format!("f-{}", fill.ink.key()));
            write!(out, "\" fill=\"{}", fill.ink.hex(theme))?;
            if fill.opacity < 1.0 {
                write!(out, "\" fill-opacity=\"{}", length(fill.opacity))?;
            }
        }
        None => out.push_str("\" fill=\"none"),
    }
    if let Some(stroke) = path.stroke {
        classes.push(format!("s-{}", stroke.ink.key()));
        let (colour, width) = (stroke.ink.hex(theme), length(stroke.width));
        write!(out, "\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round")?;
        if let Some([on, off]) = stroke.dash.lengths(stroke.width) {
            write!(out, "\" stroke-dasharray=\"{} {}", length(on), length(off))?;
        }
    }
    write!(out, "\" class=\"{}\"", classes.join(" "))?;
    match &path.tip {
        Some(tip) => writeln!(out, "><title>{}</title></path>", escaped(tip)),
        None => writeln!(out, "/>"),
    }
}

fn write_text(out: &mut String, text: &Text, theme: Theme) -> fmt::Result {
    let (x, y) = (length(text.at.0), length(text.at.1));
    let (size, key) = (length(text.size), text.ink.key());
    let colour = text.ink.hex(theme);
    write!(
        out,
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{colour}\" class=\"f-{key}\""
    )?;
    match text.align {
        Align::Start => {}
        Align::Middle => out.push_str(" text-anchor=\"middle\""),
        Align::End => out.push_str(" text-anchor=\"end\""),
    }
    if text.bold {
        out.push_str(" font-weight=\"bold\"");
    }
    // another font may be wider; a single letter has nothing to move
    if text.text.chars().nth(1).is_some() {
        let wide = length(crate::font::width(&text.text, text.size, text.bold));
        write!(out, " textLength=\"{wide}\" lengthAdjust=\"spacingAndGlyphs\"")?;
    }
    if text.upward {
        write!(out, " transform=\"rotate(-90 {x} {y})\"")?;
    }
    writeln!(out, ">{}</text>", escaped(&text.text))
}

impl Dash {
    /// Lengths of a dash and of the gap after it, for a line of this width.
    pub(crate) fn lengths(self, width: f64) -> Option<[f64; 2]> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some([4.0 * width, 2.5 * width]),
            Self::Dotted => Some([width, 2.0 * width]),
        }
    }
}

/// The fonts whose widths are those of [`crate::font`].
const FONT: &str = "Arimo, Arial, Helvetica, Liberation Sans, sans-serif";

/// A length with at most two decimals and no trailing zeros; 0 if it is not finite.
pub fn length(value: f64) -> String {
    if !value.is_finite() {
        return "0".into();
    }
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A text escaped for elements and attributes of XML and HTML. Tabs and line ends become spaces,
/// other control characters, which XML cannot contain, U+FFFD.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' => out.push(' '),
            '\u{FFFE}' | '\u{FFFF}' => out.push('\u{FFFD}'),
            c if c.is_control() => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{escaped, length, write};
    use crate::ink::Ink;
    use crate::scene::{Scene, Text, rectangle};

    #[test]
    fn a_text_cannot_leave_its_element() {
        let mut scene = Scene::new((10.0, 10.0), "<script>alert(1)</script>");
        scene.write(Text::new("a & b</text>\u{1b}[31m", (1.0, 2.0), 12.0, Ink::Text));
        scene.put(rectangle((0.0, 0.0), (1.0, 1.0), 0.0).tipped("\"><img onerror=x>"));
        let text = write(&scene);
        assert!(!text.contains("<script") && !text.contains("<img"), "{text}");
        assert!(text.contains("a &amp; b&lt;/text&gt;\u{FFFD}[31m"), "{text}");
    }

    #[test]
    fn lengths_are_short_and_finite() {
        let all = [1.0, 0.006, -0.001, 12.346, f64::NAN, f64::INFINITY].map(length);
        assert_eq!(all, ["1", "0.01", "0", "12.35", "0", "0"]);
        assert_eq!(escaped("'1'\n"), "&#39;1&#39; ");
    }
}
