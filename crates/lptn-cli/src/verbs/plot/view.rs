//! The part of a figure that is shown, and the look of its picture.

use std::str::FromStr;

use clap::Args as Arguments;
use lptn_answer::failure::Failure;
use lptn_answer::input::{quantity, wrong_unit};
use lptn_answer::run::View;
use lptn_plot::chart::Layout;
use lptn_plot::{Figure, Theme};
use lptn_report::Canvas;
use lptn_units::{Dimension, Type, Unit};

use crate::options::one_of;

/// The most columns of a picture, pixels of its sides and pixels in an inch.
const MOST_COLUMNS: u64 = 12;
const MOST_PIXELS: f64 = 20_000.0;
const MOST_DPI: u64 = 1200;

/// The part of the curves that is shown, and how.
#[derive(Clone, Debug, Default, Arguments)]
#[command(next_help_heading = "Picture")]
pub(crate) struct ViewArgs {
    /// Begin the picture at this time, such as 2h
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    from: Option<String>,
    /// End the picture at this time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    to: Option<String>,
    /// Draw the mean of each day, in a band from its lowest to its highest value
    #[arg(long)]
    daily: bool,
    /// Show energies in kWh, MJ or another unit
    #[arg(long, value_name = "UNIT")]
    energy_unit: Option<String>,
    /// Write this title; "" for none
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Draw this wide, or this wide and high: 1200, 1200x800, 160x90mm, 6x4in
    #[arg(long, value_name = "SIZE")]
    size: Option<Size>,
    /// Place files, or the panels of one file, in this number of columns
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_COLUMNS))]
    pub(crate) columns: Option<u64>,
    /// Draw for a light or a dark background
    #[arg(long, value_name = "THEME", value_parser = one_of(&THEMES, key))]
    #[arg(hide_possible_values = true)]
    theme: Option<Theme>,
    /// Pixels of a PNG in an inch, such as 300 for print; default: 192
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(24..=MOST_DPI))]
    dpi: Option<u64>,
}

const THEMES: [Theme; 2] = [Theme::Light, Theme::Dark];

fn key(theme: Theme) -> &'static str {
    if theme == Theme::Light { "light" } else { "dark" }
}

/// Width and height of a picture in CSS pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Size(f64, Option<f64>);

/// CSS pixels in a unit of length.
const LENGTHS: [(&str, f64); 4] =
    [("px", 1.0), ("mm", 96.0 / 25.4), ("cm", 96.0 / 2.54), ("in", 96.0)];

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unit =
            LENGTHS.iter().find_map(|(unit, pixels)| Some((text.strip_suffix(unit)?, *pixels)));
        let (numbers, pixels) = unit.unwrap_or((text, 1.0));
        let length = |text: &str| {
            let value: f64 = text.trim().parse().ok()?;
            Some(value * pixels).filter(|value| (100.0..=MOST_PIXELS).contains(value))
        };
        let (width, height) = match numbers.split_once('x') {
            Some((width, height)) => (length(width), length(height).map(Some)),
            None => (length(numbers), Some(None)),
        };
        let wrong = "write a width, or width and height, of 100 to 20000 pixels: 1200, 1200x800, \
                     160x90mm, 6x4in";
        width.zip(height).map(|(width, height)| Self(width, height)).ok_or_else(|| wrong.into())
    }
}

impl ViewArgs {
    /// The figure as it is shown.
    ///
    /// # Errors
    /// Times and units that are none, and a part without curves.
    pub(crate) fn of(&self, mut figure: Figure) -> Result<Figure, Failure> {
        if let Some(unit) = &self.energy_unit {
            figure = figure.in_unit("J", (unit, 1.0 / energy(unit)?.scale));
        }
        if self.from.is_some() || self.to.is_some() {
            let had = !figure.panels.is_empty();
            figure = figure.between(self.span()?);
            if had && figure.panels.is_empty() {
                return Err(nothing_there());
            }
        }
        if self.daily {
            figure = figure.daily();
        }
        if let Some(title) = &self.title {
            figure.title.clone_from(title);
        }
        Ok(figure)
    }

    /// The part of a run that is shown.
    ///
    /// # Errors
    /// Times that are none.
    pub(crate) fn view(&self) -> Result<View, Failure> {
        let days_from = if self.daily { 0.0 } else { f64::INFINITY };
        Ok(View { span: self.span()?, days_from })
    }

    /// The times that are shown, in s.
    fn span(&self) -> Result<(f64, f64), Failure> {
        let time = |option: &str, text: &Option<String>, usual: f64| match text {
            Some(text) => quantity(option, text, Type::of(Dimension::TIME)).map(|time| time.value),
            None => Ok(usual),
        };
        let from = time("--from", &self.from, f64::NEG_INFINITY)?;
        let to = time("--to", &self.to, f64::INFINITY)?;
        match from < to {
            true => Ok((from, to)),
            false => Err(Failure::refused(
                "plot::span",
                "the picture would end before it begins",
                "give --to a later time than --from",
            )),
        }
    }

    /// Size, colours and resolution.
    pub(crate) fn canvas(&self) -> Canvas {
        let usual = Canvas::default();
        let Size(width, height) = self.size.unwrap_or(Size(usual.layout.width, None));
        let columns = self.columns.map_or(1, |columns| columns as usize);
        let layout = Layout { width, height, columns };
        let dpi = self.dpi.map_or(usual.dpi, |dpi| dpi as f64);
        Canvas { layout, theme: self.theme.unwrap_or(usual.theme), dpi }
    }
}

fn nothing_there() -> Failure {
    Failure::refused(
        "plot::span",
        "no curve has a value between --from and --to",
        "leave both out to see the times of the curves",
    )
}

/// A unit of energy.
fn energy(text: &str) -> Result<Unit, Failure> {
    let unit = Unit::parse(text).map_err(|error| wrong_unit("--energy-unit", text, &error))?;
    match Unit::parse("J").is_ok_and(|joule| joule.ty == unit.ty) {
        true => Ok(unit),
        false => Err(Failure::refused(
            "units::dimension",
            format!("--energy-unit must be a unit of energy, got `{text}`"),
            "choose J, kJ, MJ, Wh or kWh",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::Size;

    #[test]
    fn a_size_has_a_width_and_perhaps_a_height() {
        assert_eq!("1200".parse(), Ok(Size(1200.0, None)));
        assert_eq!("1200x800px".parse(), Ok(Size(1200.0, Some(800.0))));
        assert_eq!("6x4in".parse(), Ok(Size(576.0, Some(384.0))));
        for wrong in ["", "x", "10x10", "1200x", "6 x 4 ft", "nan", "1e9"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }
}
