//! Adds reports, and gives a slot to the names in expressions of results.

use std::sync::Arc;

use lptn_units::{Expression, Problems, Program, Type, UnitError};

use crate::builder::NetworkBuilder;
use crate::id::{Item, ReportId};
use crate::parts::functional::OverTime;
use crate::parts::result::Report;
use crate::scope::Context;
use crate::value::Input;

impl NetworkBuilder {
    /// Gives a slot to every heat flow (`NAME.Q`, `NAME.Q_from`, `NAME.Q_to`, `NAME.P`) and every
    /// temperature of a grid (`NAME.mean`, `NAME.x1.T`) that an expression names, so that it can be
    /// compiled for [`Context::Result`].
    pub fn name_heats(&mut self, expression: &Expression) {
        for (name, _) in expression.names() {
            if let Some(heat) = self.parts.heat(&name) {
                std::sync::Arc::make_mut(&mut self.parts.layout).add_heat(heat);
            }
            self.name_grid_value(&name);
        }
    }

    /// Compiles an expression over parameters, `t`, signals, tables, and the temperatures and heat
    /// flows of all parts added up to now; see [`NetworkBuilder::post_scope`].
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn post_expression(
        &mut self,
        text: &str,
        expected: Option<Type>,
    ) -> Result<Program, Problems<UnitError>> {
        let expression = Expression::parse(text)?;
        self.name_heats(&expression);
        expression.compile(&self.scope(Context::Result), expected)
    }

    /// Adds a report: `value`, written as `text`, becomes a column of the results. Its name is one
    /// of those that parameters, signals and tables share.
    pub fn report(&mut self, name: &str, value: Input, text: &str) -> ReportId {
        let id = ReportId::from_len(self.parts.reports.len());
        let Input { value, ty, .. } = value;
        let (text, over_time) = (text.to_owned(), None);
        self.parts.reports.push(Report { name: name.to_owned(), value, ty, over_time, text });
        self.register_value(name, Item::Report(id));
        id
    }

    /// Makes a report that was added a functional of its quantity: a number and not a column. It
    /// was added with the type of the number.
    pub fn report_over_time(&mut self, id: ReportId, over_time: OverTime) {
        self.parts.reports[id.index()].over_time = Some(over_time);
    }
}

impl NetworkBuilder {
    /// Gives a slot to a value of a grid (`NAME.mean`, `NAME.x1.T`) that an expression of results
    /// names.
    pub(crate) fn name_grid_value(&mut self, name: &str) {
        if let Some(value) = self.parts.grid_value(name) {
            Arc::make_mut(&mut self.parts.layout).add_grid_value(value);
        }
    }
}
