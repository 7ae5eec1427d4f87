//! How the bed of a rotating drum moves, by its Froude number (V-37).

use super::beds::{law, line, sampled};
use super::bench::{Rig, scalars};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::own;
use glam::DVec3;
use tsubu_frame::{Claim, Kind};

/// Radius of the drum in diameters.
const DRUM: f64 = 15.0;
/// Discs in it: about 40 % of its area.
const GRAINS: usize = 290;
/// Turns until the bed is looked at, and until the end; turns shorter than [`LEAST`] count as that.
const TURNS: [f64; 2] = [0.6, 1.2];
/// In a drum that centrifuges single grains jump about for up to 60 units of time, in six fillings, until they are caught.
const LEAST: f64 = 120.0;

/// What a bed does in the mean over time.
struct Bed {
    froude: f64,
    /// Share of the grains that are nearer to nobody than a tenth of a diameter: they fly.
    flying: f64,
    /// How much steeper the surface is in the upper half from its crest on than in the lower [degrees].
    bend: f64,
    /// How far the grain that lags most goes round the axis, over how far the drum does.
    last: f64,
}

fn drum(froude: f64, friction: f64, seed: u64, perturbation: f64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "discs in a rotating drum"
        seed = {seed}
        gravity = 1
        duration = 10000
        {law}
        [materials.wall]
        young-modulus = 1e6
        restitution = 0.5
        friction = {friction}
        [[material-pair]]
        between = ["grain", "wall"]
        friction = {rough}
        rolling-friction = {rough}
        contact.rolling.epsd = {{}}
        [particles.discs]
        material = "grain"
        count = {GRAINS}
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        shape.disc.thickness = 1
        start.rows = {{ spacing = 1.02, jitter = 1, speed = 0.5, region = {{ low = [-12, -9], high = [12, 9] }} }}
        [walls.drum]
        material = "wall"
        shape.cylinder.radius = {DRUM}
        rotation.signal.steady.rate = {rate}
        "#,
        law = law(5e3, friction, 0.5),
        // The wall is as if grains stuck to it: on a smooth one the lowest grains roll, and the bed stays below.
        rough = if friction > 0.0 { 1.0 } else { 0.0 },
        rate = turning(froude),
    );
    Rig::new(&text, perturbation)
}

/// Spin of the drum at a Froude number.
fn turning(froude: f64) -> f64 {
    (froude / DRUM).sqrt()
}

impl Bed {
    fn of(froude: f64, friction: f64, seed: u64, perturbation: f64) -> Result<Self, String> {
        let mut rig = drum(froude, friction, seed, perturbation)?;
        let turn = (std::f64::consts::TAU / turning(froude)).max(LEAST);
        let [begin, end] = TURNS.map(|turns| turns * turn);
        let samples = sampled(&mut rig, [begin, end, turn / 200.0], |rig| rig.vectors("position"))?;
        let radii = scalars(&rig.frame(), Kind::Grain, "radius");
        let flights: Vec<Vec<bool>> = samples.iter().map(|centres| flying(centres, &radii)).collect();
        let (looks, alone) = (samples.len() as f64, flights.iter().flatten().filter(|f| **f).count());
        let mut swept = vec![0.0; GRAINS];
        for pair in samples.windows(2) {
            for (sum, (old, now)) in swept.iter_mut().zip(pair[0].iter().zip(&pair[1])) {
                // From z to x, as the drum turns.
                *sum += (old.z * now.x - old.x * now.z).atan2(old.x * now.x + old.z * now.z);
            }
        }
        let turned = turning(froude) * turn / 200.0 * (looks - 1.0);
        Ok(Self {
            froude,
            flying: alone as f64 / (looks * GRAINS as f64),
            bend: bend(&samples, &flights),
            last: swept.iter().map(|s| s / turned).fold(f64::MAX, f64::min),
        })
    }

    fn name(&self, what: &str) -> String {
        format!("drum at Froude number {}: {what}", self.froude)
    }

