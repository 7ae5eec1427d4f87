//! Signals as tables.

use super::{File, Format, header, lines, number};
use crate::draw::Draw;
use crate::reading::Expect;
use std::iter::once;

const BASE: &str = "hosts.spring.base.table.file = \"FILE\"";
const FORCE: &str = "hosts.spring.force.table.file = \"FILE\"";
const TURN: &str = "walls.floor.rotation.signal.table.file = \"FILE\"";

/// A table of a displacement, a force or an angle.
pub fn draw(draw: &mut Draw) -> File {
    let (key, units): (_, &[(&str, i64)]) = *draw.pick(&[
        (BASE, [("m", 1_000_000), ("mm", 1000), ("cm", 10_000), ("um", 1)].as_slice()),
        (FORCE, &[("N", 1_000_000), ("mN", 1000), ("kN", 1_000_000_000)]),
        (TURN, &[("rad", 1_000_000), ("mrad", 1000)]),
    ]);
    let mut time = 0;
    let mut rows = Vec::new();
    for _ in 0..=draw.below(30) {
        time += 1 + draw.below(100_000) as i64;
        rows.push((time, draw.below(20_000) as i64 - 10_000));
    }
    let units = if draw.one_in(3) { [("s", 1_000_000), units[0]] } else { [("ms", 1000), *draw.pick(units)] };
    let separator = *draw.pick(&[",", ", ", ";", "\t"]);
    let (time_name, a) = header(draw, "time", units[0].0);
    let (value_name, b) = header(draw, "value", units[1].0);
    let row = |(time, value): &(i64, i64), units: [i64; 2], separator: &str| {
        format!("{}{separator}{}", number(*time, units[0]), number(*value, units[1]))
    };
    let si = units.iter().all(|(_, size)| *size == 1_000_000);
    let title = if si && draw.one_in(2) { None } else { Some(format!("{time_name}{separator}{value_name}")) };
    let expect =
        if title.is_none() || (a, b) == (Expect::Same, Expect::Same) { Expect::Same } else { Expect::SameOrRefuse };
    let body = rows.iter().map(|pair| row(pair, units.map(|(_, size)| size), separator));
    let plain: Vec<String> = rows.iter().map(|pair| row(pair, [1_000_000; 2], ",")).collect();
    let written = title.into_iter().chain(body);
    File {
        format: Format::Csv,
        name: "signal.csv",
        bytes: lines(draw, written, Some('#')),
        scene: scene(key),
        plain: ("plain.csv", once("time,value".to_owned()).chain(plain).collect::<Vec<_>>().join("\n")),
        expect,
        change: "a style",
    }
}

fn scene(key: &str) -> String {
    format!(
        "duration = 1\n{key}\nmaterials.a.young-modulus = 1e7\nwalls.floor.material = \"a\"\n\
         walls.floor.shape.box = {{ width = 1, height = 1 }}\n\
         hosts.spring.structure.oscillator = {{ mass = 1, stiffness = 1, damping = 1 }}\n"
    )
}
