//! Meanings of lines and areas, and the colour that each theme gives them.
//!
//! A shape has a meaning (`Ink::Limit`, `Ink::Series(2)`), and a theme gives it a colour. Tests
//! check the contrast by WCAG, and the distance of the first five curves for two kinds of
//! colour-blind readers.

/// Meaning of a line or an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The background.
    Paper,
    /// Titles and names.
    Text,
    /// Numbers at axes and other small print.
    Faint,
    /// Axes and outlines.
    Frame,
    /// Lines of a grid.
    Grid,
    /// A limit.
    Limit,
    /// One of several curves, by its place; after [`SERIES`] the colours repeat.
    Series(usize),
    /// A value on a scale from 0, cold, to [`FIELD`] - 1, hot.
    Field(usize),
}

/// Number of curves with different colours.
pub const SERIES: usize = 8;

/// Number of colours on the scale from cold to hot.
pub const FIELD: usize = 32;

/// The two backgrounds on which a picture is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theme {
    /// Paper.
    Light,
    /// A dark screen.
    Dark,
}

/// Red, green and blue of sRGB.
pub type Rgb = [u8; 3];

impl Ink {
    /// Every ink.
    pub fn all() -> impl Iterator<Item = Self> {
        let plain = [Self::Paper, Self::Text, Self::Faint, Self::Frame, Self::Grid, Self::Limit];
        plain.into_iter().chain((0..SERIES).map(Self::Series)).chain((0..FIELD).map(Self::Field))
    }

    /// Its name in style sheets.
    pub fn key(self) -> String {
        match self {
            Self::Paper => "paper".into(),
            Self::Text => "text".into(),
            Self::Faint => "faint".into(),
            Self::Frame => "frame".into(),
            Self::Grid => "grid".into(),
            Self::Limit => "limit".into(),
            Self::Series(place) => format!("series{}", place % SERIES),
            Self::Field(place) => format!("field{}", place.min(FIELD - 1)),
        }
    }

    /// Its colour.
    pub fn rgb(self, theme: Theme) -> Rgb {
        let [light, dark] = match self {
            Self::Paper => [[255, 255, 255], [20, 23, 28]],
            Self::Text => [[27, 31, 36], [230, 237, 243]],
            Self::Faint => [[87, 96, 106], [157, 167, 179]],
            Self::Frame => [[119, 128, 138], [124, 133, 144]],
            Self::Grid => [[228, 231, 235], [42, 48, 56]],
            Self::Limit => [[179, 38, 30], [255, 138, 128]],
            Self::Series(place) => SERIES_COLOURS[place % SERIES],
            Self::Field(place) => [field(place), field(place)],
        };
        match theme {
            Theme::Light => light,
            Theme::Dark => dark,
        }
    }

