//! Draws a slice of a field.

use lptn_network::Form;
use lptn_plot::contour::{Lattice, levels};
use lptn_plot::font::width;
use lptn_plot::scene::{Align, Path, Step, Stroke, Text, circle, line, rectangle};
use lptn_plot::{FIELD, Ink, Scene};
use lptn_report::{plain, prefix, significant};
use lptn_units::Unit;

use crate::field::{Cut, GridField, position};
use crate::legend::{BAR, scale};
use crate::ring::Sector;
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
const SMALL: f64 = 10.0;

/// The colours of a slice.
#[derive(Clone, Copy, Debug)]
pub struct Shades {
    /// The temperatures in K of the coldest and of the hottest colour; `None` for those of the
    /// grid.
    pub span: Option<[f64; 2]>,
    /// True if few cells have tooltips.
    pub tips: bool,
}

impl Default for Shades {
    fn default() -> Self {
        Self { span: None, tips: true }
    }
}

/// Most isotherms of a slice.
const ISOTHERMS: usize = 8;

/// A slice of a field as a drawing: its cells coloured by their temperatures, isotherms, and the
/// hottest cell of the grid if it is in the layer.
pub fn slice(field: &GridField, cut: Cut, (title, unit): (&str, &Unit), shades: Shades) -> Scene {
    let along: Vec<usize> = (0..3).filter(|axis| *axis != cut.axis).collect();
    let span = shades.span.unwrap_or_else(|| field.span());
    let sheet = Sheet { shades, span, ..Sheet::of(field, cut, [along[0], along[1]]) };
    let words = Scale::new(unit, span[1] - span[0]);
    let title = sheet.title(title);
    let wide = width(&title, 16.0, true).max(AXIS.0 + sheet.size.0 + 20.0).max(BAR.0);
    let tall = 38.0 + sheet.size.1 + AXIS.1 + 24.0 + BAR.1 + 40.0;
    let mut scene = Scene::new((wide + 2.0 * MARGIN, tall + 2.0 * MARGIN), title.clone());
    scene.write(Text::new(title, (MARGIN, MARGIN + 12.0), 16.0, Ink::Text).bold());
    let corner = (MARGIN + AXIS.0, MARGIN + 48.0);
    sheet.cells(&mut scene, corner, &words);
    let levels = sheet.isotherms(&mut scene, corner, unit);
    sheet.mark_hottest(&mut scene, corner);
    sheet.axes(&mut scene, corner);
    let below = corner.1 + sheet.size.1 + AXIS.1 + 14.0;
    let caption = format!("{}; {}", field.caption, sheet.hottest(&words));
    let ends = span.map(|kelvin| words.text(kelvin));
    // isotherms mark the bar themselves
    let marks = if levels.is_empty() { words.ticks(span) } else { Vec::new() };
    scale(&mut scene, (&ends, &marks), &caption, (corner.0, below));
    ticks(&mut scene, &levels, (span, unit), (corner.0, below));
    scene
}

/// A slice on its way to the page.
struct Sheet<'a> {
    field: &'a GridField,
    cut: Cut,
    /// The axes to the right and upwards.
    axes: [usize; 2],
    /// The first and the last position to the right and upwards in m.
    ends: [[f64; 2]; 2],
    /// Width and height in pixels.
    size: (f64, f64),
    true_to_scale: bool,
    shades: Shades,
    /// The temperatures of the coldest and of the hottest colour in K.
    span: [f64; 2],
}

impl<'a> Sheet<'a> {
    fn of(field: &'a GridField, cut: Cut, axes: [usize; 2]) -> Self {
        let ends = match along_axis(field, cut) {
            true => whole(field).extent(),
            false => axes.map(|axis| field.ends(axis).map(|end| end * arm(field, cut, axis))),
        };
        let [right, up] = ends.map(|[low, high]| high - low);
        let scale = (ROOM.0 / right).min(ROOM.1 / up);
        let (wide, tall) = (right * scale, up * scale);
        let size = (wide.clamp(LEAST, ROOM.0), tall.clamp(LEAST, ROOM.1));
        let true_to_scale = wide >= LEAST && tall >= LEAST;
        let shades = Shades::default();
        Self { field, cut, axes, ends, size, true_to_scale, shades, span: field.span() }
    }

