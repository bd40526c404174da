//! Sensitivities as a solution keeps them.

use lptn_network::ParameterId;

/// Sensitivities of the recorded nodes in K per SI unit: row by row, in it parameter by parameter.
#[derive(Clone, Debug, Default)]
pub(crate) struct SensitivityRows {
    pub(crate) parameters: Vec<ParameterId>,
    pub(crate) values: Vec<f64>,
}

impl SensitivityRows {
    /// Those of one of `width` recorded nodes over the rows.
    pub(crate) fn of(
        &self,
        parameter: ParameterId,
        (column, width): (usize, usize),
    ) -> Option<Vec<f64>> {
        let place = self.parameters.iter().position(|own| *own == parameter)?;
        let rows = self.values.chunks_exact(width * self.parameters.len());
        Some(rows.map(|row| row[place * width + column]).collect())
    }
}
