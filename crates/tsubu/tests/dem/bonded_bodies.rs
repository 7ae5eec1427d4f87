//! Bonds of bodies that are no spheres, by their outcome.

use super::{hash, missing, open_text};
use std::f64::consts::PI;
use tsubu::engine::Engine;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu_frame::Kind;

/// Half the side of a cube or square, its rounding radius and the half diameter that belongs to them [m].
const HALF: f64 = 1e-3;
const ROUNDING: f64 = 1e-4;

const CUBE: &str = "shape.polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], \
                    [1, 1, 1]], rounding = 0.1, orientation = 'as-drawn' }";
const SQUARE: &str = "shape.polygon = { corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]], rounding = 0.1, thickness = '2 mm', orientation = 'as-drawn' }";
const EGG: &str = "shape.superellipsoid = { semi-axes = [2, 1, 1], exponents = [2, 2], orientation = 'as-drawn' }";
const PILL: &str = "shape.superellipsoid = { semi-axes = [2, 1, 1], exponents = [4, 2], orientation = 'as-drawn' }";
const ROD: &str = "shape.clump = { centre = [[0, 0, -1], [0, 0, 1]], diameter = [2, 2], orientation = 'as-drawn' }";

/// Of the sphere that just holds a cube, or the disc that just holds a square.
fn diameter(dimension: u32) -> f64 {
    2.0 * ((HALF - ROUNDING) * f64::from(dimension).sqrt() + ROUNDING)
}

/// Volume of the rounded cube (Steiner 1840), or area of the rounded square.
fn volume(dimension: u32) -> f64 {
    let (core, r) = (2.0 * (HALF - ROUNDING), ROUNDING);
    if dimension == 2 {
        return core * core + 4.0 * core * r + PI * r * r;
    }
    core.powi(3) + 6.0 * core * core * r + 3.0 * core * PI * r * r + 4.0 / 3.0 * PI * r.powi(3)
}

/// Radius of the sphere of that volume, of the disc of that area.
fn radius(dimension: u32) -> f64 {
    if dimension == 2 { (volume(2) / PI).sqrt() } else { (0.75 / PI * volume(3)).cbrt() }
}

const YOUNG: f64 = 1e8;
const POISSON: f64 = 0.25;
const DENSITY: f64 = 2500.0;

/// Five cubes or squares, face to face, held at a sphere by beams as thick as a sphere of their volume. They sag by their weight as Timoshenko says of beams from
/// centre to centre; taken for the spheres that hold them they would sag by a third of that, and for those that just fit in by twice as much: the gate refuses both.
#[test]
fn a_cantilever_of_cubes_sags_as_timoshenko_says() {
    for dimension in [2, 3] {
        let (shape, own) = if dimension == 2 { (SQUARE, radius(2)) } else { (CUBE, radius(3)) };
        let step = 2.001 * HALF;
        let at = |k: u32| {
            let x = f64::from(k) * step;
            if dimension == 2 { format!("[{x}, 0]") } else { format!("[{x}, 0, 0]") }
        };
        let body = format!("material = 'rock'\ndiameter = {}\n{shape}", diameter(dimension));
        let bond = format!("young-modulus = {YOUNG}\npoisson-ratio = {POISSON}\ndamping = 1");
        let text = format!(
            "dimension = {dimension}\nduration = '10 s'\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = {DENSITY}\n[contact]\nnormal.hertz = {{}}\n\
             [particles.held]\nmaterial = 'rock'\ndiameter = {}\nmotion.frozen = {{}}\nstart.at.position = [{}]\n\
             [particles.root]\n{body}\nstart.at.position = [{}]\n\
             [particles.tail]\n{body}\nstart.at.position = [{}]\n\
             [[bond]]\nparticles = ['held', 'root']\nradius = {}\n{bond}\n[[bond]]\nparticles = ['root', 'tail']\n{bond}\n",
            2.0 * HALF,
            at(0),
            at(1),
            (2..=5).map(at).collect::<Vec<_>>().join(", "),
            own / HALF,
        );
        let (mut engine, mut hosts, mut ledger) = open_text(&text, &["gravity=0.5"]);
        assert_eq!(engine.view(Wants::GRAINS).bonds.len(), 5);
        engine.advance(300_000, &mut hosts, &mut ledger).unwrap();
        let frame = engine.frame(&Hosts::default());
        let sag = -frame.vectors(Kind::Grain, "position")[5][2];
        let mass = DENSITY * volume(dimension) * if dimension == 2 { 2e-3 } else { 1.0 };
        let whole = 5.0 * step;
        let timoshenko = |radius: f64| {
            let (area, moment) = (PI * radius * radius, 0.25 * PI * radius.powi(4));
            let shear = 0.5 * YOUNG / (1.0 + POISSON) * 6.0 * (1.0 + POISSON) / (7.0 + 6.0 * POISSON);
            let of = |x: f64| x * x * (3.0 * whole - x) / (6.0 * YOUNG * moment) + x / (shear * area);
            (1..=5).map(|k| mass * 0.5 * of(f64::from(k) * step)).sum::<f64>()
        };
        let off = |radius: f64| (sag / timoshenko(radius) - 1.0).abs();
        assert!(off(own) < 1e-4, "{dimension}: {sag} {}", timoshenko(own));
        assert!(off(0.5 * diameter(dimension)) > 0.5 && off(HALF) > 0.1, "{dimension}: {sag}");
        assert!(missing(&*engine, &hosts, &ledger) < 1e-3);
    }
}

