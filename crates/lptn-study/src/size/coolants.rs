//! Air and oil of the built-in library.

use lptn_netlist::library::{self, LibrarySubstance};

use crate::size::cooling::Coolant;

impl Coolant {
    /// Air at atmospheric pressure that enters at `temperature` in K: the record of the
    /// library, its density brought to this temperature as that of an ideal gas.
    pub fn air(temperature: f64) -> Option<Self> {
        let (air, record) = Self::record("air")?;
        Some(Self { density: air.density * record.temperature? / temperature, ..air })
    }

    /// Mineral gear oil ISO VG 220 as in the library. Its properties are those at 60 degC; per K
    /// its density falls by 0.07 % and its specific heat grows by 0.2 % (unused engine oil,
    /// Incropera et al., Table A.5).
    pub fn oil() -> Option<Self> {
        Self::record("gear_oil_vg220").map(|(oil, _)| oil)
    }

    fn record(name: &str) -> Option<(Self, &'static LibrarySubstance)> {
        let record = library::find(name)?;
        Some((Self { specific_heat: record.cp?, density: record.density? }, record))
    }
}
