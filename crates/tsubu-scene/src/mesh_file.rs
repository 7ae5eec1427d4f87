//! Triangles from STL (binary and ASCII) and OBJ files.
//!
//! The text formats are read in double precision, and a wrong line is told by its number.

use crate::complaint::Complaint;
use crate::grain_file::ending;
use crate::lines::{Cell, Line, MOST_COMPLAINTS, lines, no_text};
use crate::plan::Vector;
use crate::suggest;

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
            None => ascii(std::str::from_utf8(bytes).map_err(|_| vec![not_whole(bytes)])?, source)?,
        }
    } else {
        let text = std::str::from_utf8(bytes).map_err(|error| vec![no_text(bytes, &error, source)])?;
        obj(text, source)?
    };
    if triangles.is_empty() {
        return Err(vec![Complaint::new(format!("`{name}` has no triangles"))]);
    }
    Ok(triangles)
}

fn not_whole(bytes: &[u8]) -> Complaint {
    let head = |count| format!("its head says {count} triangles, and there is room for {}", room(bytes));
    let told = count(bytes).map_or_else(|| "it ends within its head".to_string(), head);
    Complaint::new(format!("the file is neither text nor a whole binary STL file: {told}"))
        .hint("a binary STL file has 84 bytes and 50 for each triangle; was it cut off?")
}

/// Triangles that the head of a binary file promises.
fn count(bytes: &[u8]) -> Option<usize> {
    Some(u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?) as usize)
}

/// Triangles that the length of a binary file has room for.
fn room(bytes: &[u8]) -> f64 {
    let room = (bytes.len() - HEAD.min(bytes.len())) as f64 / RECORD as f64;
    (room * 100.0).round() / 100.0
}

/// Told by its length: there are binary files that begin with the word `solid`, as text does.
fn binary(bytes: &[u8]) -> Option<Vec<[Vector; 3]>> {
    if Some(bytes.len()) != count(bytes)?.checked_mul(RECORD)?.checked_add(HEAD) {
        return None;
    }
    let number = |at: &[u8]| f32::from_le_bytes([at[0], at[1], at[2], at[3]]);
    let corner = |at: &[u8]| [number(&at[0..4]), number(&at[4..8]), number(&at[8..12])].map(f64::from);
    // The normal (12 bytes) says again what the corners say, and is wrong in many files.
    let triangle = |at: &[u8]| [corner(&at[12..24]), corner(&at[24..36]), corner(&at[36..48])];
    Some(bytes[HEAD..].chunks_exact(RECORD).map(triangle).collect())
}

