//! Wrong systems that the ledger must find: it is worth nothing if it closes whatever happens.

use lptn_integrate::{Integrator, OdeSystem, Options, Pattern, Retry};
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature};

use crate::heat::Heat;
use crate::ledger::Ledger;
use lptn_assembly::ThermalSystem;

/// What is wrong with the heat flows.
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
    let mutant = Mutant { heat: Heat::new(&system, 500.0).unwrap(), wrong };
    let options = Options { tolerance: 1e-5, ..Options::default() };
    let mut run = Integrator::new(mutant, 0.0, &system.initial(), &options).unwrap();
    run.set_stop(1000.0);
    while run.time() < 1000.0 {
        run.step().unwrap();
    }
    let rise = run.state().iter().zip(system.capacity()).map(|(t, c)| c * (t - AMBIENT)).collect();
    Ledger::new(&system, run.quadratures().unwrap(), rise, options.tolerance)
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
