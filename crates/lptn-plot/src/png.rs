//! Writes a drawing as PNG.
//!
//! PNG is drawn from the scene, not from the SVG, with tiny-skia and the outlines of the embedded
//! font. The crate resvg would add 55 crates and 107 s of CPU time to the build; these two add 17
//! s.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke as Line, StrokeDash,
    Transform,
};
use ttf_parser::{Face, OutlineBuilder};

use crate::font;
use crate::ink::{Ink, Theme};
use crate::scene::{Align, Path, Scene, Shape, Step, Text};

lptn_units::errors! {
/// Why a drawing was not written as PNG.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PngError {
    /// It has no pixels, or more than there is memory for.
    Size { width: u32, height: u32 } = "plot::png_size",
        format!("a picture of {width} x {height} pixels cannot be drawn"),
        help "write it as SVG: a name that ends with .svg";
}
}

/// A drawing as PNG in the colours of paper, with `scale` pixels for each of the drawing.
///
/// # Errors
/// [`PngError`] if it is empty or too large for memory.
pub fn write(scene: &Scene, scale: f64) -> Result<Vec<u8>, PngError> {
    write_in(scene, scale, Theme::Light)
}

/// The same in the colours of a theme. The file states its resolution, so that it is printed in the
/// size of the drawing.
///
/// # Errors
/// As [`write()`].
pub fn write_in(scene: &Scene, scale: f64, theme: Theme) -> Result<Vec<u8>, PngError> {
    let pixels = |length: f64| (length * scale).ceil().clamp(0.0, 1e9) as u32;
    let size = (pixels(scene.size.0), pixels(scene.size.1));
    let fails = || PngError::Size { width: size.0, height: size.1 };
    let mut canvas = Canvas {
        pixels: Pixmap::new(size.0, size.1).ok_or_else(fails)?,
        scale: Transform::from_scale(scale as f32, scale as f32),
        faces: [font::face(false), font::face(true)],
        theme,
    };
    for shape in &scene.shapes {
        match shape {
            Shape::Path(path) => canvas.path(path),
            Shape::Text(text) => canvas.text(text),
        }
    }
    let bytes = canvas.pixels.encode_png().map_err(|_| fails())?;
    Ok(with_resolution(bytes, scale))
}

/// Pixels of a drawing in a metre.
const PER_METRE: f64 = 96.0 / 0.0254;

/// Length of the signature and of the chunk `IHDR`, after which other chunks may begin.
const HEAD: usize = 8 + 25;

/// Adds the chunk `pHYs` (PNG 1.2, 11.3.5.3): pixels in a metre, across and down.
fn with_resolution(mut bytes: Vec<u8>, scale: f64) -> Vec<u8> {
    let per_metre = ((PER_METRE * scale).round() as u32).to_be_bytes();
    let content = [b"pHYs".as_slice(), &per_metre, &per_metre, &[1]].concat();
    let length = (content.len() - 4) as u32;
    let crc = crc(&content).to_be_bytes();
    let chunk = [&length.to_be_bytes(), content.as_slice(), &crc].concat();
    let head = HEAD.min(bytes.len());
    bytes.splice(head..head, chunk);
    bytes
}

/// The check sum of a chunk: CRC-32 of ISO 3309.
fn crc(bytes: &[u8]) -> u32 {
    let mut sum = u32::MAX;
    for byte in bytes {
        sum ^= u32::from(*byte);
        for _ in 0..8 {
            sum = if sum & 1 == 1 { 0xEDB8_8320 ^ (sum >> 1) } else { sum >> 1 };
        }
    }
    !sum
}

struct Canvas {
    pixels: Pixmap,
    scale: Transform,
    faces: [Option<Face<'static>>; 2],
    theme: Theme,
}

impl Canvas {
    fn paint(&self, ink: Ink, opacity: f64) -> Paint<'static> {
        let [r, g, b] = ink.rgb(self.theme);
        let mut paint = Paint::default();
        let alpha = (opacity * 255.0).round().clamp(0.0, 255.0) as u8;
        paint.set_color(Color::from_rgba8(r, g, b, alpha));
        paint.anti_alias = true;
        paint
    }

