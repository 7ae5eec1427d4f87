//! Tables and numbers for a terminal.

use std::fmt::Write as _;

/// Rows of cells in aligned columns, two spaces apart; numbers to the right, text to the left.
pub fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let cell = |row: &Vec<String>, c: usize| row.get(c).cloned().unwrap_or_default();
    let width: Vec<usize> =
        (0..columns).map(|c| rows.iter().map(|r| cell(r, c).chars().count()).max().unwrap_or(0)).collect();
    let numeric: Vec<bool> = (0..columns)
        .map(|c| rows.iter().skip(1).all(|r| cell(r, c) == "-" || cell(r, c).parse::<f64>().is_ok()))
        .collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for c in 0..columns {
            let (content, w) = (cell(row, c), width[c]);
            let right = numeric[c] && rows.len() > 1;
            let _ = if right { write!(line, "{content:>w$}  ") } else { write!(line, "{content:<w$}  ") };
        }
        text += "  ";
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// A number with five figures; `-` for none.
pub fn number(x: f64) -> String {
    if x.is_nan() {
        return "-".to_owned();
    }
    let size = x.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e6).contains(&size) {
        format!("{x:.4e}")
    } else {
        let decimals = (4 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

/// An accepted range, open ends left out.
pub fn range(low: Option<f64>, high: Option<f64>) -> String {
    let end = |x: Option<f64>| x.map_or_else(String::new, number);
    format!("[{}, {}]", end(low), end(high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_honest() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(f64::NAN), "-");
        assert_eq!(number(4.083_61), "4.0836");
        assert_eq!(number(-120.0), "-120");
        assert_eq!(number(123_456.0), "123456");
        assert_eq!(number(2.5e-5), "2.5000e-5");
        assert_eq!(number(1e7), "1.0000e7");
    }

    #[test]
    fn columns_line_up() {
        let rows = [["case", "peak"], ["count = 10", "0.97"], ["none", "-"]].map(|r| r.map(String::from).to_vec());
        assert_eq!(aligned(&rows), "  case        peak\n  count = 10  0.97\n  none           -\n");
    }
}
