//! What came of `lptn fit step`, for reading.

use lptn_report::{Align, Column as TextColumn, TextTable, WIDTH, labelled, plain, shortened, significant};
use lptn_study::fit::step::{Estimated, Off, Parted};

use super::estimate::{to_error, with_error};
use super::request::Reference;
use super::{Answer, Column};
use crate::console::Console;

/// Of a file in a sentence.
const LONGEST_NAME: usize = 40;

pub(crate) fn text(answer: &Answer<'_>, console: &Console) -> String {
    let mut lines = head(answer, console);
    lines.push(String::new());
    lines.extend(fits(answer));
    lines.push(String::new());
    lines.extend(intervals(answer));
    lines.push(String::new());
    lines.extend(rises(answer));
    lines.push(String::new());
    lines.extend(bias(answer));
    lines.join("\n") + "\n"
}

fn sentence(label: &str, text: &str) -> Vec<String> {
    let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
    labelled(label, &words, WIDTH)
}

fn head(answer: &Answer<'_>, console: &Console) -> Vec<String> {
    let record = &answer.request.record;
    let (from, to) = (record.time.first().copied(), record.time.last().copied());
    let [from, to] = [from, to].map(|time| significant(time.unwrap_or(f64::NAN), 6));
    let name = shortened(&plain(&answer.request.name), LONGEST_NAME);
    let title = format!("{name}: {} rows from {from} s to {to} s", record.time.len());
    let mut lines = vec![console.title(&title)];
    lines.push("T(t) = T_f + (T_i - T_f) exp(-t / t_RC), t from the first row".to_owned());
    lines
}

/// A heading, and what stands below it for each column of the record.
type Cells<'c> = (String, &'c dyn Fn(&Column<'_>) -> String);

/// The lines of a table with a row for each column of the record: of several below each other where one were too wide.
fn table(answer: &Answer<'_>, cells: &[Cells<'_>]) -> Vec<String> {
    let part = |cells: &[Cells<'_>]| {
        let names = answer.columns.iter().map(|column| plain(&column.column.name)).collect();
        let mut columns = vec![TextColumn::new("column", Align::Left, names)];
        columns.extend(cells.iter().map(|(title, cell)| {
            TextColumn::new(title.as_str(), Align::Right, answer.columns.iter().map(cell).collect())
        }));
        TextTable::new(columns).lines(WIDTH)
    };
    let fits = |lines: &[String]| lines.iter().all(|line| line.chars().count() <= WIDTH);
    let (mut done, mut from, mut lines) = (Vec::new(), 0, part(&cells[..1]));
    for to in 2..=cells.len() {
        let wider = part(&cells[from..to]);
        if fits(&wider) {
            lines = wider;
        } else {
            done.append(&mut lines);
            from = to - 1;
            lines = part(&cells[from..to]);
        }
    }
    done.append(&mut lines);
    done
}

fn fits(answer: &Answer<'_>) -> Vec<String> {
    let unit = &answer.request.unit;
    let temperature = |t: &Estimated| with_error(unit.from_si(t.value), t.standard_error / unit.scale);
    table(
        answer,
        &[
            (format!("T_i [{}]", unit.text), &|c| temperature(&c.fit.initial)),
            (format!("T_f [{}]", unit.text), &|c| temperature(&c.fit.settled)),
            ("t_RC [s]".to_owned(), &|c| with_error(c.fit.tau.value, c.fit.tau.standard_error)),
            ("rms [K]".to_owned(), &|c| significant(c.fit.rms, 3)),
            ("length/t_RC".to_owned(), &|c| significant(c.fit.time_constants(), 3)),
        ],
    )
}

/// How sure the numbers are.
fn intervals(answer: &Answer<'_>) -> Vec<String> {
    let unit = &answer.request.unit;
    let range = |t: &Estimated, of: &dyn Fn(f64) -> f64| {
        let (low, high) = t.interval();
        format!("{} .. {}", to_error(of(low), t.standard_error), to_error(of(high), t.standard_error))
    };
    let celsius = |si: f64| unit.from_si(si);
    let mut lines = table(
        answer,
        &[
            (format!("95 %: T_i [{}]", unit.text), &|c| range(&c.fit.initial, &celsius)),
            (format!("T_f [{}]", unit.text), &|c| range(&c.fit.settled, &celsius)),
            ("t_RC [s]".to_owned(), &|c| range(&c.fit.tau, &|s| s)),
            ("n_eff/n".to_owned(), &|c| format!("{:.0}/{}", c.fit.noise.effective, c.fit.samples)),
        ],
    );
    lines.push("± is one standard error; n samples tell as much as n_eff independent ones".to_owned());
    lines
}