/// A group of one body in space.
fn one(name: &str, shape: &str, x: [f64; 3], v: [f64; 3]) -> String {
    let size = if shape == CUBE { diameter(3) } else { 2.0 * HALF };
    format!(
        "[particles.{name}]\nmaterial = 'rock'\ndiameter = {size}\n{shape}\nstart.at = {{ position = [{x:?}], velocity = [{v:?}] }}\n"
    )
}

const MATERIAL: &str = "dimension = 3\nduration = '1 s'\ngravity = 0\n[materials.rock]\nyoung-modulus = '10 MPa'\ndensity = '2500 kg/m^3'\nrestitution = 1\n\
     [contact]\nnormal.hertz = {}\n";

/// What is bonded depends on the gap between surfaces: beside each other and end to end, of all pairs of shapes. Spheres that hold bodies would overlap in most
/// of these places, and bond them all.
#[test]
fn the_gap_is_that_of_the_surfaces() {
    // How far each reaches along x and z, and the radius of what it is taken for.
    let egg = HALF / 4.0_f64.cbrt();
    let shapes = [
        (CUBE, [HALF, HALF], radius(3)),
        (EGG, [HALF, 0.5 * HALF], egg),
        ("", [HALF, HALF], HALF),
        // End to end alone: places of clumps are held against the spheres around them.
        (ROD, [f64::NAN, HALF], 0.5 * HALF),
    ];
    for (k, (one_shape, one_reach, one_radius)) in shapes.iter().enumerate() {
        for (other_shape, other_reach, other_radius) in &shapes[..=k] {
            for axis in [0, 1] {
                let bonds = |share: f64| {
                    let gap = 0.3 * one_radius.min(*other_radius);
                    let mut x = [0.0; 3];
                    x[2 * axis] = one_reach[axis] + other_reach[axis] + share * gap;
                    let bodies = one("a", one_shape, [0.0; 3], [0.0; 3]) + &one("b", other_shape, x, [0.0; 3]);
                    let text = format!("{MATERIAL}{bodies}[[bond]]\ngap = 0.3\nyoung-modulus = '10 MPa'\n");
                    open_text(&text, &[]).0.view(Wants::GRAINS).bonds.len()
                };
                if axis == 1 || *one_shape != ROD {
                    assert_eq!((bonds(0.98), bonds(1.02)), (1, 0), "{one_shape} {other_shape} {axis}");
                }
            }
        }
    }
}

