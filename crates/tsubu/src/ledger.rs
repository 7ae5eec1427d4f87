//! The ledger: where energy and momentum went.
//!
//! *Energies* are what the system holds now, measured from its state. *Flows* are what came in or was lost since time 0,
//! posted step by step by whoever does the work. The books close when
//!
//! energies now - energies at 0 = work done on the system - losses,
//!
//! and what is left over is the residual: an error of the time integration, or of the program.

use crate::mutation::{Mutation, mutated};
use crate::sections::{self, Named};
use std::slice::from_mut;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// A named row of flows. Work rows count energy that came in, loss rows energy that left as heat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Account {
    /// Work of a host's moving base on the structure [J].
    BaseWork,
    /// Work of forces applied to a host [J].
    ForceWork,
    /// Work of walls with prescribed motion on the grains [J].
    WallWork,
    /// Lost in the normal damping of contacts [J].
    NormalDamping,
    /// Lost in sliding friction and tangential damping [J].
    Sliding,
    /// Lost in rolling resistance [J].
    Rolling,
    /// Lost in the damping of bonds [J].
    BondDamping,
    /// Set free by bonds that broke, less what the contacts in their place hold; or held by contacts that bonds took the place of [J].
    Bonds,
    /// Lost in the structure's own damper [J].
    HostDamping,
    /// Lost in lattice collisions by restitution [J].
    Collision,
    /// Work of flowing water on the grains: what its forces would do to grains that went along with it; where the stream is
    /// part of the system, the work of what drives it [J].
    StreamWork,
    /// Work of the pressure (and shear stress) in the water on the grains, and of water that begins or ends to move along
    /// with them where they go through its surface [J].
    Buoyancy,
    /// Lost in drag: what the forces of the water take from motion relative to it [J].
    Drag,
    /// Lost in the stream itself: in its stress, at its bottom, and where it mixes to make way for grains; less what its
    /// turbulence does to grains [J].
    StreamFriction,
    /// Lost (or gained: negative) by rules of a lattice model that do not conserve energy: forgotten distance,
    /// turned directions, one-sided collisions [J].
    LatticeRules,
    /// Lost (or gained) because an automaton treats the box as infinitely heavy within a step [J].
    HeavyBox,
    /// Energy that grains brought which came in, less what those took that were removed [J].
    Exchange,
    /// Energy that contacts held with walls when these vanished: negative, it goes with them [J].
    Gates,
    /// What the system holds more when a stage of a run begins than when the one before ended: potential energy in another gravity,
    /// springs of another stiffness [J].
    Stages,
    /// Work of whoever acts on grains and moves walls from outside the program [J].
    Outside,
}

impl Account {
    /// All accounts, in the order they are reported.
    pub const ALL: [Self; 20] = [
        Self::BaseWork,
        Self::ForceWork,
        Self::WallWork,
        Self::NormalDamping,
        Self::Sliding,
        Self::Rolling,
        Self::BondDamping,
        Self::Bonds,
        Self::HostDamping,
        Self::Collision,
        Self::StreamWork,
        Self::Buoyancy,
        Self::Drag,
        Self::StreamFriction,
        Self::LatticeRules,
        Self::HeavyBox,
        Self::Exchange,
        Self::Gates,
        Self::Stages,
        Self::Outside,
    ];

    /// Name in summaries and figures.
    pub fn name(self) -> &'static str {
        match self {
            Self::BaseWork => "base work",
            Self::ForceWork => "force work",
            Self::WallWork => "wall work",
            Self::NormalDamping => "normal damping",
            Self::Sliding => "sliding",
            Self::Rolling => "rolling",
            Self::BondDamping => "bond damping",
            Self::Bonds => "bonds made and broken",
            Self::HostDamping => "host damping",
            Self::StreamWork => "stream work",
            Self::Buoyancy => "buoyancy",
            Self::Drag => "drag",
            Self::StreamFriction => "stream friction",
            Self::Collision => "collision",
            Self::LatticeRules => "lattice rules",
            Self::HeavyBox => "heavy box",
            Self::Exchange => "grains in and out",
            Self::Gates => "vanished walls",
            Self::Stages => "changes of stage",
            Self::Outside => "outside work",
        }
    }

    /// Whether the row counts energy coming in (else: lost).
    pub fn is_work(self) -> bool {
        matches!(
            self,
            Self::BaseWork
                | Self::ForceWork
                | Self::WallWork
                | Self::StreamWork
                | Self::Buoyancy
                | Self::Exchange
                | Self::Gates
                | Self::Stages
                | Self::Outside
        )
    }
}

/// What the system holds [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Translational kinetic energy of the grains.
    pub kinetic: f64,
    /// Rotational kinetic energy of the grains.
    pub rotational: f64,
    /// Potential energy of the grains in gravity, from z = 0.
    pub potential: f64,
    /// Stored in contacts.
    pub elastic: f64,
    /// Stored in bonds.
    pub bonds: f64,
    /// Kinetic energy of the hosts.
    pub host_kinetic: f64,
    /// Stored in the springs of the hosts.
    pub host_spring: f64,
    /// Kinetic and potential energy of walls that move by themselves: servos and free bodies.
    pub walls: f64,
    /// Kinetic energy of the water that moves along with the grains: their added mass.
    pub added_mass: f64,
    /// Kinetic energy of a stream that the grains slow.
    pub stream: f64,
}

