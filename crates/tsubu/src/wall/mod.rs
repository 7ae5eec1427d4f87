//! Walls: their geometry, how grains touch them, and who moves them.
//!
//! A [`Wall`] keeps its elements (half-spaces, the sides of a cylinder or cone, a shell, triangles) in the frame it was
//! drawn in and has a [`Pose`]. Grains are taken into that frame, so moving a wall touches none of its elements.
//!
//! In a step the engine calls, for every wall, [`Wall::before`] (servos and free bodies move), [`Wall::follow`] (the
//! pose is that of the new time), [`Wall::touching`] for every grain with candidates, and [`Wall::after`] with the sum
//! of the forces. A contact's history belongs to (grain, wall, [`Wall::key`]).

mod begun;
pub mod body;
mod distinct;
mod faces;
mod facets;
pub mod frustum;
pub mod half_space;
mod inside;
pub mod mesh;
pub mod mover;
pub mod nearest;
pub mod outline;
pub mod pose;
pub mod ridges;
mod section;
pub mod servo;
pub mod shell;
pub mod steered;
pub mod surface;
mod topology;
mod tree;
pub mod triangle;

pub use begun::Begun;
pub use body::Body;
pub use faces::Faces;
pub use facets::Faceted;
pub use mover::{Exchange, Mover, Turning};
pub use nearest::{Feature, Nearest, Touch};
pub use outline::Outline;
pub use pose::Pose;
pub use servo::Servo;
pub use steered::{Steered, Velocity};
pub use surface::Surface;
pub(crate) use tree::meets_box;

use crate::about::About;
use crate::partner::Hosts;
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

/// What the shapes of walls are, and who moves walls.
pub(crate) const ABOUT: &[&About] = &[
    &half_space::BOX,
    &half_space::PLANE,
    &frustum::CYLINDER,
    &frustum::CONE,
    &shell::SPHERE,
    &mesh::MESH,
    &mover::HOST,
    &mover::MOTION,
    &mover::ROTATION,
    &servo::ABOUT,
    &body::ABOUT,
];

/// A wall: a surface, where it is, and who moves it.
#[derive(Clone, Debug)]
pub struct Wall {
    /// Name in the scene.
    pub name: String,
    /// Number of its material in the contact table; the engine sets it.
    pub material: u32,
    /// One over the mass it shows in an impact [1/kg]: 0 but for walls on a light structure; the engine sets it.
    pub inverse_mass: f64,
    /// Where it is and how it moves.
    pub pose: Pose,
    /// Its elements, as drawn.
    pub surface: Surface,
    /// Who displaces it.
    pub mover: Mover,
    /// Prescribed turning, on top of `mover`.
    pub turning: Option<Turning>,
    /// When it vanishes [s].
    pub until: Option<f64>,
    /// Whether a later stage has said so: its time counts from the begin of that stage.
    until_of_stage: bool,
    /// Since when it moves as it does, and from where; nothing where it does so from the first.
    begun: Option<Begun>,
    /// Whether it has vanished: nothing touches it then, and nobody sees it.
    vanished: bool,
    outline: Outline,
    /// In the plane y is an exact zero, whatever rounding says.
    pub(crate) in_plane: bool,
}

impl Wall {
    /// Builds a wall at time 0. `dimension` 2: boxes have no front and back, drums no ends, and of meshes
    /// the section with y = 0 counts. `gravity` [m/s^2] pulls
    /// free bodies.
    pub fn new(name: &str, plan: &plan::Wall, dimension: u8, hosts: &Hosts, gravity: DVec3) -> Self {
        let mover = Mover::new(plan, hosts, gravity);
        let centre = match (&mover, &plan.rotation) {
            (Mover::Body(body), _) => body.drawn_centre(),
            (_, Some(rotation)) => DVec3::from_array(rotation.centre),
            _ => DVec3::ZERO,
        };
        let surface = Surface::new(&plan.shape, dimension, centre);
        let outline = Outline::new(&plan.shape, &surface, dimension);
        let turning = plan.rotation.as_ref().map(Turning::new);
        let (name, pose) = (name.to_owned(), Pose::at_rest(centre));
        let mut wall = Self {
            name,
            material: 0,
            inverse_mass: 0.0,
            pose,
            surface,
            mover,
            turning,
            until: plan.until,
            until_of_stage: false,
            begun: None,
            vanished: false,
            outline,
            in_plane: dimension == 2,
        };
        wall.follow(0.0, hosts);
        wall
    }

