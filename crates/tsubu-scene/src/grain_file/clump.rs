//! Clumps: the spheres of one body, as programs write them, told apart by how their files begin.
//!
//! - A molecule of LAMMPS: a title, `5 atoms`, then the sections `Coords` (id x y z) and `Diameters` (id d).
//! - Rows whose columns a line `#format x_y_z_r` tells, as YADE writes them (`export.text`, `export.textExt`, `export.textClumps`).
//! - Bare rows x, y, z, radius, between commas (CLUMP; MercuryDPM's `MClump`) or blanks (LIGGGHTS), or rows under a header as in any CSV.

use super::{Column, Rows, Slot, csv};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use crate::plan::Vector;
use crate::suggest;
use std::collections::HashMap;

/// The most spheres of a clump.
pub(crate) const MOST_PIECES: usize = 1000;

/// Reads the spheres, centre and radius, of the one clump in a text, which is the given source of complaints. A sphere that lies within
/// another one is left out: whatever it could touch, the other touches before.
pub(crate) fn read(text: &str, source: usize, space: bool) -> Result<Vec<(Vector, f64)>, Vec<Complaint>> {
    let mut rows = Rows { source, how: super::How { space, kind: None }, ..Rows::default() };
    if is_molecule(text) {
        molecule(text, &mut rows);
    } else if let Some(format) = lines(text).find(|line| line.behind('#').text.starts_with("format ")) {
        yade(text, &format, &mut rows);
    } else {
        csv::read(text, &mut rows);
    }
    let count = rows.grains.position.len();
    let nothing = |what: &str| Complaint::new(what).at(&Place::new(source, 0..0), "in this file");
    if rows.complaints.is_empty() && count == 0 {
        rows.complain(nothing("the file has no spheres"));
    }
    if rows.complaints.is_empty() && rows.grains.diameter.is_empty() {
        rows.complain(
            nothing("the file does not say how large its spheres are")
                .hint("rows are x, y, z, radius; a molecule of LAMMPS has a section `Diameters`"),
        );
    }
    let spheres: Vec<(Vector, f64)> =
        rows.grains.position.iter().zip(&rows.grains.diameter).map(|(c, d)| (*c, 0.5 * d)).collect();
    let kept = outer(&spheres);
    if rows.complaints.is_empty() && kept.len() > MOST_PIECES {
        rows.complain(nothing(&format!("the clump has {count} spheres")).hint(format!("at most {MOST_PIECES}")));
    }
    if rows.complaints.is_empty() { Ok(kept) } else { Err(rows.complaints) }
}

/// Those that do not lie within another one, in their order; no more than show that there are too many.
fn outer(spheres: &[(Vector, f64)]) -> Vec<(Vector, f64)> {
    let mut order: Vec<usize> = (0..spheres.len()).collect();
    order.sort_by(|a, b| spheres[*b].1.total_cmp(&spheres[*a].1));
    let mut kept: Vec<usize> = Vec::new();
    for i in order {
        let (centre, radius) = spheres[i];
        let holds = |j: &usize| {
            let (other, larger) = spheres[*j];
            let apart = (0..3).map(|k| (centre[k] - other[k]).powi(2)).sum::<f64>().sqrt();
            apart + radius <= larger * (1.0 + 1e-9)
        };
        if kept.len() <= MOST_PIECES && !kept.iter().any(holds) {
            kept.push(i);
        }
    }
    kept.sort_unstable();
    kept.into_iter().map(|i| spheres[i]).collect()
}

/// Rows as YADE writes them, with columns told by name: `x_y_z_r`, `x_y_z_r_matId`, `id_x_y_z_r_matId`, `x_y_z_r_clumpId`.
fn yade(text: &str, format: &Line<'_>, rows: &mut Rows) {
    let names = format.behind('#').text["format ".len()..].trim();
    let mut columns = Vec::new();
    for name in names.split('_') {
        columns.push(match name {
            "x" => Column::new(Slot::Position(0)),
            "y" => Column::new(Slot::Position(1)),
            "z" => Column::new(Slot::Position(2)),
            "r" => Column::radius(),
            "clumpId" => Column::new(Slot::Kind),
            "id" | "matId" | "mask" => Column::new(Slot::Passed),
            other => {
                return rows.complain(
                    Complaint::new(format!("the format `{names}` has a column `{other}` that cannot be read"))
                        .at(&format.place(rows.source), "columns of a clump are x, y, z, r")
                        .hint("write it with `export.text` or `export.textClumps` of YADE"),
                );
            }
        });
    }
    let mut body: Option<(u64, Line<'_>)> = None;
    for line in lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('#')) {
        let Some(row) = rows.row(&line, None, &columns) else {
            if rows.hopeless() {
                return;
            }
            continue;
        };
        let (first, begun) = *body.get_or_insert((row.kind, line));
        if row.kind != first {
            return rows.complain(
                Complaint::new("the file has several clumps")
                    .at(&line.place(rows.source), format!("clump {}", row.kind))
                    .also(&begun.place(rows.source), format!("clump {first}"))
                    .hint("keep the rows of one clump; each shape is a group of grains with a file of its own"),
            );
        }
        rows.keep(&row, &line, &columns);
    }
}

