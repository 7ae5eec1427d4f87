//! Matrices as Nastran writes them: `DMIG` entries of a punch file (`.pch`), in small, large or free fields, with node and direction of each
//! column and its rows.

use super::{Coordinate, Matrix, Role, number};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use std::collections::BTreeMap;

/// Width of a small field, and of the first of every line.
const SMALL: usize = 8;
const LARGE: usize = 16;

/// Reads the matrix of a file for a role: the only one, or the only one whose name begins as Nastran names it, K, M or B.
pub(super) fn read(text: &str, source: usize, role: Role) -> Result<Matrix, Complaint> {
    let mut all: BTreeMap<String, Found> = BTreeMap::new();
    // The matrix and the column that entries belong to.
    let mut at: Option<(String, Coordinate)> = None;
    let mut ours = false;
    for line in lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('$')) {
        let raw = whole(text, &line);
        let continues = raw.starts_with([' ', '*', '+', ',']);
        let fields = fields(raw);
        let rows = if continues {
            if !ours {
                continue;
            }
            &fields[1..]
        } else {
            ours = fields[0].trim_end_matches('*').eq_ignore_ascii_case("DMIG");
            if !ours {
                continue;
            }
            let [name, column, direction] = [1, 2, 3].map(|index| fields.get(index).copied().unwrap_or_default());
            if column == "0" {
                let form = direction;
                let kind = fields.get(4).copied().unwrap_or_default();
                if !["1", "6"].contains(&form) || !["1", "2", "0", ""].contains(&kind) {
                    return Err(Complaint::new(format!("the matrix `{name}` is not square and real")).at(
                        &line.place(source),
                        format!("its form is {form} and its type {kind}; 1 or 6, and 1 or 2 can be read"),
                    ));
                }
                all.entry(name.to_uppercase()).or_default().symmetric = form == "6";
                at = None;
                continue;
            }
            let place = coordinate(column, direction).ok_or_else(|| wrong(&line, source))?;
            at = Some((name.to_uppercase(), place));
            fields.get(5..).unwrap_or_default()
        };
        let Some((name, column)) = &at else { continue };
        for entry in rows.chunks(4).filter(|entry| entry.iter().any(|field| !field.is_empty())) {
            let of = |index: usize| entry.get(index).copied().unwrap_or_default();
            let read = coordinate(of(0), of(1)).zip(number(of(2)));
            let (row, value) = read.ok_or_else(|| wrong(&line, source))?;
            all.entry(name.clone()).or_default().matrix.set(row, *column, value);
        }
    }
    chosen(all, role, &Place::new(source, text.len()..text.len()))
}

#[derive(Default)]
struct Found {
    matrix: Matrix,
    symmetric: bool,
}

fn chosen(mut all: BTreeMap<String, Found>, role: Role, end: &Place) -> Result<Matrix, Complaint> {
    let letter = match role {
        Role::Mass => 'M',
        Role::Damping => 'B',
        Role::Stiffness => 'K',
    };
    let names: Vec<String> = all.keys().cloned().collect();
    let named: Vec<&String> = names.iter().filter(|name| names.len() == 1 || name.starts_with(letter)).collect();
    let only = if let [only] = named[..] { all.remove(only) } else { None };
    let found = only.ok_or_else(|| {
        if names.is_empty() {
            return Complaint::new("there is no matrix in this file")
                .at(end, "nothing that can be read")
                .hint("Matrix Market begins with `%%MatrixMarket`, Nastran's matrices with `DMIG`")
                .hint("those of Abaqus and CalculiX have node, direction, node, direction, value, or row, column, value, in every line");
        }
        Complaint::new(format!("the {} is not found in this file", role.key()))
            .at(end, format!("matrices here: {}", names.join(", ")))
            .hint(format!("of several matrices the one is read whose name begins with {letter}"))
    })?;
    Ok(if found.symmetric { found.matrix.mirrored() } else { found.matrix })
}

fn wrong(line: &Line<'_>, source: usize) -> Complaint {
    Complaint::new("this is no entry of a DMIG matrix")
        .at(&line.place(source), "needs nodes, directions and finite numbers, field by field")
}

