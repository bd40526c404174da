//! `[import]`: elements from CSV files.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::io::{Error, ErrorKind};
use std::path::Path;

use lptn_netlist::{Netlist, Rejected, parse, parse_with};
use lptn_network::{ConductorKind, Field, Formula, Item};

const MAIN: &str = "format = 1\n[import]\nnodes = \"n.csv\"\nboundaries = \"b.csv\"\nconductors \
    = \"c.csv\"\n\
                    sources = \"s.csv\"\n";

/// A netlist with its files.
fn read(main: &str, files: &[(&str, &str)]) -> Result<Netlist, Rejected> {
    parse_with("net/main.toml", main, &mut |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new("net").join(name) == path);
        found
            .map(|(_, text)| text.as_bytes().to_vec())
            .ok_or_else(|| Error::from(ErrorKind::NotFound))
    })
}

const SMALL: [(&str, &str); 4] = [
    ("n.csv", "name,C [J/K],T0 [degC]\nn1,500,25\nn2,,\n\"wall[1,2]\",0.5,30\n"),
    ("b.csv", "name,T [degC]\nair,20\n"),
    ("c.csv", "from,to,G [W/K],name\nn1,n2,2,\nn2,air,0.5,skin\n\"wall[1,2]\",n1,0.25,\n"),
    ("s.csv", "into,P [W]\nn1,10\n"),
];

fn with(name: &str, text: &'static str) -> [(&'static str, &'static str); 4] {
    SMALL.map(|(known, old)| (known, if known == name { text } else { old }))
}

/// diagnostics: what the file says is what the network has.
#[test]
fn the_elements_of_the_files_are_those_of_the_network() {
    let netlist = read(MAIN, &SMALL).unwrap();
    let network = &netlist.network;
    let names: Vec<_> = network.node_ids().map(|id| network.name_of(Item::Node(id))).collect();
    assert_eq!(names, ["n1", "n2", "wall[1,2]"]);
    let capacities: Vec<f64> = network.node_ids().map(|id| network.capacity(id)).collect();
    assert_eq!(capacities, [500.0, 0.0, 0.5]);
    assert!(network.nodes()[1].massless && !network.nodes()[2].massless);
    assert_eq!(network.initial(network.node("n1").unwrap()).to_bits(), 298.15_f64.to_bits());
    let paths: Vec<_> =
        network.conductor_ids().map(|id| network.name_of(Item::Conductor(id))).collect();
    assert_eq!(paths, ["import.conductor[1]", "skin", "import.conductor[3]"]);
    let conductances: Vec<_> =
        network.conductor_ids().map(|id| network.conductance(id).unwrap()).collect();
    assert_eq!(conductances, [2.0, 0.5, 0.25]);
    assert!(
        network.item("import.conductor[2]").is_err() && network.item("import.conductor[3]").is_ok()
    );
    let source = network.source_ids().next().unwrap();
    assert_eq!(network.name_of(Item::Source(source)), "import.source[1]");
    assert_eq!(
        netlist.inputs().map(|(name, _)| name).collect::<Vec<_>>(),
        ["net/main.toml", "net/n.csv", "net/b.csv", "net/c.csv", "net/s.csv"]
    );
}

/// Units of the header, other orders of columns, a byte order mark, quotes, blanks, comments, line
/// ends of Windows.
#[test]
fn files_of_other_programs_are_read() {
    let nodes = "\u{feff}# from a mesher\r\nT0 [K],\"name\", C [kJ/K]\r\n\r\n298.15, n1 \
        ,0.5\r\n,n2,\r\n303.15,\"wall[1,2]\",0.0005";
    let netlist = read(MAIN, &with("n.csv", nodes)).unwrap();
    let plain = read(MAIN, &SMALL).unwrap();
    for id in plain.network.node_ids() {
        assert_eq!(netlist.network.name_of(Item::Node(id)), plain.network.name_of(Item::Node(id)));
        assert!((netlist.network.capacity(id) - plain.network.capacity(id)).abs() < 1e-12);
        assert_eq!(netlist.network.initial(id).to_bits(), plain.network.initial(id).to_bits());
    }
    let netlist = read(
        MAIN,
        &with("c.csv", "R [K/mW],to,from\n5e-4,n2,n1\n2e-3,air,n2\n4e-3,n1,\"wall[1,2]\"\n"),
    );
    let netlist = netlist.unwrap();
    for (id, expected) in netlist.network.conductor_ids().zip([2.0, 0.5, 0.25]) {
        assert!((netlist.network.conductance(id).unwrap() - expected).abs() < 1e-12);
    }
}