    fn title(&self, title: &str) -> String {
        let Self { field, cut, .. } = self;
        let letter = field.form.directions()[cut.axis];
        let place = position(letter, field.along[cut.axis].nodes[cut.layer]);
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
        if along_axis(self.field, self.cut) {
            return self.sectors(scene, (x, y), words);
        }
        let (columns, rows) = self.counts();
        let tall = self.size.1 / rows as f64;
        let span = self.span;
        let told = self.shades.tips && columns * rows <= MOST_TIPS;
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
                let (left, wide) = self.columns(column, end);
                let size = (wide + over(end == columns), tall + over(row == 0));
                let piece = rectangle((x + left, top), size, 0.0).filled(ink, 1.0);
                scene.put(if told { self.tipped(piece, at, words) } else { piece });
                column = end;
            }
        }
        scene.put(rectangle((x, y), self.size, 0.0).stroked(Stroke::solid(Ink::Frame, 1.0)));
    }

    /// A piece with the name and the temperature of its cell.
    fn tipped(&self, piece: Path, at: [usize; 3], words: &Scale<'_>) -> Path {
        piece.tipped(format!("{}: {}", self.field.cell(at), words.text(self.field.at(at))))
    }

    /// Start and width of some columns in pixels. Those along r differ.
    fn columns(&self, from: usize, to: usize) -> (f64, f64) {
        let (columns, _) = self.counts();
        if self.axes[0] != 0 || !self.field.is_round() {
            let wide = self.size.0 / columns as f64;
            return (wide * from as f64, wide * (to - from) as f64);
        }
        let [low, high] = self.ends[0];
        let borders = &self.field.along[0].borders;
        let [left, right] =
            [from, to].map(|border| self.size.0 * (borders[border] - low) / (high - low));
        (left, right - left)
    }

    /// Draws the cells of a layer of a cylinder as sectors of rings.
    fn sectors(&self, scene: &mut Scene, (x, y): (f64, f64), words: &Scale<'_>) {
        let [[left, right], [_, top]] = self.ends;
        let scale = self.size.0 / (right - left);
        let centre = (x - left * scale, y + top * scale);
        let (rings, around) = self.counts();
        let span = self.span;
        for (i, j) in (0..rings).flat_map(|i| (0..around).map(move |j| (i, j))) {
            let at = self.at(i, j);
            let pair = |axis: usize, k: usize| {
                let borders = &self.field.along[axis].borders;
                [borders[k], borders[k + 1]]
            };
            let sector = Sector { radii: pair(0, i), angles: pair(1, j) };
            let piece = sector.drawn(centre, scale).filled(self.ink(at, span), 1.0);
            let told = self.shades.tips && rings * around <= MOST_TIPS;
            scene.put(if told { self.tipped(piece, at, words) } else { piece });
        }
        let pen = Stroke::solid(Ink::Frame, 1.0);
        let Form::Cylinder { closed: true, .. } = self.field.form else {
            return scene.put(whole(self.field).drawn(centre, scale).stroked(pen));
        };
        let radii = self.field.ends(0).into_iter().filter(|radius| *radius > 0.0);
        radii.for_each(|radius| scene.put(circle(centre, radius * scale).stroked(pen)));
    }

    /// Draws isotherms between the nodes of the cells, and returns their temperatures in `unit`.
    fn isotherms(&self, scene: &mut Scene, corner: (f64, f64), unit: &Unit) -> Vec<f64> {
        let (columns, rows) = self.counts();
        if columns < 2 || rows < 2 {
            return Vec::new();
        }
        let [right, up] = self.axes.map(|axis| &self.field.along[axis].nodes);
        let values = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let shown = |(column, row)| unit.from_si(self.field.at(self.at(column, row)));
        let lattice =
            Lattice { x: right.clone(), y: up.clone(), values: values.map(shown).collect() };
        let [low, high] = self.span.map(|kelvin| unit.from_si(kelvin));
        let found = levels((low, high), ISOTHERMS);
        for level in &found {
            let points = lattice.line(*level);
            let pieces = points.split(|point| !point.0.is_finite());
            let steps = pieces
                .flat_map(|ends| line(ends.iter().map(|point| self.on_page(*point, corner))).steps);
            let steps: Vec<Step> = steps.collect();
            if !steps.is_empty() {
                let tip = format!("{} {}", significant(*level, 6), unit.text);
                let pen = Stroke::solid(Ink::Paper, 1.2);
                scene.put(Path::new(steps).stroked(pen).tipped(tip));
            }
        }
        found
    }

    /// The place on the page of a position along both axes, in m, along phi in rad.
    fn on_page(&self, (right, up): (f64, f64), (x, y): (f64, f64)) -> (f64, f64) {
        let [[left, end], [low, top]] = self.ends;
        let (right, up) = match along_axis(self.field, self.cut) {
            true => (right * up.cos(), right * up.sin()),
            false => {
                let arm = |side: usize| arm(self.field, self.cut, self.axes[side]);
                (right * arm(0), up * arm(1))
            }
        };
        let across = self.size.0 * (right - left) / (end - left);
        (x + across, y + self.size.1 * (top - up) / (top - low))
    }

    /// Marks the hottest cell of the grid if it is in the layer.
    fn mark_hottest(&self, scene: &mut Scene, corner: (f64, f64)) {
        let field = self.field;
        let hottest = field.hottest().filter(|at| at[self.cut.axis] == self.cut.layer);
        if let Some(at) = hottest {
            let [right, up] = self.axes.map(|axis| field.along[axis].nodes[at[axis]]);
            let tip = format!("hottest cell: {}", field.cell(at));
            let ring = circle(self.on_page((right, up), corner), 5.0);
            scene.put(ring.stroked(Stroke::solid(Ink::Limit, 2.0)).tipped(tip));
        }
    }

    /// The name of a side: of a layer of a cylinder x and y, of one of its rings the arc.
    fn side(&self, side: usize) -> &'static str {
        let axis = self.axes[side];
        match self.field.is_round() {
            true if along_axis(self.field, self.cut) => ["x", "y"][side],
            true if axis == 1 => "arc",
            _ => self.field.form.directions()[axis],
        }
    }

    /// Lengths along both sides.
    fn axes(&self, scene: &mut Scene, (x, y): (f64, f64)) {
        let [[left, right], [low, high]] = self.ends;
        let bottom = y + self.size.1;
        let (scale, letter) = prefix(right.max(high));
        let pen = Stroke::solid(Ink::Frame, 1.0);
        let mut write = |text: String, at, align| {
            scene.write(Text::new(text, at, SIZE, Ink::Faint).aligned(align));
        };
        let unit = format!("{}m", if letter == "u" { "µ" } else { letter });
        let name = |side: usize| format!("{} [{unit}]", self.side(side));
        write(name(0), (x + self.size.0 / 2.0, bottom + 38.0), Align::Middle);
        write(name(1), (x - AXIS.0 + 2.0, y - 14.0), Align::Start);
        let mut ticks = Vec::new();
        for place in marks([left, right], self.size.0) {
            let at = x + self.size.0 * (place - left) / (right - left);
            write(significant(place / scale, 4), (at, bottom + 19.0), Align::Middle);
            ticks.push([(at, bottom), (at, bottom + 5.0)]);
        }
        for place in marks([low, high], self.size.1) {
            let at = bottom - self.size.1 * (place - low) / (high - low);
            write(significant(place / scale, 4), (x - 8.0, at + 4.0), Align::End);
            ticks.push([(x, at), (x - 5.0, at)]);
        }
        ticks.into_iter().for_each(|tick| scene.put(line(tick).stroked(pen)));
    }
}

