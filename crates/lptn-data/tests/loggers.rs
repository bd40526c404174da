//! Files as loggers write them. The expected numbers are those in the files: differences of their
//! clocks, and their temperatures plus 273.15 K.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use lptn_data::{
    CsvOptions, DateOrder, Decimal, Files, Record, RecordQuery, Rejected, Severity, read_record,
};

fn read(name: &str, csv: CsvOptions) -> Result<(Record, Files), Rejected> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/loggers").join(name);
    let query = RecordQuery { csv, ..RecordQuery::default() };
    read_record(Path::new(name), &std::fs::read(path).unwrap(), &query)
}

fn of(text: &str, csv: CsvOptions) -> Result<Record, Rejected> {
    let query = RecordQuery { csv, ..RecordQuery::default() };
    read_record(Path::new("r.csv"), text.as_bytes(), &query).map(|(record, _)| record)
}

fn code(text: &str, csv: CsvOptions) -> (&'static str, usize, String) {
    let refused = of(text, csv).unwrap_err();
    let first = &refused.diagnostics[0];
    let line = refused.files.line_column(first.place().unwrap()).0;
    (first.code, line, first.help.clone().unwrap_or_default())
}

/// The names and values of the columns, in degC; a gap is -1.
fn columns(record: &Record) -> Vec<(&str, Vec<f64>)> {
    let celsius = |value: &f64| match value.is_nan() {
        true => -1.0,
        false => ((value - 273.15) * 1e4).round() / 1e4,
    };
    let column = |column: &'_ lptn_data::RecordColumn| column.values.iter().map(celsius).collect();
    record.temperatures().map(|one| (one.name.as_str(), column(one))).collect()
}

fn note(record: &Record) -> &str {
    let notes = record.warnings.iter().filter(|one| one.severity == Severity::Note);
    let notes: Vec<&str> = notes.map(|note| note.message.as_str()).collect();
    assert_eq!(notes.len(), 1, "{notes:?}");
    notes[0]
}

const LID: [f64; 4] = [25.1, 25.2, 25.2, 25.3];

/// Four header rows, units in the third, a timestamp in quotes, `NAN`. Campbell Scientific,
/// LoggerNet instruction manual, appendix B.1.4, TOA5.
#[test]
fn toa5_of_campbell_scientific() {
    let (record, _) = read("toa5.dat", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 0.2, 0.4, 0.6]);
    assert_eq!(record.time_name, "TIMESTAMP");
    let expected =
        [("Ring_Avg", vec![24.9, 25.3, 26.02, 26.9]), ("Lid_Avg", vec![25.1, -1.0, 25.2, 25.3])];
    assert_eq!(columns(&record), expected);
    assert_eq!(
        note(&record),
        "toa5.dat is read with one line above the header left out, units in a separate line, 0 \
         s at 2026-05-03 23:59:59.8, without the columns `RECORD [RN]`, whose units are unknown"
    );
}

/// Milliseconds after a colon, month first, the unit in round brackets behind the channel, a column
/// of alarms without unit. Keysight, 34970A/34972A User's Guide, chapter 4, sample of a data file;
/// BenchLink Data Logger 3 exports it in UTF-16 below a description of the scan.
#[test]
fn benchlink_of_keysight() {
    let (record, _) = read("benchlink.csv", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 2.0, 4.0, 6.001]);
    let expected = [
        ("101 <Ring>", vec![24.913, 25.327, 26.02, 27.4]),
        ("102 <Lid>", vec![25.104, 25.116, 25.149, -1.0]),
    ];
    assert_eq!(columns(&record), expected);
    assert!(note(&record).contains("encoding UTF-16, 5 lines above"), "{}", note(&record));
}

/// A description of the channels with as many cells as the rows, units in a second line with the
/// half-width degree sign, milliseconds in a column of their own, a blank after the sign,
/// `BURNOUT`. Graphtec, midi LOGGER GL840 User's Manual, chapter on the format of CSV files.
#[test]
fn gl840_of_graphtec() {
    let (record, _) = read("graphtec.csv", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 0.1, 0.2, 1.0]);
    let expected = [("CH1", vec![24.9, 25.3, 26.0, 26.9]), ("CH2", vec![25.1, -1.0, -5.2, 25.3])];
    assert_eq!(columns(&record), expected);
}

