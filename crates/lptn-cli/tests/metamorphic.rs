//! What a network means does not depend on how it is written: random networks of every kind of
//! element, each also renamed, reordered, in other units, split, and so on, have to give the same
//! within ten times the tolerance.
//!
//! Each of 300 networks is asked for every second relation.
//! `make metamorphic METAMORPHIC=5000 METAMORPHIC_FROM=17` takes so many networks from that seed on,
//! and all relations. `LPTN_METAMORPHIC=1 LPTN_METAMORPHIC_FROM=17` looks at one network alone.

#![allow(clippy::print_stdout, reason = "how many networks a relation changes")]

use crate::random;

use std::sync::OnceLock;

use lptn_solve::{available_threads, in_parallel};
use random::compare::{Case, LeftOut, coverage, same};
use random::generate::network;
use random::model::{Field, Net};
use random::program;
use random::random::Random;
use random::relations::{RELATIONS, Relation, Variant, included, reordered, superposed, templated};
use random::results::{Results, read, results};
use random::shrink::smallest;
use random::verbs::Study;
use random::write::{MAIN, Texts};

/// Each kind of element, table, signal and so on stands in at least so many of a hundred networks.
const LEAST: f64 = 2.5;

struct Cases {
    cases: Vec<Case>,
    asked: usize,
    left_out: Vec<(u64, LeftOut)>,
}

fn number(variable: &str, usual: u64) -> u64 {
    std::env::var(variable).map_or(usual, |text| text.parse().expect("a whole number"))
}

/// The networks with their results, computed once.
fn cases() -> &'static Cases {
    static CASES: OnceLock<Cases> = OnceLock::new();
    CASES.get_or_init(|| {
        let first = number("LPTN_METAMORPHIC_FROM", 0);
        let seeds: Vec<u64> = (first..first + number("LPTN_METAMORPHIC", 300)).collect();
        let made = in_parallel(&seeds, available_threads(), |&seed| Case::new(seed, network(seed)));
        let (mut cases, mut left_out) = (Vec::new(), Vec::new());
        for (seed, case) in seeds.iter().zip(made) {
            match case {
                Ok(case) => cases.push(case),
                Err(why) => left_out.push((*seed, why)),
            }
        }
        Cases { cases, asked: seeds.len(), left_out }
    })
}

/// The number that belongs to a relation and a seed.
fn dice(seed: u64, name: &str) -> Random {
    Random::new(name.bytes().fold(seed, |sum, byte| sum.wrapping_mul(31).wrapping_add(byte.into())))
}

/// Nothing where there is nothing to change; else that it gives the same, or the difference and the
/// texts that show it.
type Verdict = Option<Result<(), (String, Texts)>>;

type Check<'a> = &'a (dyn Fn(&Case) -> Verdict + Sync);

/// What a relation makes of a network, and whether it gives the same.
fn related(case: &Case, name: &str, relation: Relation) -> Verdict {
    let variant = relation(&case.net, &mut dice(case.seed, name))?;
    let texts = variant.net.texts();
    let outcome = results(&texts).and_then(|found| same(case, &variant, &found));
    Some(outcome.map_err(|difference| (difference, texts)))
}

fn shown(texts: &Texts) -> String {
    texts.iter().map(|(name, text)| format!("---- {name}\n{text}")).collect()
}

/// The smallest network for which `check` finds a difference, and that difference.
fn report(case: &Case, name: &str, check: Check<'_>) -> String {
    let failing = |net: &Net| {
        let case = Case::new(case.seed, net.clone()).ok()?;
        check(&case)?.err()
    };
    let small = smallest(&case.net, &|net| failing(net).is_some());
    let (difference, texts) =
        failing(&small).unwrap_or_else(|| ("gone when it was run again".into(), Texts::new()));
    format!(
        "seed {}, {name}: {difference}\n{}==== {name}\n{}",
        case.seed,
        shown(&small.texts()),
        shown(&texts)
    )
}

