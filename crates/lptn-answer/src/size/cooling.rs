//! Requirements on a cooling, without a netlist.

use std::io;

use lptn_netlist::{Diagnostic, Files};
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, plain, significant};
use lptn_solve::Table;
use lptn_study::{Coolant, CoolantFlow, Cooling, CoolingTask, SiValue};
use lptn_units::{Dimension, Type};
use serde_json::{Map, json};

use crate::about;
use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::quantity;
use crate::messages;

/// Default temperature rise of a coolant.
const USUAL_RISE: &str = "10 K";

/// The question for the resistance and the flow of a cooling. Quantities are text with units.
#[derive(Clone, Debug, Default)]
pub struct CoolingQuestion {
    /// Heat to be taken away: `223 W`.
    pub power: String,
    /// Temperature that must not be exceeded: `110 degC`.
    pub limit: String,
    /// Temperature of the surroundings: `35 degC`.
    pub ambient: String,
    /// Temperature rise of a coolant on its way; `None` for 10 K.
    pub rise: Option<String>,
    /// The words of the command that asked, for reports; empty if a program asked.
    pub command: Vec<String>,
}

impl CoolingQuestion {
    /// Asks without a netlist.
    ///
    /// # Errors
    /// A text that is not a quantity, a rise or a power that is not more than zero.
    pub fn ask(&self) -> Result<CoolingAnswer, Failure> {
        let task = self.task()?;
        let cooling = task.cooling().map_err(|error| Failure::of(&error))?;
        Ok(CoolingAnswer {
            asked: self.clone(),
            task,
            cooling,
            air: Coolant::air(task.ambient).map(|air| (air, task.flow(air))),
            oil: Coolant::oil().map(|oil| (oil, task.flow(oil))),
            files: Files::new(),
        })
    }

    fn task(&self) -> Result<CoolingTask, Failure> {
        let value = |name: &str, text: &str, ty: Type| {
            quantity(name, text, ty).map(|quantity| quantity.value)
        };
        let absolute = Type::ABSOLUTE_TEMPERATURE;
        let rise = self.rise.as_deref().unwrap_or(USUAL_RISE);
        Ok(CoolingTask {
            power: value("--power", &self.power, Type::of(Dimension::POWER))?,
            limit: value("--limit", &self.limit, absolute)?,
            ambient: value("--ambient", &self.ambient, absolute)?,
            rise: value("--rise", rise, Type::of(Dimension::TEMPERATURE))?,
        })
    }
}

/// The resistance and the flow of a cooling.
#[derive(Debug)]
pub struct CoolingAnswer {
    asked: CoolingQuestion,
    /// The question in SI units.
    pub task: CoolingTask,
    /// The largest resistance, and the temperature difference over it.
    pub cooling: Cooling,
    /// Properties and flow; the flow is `None` if the coolant would leave warmer than the limit.
    air: Option<(Coolant, Option<CoolantFlow>)>,
    oil: Option<(Coolant, Option<CoolantFlow>)>,
    files: Files,
}

impl CoolingAnswer {
    fn feasible(&self) -> bool {
        self.cooling.available > 0.0
    }

    fn infeasible(&self) -> String {
        let off = significant(-self.cooling.available, 4);
        if self.cooling.available == 0.0 {
            return "infeasible: the limit is the temperature of the surroundings, so no heat flows \
                to them"
                .into();
        }
        format!(
            "infeasible: the limit is {off} K below the surroundings; only refrigeration could \
             keep it"
        )
    }

    /// Name, value in SI units, unit; NaN for missing values.
    fn values(&self) -> [(&'static str, f64, &'static str); 6] {
        let resistance = if self.feasible() { self.cooling.resistance } else { f64::NAN };
        let flow = |of: Option<(Coolant, Option<CoolantFlow>)>| of.and_then(|(_, flow)| flow);
        let mass = |of| flow(of).map_or(f64::NAN, |flow| flow.mass);
        let volume = |of| flow(of).map_or(f64::NAN, |flow| flow.volume);
        [
            ("R_max", resistance, "K/W"),
            ("hA", resistance.recip(), "W/K"),
            ("air_flow", mass(self.air), "kg/s"),
            ("air_volume_flow", volume(self.air), "m^3/s"),
            ("oil_flow", mass(self.oil), "kg/s"),
            ("oil_volume_flow", volume(self.oil), "m^3/s"),
        ]
    }

    fn needs(&self) -> TextTable {
        let rise = significant(self.task.rise, 4);
        let mut rows = vec![
            [
                "largest resistance".to_owned(),
                format!("R_max = {} K/W", significant(self.cooling.resistance, 5)),
                format!(
                    "{} K over {} W",
                    significant(self.cooling.available, 5),
                    significant(self.task.power, 5)
                ),
            ],
            [
                "coefficient x area".into(),
                format!("h A = {} W/K", significant(self.cooling.resistance.recip(), 5)),
                "1 / R_max".into(),
            ],
        ];
        for (name, of) in [("air", self.air), ("gear oil", self.oil)] {
            rows.push([format!("{name}, {rise} K warmer"), flow(of), properties(of)]);
        }
        TextTable::of(&rows)
            .left("", |row| &row[0])
            .left("", |row| &row[1])
            .left("", |row| &row[2])
            .into()
    }
}

impl Answer for CoolingAnswer {
    fn files(&self) -> &Files {
        &self.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

impl Page for CoolingAnswer {
    fn text(&self) -> Text {
        let asked = &self.asked;
        let [power, limit, ambient] =
            [&asked.power, &asked.limit, &asked.ambient].map(|text| plain(text));
        let mut text = Text::titled(format!("Cooling of {power} at {limit} in {ambient}"));
        match self.feasible() {
            true => text.section().table(self.needs()),
            false => text.section().line(self.infeasible()),
        };
        text
    }

    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&[()]);
        let values = self.values().into_iter();
        values.for_each(|(name, value, unit)| table.column(name, unit, |()| value));
        table.done().into()
    }

    fn more(&self) -> Report {
        about::of_command(&[], &self.asked.command)
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let member = |(name, value, unit): (&str, f64, &str)| {
            (name.to_owned(), json!(SiValue::new(value, unit)))
        };
        messages::head(json, None, (&self.files, &[]))?;
        json.member("values", &self.values().map(member).into_iter().collect::<Map<_, _>>())?;
        json.member("margin", &SiValue::new(self.cooling.available, "K"))?;
        json.member("binding", &self.feasible().then_some("limit"))?;
        json.member("feasible", &self.feasible())
    }

    fn no(&self) -> Option<String> {
        (!self.feasible()).then(|| self.infeasible())
    }
}

fn flow(of: Option<(Coolant, Option<CoolantFlow>)>) -> String {
    match of {
        None => "no properties".into(),
        Some((_, None)) => "would leave warmer than the limit".into(),
        Some((_, Some(flow))) => {
            let (mass, volume) =
                (significant(1e3 * flow.mass, 4), significant(6e4 * flow.volume, 4));
            format!("{mass} g/s = {volume} L/min")
        }
    }
}

fn properties(of: Option<(Coolant, Option<CoolantFlow>)>) -> String {
    // of no use without a flow
    of.filter(|(_, flow)| flow.is_some()).map_or(String::new(), |(coolant, _)| {
        let (cp, rho) = (significant(coolant.specific_heat, 4), significant(coolant.density, 4));
        format!("{cp} J/(kg K), {rho} kg/m^3")
    })
}
