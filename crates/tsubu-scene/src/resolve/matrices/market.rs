//! Matrices in the exchange format of the Matrix Market (Boisvert, Pozo and Remington 1996): real, general or symmetric, as
//! coordinates or as an array.

use super::MOST;
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use std::collections::BTreeSet;

/// Reads a square matrix, row by row. The text is the given source.
pub(super) fn read(text: &str, source: usize) -> Result<Vec<Vec<f64>>, Complaint> {
    let mut left = lines(text).filter(|line| !line.text.is_empty());
    let wrong =
        |line: &Line<'_>, title: &str, label: &str| Complaint::new(title).at(&line.place(source), label.to_owned());
    let ended =
        || Complaint::new("the matrix ends too soon").at(&Place::new(source, text.len()..text.len()), "more is needed");
    let head = left.next().ok_or_else(ended)?;
    let words: Vec<String> = head.text.split_whitespace().map(str::to_lowercase).collect();
    let form: Vec<&str> = words.iter().map(String::as_str).collect();
    let [
        "%%matrixmarket",
        "matrix",
        layout @ ("coordinate" | "array"),
        "real" | "integer",
        symmetry @ ("general" | "symmetric"),
    ] = form.as_slice()
    else {
        return Err(wrong(
            &head,
            "the file does not begin as one of the Matrix Market that can be read",
            "not such a line",
        )
        .hint("it begins with `%%MatrixMarket matrix coordinate real symmetric`, or `array` and `general`"));
    };
    let mut left = left.filter(|line| !line.text.starts_with('%'));
    let sizes = left.next().ok_or_else(ended)?;
    let whole: Vec<usize> = sizes.text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let coordinates = *layout == "coordinate";
    let (n, entries) = match (whole.as_slice(), coordinates) {
        ([rows, columns, entries], true) if rows == columns => (*rows, *entries),
        ([rows, columns], false) if rows == columns => {
            (*rows, if *symmetry == "symmetric" { rows * (rows + 1) / 2 } else { rows * rows })
        }
        _ => {
            return Err(wrong(
                &sizes,
                "these are not the sizes of a square matrix",
                "rows, columns, and for `coordinate` entries",
            ));
        }
    };
    if n == 0 || n > MOST {
        return Err(wrong(&sizes, "the matrix is too large or empty", &format!("1 to {MOST} coordinates can be read"))
            .hint("reduce the structure to its interfaces, or give its modes in a `modal-table`"));
    }
    let mut matrix = vec![vec![0.0; n]; n];
    // An array goes column by column; of a symmetric one the lower triangle is written.
    let (mut row, mut column) = (0, 0);
    let mut told = BTreeSet::new();
    for _ in 0..entries {
        let line = left.next().ok_or_else(ended)?;
        let mut cells = line.text.split_whitespace();
        if coordinates {
            let mut place = || cells.next()?.parse::<usize>().ok()?.checked_sub(1).filter(|index| *index < n);
            (row, column) = place().zip(place()).ok_or_else(|| {
                wrong(
                    &line,
                    "this is no entry of the matrix",
                    &format!("needs row and column from 1 to {n}, and a value"),
                )
            })?;
            let mirrored = *symmetry == "symmetric" && told.contains(&(column, row));
            if !told.insert((row, column)) || mirrored {
                return Err(wrong(&line, "the matrix has this entry twice", "again"));
            }
        }
        let value = cells.next().and_then(|cell| cell.parse::<f64>().ok()).filter(|value| value.is_finite());
        let value = value.ok_or_else(|| wrong(&line, "this is no entry of the matrix", "needs a finite number"))?;
        matrix[row][column] = value;
        if *symmetry == "symmetric" {
            matrix[column][row] = value;
        }
        row += 1;
        if row == n {
            column += 1;
            row = if *symmetry == "symmetric" { column } else { 0 };
        }
    }
    match left.next() {
        Some(line) => Err(wrong(&line, "the matrix has more entries than it says", "one too many")),
        None => Ok(matrix),
    }
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn all_forms_are_read() {
        let expected = vec![vec![2.0, -1.0], vec![-1.0, 3.0]];
        for text in [
            "%%MatrixMarket matrix coordinate real symmetric\n% made by hand\n2 2 3\n1 1 2\n2 1 -1\n2 2 3\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 2\n2 1 -1\n1 2 -1\n2 2 3\n",
            "%%MatrixMarket matrix array real symmetric\n2 2\n2\n-1\n3\n",
            "%%MatrixMarket matrix array real general\n2 2\n2.0\n-1\n-1e0\n3\n",
        ] {
            assert_eq!(read(text, 0).unwrap_or_else(|wrong| panic!("{wrong:?}")), expected, "{text}");
        }
    }

    #[test]
    fn what_is_cut_short_or_no_matrix_is_refused() {
        for text in [
            "",
            "1 1 2\n",
            "%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 2 0\n",
            "%%MatrixMarket matrix coordinate real general\n2 1 1\n1 1 2\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 2\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 2\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 1\n0 1 2\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 1\n1 1 nan\n",
            "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 2\n1 1 3\n",
            "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n1 2 -1\n",
            "%%MatrixMarket matrix array real general\n1 1\n2\n3\n",
            "%%MatrixMarket matrix array real general\n99999 99999\n2\n",
        ] {
            assert!(read(text, 0).is_err(), "{text}");
        }
    }
}
