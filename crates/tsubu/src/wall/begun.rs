//! Walls that a later stage of a run moves in another way: they do so from where they stand, and the time of their motion counts from
//! the begin of that stage.

use super::{Mover, Pose, Wall};
use crate::partner::Hosts;
use glam::{DQuat, DVec3};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

/// Where the motion of a wall began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Begun {
    /// When its mover took it over [s].
    pub moved: f64,
    /// How far it had come by then [m].
    pub offset: DVec3,
    /// When its turning began [s].
    pub turned: f64,
    /// How far it had turned by then.
    pub rotation: DQuat,
}

impl Begun {
    /// Puts a place that is told from the begin of a motion on top of where that began; `turns`: the rotation is told so, too.
    pub(super) fn carry(&self, pose: &mut Pose, turns: bool) {
        pose.offset += self.offset;
        if turns {
            pose.rotation *= self.rotation;
        } else if self.rotation != DQuat::IDENTITY {
            pose.rotation = self.rotation;
        }
    }

    fn numbers(&self) -> [f64; 9] {
        let (o, q) = (self.offset, self.rotation);
        [self.moved, o.x, o.y, o.z, self.turned, q.x, q.y, q.z, q.w]
    }

    fn of(numbers: [f64; 9]) -> Self {
        let [moved, x, y, z, turned, i, j, k, w] = numbers;
        Self { moved, offset: DVec3::new(x, y, z), turned, rotation: DQuat::from_xyzw(i, j, k, w) }
    }
}

impl Wall {
    /// Another stage begins at `time` [s]: what of the wall's motion it changes begins now, from where the wall stands.
    pub fn change(
        &mut self,
        [earlier, now]: [&plan::Wall; 2],
        dimension: u8,
        hosts: &Hosts,
        gravity: DVec3,
        time: f64,
    ) -> Result<(), String> {
        let moves = |wall: &plan::Wall| (wall.motion.clone(), wall.servo.clone(), wall.host.clone());
        let (moved, turned) = (moves(earlier) != moves(now), earlier.rotation != now.rotation);
        let until = if earlier.until == now.until { self.until } else { now.until.map(|until| time + until) };
        self.until_of_stage |= earlier.until != now.until;
        if !moved && !turned {
            self.until = until;
            return Ok(());
        }
        let mut next = Self::new(&self.name, now, dimension, hosts, gravity);
        if next.pose.centre != self.pose.centre && self.pose.rotation != DQuat::IDENTITY {
            return Err("a wall that has turned goes on turning about the same centre".to_owned());
        }
        let mut begun = self.begun.unwrap_or_default();
        if moved {
            (begun.moved, begun.offset) = (time, self.pose.offset - next.mover.displacement(0.0, hosts).0);
        } else {
            next.mover = self.mover.clone();
        }
        if turned {
            begun.turned = time;
            begun.rotation = next.pose.rotation.conjugate() * self.pose.rotation;
        }
        if matches!(next.mover, Mover::Body(_)) {
            begun = Begun::default();
        }
        (next.material, next.inverse_mass, next.vanished) = (self.material, self.inverse_mass, self.vanished);
        (next.begun, next.until, next.until_of_stage) = (Some(begun), until, self.until_of_stage);
        *self = next;
        self.follow(time, hosts);
        Ok(())
    }

    /// At time 0 of another clock: all its motion begins now, from where it stands. What has vanished stays so.
    pub fn begin_anew(&mut self, plan: &plan::Wall, hosts: &Hosts) {
        self.until = if self.vanished() { Some(0.0) } else { plan.until };
        if matches!(self.mover, Mover::Body(_)) {
            return;
        }
        let offset = self.pose.offset - self.mover.displacement(0.0, hosts).0;
        let mut drawn = self.pose;
        if let Some(turning) = &self.turning {
            turning.place(0.0, &mut drawn);
            drawn.rotation = drawn.rotation.conjugate() * self.pose.rotation;
        }
        self.begun = Some(Begun { moved: 0.0, offset, turned: 0.0, rotation: drawn.rotation });
        self.follow(0.0, hosts);
    }

    /// What a later stage has changed.
    pub(super) fn save_begun(&self, state: &mut State) {
        let until = self.until.unwrap_or(f64::INFINITY);
        match &self.begun {
            Some(begun) => state.put_real(&self.section("begun"), [begun.numbers().as_slice(), &[until]].concat()),
            None if self.until_of_stage => state.put_real(&self.section("until"), vec![until]),
            None => {}
        }
    }

    /// Takes it back.
    pub(super) fn load_begun(&mut self, state: &State) -> Result<(), MissingSection> {
        if let Ok(&[until]) = state.real(&self.section("until")) {
            self.until = until.is_finite().then_some(until);
        }
        let section = self.section("begun");
        let Ok(values) = state.real(&section) else { return Ok(()) };
        let Ok([numbers @ .., until]) = <[f64; 10]>::try_from(values) else {
            return Err(MissingSection { name: section, kind: "real" });
        };
        self.begun = Some(Begun::of(numbers));
        self.until = until.is_finite().then_some(until);
        Ok(())
    }

    fn section(&self, what: &str) -> String {
        format!("wall.{}.{what}", self.name)
    }
}
