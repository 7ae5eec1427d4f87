//! A bed of hexagons or of rods loses its right wall: CL-CA beside DEM of the same outlines, with and without turning, in ensembles.

use super::super::bench::Rig;
use super::super::cl_ca_2001::slope;
use super::super::control::refused;
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use std::path::Path;
use tsubu::watch;
use tsubu_frame::{Claim, Ensemble, Source};
use tsubu_scene::Scene;

const SCENE: &str = include_str!("../../../../studies/common-test/shapes.toml");

/// Where the wall stood [m].
const WALL: f64 = 26e-3;
/// When the beds lie still, just before the wall goes [s].
const STILL: f64 = 0.44;
/// The end [s].
const END: f64 = 0.9;
/// Draws of places and of how grains are turned at first.
const SEEDS: u64 = 18;

/// Changes of the scene that make a bed of one shape.
const HEXAGONS: [&str; 1] = ["particles.hexagons.count=100"];
const RODS: [&str; 2] = ["particles.hexagons.count=0", "particles.rods.count=120"];

/// Grains that do not turn.
const STIFF: &str = "contact.rotation=false";

/// Wrong on purpose: discs of the area of hexagons, which roll freely.
const DISCS: [&str; 2] = ["particles.hexagons.shape={disc={thickness=0.05}}", "particles.hexagons.diameter=2.778e-3"];

/// Wrong on purpose: rods that stand as they are drawn.
const DRAWN: &str = "particles.rods.shape.cells.orientation=as-drawn";

/// What is seen of a bed in each draw.
struct Bed {
    /// Height of the centre of mass at rest, before the wall goes [m].
    height: Ensemble,
    /// How far grains lie along the ground then: 1 along it, -1 across, 0 where no direction is preferred.
    alignment: Ensemble,
    /// How far the front has gone beyond the wall's place at the end [mm].
    way: Ensemble,
    /// Slope at the end [degrees].
    slope: Ensemble,
}

/// Runs a bed by a method in all draws; `until` is when it is taken to lie still [s].
fn bed(method: &str, shape: &[&str], more: &[&str], until: f64, perturbation: f64) -> Result<Bed, String> {
    let name = format!("{method} {shape:?} {more:?} {until}");
    let [height, alignment, way, slope] = ensemble::members(&name, 1..=SEEDS, |seed| {
        let told = [format!("method={method}"), format!("seed={seed}")];
        let changes: Vec<String> = shape.iter().chain(more).map(|change| (*change).to_owned()).chain(told).collect();
        let scene = Scene::parse("shapes", SCENE, Path::new("."), &changes).map_err(|c| c.to_string())?;
        let mut plan = scene.plan().clone();
        if perturbation != 1.0
            && let Some(wall) = plan.walls.get_mut("right")
        {
            wall.until = None;
        }
        let mut rig = Rig::of(plan, 1.0)?;
        rig.until(until)?;
        let height = rig.engine.centre_of_mass()[2];
        let turned = rig.plan.watch.get("turned").ok_or("the scene has no watch `turned`")?;
        let mut turned = watch::open(&turned.measure, &rig.plan);
        let said = turned.take(&rig.engine.view(turned.wants())).scalars;
        rig.until(END)?;
        let (_, front, angle) = slope(&rig.vectors("position"), WALL);
        // Discs have no alignment.
        let alignment = said.last().copied().filter(|alignment| alignment.is_finite()).unwrap_or(0.0);
        Ok([height, alignment, front - 1e3 * WALL, angle])
    })?;
    Ok(Bed { height, alignment, way, slope })
}

/// Draw by draw.
fn paired(a: &Ensemble, b: &Ensemble, of: impl Fn(f64, f64) -> f64) -> Ensemble {
    ensemble::of(&a.seeds, a.members.iter().zip(&b.members).map(|(a, b)| of(*a, *b)).collect())
}

fn ratio(a: &Ensemble, b: &Ensemble) -> Ensemble {
    paired(a, b, |a, b| a / b)
}

fn less(a: &Ensemble, b: &Ensemble) -> Ensemble {
    paired(a, b, |a, b| a - b)
}

/// Grains that turn beside the same that do not, by one method.
fn turning(name: &str, turn: &Bed, stiff: &Bed) -> Claim {
    let source = own("the more grains turn, the farther they run (Osada 2004, figure 19)");
    let name = format!("{name}: way of the front, grains that turn over those that do not");
    Claim::judge_ensemble(name, ratio(&turn.way, &stiff.way), Some(1.0), None, source)
}

