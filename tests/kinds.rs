//! Property: what follows from the declaration of a kind or a law, for each of them. Their numbers
//! are tested against closed forms elsewhere (`elements.rs`, `crates/lptn-laws/tests`); here
//! derivatives are compared with differences and what is written with what is read.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::kind_page;

use std::path::{Path, PathBuf};

use kind_page::tables;
use lptn_assembly::ThermalSystem;
use lptn_laws::{FieldDeclaration, Formula, Kind, Range};
use lptn_netlist::Netlist;
use lptn_network::{ConductorFlow, Item, Network};
use lptn_solve::{Adjoint, StateRates, SteadyState};
use lptn_units::{parse_quantity, suggest};

/// Every kind with each of its laws.
fn all() -> Vec<(Kind, Formula)> {
    Kind::ALL.iter().flat_map(|kind| kind.laws().map(|law| (*kind, law))).collect()
}

fn words((kind, law): (Kind, Formula)) -> String {
    format!("[{}] {}", kind.declaration().section, law.declaration().name)
}

/// An example as it stands in a netlist, and as an expression with a factor.
fn example(field: &FieldDeclaration) -> String {
    field.example.to_owned()
}

fn times(field: &FieldDeclaration, factor: &str) -> String {
    let number = si(field);
    match field.ty {
        ty if ty.absolute => format!("\"absolute({factor} * {number} [K])\""),
        ty if ty.is_scalar() => format!("\"{factor} * {number}\""),
        ty => format!("\"{factor} * {number} [{}]\"", ty.dimension.si_unit()),
    }
}

/// The example in SI units.
fn si(field: &FieldDeclaration) -> f64 {
    parse_quantity(field.example.trim_matches('"'), Some(field.ty)).unwrap().value
}

/// Two nodes of different temperatures, joined by a path of this kind and law, or the first heated
/// by a source.
fn netlist((kind, law): (Kind, Formula), value: impl Fn(&FieldDeclaration) -> String) -> String {
    let (declared, section) = (law.declaration(), kind.declaration());
    let ends = if kind.is_source() { "into = \"a\"" } else { "from = \"a\", to = \"b\"" };
    let mut fields = vec![ends.to_owned()];
    let selector = section.selector.filter(|_| declared.named);
    fields.extend(selector.map(|key| format!("{key} = \"{}\"", declared.name)));
    fields.extend(declared.carries.is_of_fluid().then(|| "fluid = \"oil\"".to_owned()));
    for same in declared.fields.chunk_by(|a, b| a.key == b.key) {
        let values: Vec<String> = same.iter().map(&value).collect();
        fields.push(match values.as_slice() {
            [one] => format!("{} = {one}", same[0].key),
            several => format!("{} = [{}]", same[0].key, several.join(", ")),
        });
    }
    format!(
        "format = 1\n[param]\np = 1\n[fluid]\noil = {{ density = \"870 kg/m^3\", cp = \"(1900 + 3 \
         * kelvin(T) / 1 [K]) * 1 [J/(kg K)]\" }}\n\
         [node]\na = {{ T0 = \"80 degC\", C = \"1 kJ/K\" }}\nb = {{ T0 = \"30 degC\", C = \"1 \
         kJ/K\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\ncooling = {{ from = \"b\", to \
         = \"air\", R = \"1 K/W\" }}\n\
         [{}]\npath = {{ {} }}\n[run]\nstop = \"1 min\"\n",
        section.section,
        fields.join(", ")
    )
    .replace("[resistor]\npath", "path")
}

/// The change of the temperature of `b` in K/s at the start, if its path comes from a face, or from
/// the patch `lid` that covers it, of a body that conducts without limit, of this many cells; `None`
/// if no such path may end at a face.
fn change_from_a_face((kind, law): (Kind, Formula), cells: &str, end: &str) -> Option<f64> {
    let from = format!("from = \"plate.{end}\"");
    let text = netlist((kind, law), example).replace("from = \"a\"", &from);
    let plate = "[material]\nideal = { k = \"1 GW/(m K)\", density = \"1 kg/m^3\", cp = \"1 kJ/(kg \
                 K)\" }\n[grid]\nplate = { material = \"ideal\", T0 = \"80 degC\", ";
    // the area of the path is that of the face
    let declared = law.declaration();
    let own = declared.fields.iter().find(|field| declared.area.first() == Some(&field.key));
    let area = own.map_or(2.0, si);
    let text = format!(
        "{text}{plate}size = [\"{area} m\", \"1 m\", \"10 mm\"], cells = {cells}, patch = {{ lid = \
         {{ on = \"z1\", size = [\"{area} m\", \"1 m\"] }} }} }}\n"
    );
    let network = match lptn::parse("kinds.toml", &text) {
        Ok(netlist) => netlist.network,
        Err(rejected) => {
            let words = rejected.to_string();
            let refused = ["network::stream_into_face", "network::whole_law"];
            assert!(refused.iter().any(|code| words.contains(code)), "{words}\n{text}");
            return None;
        }
    };
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut rates = StateRates::new(&system).unwrap();
    let b = network.node("b").unwrap();
    let state = system.states().iter().position(|id| *id == b).unwrap();
    Some(rates.at(0.0, &system.initial()).unwrap().states[state])
}

