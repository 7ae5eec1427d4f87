//! Matrices that CalculiX stores (`*FREQUENCY, SOLVER=MATRIXSTORAGE`): `.sti` and `.mas`, a line for each entry of the upper triangle, with
//! row, column and value; and `.dof`, the node and the direction of each coordinate.

use super::{Coordinate, Matrix};
use crate::complaint::Complaint;
use crate::lines::lines;

/// Reads `.dof`: a line `node.direction` for each coordinate.
pub(in crate::resolve) fn names(text: &str, source: usize) -> Result<Vec<Coordinate>, Complaint> {
    let name = |line: crate::lines::Line<'_>| {
        let named = line.text.split_once('.').and_then(|(node, direction)| {
            let direction = direction.parse().ok().filter(|direction| (1..=6).contains(direction))?;
            Some(Coordinate { node: node.parse().ok()?, direction })
        });
        named.ok_or_else(|| {
            Complaint::new("this is no coordinate")
                .at(&line.place(source), "needs node and direction, for example 12.3")
        })
    };
    lines(text).filter(|line| !line.text.is_empty()).map(name).collect()
}

/// Reads `.sti` or `.mas`.
pub(super) fn read(text: &str, source: usize, names: Option<&[Coordinate]>) -> Result<Matrix, Complaint> {
    let mut matrix = Matrix::default();
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        let words: Vec<&str> = line.text.split_whitespace().collect();
        let coordinate = |word: &str| {
            let number = word.parse::<usize>().ok().filter(|number| *number > 0)?;
            match names {
                Some(names) => names.get(number - 1).copied(),
                None => Some(Coordinate { node: number as u64, direction: 0 }),
            }
        };
        let entry = match words.as_slice() {
            [row, column, value] => {
                let value = value.parse::<f64>().ok().filter(|value| value.is_finite());
                coordinate(row).zip(coordinate(column)).zip(value)
            }
            _ => None,
        };
        let ((row, column), value) = entry.ok_or_else(|| {
            let known = names.map_or(String::new(), |names| format!(", numbered from 1 to {}", names.len()));
            Complaint::new("this is no entry of the matrix")
                .at(&line.place(source), format!("needs row, column{known}, and a finite number"))
        })?;
        matrix.set(row, column, value);
    }
    Ok(matrix.mirrored())
}

#[cfg(test)]
mod tests {
    use super::super::AS_WRITTEN;
    use super::*;

    #[test]
    fn the_upper_triangle_is_mirrored() {
        let names = names("5.1\n5.3\n", 0).expect("two coordinates");
        let matrix = read("1 1  2.0e+00\n1 2 -1.0e+00\n2 2  3.0e+00\n", 0, Some(&names)).expect("a matrix");
        assert_eq!(matrix.rows(&names, AS_WRITTEN), [[2.0, -1.0], [-1.0, 3.0]]);
    }

    #[test]
    fn what_is_no_matrix_is_refused() {
        let two = [1, 2].map(|direction| Coordinate { node: 5, direction });
        for text in ["1 1\n", "1 3 2.0\n", "0 1 2.0\n", "1 1 nan\n", "1 1 x\n"] {
            assert!(read(text, 0, Some(&two)).is_err(), "{text}");
        }
        for text in ["5\n", "5.7\n", "x.1\n"] {
            assert!(names(text, 0).is_err(), "{text}");
        }
    }
}
