//! Destination of a picture, and width of a terminal.

use std::path::PathBuf;
use std::str::FromStr;

use lptn_plot::Figure;
use lptn_report::{Canvas, Picture, WIDTH};

use crate::files;
use lptn_answer::failure::Failure;

/// Destination of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Drawing {
    /// To the terminal, in characters.
    Terminal,
    /// To a file.
    File(PathBuf, Picture),
}

impl FromStr for Drawing {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match Picture::of_name(text) {
            _ if text == "-" => Ok(Self::Terminal),
            Some(picture) => Ok(Self::File(text.into(), picture)),
            None => Err("a picture's name ends with .svg or .png; - draws it here".into()),
        }
    }
}

impl Drawing {
    /// Draws figures, and gives the file that was written.
    pub(crate) fn draw(
        &self,
        (figures, canvas): (&[Figure], &Canvas),
        styled: bool,
        show: impl FnOnce(&[u8]) -> Result<(), Failure>,
    ) -> Result<Option<String>, Failure> {
        if figures.iter().all(|figure| figure.panels.is_empty()) {
            return Err(nothing(&[]));
        }
        let (picture, file) = match self {
            Self::Terminal => (Picture::Text, None),
            Self::File(file, picture) => (*picture, Some(file)),
        };
        let bytes = picture
            .draw_on(canvas, figures, (terminal_width(), styled))
            .map_err(|error| Failure::of(&error))?;
        let Some(file) = file else { return show(&bytes).map(|()| None) };
        let help = "name another file for the picture";
        files::replace(file, &bytes).map_err(|failure| failure.with_help(help))?;
        Ok(Some(file.display().to_string()))
    }
}

/// Failure: a chart would be between numbers that a program reads.
pub(crate) fn not_here() -> Failure {
    let message = "`--plot -` draws below a table, but another format is requested";
    Failure::refused(
        "plot::not_here",
        message,
        "leave --format out, or name a file: --plot heat.svg",
    )
}

/// `drawn` are the verbs whose answer has a picture.
pub(crate) fn nothing(drawn: &[&str]) -> Failure {
    let drawn: Vec<&str> = drawn.iter().copied().filter(|verb| !verb.is_empty()).collect();
    let help = match drawn.is_empty() {
        true => "`lptn graph` draws the network".to_owned(),
        false => format!("{} have one", drawn.join(", ")),
    };
    Failure::refused("plot::nothing", "there is no picture of this answer", help)
}

/// Columns of the terminal that results go to; [`WIDTH`] if they go elsewhere.
pub(crate) fn terminal_width() -> usize {
    let told = std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok());
    told.or_else(asked).filter(|columns| *columns >= 20).unwrap_or(WIDTH)
}

fn asked() -> Option<usize> {
    terminal_size::terminal_size_of(std::io::stdout()).map(|(width, _)| usize::from(width.0))
}

#[cfg(test)]
mod tests {
    use super::Drawing;

    #[test]
    fn a_name_without_a_known_end_is_refused() {
        assert_eq!("-".parse(), Ok(Drawing::Terminal));
        assert!("a.svg".parse::<Drawing>().is_ok());
        assert!("a.pdf".parse::<Drawing>().unwrap_err().contains(".svg or .png"));
    }
}