/// The cells of a face share a path: together they carry the heat of the whole.
#[test]
fn every_law_carries_the_same_heat_from_a_face_of_many_cells() {
    let mut carried = 0;
    for pair in all().into_iter().filter(|(kind, _)| !kind.is_source()) {
        let one = change_from_a_face(pair, "[1, 1, 1]", "z1");
        for end in ["z1", "lid"] {
            let many = change_from_a_face(pair, "[4, 2, 1]", end);
            assert!(one.is_some() || many.is_none(), "{}", words(pair));
            let (Some(one), Some(many)) = (one, many) else { continue };
            assert!((many / one - 1.0).abs() < 1e-6, "{}: {many} is not {one}", words(pair));
            carried += 1;
        }
    }
    assert!(carried > 40, "{carried} laws may end at a face or a patch");
}

fn read(text: &str) -> Netlist {
    lptn::parse("kinds.toml", text).unwrap_or_else(|rejected| panic!("{rejected}\n{text}"))
}

/// The element that is looked at.
fn element(network: &Network) -> Item {
    network.item("path").unwrap()
}

/// What varies with the temperatures of the element.
fn varied(kind: Kind) -> &'static str {
    if kind.is_source() { "(1 + (T - 20 [degC]) / 1000 [K])" } else { "(1 + dT / 1000 [K])" }
}

#[test]
fn every_law_belongs_to_a_kind_and_is_told_apart() {
    for law in Formula::ALL {
        let declared = law.declaration();
        assert!(!declared.kinds.is_empty(), "no kind obeys {}", declared.name);
        for text in [declared.sentence, declared.equation, declared.validity, declared.source] {
            assert!(text.len() > 10, "{}: \"{text}\" says nothing", declared.name);
        }
        for key in declared.area.iter().chain(declared.ordered.iter().flatten()) {
            assert!(law.field(key).is_some(), "{} has no field {key}", declared.name);
        }
        for field in declared.fields {
            assert!(si(field).is_finite() && field.meaning.len() > 4, "{}", field.key);
        }
    }
    for kind in Kind::ALL {
        let keys = |law: Formula| -> Vec<&str> {
            law.declaration().fields.iter().map(|field| field.key).collect()
        };
        // laws with one word are told apart by their keys
        let mut all: Vec<_> = kind.laws().map(|law| (law.declaration().name, keys(law))).collect();
        all.sort_unstable();
        assert!(!all.is_empty() && all.windows(2).all(|two| two[0] != two[1]), "{all:?}");
    }
}

#[test]
fn every_law_and_kind_that_is_written_is_in_the_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/lptn-laws/src");
    let listed: Vec<String> = Kind::ALL
        .iter()
        .map(|kind| format!("{kind:?}"))
        .chain(Formula::ALL.iter().map(|law| format!("{law:?}")))
        .collect();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let law = |line: &str| line.strip_prefix("impl Law for ").map(str::to_owned);
        let kind = |line: &str| line.strip_prefix("pub(crate) const ").map(str::to_owned);
        let kinds =
            text.lines().filter(|line| line.contains(": KindDeclaration =")).filter_map(kind);
        for name in text.lines().filter_map(law).chain(kinds) {
            let name = name.split([' ', ':']).next().unwrap();
            assert!(listed.iter().any(|known| known == name), "{}: {name}", path.display());
        }
    }
}

#[test]
fn every_law_is_read_as_it_is_declared() {
    for of in all() {
        let netlist = read(&netlist(of, example));
        let found = match element(&netlist.network) {
            Item::Conductor(id) => {
                let conductor = &netlist.network.conductors()[id.index()];
                (conductor.kind, conductor.law.formula())
            }
            Item::Source(id) => {
                let source = &netlist.network.sources()[id.index()];
                (source.kind, source.law.formula())
            }
            other => panic!("{other:?}"),
        };
        assert_eq!(found, of, "{}", words(of));
        let heats: &[&str] = match of.0 {
            kind if kind.is_source() => &["P"],
            kind if kind.is_stream() => &["Q_from", "Q_to"],
            _ => &["Q"],
        };
        for heat in heats {
            read(&format!(
                "{}[limit]\nmuch = {{ of = \"path.{heat}\", below = \"1 GW\" }}\n",
                self::netlist(of, example)
            ));
        }
    }
}