/// dT, and with a capacity what follows from it.
fn rises(answer: &Answer<'_>) -> Vec<String> {
    let request = answer.request;
    let mut lines = sentence("", &reference(answer));
    if let Some(capacity) = &request.capacity {
        let capacity = with_error(capacity.value, capacity.deviation.unwrap_or(0.0));
        let text = format!("R_eq = t_RC / C and P_disp = dT / R_eq with C = {capacity} J/K");
        lines.extend(sentence("", &text));
    }
    lines.extend(parted(answer).lines(WIDTH));
    lines
}

/// One row for each number whose errors stand apart.
fn parted(answer: &Answer<'_>) -> TextTable {
    let mut cells: [Vec<String>; 5] = Default::default();
    for column in &answer.columns {
        let power = &column.power;
        let mut rows = vec![("dT [K]", &power.rise)];
        if answer.request.capacity.is_some() {
            rows.extend([("R_eq [K/W]", &power.resistance), ("P_disp [W]", &power.power)]);
        }
        for (i, (title, part)) in rows.into_iter().enumerate() {
            let name = if i == 0 { plain(&column.column.name) } else { String::new() };
            let row = [
                name,
                title.to_owned(),
                to_error(part.value, least(part)),
                error(part.random),
                error(part.systematic),
            ];
            cells.iter_mut().zip(row).for_each(|(cells, cell)| cells.push(cell));
        }
    }
    let [names, titles, values, random, systematic] = cells;
    TextTable::new(vec![
        TextColumn::new("column", Align::Left, names),
        TextColumn::new("", Align::Left, titles),
        TextColumn::new("", Align::Right, values),
        TextColumn::new("± random", Align::Right, random),
        TextColumn::new("± systematic", Align::Right, systematic),
    ])
}

/// The smaller of the two errors that is there: it says how many digits mean something.
fn least(part: &Parted) -> f64 {
    if part.systematic > 0.0 { part.random.min(part.systematic) } else { part.random }
}

fn error(error: f64) -> String {
    to_error(error, error)
}

/// From where dT is counted.
fn reference(answer: &Answer<'_>) -> String {
    let request = answer.request;
    let shown = |kelvin: f64, error: f64| {
        let unit = &request.unit;
        format!("{} {}", with_error(unit.from_si(kelvin), error / unit.scale), unit.text)
    };
    let first = answer.columns.first().map(|column| &column.power);
    let of = match (&request.reference, first) {
        (Reference::Column(_), Some(power)) => {
            let mean = shown(power.reference_temperature, power.reference_error);
            format!("the mean of `{}`, {mean}", plain(&power.reference))
        }
        (Reference::Value(kelvin), _) => shown(*kelvin, 0.0),
        _ => "T_i of the same column".to_owned(),
    };
    let class = match request.sensor {
        Some(class) => format!("sensors to ± {} K", significant(class, 3)),
        None => "sensors taken as exact (--sensor)".to_owned(),
    };
    format!("dT = T_f less {of} (--reference); {class}")
}

/// What the method itself gets wrong.
fn bias(answer: &Answer<'_>) -> Vec<String> {
    let Some(model) = &answer.model else {
        return sentence(
            "",
            "no ± includes the bias of the method: a body of several parts is no single exponential; \
             --model FILE --port NODE states it",
        );
    };
    let (unit, bias) = (&answer.request.unit, &model.bias);
    let row = |pick: &dyn Fn(&Off) -> f64| -> Vec<String> {
        let temperature = |off: &Off| significant(unit.from_si(pick(off)), 6);
        vec![
            temperature(&bias.initial),
            temperature(&bias.settled),
            significant(pick(&bias.tau), 5),
            significant(pick(&bias.power), 5),
        ]
    };
    let signed = |value: f64| format!("{}{}", if value > 0.0 { "+" } else { "" }, significant(value, 3));
    let off = vec![
        signed(bias.initial.bias() / unit.scale),
        signed(bias.settled.bias() / unit.scale),
        signed(bias.tau.bias()),
        signed(bias.power.bias()),
    ];
    let rows = [row(&|off| off.real), row(&|off| off.fitted), off];
    let titles =
        [format!("T_i [{}]", unit.text), format!("T_f [{}]", unit.text), "t_RC [s]".into(), "P [W]".into()];
    let names = ["the network", "one exponential", "bias"].map(str::to_owned).to_vec();
    let mut columns = vec![TextColumn::new("", Align::Left, names)];
    columns.extend(titles.into_iter().enumerate().map(|(i, title)| {
        TextColumn::new(title, Align::Right, rows.iter().map(|row| row[i].clone()).collect())
    }));
    let text = format!(
        "bias of the method on {} at `{}`, in no ± and not subtracted:",
        shortened(&plain(&model.file), LONGEST_NAME),
        plain(&model.port)
    );
    let mut lines = sentence("", &text);
    lines.extend(TextTable::new(columns).lines(WIDTH));
    lines
}
