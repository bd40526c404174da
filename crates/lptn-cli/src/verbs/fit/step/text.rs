//! What came of `lptn fit step`, for reading.

use lptn_fit::step::{Estimated, Off, Parted};
use lptn_report::{
    Align, Column as TextColumn, Text, TextTable, WIDTH, plain, shortened, significant, stacked,
};

use super::estimate::{to_error, with_error};
use super::request::Reference;
use super::{Answer, Column};

/// Of a file in a sentence.
const LONGEST_NAME: usize = 40;

pub(crate) fn text(answer: &Answer<'_>) -> Text {
    let record = &answer.request.record;
    let (from, to) = (record.time.first().copied(), record.time.last().copied());
    let [from, to] = [from, to].map(|time| significant(time.unwrap_or(f64::NAN), 6));
    let name = shortened(&plain(&answer.request.name), LONGEST_NAME);
    let mut text = Text::titled(format!("{name}: {} rows from {from} s to {to} s", record.time.len()));
    text.line("T(t) = T_f + (T_i - T_f) exp(-t / t_RC), t from the first row");
    fits(answer, text.section());
    intervals(answer, text.section());
    rises(answer, text.section());
    bias(answer, text.section());
    text
}

/// A heading, and what stands below it for each column of the record.
type Cells<'c> = (String, &'c dyn Fn(&Column<'_>) -> String);

/// A table with a row for each column of the record: several below each other where one were too wide.
fn table(answer: &Answer<'_>, text: &mut Text, cells: &[Cells<'_>]) {
    let column = |title: &str, align, cell: &dyn Fn(&Column<'_>) -> String| {
        TextColumn::new(title, align, answer.columns.iter().map(cell).collect())
    };
    let names = column("column", Align::Left, &|column| plain(&column.column.name));
    let columns = cells.iter().map(|(title, cell)| column(title, Align::Right, cell)).collect();
    let fits =
        |table: &TextTable| table.clone().lines(WIDTH).iter().all(|line| line.chars().count() <= WIDTH);
    for table in stacked(&names, columns, fits) {
        text.table(table);
    }
}

fn fits(answer: &Answer<'_>, text: &mut Text) {
    let unit = &answer.request.unit;
    let temperature = |t: &Estimated| with_error(unit.from_si(t.value), t.standard_error / unit.scale);
    table(
        answer,
        text,
        &[
            (format!("T_i [{}]", unit.text), &|c| temperature(&c.fit.initial)),
            (format!("T_f [{}]", unit.text), &|c| temperature(&c.fit.settled)),
            ("t_RC [s]".to_owned(), &|c| with_error(c.fit.tau.value, c.fit.tau.standard_error)),
            ("rms [K]".to_owned(), &|c| significant(c.fit.rms, 3)),
            ("length/t_RC".to_owned(), &|c| significant(c.fit.time_constants(), 3)),
        ],
    );
}

/// How sure the numbers are.
fn intervals(answer: &Answer<'_>, text: &mut Text) {
    let unit = &answer.request.unit;
    let range = |t: &Estimated, of: &dyn Fn(f64) -> f64| {
        let (low, high) = t.interval();
        format!("{} .. {}", to_error(of(low), t.standard_error), to_error(of(high), t.standard_error))
    };
    let celsius = |si: f64| unit.from_si(si);
    table(
        answer,
        text,
        &[
            (format!("95 %: T_i [{}]", unit.text), &|c| range(&c.fit.initial, &celsius)),
            (format!("T_f [{}]", unit.text), &|c| range(&c.fit.settled, &celsius)),
            ("t_RC [s]".to_owned(), &|c| range(&c.fit.tau, &|s| s)),
            ("n_eff/n".to_owned(), &|c| format!("{:.0}/{}", c.fit.noise.effective, c.fit.samples)),
        ],
    );
    text.line("± is one standard error; n samples tell as much as n_eff independent ones");
}

/// dT, and with a capacity what follows from it.
fn rises(answer: &Answer<'_>, text: &mut Text) {
    text.sentence("", &reference(answer));
    if let Some(capacity) = &answer.request.capacity {
        let capacity = with_error(capacity.value, capacity.deviation.unwrap_or(0.0));
        text.sentence("", &format!("R_eq = t_RC / C and P_disp = dT / R_eq with C = {capacity} J/K"));
    }
    // one row for each number whose errors stand apart
    let mut rows: Vec<(String, &str, &Parted)> = Vec::new();
    for column in &answer.columns {
        let power = &column.power;
        rows.push((plain(&column.column.name), "dT [K]", &power.rise));
        if answer.request.capacity.is_some() {
            rows.push((String::new(), "R_eq [K/W]", &power.resistance));
            rows.push((String::new(), "P_disp [W]", &power.power));
        }
    }
    text.table(
        TextTable::of(&rows)
            .left("column", |row| row.0.as_str())
            .left("", |row| row.1)
            .right("", |row| to_error(row.2.value, least(row.2)))
            .right("± random", |row| error(row.2.random))
            .right("± systematic", |row| error(row.2.systematic)),
    );
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
fn bias(answer: &Answer<'_>, text: &mut Text) {
    let Some(model) = &answer.model else {
        text.sentence(
            "",
            "no ± includes the bias of the method: a body of several parts is no single exponential; \
             --model FILE --port NODE states it",
        );
        return;
    };
    let (unit, bias) = (&answer.request.unit, &model.bias);
    let signed = |value: f64| format!("{}{}", if value > 0.0 { "+" } else { "" }, significant(value, 3));
    // T_i, T_f, t_RC and P: how each is shown
    let row = |name, pick: fn(&Off) -> f64| {
        let temperature = |off: &Off| significant(unit.from_si(pick(off)), 6);
        let number = |off: &Off| significant(pick(off), 5);
        let [initial, settled] = [&bias.initial, &bias.settled].map(temperature);
        let [tau, power] = [&bias.tau, &bias.power].map(number);
        (name, [initial, settled, tau, power])
    };
    let off = [
        bias.initial.bias() / unit.scale,
        bias.settled.bias() / unit.scale,
        bias.tau.bias(),
        bias.power.bias(),
    ];
    let rows = [
        row("the network", |off| off.real),
        row("one exponential", |off| off.fitted),
        ("bias", off.map(signed)),
    ];
    text.sentence(
        "",
        &format!(
            "bias of the method on {} at `{}`, in no ± and not subtracted:",
            shortened(&plain(&model.file), LONGEST_NAME),
            plain(&model.port)
        ),
    );
    text.table(
        TextTable::of(&rows)
            .left("", |row| row.0)
            .right(format!("T_i [{}]", unit.text), |row| &row.1[0])
            .right(format!("T_f [{}]", unit.text), |row| &row.1[1])
            .right("t_RC [s]", |row| &row.1[2])
            .right("P [W]", |row| &row.1[3]),
    );
}