/// A header of other width, `C` for degC, seconds without a unit, a comma at the end of each line.
/// Hioki, LR8431 Instruction Manual, appendix 3, internal format of text files.
#[test]
fn lr8431_of_hioki_needs_its_units() {
    let refused = read("hioki.csv", CsvOptions::default()).unwrap_err();
    let told: Vec<&str> = refused.diagnostics.iter().map(|one| one.message.as_str()).collect();
    assert!(told.contains(&"`C` is the unit of charge: is column `CH-1` in degC?"), "{told:?}");
    let units = [("Time", "s"), ("CH-1", "degC"), ("CH-2", "degC")];
    let units = units.map(|(name, unit)| (name.to_owned(), unit.to_owned())).to_vec();
    let (record, _) = read("hioki.csv", CsvOptions { units, ..CsvOptions::default() }).unwrap();
    assert_eq!(record.time, [0.0, 0.5, 1.0, 1.5]);
    let expected = [("CH-1", vec![24.9, 25.3, 26.0, 26.9]), ("CH-2", LID.to_vec())];
    assert_eq!(columns(&record), expected);
}

/// Title lines, channel numbers and units in lines of their own, 12-hour clocks over midnight.
/// Fluke, 2680 Series Users Manual, appendix F, data file format.
#[test]
fn series_2680_of_fluke() {
    let code = read("fluke.csv", CsvOptions::default()).unwrap_err().diagnostics[0].code;
    assert_eq!(code, "record::dates");
    let dates = Some(DateOrder::MonthFirst);
    let (record, _) = read("fluke.csv", CsvOptions { dates, ..CsvOptions::default() }).unwrap();
    assert_eq!(record.time, [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(columns(&record), [("101", vec![24.9, 25.3, 26.0, 26.9]), ("102", LID.to_vec())]);
}

const RING: [f64; 4] = [24.9, 25.3, 26.0, 26.9];
const LID_WITH_GAP: [f64; 4] = [25.1, -1.0, 25.2, 25.3];

/// Two headers, units in `Y_Unit_Label` of the second, `X_Value` in the seconds of `X_Dimension`, a
/// comment in the first row only, a decimal comma that the header states: 1,234 V is not a thousand.
/// National Instruments, Specification for the LabVIEW Measurement File (.lvm).
#[test]
fn lvm_of_labview() {
    let (record, _) = read("labview.lvm", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 0.5, 1.0, 1.5]);
    let expected = [("Ring", RING.to_vec()), ("Lid", LID_WITH_GAP.to_vec())];
    assert_eq!(columns(&record), expected);
    assert_eq!(record.column("Heater").unwrap().values, [1.234; 4]);
    assert_eq!(record.column("Lid").unwrap().gaps, 1);
    assert!(note(&record).contains("with the header of LabVIEW, tabs"), "{}", note(&record));
}

/// Without columns of X there are no times, and a second segment is not a row.
#[test]
fn lvm_without_times_or_with_two_segments_is_refused() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/loggers/labview.lvm");
    let text = std::fs::read_to_string(path).unwrap();
    let bare = ["0,000000", "0,500000", "1,000000", "1,500000"]
        .iter()
        .fold(text.clone(), |text, time| text.replace(&format!("\r\n{time}\t"), "\r\n\t"));
    let (code, _, help) = code(&bare, CsvOptions::default());
    assert_eq!(code, "record::row_without_time");
    assert!(help.contains("X_Columns No"), "{help}");
    let segment = text.split_once("\t\r\nChannels").unwrap().1;
    let twice = format!("{text}Channels{segment}");
    let refused = of(&twice, CsvOptions::default()).unwrap_err();
    assert!(!refused.diagnostics.is_empty());
}

/// A first column without a name, ISO 8601 with an offset, `C` for degC, a cell left empty. PicoLog 6;
/// its columns `Ave. (C)`, `Last (C)` are those in the tests of yadg.
#[test]
fn picolog_of_pico_technology() {
    let (record, _) = read("picolog.csv", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 1.0, 2.0, 3.0]);
    let expected = [
        ("Ring Ave.", RING.to_vec()),
        ("Lid Ave.", LID_WITH_GAP.to_vec()),
        ("Lid Last", vec![25.11, 25.12, 25.23, 25.34]),
    ];
    assert_eq!(columns(&record), expected);
    assert!(note(&record).contains("with `C` as degC, 0 s at"), "{}", note(&record));
}

