//! Grains in CSV, extended XYZ, LAMMPS data, LAMMPS dumps and VTK PolyData.

use super::{File, Format, header, lines, number};
use crate::draw::Draw;
use crate::reading::Expect;
use std::fmt::Write as _;

/// Distance of places [um].
const SPACING: i64 = 4000;
const METRE: i64 = 1_000_000;

struct Grain {
    /// [um]
    place: [i64; 3],
    /// [um]
    diameter: i64,
    /// [um/s]
    velocity: [i64; 3],
    /// [1e-6 rad/s]
    spin: [i64; 3],
}

/// What a file says beside places.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "columns that are there or not")]
struct Columns {
    space: bool,
    diameter: bool,
    velocity: bool,
    spin: bool,
}

/// A file of grains.
pub fn draw(draw: &mut Draw) -> File {
    let format = *draw.pick(&[Format::Csv, Format::Xyz, Format::Data, Format::Dump, Format::Vtp]);
    let data = format == Format::Data;
    let moves = draw.one_in(2);
    let columns = Columns {
        space: draw.one_in(2),
        diameter: data || draw.one_in(2),
        velocity: moves,
        spin: if data { moves } else { draw.one_in(2) },
    };
    let grains: Vec<Grain> = (0..=draw.below(24) as i64).map(|index| grain(draw, index, columns)).collect();
    let (name, rows, expect) = match format {
        Format::Csv => csv(draw, &grains, columns),
        Format::Xyz => xyz(draw, &grains, columns),
        Format::Dump => dump(draw, &grains, columns),
        Format::Vtp => vtp(draw, &grains, columns),
        _ => data_file(draw, &grains, columns),
    };
    let comment = match format {
        Format::Csv | Format::Data => Some('#'),
        _ => None,
    };
    // The first two lines of these formats are what they are.
    let head = if format == Format::Csv { 0 } else { 2.min(rows.len()) };
    let mut rows = rows.into_iter();
    let mut bytes = lines(draw, rows.by_ref().take(head), None);
    bytes.extend(lines(draw, rows, comment));
    File {
        format,
        name,
        bytes,
        scene: scene(columns),
        plain: ("plain.csv", plain(&grains, columns)),
        expect,
        change: "a style",
    }
}

fn grain(draw: &mut Draw, index: i64, columns: Columns) -> Grain {
    let plane = |mut vector: [i64; 3]| {
        if !columns.space {
            vector[1] = 0;
        }
        vector
    };
    let some = |draw: &mut Draw| [0; 3].map(|_: i64| draw.below(2000) as i64 - 1000);
    let place = [index % 5, index / 5 % 3, index / 15].map(|step| step * SPACING + draw.below(500) as i64);
    // Where there is no depth, the rows behind stand above.
    let place = if columns.space { place } else { [place[0], 0, place[2] + index / 5 % 3 * 3 * SPACING] };
    let spin = some(draw);
    Grain {
        place,
        diameter: 500 + draw.below(2500) as i64,
        velocity: plane(some(draw)),
        spin: if columns.space { spin } else { [0, spin[1], 0] },
    }
}

fn scene(columns: Columns) -> String {
    let diameter = if columns.diameter { "" } else { "diameter = 0.003\n" };
    format!(
        "duration = 1\ndimension = {}\n[materials.a]\nyoung-modulus = 1e7\ndensity = 2500\n[particles.grains]\n\
         material = \"a\"\n{diameter}start.file.path = \"FILE\"\n",
        if columns.space { 3 } else { 2 }
    )
}

fn plain(grains: &[Grain], columns: Columns) -> String {
    let mut text = "x,y,z".to_owned();
    let names = [(columns.diameter, ",d"), (columns.velocity, ",vx,vy,vz"), (columns.spin, ",wx,wy,wz")];
    names.iter().filter(|(there, _)| *there).for_each(|(_, names)| text.push_str(names));
    for grain in grains {
        let cells = cells(grain, columns).map(|(_, _, millionths)| number(millionths, METRE));
        let _ = write!(text, "\n{}", cells.collect::<Vec<_>>().join(","));
    }
    text
}

