//! Wrong systems that the ledger must find: a ledger that always closes is worth nothing.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_cvodes::Cvodes;
use lptn_integrate::{Integrator, OdeSystem, Options, Pattern, Retry};
use lptn_network::{
    Conductance, ConductorKind, Context, HeatCapacity, HeatFlow, Melting, NetworkBuilder, Path,
    Properties, Size, Temperature,
};

use crate::heat::Heat;
use crate::ledger::Ledger;
use lptn_assembly::ThermalSystem;

/// Error of the heat flows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Nothing,
    /// The heat that leaves node 0 towards node 1 leaves node 1 too.
    Sign,
    /// The path from node 1 to the boundary counts twice.
    DoubledLink,
    /// The path from node 1 to the boundary is left out.
    LinkLeftOut,
    /// The source heats its node with a tenth more.
    Source,
}

struct Mutant<'a> {
    heat: Heat<'a>,
    wrong: Wrong,
}

const INNER: f64 = 5.0;
const OUTER: f64 = 2.0;
const POWER: f64 = 100.0;
const AMBIENT: f64 = 293.15;

impl OdeSystem for Mutant<'_> {
    fn size(&self) -> usize {
        self.heat.size()
    }

    fn mass(&self) -> &[f64] {
        self.heat.mass()
    }

    fn flow(&mut self, time: f64, y: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        self.heat.flow(time, y, flow)?;
        match self.wrong {
            Wrong::Nothing => {}
            Wrong::Sign => flow[1] -= 2.0 * INNER * (y[0] - y[1]),
            Wrong::DoubledLink => flow[1] -= OUTER * (y[1] - AMBIENT),
            Wrong::LinkLeftOut => flow[1] += OUTER * (y[1] - AMBIENT),
            Wrong::Source => flow[0] += 0.1 * POWER,
        }
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        self.heat.pattern()
    }

    fn symmetric(&self) -> bool {
        true
    }

    fn jacobian(&mut self, time: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        self.heat.jacobian(time, y, values)
    }

    fn quadrature_count(&self) -> usize {
        self.heat.quadrature_count()
    }

    fn quadrature(&mut self, time: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        self.heat.quadrature(time, y, q)
    }
}

fn ledger(wrong: Wrong) -> Ledger {
    let mut b = NetworkBuilder::new();
    let ambient = Temperature(AMBIENT);
    let inner = b.node("inner", HeatCapacity(500.0), ambient);
    let outer = b.node("outer", HeatCapacity(800.0), ambient);
    let air = b.boundary("air", ambient);
    b.resistor("joint", inner, outer, Conductance(INNER));
    b.resistor("skin", outer, air, Conductance(OUTER));
    b.source("heater", inner, HeatFlow(POWER));
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let mutant = Mutant {
        heat: Heat::new(&system, 500.0, crate::balance::Books::default()).unwrap(),
        wrong,
    };
    let options = Options { tolerance: 1e-5, ..Options::default() };
    let mut run = Cvodes::new(mutant, 0.0, &system.initial(), &options).unwrap();
    run.set_stop(1000.0);
    while run.time() < 1000.0 {
        run.step().unwrap();
    }
    let rise = run.state().iter().zip(system.capacity()).map(|(t, c)| c * (t - AMBIENT)).collect();
    Ledger::new(&system, run.quadratures().unwrap(), rise, (options.tolerance, 0.0))
}

#[test]
fn the_right_system_closes_its_books() {
    let ledger = ledger(Wrong::Nothing);
    assert!(ledger.closes());
    assert!(ledger.relative_residual().unwrap().abs() < 1e-8);
}

#[test]
fn every_mutant_breaks_the_books() {
    for wrong in [Wrong::Sign, Wrong::DoubledLink, Wrong::LinkLeftOut, Wrong::Source] {
        let ledger = ledger(wrong);
        assert!(!ledger.closes(), "{wrong:?}: {:e}", ledger.relative_residual().unwrap());
    }
}

/// Error of the elements that are not constant conductances.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bent {
    Nothing,
    /// The receiver of radiation gives heat too.
    Radiation,
    /// A stream takes from its start the heat that it brings to its end, as a conductance would.
    Stream,
    /// The source that depends on its node's temperature heats by a tenth more.
    Source,
    /// Heat is stored as if the capacity were that of the start.
    Capacity,
    /// Half of the latent heat is not counted as stored.
    Latent,
}

const SIGMA: f64 = 5.670_374_419e-8;
const GLOW: f64 = 0.05;
const RATE: f64 = 3.0;