/// `vertex x y z` three times in a `facet`, facets in a `solid`: each of the two has its end, so that a file that was
/// cut off is known. Loops and normals are decoration.
fn ascii(text: &str, source: usize) -> Read {
    let mut triangles = Vec::new();
    let mut corners: Vec<Vector> = Vec::new();
    let mut complaints = Vec::new();
    let (mut solid, mut facet) = (None, None);
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        let mut cells = line.cells(None);
        let word = cells.next().map(|cell| cell.text.to_ascii_lowercase()).unwrap_or_default();
        let cells: Vec<Cell<'_>> = cells.collect();
        let stray = |what: &str| Complaint::new(what).at(&line.place(source), "in this line");
        match (word.as_str(), solid.is_some(), facet.is_some()) {
            ("solid", false, _) => solid = Some(line),
            ("endsolid", true, false) => solid = None,
            ("facet", true, false) => facet = Some(line),
            ("vertex", _, true) => match corner(&line, &cells, source) {
                Ok(corner) if cells.len() == 3 => corners.push(corner),
                Ok(_) => complaints.push(stray("a corner has more than three numbers")),
                Err(complaint) => complaints.push(complaint),
            },
            ("endfacet", _, true) => {
                facet = None;
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
            ("outer" | "endloop", _, true) => {}
            ("solid" | "endsolid" | "facet" | "vertex" | "endfacet" | "outer" | "endloop", ..) => {
                complaints.push(
                    stray(&format!("`{word}` stands where it cannot"))
                        .hint("facets stand between `solid` and `endsolid`, corners between `facet` and `endfacet`"),
                );
                // What follows would only stumble over the same.
                break;
            }
            _ => complaints.push(stray(&format!("`{word}` is no word of an STL file"))),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    let open = facet.map(|line| ("facet", line)).or_else(|| solid.map(|line| ("solid", line)));
    if let (Some((what, line)), true) = (open, complaints.is_empty()) {
        complaints.push(
            Complaint::new(format!("the file ends within a {what}"))
                .at(&line.place(source), format!("begins here; there is no `end{what}`"))
                .hint("was it cut off while it was written?"),
        );
    }
    if complaints.is_empty() { Ok(triangles) } else { Err(complaints) }
}

/// Words of OBJ files that change no surface: normals, textures, names, groups, looks, lines and points.
const DECORATION: [&str; 9] = ["vn", "vt", "g", "o", "s", "usemtl", "mtllib", "l", "p"];

/// Corners `v` and faces `f`; polygons are cut into fans.
fn obj(text: &str, source: usize) -> Read {
    let mut corners: Vec<Vector> = Vec::new();
    let mut triangles = Vec::new();
    let mut complaints = Vec::new();
    for line in lines(text) {
        let bare = line.before('#');
        let mut cells = bare.cells(None);
        let Some(word) = cells.next() else { continue };
        let cells: Vec<Cell<'_>> = cells.collect();
        match word.text {
            "v" => match corner(&bare, &cells, source).and_then(|corner| weighed(corner, &cells, source)) {
                Ok(corner) => corners.push(corner),
                Err(complaint) => complaints.push(complaint),
            },
            "f" => match face(&bare, &cells, &corners, source) {
                Ok(fan) => triangles.extend(fan),
                Err(complaint) => complaints.push(complaint),
            },
            word if DECORATION.contains(&word) => {}
            other => complaints.push(
                Complaint::new(format!("`{other}` is no word that is known of an OBJ file"))
                    .at(&word.place(source), "in this line")
                    .hint("words: `v` (a corner), `f` (a face)")
                    .hint(format!("passed over: `#`, {}", suggest::list(DECORATION))),
            ),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() { Ok(triangles) } else { Err(complaints) }
}

/// Behind the three numbers of a corner stand a weight, which can only be 1, or a colour.
fn weighed(corner: Vector, cells: &[Cell<'_>], source: usize) -> Result<Vector, Complaint> {
    match &cells[3..] {
        [] => Ok(corner),
        [weight] if weight.text.parse() == Ok(1.0) => Ok(corner),
        [weight] => Err(Complaint::new("a corner has a weight other than 1")
            .at(&weight.place(source), "only curved surfaces have weights")),
        colour if matches!(colour.len(), 3 | 4) && colour.iter().all(|cell| cell.text.parse::<f64>().is_ok()) => {
            Ok(corner)
        }
        [first, ..] => Err(Complaint::new("a corner has three numbers, and perhaps a colour")
            .at(&first.place(source), format!("the fourth of {} in this line", cells.len()))),
    }
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

/// The fan of a polygon.
fn face(line: &Line<'_>, cells: &[Cell<'_>], corners: &[Vector], source: usize) -> Result<Vec<[Vector; 3]>, Complaint> {
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
    let polygon: Vec<Vector> = cells.iter().map(one).collect::<Result<_, _>>()?;
    let fan: Vec<[Vector; 3]> = polygon.windows(2).skip(1).map(|edge| [polygon[0], edge[0], edge[1]]).collect();
    // A fan of a polygon with a bay in it covers the bay.
    let normals: Vec<Vector> = fan.iter().map(normal).collect();
    let whole = [0, 1, 2].map(|axis| normals.iter().map(|normal| normal[axis]).sum::<f64>());
    if normals.iter().any(|normal| (0..3).map(|axis| normal[axis] * whole[axis]).sum::<f64>() < 0.0) {
        return Err(Complaint::new("a face is a polygon that cannot be cut into triangles from its first corner")
            .at(&line.place(source), "it has a bay")
            .hint("write the mesh in triangles"));
    }
    Ok(fan)
}

/// Twice the area, along the normal.
fn normal([a, b, c]: &[Vector; 3]) -> Vector {
    let [u, v] = [b, c].map(|to| [0, 1, 2].map(|axis| to[axis] - a[axis]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
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
        let neither = "the file is neither text nor a whole binary STL file: ";
        let promises = format!("{neither}its head says 1 triangles, and there is room for 1.06");
        assert_eq!(titles("a.stl", &cut), [promises]);
        assert_eq!(titles("a.stl", b"\0\xff"), [format!("{neither}it ends within its head")]);
        assert_eq!(titles("a.stl", ASCII.replace("0.1 0 0", "0.1 0").as_bytes()), ["a corner needs three numbers"]);
        assert_eq!(titles("a.stl", ASCII.replace("vertex 0 0 0\n", "").as_bytes()), ["a facet has not three corners"]);
        assert_eq!(titles("a.stl", &ASCII.as_bytes()[..54]), ["the file ends within a facet"]);
        assert_eq!(titles("a.stl", b"hello\n"), ["`hello` is no word of an STL file"]);
        assert_eq!(titles("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n"), ["there is no corner `3`"]);
        assert_eq!(
            titles("a.stl", ASCII.replace("0.1 0 0", "0.1 0 0 7").as_bytes()),
            ["a corner has more than three numbers"]
        );
        assert_eq!(titles("a.obj", b"v 0 0 0 0.5\n"), ["a corner has a weight other than 1"]);
        assert_eq!(titles("a.obj", b"v 0 0 0 1 0\n"), ["a corner has three numbers, and perhaps a colour"]);
        assert_eq!(
            titles("a.obj", b"v 0 0 zero\nf 1 1\n"),
            ["`zero` is not a number", "a face needs three corners or more"]
        );
    }

    /// Words that were not known were passed over: with `F 1 3 4` a mesh lost a face without a word.
    #[test]
    fn no_face_is_lost_in_an_obj_file() {
        let square = "mtllib a.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ns off\nusemtl b\nf 1 2 3\nF 1 3 4\n";
        assert_eq!(titles("a.obj", square.as_bytes()), ["`F` is no word that is known of an OBJ file"]);
        assert_eq!(read("a.obj", square.replace('F', "f").as_bytes(), 0).expect("a square").len(), 2);
        assert_eq!(
            titles("a.obj", square.replace("F 1 3 4", "curv 0 1 1 2").as_bytes()),
            ["`curv` is no word that is known of an OBJ file"]
        );
    }

    /// An L is not the fan from its first corner: the fan covers the bay.
    #[test]
    fn a_polygon_with_a_bay_is_refused() {
        let corners = "v 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 1 0\nv 1 1 0\n";
        let bay = "a face is a polygon that cannot be cut into triangles from its first corner";
        assert_eq!(titles("a.obj", format!("{corners}f 5 6 1 2 3 4\n").as_bytes()).len(), 1);
        assert_eq!(titles("a.obj", format!("{corners}f 2 3 4 5 6 1\n").as_bytes()), [bay]);
        // From the corner at the bay all of it is seen.
        assert_eq!(read("a.obj", format!("{corners}f 6 1 2 3 4 5\n").as_bytes(), 0).expect("an L").len(), 4);
    }

    /// A text that was cut between two facets passed, with the rest of its triangles lost.
    #[test]
    fn a_text_is_whole_or_refused() {
        let facet = ASCII.replace("endsolid a\n", "").replace("solid a\n", "");
        let two = format!("solid a\n{facet}{facet}endsolid a\n");
        assert_eq!(read("a.stl", two.as_bytes(), 0).expect("two").len(), 2);
        let lines: Vec<&str> = two.lines().collect();
        for kept in 0..lines.len() {
            let cut = lines[..kept].join("\n");
            assert!(read("a.stl", cut.as_bytes(), 0).is_err(), "{cut}");
        }
        assert_eq!(titles("a.stl", two.replace("endsolid a\n", "").as_bytes()), ["the file ends within a solid"]);
        let stray = titles("a.stl", two.replacen("endfacet\n", "", 1).as_bytes());
        assert_eq!(stray, ["`facet` stands where it cannot"]);
    }
}