impl Energies {
    /// The terms with their names.
    pub fn terms(mut self) -> [(&'static str, f64); 10] {
        self.terms_mut().map(|(name, value)| (name, *value))
    }

    fn terms_mut(&mut self) -> [(&'static str, &mut f64); 10] {
        [
            ("kinetic", &mut self.kinetic),
            ("rotational", &mut self.rotational),
            ("potential", &mut self.potential),
            ("elastic", &mut self.elastic),
            ("bonds", &mut self.bonds),
            ("host kinetic", &mut self.host_kinetic),
            ("host spring", &mut self.host_spring),
            ("walls", &mut self.walls),
            ("added mass", &mut self.added_mass),
            ("stream", &mut self.stream),
        ]
    }

    fn named(&mut self) -> Named<'_> {
        self.terms_mut().map(|(name, value)| (name, &mut *from_mut(value))).into()
    }

    /// Sum of all terms.
    pub fn total(&self) -> f64 {
        self.terms().iter().map(|(_, value)| value).sum()
    }
}

/// Energy and momentum accounts of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ledger {
    flows: [f64; Account::ALL.len()],
    /// Impulse of gravity on the grains since time 0 [N.s].
    pub gravity_impulse: [f64; 3],
    /// Impulse of walls on the grains since time 0 [N.s].
    pub wall_impulse: [f64; 3],
    /// Impulse of the water on the grains since time 0, that on its added mass not counted [N.s].
    pub water_impulse: [f64; 3],
    /// Momentum that grains brought which came in, less what those took that were removed [N.s].
    pub exchange_impulse: [f64; 3],
    /// Impulse that lattice rules created out of nothing [N.s].
    pub rule_impulse: [f64; 3],
    /// Impulse of whoever acts on grains from outside the program [N.s].
    pub outside_impulse: [f64; 3],
    /// Impulse that hosts heard from the grains, along their directions [N.s].
    pub host_impulse: f64,
    /// Energies at time 0; set by [`Ledger::open`].
    opening: Energies,
    opening_momentum: [f64; 3],
}

impl Ledger {
    /// Opens the books: what the system holds at time 0.
    pub fn open(energies: Energies, momentum: [f64; 3]) -> Self {
        Self { opening: energies, opening_momentum: momentum, ..Self::default() }
    }

    /// Adds energy [J] to an account.
    #[inline]
    pub fn post(&mut self, account: Account, energy: f64) {
        self.flows[account as usize] += energy;
    }

    /// Sets an account to what it has come to since time 0 [J]: of rows that only a balance can tell.
    #[inline]
    pub fn set(&mut self, account: Account, energy: f64) {
        self.flows[account as usize] = energy;
    }

    /// Energy posted to an account since time 0 [J].
    pub fn flow(&self, account: Account) -> f64 {
        self.flows[account as usize]
    }

    /// Energy that the books cannot explain [J].
    pub fn residual(&self, now: &Energies) -> f64 {
        let change = now.total() - self.opening.total();
        let explained: f64 = Account::ALL
            .iter()
            .map(|&a| if a.is_work() { self.flow(a) } else { -mutated(Mutation::Losses, self.flow(a)) })
            .sum();
        change - explained
    }

    /// Residual over the energy turned over: the sum of all flows (absolute) and of the largest of the energies' changes. What rounding makes
    /// of energies that are held is none: of a bed at rest nothing is turned over.
    pub fn residual_relative(&self, now: &Energies) -> f64 {
        let held: f64 = now.terms().iter().map(|(_, value)| value.abs()).sum();
        if self.residual(now).abs() <= 8.0 * f64::EPSILON * held {
            return 0.0;
        }
        let flows: f64 = self.flows.iter().map(|f| f.abs()).sum();
        let moving = now.kinetic.max(self.opening.kinetic)
            + now.host_kinetic.max(self.opening.host_kinetic)
            + (now.stream - self.opening.stream).abs();
        let change =
            (now.potential - self.opening.potential).abs().max((now.host_spring - self.opening.host_spring).abs());
        let turned_over = flows + moving + change;
        if turned_over > 0.0 { self.residual(now) / turned_over } else { 0.0 }
    }

    /// Momentum that the books cannot explain [N.s].
    pub fn momentum_residual(&self, now: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| {
            now[i]
                - self.opening_momentum[i]
                - self.gravity_impulse[i]
                - self.wall_impulse[i]
                - self.water_impulse[i]
                - self.outside_impulse[i]
                - self.rule_impulse[i]
                - self.exchange_impulse[i]
        })
    }

    /// Everything that the books hold, each under its name.
    fn named(&mut self) -> Named<'_> {
        let accounts = Account::ALL.iter().zip(&mut self.flows);
        let mut all: Named = accounts.map(|(account, flow)| (account.name(), from_mut(flow))).collect();
        all.push(("gravity impulse", &mut self.gravity_impulse));
        all.push(("wall impulse", &mut self.wall_impulse));
        all.push(("water impulse", &mut self.water_impulse));
        all.push(("outside impulse", &mut self.outside_impulse));
        all.push(("exchange impulse", &mut self.exchange_impulse));
        all.push(("rule impulse", &mut self.rule_impulse));
        all.push(("host impulse", from_mut(&mut self.host_impulse)));
        all.push(("opening momentum", &mut self.opening_momentum));
        all
    }

    /// Writes the books into a checkpoint.
    pub fn save(&self, state: &mut State) {
        let mut books = self.clone();
        sections::save("ledger", books.named(), state);
        sections::save("ledger.opening", books.opening.named(), state);
    }

    /// Reads the books from a checkpoint.
    pub fn load(state: &State) -> Result<Self, MissingSection> {
        let mut books = Self::default();
        sections::load("ledger", books.named(), state)?;
        sections::load("ledger.opening", books.opening.named(), state)?;
        Ok(books)
    }
}
