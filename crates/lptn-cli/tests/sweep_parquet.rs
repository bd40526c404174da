//! `lptn sweep --parquet`: the rows of the CSV, with nulls for what is not there.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::{Field, Row};

const NODE: &str = r#"
format = 1

[param]
G = "5 W/K"

[node]
block = { T0 = "20 degC", C = "1 kJ/K" }

[boundary]
air = { T = "20 degC" }

[resistor]
skin = { from = "block", to = "air", G = "G" }

[source]
loss = { into = "block", P = "100 W" }

[sweep.some]
method = "list"
axes = { G = ["2 W/K", "-1 W/K", "5 W/K", "8 W/K"] }
report = { T = "block.T", Q = "skin.Q" }
"#;

fn rows(folder: &Folder, name: &str) -> Vec<Row> {
    let file = std::fs::File::open(folder.path().join(name)).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    reader.get_row_iter(None).unwrap().map(Result::unwrap).collect()
}

fn texts(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    let text = |field: &Field| match field {
        Field::Null => String::new(),
        Field::Str(text) => text.clone(),
        Field::Double(number) => number.to_string(),
        other => other.to_string(),
    };
    let row = |row: &Row| row.get_column_iter().map(|(_, field)| text(field)).collect();
    rows(folder, name).iter().map(row).collect()
}

#[test]
fn rows_and_names_are_those_of_the_csv() {
    let folder = Folder::with("node.toml", NODE);
    folder.run(&["sweep", "node.toml", "-o", "out", "--parquet"]).exits(0).says("sweep.parquet");
    let csv = folder.read("out/sweep.csv");
    let expected: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let found = rows(&folder, "out/sweep.parquet");
    let names: Vec<&String> = found[0].get_column_iter().map(|(name, _)| name).collect();
    assert_eq!(names, expected[0]);
    assert_eq!(texts(&folder, "out/sweep.parquet"), expected[1..]);
    assert_eq!(expected[2].last(), Some(&"network::not_positive"));
}

#[test]
fn parts_are_joined_in_parquet_too_and_nothing_old_stays() {
    let folder = Folder::with("node.toml", NODE);
    folder.run(&["sweep", "node.toml", "-o", "whole", "--parquet"]).exits(0);
    for part in ["1/2", "2/2"] {
        folder.run(&["sweep", "node.toml", "-o", "parts", "--shard", part]).exits(0);
    }
    folder.run(&["sweep", "merge", "parts", "--parquet"]).exits(0);
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert_eq!(bytes("whole/sweep.parquet"), bytes("parts/sweep.parquet"));
    // rows of another sweep beside it would be taken for those of this one
    folder.run(&["sweep", "node.toml", "-o", "whole"]).exits(0);
    folder.run(&["sweep", "merge", "parts"]).exits(0);
    for name in ["whole/sweep.parquet", "parts/sweep.parquet"] {
        assert!(!folder.path().join(name).exists(), "{name}");
    }
}
