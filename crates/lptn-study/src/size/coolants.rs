//! Air and oil for [`CoolingTask::flow`](crate::CoolingTask::flow).

use crate::size::cooling::{Coolant, CoolingTask};

/// A fluid at rising temperatures: K, kg/m^3, J/(kg K).
type Records = [(f64, f64, f64)];

/// F. P. Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, table A.4: air at atmospheric pressure.
const AIR: &Records =
    &[(250.0, 1.3947, 1006.0), (300.0, 1.1614, 1007.0), (350.0, 0.9950, 1009.0), (400.0, 0.8711, 1014.0)];

/// The same, table A.5: engine oil (unused); gear oils of mineral base differ by a few per cent.
const OIL: &Records = &[
    (280.0, 895.3, 1827.0),
    (300.0, 884.1, 1909.0),
    (320.0, 871.8, 1993.0),
    (340.0, 859.9, 2076.0),
    (360.0, 847.8, 2161.0),
    (380.0, 836.0, 2250.0),
    (400.0, 825.1, 2337.0),
];

impl Coolant {
    /// Air at atmospheric pressure for a task; `None` outside 250 to 400 K.
    pub fn air(task: &CoolingTask) -> Option<Self> {
        Self::of(AIR, task)
    }

    /// Mineral oil for a task; `None` outside 280 to 400 K.
    pub fn oil(task: &CoolingTask) -> Option<Self> {
        Self::of(OIL, task)
    }

    fn of(records: &Records, task: &CoolingTask) -> Option<Self> {
        let density = interpolated(records, task.ambient)?.0;
        let specific_heat = interpolated(records, task.mean_temperature())?.1;
        Some(Self { specific_heat, density })
    }
}

fn interpolated(records: &Records, temperature: f64) -> Option<(f64, f64)> {
    let (low, high) = records
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .find(|(low, high)| low.0 <= temperature && temperature <= high.0)?;
    let share = (temperature - low.0) / (high.0 - low.0);
    let between = |low: f64, high: f64| low + share * (high - low);
    Some((between(low.1, high.1), between(low.2, high.2)))
}