/// The line with the blanks that it begins with, which count.
fn whole<'a>(text: &'a str, line: &Line<'a>) -> &'a str {
    let begin = text[..line.begin].rfind('\n').map_or(0, |end| end + 1);
    &text[begin..line.begin + line.text.len()]
}

/// The fields of a line: between commas, or 8 wide, or, with an asterisk in the first, 16 wide.
fn fields(line: &str) -> Vec<&str> {
    if line.contains(',') {
        return line.split(',').map(str::trim).collect();
    }
    let head = line.get(..SMALL).unwrap_or(line);
    let wide = if head.contains('*') { LARGE } else { SMALL };
    // Eight fields of 8 or four of 16; behind them stands what names the next line.
    let rest = line.get(SMALL..).unwrap_or_default();
    let rest = rest.get(..8 * SMALL).unwrap_or(rest);
    let cut = (0..rest.len().div_ceil(wide))
        .map(|i| rest.get(i * wide..((i + 1) * wide).min(rest.len())).unwrap_or_default());
    std::iter::once(head).chain(cut).map(str::trim).collect()
}

/// A scalar point has no direction, or 0.
fn coordinate(node: &str, direction: &str) -> Option<Coordinate> {
    let direction =
        if direction.is_empty() { Some(0) } else { direction.parse().ok().filter(|direction| *direction <= 6) };
    Some(Coordinate { node: node.parse().ok()?, direction: direction? })
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
    const ROWS: [[f64; 3]; 3] = [[4.0e7, 0.5, 0.0], [0.5, 3.0, -1.0], [0.0, -1.0, 2.0]];

    /// Large fields without a blank between direction and number, as punch files have them; small fields; commas.
    #[test]
    fn all_forms_are_read() {
        let large = "\
DMIG    KAAX           0       6       2       0                       9
DMIG*   KAAX                           7               1
*                      7               1 4.000000000D+07
*                      7               3 5.000000000D-01
DMIG*   KAAX                           7               3
*                      7               3 3.000000000D+00
DMIG*   KAAX                           9               3
*                      7               3-1.000000000D+00
*                      9               3 2.000000000D+00
DMIG    MAAX           0       6       2       0
DMIG*   MAAX                           7               1
*                      7               1 1.000000000D+00
";
        let small = "\
$ a comment
DMIG    STIF    0       1       1
DMIG    STIF    7       1               7       1       4.+7
        7       3       .5
DMIG    STIF    7       3               7       1       .5
        7       3       3.              9       3       -1.
DMIG    STIF    9       3               7       3       -1.
        9       3       2.
GRID    7               0.      0.      0.
";
        let free =
            "DMIG,K,0,6,1,0\nDMIG,K,7,1,,7,1,4.0E7,\n,7,3,.5,\nDMIG,K,7,3,,7,3,3.,,9,3,-1.\nDMIG,K,9,3,,9,3,2.\n";
        for text in [large, small, free] {
            let matrix = read(text, 0, Role::Stiffness).unwrap_or_else(|wrong| panic!("{wrong:?}\n{text}"));
            assert_eq!(matrix.rows(&THREE, AS_WRITTEN), ROWS, "{text}");
        }
        assert_eq!(read(large, 0, Role::Mass).expect("the mass").rows(&THREE[..1], AS_WRITTEN), [[1.0]]);
        assert!(read(large, 0, Role::Damping).is_err());
    }

    #[test]
    fn what_is_no_matrix_is_refused() {
        for text in [
            "",
            "GRID,7,,0.,0.,0.\n",
            "DMIG,K,0,2,1,0\nDMIG,K,7,1,,7,1,4.\n",
            "DMIG,K,0,6,3,0\nDMIG,K,7,1,,7,1,4.\n",
            "DMIG,K,7,1,,7,8,4.\n",
            "DMIG,K,7,1,,7,1,x\n",
        ] {
            assert!(read(text, 0, Role::Stiffness).is_err(), "{text}");
        }
    }
}
