//! The bench of contact laws: what any law must do, asked of every stack of parts that a scene can build, and what each part
//! promises, against closed forms and published numbers. Beside every gate stands a law that it must refuse.

mod adhesion;
mod cycle;
mod film;
mod frame;
mod impact;
mod luding;
mod oblique;
mod rolling;
mod row;
mod stack;
mod text;
mod two;

use tsubu::contact::chunk::Chunk;
use tsubu::contact::pair::Constants;
use tsubu::contact::{Law, Pair};
use tsubu_scene::plan::Contact;

/// A law at work on a chunk, or one that has been spoiled to see whether a gate notices.
pub struct Subject {
    pub contact: Contact,
    pub law: Law,
    pub constants: Constants,
    /// What is done to the results afterwards.
    pub spoil: fn(&mut Chunk),
}

impl Subject {
    /// The law of `contact` between bodies of `constants`.
    pub fn new(contact: &Contact, constants: Constants) -> Self {
        let (law, mut constants) = (Law::new(contact), constants);
        law.prepare(&mut constants);
        Self { contact: contact.clone(), law, constants, spoil: |_| {} }
    }

    /// The same law, spoiled.
    pub fn spoiled(&self, spoil: fn(&mut Chunk)) -> Self {
        Self { contact: self.contact.clone(), law: Law::new(&self.contact), constants: self.constants, spoil }
    }

    /// An empty chunk with all constants filled in.
    pub fn chunk(&self, rows: usize) -> Box<Chunk> {
        let mut chunk = Box::new(Chunk::new(self.law.width()));
        chunk.len = rows;
        chunk.set_constants(0..rows, &self.constants);
        chunk
    }

    pub fn apply(&self, chunk: &mut Chunk, dt: f64) {
        self.law.apply(chunk, dt);
        (self.spoil)(chunk);
    }

    /// Two bodies of effective radius and mass, as the verdict on the time step sees them.
    pub fn pair(&self, radius: f64, mass: f64) -> Pair {
        let mut pair = Pair { constants: self.constants, radius, mass, ..Pair::default() };
        self.law.judge(&mut pair);
        pair
    }
}

/// Soft grains of every kind of friction and stickiness.
pub fn constants() -> Constants {
    Constants {
        effective_modulus: 0.27e9,
        shear_modulus: 0.06e9,
        restitution: 0.75,
        friction: 0.5,
        rolling: 0.1,
        twisting: 0.3,
        surface_energy: 5.0,
        ..Constants::default()
    }
}

/// Numbers of a fixed sequence.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Between two, every number as likely (splitmix64).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A vector in a cube about zero.
    pub fn vector(&mut self, size: f64) -> glam::DVec3 {
        glam::DVec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }
}
