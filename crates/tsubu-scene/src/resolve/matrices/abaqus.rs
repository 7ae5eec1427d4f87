//! Matrices as Abaqus writes them: entry by entry (`*MATRIX OUTPUT, FORMAT=MATRIX INPUT`), with node and direction of row and column; or
//! those of a substructure as a user element (`*SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED`), which CalculiX writes, too.

use super::{Coordinate, Matrix, Role, number};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};

/// Reads either.
pub(super) fn read(text: &str, source: usize, role: Role) -> Result<Matrix, Complaint> {
    let element = lines(text).any(|line| keyword(&line).is_some_and(|word| word.starts_with("*USER ELEMENT")));
    if element { user_element(text, source, role) } else { entries(text, source) }
}

/// A line that begins a block, in capitals.
fn keyword(line: &Line<'_>) -> Option<String> {
    (line.text.starts_with('*') && !line.text.starts_with("**")).then(|| line.text.to_uppercase())
}

fn wrong(line: &Line<'_>, source: usize, label: &str) -> Complaint {
    Complaint::new("this is no entry of the matrix").at(&line.place(source), label.to_owned())
}

/// `node, direction, node, direction, value` in every line.
fn entries(text: &str, source: usize) -> Result<Matrix, Complaint> {
    let mut matrix = Matrix::default();
    for line in lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('*')) {
        let cells: Vec<&str> = line.text.split(',').map(str::trim).filter(|cell| !cell.is_empty()).collect();
        let entry = match cells.as_slice() {
            [row, a, column, b, value] => (coordinate(row, a).zip(coordinate(column, b))).zip(number(value)),
            _ => None,
        };
        let label = "needs node and direction of row and column, and a finite number";
        let ((row, column), value) = entry.ok_or_else(|| wrong(&line, source, label))?;
        matrix.set(row, column, value);
    }
    Ok(matrix.mirrored())
}

/// Internal coordinates of Abaqus have negative nodes or direction 0.
fn coordinate(node: &str, direction: &str) -> Option<Coordinate> {
    let node: i64 = node.parse().ok()?;
    let direction: u8 = direction.parse().ok().filter(|direction| *direction <= 6)?;
    Some(Coordinate { node: node.unsigned_abs(), direction: if node > 0 { direction } else { 0 } })
}

