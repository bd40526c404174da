//! Draws a slice of a field.

use lptn_plot::font::width;
use lptn_plot::scene::{Align, Stroke, Text, line, rectangle};
use lptn_plot::{FIELD, Ink, Scene};
use lptn_report::{plain, prefix, significant};
use lptn_units::Unit;

use crate::field::{AXES, Cut, GridField};
use crate::legend::{BAR, scale};
use crate::words::Scale;

/// The room that the cells of a slice have.
const ROOM: (f64, f64) = (760.0, 460.0);

/// A side is not drawn narrower than this.
const LEAST: f64 = 48.0;

/// If there are more cells than this, they have no separate labels.
const MOST_TIPS: usize = 2500;

const MARGIN: f64 = 24.0;
const AXIS: (f64, f64) = (58.0, 44.0);
const SIZE: f64 = 12.0;

/// A slice of a field as a drawing: its cells coloured by their temperatures, on the scale of the
/// whole grid.
pub fn slice(field: &GridField, cut: Cut, title: &str, unit: &Unit) -> Scene {
    let along: Vec<usize> = (0..3).filter(|axis| *axis != cut.axis).collect();
    let sheet = Sheet::of(field, cut, [along[0], along[1]]);
    let span = field.span();
    let words = Scale::new(unit, span[1] - span[0]);
    let title = sheet.title(title);
    let wide = width(&title, 16.0, true).max(AXIS.0 + sheet.size.0 + 20.0).max(BAR.0);
    let tall = 38.0 + sheet.size.1 + AXIS.1 + 24.0 + BAR.1 + 40.0;
    let mut scene = Scene::new((wide + 2.0 * MARGIN, tall + 2.0 * MARGIN), title.clone());
    scene.write(Text::new(title, (MARGIN, MARGIN + 12.0), 16.0, Ink::Text).bold());
    let corner = (MARGIN + AXIS.0, MARGIN + 48.0);
    sheet.cells(&mut scene, corner, &words);
    sheet.axes(&mut scene, corner);
    let below = corner.1 + sheet.size.1 + AXIS.1 + 14.0;
    let caption = format!("{}; {}", field.caption, sheet.hottest(&words));
    let ends = span.map(|kelvin| words.text(kelvin));
    scale(&mut scene, &ends, &caption, (corner.0, below));
    scene
}

/// A slice on its way to the page.
struct Sheet<'a> {
    field: &'a GridField,
    cut: Cut,
    /// The axes to the right and upwards.
    axes: [usize; 2],
    /// Width and height in pixels.
    size: (f64, f64),
    true_to_scale: bool,
}

impl<'a> Sheet<'a> {
    fn of(field: &'a GridField, cut: Cut, axes: [usize; 2]) -> Self {
        let [right, up] = axes.map(|axis| field.size[axis]);
        let scale = (ROOM.0 / right).min(ROOM.1 / up);
        let (wide, tall) = (right * scale, up * scale);
        let size = (wide.clamp(LEAST, ROOM.0), tall.clamp(LEAST, ROOM.1));
        let true_to_scale = wide >= LEAST && tall >= LEAST;
        Self { field, cut, axes, size, true_to_scale }
    }

    fn title(&self, title: &str) -> String {
        let Self { field, cut, .. } = self;
        let place = length(field.centre([cut.layer; 3])[cut.axis]);
        let letter = AXES[cut.axis];
        let note = if self.true_to_scale { "" } else { ", not to scale" };
        let (name, layers) = (&field.name, field.cells[cut.axis]);
        let where_from = match plain(title) {
            title if title.is_empty() || title == *name => String::new(),
            title => format!("{title}: "),
        };
        format!(
            "{where_from}{name} at {letter} = {place}, layer {} of {layers}{note}",
            cut.layer + 1
        )
    }

    /// The indices of a cell by its column and row.
    fn at(&self, column: usize, row: usize) -> [usize; 3] {
        let mut at = [self.cut.layer; 3];
        at[self.axes[0]] = column;
        at[self.axes[1]] = row;
        at
    }

    fn counts(&self) -> (usize, usize) {
        (self.field.cells[self.axes[0]], self.field.cells[self.axes[1]])
    }

