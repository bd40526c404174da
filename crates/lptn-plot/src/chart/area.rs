//! Position of a panel on the page, and sizes of its texts.

use crate::font::width;
use crate::ticks::Ruler;

/// Text sizes in pixels: title, names, numbers.
pub(crate) const TITLE: f64 = 15.0;
pub(crate) const NAME: f64 = 12.0;
pub(crate) const SMALL: f64 = 11.0;

/// The area of a panel's curves, in pixels, and its two axes.
#[derive(Debug)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
    pub(crate) x: Ruler,
    pub(crate) y: Ruler,
    /// True if y grows downwards: a list is read from the top.
    pub(crate) downward: bool,
}

impl Area {
    pub(crate) fn x_at(&self, value: f64) -> f64 {
        self.left + self.x.place(value) * (self.right - self.left)
    }

    pub(crate) fn y_at(&self, value: f64) -> f64 {
        let place = self.y.place(value);
        let place = if self.downward { 1.0 - place } else { place };
        self.bottom - place * (self.bottom - self.top)
    }

    /// The edge that a height on the page is beyond, and true if that is the upper one.
    pub(crate) fn edge(&self, y: f64) -> Option<(f64, bool)> {
        match (y < self.top, y > self.bottom) {
            (true, _) => Some((self.top, true)),
            (_, true) => Some((self.bottom, false)),
            _ => None,
        }
    }

    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }
}

/// A text that is not wider than `room`, shortened with an ellipsis if necessary.
pub(crate) fn shortened(text: &str, size: f64, room: f64) -> String {
    if width(text, size, false) <= room {
        return text.to_owned();
    }
    let mut short: String = text.to_owned();
    while short.pop().is_some() {
        let cut = format!("{}\u{2026}", short.trim_end());
        if width(&cut, size, false) <= room {
            return cut;
        }
    }
    "\u{2026}".into()
}
