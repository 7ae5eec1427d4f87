//! Triangles from STL (binary and ASCII) and OBJ files.
//!
//! The text formats are read in double precision, and a wrong line is told by its number.

use crate::complaint::Complaint;
use crate::grain_file::ending;
use crate::lines::{Cell, Line, MOST_COMPLAINTS, lines};
use crate::plan::Vector;

type Read = Result<Vec<[Vector; 3]>, Vec<Complaint>>;

const HEAD: usize = 84;
const RECORD: usize = 50;

/// Whether a file of this name can be read; the complaint has yet to be placed.
pub(crate) fn known(name: &str) -> Result<(), Complaint> {
    match ending(name).as_str() {
        "stl" | "obj" => Ok(()),
        _ => Err(Complaint::new(format!("the ending of `{name}` tells no format of meshes"))
            .hint("formats: `.stl` (binary or text), `.obj`")),
    }
}

/// Reads the triangles of the file of that name. Complaints about a text point into it as the given source; others
/// have no place.
pub(crate) fn read(name: &str, bytes: &[u8], source: usize) -> Read {
    let triangles = if ending(name) == "stl" {
        match binary(bytes) {
            Some(triangles) => triangles,
            None => ascii(text(bytes)?, source)?,
        }
    } else {
        obj(text(bytes)?, source)?
    };
    if triangles.is_empty() {
        return Err(vec![Complaint::new(format!("`{name}` has no triangles"))]);
    }
    Ok(triangles)
}

fn text(bytes: &[u8]) -> Result<&str, Vec<Complaint>> {
    std::str::from_utf8(bytes).map_err(|_| {
        vec![
            Complaint::new("the file is neither text nor a whole binary STL file")
                .hint("a binary STL file has 84 bytes and 50 for each triangle; was it cut off?"),
        ]
    })
}

/// Told by its length: there are binary files that begin with the word `solid`, as text does.
fn binary(bytes: &[u8]) -> Option<Vec<[Vector; 3]>> {
    let count = u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?) as usize;
    if bytes.len() != HEAD + RECORD * count {
        return None;
    }
    let number = |at: &[u8]| f32::from_le_bytes([at[0], at[1], at[2], at[3]]);
    let corner = |at: &[u8]| [number(&at[0..4]), number(&at[4..8]), number(&at[8..12])].map(f64::from);
    // The normal (12 bytes) says again what the corners say, and is wrong in many files.
    let triangle = |at: &[u8]| [corner(&at[12..24]), corner(&at[24..36]), corner(&at[36..48])];
    Some(bytes[HEAD..].chunks_exact(RECORD).map(triangle).collect())
}

/// `vertex x y z` three times between `outer loop` and `endloop`; the rest is decoration.
fn ascii(text: &str, source: usize) -> Read {
    let mut triangles = Vec::new();
    let mut corners: Vec<Vector> = Vec::new();
    let mut complaints = Vec::new();
    let mut open = None;
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        let mut cells = line.cells(None);
        let word = cells.next().map(|cell| cell.text.to_ascii_lowercase()).unwrap_or_default();
        let cells: Vec<Cell<'_>> = cells.collect();
        match word.as_str() {
            "vertex" => match corner(&line, &cells, source) {
                Ok(corner) => corners.push(corner),
                Err(complaint) => complaints.push(complaint),
            },
            "facet" => open = Some(line),
            "endfacet" => {
                open = None;
                if let Ok(triangle) = <[Vector; 3]>::try_from(corners.as_slice()) {
                    triangles.push(triangle);
                } else if complaints.is_empty() {
                    complaints.push(
                        Complaint::new("a facet has not three corners")
                            .at(&line.place(source), format!("ends with {}", corners.len())),
                    );
                }
                corners.clear();
            }
            "outer" | "endloop" | "solid" | "endsolid" => {}
            _ => complaints.push(
                Complaint::new(format!("`{word}` is no word of an STL file")).at(&line.place(source), "in this line"),
            ),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if let (Some(line), true) = (open, complaints.is_empty()) {
        complaints.push(
            Complaint::new("the file ends within a facet")
                .at(&line.place(source), "begins here")
                .hint("was it cut off while it was written?"),
        );
    }
    if complaints.is_empty() { Ok(triangles) } else { Err(complaints) }
}

/// Corners `v` and faces `f`; polygons are cut into fans. Normals, textures, names and groups are passed over.
fn obj(text: &str, source: usize) -> Read {
    let mut corners: Vec<Vector> = Vec::new();
    let mut triangles = Vec::new();
    let mut complaints = Vec::new();
    for line in lines(text) {
        let bare = line.before('#');
        let mut cells = bare.cells(None);
        let word = cells.next().map(|cell| cell.text);
        let cells: Vec<Cell<'_>> = cells.collect();
        match word {
            Some("v") => match corner(&bare, &cells, source) {
                Ok(corner) => corners.push(corner),
                Err(complaint) => complaints.push(complaint),
            },
            Some("f") => match face(&bare, &cells, &corners, source) {
                Ok(polygon) => triangles.extend(polygon.windows(2).skip(1).map(|edge| [polygon[0], edge[0], edge[1]])),
                Err(complaint) => complaints.push(complaint),
            },
            _ => {}
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() { Ok(triangles) } else { Err(complaints) }
}

fn corner(line: &Line<'_>, cells: &[Cell<'_>], source: usize) -> Result<Vector, Complaint> {
    let mut corner = [0.0; 3];
    if cells.len() < 3 {
        return Err(Complaint::new("a corner needs three numbers")
            .at(&line.place(source), format!("{} in this line", cells.len())));
    }
    for (number, cell) in corner.iter_mut().zip(cells) {
        *number = cell.text.parse().map_err(|_| {
            Complaint::new(format!("`{}` is not a number", cell.text)).at(&cell.place(source), "needs a number")
        })?;
    }
    Ok(corner)
}

fn face(line: &Line<'_>, cells: &[Cell<'_>], corners: &[Vector], source: usize) -> Result<Vec<Vector>, Complaint> {
    if cells.len() < 3 {
        return Err(Complaint::new("a face needs three corners or more")
            .at(&line.place(source), format!("{} in this line", cells.len())));
    }
    let one = |cell: &Cell<'_>| {
        let typed: Option<i64> = cell.text.split('/').next().and_then(|index| index.parse().ok());
        // From 1 upwards from the first, from -1 downwards from the last.
        let index = typed.map(|index| if index < 0 { index + corners.len() as i64 } else { index - 1 });
        let corner = index.and_then(|index| usize::try_from(index).ok()).and_then(|index| corners.get(index));
        corner.copied().ok_or_else(|| {
            Complaint::new(format!("there is no corner `{}`", cell.text))
                .at(&cell.place(source), format!("{} corners stand above this line", corners.len()))
        })
    };
    cells.iter().map(one).collect()
}