/// Marks the isotherms on the scale.
fn ticks(scene: &mut Scene, levels: &[f64], (span, unit): ([f64; 2], &Unit), (x, y): (f64, f64)) {
    let [low, high] = span.map(|kelvin| unit.from_si(kelvin));
    let mut free = f64::NEG_INFINITY;
    for level in levels {
        let at = x + BAR.0 * (level - low) / (high - low);
        let stroke = Stroke::solid(Ink::Paper, 1.2);
        scene.put(line([(at, y), (at, y + BAR.1)]).stroked(stroke));
        let text = significant(*level, 6);
        let half = width(&text, SMALL, false) / 2.0;
        if at - half > free {
            let text = Text::new(text, (at, y - 4.0), SMALL, Ink::Faint);
            scene.write(text.aligned(Align::Middle));
            free = at + half + 4.0;
        }
    }
}

/// True for a layer of a cylinder that is seen along its axis.
fn along_axis(field: &GridField, cut: Cut) -> bool {
    field.is_round() && cut.axis == 2
}

/// A layer of a cylinder as a whole.
fn whole(field: &GridField) -> Sector {
    Sector { radii: field.ends(0), angles: field.ends(1) }
}

/// The factor by which positions along an axis become lengths: for angles the radius of the ring.
fn arm(field: &GridField, cut: Cut, axis: usize) -> f64 {
    if field.is_round() && axis == 1 { field.along[0].nodes[cut.layer] } else { 1.0 }
}

/// Round places between two ends in m, along a side that takes `pixels`.
fn marks([low, high]: [f64; 2], pixels: f64) -> Vec<f64> {
    let most = (pixels / 60.0).clamp(1.0, 8.0);
    let least = (high - low) / most;
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|s| *s >= least * 0.999);
    let Some(step) = step.filter(|step| step.is_finite()) else { return Vec::new() };
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let count = (last - first).max(0.0) as usize;
    (0..=count).map(|i| (first + i as f64) * step).collect()
}

#[cfg(test)]
mod tests {
    use super::marks;

    #[test]
    fn marks_are_round_and_inside() {
        let found = |ends| -> Vec<String> {
            marks(ends, 400.0).iter().map(|x| format!("{x:.3}")).collect()
        };
        assert_eq!(found([0.0, 0.2]), ["0.000", "0.050", "0.100", "0.150", "0.200"]);
        assert_eq!(found([-0.09, 0.11]), ["-0.050", "0.000", "0.050", "0.100"]);
        assert_eq!(marks([0.0, f64::NAN], 100.0).len(), 0);
    }
}