/// Bodies that are still pressed together when their bond breaks by shear meet by their contact, and the books hold; while the bond holds there is none.
#[test]
fn a_contact_takes_over_between_bodies() {
    let reach = |shape: &str| match shape {
        EGG => 0.5 * HALF,
        // The longest diagonal of the profile |x/2|^4 + |z|^4 = 1 is 2 (1 + 1/16)^(1/4).
        PILL => 0.5 * HALF / 1.0625_f64.powf(0.25),
        _ => HALF,
    };
    for (a, b) in [(CUBE, CUBE), (EGG, EGG), (PILL, PILL), (CUBE, EGG), (CUBE, ""), ("", EGG), (CUBE, ROD)] {
        let apart = reach(a) + reach(b) + 1e-6;
        let bodies = one("a", a, [0.0; 3], [0.2, 0.0, 0.1]) + &one("b", b, [0.0, 0.0, apart], [-0.2, 0.0, -0.1]);
        let bond = "[[bond]]\nparticles = ['a', 'b']\nyoung-modulus = '10 MPa'\nshear-strength = '6 kPa'\n";
        let (mut engine, mut hosts, mut ledger) =
            open_text(&format!("{MATERIAL}{bodies}{bond}"), &["dem.time-step='0.2 us'", "dem.largest-overlap=1"]);
        let held = |engine: &dyn Engine| engine.view(Wants::GRAINS).bonds.len();
        assert_eq!(held(&*engine), 1);
        let broke = (0..4000).any(|_| {
            engine.advance(1, &mut hosts, &mut ledger).unwrap();
            assert!(held(&*engine) == 0 || engine.contacts() == 0, "{a} {b}: a contact beside the bond");
            held(&*engine) == 0
        });
        assert!(broke && engine.contacts() > 0, "{a} {b}: {broke} {}", engine.contacts());
        assert!(engine.grain_energies().elastic > 0.0);
        engine.advance(20_000, &mut hosts, &mut ledger).unwrap();
        assert_eq!(engine.contacts(), 0, "{a} {b}");
        let lost = missing(&*engine, &hosts, &ledger);
        assert!(lost < 1e-3, "{a} {b}: {lost}");
    }
}

/// A bonded pair of cubes that swings across a periodic end does what it does elsewhere.
#[test]
fn a_bond_of_cubes_reaches_across_a_periodic_end() {
    let run = |x: f64| {
        let second = (x + 2.002 * HALF) % 0.03125;
        let bodies =
            one("a", CUBE, [x, 0.0, 0.0], [0.1, 0.0, 1.0]) + &one("b", CUBE, [second, 0.0, 0.0], [0.0, 0.0, -1.0]);
        let text =
            format!("periodic.x = [0, 0.03125]\n{MATERIAL}{bodies}[[bond]]\nyoung-modulus = '10 MPa'\ngap = 0.05\n");
        let (mut engine, mut hosts, mut ledger) = open_text(&text, &["dem.time-step='1 us'"]);
        assert_eq!(engine.view(Wants::GRAINS).bonds.len(), 1);
        engine.advance(3000, &mut hosts, &mut ledger).unwrap();
        let frame = engine.frame(&Hosts::default());
        let [place, spin] = ["position", "spin"].map(|name| frame.vectors(Kind::Grain, name).to_vec());
        [place[0][2], place[1][2], spin[0][1], spin[1][1]]
    };
    let (inside, across) = (run(0.01), run(0.0305));
    assert!(inside[2].abs() > 1.0, "they turn: {inside:?}");
    for (a, b) in inside.iter().zip(across) {
        assert!((a - b).abs() < 1e-8 * a.abs().max(1e-3), "{inside:?} {across:?}");
    }
}

