//! The words at an element, and the room that they take.

use lptn_plot::font::width;
use lptn_report::shortened;

use crate::layout::Room;

/// Sizes of letters: names, values, small print.
pub(crate) const NAME: f64 = 13.0;
pub(crate) const VALUE: f64 = 12.0;
pub(crate) const SMALL: f64 = 11.0;

/// From one line of text to the next.
pub(crate) const LINE: f64 = 15.0;

/// Letters of a name that are shown; a reader who points at it sees all.
pub(crate) const LETTERS: usize = 30;

/// The arrow of a heat flow and the gap before its words.
pub(crate) const ARROW: f64 = 34.0;
pub(crate) const ARROW_GAP: f64 = 6.0;

/// The room of an element with its name above its symbol, and lines and a heat flow below.
pub(crate) fn element_block(
    name: &str,
    below: &[String],
    (flow, pin, reach): (Option<&str>, f64, f64),
) -> Room {
    let name = width(&shortened(name, LETTERS), NAME, false);
    let texts = below.iter().map(|text| width(text, VALUE, false));
    let flow_width = flow.map_or(0.0, |text| ARROW + ARROW_GAP + width(text, VALUE, true));
    let wide = texts.fold(name.max(flow_width), f64::max);
    let lines = below.len() + usize::from(flow.is_some());
    Room {
        pin,
        half: (wide / 2.0 + 6.0).max(pin + 6.0).ceil(),
        above: reach + LINE + 3.0,
        below: reach + LINE * lines as f64 + 3.0,
    }
}