/// Nodes in the comment below `** ELEMENT NODES`; directions of the first node, then lines `place, directions` from where they
/// change; lower triangles, row by row, each below `*MATRIX, TYPE=`.
fn user_element(text: &str, source: usize, role: Role) -> Result<Matrix, Complaint> {
    #[derive(PartialEq)]
    enum Block {
        Other,
        Directions,
        Matrix,
    }
    let (mut nodes, mut listing) = (Vec::<u64>::new(), false);
    let mut changes: Vec<(usize, Vec<u8>)> = Vec::new();
    let (mut values, mut block, mut found) = (Vec::new(), Block::Other, false);
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        if let Some(comment) = line.text.strip_prefix("**") {
            if comment.to_uppercase().contains("ELEMENT NODES") {
                listing = true;
            } else if listing {
                nodes.extend(comment.split(',').filter_map(|cell| cell.trim().parse::<u64>().ok()));
            }
            continue;
        }
        listing = false;
        let whole = |cell: &str| cell.trim().parse::<usize>().ok();
        if let Some(word) = keyword(&line) {
            let this = word.replace(' ', "").contains(&format!("TYPE={}", role.key().to_uppercase()));
            block = match word.split(',').next() {
                Some("*USER ELEMENT") => Block::Directions,
                Some("*MATRIX") if this => Block::Matrix,
                _ => Block::Other,
            };
            found |= block == Block::Matrix;
        } else if block == Block::Directions {
            let cells: Option<Vec<usize>> =
                line.text.split(',').filter(|cell| !cell.trim().is_empty()).map(whole).collect();
            let cells = cells.ok_or_else(|| wrong(&line, source, "needs directions, 1 to 6"))?;
            let (place, directions) = if changes.is_empty() { (1, &cells[..]) } else { (cells[0], &cells[1..]) };
            changes.push((place, directions.iter().map(|direction| *direction as u8).collect()));
        } else if block == Block::Matrix {
            for cell in line.text.split(',').map(str::trim).filter(|cell| !cell.is_empty()) {
                values.push(number(cell).ok_or_else(|| wrong(&line, source, "needs finite numbers"))?);
            }
        }
    }
    let end = Place::new(source, text.len()..text.len());
    if !found {
        let key = role.key();
        return Err(Complaint::new(format!("there is no {key} in this file"))
            .at(&end, format!("no block *MATRIX, TYPE={}", key.to_uppercase()))
            .hint(format!("let *SUBSTRUCTURE MATRIX OUTPUT write it, with {}=YES", key.to_uppercase())));
    }
    let directions =
        |place: usize| changes.iter().rev().find(|change| change.0 <= place + 1).map_or(&[][..], |change| &change.1);
    let coordinates: Vec<Coordinate> = nodes
        .iter()
        .enumerate()
        .flat_map(|(place, node)| {
            directions(place).iter().map(|direction| Coordinate { node: *node, direction: *direction })
        })
        .collect();
    let n = coordinates.len();
    if values.len() != n * (n + 1) / 2 {
        return Err(Complaint::new("the matrix has another size than its nodes say").at(
            &end,
            format!("{} numbers for a lower triangle of {n} coordinates, which has {}", values.len(), n * (n + 1) / 2),
        ));
    }
    let mut matrix = Matrix::default();
    let triangle = (0..n).flat_map(|row| (0..=row).map(move |column| (row, column)));
    for ((row, column), value) in triangle.zip(values) {
        matrix.set(coordinates[row], coordinates[column], value);
    }
    Ok(matrix.mirrored())
}

#[cfg(test)]
mod tests {
    use super::super::AS_WRITTEN;
    use super::*;

    const THREE: [Coordinate; 3] = [
        Coordinate { node: 7, direction: 1 },
        Coordinate { node: 7, direction: 3 },
        Coordinate { node: 9, direction: 3 },
    ];
    const ROWS: [[f64; 3]; 3] = [[4.0, 0.5, 0.0], [0.5, 3.0, -1.0], [0.0, -1.0, 2.0]];

    #[test]
    fn both_forms_are_read() {
        let by_entry = "** MATRIX\n7,1, 7,1, 4.0\n7,3, 7,1, 5.0D-01\n7,3, 7,3, 3.0\n9,3, 7,3, -1.0\n9,3, 9,3, 2.0\n";
        let element = "*USER ELEMENT,NODES= 2,LINEAR\n** ELEMENT NODES\n** 7, 9\n1, 3\n2, 3\n*MATRIX,TYPE=MASS\n9.,\n\
                       *MATRIX,TYPE=STIFFNESS\n 4.0,\n 0.5, 3.0,\n 0.0, -1.0,\n 2.0\n";
        // As CalculiX writes it: a node for each coordinate.
        let places = element.replace("NODES= 2", "NODES=         3").replace(
            "** 7, 9\n1, 3\n2, 3\n",
            "**         7,         7,         9\n         1\n         2,         3\n         3,         3\n",
        );
        for text in [by_entry, element, &places] {
            let matrix = read(text, 0, Role::Stiffness).unwrap_or_else(|wrong| panic!("{wrong:?}"));
            assert_eq!(matrix.rows(&THREE, AS_WRITTEN), ROWS, "{text}");
        }
        assert!(read(element, 0, Role::Mass).is_err() && read(element, 0, Role::Damping).is_err());
    }

    #[test]
    fn what_is_no_matrix_is_refused() {
        for text in [
            "1,1,1,1\n",
            "1,7,1,1,2.\n",
            "1,1,1,1,x\n",
            "*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** 1\n1,2\n*MATRIX,TYPE=STIFFNESS\n1.,2.\n",
        ] {
            assert!(read(text, 0, Role::Stiffness).is_err(), "{text}");
        }
    }
}
