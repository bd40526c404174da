//! Rows that are words, column by column.

/// The cells of a column.
enum Cells {
    Numbers { unit: String, values: Vec<f64> },
    Words(Vec<String>),
}

/// Names and cells of all columns.
pub(crate) struct Sheet(Vec<(String, Cells)>);

impl Sheet {
    /// A column has numbers if its heading has a unit and each cell is a number or empty: NaN.
    pub(crate) fn of(rows: &[Vec<String>]) -> Self {
        let Some((heads, rows)) = rows.split_first() else { return Self(Vec::new()) };
        let column = |(place, head): (usize, &String)| {
            let cells = || rows.iter().map(move |row| row.get(place).map_or("", String::as_str));
            let split = head.rsplit_once(" [").and_then(|(name, unit)| {
                Some((name, unit.strip_suffix(']').filter(|unit| !unit.is_empty())?))
            });
            let numbers = |(name, unit): (&str, &str)| {
                let values: Option<Vec<f64>> = cells().map(number).collect();
                Some((name.to_owned(), Cells::Numbers { unit: unit.to_owned(), values: values? }))
            };
            let words = || (head.clone(), Cells::Words(cells().map(str::to_owned).collect()));
            split.and_then(numbers).unwrap_or_else(words)
        };
        Self(heads.iter().enumerate().map(column).collect())
    }

    /// Names of the columns, with the unit of those of numbers.
    pub(crate) fn columns(&self) -> Vec<(String, Option<String>)> {
        let unit = |cells: &Cells| match cells {
            Cells::Numbers { unit, .. } => Some(unit.clone()),
            Cells::Words(_) => None,
        };
        self.0.iter().map(|(name, cells)| (name.clone(), unit(cells))).collect()
    }

    /// The cells of a column of words.
    pub(crate) fn words(&self, name: &str) -> Option<&[String]> {
        match self.cells(name)? {
            Cells::Words(cells) => Some(cells),
            Cells::Numbers { .. } => None,
        }
    }

    /// The unit and the numbers of a column of numbers.
    pub(crate) fn numbers(&self, name: &str) -> Option<(&str, &[f64])> {
        match self.cells(name)? {
            Cells::Numbers { unit, values } => Some((unit, values)),
            Cells::Words(_) => None,
        }
    }

    fn cells(&self, name: &str) -> Option<&Cells> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, cells)| cells)
    }
}

fn number(cell: &str) -> Option<f64> {
    if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() }
}