#[test]
fn every_law_is_the_same_when_it_is_written_and_read_again() {
    for of in all() {
        let varied = format!("p * {}", varied(of.0));
        let values: [&dyn Fn(&FieldDeclaration) -> String; 2] =
            [&example, &|field| times(field, &varied)];
        for value in values {
            let first = read(&netlist(of, value));
            let again = read(&first.expanded());
            let [a, b] =
                [&first, &again].map(|netlist| heat(&netlist.network, [350.0, 310.0, 293.15]));
            assert!(
                (a[0] - b[0]).abs() + (a[1] - b[1]).abs() <= 1e-12 * a[1].abs(),
                "{}",
                words(of)
            );
            assert_eq!(again.expanded(), first.expanded(), "{}", words(of));
        }
    }
}

/// Heat received by the ends of the path, or by the first node from the source.
fn heat(network: &Network, temperatures: [f64; 3]) -> [f64; 2] {
    let difference = temperatures[0] - temperatures[1];
    let id = match element(network) {
        Item::Conductor(id) => id,
        Item::Source(id) => {
            let heat = network.source_heat(id, &mut network.evaluation(), &temperatures);
            return [heat.unwrap(), 0.0];
        }
        other => panic!("{other:?}"),
    };
    match network.flow(id) {
        ConductorFlow::Conductance(g) => [-g * difference, g * difference],
        ConductorFlow::Radiation(gr) => {
            let q = 5.670_374_419e-8 * gr * (temperatures[0].powi(4) - temperatures[1].powi(4));
            [-q, q]
        }
        ConductorFlow::Stream(rate) => [0.0, rate * difference],
        ConductorFlow::Variable => {
            network.exchange(id, &mut network.evaluation(), &temperatures).unwrap()
        }
    }
}

fn close(found: f64, slope: f64, what: &str) {
    assert!(
        (found - slope).abs() <= 1e-5 * slope.abs().max(1e-3),
        "{what}: {found} is not {slope}"
    );
}

#[test]
fn every_law_knows_its_slopes() {
    let at = [350.0, 310.0, 293.15];
    for of in all() {
        let network = read(&netlist(of, |field| times(field, varied(of.0)))).network;
        let (mut scope, mut slopes) = (network.evaluation(), Vec::new());
        match element(&network) {
            Item::Conductor(id) => {
                network.exchange_slopes(id, &mut scope, &at, &mut slopes).unwrap();
            }
            Item::Source(id) => {
                let mut own = Vec::new();
                network.source_slopes(id, &mut scope, &at, &mut own).unwrap();
                slopes.extend(own.iter().map(|slope| [*slope, 0.0]));
            }
            other => panic!("{other:?}"),
        }
        assert!(!slopes.is_empty(), "{}", words(of));
        for (k, slope) in slopes.iter().enumerate() {
            let moved = |by: f64| {
                let mut moved = at;
                moved[k] += by;
                heat(&network, moved)
            };
            let (up, down) = (moved(1e-3), moved(-1e-3));
            (0..2).for_each(|end| close(slope[end], (up[end] - down[end]) / 2e-3, &words(of)));
        }
    }
}

#[test]
fn every_law_knows_its_sensitivities() {
    let at = [350.0, 310.0, 293.15];
    for of in all() {
        // a part of a tooth is no tooth
        let counted = |field: &&FieldDeclaration| field.range == Range::Count;
        for field in of.1.declaration().fields.iter().filter(|field| !counted(field)) {
            let one = |own: &FieldDeclaration| {
                if own.key == field.key { times(own, "p") } else { example(own) }
            };
            let network = read(&netlist(of, one)).network;
            let p = network.parameter_ids().next().unwrap();
            let mut found = vec![f64::NAN; 3];
            let mut tangents = network.tangents(&[p]).unwrap();
            tangents.heat(&network, &network.evaluation(), &at, &mut found).unwrap();
            let moved = |by: f64| {
                let mut given = network.given();
                given.set(p, 1.0 + by);
                heat(&network.with(&given).unwrap(), at)
            };
            let (up, down) = (moved(1e-4), moved(-1e-4));
            let what = format!("{} by {}", words(of), field.key);
            (0..2).for_each(|end| close(found[end], (up[end] - down[end]) / 2e-4, &what));
        }
    }
}

