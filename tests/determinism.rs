//! Same input, same bytes: twice in a row, and from several threads at once.

use crate::support;

use lptn::prelude::*;
use support::{StiffLadder, grid};

fn bits(solution: &Solution) -> Vec<u64> {
    (0..solution.times().len())
        .flat_map(|row| solution.row(row).iter().map(|t| t.to_bits()))
        .collect()
}

fn run(system: &ThermalSystem) -> Vec<u64> {
    bits(&Transient::until(Time(120.0)).every(Time(1.0)).solve(system).expect("it runs"))
}

#[test]
fn a_run_repeats_to_the_bit() {
    let system = grid(20, 30.0, (5, 6));
    assert_eq!(run(&system), run(&system));
}

#[test]
fn threads_do_not_disturb_each_other() {
    let (grid, ladder) = (grid(20, 30.0, (5, 6)), StiffLadder::new(60));
    let (alone_grid, alone_ladder) = (run(&grid), run(&ladder.system));
    std::thread::scope(|scope| {
        let grids = [(); 2].map(|()| scope.spawn(|| run(&grid)));
        let ladders = [(); 2].map(|()| scope.spawn(|| run(&ladder.system)));
        grids.into_iter().for_each(|run| assert_eq!(run.join().expect("it runs"), alone_grid));
        ladders.into_iter().for_each(|run| assert_eq!(run.join().expect("it runs"), alone_ladder));
    });
}
