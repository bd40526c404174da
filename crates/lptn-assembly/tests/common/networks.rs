//! Helpers for networks of elements that are more than a constant conductance.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, reason = "each test file uses a part")]

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_network::{ConductorId, ConductorKind, Context, End, Input, NetworkBuilder, Path};
use lptn_units::{
    Dimension, Interpolation, LookupTable, Outside, Table1, Table2, TableSymbol, Type,
    parse_quantity,
};

pub const SIGMA: f64 = 5.670_374_419e-8;

/// Numbers that look random and are the same every time (xorshift64*, S. Vigna, ACM TOMS 42 (2016)
/// 30).
pub struct Random(pub u64);

impl Random {
    /// Between 0 and 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }
}

pub fn quantity(text: &str) -> Input {
    parse_quantity(text, None).unwrap().into()
}

pub fn link(b: &NetworkBuilder, text: &str) -> Input {
    b.expression_in(Context::Link, text, None).unwrap_or_else(|e| panic!("{text}: {e:?}")).into()
}

pub fn own(b: &NetworkBuilder, text: &str) -> Input {
    b.expression_in(Context::Own, text, None).unwrap_or_else(|e| panic!("{text}: {e:?}")).into()
}

pub fn power(b: &NetworkBuilder, text: &str) -> Input {
    b.expression_in(Context::Source, text, None).unwrap_or_else(|e| panic!("{text}: {e:?}")).into()
}

pub fn system(builder: NetworkBuilder) -> ThermalSystem {
    ThermalSystem::assemble(&builder.build().unwrap()).unwrap()
}

/// A table of one argument.
pub fn table(x: &[f64], y: &[f64], interp: Interpolation, types: (Type, Type)) -> TableSymbol {
    let table = Table1::new(x.to_vec(), y.to_vec(), interp, Outside::Error).unwrap();
    TableSymbol {
        table: LookupTable::One(table).into(),
        arguments: vec![types.0],
        ty: types.1,
        units: Vec::new(),
    }
}

/// A table of two arguments.
pub fn map(x: &[f64], y: &[f64], z: &[f64], types: (Type, Type, Type)) -> TableSymbol {
    let table = Table2::new(x.to_vec(), y.to_vec(), z.to_vec(), Outside::Error).unwrap();
    TableSymbol {
        table: LookupTable::Two(table).into(),
        arguments: vec![types.0, types.1],
        ty: types.2,
        units: Vec::new(),
    }
}

pub const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

pub fn of(dimension: Dimension) -> Type {
    Type::of(dimension)
}

pub fn radiation(
    b: &mut NetworkBuilder,
    name: &str,
    ends: (impl Into<End>, impl Into<End>),
    gr: &str,
) -> ConductorId {
    let path = Path::radiation(quantity(gr));
    b.conductor(name, ConductorKind::Radiation, (ends.0.into(), ends.1.into()), path)
}

pub fn stream(
    b: &mut NetworkBuilder,
    name: &str,
    ends: (impl Into<End>, impl Into<End>),
    mcp: Input,
) -> ConductorId {
    let path = Path::stream(mcp);
    b.conductor(name, ConductorKind::Advection, (ends.0.into(), ends.1.into()), path)
}

/// The Jacobian as a dense matrix, by rows.
pub fn dense(system: &ThermalSystem, time: f64, y: &[f64], form: JacobianForm) -> Vec<Vec<f64>> {
    let mut work = system.workspace();
    system.read_inputs(&mut work, time, time).unwrap();
    let mut values = vec![f64::NAN; system.pattern().entries()];
    system.jacobian_at(&mut work, y, form, &mut values).unwrap_or_else(|e| panic!("{e} at {y:?}"));
    let [columns, rows, _] = system.pattern().symbolic();
    let mut matrix = vec![vec![0.0; y.len()]; y.len()];
    for (column, _) in y.iter().enumerate() {
        for slot in columns[column]..columns[column + 1] {
            matrix[rows[slot]][column] = values[slot];
        }
    }
    matrix
}

/// Heat into each unknown in W.
pub fn flow(system: &ThermalSystem, time: f64, y: &[f64]) -> Vec<f64> {
    let mut work = system.workspace();
    system.read_inputs(&mut work, time, time).unwrap();
    let mut flow = vec![f64::NAN; y.len()];
    system.flow(&mut work, y, &mut flow).unwrap_or_else(|e| panic!("{e} at {y:?}"));
    flow
}
