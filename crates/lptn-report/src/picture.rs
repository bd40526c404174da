//! The formats in which figures are drawn.

use lptn_plot::chart::Layout;
use lptn_plot::{Figure, PngError, Theme, chart, png, svg, terminal};

/// Format of a drawn figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// Lines that stay sharp at any size.
    Svg,
    /// Pixels.
    Png,
    /// Characters.
    Text,
}

/// Width of a picture in CSS pixels: that of a page's text.
const WIDTH: f64 = 760.0;

/// Pixels of a PNG in an inch.
const DPI: f64 = 192.0;

/// CSS pixels in an inch.
const CSS: f64 = 96.0;

/// Size, colours and resolution of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Canvas {
    /// Size in CSS pixels, and arrangement.
    pub layout: Layout,
    /// Its colours.
    pub theme: Theme,
    /// Pixels of a PNG in an inch.
    pub dpi: f64,
}

impl Default for Canvas {
    fn default() -> Self {
        let layout = Layout { width: WIDTH, height: None, columns: 1 };
        Self { layout, theme: Theme::Light, dpi: DPI }
    }
}

impl Picture {
    /// The format that belongs to the extension of a file's name.
    pub fn of_name(name: &str) -> Option<Self> {
        match name.rsplit_once('.')?.1.to_ascii_lowercase().as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }

    /// Draws figures below each other.
    /// Characters are `columns` wide, with colours if they are `styled`.
    ///
    /// # Errors
    /// [`PngError`]
    pub fn draw(self, figures: &[Figure], terminal: (usize, bool)) -> Result<Vec<u8>, PngError> {
        self.draw_on(&Canvas::default(), figures, terminal)
    }

    /// The same on a canvas, which characters do not use.
    ///
    /// # Errors
    /// [`PngError`]
    pub fn draw_on(
        self,
        canvas: &Canvas,
        figures: &[Figure],
        (columns, styled): (usize, bool),
    ) -> Result<Vec<u8>, PngError> {
        let scene = || chart::arranged(figures, &canvas.layout);
        match self {
            Self::Svg => Ok(svg::write_in(&scene(), canvas.theme).into_bytes()),
            Self::Png => png::write_in(&scene(), canvas.dpi / CSS, canvas.theme),
            Self::Text => {
                let texts: Vec<String> =
                    figures.iter().map(|figure| terminal::write(figure, columns, styled)).collect();
                Ok(texts.join("\n").into_bytes())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Picture;

    #[test]
    fn the_end_of_a_name_says_the_format() {
        let found = ["a.svg", "out/b.PNG", "c.pdf", "svg"].map(Picture::of_name);
        assert_eq!(found, [Some(Picture::Svg), Some(Picture::Png), None, None]);
    }
}
