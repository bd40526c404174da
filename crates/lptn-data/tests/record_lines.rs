//! Records that come line by line: what counts of each line, and where what is wrong with it stands.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_data::{RecordLines, RecordName, RecordQuery, RecordRow, Rejected};

/// The rows of two columns, and the codes of what is doubtful.
fn read(text: &[u8]) -> Result<(Vec<RecordRow>, Vec<&'static str>), Rejected> {
    let columns = ["lid", "ring"].map(RecordName::new).to_vec();
    let mut lines = RecordLines::new("log", RecordQuery { columns, ..RecordQuery::default() });
    let (mut rows, mut codes) = (Vec::new(), Vec::new());
    for line in text.split_inclusive(|byte| *byte == b'\n') {
        let read = lines.take(line)?;
        rows.extend(read.row);
        codes.extend(read.warnings.1.iter().map(|warning| warning.code));
    }
    assert_eq!(lines.rows(), rows.len());
    codes.extend(lines.end()?.1.iter().map(|warning| warning.code));
    Ok((rows, codes))
}

#[test]
fn a_line_is_a_row_with_its_units_and_gaps() {
    let text =
        "# log\nt [min],ring [degC],lid [K]\n\n0,20,\n1,NaN,300\n1,NaN,300\n# pause\n2,-,n/a\n3,1";
    let (rows, codes) = read(text.as_bytes()).unwrap();
    let told: Vec<String> =
        rows.iter().map(|row| format!("{} {} {:?}", row.line, row.time, row.values)).collect();
    assert_eq!(told, ["4 0 [NaN, 293.15]", "5 60 [300.0, NaN]", "8 120 [NaN, NaN]"]);
    assert_eq!(codes, ["record::same_row", "record::broken_off"]);
}

#[test]
fn what_is_wrong_stands_where_it_came() {
    let place = |text: &[u8]| {
        let rejected = read(text).unwrap_err();
        let problem = &rejected.diagnostics[0];
        let (line, column) = rejected.files.line_column(problem.place().unwrap());
        format!(
            "{} {}:{line}:{column}",
            problem.code,
            rejected.files.name(problem.place().unwrap().file)
        )
    };
    let head = "t [s],ring [degC],lid [degC]\n0,20,20\n";
    let after = |rows: &str| place(format!("{head}\n# pause\n{rows}").as_bytes());
    assert_eq!(after("5,20,x\n"), "record::not_a_number log:5:6");
    assert_eq!(after("noon,20,20\n"), "record::not_a_number log:5:1");
    assert_eq!(after("5,20\n6,20,20\n"), "record::short_row log:5:1");
    assert_eq!(after("0,20,21\n"), "record::time_repeated log:5:1");
    assert_eq!(after("-1,20,20\n"), "record::time_reversed log:5:1");
    assert_eq!(after("5,20,-300\n"), "units::below_absolute_zero log:5:6");
    assert_eq!(place(b"t [s],ring [degC]\n0,20\n"), "record::no_column log:1:1");
    assert_eq!(
        place(b"t [s],ring [degC],lid [degC]\n0,20,20\n1,20,2\xb0\n"),
        "netlist::not_text log:3:7"
    );
}