#[test]
fn the_file_uses_imported_names_like_its_own() {
    let more = "[node]\nhousing = { C = \"1 kJ/K\", T0 = \"25 degC\" }\n[capacitor]\nlid = { node \
        = \"n1\", C = \"100 J/K\" }\n\
                [resistor]\nfoot = { from = \"housing\", to = \"n2\", G = \"1 [W/K] * (1 + (n1.T - \
                20 [degC]) / 100 [K])\" }\n\
                [source]\nheat = { into = { n1 = 0.5, housing = 0.5 }, P = \"5 W\" }\n\
                [limit]\nhot = { of = \"max(n1.T, 'wall'.T)\", below = \"80 degC\" }\n";
    let more = more.replace("'wall'", "wall[1,2]");
    let run = "[run]\nstop = \"1 min\"\nselect = [\"n1.T\", \"import.conductor[*].Q\"]\nreport = { \
        q = \"skin.Q + import.source[1].P + import.conductor[1].Q\" }\n";
    let netlist = read(&format!("{MAIN}{more}{run}"), &SMALL).unwrap();
    let network = &netlist.network;
    assert!((network.capacity(network.node("n1").unwrap()) - 600.0).abs() < 1e-9);
    assert_eq!(network.limits().len(), 1);
    assert_eq!(network.reports().len(), 1);
}

/// The rows of a file are found again, also behind rows that are none.
#[test]
fn every_row_has_its_place() {
    let mut nodes = "name,C [J/K],T0 [degC]\n".to_owned();
    let mut conductors = "from,to,G [W/K]\n# a comment\n\n".to_owned();
    for i in 1..=1000 {
        nodes += &format!("n{i},{i},20\n");
        conductors += &format!("n{i},air,{i}\n");
    }
    let files = [("n.csv", &*nodes), SMALL[1], ("c.csv", &*conductors), ("s.csv", "into,P [W]\n")];
    let netlist = read(MAIN, &files).unwrap();
    let (network, map) = (&netlist.network, &netlist.source_map);
    for (i, id) in (1..).zip(network.node_ids()) {
        let at = |field| netlist.files.at(&map.get(Item::Node(id), field).unwrap()).to_owned();
        assert_eq!(
            (at(Field::Name), at(Field::Capacity), at(Field::Initial)),
            (format!("n{i}"), format!("{i}"), "20".into())
        );
        let span = map.name(Item::Node(id)).unwrap();
        assert_eq!(netlist.files.line_column(&span), (i + 1, 1));
    }
    for (i, id) in (1..).zip(network.conductor_ids()) {
        let at = |field| netlist.files.at(&map.get(Item::Conductor(id), field).unwrap()).to_owned();
        assert_eq!((at(Field::Name), at(Field::From)), (format!("n{i},air,{i}"), format!("n{i}")));
        assert_eq!(at(Field::of_law("G").unwrap()), format!("{i}"));
        assert!(map.get(Item::Conductor(id), Field::of_law("R").unwrap()).is_none());
    }
}

#[test]
fn a_bad_row_does_not_move_the_places_of_others() {
    let mut nodes = "name,C [J/K],T0 [degC]\n".to_owned();
    for i in 1..=600 {
        nodes += &if i % 100 == 0 {
            ",1,20\n".to_owned()
        } else {
            format!("n{i},{},20\n", if i == 555 { -1 } else { 1 })
        };
    }
    let rejected =
        read("format = 1\n[import]\nnodes = \"n.csv\"\n", &[("n.csv", &nodes)]).unwrap_err();
    let negative = rejected.diagnostics.iter().find(|d| d.code == "network::not_positive").unwrap();
    assert!(negative.message.contains("`n555`"));
    assert_eq!(rejected.files.line_column(negative.place().unwrap()), (556, 6));
    assert_eq!(rejected.diagnostics.len(), 7);
}