    fn path(&mut self, path: &Path) {
        let mut builder = PathBuilder::new();
        for step in &path.steps {
            match *step {
                Step::Move(x, y) => builder.move_to(x as f32, y as f32),
                Step::Line(x, y) => builder.line_to(x as f32, y as f32),
                Step::Curve([a, b, c]) => builder.cubic_to(
                    a.0 as f32, a.1 as f32, b.0 as f32, b.1 as f32, c.0 as f32, c.1 as f32,
                ),
                Step::Close => builder.close(),
                Step::Circle((x, y), r) => builder.push_circle(x as f32, y as f32, r as f32),
            }
        }
        let Some(outline) = builder.finish() else { return };
        if let Some(fill) = path.fill {
            let paint = self.paint(fill.ink, fill.opacity);
            self.pixels.fill_path(&outline, &paint, FillRule::Winding, self.scale, None);
        }
        if let Some(stroke) = path.stroke {
            let line = Line {
                width: stroke.width as f32,
                line_cap: LineCap::Butt,
                line_join: LineJoin::Round,
                dash: stroke
                    .dash
                    .lengths(stroke.width)
                    .and_then(|lengths| StrokeDash::new(lengths.map(|x| x as f32).to_vec(), 0.0)),
                ..Line::default()
            };
            self.pixels.stroke_path(
                &outline,
                &self.paint(stroke.ink, 1.0),
                &line,
                self.scale,
                None,
            );
        }
    }

    fn text(&mut self, text: &Text) {
        let Some(face) = &self.faces[usize::from(text.bold)] else { return };
        let mut outline = Outline { builder: PathBuilder::new(), x: 0.0 };
        for c in text.text.chars() {
            let glyph = face.glyph_index(c).or_else(|| face.glyph_index('\u{FFFD}'));
            let Some(glyph) = glyph else { continue };
            face.outline_glyph(glyph, &mut outline);
            outline.x += f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        }
        let Some(path) = outline.builder.finish() else { return };
        let size = text.size as f32 / f32::from(face.units_per_em());
        let before = match text.align {
            Align::Start => 0.0,
            Align::Middle => outline.x / 2.0,
            Align::End => outline.x,
        };
        let (x, y) = (text.at.0 as f32, text.at.1 as f32);
        let turn = if text.upward { Transform::from_rotate(-90.0) } else { Transform::identity() };
        let place = Transform::from_translate(-before, 0.0)
            .post_scale(size, size)
            .post_concat(turn)
            .post_translate(x, y)
            .post_concat(self.scale);
        self.pixels.fill_path(&path, &self.paint(text.ink, 1.0), FillRule::Winding, place, None);
    }
}

/// The outlines of a line of glyphs. In fonts, y grows upwards.
struct Outline {
    builder: PathBuilder,
    x: f32,
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.builder.move_to(self.x + x, -y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.builder.line_to(self.x + x, -y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.builder.quad_to(self.x + x1, -y1, self.x + x, -y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.builder.cubic_to(self.x + x1, -y1, self.x + x2, -y2, self.x + x, -y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}

#[cfg(test)]
mod tests {
    use super::{PngError, write};
    use crate::ink::Ink;
    use crate::scene::{Scene, rectangle};

    #[test]
    fn a_picture_has_its_pixels_and_colours() {
        let mut scene = Scene::new((20.0, 10.0), "a square");
        scene.put(rectangle((5.0, 2.0), (4.0, 4.0), 0.0).filled(Ink::Series(0), 1.0));
        let picture = tiny_skia::Pixmap::decode_png(&write(&scene, 2.0).unwrap()).unwrap();
        assert_eq!((picture.width(), picture.height()), (40, 20));
        let colour = |x, y| picture.pixel(x, y).map(|p| (p.red(), p.green(), p.blue()));
        assert_eq!(colour(14, 8), Some((0, 98, 170)));
        assert_eq!(colour(30, 8), Some((255, 255, 255)));
    }

    /// 300 dpi are 11811 pixels a metre; the check value of CRC-32 is that of `123456789`.
    #[test]
    fn a_picture_states_its_resolution() {
        let bytes = write(&Scene::new((20.0, 10.0), ""), 300.0 / 96.0).unwrap();
        let at = bytes.windows(4).position(|part| part == b"pHYs").unwrap() + 4;
        assert_eq!(bytes[at..at + 9], [0, 0, 0x2E, 0x23, 0, 0, 0x2E, 0x23, 1]);
        assert_eq!(super::crc(b"123456789"), 0xCBF4_3926);
        assert!(tiny_skia::Pixmap::decode_png(&bytes).is_ok());
    }

    #[test]
    fn a_picture_without_pixels_is_an_error() {
        let error = write(&Scene::new((0.0, 10.0), ""), 1.0).unwrap_err();
        assert_eq!(error, PngError::Size { width: 0, height: 10 });
    }
}
