//! The formats in which figures are drawn.

use lptn_plot::{Figure, PngError, chart, png, svg, terminal};

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

/// Pixels of a PNG per CSS pixel: 192 per inch.
const SCALE: f64 = 2.0;

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
    pub fn draw(
        self,
        figures: &[Figure],
        (columns, styled): (usize, bool),
    ) -> Result<Vec<u8>, PngError> {
        match self {
            Self::Svg => Ok(svg::write(&chart::scene(figures, WIDTH)).into_bytes()),
            Self::Png => png::write(&chart::scene(figures, WIDTH), SCALE),
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