    /// Its colour as `#rrggbb`.
    pub fn hex(self, theme: Theme) -> String {
        let [r, g, b] = self.rgb(theme);
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Colours on paper and on a dark screen. A test checks that readers who see no red or no green can
/// distinguish the first five.
const SERIES_COLOURS: [[Rgb; 2]; SERIES] = [
    [[0, 98, 170], [108, 182, 255]],
    [[200, 80, 0], [255, 155, 87]],
    [[0, 128, 96], [70, 225, 180]],
    [[110, 10, 85], [235, 228, 90]],
    [[140, 80, 230], [255, 85, 140]],
    [[100, 92, 0], [170, 140, 255]],
    [[92, 92, 92], [184, 190, 198]],
    [[190, 20, 80], [200, 110, 180]],
];

/// The scale cividis of Nunez, Anderton and Renslow (PLoS ONE 13(7), 2018), made for readers with
/// and without colour vision deficiency: lightness grows evenly from blue to yellow. Colours are
/// interpolated linearly between those at 0, 1/8, … 1.
fn field(place: usize) -> Rgb {
    const KNOTS: [Rgb; 9] = [
        [0, 34, 78],
        [26, 56, 111],
        [65, 77, 107],
        [96, 99, 110],
        [124, 123, 120],
        [155, 148, 119],
        [188, 175, 111],
        [222, 204, 94],
        [254, 232, 56],
    ];
    let at = place.min(FIELD - 1) as f64 * (KNOTS.len() - 1) as f64 / (FIELD - 1) as f64;
    let below = (at.floor() as usize).min(KNOTS.len() - 2);
    let share = at - below as f64;
    let mixed = |i: usize| {
        let (a, b) = (f64::from(KNOTS[below][i]), f64::from(KNOTS[below + 1][i]));
        (a + (b - a) * share).round() as u8
    };
    [mixed(0), mixed(1), mixed(2)]
}

/// Contrast of two colours by WCAG 2.1, from 1 to 21.
pub fn contrast(a: Rgb, b: Rgb) -> f64 {
    let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
    a.max(b) / a.min(b)
}

/// Relative luminance by WCAG 2.1.
fn luminance(rgb: Rgb) -> f64 {
    let linear = |value: u8| {
        let value = f64::from(value) / 255.0;
        if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    };
    let [r, g, b] = rgb.map(linear);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

#[cfg(test)]
mod tests {
    use super::{Ink, SERIES, Theme, contrast};

    /// 21 for black on white is the definition; #777777 on white has 4.48 in the WCAG's examples.
    #[test]
    fn contrast_is_that_of_the_standard() {
        assert!((contrast([0; 3], [255; 3]) - 21.0).abs() < 1e-9);
        assert!((contrast([0x77; 3], [255; 3]) - 4.48).abs() < 0.005);
    }

    /// WCAG 2.1 requires 4.5 for text, such as names at curves, and 3 for lines.
    #[test]
    fn everything_that_is_read_stands_out_in_both_themes() {
        for theme in [Theme::Light, Theme::Dark] {
            let paper = Ink::Paper.rgb(theme);
            let texts = [Ink::Text, Ink::Faint, Ink::Limit];
            for ink in texts.into_iter().chain((0..SERIES).map(Ink::Series)) {
                assert!(contrast(ink.rgb(theme), paper) >= 4.5, "{ink:?} {theme:?}");
            }
            assert!(contrast(Ink::Frame.rgb(theme), paper) >= 3.0);
        }
    }

    /// Machado, Oliveira and Fernandes (2009), severity 1: protanopia and deuteranopia. The first
    /// five curves differ by 10 in CIELAB, about four times the just noticeable difference.
    #[test]
    fn the_first_curves_differ_for_readers_that_see_no_red_or_no_green() {
        const PROTAN: [[f64; 3]; 3] = [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ];
        const DEUTAN: [[f64; 3]; 3] = [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ];
        for theme in [Theme::Light, Theme::Dark] {
            for seen in [PROTAN, DEUTAN] {
                let colours: Vec<[f64; 3]> =
                    (0..5).map(|i| lab(Ink::Series(i).rgb(theme), seen)).collect();
                for (i, a) in colours.iter().enumerate() {
                    for (j, b) in colours.iter().enumerate().skip(i + 1) {
                        let apart = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
                        assert!(apart > 10.0, "{theme:?}: {i} and {j} are {apart:.1} apart");
                    }
                }
            }
        }
    }

    /// CIELAB under D65 of a colour seen through a matrix on linear RGB.
    fn lab(rgb: [u8; 3], seen: [[f64; 3]; 3]) -> [f64; 3] {
        let linear = rgb.map(|value| {
            let value = f64::from(value) / 255.0;
            if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        });
        let times = |m: [[f64; 3]; 3], v: [f64; 3]| {
            m.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>())
        };
        let xyz = times(
            [
                [0.412_456, 0.357_576, 0.180_437],
                [0.212_673, 0.715_152, 0.072_175],
                [0.019_334, 0.119_192, 0.950_304],
            ],
            times(seen, linear).map(|value| value.clamp(0.0, 1.0)),
        );
        let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
        let [x, y, z] = [f(xyz[0] / 0.950_47), f(xyz[1]), f(xyz[2] / 1.088_83)];
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }
}