fn is_molecule(text: &str) -> bool {
    lines(text).map(|line| line.before('#')).any(|line| line.text == "Coords" || promised(&line).is_some())
}

/// `5 atoms`
fn promised(bare: &Line<'_>) -> Option<usize> {
    bare.text.strip_suffix("atoms")?.trim_end().parse().ok()
}

/// Sections of molecules; the first two are read. Masses and all that is bound say nothing of where spheres are.
const SECTIONS: [&str; 20] = [
    "Coords",
    "Diameters",
    "Types",
    "Molecules",
    "Fragments",
    "Charges",
    "Dipoles",
    "Masses",
    "Bonds",
    "Angles",
    "Dihedrals",
    "Impropers",
    "Special Bond Counts",
    "Special Bonds",
    "Shake Flags",
    "Shake Atoms",
    "Shake Bond Types",
    "Body Integers",
    "Body Doubles",
    "Shake Angle Types",
];

/// A molecule of LAMMPS (its command `molecule`).
fn molecule(text: &str, rows: &mut Rows) {
    let coords = [Slot::Id, Slot::Position(0), Slot::Position(1), Slot::Position(2)].map(Column::new);
    let sizes = [Slot::Id, Slot::Diameter].map(Column::new);
    let (mut section, mut count) = ("", None);
    let mut diameters: HashMap<u64, f64> = HashMap::new();
    // The first line is a title.
    for line in lines(text).skip(1) {
        let bare = line.before('#');
        if bare.text.is_empty() {
            continue;
        }
        if bare.text.starts_with(char::is_uppercase) {
            let Some(known) = SECTIONS.into_iter().find(|name| *name == bare.text) else {
                let near = suggest::nearest(bare.text, SECTIONS).map(|near| format!("did you mean `{near}`?"));
                return rows.complain(
                    Complaint::new(format!("`{}` is no section of a molecule of LAMMPS", bare.text))
                        .at(&bare.place(rows.source), "in this line")
                        .hints(near)
                        .hint(format!("sections: {}", suggest::list(SECTIONS))),
                );
            };
            section = known;
            continue;
        }
        let columns = match section {
            "" => {
                count = count.or_else(|| Some((promised(&bare)?, line)));
                continue;
            }
            "Coords" => &coords[..],
            "Diameters" => &sizes[..],
            _ => continue,
        };
        let Some(row) = rows.row(&bare, None, columns) else {
            if rows.hopeless() {
                return;
            }
            continue;
        };
        let again = if section == "Coords" {
            let again = rows.ids.contains(&row.id);
            rows.keep(&row, &line, columns);
            again
        } else {
            diameters.insert(row.id, row.diameter).is_some()
        };
        if again {
            return rows.complain(
                Complaint::new(format!("the atom {} is there twice", row.id))
                    .at(&line.place(rows.source), format!("again in `{section}`")),
            );
        }
    }
    if rows.complaints.is_empty() {
        whole(count, diameters, rows);
    }
}