/// Lines `Ch`, `Ch Id`, `Tag`, `Unit`, `Type`, `Kind` above the rows, a count of messages in the last
/// column, the messages below the rows, `+OVER`. Yokogawa, GX10/GX20/GP10/GP20 User's Manual,
/// IM 04L51B01-01EN, appendix on text files.
#[test]
fn gm10_of_yokogawa() {
    let (record, _) = read("yokogawa.txt", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 1.0, 2.0, 3.0]);
    let expected = [("0001", RING.to_vec()), ("0002", LID_WITH_GAP.to_vec())];
    assert_eq!(columns(&record), expected);
    assert_eq!(record.column("0003").unwrap().values, [1.234; 4]);
    assert!(note(&record).contains("the header of a Yokogawa recorder"), "{}", note(&record));
}

/// As above with labels below the units, a day above 12, and the number of SCPI for an overload
/// (SCPI 1999.0, volume 1, section 7.2.1), which is not a temperature.
#[test]
fn series_2680_of_fluke_with_labels() {
    let (record, _) = read("fluke_labels.csv", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(columns(&record), [("101", RING.to_vec()), ("102", LID_WITH_GAP.to_vec())]);
}

#[test]
fn missing_values_are_holes_and_never_numbers() {
    for hole in
        ["NAN", "OL", "--", "---", "+OVER", "-OVER", "overrange", "9.9E+37", "-9.9E37", "9.91E37"]
    {
        let text = format!("t [s],ring [degC]\n0,20\n1,{hole}\n2,21\n3,22\n");
        let record = of(&text, CsvOptions::default()).unwrap();
        assert!(record.columns[0].values[1].is_nan() && record.columns[0].gaps == 1, "{hole}");
        let told = record.warnings.iter().any(|warning| warning.code == "record::gaps");
        assert!(told, "{hole}: {:?}", record.warnings);
    }
}

/// Semicolons, decimal commas, thousands with points, Windows-1252, date and clock in two columns.
#[test]
fn a_german_logger() {
    let (record, _) = read("german.csv", CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 1.0, 2.0, 3.0]);
    let expected = [
        ("TC1 Gehäuse", vec![1025.7, 25.6, 25.6, 25.8]),
        ("TC2 Öl", vec![22.7, 22.75, -1.0, 22.8]),
    ];
    assert_eq!(columns(&record), expected);
    assert_eq!(
        note(&record),
        "german.csv is read with `;` between columns, decimal commas, encoding Windows-1252, 2 \
         lines above the header left out, 0 s at 03.05.2026 23:59:58,5"
    );
}

fn with_times(times: &[&str]) -> String {
    let rows = times.iter().enumerate().map(|(n, time)| format!("\"{time}\",{}.5\n", 20 + n));
    "Time,ring (degC)\n".to_owned() + &rows.collect::<String>()
}

#[test]
fn a_clock_without_a_date_passes_midnight_and_is_never_set_back() {
    let text = with_times(&["22:00:00", "23:30", "01:00:00.25", "21:00:00", "00:00:00"]);
    let record = of(&text, CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 5400.0, 10_800.25, 82_800.0, 93_600.0]);
    let summer = with_times(&["02:30:00", "02:59:59", "02:00:00", "02:30:01"]);
    let (code, line, help) = code(&summer, CsvOptions::default());
    assert_eq!((code, line), ("record::time_reversed", 4));
    assert!(help.contains("daylight-saving"), "{help}");
}

/// One instant in two zones: 02:59:59 in summer time is one second before 02:00:00 in winter time.
#[test]
fn offsets_from_utc_count() {
    let text = with_times(&["2026-10-25T02:59:59+02:00", "2026-10-25T02:00:00+01:00"]);
    assert_eq!(of(&text, CsvOptions::default()).unwrap().time, [0.0, 1.0]);
    let mixed = with_times(&["2026-10-25T02:59:59+02:00", "2026-10-25T03:00:00"]);
    assert_eq!(code(&mixed, CsvOptions::default()).0, "record::not_a_number");
}