/// A block of cubes with some of every shape on its top that falls onto a floor, and breaks.
pub fn block(side: u32) -> String {
    let step = 2.002 * HALF;
    let place = |k: u32| f64::from(k) * step;
    let mut cubes = Vec::new();
    for k in 0..side * side * 2 {
        let (x, y, z) = (place(k % side), place(k / side % side), place(k / (side * side)));
        cubes.push(format!("[{x}, {y}, {}]", z + 1.05 * HALF));
    }
    let top = 1.05 * HALF + place(1) + HALF;
    let row = |y: u32, reach: f64| {
        let of: Vec<String> =
            (0..side).map(|k| format!("[{}, {}, {}]", place(k), place(y), top + 1.002 * reach)).collect();
        of.join(", ")
    };
    let group = |name: &str, size: f64, shape: &str, places: &str| {
        format!("[particles.{name}]\nmaterial = 'rock'\ndiameter = {size}\n{shape}\nstart.at.position = [{places}]\n")
    };
    let text = "dimension = 3\nduration = '1 s'\ngravity = 500\n[materials.rock]\nyoung-modulus = '200 MPa'\ndensity = '2500 kg/m^3'\nrestitution = 0.6\nfriction = 0.4\n\
         [contact]\nnormal.hertz = {}\ntangential.mindlin = {}\n"
        .to_owned();
    let size = 2.0 * HALF;
    text + &group("cubes", diameter(3), CUBE, &cubes.join(", "))
        + &group("balls", size, "", &row(0, HALF))
        + &group("eggs", size, EGG, &row(1, 0.5 * HALF))
        + &group("pills", size, PILL, &row(2, 0.5 * HALF / 1.0625_f64.powf(0.25)))
        + &group("rods", size, ROD, &row(3, HALF))
        + "[walls.floor]\nmaterial = 'rock'\nshape.plane = { point = [0, 0, -2e-4], normal = [0.1, 0, 1] }\n"
        + "[[bond]]\nyoung-modulus = '20 MPa'\ndamping = 0.1\ntensile-strength = '60 kPa'\nshear-strength = '60 kPa'\nweibull-modulus = 4\n\
           [dem]\ntime-step = '0.5 us'\nlargest-overlap = 0.5\n"
}

/// The same in the plane: polygons, cells as polygons and as discs, and discs, settled in a box that then shakes them apart.
const HEAP: &str = "duration = '1 s'\ngravity = 20\n[materials.rock]\nyoung-modulus = '200 MPa'\ndensity = '2500 kg/m^3'\nrestitution = 0.4\nfriction = 0.4\n\
     [contact]\nnormal.hertz = {}\n\
     [particles.hexagons]\nmaterial = 'rock'\ncount = 12\nshape.cells = { outline.hexagon.radius = 1, spacing = '1 mm', thickness = '2 mm' }\n\
     start.settled.time = '150 ms'\n\
     [particles.hooks]\nmaterial = 'rock'\ncount = 6\nshape.cells = { outline.points.at = [[0, 0], [0, 2], [0, 4], [1, 5], [2, 4], [3, 3]], spacing = '1 mm', \
     thickness = '2 mm' }\nstart.settled.time = '150 ms'\n\
     [particles.squares]\nmaterial = 'rock'\ncount = 12\ndiameter = '3 mm'\n\
     shape.polygon = { corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]], rounding = 0.1, thickness = '2 mm' }\nstart.settled.time = '150 ms'\n\
     [particles.discs]\nmaterial = 'rock'\ncount = 8\ndiameter = '2 mm'\nshape.disc.thickness = '2 mm'\nstart.settled.time = '150 ms'\n\
     [walls.box]\nmaterial = 'rock'\nshape.box = { width = '24 mm', height = '60 mm' }\n\
     motion = { direction = 'x', signal.sine = { amplitude = '1 mm', frequency = '100 Hz' } }\n\
     [[bond]]\ngap = 0.2\nradius = 0.5\nyoung-modulus = '20 MPa'\ndamping = 0.1\ntensile-strength = '1 MPa'\nshear-strength = '1 MPa'\n\
     [dem]\nlargest-overlap = 0.5\n";

mod patient {
    use super::*;

    /// Blocks and heaps of all shapes that break do so by the same bits on any threads and after a resume, and their books close.
    #[test]
    #[ignore = "8 s: cargo xtask patient"]
    fn bodies_of_all_shapes_break_by_the_same_bits() {
        for (text, steps) in [(&*block(8), 1600), (HEAP, 3000)] {
            let run = |threads: usize, resume: bool| {
                let look = |engine: &dyn Engine, hosts: &Hosts, ledger: &Ledger| {
                    let view = engine.view(Wants::GRAINS);
                    (view.bonds.len(), view.broken_bonds, engine.contacts(), missing(engine, hosts, ledger))
                };
                hash(|| open_text(text, &[]), [steps, steps], threads, resume, look)
            };
            let (bits, (hold, broken, contacts, lost)) = run(1, false);
            assert!(hold > 20 && broken > 20 && contacts > 5, "{hold} {broken} {contacts}");
            assert!(lost < 1e-3, "{lost}");
            assert_eq!(bits, run(2, false).0);
            assert_eq!(bits, run(7, false).0);
            assert_eq!(bits, run(2, true).0);
        }
    }
}