/// Every atom that was promised has a place and a diameter.
fn whole(count: Option<(usize, Line<'_>)>, mut diameters: HashMap<u64, f64>, rows: &mut Rows) {
    let found = rows.ids.len();
    if let Some((promised, line)) = count.filter(|(promised, _)| *promised != found) {
        return rows.complain(
            Complaint::new(format!("the file promises {promised} atoms and has {found} in `Coords`"))
                .at(&line.place(rows.source), format!("says {promised}"))
                .hint("was it cut off while it was written?"),
        );
    }
    // Without any the reader of all forms says what is missing.
    if !diameters.is_empty() {
        let sizes: Vec<Option<f64>> = rows.ids.iter().map(|id| diameters.remove(id)).collect();
        if let Some(i) = sizes.iter().position(Option::is_none) {
            return rows.complain(
                Complaint::new(format!("the atom {} has no diameter", rows.ids[i]))
                    .at(&Place::new(rows.source, 0..0), format!("in `Coords` at line {}", rows.lines[i])),
            );
        }
        if let Some(id) = diameters.keys().min() {
            return rows.complain(
                Complaint::new(format!("the atom {id} has a diameter and no place"))
                    .at(&Place::new(rows.source, 0..0), "not in `Coords`"),
            );
        }
        rows.grains.diameter = sizes.into_iter().flatten().collect();
        rows.sort_by_id();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const THREE: [(Vector, f64); 3] = [([0.0, 0.0, 0.0], 1.0), ([2.0, 0.0, 0.0], 0.5), ([2.0, 1.0, 0.0], 0.5)];

    fn titles(text: &str) -> Vec<String> {
        match read(text, 0, true) {
            Ok(spheres) => panic!("{spheres:?}"),
            Err(complaints) => complaints.iter().map(|complaint| complaint.title().to_string()).collect(),
        }
    }

    /// What CLUMP (`dlmwrite`, `savetxt`), MercuryDPM, LIGGGHTS, YADE and LAMMPS write of the same three spheres.
    #[test]
    fn all_forms_say_the_same() {
        let forms = [
            "  0.000000, -0.000000,  0.000000,  1.000000\n  2.000000,  0.000000,  0.000000,  0.500000\n  2.000000,  1.000000,  0.000000,  0.500000\n",
            "0.000000000000000000e+00,0.0e+00,0.0e+00,1.0e+00\n2.0e+00,0.0e+00,0.0e+00,5.0e-01\n2.0e+00,1.0e+00,0.0e+00,5.0e-01\n",
            "0 0 0 1\n2 0 0 0.5\n2 1 0 0.5\n",
            "#format x_y_z_r\n# a remark\n0\t0\t0\t1\n2\t0\t0\t0.5\n2\t1\t0\t0.5\n",
            "#format x_y_z_r_clumpId\n0\t0\t0\t1\t7\n2\t0\t0\t0.5\t7\n2\t1\t0\t0.5\t7\n",
            "#format id_x_y_z_r_matId\n4 0 0 0 1 0\n5 2 0 0 0.5 0\n6 2 1 0 0.5 0\n",
            "# three\n\n3 atoms\n0.5 0 0 com\n\nCoords\n\n3 2 1 0\n1 0 0 0\n2 2 0 0 # here\n\nTypes\n\n1 1\n2 1\n3 1\n\nDiameters\n\n1 2.0\n2 1.0\n3 1.0\n\nMasses\n\n1 0.5\n2 0.5\n3 0.5\n",
            "x, y, z, d\n0, 0, 0, 2\n2, 0, 0, 1\n2, 1, 0, 1\n",
        ];
        for form in forms {
            let found = read(form, 0, true).unwrap_or_else(|wrong| panic!("{form}: {}", wrong[0].title()));
            assert_eq!(found, THREE, "{form}");
        }
    }

    /// CLUMP's own example of an octahedron has spheres two and three times, with another sign of zero; each would have pushed with its own spring.
    #[test]
    fn a_sphere_within_another_is_left_out() {
        let text = "0 0 0 1\n2 0 0 0.5\n0.2 0 0 0.5\n2 1 0 0.5\n2 -0 0 0.5\n";
        assert_eq!(read(text, 0, true).expect("three are left"), THREE);
    }

    #[test]
    fn files_that_are_wrong() {
        assert_eq!(titles(""), ["the file has no spheres"]);
        assert_eq!(titles("0 0 0\n1 0 0\n"), ["the file does not say how large its spheres are"]);
        assert_eq!(titles("0 0 0 1\n1 0 0 -1\n"), ["`-1` is no size of a grain"]);
        assert_eq!(titles("0 0 0 1\n1 0 zero 1\n"), ["`zero` is not a number"]);
        assert_eq!(titles("#format x_y_z_r_clumpId\n0 0 0 1 3\n0 0 1 1 4\n"), ["the file has several clumps"]);
        assert_eq!(
            titles("#format x_y_z_r_attrs\n0 0 0 1 3\n"),
            ["the format `x_y_z_r_attrs` has a column `attrs` that cannot be read"]
        );
        let many: Vec<String> = (0..1001).map(|i| format!("{} 0 0 1\n", 3 * i)).collect();
        assert_eq!(titles(&many.concat()), ["the clump has 1001 spheres"]);
        let two = "title\n2 atoms\nCoords\n\n1 0 0 0\n2 1 0 0\n\nDiameters\n\n1 1\n2 1\n";
        assert_eq!(read(two, 0, true).expect("two").len(), 2);
        let wrong = |from: &str, to: &str| titles(&two.replace(from, to));
        assert_eq!(wrong("2 atoms", "3 atoms"), ["the file promises 3 atoms and has 2 in `Coords`"]);
        assert_eq!(wrong("1 1\n2 1\n", "1 1\n"), ["the atom 2 has no diameter"]);
        assert_eq!(wrong("1 1\n2 1\n", "1 1\n2 1\n3 1\n"), ["the atom 3 has a diameter and no place"]);
        assert_eq!(wrong("2 1 0 0", "1 1 0 0"), ["the atom 1 is there twice"]);
        assert_eq!(wrong("Diameters", "Diameter"), ["`Diameter` is no section of a molecule of LAMMPS"]);
        assert_eq!(wrong("Diameters\n\n1 1\n2 1\n", ""), ["the file does not say how large its spheres are"]);
    }
}