#[test]
fn the_order_of_dates_follows_from_the_column_or_a_key() {
    let options = |dates| CsvOptions { dates, ..CsvOptions::default() };
    let shown = with_times(&["01/02/2026 08:00", "13/02/2026 08:00"]);
    assert_eq!(of(&shown, options(None)).unwrap().time, [0.0, 12.0 * 86_400.0]);
    let same = with_times(&["01/02/2026 08:00", "01/02/2026 09:00"]);
    assert_eq!(of(&same, options(None)).unwrap().time, [0.0, 3600.0]);
    let text = with_times(&["01/02/2026 08:00", "02/02/2026 08:00"]);
    let (code, line, help) = code(&text, options(None));
    assert_eq!((code, line), ("record::dates", 2));
    assert!(help.contains("`dates = \"day first\"`"), "{help}");
    let days = |order| of(&text, options(Some(order))).unwrap().time[1] / 86_400.0;
    // 1 and 2 February; 2 January and 2 February
    assert_eq!((days(DateOrder::DayFirst), days(DateOrder::MonthFirst)), (1.0, 31.0));
}

#[test]
fn a_start_is_the_time_zero() {
    let options = |start: &str| CsvOptions { start: Some(start.into()), ..CsvOptions::default() };
    let text = with_times(&["2026-05-03 09:00:00", "2026-05-03 09:00:10"]);
    assert_eq!(of(&text, options("2026-05-02 09:00:00")).unwrap().time, [86_400.0, 86_410.0]);
    assert_eq!(of(&text, options("09:00:04")).unwrap().time, [-4.0, 6.0]);
    assert_eq!(code(&text, options("noon")).0, "record::start");
    let numbers = "t [s],ring [degC]\n0,20\n1,21\n";
    assert_eq!(code(numbers, options("09:00:00")).0, "record::start");
    assert_eq!(code(&text, options("2026-05-03")).0, "record::start");
}

#[test]
fn a_comma_that_may_part_thousands_is_refused() {
    let options = |decimal| CsvOptions { decimal, ..CsvOptions::default() };
    let text = "t [s];P [W]\n0;1,234\n1;2,345\n";
    let (code, line, help) = code(text, options(None));
    assert_eq!((code, line), ("record::decimal", 2));
    assert!(help.contains("`decimal = \",\"`") && help.contains("for 1.234"), "{help}");
    let power = |decimal| of(text, options(Some(decimal))).unwrap().columns[0].values.clone();
    assert_eq!(power(Decimal::Comma), [1.234, 2.345]);
    assert_eq!(power(Decimal::PointOnly), [1234.0, 2345.0]);
    let shown = text.replace("1;2,345", "1,5;2,345");
    assert_eq!(of(&shown, options(None)).unwrap().columns[0].values, [1.234, 2.345]);
}

/// A body is neither liquid tungsten nor colder than nitrogen, whatever the header says.
#[test]
fn a_unit_that_makes_no_sense_is_a_warning() {
    let codes = |unit: &str, scale: f64| {
        let rows: String =
            (0..30).map(|k| format!("{k},{}\n", scale * f64::from(20 + k))).collect();
        let record = of(&format!("t [s],ring [{unit}]\n{rows}"), CsvOptions::default()).unwrap();
        record.warnings.iter().map(|one| one.code).collect::<Vec<_>>()
    };
    for (unit, scale) in [("degC", 1000.0), ("degR", 1.0), ("K", 1.0)] {
        assert_eq!(codes(unit, scale), ["record::which_unit"], "{unit}");
    }
    for (unit, scale) in [("degC", 40.0), ("degF", 1.0), ("degR", 20.0), ("degC", -4.0)] {
        assert_eq!(codes(unit, scale), [""; 0], "{unit}");
    }
}