    /// Rolling: a straight surface, nobody flies. Then an S, steep above; then a part of the bed is thrown; then all goes round.
    fn gates(&self, regime: Regime) -> Vec<Claim> {
        let source = own("regimes of Mellmann 2001, from memory; the bars are ours").after();
        let flying =
            |low, high| Claim::judge(self.name("share of the grains that fly"), self.flying, low, high, source);
        let bend = |low, high| {
            Claim::judge(self.name("surface, upper less lower half [degrees]"), self.bend, low, high, source)
        };
        let last = |low, high| {
            Claim::judge(self.name("turns of the grain that lags most, over the drum's"), self.last, low, high, source)
        };
        match regime {
            Regime::Rolling => vec![flying(None, Some(0.005)), bend(Some(-8.0), Some(8.0)), last(None, Some(0.5))],
            Regime::Cascading => vec![flying(Some(0.005), Some(0.03)), bend(Some(8.0), None), last(None, Some(0.5))],
            Regime::Cataracting => vec![flying(Some(0.03), None), bend(Some(8.0), None), last(None, Some(0.5))],
            Regime::Centrifuging => vec![flying(None, Some(0.005)), last(Some(0.5), None)],
        }
    }
}

#[derive(Clone, Copy)]
enum Regime {
    Rolling,
    Cascading,
    Cataracting,
    Centrifuging,
}

/// Which grains are nearer to no other, and not to the wall, than a tenth of a mean diameter.
fn flying(centres: &[DVec3], radii: &[f64]) -> Vec<bool> {
    let far = |i: usize, j: usize| centres[i].distance(centres[j]) > radii[i] + radii[j] + 0.1;
    let alone = |i: usize| centres[i].length() + radii[i] + 0.1 < DRUM && (0..radii.len()).all(|j| i == j || far(i, j));
    (0..radii.len()).map(alone).collect()
}

/// How much steeper the surface is in its upper half, from its crest on, than in its lower [degrees]: the mean height of the
/// highest grain that does not fly, in columns one diameter wide. The bed is carried up towards negative x.
fn bend(samples: &[Vec<DVec3>], flights: &[Vec<bool>]) -> f64 {
    let columns = 2 * DRUM as usize;
    let mut tops = vec![(0.0, 0.0); columns];
    for (centres, flies) in samples.iter().zip(flights) {
        let mut highest = vec![f64::NEG_INFINITY; columns];
        for (p, _) in centres.iter().zip(flies).filter(|(_, flies)| !**flies) {
            let column = &mut highest[((p.x + DRUM) as usize).min(columns - 1)];
            *column = column.max(p.z);
        }
        for (top, z) in tops.iter_mut().zip(highest).filter(|(_, z)| z.is_finite()) {
            *top = (top.0 + 1.0, top.1 + z);
        }
    }
    let often = |top: &(f64, f64)| top.0 > 0.9 * samples.len() as f64;
    let surface: Vec<(f64, f64)> =
        (0..columns).filter(|&k| often(&tops[k])).map(|k| (k as f64, tops[k].1 / tops[k].0)).collect();
    let crest = (0..surface.len()).max_by(|a, b| surface[*a].1.total_cmp(&surface[*b].1)).unwrap_or_default();
    let (upper, lower) = surface[crest..].split_at((surface.len() - crest) / 2);
    let steep = |part: &[(f64, f64)]| (-line(part).0).atan().to_degrees();
    steep(upper) - steep(lower)
}

/// V-37: at Froude numbers in the middle of the ranges the bed rolls, cascades, cataracts and is centrifuged, and is refused by
/// the gates of its neighbours.
pub(super) fn regimes(perturbation: f64) -> Judged {
    ensemble::drawn("drums", 1..=5, |seed| {
        let middle = [
            (0.005, Regime::Rolling),
            (0.05, Regime::Cascading),
            (0.35, Regime::Cataracting),
            (4.0, Regime::Centrifuging),
        ];
        let beds = middle.map(|(froude, _)| Bed::of(froude, 0.5, seed, perturbation));
        let beds = beds.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut claims = Vec::new();
        for (k, (bed, (_, regime))) in beds.iter().zip(middle).enumerate() {
            claims.extend(bed.gates(regime));
            let (froude, other) = middle[if k == 0 { 1 } else { k - 1 }];
            let what = format!("drum at Froude number {}, for one at {froude}", bed.froude);
            claims.push(refused(&what, &bed.gates(other), 1));
        }
        let smooth = Bed::of(4.0, 0.0, seed, perturbation)?;
        claims.push(refused("drum without friction at Froude number 4", &smooth.gates(Regime::Centrifuging), 1));
        Ok(claims)
    })
}