#[test]
fn a_file_full_of_mistakes_is_cut_short() {
    let rows: String = (1..=130).map(|i| format!("n{i},much,20\n")).collect();
    let nodes = format!("name,C [J/K],T0 [degC]\n{rows}");
    let rejected =
        read("format = 1\n[import]\nnodes = \"n.csv\"\n", &[("n.csv", &nodes)]).unwrap_err();
    assert_eq!(rejected.diagnostics.len(), 51);
    assert!(
        rejected.to_string().ends_with("error[netlist::more]: and 80 more problems"),
        "{rejected}"
    );
    // of those that only the whole network shows
    let rows: String = (1..=1300).map(|i| format!("n{i},-1,20\n")).collect();
    let nodes = format!("name,C [J/K],T0 [degC]\n{rows}");
    let rejected =
        read("format = 1\n[import]\nnodes = \"n.csv\"\n", &[("n.csv", &nodes)]).unwrap_err();
    assert!(
        rejected.to_string().ends_with("error[netlist::more]: and 1250 more problems"),
        "{rejected}"
    );
}

#[test]
fn paths_are_relative_to_the_file_that_names_them() {
    let main = "format = 1\ninclude = [\"mesh/mesh.toml\"]\n[boundary]\nair = { T = \"20 degC\" }\n\
                [resistor]\nskin = { from = \"n1\", to = \"air\", R = \"1 K/W\" }\n";
    let files = [
        ("mesh/mesh.toml", "format = 1\n[import]\nnodes = \"n.csv\"\n"),
        ("mesh/n.csv", "name,C [J/K],T0 [degC]\nn1,500,25\n"),
    ];
    assert_eq!(read(main, &files).unwrap().network.nodes().len(), 1);
    let rejected = parse("<stdin>", MAIN).unwrap_err();
    assert!(
        rejected.diagnostics.iter().all(|d| d.code == "netlist::csv_without_folder"),
        "{rejected}"
    );
    assert_eq!(rejected.diagnostics.len(), 4);
}

#[test]
fn the_start_of_default_is_that_of_empty_cells() {
    let main = format!("{MAIN}[default]\nT0 = \"40 degC\"\n");
    let netlist = read(
        &main,
        &with("n.csv", "name,C [J/K],T0 [degC]\nn1,500,\nn2,,\n\"wall[1,2]\",0.5,30\n"),
    )
    .unwrap();
    let starts: Vec<f64> =
        netlist.network.node_ids().map(|id| netlist.network.initial(id)).collect();
    assert!(
        (starts[0] - 313.15).abs() < 1e-12
            && starts[1].is_nan()
            && (starts[2] - 303.15).abs() < 1e-12
    );
    let netlist =
        read(&main, &with("n.csv", "name,C [J/K]\nn1,500\nn2,\n\"wall[1,2]\",0.5\n")).unwrap();
    assert!((netlist.network.initial(netlist.network.node("n1").unwrap()) - 313.15).abs() < 1e-12);
}

/// Each file has the law that its columns name; rows without a name are counted over the files.
#[test]
fn the_columns_of_a_file_choose_its_law() {
    let main = MAIN.replace("\"c.csv\"", "[\"c.csv\", \"g.csv\", \"f.csv\"]");
    let [nodes, boundaries, conductors, sources] = SMALL;
    let seen = ("g.csv", "from,to,Gr [cm^2]\nn1,n2,400\n");
    let films =
        ("f.csv", "from,to,area [cm^2],h [W/(m^2 K)],name\nn1,air,50,8,\nn2,air,20,9,top\n");
    let netlist = read(&main, &[nodes, boundaries, conductors, seen, films, sources]).unwrap();
    let (network, map) = (&netlist.network, &netlist.source_map);
    let told: Vec<_> = network
        .conductors()
        .iter()
        .zip(network.conductor_ids())
        .skip(3)
        .map(|(conductor, id)| {
            (
                network.name_of(Item::Conductor(id)).into_owned(),
                conductor.kind,
                conductor.law.formula(),
            )
        })
        .collect();
    assert_eq!(
        told,
        [
            ("import.conductor[4]".into(), ConductorKind::Radiation, Formula::ExchangeArea),
            ("import.conductor[5]".into(), ConductorKind::Convection, Formula::Film),
            ("top".into(), ConductorKind::Convection, Formula::Film),
        ]
    );
    let ids: Vec<_> = network.conductor_ids().collect();
    // 50 cm^2 times 8 W/(m^2 K), 20 cm^2 times 9
    assert!((network.conductance(ids[4]).unwrap() - 0.04).abs() < 1e-15);
    assert!((network.conductance(ids[5]).unwrap() - 0.018).abs() < 1e-15);
    let at = |id: usize, key| {
        let field = Field::of_law(key).unwrap();
        netlist.files.at(&map.get(Item::Conductor(ids[id]), field).unwrap()).to_owned()
    };
    assert_eq!([at(3, "Gr"), at(4, "h"), at(5, "area")], ["400", "8", "20"]);
}