/// Daylight-saving time begins on 2026-03-29 in Europe and on 2026-03-08 in North America, both
/// Sundays. An hour that is missing on another day, by day, or with offsets is a gap.
#[test]
fn a_clock_that_is_set_forward_is_a_warning() {
    let changes = |times: [&str; 4]| {
        let rows = times.map(|time| format!("{time},20\n")).concat();
        let record = of(&format!("time,ring [degC]\n{rows}"), CsvOptions::default()).unwrap();
        record.warnings.iter().filter(|one| one.code == "record::clock_change").count()
    };
    let hours = |date: &str| {
        changes(
            ["00:00", "01:00", "03:00", "04:00"]
                .map(|h| format!("{date} {h}"))
                .each_ref()
                .map(String::as_str),
        )
    };
    assert_eq!(
        ["2026-03-29", "2026-03-08", "08.03.2026", "2026-03-28", "2026-06-28"].map(hours),
        [1, 1, 1, 0, 0]
    );
    let minutes = [
        "2026-03-29 01:58:00",
        "2026-03-29 01:59:00",
        "2026-03-29 03:00:00",
        "2026-03-29 03:01:00",
    ];
    assert_eq!(changes(minutes), 1);
    let by_day = ["2026-03-29 10:00", "2026-03-29 11:00", "2026-03-29 13:00", "2026-03-29 14:00"];
    assert_eq!(changes(by_day), 0);
    let offsets = [
        "2026-03-29 00:00+01:00",
        "2026-03-29 01:00+01:00",
        "2026-03-29 03:00+02:00",
        "2026-03-29 04:00+02:00",
    ];
    assert_eq!(changes(offsets), 0);
}

/// A file with both signs, as joined by hand, beside one with thousands: `20,125` is 20.125 in the
/// first. A number of the same column decides, and so does a statement.
#[test]
fn a_comma_that_other_columns_decide_is_a_warning() {
    let doubts = |text: &str, csv| {
        let record = of(text, csv).unwrap();
        let mut all = record.warnings.iter().filter(|one| one.severity == Severity::Warning);
        let codes: Vec<&str> = all.clone().map(|one| one.code).collect();
        let message = all.find(|one| one.code == "record::decimal").map(|one| one.message.clone());
        (codes, message.unwrap_or_default())
    };
    let joined = "t [s];ring [degC]\n0.0;20,125\n60.0;21,250\n120.0;22,375\n";
    let (codes, message) = doubts(joined, CsvOptions::default());
    assert_eq!(codes, ["record::which_unit", "record::decimal"]);
    assert!(message.contains("`20,125` is read as 20125"), "{message}");
    let points = "t [s];n [rpm]\n0,5;1.500\n60,5;1.750\n120,5;2.000\n";
    let (codes, message) = doubts(points, CsvOptions::default());
    assert_eq!(codes, ["record::decimal"]);
    assert!(message.contains("`1.500` is read as 1500"), "{message}");
    let stated = CsvOptions { decimal: Some(Decimal::Comma), ..CsvOptions::default() };
    assert!(doubts(points, stated).0.is_empty());
    for more in ["500", "1.500,5"] {
        let shown = format!("{points}180,5;{more}\n");
        assert!(doubts(&shown, CsvOptions::default()).0.is_empty(), "{more}");
    }
}

#[test]
fn one_row_is_enough() {
    for text in ["Zeit [s];Ring [degC]\n0,5;20,5\n", "Ofen\n\nZeit [s]\tRing [degC]\n0,5\t20,5\n"] {
        let record = of(text, CsvOptions::default()).unwrap();
        assert_eq!(
            (record.time.as_slice(), columns(&record)),
            (&[0.5][..], vec![("Ring", vec![20.5])])
        );
    }
}

/// No file in lptn's own form is read in another way: a note would tell.
#[test]
fn plain_files_have_no_note() {
    let rows = |n: u32| (0..n).map(|t| format!("{t},{},\n", 20 + t)).collect::<String>();
    for text in [
        format!("t [s],ring [degC],remark\n{}", rows(5)),
        format!("# a; b; c\n\nt [s],ring [degC],remark\n{}", rows(1)),
        "t [s],\"ring, left\" [degC]\n0,1\n1,2\n".to_owned(),
        "t [s],ring [degC],day\n0,1,2026-05-03\n1,2,2026-05-03\n".to_owned(),
    ] {
        let record = of(&text, CsvOptions::default()).unwrap();
        let notes = record.warnings.iter().filter(|one| one.severity == Severity::Note).count();
        assert_eq!(notes, 0, "{text}");
    }
}