/// `wax` melts and radiates to `block`, whose capacity grows; a stream leads from the block to the
/// wax.
fn bent_network() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let quantity = |text: &str| lptn_units::parse_quantity(text, None).unwrap();
    let melting = Melting {
        solidus: Temperature(330.0).into(),
        liquidus: Temperature(335.0).into(),
        heat: quantity("200 kJ/kg").into(),
    };
    let cp = Some(quantity("2000 J/(kg K)").into());
    let wax = b.material("wax", Properties { cp, melting: Some(melting), ..Properties::default() });
    let lump = b.lump(wax, Size::Mass(quantity("0.1 kg").into())).unwrap();
    let wax = b.node("n_wax", lump, Temperature(300.0));
    let capacity = b.expression_in(Context::Own, "200 [J/K] * kelvin(T) / 600 [K]", None).unwrap();
    let block = b.node("block", capacity, Temperature(600.0));
    let ends = (block.into(), wax.into());
    let gr = Path::radiation(quantity("0.05 m^2"));
    b.conductor("glow", ConductorKind::Radiation, ends, gr);
    let rate = Path::stream(quantity("3 W/K"));
    b.conductor("flow", ConductorKind::Advection, ends, rate);
    let power =
        b.expression_in(Context::Source, "0.5 [W/K] * (absolute(700 [K]) - T)", None).unwrap();
    b.source("heater", block, power);
    let room = b.boundary("room", Temperature(AMBIENT));
    b.resistor("skin", wax, room, Conductance(OUTER));
    ThermalSystem::assemble(&b.build().unwrap()).unwrap()
}

struct BentMutant<'a> {
    heat: Heat<'a>,
    system: &'a ThermalSystem,
    wrong: Bent,
}

/// Temperatures of the wax and of the block from the state variables.
fn unfolded(system: &ThermalSystem, y: &[f64]) -> [f64; 2] {
    [0, 1].map(|i| {
        let (curve, start) =
            (system.network().enthalpy(system.states()[i]).unwrap(), system.initial()[i]);
        curve.temperature(system.capacity()[i] * (y[i] - start)).unwrap().temperature
    })
}

impl OdeSystem for BentMutant<'_> {
    fn size(&self) -> usize {
        self.heat.size()
    }

    fn mass(&self) -> &[f64] {
        self.heat.mass()
    }

    fn slope(&self) -> Option<&[f64]> {
        self.heat.slope()
    }

    fn flow(&mut self, time: f64, y: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        self.heat.flow(time, y, flow)?;
        let [wax, block] = unfolded(self.system, y);
        match self.wrong {
            Bent::Radiation => flow[0] -= 2.0 * SIGMA * GLOW * (block.powi(4) - wax.powi(4)),
            Bent::Stream => flow[1] -= RATE * (block - wax),
            Bent::Source => flow[1] += 0.05 * (700.0 - block),
            Bent::Nothing | Bent::Capacity | Bent::Latent => {}
        }
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        self.heat.pattern()
    }

    fn symmetric(&self) -> bool {
        false
    }

    fn jacobian(&mut self, time: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        self.heat.jacobian(time, y, values)
    }

    fn quadrature_count(&self) -> usize {
        self.heat.quadrature_count()
    }

    fn quadrature(&mut self, time: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        self.heat.quadrature(time, y, q)
    }
}

fn bent_ledger(wrong: Bent) -> Ledger {
    let system = bent_network();
    let heat = Heat::new(&system, 100.0, crate::balance::Books::default()).unwrap();
    let mutant = BentMutant { heat, system: &system, wrong };
    let options = Options { tolerance: 1e-5, ..Options::default() };
    let mut run = Cvodes::new(mutant, 0.0, &system.initial(), &options).unwrap();
    run.set_stop(200.0);
    while run.time() < 200.0 {
        run.step().unwrap();
    }
    let capacity = system.capacity().to_vec();
    let mut stored: Vec<f64> =
        (0..2).map(|i| capacity[i] * (run.state()[i] - system.initial()[i])).collect();
    let [wax, block] = unfolded(&system, run.state());
    assert!(wax > 336.0 || wrong == Bent::Radiation, "the wax has to melt: {wax} K");
    match wrong {
        Bent::Capacity => stored[1] = capacity[1] * (block - 600.0),
        Bent::Latent => stored[0] -= 10_000.0,
        _ => {}
    }
    Ledger::new(&system, run.quadratures().unwrap(), stored, (options.tolerance, 0.0))
}

#[test]
fn bent_elements_close_their_books() {
    let ledger = bent_ledger(Bent::Nothing);
    assert!(ledger.closes(), "{:e} {ledger:?}", ledger.relative_residual().unwrap());
    assert!(ledger.relative_residual().unwrap().abs() < 1e-8);
}

#[test]
fn every_bent_mutant_breaks_the_books() {
    for wrong in [Bent::Radiation, Bent::Stream, Bent::Source, Bent::Capacity, Bent::Latent] {
        let ledger = bent_ledger(wrong);
        assert!(!ledger.closes(), "{wrong:?}: {:e}", ledger.relative_residual().unwrap());
    }
}
