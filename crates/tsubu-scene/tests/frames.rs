//! Grains from VTK PolyData, as tsubu and ParaView write it.

use super::files::{SCENE, in_folder};
use std::sync::Arc;
use tsubu_scene::Complaints;
use tsubu_scene::plan::{GrainTable, Start};

fn read(bytes: &[u8], more: &str) -> Result<Arc<GrainTable>, Complaints> {
    let scene = in_folder(&[("a.vtp", bytes)], &format!("{}{more}", SCENE.replace("NAME", "a.vtp")))?;
    let Start::File { grains, .. } = &scene.plan().particles["sand"].start else { panic!("a file") };
    Ok(Arc::clone(grains))
}

/// Two grains in text, the second of another group.
const TEXT: &str = r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="2">
<PointData>
<DataArray type="Float64" Name="velocity" NumberOfComponents="3" format="ascii">0 0 -1 1 2 3</DataArray>
<DataArray type="Float64" Name="radius" format="ascii">0.002 0.001</DataArray>
<DataArray type="Int64" Name="id" format="ascii">1 0</DataArray>
<DataArray type="Int64" Name="group" format="ascii">1 0</DataArray>
<DataArray type="Float64" Name="pressure" format="ascii">5 5</DataArray>
</PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0.04 0.05 0.06 0.01 0.02 0.03
</DataArray></Points>
</Piece></PolyData></VTKFile>
"#;

fn table() -> GrainTable {
    GrainTable {
        position: vec![[0.01, 0.02, 0.03], [0.04, 0.05, 0.06]],
        diameter: vec![0.002, 0.004],
        velocity: vec![[1.0, 2.0, 3.0], [0.0, 0.0, -1.0]],
        ..GrainTable::default()
    }
}

/// Places in raw bytes behind the head, in words and with lengths of these widths.
fn appended(wide: bool) -> Vec<u8> {
    let places = [0.5f32, 0.25, 0.125, 1.0, 2.0, 4.0];
    let (form, length) = if wide { ("Float64", "UInt64") } else { ("Float32", "UInt32") };
    let head = format!(
        "<VTKFile type=\"PolyData\" header_type=\"{length}\">\n<PolyData><Piece><Points>\n\
         <DataArray type=\"{form}\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/>\n\
         </Points></Piece></PolyData>\n<AppendedData encoding=\"raw\">\n_"
    );
    let mut bytes = head.into_bytes();
    if wide {
        bytes.extend(48u64.to_le_bytes());
        bytes.extend(places.iter().flat_map(|place| f64::from(*place).to_le_bytes()));
    } else {
        bytes.extend(24u32.to_le_bytes());
        bytes.extend(places.iter().flat_map(|place| place.to_le_bytes()));
    }
    bytes.extend(b"\n</AppendedData></VTKFile>\n");
    bytes
}

#[test]
fn text_and_bytes_are_read() {
    assert_eq!(*read(TEXT.as_bytes(), "").unwrap_or_else(|wrong| panic!("{wrong}")), table());
    for wide in [true, false] {
        let bytes = appended(wide);
        let found = read(&bytes, "diameter = 0.1\n").unwrap_or_else(|wrong| panic!("{wrong}"));
        assert_eq!(found.position, [[0.5, 0.25, 0.125], [1.0, 2.0, 4.0]]);
    }
    let second = read(TEXT.as_bytes(), "start.file.kind = 2\n").unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!(second.position, table().position[1..]);
}

#[test]
fn frames_that_cannot_be_read() {
    let about = |bytes: &[u8]| read(bytes, "").expect_err("the file is wrong").to_string();
    let changed = |from: &str, to: &str| {
        assert!(TEXT.contains(from), "{from}");
        about(TEXT.replace(from, to).as_bytes())
    };
    let cut = appended(true);
    let base64 = String::from_utf8_lossy(&cut).replace("\"raw\"", "\"base64\"");
    let all = [
        about(b"solid blade\n"),
        about(&[0xff; 40]),
        about(&cut[..cut.len() - 60]),
        about(base64.as_bytes()),
        changed("PolyData\" version", "UnstructuredGrid\" version"),
        changed("header_type", "compressor=\"vtkZLibDataCompressor\" header_type"),
        changed("LittleEndian", "BigEndian"),
        changed("<Points>", "<Point>").replace("</Points>", "</Point>"),
        changed("NumberOfPoints=\"2\"", "NumberOfPoints=\"3\""),
        changed("<PolyData><Piece", "<PolyData><Piece NumberOfPoints=\"0\"/><Piece"),
        changed("0.002 0.001", "0.002"),
        changed("0.002 0.001", "0.002 0,001"),
        changed("0.002 0.001", "0.002 -0.001"),
        changed("0.002 0.001", "nan 0.001"),
        changed("Name=\"radius\" format=\"ascii\"", "Name=\"radius\" format=\"binary\""),
        changed("Name=\"radius\"", "Name=\"radius\" NumberOfComponents=\"2\""),
        read(TEXT.as_bytes(), "start.file.kind = 3\n").expect_err("no such group").to_string(),
    ];
    insta::assert_snapshot!(all.join("\n"));
}

/// Spheres of a clump would fall apart; a frame in which every sphere is by itself is read.
#[test]
fn frames_of_clumps_are_refused() {
    let with = |bodies: &str| {
        let column =
            format!("<DataArray type=\"Int64\" Name=\"body\" format=\"ascii\">{bodies}</DataArray>\n</PointData>");
        read(TEXT.replace("</PointData>", &column).as_bytes(), "")
    };
    assert!(with("-1 -1").is_ok());
    let told = with("-1 0").expect_err("clumps").to_string();
    assert!(told.contains("spheres of clumps") && told.contains("start-from"), "{told}");
}