/// Texts that can be read in two ways: each is refused, and the given statement settles it.
#[test]
fn what_can_be_read_in_two_ways_is_refused() {
    let none = CsvOptions::default;
    let refused = |text: &str, csv: CsvOptions| code(text, csv).0;
    // 1.5 or 1500, 20 or 20000
    let thousands = "t [s];n [rpm];T [degC]\n0;1.500;20,000\n60;1.500;27,775\n";
    assert_eq!(refused(thousands, none()), "record::decimal");
    let points = "t [s];T [degC]\n0;28\n60.000;29\n";
    assert_eq!(refused(points, none()), "record::decimal");
    let comma = CsvOptions { decimal: Some(Decimal::Comma), ..none() };
    assert_eq!(of(points, comma).unwrap().time, [0.0, 60_000.0]);
    let point = CsvOptions { decimal: Some(Decimal::PointOnly), ..none() };
    assert_eq!(of(points, point).unwrap().time, [0.0, 60.0]);
    // a comma elsewhere shows that the point parts thousands
    let shown = "t [s];T [degC]\n0;28,5\n1.060;29,25\n";
    assert_eq!(of(shown, none()).unwrap().time, [0.0, 1060.0]);
    // hours and minutes, or minutes and seconds
    assert_eq!(refused("Elapsed,T [degC]\n00:00,20\n01:00,21\n", none()), "record::dates");
    // two columns of times
    let setpoint =
        "Timestamp,Dwell [min],T [degC]\n2026-05-03 09:00:00,5,20\n2026-05-03 09:01:00,5,21\n";
    assert_eq!(refused(setpoint, none()), "record::no_time");
    // two clocks for one date
    let clocks = "Date;Elapsed;Time;T [degC]\n03.05.2026;00:00:00;23:59:00;20\n04.05.2026;00:02:00;00:01:00;21\n";
    assert_eq!(refused(clocks, none()), "record::dates");
    // a start on another day needs the order of the dates
    let one_day = "Time,T [degC]\n5/3/2026 09:00:00,20\n5/3/2026 09:01:00,21\n";
    let start = CsvOptions { start: Some("2026-05-03 09:00:00".to_owned()), ..none() };
    assert_eq!(refused(one_day, start), "record::dates");
    let given = CsvOptions {
        start: Some("2026-05-03 09:00:00".to_owned()),
        dates: Some(DateOrder::MonthFirst),
        ..none()
    };
    assert_eq!(of(one_day, given).unwrap().time, [0.0, 60.0]);
    // an ambiguous start on rows that show their order
    let iso = "Time,T [degC]\n2026-05-03 09:00:00,20\n2026-05-03 09:01:00,21\n";
    let start = CsvOptions { start: Some("05/03/2026 09:00:00".to_owned()), ..none() };
    assert_eq!(refused(iso, start), "record::start");
    // an order that the form contradicts
    let dotted = "Time,T [degC]\n03.05.2026 09:00:00,20\n03.06.2026 09:01:00,21\n";
    let dates = CsvOptions { dates: Some(DateOrder::MonthFirst), ..none() };
    assert_eq!(refused(dotted, dates), "record::dates");
    // a year of two digits in front
    let short = "Time,T [degC]\n26-05-03 09:00:00,20\n26-05-15 09:01:00,21\n";
    assert!(code(short, none()).2.contains("year first"), "{:?}", code(short, none()));
}

/// The one clock of the one date is its time of day, wherever it is.
#[test]
fn a_date_and_its_clock_need_not_be_neighbours() {
    let text = "Date;Op;Time;T [degC]\n01.05.2026;A;09:00:00;20\n02.05.2026;B;17:00:00;21\n";
    assert_eq!(of(text, CsvOptions::default()).unwrap().time, [0.0, 115_200.0]);
}

/// A title of one word above columns that tabs separate, and a row without a value between others.
#[test]
fn one_word_above_the_header_and_a_blank_row() {
    let text = "Data1\nTime (s)\tring (\u{b0}C)\n0\t20.1\n60\t30.2\n120\t36.2\n";
    let record = of(text, CsvOptions::default()).unwrap();
    assert_eq!(record.time, [0.0, 60.0, 120.0]);
    assert_eq!(columns(&record), [("ring", vec![20.1, 30.2, 36.2])]);
    let sheet = |text: &str| {
        lptn_data::read_sheet(Path::new("n.csv"), text.as_bytes(), &CsvOptions::default())
    };
    let (sheet, _) = sheet("name;C [J/K];m [kg]\nn1;10,5;20\nn2;;\nn3;5;30\n").unwrap();
    for (column, [first, last]) in sheet.columns.iter().zip([[10.5, 5.0], [20.0, 30.0]]) {
        assert_eq!((column.values[0], column.values[2]), (first, last));
        assert!(column.values[1].is_nan());
    }
}