/// What came of a question to many networks.
struct Asked {
    /// Those that were asked.
    tried: usize,
    /// Those that had something to change.
    changed: usize,
}

impl Asked {
    /// At least so many percent had something to change.
    fn at_least(&self, percent: usize) {
        let Self { tried, changed } = self;
        assert!(
            changed * 100 >= percent * tried,
            "only {changed} of {tried} have something to change"
        );
    }
}

/// Asks one network in `every`, which is not a multiple of 3, for every third is linear; shows the
/// smallest of at most three that differ.
fn hold(name: &str, every: u64, check: Check<'_>) -> Asked {
    let long = std::env::var_os("LPTN_METAMORPHIC").is_some();
    let every = if long { 1 } else { every };
    let first = name.len() as u64;
    let tried: Vec<&Case> =
        cases().cases.iter().filter(|case| (case.seed + first).is_multiple_of(every)).collect();
    let outcomes = in_parallel(&tried, available_threads(), |case| {
        let outcome = check(case);
        if let (true, Some(Err((difference, _)))) = (long, &outcome) {
            // hours before the smallest are shown
            println!("seed {}, {name}: {difference}", case.seed);
        }
        outcome
    });
    let failed = tried.iter().zip(&outcomes).filter(|(_, outcome)| matches!(outcome, Some(Err(_))));
    let failed: Vec<&Case> = failed.map(|(case, _)| *case).collect();
    let changed = outcomes.iter().flatten().count();
    let shown: Vec<String> = failed.iter().take(3).map(|case| report(case, name, check)).collect();
    let seeds: Vec<u64> = failed.iter().map(|case| case.seed).collect();
    assert!(
        failed.is_empty(),
        "{} of {changed} differ, seeds {seeds:?}:\n{}",
        failed.len(),
        shown.join("\n")
    );
    println!("{name}: {changed} of {} networks", tried.len());
    Asked { tried: tried.len(), changed }
}

/// Every second network, related as the test is called; `least` percent of them have something to
/// change.
fn holds(name: &str, least: usize) {
    let relation = RELATIONS.iter().find(|(known, _)| *known == name).expect("a relation").1;
    hold(name, 2, &|case| related(case, name, relation)).at_least(least);
}

#[test]
fn renamed_networks_are_the_same() {
    holds("renamed", 80);
}

#[test]
fn reordered_networks_are_the_same() {
    holds("reordered", 80);
}

#[test]
fn networks_in_other_units_are_the_same() {
    holds("in other units", 80);
}

#[test]
fn paths_split_in_series_are_the_same() {
    holds("split in series", 40);
}

#[test]
fn paths_and_sources_split_in_parallel_are_the_same() {
    holds("split in parallel", 80);
}

#[test]
fn templates_are_the_same() {
    holds("made of a template", 60);
}

#[test]
fn imports_are_the_same() {
    holds("imported", 60);
}

#[test]
fn includes_are_the_same() {
    holds("included", 80);
}

#[test]
fn idle_nodes_change_nothing() {
    holds("beside idle nodes", 80);
}

#[test]
fn a_later_start_moves_everything() {
    holds("with a later start", 80);
}

#[test]
fn reports_windows_and_limits_change_no_temperature() {
    holds("with more outputs", 80);
}

#[test]
fn grids_are_the_nodes_they_stand_for() {
    holds("with its grid written out", 5);
}

/// A run by ESDIRK, whatever its inputs are; `None` where something melts, which it refuses.
fn by_esdirk(case: &Case) -> Verdict {
    let mut variant = Variant::of(&case.net);
    let run = variant.net.entries.iter_mut().find(|entry| entry.section == "run")?;
    *run = run.clone().with("integrator", Field::Word("esdirk".into()));
    let texts = variant.net.texts();
    match results(&texts).and_then(|found| same(case, &variant, &found)) {
        Err(words) if words.contains("ESDIRK does not compute runs") => None,
        outcome => Some(outcome.map_err(|difference| (difference, texts))),
    }
}

