//! CSV tables and the history of a run.

use std::fs;

use proptest::prelude::*;
use tsubu_frame::{Advise, Cell, History, Mark, Table};

#[test]
fn columns_are_found_with_or_without_their_unit() {
    let table = Table::parse("time [s],case [text],n [-]\n0,20,1\n1.5,\"a, \"\"b\"\"\",\n").unwrap();
    assert_eq!(table.numbers("time [s]").unwrap(), [0.0, 1.5]);
    assert_eq!(table.texts("case").unwrap(), ["20", "a, \"b\""]);
    assert!(table.numbers("n").unwrap()[1].is_nan());
    assert!(table.numbers("mass").is_none());
    assert_eq!(Table::parse(&table.to_csv()).unwrap(), table);
}

#[test]
fn a_line_being_written_is_left_out() {
    let table = Table::parse("time [s],x [m]\n0,1\n1,2\n2,").unwrap();
    assert_eq!(table.rows.len(), 2);
    assert!(Table::parse("").is_err());
    assert!(Table::parse("a,b\n1\n").unwrap_err().contains("row 1 has 1 cells"));
}

/// A missing, cut or edited history was gone on with in silence.
#[test]
fn a_resumed_history_is_the_one_of_the_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("history.csv");
    let header = ["time [s]", "displacement [m]"];
    let mut history = History::create(&path, &header).unwrap();
    let rows = |from: u32, to: u32, history: &mut History| {
        (from..to).for_each(|i| history.append(&[f64::from(i) * 0.1, f64::from(i)]).unwrap());
    };
    rows(0, 4, &mut history);
    let mark = history.sync().unwrap();
    let checkpoint = fs::read(&path).unwrap();
    rows(4, 10, &mut history);
    drop(history);
    let whole = fs::read(&path).unwrap();
    assert_eq!(Mark::from_numbers(&mark.numbers()), Some(mark));

    let edited = String::from_utf8(whole.clone()).unwrap().replace("0.2,2", "0.2,7").into_bytes();
    let shorter = &checkpoint[..checkpoint.len() - 1];
    for (content, said) in
        [(Some(&edited[..]), "have been changed"), (Some(shorter), "are missing"), (None, "not there")]
    {
        match content {
            Some(content) => fs::write(&path, content).unwrap(),
            None => fs::remove_file(&path).unwrap(),
        }
        let error = History::resume(&path, &header, mark).unwrap_err();
        let (text, hints) = (error.to_string(), error.hints());
        assert!(text.contains("history.csv") && text.contains(said), "{text}");
        assert!(hints.iter().any(|hint| hint.to_string().contains("--overwrite")), "{hints:?}");
        assert_eq!(fs::read(&path).ok().as_deref(), content, "a refusal changed the file");
    }

    // Rows behind the checkpoint, one of them cut, are computed again.
    fs::write(&path, [&whole[..], b"1.0,9"].concat()).unwrap();
    let mut history = History::resume(&path, &header, mark).unwrap();
    rows(4, 10, &mut history);
    let end = history.sync().unwrap();
    assert_eq!(fs::read(&path).unwrap(), whole);
    end.check(&path).unwrap();
    let error = History::resume(&path, &["time [s]", "other [m]"], end).unwrap_err().to_string();
    assert!(error.contains("history.csv") && error.contains("columns"), "{error}");
}

#[test]
fn rows_reach_the_file_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("history.csv");
    let mut history = History::create(&path, &["time [s]", "x [m]", "y [m]"]).unwrap();
    for i in 0..20_000 {
        history.append(&[f64::from(i), 1.0 / f64::from(i), 1e-300]).unwrap();
        if i % 997 == 0 {
            assert!(fs::read(&path).unwrap().ends_with(b"\n"));
        }
    }
    drop(history);
    assert_eq!(Table::read(&path).unwrap().rows.len(), 20_000);
}

proptest! {
    #[test]
    fn numbers_come_back_bit_by_bit(x in any::<f64>().prop_filter("one NaN is as good as another", |x| !x.is_nan())) {
        let mut table = Table::new(["x [-]"]);
        table.push([Cell::Number(x)]);
        let back = Table::parse(&table.to_csv()).unwrap().numbers("x").unwrap()[0];
        prop_assert_eq!(back.to_bits(), x.to_bits());
    }

    #[test]
    fn text_comes_back(text in "[ -~\n\u{e9}]{0,20}") {
        let mut table = Table::new(["t [text]", "n [-]"]);
        table.push([Cell::Text(text), Cell::Number(1.0)]);
        prop_assert_eq!(Table::parse(&table.to_csv()).unwrap(), table);
    }

    #[test]
    fn garbage_never_panics(text in "\\PC{0,200}|[a,\"\r\n 1]{0,60}") {
        let _ = Table::parse(&text);
    }
}