/// CL-CA beside DEM.
fn alike(name: &str, lattice: &Bed, dem: &Bed) -> [Claim; 2] {
    let source: Source = own("grains of the same outline and mass; a quarter, or 10 degrees, either way");
    let way = format!("{name}: way of the front, CL-CA over DEM");
    let angle = format!("{name}: slope in degrees, CL-CA less DEM");
    [
        Claim::judge_ensemble(way, ratio(&lattice.way, &dem.way), Some(0.8), Some(1.25), source),
        Claim::judge_ensemble(angle, less(&lattice.slope, &dem.slope), Some(-10.0), Some(10.0), source),
    ]
}

/// How dense both lie before the wall goes.
fn packed(name: &str, lattice: &Bed, dem: &Bed) -> Claim {
    let source = own("grains of the same outline and mass; a tenth either way");
    let name = format!("{name}: height of the centre of mass at rest, CL-CA over DEM");
    Claim::judge_ensemble(name, ratio(&lattice.height, &dem.height), Some(0.9), Some(1.1), source)
}

/// Rods that may turn come to lie.
fn lie(name: &str, bed: &Bed) -> Claim {
    let source = own("rods that fall come to lie along the ground: an end that lands first is turned by the weight");
    let name = format!("{name}: alignment of rods with the ground at rest");
    Claim::judge_ensemble(name, bed.alignment.clone(), Some(0.0), None, source)
}

fn lie_alike(name: &str, lattice: &Bed, dem: &Bed) -> Claim {
    let source = own("grains of the same outline and mass; 0.2 either way");
    let name = format!("{name}: alignment of rods with the ground at rest, CL-CA less DEM");
    Claim::judge_ensemble(name, less(&lattice.alignment, &dem.alignment), Some(-0.2), Some(0.2), source)
}

/// Both shapes by both methods.
pub(in super::super) fn shapes(perturbation: f64) -> Judged {
    let run = |method: &str, shape: &[&str], more: &[&str]| bed(method, shape, more, STILL, perturbation);
    let [hexagons, rods] = [&HEXAGONS[..], &RODS[..]];
    let dem = [
        run("dem", hexagons, &[])?,
        run("dem", hexagons, &[STIFF])?,
        run("dem", rods, &[])?,
        run("dem", rods, &[STIFF])?,
    ];
    let lattice = [
        run("cl-ca", hexagons, &[])?,
        run("cl-ca", hexagons, &[STIFF])?,
        run("cl-ca", rods, &[])?,
        run("cl-ca", rods, &[STIFF])?,
    ];
    let mut claims = vec![
        turning("hexagons by DEM", &dem[0], &dem[1]),
        turning("rods by DEM", &dem[2], &dem[3]),
        turning("rods by CL-CA", &lattice[2], &lattice[3]),
        refused(
            "grains that do not turn for those that do",
            &[
                turning("hexagons by DEM", &dem[1], &dem[0]),
                turning("rods by DEM", &dem[3], &dem[2]),
                turning("rods by CL-CA", &lattice[3], &lattice[2]),
            ],
            1,
        ),
    ];
    let same = |turn: &Bed, stiff: &Bed| {
        let name = "hexagons by CL-CA: way of the front, the same with and without turning";
        let source = closed_form("a hexagon turned by 60 degrees is the same hexagon");
        Claim::judge_ensemble(name, ratio(&turn.way, &stiff.way), Some(1.0), Some(1.0), source)
    };
    claims.push(same(&lattice[0], &lattice[1]));
    claims.push(refused("rods, which are other grains when turned", &[same(&lattice[2], &lattice[3])], 1));
    let names = ["hexagons that turn", "hexagons that do not turn", "rods that turn", "rods that do not turn"];
    for ((name, lattice), dem) in names.iter().zip(&lattice).zip(&dem) {
        claims.push(packed(name, lattice, dem));
        claims.extend(alike(name, lattice, dem));
    }
    claims.extend([lie("rods by DEM", &dem[2]), lie("rods by CL-CA", &lattice[2])]);
    claims.push(lie_alike("rods that turn", &lattice[2], &dem[2]));
    let discs = run("dem", hexagons, &DISCS)?;
    claims.push(refused("discs that roll for hexagons of cells", &alike(names[1], &discs, &dem[1]), 2));
    let falling = bed("cl-ca", hexagons, &[STIFF], 0.02, perturbation)?;
    claims.push(refused("a bed that still falls", &[packed(names[1], &falling, &dem[1])], 1));
    let upright = run("cl-ca", rods, &[STIFF, DRAWN])?;
    let gates = [lie("upright rods by CL-CA", &upright), lie_alike("upright rods", &upright, &dem[2])];
    claims.push(refused("rods that stand upright and do not turn", &gates, 2));
    Ok(claims)
}