#[test]
fn another_integrator_gives_the_same() {
    hold("by ESDIRK", 2, &by_esdirk).at_least(50);
}

/// The expansion is read as the same network, to the last digit.
#[test]
fn expansions_are_the_same() {
    let asked = hold("expanded", 2, &|case| {
        let mut texts = case.net.texts();
        let netlist = read(&texts).expect("it was read before");
        netlist.not_flat().is_none().then(|| {
            texts.insert(MAIN.into(), netlist.expanded());
            let variant = Variant { exact: true, ..Variant::of(&case.net) };
            let outcome = results(&texts).and_then(|found| same(case, &variant, &found));
            outcome.map_err(|difference| (difference, texts))
        })
    });
    asked.at_least(60);
}

/// A network that is the result of one relation has to obey the others: templates in other units
/// and so on.
#[test]
fn relations_hold_one_after_the_other() {
    let first: [Relation; 3] = [templated, included, reordered];
    hold("one after the other", 7, &|case| {
        let mut random = dice(case.seed, "first");
        let net = random.pick(&first)(&case.net, &mut random)?.net;
        let case = match Case::new(case.seed, net.clone()) {
            Ok(case) => case,
            Err(why) => return Some(Err((format!("{why:?}"), net.texts()))),
        };
        let second: [usize; 4] = [0, 1, 2, 9];
        let (name, relation) = RELATIONS[*random.pick(&second)];
        related(&case, name, relation)
    });
}

/// Temperatures of a linear network for the mean of two excitations are the means.
#[test]
fn linear_networks_superpose() {
    let asked = hold("superposed", 1, &|case| {
        let nets = superposed(&case.net, &mut dice(case.seed, "superposed"))?;
        let texts = nets[1].texts();
        let found = nets.each_ref().map(|net| results(&net.texts()));
        let [other, mean] = match found {
            [Ok(other), Ok(mean)] => [other, mean],
            [Err(error), _] | [_, Err(error)] => return Some(Err((error, texts))),
        };
        let mut half = Results { columns: other.columns.clone(), ..mean.clone() };
        for (name, values) in &mut half.columns {
            // twice the mean, less the one, is the other
            values
                .iter_mut()
                .zip(&mean.columns[name])
                .for_each(|(other, mean)| *other = 2.0 * mean - *other);
        }
        half.columns.retain(|name, _| name.ends_with(".T"));
        let only = |results: &Results| {
            let columns = results.columns.iter().filter(|(name, _)| name.ends_with(".T"));
            Results {
                times: results.times.clone(),
                columns: columns.map(|(name, values)| (name.clone(), values.clone())).collect(),
                ..Results::default()
            }
        };
        let own = Case {
            seed: case.seed,
            net: case.net.clone(),
            results: only(&case.results),
            growth: 3.0,
        };
        Some(same(&own, &Variant::of(&case.net), &half).map_err(|difference| (difference, texts)))
    });
    asked.at_least(25);
}

/// A run with a hundredth of the tolerance differs by the error of the run, where the network
/// bounds it.
#[test]
fn a_tighter_tolerance_changes_no_more_than_is_promised() {
    hold("with a tighter tolerance", 5, &|case| {
        let mut variant = Variant::of(&case.net);
        let tight = random::model::constant(
            0.01 * random::model::TOLERANCE,
            random::units::Kind::Difference,
        );
        *variant.net.run().get_mut("tolerance")? = tight;
        let texts = variant.net.texts();
        let outcome = results(&texts).and_then(|found| same(case, &variant, &found));
        Some(outcome.map_err(|difference| (difference, texts)))
    });
}

/// Twice the same bytes.
#[test]
fn runs_repeat_to_the_last_digit() {
    hold("again", 8, &|case| {
        let (texts, variant) =
            (case.net.texts(), Variant { exact: true, ..Variant::of(&case.net) });
        let outcome = results(&texts).and_then(|found| same(case, &variant, &found));
        Some(outcome.map_err(|difference| (difference, texts)))
    });
}