    /// Takes the place and motion of `time` [s]; hosts, servos and bodies give those they have now.
    pub fn follow(&mut self, time: f64, hosts: &Hosts) {
        let begun = self.begun.unwrap_or_default();
        self.mover.place(time - begun.moved, hosts, &mut self.pose);
        if let Some(turning) = &self.turning {
            turning.place(time - begun.turned, &mut self.pose);
        }
        if self.begun.is_some() {
            begun.carry(&mut self.pose, self.turning.is_some());
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.surface.elements()
    }

    /// Whether it has vanished.
    pub fn vanished(&self) -> bool {
        self.vanished
    }

    /// Whether it should have vanished at `time` [s]. The end of the step that reaches the moment counts, whatever
    /// rounding makes of the product of steps and step.
    pub fn goes_by(&self, time: f64) -> bool {
        self.until.is_some_and(|until| time >= until * (1.0 - 1e-9))
    }

    /// Makes it vanish, or brings it back, as `time` [s] wants. Candidates must be found again after that.
    pub fn stand_or_go(&mut self, time: f64) {
        self.vanished = self.goes_by(time);
    }

    /// Puts the elements whose distance from a point is below `reach` [m] into `out`, ascending.
    pub fn near(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        if self.vanished {
            out.clear();
            return;
        }
        self.surface.near(self.pose.to_own(centre), reach, out);
    }

    /// The nearest point of an element to a point, both in the world.
    #[inline]
    pub fn nearest(&self, element: u32, centre: DVec3) -> Nearest {
        self.placed(self.surface.nearest(element, self.pose.to_own(centre)))
    }

    /// The contacts of one grain among its candidate elements, which must hold every element within `reach` [m]; `out`
    /// is emptied first. Elements ascend. What does not touch costs one look in the wall's own frame.
    pub fn touching(&self, candidates: &[u32], centre: DVec3, reach: f64, out: &mut Vec<Touch>) {
        out.clear();
        let own = self.pose.to_own(centre);
        for &element in candidates {
            let nearest = self.surface.nearest(element, own);
            if nearest.distance < reach {
                out.push(Touch::new(element, self.placed(nearest)));
            }
        }
        let contacts = self.distinct(out);
        out.truncate(contacts);
    }

    /// Moves those touches of one grain that are contacts of their own to the front, in the order of elements, and
    /// returns how many they are. `touches` must hold *all* elements within reach. On other shapes than meshes every
    /// touch is one.
    pub fn distinct(&self, touches: &mut [Touch]) -> usize {
        match &self.surface {
            Surface::Mesh(mesh) => distinct::distinct(mesh, &self.pose, touches),
            _ => touches.len(),
        }
    }

    /// What the history of a contact hangs on: the patch of coplanar triangles, so that it goes on over seams; of other
    /// shapes the element. Where a patch is not convex (a grain in a hole of a plate) contacts of one grain may share a
    /// key; the order of elements tells them apart.
    pub fn key(&self, element: u32) -> u32 {
        match &self.surface {
            Surface::Mesh(mesh) => mesh.topology.patch[element as usize],
            _ => element,
        }
    }

    /// Whether the surfaces of two keys share an edge or a corner, so that a contact may have rolled from one to the
    /// other.
    pub fn adjacent(&self, a: u32, b: u32) -> bool {
        matches!(&self.surface, Surface::Mesh(mesh) if mesh.topology.adjacent(a, b))
    }

    /// Velocity of the wall at a point of the world [m/s].
    #[inline]
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.pose.velocity_at(point)
    }

    /// Upper bound of how far any point of the surface has moved since a reference pose [m]; planes count along their
    /// normals, and turning about its own axis does not move a cylinder. `extent`: the greatest distance of any grain
    /// from [`Pose::origin`] [m], looked at only where a lone plane or an endless cylinder has tilted (infinity is
    /// safe).
    pub fn travel_bound(&self, reference: &Pose, extent: f64) -> f64 {
        self.surface.travel(&self.pose, reference, extent)
    }

