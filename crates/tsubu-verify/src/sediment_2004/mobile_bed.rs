//! A bed of free grains in a stream (figure 22): locked grains do not climb over one another.

use super::super::control::refused;
use super::super::ensemble;
use super::rig;
use crate::case::Judged;
use crate::origin::own;
use tsubu::view::Wants;
use tsubu_frame::Claim;

const SCENE: &str = include_str!("../../../../studies/sediment-2004/mobile-bed.toml");
/// Looks begin and end, and the time between two of them [s].
const FROM: f64 = 1.0;
const UNTIL: f64 = 1.5;
const PAUSE: f64 = 0.02;
/// Speed along the bed from which a grain moves [m/s].
const MOVES: f64 = 0.02;

/// What the stream does to the bed.
struct Bed {
    /// Share of the free grains that move.
    moving: f64,
    /// Of two grains that touch and move, difference of velocity over their speed: median.
    apart: f64,
}

/// The bed on a slope [degrees].
fn bed(slope: f64, rotation: bool, seed: u64, perturbation: f64) -> Result<Bed, String> {
    let changes = [format!("slope='{slope} deg'"), format!("contact.rotation={rotation}"), format!("seed={seed}")];
    let mut rig = rig(SCENE, &changes, perturbation)?;
    rig.until(FROM)?;
    let (mut moving, mut free, mut apart) = (0, 0, Vec::new());
    let looks = ((UNTIL - FROM) / PAUSE).round() as usize;
    for look in 1..=looks {
        rig.until(FROM + look as f64 * PAUSE)?;
        let view = rig.engine.view(Wants::TOUCHES);
        let moves = |i: usize| view.free(i) && view.grains.velocity[i].x > MOVES;
        free += (0..view.len()).filter(|i| view.free(*i)).count();
        moving += (0..view.len()).filter(|i| moves(*i)).count();
        for contact in view.contacts.iter().filter(|c| !c.wall && moves(c.first) && moves(c.second)) {
            let (a, b) = (view.grains.velocity[contact.first], view.grains.velocity[contact.second]);
            apart.push(2.0 * (a - b).length() / (a + b).length());
        }
    }
    apart.sort_by(f64::total_cmp);
    let middle = apart.get(apart.len() / 2).copied();
    Ok(Bed { moving: moving as f64 / free as f64, apart: middle.unwrap_or(f64::NAN) })
}

/// B-F22: the slope at which the bed begins to move, locked and free, and how rows of locked grains move above it.
pub(in super::super) fn mobile_bed(perturbation: f64) -> Judged {
    ensemble::drawn("beds", 1..=15, |seed| {
        let source = own("grains that do not turn cannot climb over one another (Osada 2004, figure 22)").after();
        let lies = |bed: &Bed, what: &str| {
            let name = format!("mobile bed, {what}: share of grains that move");
            Claim::judge(name, bed.moving, None, Some(0.01), source)
        };
        let moves = |bed: &Bed, what: &str| {
            let name = format!("mobile bed, {what}: share of grains that move");
            let source = own("Shields number above 0.1, twice that at which a bed begins to move").after();
            Claim::judge(name, bed.moving, Some(0.03), None, source)
        };
        let rods = |locked: f64, free: f64| {
            let source = own("a row of locked grains slides as a rod (Osada 2004, figure 22)").after();
            let name = "mobile bed: difference of velocity of grains that touch and move, locked over free";
            Claim::judge(name, locked / free, None, Some(0.7), source)
        };
        let (locked, free) = (bed(2.8624, false, seed, perturbation)?, bed(2.8624, true, seed, perturbation)?);
        let steeper = bed(4.0, false, seed, perturbation)?;
        let steep = bed(STEEP, false, seed, perturbation)?;
        let gentle = bed(1.5, true, seed, perturbation)?;
        Ok(vec![
            lies(&locked, "rotation locked, 1 in 20"),
            lies(&steeper, "rotation locked, 4 degrees"),
            moves(&free, "free rotation, 1 in 20"),
            moves(&gentle, "free rotation, 1.5 degrees"),
            moves(&steep, &format!("rotation locked, {STEEP} degrees")),
            rods(steep.apart, free.apart),
            refused("free rotation for locked", &[lies(&free, ""), rods(free.apart, free.apart)], 2),
            refused("locked for free rotation", &[moves(&locked, "")], 1),
        ])
    })
}

/// Slope at which a locked bed flows, degrees.
const STEEP: f64 = 6.0;
