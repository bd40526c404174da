//! `lptn size` without a netlist: what a cooling has to do.

use std::io;

use lptn_netlist::Files;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, plain, significant};
use lptn_solve::Table;
use lptn_study::{Coolant, CoolantFlow, Cooling, CoolingTask, SiValue};
use lptn_units::{Dimension, Type};
use serde_json::{Map, json};

use super::args::{CoolingArgs, SizeArgs};
use crate::console::Console;
use lptn_answer::about;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::quantity;
use lptn_answer::messages;

/// How much a coolant warms unless said otherwise.
const USUAL_RISE: &str = "10 K";

pub(crate) fn cooling(args: &SizeArgs, console: &Console) -> Result<Exit, Failure> {
    let task = task(&args.cooling)?;
    let cooling = task.cooling().map_err(|error| Failure::of(&error))?;
    let answer = Answer {
        asked: &args.cooling,
        task,
        cooling,
        air: Coolant::air(task.ambient).map(|air| (air, task.flow(air))),
        oil: Coolant::oil().map(|oil| (oil, task.flow(oil))),
    };
    console.show(&answer, args.printed.format)
}

fn task(args: &CoolingArgs) -> Result<CoolingTask, Failure> {
    let value = |name: &str, text: Option<&String>, usual: &str, ty: Type| {
        let text = text.map_or(usual, String::as_str);
        quantity(name, text, ty).map(|quantity| quantity.value)
    };
    let absolute = Type::ABSOLUTE_TEMPERATURE;
    Ok(CoolingTask {
        power: value("--power", args.power.as_ref(), "", Type::of(Dimension::POWER))?,
        limit: value("--limit", args.limit.as_ref(), "", absolute)?,
        ambient: value("--ambient", args.ambient.as_ref(), "", absolute)?,
        rise: value("--rise", args.rise.as_ref(), USUAL_RISE, Type::of(Dimension::TEMPERATURE))?,
    })
}

struct Answer<'a> {
    asked: &'a CoolingArgs,
    task: CoolingTask,
    cooling: Cooling,
    /// Properties and flow; the flow is `None` where the coolant would leave warmer than the limit.
    air: Option<(Coolant, Option<CoolantFlow>)>,
    oil: Option<(Coolant, Option<CoolantFlow>)>,
}

impl Answer<'_> {
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

    /// Name, value in SI units, unit; NaN for what there is not.
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
                "film coefficient x area".into(),
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

impl Page for Answer<'_> {
    fn text(&self) -> Text {
        let said = |text: &Option<String>| plain(text.as_deref().unwrap_or_default());
        let [power, limit, ambient] =
            [&self.asked.power, &self.asked.limit, &self.asked.ambient].map(said);
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
        about::of_command(&[], &crate::files::arguments())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let member = |(name, value, unit): (&str, f64, &str)| {
            (name.to_owned(), json!(SiValue::new(value, unit)))
        };
        messages::head(json, None, (&Files::new(), &[]))?;
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
    // of no use where there is no flow
    of.filter(|(_, flow)| flow.is_some()).map_or(String::new(), |(coolant, _)| {
        let (cp, rho) = (significant(coolant.specific_heat, 4), significant(coolant.density, 4));
        format!("{cp} J/(kg K), {rho} kg/m^3")
    })
}