/// The change of the temperature of `a` in steady state with each value of a law, by one solution of
/// the adjoint network, against differences of steady states.
#[test]
fn every_law_has_its_adjoint() {
    for of in all() {
        let counted = |field: &&FieldDeclaration| field.range == Range::Count;
        for field in of.1.declaration().fields.iter().filter(|field| !counted(field)) {
            let one = |own: &FieldDeclaration| {
                if own.key == field.key { times(own, "p") } else { example(own) }
            };
            let warm = "R = \"1 K/W\" }\nwarm = { from = \"hall\", to = \"a\", R = \"2 K/W\" }";
            let hall = "[boundary]\nhall = { T = \"90 degC\" }";
            let text =
                netlist(of, one).replace("R = \"1 K/W\" }", warm).replace("[boundary]", hall);
            let network = read(&text).network;
            let p = network.parameter_ids().next().unwrap();
            let node = network.node("a").unwrap();
            let system = ThermalSystem::assemble(&network).unwrap();
            let what = format!("{} by {}", words(of), field.key);
            let steady = SteadyState::solve(&system, 0.0).unwrap_or_else(|e| panic!("{what}: {e}"));
            let adjoint = Adjoint::of(&system, &steady.state, node).unwrap();
            let own = adjoint.influences().unwrap().into_iter().filter(|influence| {
                influence.of == element(&network) && influence.field.key() == field.key
            });
            let by_value: f64 = own
                .map(|influence| {
                    influence.change * if influence.absolute { influence.value } else { 1.0 }
                })
                .sum();
            let by_parameter = adjoint.by_parameters(&[p]).unwrap()[0];
            let moved = |by: f64| {
                let mut given = network.given();
                given.set(p, 1.0 + by);
                let system = system.with(&given).unwrap();
                SteadyState::solve(&system, 0.0).unwrap()[node]
            };
            // of the fourth order
            let step = 1e-3;
            let pair = |step: f64| (moved(step) - moved(-step)) / (2.0 * step);
            let slope = (4.0 * pair(step) - pair(2.0 * step)) / 3.0;
            for found in [by_value, by_parameter] {
                let off = (found - slope).abs();
                assert!(off <= 1e-6 * slope.abs().max(0.1), "{what}: {found} is not {slope}");
            }
        }
    }
}

#[test]
fn every_field_refuses_what_is_out_of_its_range() {
    for of in all() {
        for field in of.1.declaration().fields {
            let factor = match field.range {
                Range::Finite => continue,
                Range::Positive | Range::NotNegative | Range::Temperature => "-1",
                Range::Fraction => "2",
                Range::Degrees(..) => "10",
                Range::Count => "0.37",
            };
            let one = |own: &FieldDeclaration| {
                if own.key == field.key { times(own, factor) } else { example(own) }
            };
            let rejected = lptn::parse("kinds.toml", &netlist(of, one)).unwrap_err();
            let codes: Vec<&str> = rejected.diagnostics.iter().map(|d| d.code).collect();
            let wanted = match field.range {
                Range::Fraction => "network::not_a_fraction",
                Range::Degrees(..) => "network::angle",
                Range::Count => "network::not_counted",
                Range::Temperature => "network::below_absolute_zero",
                Range::NotNegative => "network::negative",
                _ => "network::not_positive",
            };
            assert!(codes.contains(&wanted), "{} {}: {codes:?}", words(of), field.key);
        }
    }
}

#[test]
fn every_key_is_suggested_and_has_an_example() {
    for (kind, law) in all() {
        for field in law.declaration().fields {
            let wrong = format!("{}x", field.key);
            let keys: Vec<&str> = kind.fields().iter().map(|field| field.key).collect();
            let near = suggest(&wrong, keys.iter().copied());
            let text = netlist((kind, law), example).replacen(
                &format!(" {} =", field.key),
                &format!(" {wrong} ="),
                1,
            );
            let rejected = lptn::parse("kinds.toml", &text).unwrap_err().to_string();
            assert!(near.is_none_or(|near| rejected.contains(near)), "{rejected}");
        }
    }
}

fn page(kind: Kind) -> PathBuf {
    let name = format!("{}.md", kind.declaration().section);
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/elements").join(name)
}

/// `LPTN_BLESS=1` writes the tables anew, and the page of a new kind.
#[test]
fn every_kind_has_its_page() {
    for kind in Kind::ALL {
        let declared = kind.declaration();
        let new = || {
            let first = netlist((*kind, kind.laws().next().unwrap()), example);
            let (name, sentence) = (declared.section, declared.sentence);
            format!("# {name}\n{sentence}\n\n## Keys\n\n## Example\n```toml\n{first}```\n")
        };
        let text = std::fs::read_to_string(page(*kind)).unwrap_or_else(|_| new());
        let (before, rest) = text.split_once("## Keys\n").unwrap();
        let prose = rest.lines().skip_while(|line| line.starts_with('|') || line.is_empty());
        let after: String = prose.map(|line| format!("{line}\n")).collect();
        let wanted = format!("{before}## Keys\n{}\n{after}", tables(*kind));
        if std::env::var_os("LPTN_BLESS").is_some() {
            std::fs::write(page(*kind), &wanted).unwrap();
        } else {
            assert_eq!(
                std::fs::read_to_string(page(*kind)).unwrap_or_default(),
                wanted,
                "LPTN_BLESS=1 writes it"
            );
        }
    }
}