/// Name, unit and value of every column.
fn cells(grain: &Grain, columns: Columns) -> impl Iterator<Item = (&'static str, &'static str, i64)> {
    let vector =
        |names: [&'static str; 3], unit, vector: [i64; 3]| [0, 1, 2].map(|axis| (names[axis], unit, vector[axis]));
    let mut all = vector(["x", "y", "z"], "m", grain.place).to_vec();
    if columns.diameter {
        all.push(("diameter", "m", grain.diameter));
    }
    if columns.velocity {
        all.extend(vector(["vx", "vy", "vz"], "m/s", grain.velocity));
    }
    if columns.spin {
        all.extend(vector(["wx", "wy", "wz"], "rad/s", grain.spin));
    }
    all.into_iter()
}

type Written = (&'static str, Vec<String>, Expect);

fn csv(draw: &mut Draw, grains: &[Grain], columns: Columns) -> Written {
    let separator = *draw.pick(&[",", ", ", ";", "\t"]);
    let (long, short): (&[_], _) = (&[("m", METRE), ("mm", 1000), ("cm", 10_000)], ("m", METRE));
    let length = if draw.one_in(2) { *draw.pick(long) } else { short };
    let mut order: Vec<usize> = (0..cells(&grains[0], columns).count()).collect();
    draw.shuffle(&mut order);
    let mut expect = Expect::Same;
    let mut names = Vec::new();
    let mut sizes = Vec::new();
    let first: Vec<_> = cells(&grains[0], columns).collect();
    for column in &order {
        let (name, unit, _) = first[*column];
        let half = name == "diameter" && draw.one_in(2);
        let name = if half { "radius" } else { name };
        let size = if unit == "m" { length.1 } else { METRE };
        sizes.push(if half { 2 * size } else { size });
        let unit = if unit == "m" { length.0 } else { unit };
        names.push(if size == METRE && draw.one_in(2) {
            name.to_owned()
        } else {
            let (name, held) = header(draw, name, unit);
            expect = if held == Expect::Same { expect } else { held };
            name
        });
    }
    let mut rows = vec![names.join(separator)];
    for grain in grains {
        let cells: Vec<_> = cells(grain, columns).collect();
        let row = order.iter().zip(&sizes).map(|(column, size)| number(cells[*column].2, *size));
        rows.push(row.collect::<Vec<_>>().join(separator));
    }
    ("grains.csv", rows, expect)
}

fn xyz(draw: &mut Draw, grains: &[Grain], columns: Columns) -> Written {
    let mut properties = "species:S:1:pos:R:3".to_owned();
    let radius = draw.one_in(2);
    let size = if radius { "radius:R:1" } else { "diameter:R:1" };
    for (there, name) in [(columns.diameter, size), (columns.velocity, "velo:R:3"), (columns.spin, "omega:R:3")] {
        if there {
            let _ = write!(properties, ":{name}");
        }
    }
    let lattice = if draw.one_in(2) { "Lattice=\"1 0 0 0 1 0 0 0 1\" " } else { "" };
    let mut rows = vec![grains.len().to_string(), format!("{lattice}Properties={properties}")];
    for grain in grains {
        let cells = cells(grain, columns).map(|(name, _, millionths)| {
            number(millionths, if name == "diameter" && radius { 2 * METRE } else { METRE })
        });
        rows.push(format!("G {}", cells.collect::<Vec<_>>().join(" ")));
    }
    ("grains.xyz", rows, Expect::Same)
}

/// A dump of one or two snapshots; the last one counts.
fn dump(draw: &mut Draw, grains: &[Grain], columns: Columns) -> Written {
    let radius = draw.one_in(2);
    let mut names = "id type x y z".to_owned();
    let size = if radius { " radius" } else { " diameter" };
    let others = [(columns.diameter, size), (columns.velocity, " vx vy vz"), (columns.spin, " omegax omegay omegaz")];
    others.iter().filter(|(there, _)| *there).for_each(|(_, name)| names.push_str(name));
    let mut rows = if draw.one_in(2) { vec!["ITEM: UNITS".to_owned(), "si".to_owned()] } else { Vec::new() };
    let mut snapshot = |count: usize, names: &str| {
        let bounds = ["ITEM: BOX BOUNDS ff ff ff", "-1 1", "-1 1", "-1 1"].map(String::from);
        rows.extend(["ITEM: TIMESTEP", "7", "ITEM: NUMBER OF ATOMS"].map(String::from));
        rows.push(count.to_string());
        rows.extend(bounds);
        rows.push(format!("ITEM: ATOMS {names}"));
    };
    if draw.one_in(2) {
        snapshot(0, "id xs ys zs");
    }
    snapshot(grains.len(), &names);
    for (index, grain) in grains.iter().enumerate() {
        let cells = cells(grain, columns).map(|(name, _, millionths)| {
            number(millionths, if name == "diameter" && radius { 2 * METRE } else { METRE })
        });
        rows.push(format!("{} 1 {}", index + 1, cells.collect::<Vec<_>>().join(" ")));
    }
    ("grains.lammpstrj", rows, Expect::Same)
}

/// As ParaView writes it as text.
fn vtp(draw: &mut Draw, grains: &[Grain], columns: Columns) -> Written {
    let radius = draw.one_in(2);
    let mut rows = vec![
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">".to_owned(),
        format!("<PolyData><Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\">", grains.len()),
        "<Points>".to_owned(),
    ];
    let size = if radius { "radius" } else { "diameter" };
    let arrays = [(true, "Points", 0..3), (columns.diameter, size, 3..4)];
    let after = if columns.diameter { 4 } else { 3 };
    let spins = if columns.velocity { after + 3 } else { after };
    let vectors = [(columns.velocity, "velocity", after..after + 3), (columns.spin, "spin", spins..spins + 3)];
    for (_, name, cells_of_it) in arrays.into_iter().chain(vectors).filter(|(there, ..)| *there) {
        let form = format!("type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{}\"", cells_of_it.len());
        rows.push(format!("<DataArray {form} format=\"ascii\">"));
        rows.extend(grains.iter().map(|grain| {
            let all = cells(grain, columns).map(|(name, _, millionths)| {
                number(millionths, if name == "diameter" && radius { 2 * METRE } else { METRE })
            });
            all.skip(cells_of_it.start).take(cells_of_it.len()).collect::<Vec<_>>().join(" ")
        }));
        rows.push("</DataArray>".to_owned());
        rows.extend((name == "Points").then(|| "</Points><PointData>".to_owned()));
    }
    rows.push("</PointData></Piece></PolyData></VTKFile>".to_owned());
    ("grains.vtp", rows, Expect::Same)
}

fn data_file(draw: &mut Draw, grains: &[Grain], columns: Columns) -> Written {
    let count = grains.len();
    let centimetres = draw.one_in(8);
    let (unit, expect) = if centimetres { (10_000, Expect::SameOrRefuse) } else { (METRE, Expect::Same) };
    let units = if centimetres { "cgs" } else { "si" };
    let title = format!("LAMMPS data file via write_data, version 22 Jul 2025, timestep = 0, units = {units}");
    let mut rows = vec![title, String::new(), format!("{count} atoms"), "1 atom types".to_owned(), String::new()];
    rows.extend(
        ["x", "y", "z"].map(|axis| format!("{} {} {axis}lo {axis}hi", number(-METRE, unit), number(METRE, unit))),
    );
    rows.extend(["", if draw.one_in(2) { "Atoms # sphere" } else { "Atoms" }, ""].map(String::from));
    // One row without its flags is a whole file.
    let flags = if draw.one_in(3) && count > 1 { " 0 0 0" } else { "" };
    let vector = |vector: [i64; 3], unit| vector.map(|millionths| number(millionths, unit)).join(" ");
    for (index, grain) in grains.iter().enumerate() {
        let (diameter, place) = (number(grain.diameter, unit), vector(grain.place, unit));
        rows.push(format!("{} 1 {diameter} 2500 {place}{flags}", index + 1));
    }
    if columns.velocity {
        rows.extend(["", "Velocities", ""].map(String::from));
        for (index, grain) in grains.iter().enumerate() {
            rows.push(format!("{} {} {}", index + 1, vector(grain.velocity, unit), vector(grain.spin, METRE)));
        }
    }
    ("grains.data", rows, expect)
}