/// CSV, JSON and the table of the program show the numbers of the library, all columns or some.
#[test]
fn all_formats_show_the_same_numbers() {
    hold("in all formats", 11, &|case| {
        Some(program::formats(case).map_err(|words| (words, Texts::new())))
    });
}

/// Events, heats, balances, limits and the work of the solver do not depend on the columns.
#[test]
fn columns_decide_nothing() {
    hold("one column", 7, &|case| {
        Some(program::columns_decide_nothing(case).map_err(|words| (words, Texts::new())))
    });
}

/// A run in two parts, the second from the `state.json` of the first, ends where the whole does.
#[test]
fn runs_in_two_parts_are_the_same() {
    hold("in two parts", 5, &|case| Some(program::in_two_parts(case)));
}

/// `run`, `compare`, `sweep`, `rank`, `size` at its answer, bands and the page of a report agree on
/// the hottest, the margin of a limit, heats and the verdict.
#[test]
fn verbs_agree() {
    let asked = hold("verb against verb", 40, &|case| {
        Some(Study::of(case, &mut dice(case.seed, "verbs"))?.agrees())
    });
    asked.at_least(60);
}

/// Few networks cannot be run or have no useful bound, and every kind of element is there.
#[test]
fn the_networks_hold_every_kind_of_element() {
    let Cases { cases, asked, left_out } = cases();
    let counts = coverage(cases);
    let steps: u64 = cases.iter().map(|case| case.results.steps).sum();
    let switches = cases.iter().filter(|case| !case.results.events.is_empty()).count();
    println!(
        "{} of {asked} networks, {steps} steps, {switches} switch\n{counts:#?}\n{left_out:#?}",
        cases.len()
    );
    let fails = left_out.iter().filter(|(_, why)| matches!(why, LeftOut::Fails(_))).count();
    let boundless = left_out.len() - fails;
    assert!(fails * 100 <= 5 * asked, "{fails} of {asked} fail: {left_out:#?}");
    assert!(
        boundless * 100 <= 8 * asked,
        "{boundless} of {asked} have no useful bound: {left_out:#?}"
    );
    if *asked >= 300 {
        let few: Vec<_> = ELEMENTS
            .iter()
            .map(|element| (element, counts.get(element).copied().unwrap_or(0)))
            .filter(|(_, count)| (*count as f64) < LEAST / 100.0 * *asked as f64)
            .collect();
        assert!(few.is_empty(), "too few networks with {few:?}");
    }
}

/// What networks are made of.
const ELEMENTS: [&str; 60] = [
    "C(T)",
    "CSV file",
    "advection mcp",
    "boundary",
    "boundary that jumps",
    "boundary that swings",
    "capacitor",
    "comparison of t",
    "comparison of temperatures",
    "conduction of a material",
    "constant value",
    "contact",
    "control that cools",
    "control that heats",
    "convection R",
    "convection h",
    "cp table",
    "cp(T)",
    "cylinder",
    "dwell time",
    "fluid",
    "fluid of cp(T)",
    "grid",
    "grid in two dimensions",
    "limit",
    "linear signal",
    "mass flow",
    "mass of a material",
    "massless",
    "material",
    "melting at one temperature",
    "melting over a range",
    "node",
    "output at",
    "output every",
    "parameter",
    "parameter of a parameter",
    "parameter of a temperature",
    "pchip signal",
    "pchip table",
    "power of dT",
    "previous signal",
    "radiation Gr",
    "radiation of an emissivity",
    "radiation of two plates",
    "report",
    "resistor G",
    "resistor R",
    "rod",
    "signal expression",
    "signal of heat",
    "signal that holds",
    "signal that repeats",
    "signal to the end",
    "sine of t",
    "slab",
    "source",
    "source with shares",
    "sphere",
    "table",
];
