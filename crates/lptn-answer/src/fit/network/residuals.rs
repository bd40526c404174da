//! Measured values next to those of the fitted network.

use lptn_solve::Table;
use lptn_units::Type;

use super::FitNetworkAnswer;
use super::units::Shown;

/// A value of a record with its column and time.
struct Sample<'a> {
    record: &'a str,
    column: &'a str,
    /// In s.
    time: f64,
    /// In SI units.
    measured: f64,
    computed: f64,
    shown: Shown,
}

impl FitNetworkAnswer {
    /// A row for each value, by record and column. Temperatures are in the unit of the netlist.
    /// If not all columns are temperatures, each value has its unit. A residual is positive if the
    /// measured value is larger than the computed one.
    pub fn residuals(&self) -> Table {
        let temperature = &self.input.netlist.temperature_unit;
        let samples = self.fit.columns.iter().flat_map(|m| {
            let run = &self.task.runs[m.run];
            let column = &run.columns[m.column];
            let values = run.times.iter().zip(&column.values).zip(&m.modelled);
            let sample = |((&time, &measured), &computed): ((&f64, &f64), &f64)| Sample {
                record: &run.name,
                column: &column.name,
                time,
                measured,
                computed,
                shown: Shown::of(column.ty, temperature),
            };
            // gaps of the record are not values
            values.map(sample).filter(|sample| sample.measured.is_finite()).collect::<Vec<_>>()
        });
        let samples: Vec<Sample<'_>> = samples.collect();
        let mixed = self.fit.columns.iter().any(|misfit| !self.column(misfit).ty.absolute);
        let kelvin = Shown::of(Type::ABSOLUTE_TEMPERATURE, temperature);
        let [unit, of_differences] = match mixed {
            true => ["unit"; 2].map(str::to_owned),
            false => [kelvin.unit.text, kelvin.of_differences],
        };
        let mut table = Table::of(&samples);
        table.label("record", |s| s.record.to_owned());
        table.label("column", |s| s.column.to_owned());
        if mixed {
            table.label("unit", |s| s.shown.unit.text.clone());
        }
        table.column("time", "s", |s| s.time);
        table.column("measured", &unit, |s| s.shown.unit.from_si(s.measured));
        table.column("computed", &unit, |s| s.shown.unit.from_si(s.computed));
        let residual = |s: &Sample<'_>| (s.measured - s.computed) / s.shown.unit.scale;
        table.column("residual", &of_differences, residual);
        table.done()
    }
}