/// The corners scaled and shifted.
pub(crate) fn placed(triangles: &[[Vector; 3]], scale: f64, shift: Vector) -> Vec<[Vector; 3]> {
    let corner = |corner: Vector| [0, 1, 2].map(|axis| corner[axis] * scale + shift[axis]);
    triangles.iter().map(|triangle| triangle.map(corner)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: &str = "solid a\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 0.1 0 0\n vertex 0 0.1 0\n\
                         endloop\nendfacet\nendsolid a\n";

    fn titles(name: &str, bytes: &[u8]) -> Vec<String> {
        match read(name, bytes, 0) {
            Ok(triangles) => panic!("{} triangles", triangles.len()),
            Err(complaints) => complaints.iter().map(|complaint| complaint.title().to_string()).collect(),
        }
    }

    fn binary_of(head: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = vec![0; 80];
        bytes[..head.len()].copy_from_slice(head);
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    #[test]
    fn all_three_formats_say_the_same() {
        let expected = vec![[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]]];
        assert_eq!(read("a.stl", ASCII.as_bytes(), 0).expect("text"), expected);
        let obj = "v 0 0 0\nv 0.1 0 0 1.0\nvn 0 0 1\nv 0 0.1 0\nf 1/1/1 2//1 -1 # all\n";
        assert_eq!(read("A.OBJ", obj.as_bytes(), 0).expect("obj"), expected);
        let bytes = binary_of(b"solid but binary", &[[[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0]]]);
        let expected = vec![[[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0]]];
        assert_eq!(read("a.stl", &bytes, 0).expect("binary"), expected);
    }

    #[test]
    fn polygons_become_fans() {
        let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        let triangles = read("a.obj", square.as_bytes(), 0).expect("a square");
        assert_eq!(triangles.len(), 2);
        assert_eq!(triangles[1], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    }

    #[test]
    fn damaged_files_are_refused() {
        assert_eq!(titles("a.stl", b""), ["`a.stl` has no triangles"]);
        assert_eq!(titles("a.obj", b"# nothing\n"), ["`a.obj` has no triangles"]);
        let mut cut = binary_of(b"", &[[[1.0; 3]; 3]]);
        cut.extend([255; 3]);
        assert_eq!(titles("a.stl", &cut), ["the file is neither text nor a whole binary STL file"]);
        assert_eq!(titles("a.stl", ASCII.replace("0.1 0 0", "0.1 0").as_bytes()), ["a corner needs three numbers"]);
        assert_eq!(titles("a.stl", ASCII.replace("vertex 0 0 0\n", "").as_bytes()), ["a facet has not three corners"]);
        assert_eq!(titles("a.stl", &ASCII.as_bytes()[..54]), ["the file ends within a facet"]);
        assert_eq!(titles("a.stl", b"hello\n"), ["`hello` is no word of an STL file"]);
        assert_eq!(titles("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n"), ["there is no corner `3`"]);
        assert_eq!(
            titles("a.obj", b"v 0 0 zero\nf 1 1\n"),
            ["`zero` is not a number", "a face needs three corners or more"]
        );
    }
}
