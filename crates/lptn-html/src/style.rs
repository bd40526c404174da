//! The look of the page, with the colours of the pictures in both themes.

use lptn_plot::{Ink, Theme};

const UPLOT: &str = include_str!("../assets/uPlot.min.css");

const PAGE: &str = include_str!("../assets/page.css");

/// The style sheet. Both themes are for screens: print is always light.
pub(crate) fn sheet() -> String {
    let (light, dark) = (colours(Theme::Light), colours(Theme::Dark));
    let mut sheet = format!(
        ":root{{{light}}}\n\
         @media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]){{{dark}}}}}\n\
         @media screen{{:root[data-theme=dark]{{{dark}}}}}\n"
    );
    for ink in Ink::all() {
        let key = ink.key();
        sheet += &format!(".f-{key}{{fill:var(--{key})}}.s-{key}{{stroke:var(--{key})}}");
        if let Ink::Series(_) = ink {
            sheet += &format!(".spark.c-{key}{{color:var(--{key})}}");
        }
    }
    format!("{sheet}\n{UPLOT}\n{PAGE}")
}

fn colours(theme: Theme) -> String {
    let scheme = if theme == Theme::Light { "light" } else { "dark" };
    let colour = |ink: Ink| format!("--{}:{};", ink.key(), ink.hex(theme));
    format!("color-scheme:{scheme};{}", Ink::all().map(colour).collect::<String>())
}