    /// The hottest cell of the slice.
    fn hottest(&self, words: &Scale<'_>) -> String {
        let (columns, rows) = self.counts();
        let all = (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r)));
        let hottest = all
            .map(|(c, r)| self.at(c, r))
            .reduce(|a, b| if self.field.at(b) > self.field.at(a) { b } else { a });
        hottest.map_or_else(String::new, |at| {
            format!("hottest here: {} at {}", words.text(self.field.at(at)), self.field.cell(at))
        })
    }

    fn ink(&self, at: [usize; 3], [low, high]: [f64; 2]) -> Ink {
        let share = if high > low { (self.field.at(at) - low) / (high - low) } else { 0.5 };
        Ink::Field((share.clamp(0.0, 1.0) * (FIELD - 1) as f64).round() as usize)
    }

    /// Draws the cells. Neighbours of one colour are one piece, unless the cells are few enough for
    /// separate labels.
    fn cells(&self, scene: &mut Scene, (x, y): (f64, f64), words: &Scale<'_>) {
        let (columns, rows) = self.counts();
        let (wide, tall) = (self.size.0 / columns as f64, self.size.1 / rows as f64);
        let span = self.field.span();
        let told = columns * rows <= MOST_TIPS;
        for row in 0..rows {
            let top = y + tall * (rows - 1 - row) as f64;
            let mut column = 0;
            while column < columns {
                let at = self.at(column, row);
                let ink = self.ink(at, span);
                let same = (column + 1..columns)
                    .take_while(|next| !told && self.ink(self.at(*next, row), span) == ink)
                    .count();
                let end = column + 1 + same;
                // a little wider, so that no paper shows between them
                let over = |last: bool| if last { 0.0 } else { 0.4 };
                let size =
                    (wide * (end - column) as f64 + over(end == columns), tall + over(row == 0));
                let piece = rectangle((x + wide * column as f64, top), size, 0.0).filled(ink, 1.0);
                scene.put(match told {
                    true => {
                        let text = words.text(self.field.at(at));
                        piece.tipped(format!("{}: {text}", self.field.cell(at)))
                    }
                    false => piece,
                });
                column = end;
            }
        }
        scene.put(rectangle((x, y), self.size, 0.0).stroked(Stroke::solid(Ink::Frame, 1.0)));
    }

    /// Lengths along both sides.
    fn axes(&self, scene: &mut Scene, (x, y): (f64, f64)) {
        let [right, up] = self.axes.map(|axis| self.field.size[axis]);
        let bottom = y + self.size.1;
        let (scale, letter) = prefix(right.max(up));
        let pen = Stroke::solid(Ink::Frame, 1.0);
        let mut write = |text: String, at, align| {
            scene.write(Text::new(text, at, SIZE, Ink::Faint).aligned(align));
        };
        let unit = format!("{}m", if letter == "u" { "µ" } else { letter });
        let name = |axis: usize| format!("{} [{unit}]", AXES[axis]);
        write(name(self.axes[0]), (x + self.size.0 / 2.0, bottom + 38.0), Align::Middle);
        write(name(self.axes[1]), (x - AXIS.0 + 2.0, y - 14.0), Align::Start);
        let mut ticks = Vec::new();
        for place in marks(right, self.size.0) {
            let at = x + self.size.0 * place / right;
            write(significant(place / scale, 4), (at, bottom + 19.0), Align::Middle);
            ticks.push([(at, bottom), (at, bottom + 5.0)]);
        }
        for place in marks(up, self.size.1) {
            let at = bottom - self.size.1 * place / up;
            write(significant(place / scale, 4), (x - 8.0, at + 4.0), Align::End);
            ticks.push([(x, at), (x - 5.0, at)]);
        }
        ticks.into_iter().for_each(|tick| scene.put(line(tick).stroked(pen)));
    }
}

/// Round places from 0 on, along a side of `length` in m that takes `pixels`.
fn marks(length: f64, pixels: f64) -> Vec<f64> {
    let most = (pixels / 60.0).clamp(1.0, 8.0);
    let least = length / most;
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|s| *s >= least * 0.999);
    let Some(step) = step.filter(|step| step.is_finite()) else { return Vec::new() };
    let count = (length / step + 1e-9).floor() as usize;
    (0..=count).map(|i| i as f64 * step).collect()
}

fn length(metres: f64) -> String {
    crate::words::si(metres, "m")
}

#[cfg(test)]
mod tests {
    use super::marks;

    #[test]
    fn marks_are_round_and_inside() {
        let found: Vec<String> = marks(0.2, 400.0).iter().map(|x| format!("{x:.3}")).collect();
        assert_eq!(found, ["0.000", "0.050", "0.100", "0.150", "0.200"]);
        assert_eq!(marks(f64::NAN, 100.0).len(), 0);
    }
}
