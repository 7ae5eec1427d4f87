//! Piles after Karolyi and Kertesz as models of the engine.

use super::{Model, Seat, section, wrong};
use crate::lattice::direction::Direction;
use crate::lattice::gas::pile::{Pile, Place};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Number of a site's place for a grain at rest, after those of the six directions.
const REST: usize = 6;

/// A pile and where grains vanish.
#[derive(Clone, Debug)]
pub struct Avalanche {
    pile: Pile,
    /// Sites where grains vanish, unless they are wall.
    outlets: Vec<bool>,
    /// Whether there are any.
    leaks: bool,
}

impl Avalanche {
    /// A pile whose grains have been announced.
    pub fn new(pile: Pile, outlets: &[usize]) -> Self {
        let mut flags = vec![false; pile.sites.count()];
        for &site in outlets {
            flags[site] = true;
        }
        Self { pile, outlets: flags, leaks: !outlets.is_empty() }
    }

    fn seat(&self, grain: usize, Place { site, way }: Place) -> Seat {
        let way = way.map_or([0.0; 3], Direction::unit);
        let laps = [self.pile.laps[grain], 0];
        Seat { grain, site, offset: [0.0; 2], velocity: [way[0], way[2]], laps }
    }
}

impl Model for Avalanche {
    fn advance(&mut self) -> Result<(), String> {
        self.pile.step();
        if self.leaks {
            self.pile.clear(&self.outlets);
        }
        Ok(())
    }

    fn step(&self) -> u64 {
        self.pile.steps()
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        for (grain, place) in self.pile.places().into_iter().enumerate() {
            if let Some(place) = place {
                each(self.seat(grain, place));
            }
        }
    }

    fn free(&mut self, site: usize, _outlet: bool) {
        self.pile.free(site);
    }

    /// Who stops where others rest is set down on top of them, wherever that is.
    fn limits(&self) -> (usize, f64) {
        (REST + 1, f64::INFINITY)
    }

    fn removed(&mut self) -> Vec<Seat> {
        let removed = std::mem::take(&mut self.pile.removed);
        removed.into_iter().map(|(grain, place)| self.seat(grain as usize, place)).collect()
    }

    fn enter(&mut self, grain: usize, site: usize) -> Option<Seat> {
        let free = self.pile.release(site, grain as u32);
        free.then(|| self.seat(grain, Place { site, way: Some(Direction::S) }))
    }

    fn save(&self, state: &mut State) {
        let number = |place: Option<Place>| {
            place.map_or(-1, |Place { site, way }| (site * (REST + 1) + way.map_or(REST, |way| way as usize)) as i64)
        };
        state.put_integer("gas.places", self.pile.places().into_iter().map(number).collect::<Vec<_>>());
        state.put_integer("gas.laps", self.pile.laps.iter().map(|lap| i64::from(*lap)).collect::<Vec<_>>());
        state.put_integer("gas.step", vec![self.pile.steps() as i64]);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let count = self.pile.laps.len();
        let place = |number: &i64| {
            let number = usize::try_from(*number).ok()?;
            let way = Direction::ALL.get(number % (REST + 1)).copied();
            Some(Place { site: number / (REST + 1), way })
        };
        let places: Vec<_> = section(state, "gas.places", count)?.iter().map(place).collect();
        if places.iter().flatten().any(|place| place.site >= self.pile.sites.count()) {
            return Err(wrong("gas.places"));
        }
        let laps = section(state, "gas.laps", count)?;
        self.pile.laps = laps.iter().map(|lap| *lap as i32).collect();
        self.pile.restore(&places, section(state, "gas.step", 1)?[0] as u64);
        Ok(())
    }
}