    /// The host that carries it and the interface that it hangs on, by number.
    pub fn host(&self) -> Option<(usize, usize)> {
        match self.mover {
            Mover::Host { host, interface } => Some((host, interface)),
            _ => None,
        }
    }

    /// Power of prescribed motion on the wall [W] when the grains act on it with `force` [N] and with `torque` [N.m]
    /// about [`Pose::origin`]; its negative is what such walls give to the grains. Hosts, servos and bodies keep their
    /// own books.
    pub fn prescribed_power(&self, force: DVec3, torque: DVec3) -> f64 {
        let steered = self.steered();
        let moved =
            if steered || matches!(self.mover, Mover::Motion(..)) { force.dot(self.pose.velocity) } else { 0.0 };
        let turned = if steered || self.turning.is_some() { torque.dot(self.pose.spin) } else { 0.0 };
        moved + turned
    }

    /// Kinetic energy, and potential energy in gravity, of a servo or a body [J]; zero for others.
    pub fn energy(&self) -> (f64, f64) {
        match &self.mover {
            Mover::Servo(servo) => (servo.kinetic(), 0.0),
            Mover::Body(body) => (body.kinetic().0 + body.kinetic().1, body.potential()),
            _ => (0.0, 0.0),
        }
    }

    /// Tells a servo or body the grains' force [N] and torque about [`Pose::origin`] [N.m] at time 0.
    pub fn start(&mut self, force: DVec3, torque: DVec3) {
        match &mut self.mover {
            Mover::Servo(servo) => servo.start(force),
            Mover::Body(body) => body.start(force, torque),
            _ => {}
        }
    }

    /// First half of a step of a servo or body: it moves to the end of the step. [`Wall::follow`] comes next.
    pub fn before(&mut self, dt: f64) {
        match &mut self.mover {
            Mover::Servo(servo) => servo.before(dt),
            Mover::Body(body) => body.before(dt),
            _ => {}
        }
    }

    /// Second half of a step of a servo or body: it hears the grains' force [N] and torque about [`Pose::origin`]
    /// [N.m]. Returns what it exchanged with the outside.
    pub fn after(&mut self, force: DVec3, torque: DVec3, dt: f64) -> Exchange {
        match &mut self.mover {
            Mover::Servo(servo) => {
                let exchange = servo.after(force, dt);
                self.pose.velocity = servo.direction * servo.velocity();
                exchange
            }
            Mover::Body(body) => {
                body.after(force, torque, dt);
                (self.pose.velocity, self.pose.spin) = (body.velocity(), body.spin());
                Exchange::default()
            }
            _ => Exchange::default(),
        }
    }

    /// Point and normal of a plane that stands alone: it has no end, and is drawn as large as the rest of a picture.
    pub fn lone_plane(&self) -> Option<(DVec3, DVec3)> {
        match &self.surface {
            Surface::HalfSpaces { planes, .. } if planes.len() == 1 && !self.vanished => {
                Some((self.pose.to_world(planes[0].point), self.pose.direction(planes[0].normal)))
            }
            _ => None,
        }
    }

    /// Lines and triangles for pictures, where they are now.
    pub fn outline(&self) -> Outline {
        if self.vanished { Outline::default() } else { self.outline.placed(&self.pose) }
    }

    /// Writes the state of a servo or body, and what a later stage has changed, into a checkpoint; other walls have none.
    pub fn save(&self, state: &mut State) {
        self.save_begun(state);
        self.save_steered(state);
        match &self.mover {
            Mover::Servo(servo) => servo.save(&format!("wall.{}", self.name), state),
            Mover::Body(body) => body.save(&format!("wall.{}", self.name), state),
            _ => {}
        }
    }

    /// Takes the state back from a checkpoint; [`Wall::follow`] comes next.
    pub fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        self.load_begun(state)?;
        self.load_steered(state)?;
        match &mut self.mover {
            Mover::Servo(servo) => servo.load(&format!("wall.{}", self.name), state),
            Mover::Body(body) => body.load(&format!("wall.{}", self.name), state),
            _ => Ok(()),
        }
    }

    fn placed(&self, own: Nearest) -> Nearest {
        let mut placed =
            Nearest { normal: self.pose.direction(own.normal), point: self.pose.to_world(own.point), ..own };
        if self.in_plane {
            (placed.normal.y, placed.point.y) = (0.0, 0.0);
        }
        placed
    }
}
