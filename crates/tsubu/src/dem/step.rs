//! The step.

use super::bonds::Attitudes;
use super::contact_forces::{ContactForces, ForceInput, each_contact};
use super::engine::DemEngine;
use super::history_transfer::HistorySnapshot;
use super::overlaps::overlaps;
use super::ranks::Ranks;
use crate::engine::Fault;
use crate::ledger::{Account, Ledger};
use crate::neighbours::block::BLOCK;
use crate::partner::Hosts;
use crate::ranks::Reader;
use crate::state::Grains;
use crate::threads::{awake, piece, shares};
use crate::view::Contact;
use crate::wall::{Mover, Wall};
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

impl DemEngine {
    /// Moves everything by so many time steps, whether it is `seen` then or not.
    pub(super) fn go(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger, seen: bool) -> Result<(), Fault> {
        let grains = self.grains.len();
        self.ranks.begin_to_work();
        let mut go = || {
            for step in 0..steps {
                self.step(hosts, ledger, !seen || step + 1 < steps)?;
                if self.contacts.outside.wants_stop() {
                    break;
                }
            }
            if seen {
                self.ranks.gather_grains(&mut self.grains);
            }
            Ok(())
        };
        if shares(grains) > 1 { awake(grains.div_ceil(BLOCK), go) } else { go() }
    }

    /// Moves everything by one time step. With `go_on` the grains have done the first half of the next step when it ends: it is
    /// done together with the second half of this one.
    pub(super) fn step(&mut self, hosts: &mut Hosts, ledger: &mut Ledger, go_on: bool) -> Result<(), Fault> {
        // Grains come and go, and gates open, between steps; a step before that is done to its end.
        let next = self.clock.step + 1;
        let (insertion_due, gate_due, bonds_due) =
            (self.insertion_due(next), self.gate_due(next), self.bonds_due(next));
        let go_on = go_on && !insertion_due && !gate_due && !bonds_due;
        let go_on = go_on && !self.contacts.outside.acts() && self.contacts.bonds.is_empty();
        if !std::mem::replace(&mut self.clock.half_step_done, go_on) {
            let dt = self.clock.dt;
            self.integration.first_half(&mut self.grains, &mut self.neighbours, dt, &mut self.ranks);
        }
        self.clock.tick(self.grains.len());
        let (time, dt) = (self.clock.time(), self.clock.dt);
        self.rotate();
        hosts.before(time, dt);
        self.move_walls(time, hosts);
        self.move_driven(time);
        self.update_added_mass(ledger);
        if self.neighbours.stale(&self.grains, &self.walls) {
            self.ranks.gather_positions(&mut self.grains);
            self.check_finite()?;
            self.rebuild_neighbours();
        }
        self.ask_outside();
        self.evaluate_forces(self.integration.predicted_for(dt));
        let deepest = self.deepest_beyond_limit();
        // Before positions may go on to the next step: the stream looks where the grains are now.
        self.advance_stream(ledger);
        self.second_half_step(dt, go_on);
        self.check_overlap(deepest)?;
        if !go_on {
            self.integration.bodies.show(&mut self.grains);
        }
        self.apply_reactions(hosts, ledger);
        hosts.after(time, dt, ledger);
        self.post_powers(ledger);
        if insertion_due || gate_due || bonds_due {
            self.ranks.gather_grains(&mut self.grains);
        }
        if insertion_due {
            self.insert_and_remove(ledger);
        }
        if gate_due {
            self.open_gates(ledger);
        }
        if self.contacts.bonds.overloaded() {
            self.break_bonds(ledger);
        }
        if bonds_due {
            self.make_bonds(ledger);
        }
        Ok(())
    }

    fn move_walls(&mut self, time: f64, hosts: &Hosts) {
        if self.clock.settling {
            return;
        }
        for wall in &mut self.walls {
            wall.before(self.clock.dt);
            wall.follow(time, hosts);
        }
    }

    /// Sorts the grains and makes the neighbour lists again; contact history follows its pair.
    pub(super) fn rebuild_neighbours(&mut self) {
        let history = self.snapshot_history();
        self.rebuild_neighbours_with(history);
    }

    /// The same with the contact history from before grains came or went.
    pub(super) fn rebuild_neighbours_with(&mut self, history: HistorySnapshot) {
        self.neighbours.sort_grains(&mut self.grains, self.ranks.columns_apart());
        self.integration.bodies.find(&self.grains);
        self.contacts.bonds.find(&self.grains);
        self.neighbours.part = self.cut();
        self.ranks.move_grains(&mut self.grains, self.neighbours.order());
        self.neighbours.rebuild(&self.grains, &self.walls);
        self.resize_contacts();
        self.ranks.share_start(&mut self.grains, &mut self.neighbours);
        let released = self.restore_history(history);
        self.contacts.released += released;
    }

    /// The blocks that this rank has from now on; `None`: all.
    pub(super) fn cut(&mut self) -> Option<Range<usize>> {
        let blocks = &self.contacts.blocks;
        let contacts = |block: usize| blocks.get(block).map_or(0, |block| block.sums.contacts);
        self.ranks.cut(self.grains.len().div_ceil(BLOCK), contacts)
    }

    /// The contacts that this rank and all others have, in the order of blocks.
    fn of_all_ranks(&self, own: Vec<Contact>) -> Vec<Contact> {
        if self.ranks.is_alone() {
            return own;
        }
        let mut message = Vec::new();
        for contact in own {
            contact.put(&mut message);
        }
        let all = self.ranks.gather(message);
        let mut all = Reader::new(&all);
        std::iter::from_fn(|| (!all.is_at_end()).then(|| Contact::take(&mut all))).collect()
    }

    /// Prepares the contacts for new neighbour lists.
    pub(super) fn resize_contacts(&mut self) {
        self.ranks.agree(&mut self.neighbours);
        let (contacts, _, input) = self.contacts_and_input();
        contacts.resize(&input);
        self.neighbours.estimate_work(self.contacts.blocks.iter().map(|block| block.sums.contacts));
    }

    pub(super) fn snapshot_history(&mut self) -> HistorySnapshot {
        let (contacts, _, input) = self.contacts_and_input();
        contacts.snapshot_history(&input)
    }

    pub(super) fn restore_history(&mut self, history: HistorySnapshot) -> f64 {
        let (contacts, ranks, input) = self.contacts_and_input();
        contacts.restore_history(&input, history, ranks)
    }

    /// Forces of contacts and of the water at this time level; `completion` as in [`ForceInput`].
    fn evaluate_forces(&mut self, completion: f64) {
        let (contacts, ranks, input) = self.contacts_and_input();
        contacts.evaluate(&ForceInput { completion, ..input }, ranks);
        if let Some(immersion) = self.immersion.as_mut().filter(|immersion| immersion.has_stream()) {
            // The stream looks at it before the step goes on.
            self.ranks.share_reaction(&mut self.contacts.blocks);
            immersion.sum_reaction(&self.contacts.blocks);
        }
        self.contacts.add_outside(&self.grains);
        self.add_bonds();
    }

    /// Adds what bonds do to the grains to what contacts do.
    fn add_bonds(&mut self) {
        let Self { grains, contacts, neighbours, integration, .. } = self;
        let ContactForces { bonds, blocks, .. } = contacts;
        let attitudes = Attitudes { orientation: &integration.orientation, bodies: &integration.bodies };
        bonds.evaluate(grains, attitudes, &neighbours.search.periodic);
        bonds.add(blocks, &neighbours.own());
    }

    /// Forces, energies and powers of a moment that no step has led to: at time 0, and after grains or walls have gone.
    pub(super) fn evaluate_at_rest(&mut self) {
        // In a moment bodies that adhere take hold of each other and springs stay as they are. Powers have no meaning then:
        // what snapping together sets free has gone before the ledger opens.
        let (contacts, ranks, input) = self.contacts_and_input();
        contacts.evaluate(&ForceInput { moment: true, water: None, ..input }, ranks);
        ranks.share_sums(&mut contacts.blocks);
        contacts.add_up();
        let stored = contacts.sums.stored;
        let history = self.snapshot_history();
        self.evaluate_forces(0.0);
        self.restore_history(history);
        self.evaluate_stream_at_rest();
        self.second_half_step(0.0, false);
        self.contacts.sums.stored = stored;
        self.integration.bodies.show(&mut self.grains);
        self.reactions.sum_wall_loads(&self.contacts);
        self.faces.measure(&mut self.walls);
        for (wall, load) in self.walls.iter_mut().zip(&self.reactions.wall_loads) {
            wall.start(load.force, load.torque);
        }
        self.books.last = self.powers();
    }

    /// The contacts, the ranks, and what forces are computed from.
    fn contacts_and_input(&mut self) -> (&mut ContactForces, &mut Ranks, ForceInput<'_>) {
        let Self { grains, walls, neighbours, laws, contacts, ranks, immersion, integration, clock, .. } = self;
        let water = immersion.as_ref().map(|immersion| immersion.at(clock.time(), integration.gravity, clock.settling));
        (
            contacts,
            ranks,
            ForceInput {
                grains,
                bodies: &integration.bodies,
                walls,
                neighbours,
                laws,
                dt: clock.dt,
                moment: false,
                completion: 0.0,
                water,
            },
        )
    }

    /// The same to look at.
    pub(super) fn force_input(&self) -> ForceInput<'_> {
        let Self { grains, integration, walls, neighbours, laws, clock, .. } = self;
        ForceInput {
            grains,
            bodies: &integration.bodies,
            walls,
            neighbours,
            laws,
            dt: clock.dt,
            moment: false,
            completion: 0.0,
            water: None,
        }
    }

    /// Shows the contacts of this moment one by one, in the order of blocks, on the first rank; the others tell it theirs.
    pub(super) fn each_contact(&self, mut show: impl FnMut(Contact)) {
        let input = self.force_input();
        self.ranks.tell_first(
            self.neighbours.own(),
            |blocks, message| each_contact(&self.contacts, &input, blocks, |contact| contact.put(message)),
            |message| {
                while !message.is_at_end() {
                    show(Contact::take(message));
                }
            },
        );
    }

    /// The contacts without forces, on all ranks, for those who look at every step.
    pub(super) fn overlaps(&self) -> Vec<Contact> {
        self.of_all_ranks(overlaps(&self.force_input()))
    }

    /// Accelerations from forces and gravity; completes the velocities of a step `dt` (0: leaves them).
    fn second_half_step(&mut self, dt: f64, go_on: bool) {
        let Self { grains, neighbours, contacts, integration, immersion, ranks, clock, .. } = self;
        let power = |contacts: &ContactForces, grains: &Grains| {
            contacts.outside.torque_power(grains) + contacts.bonds.torque_power(grains)
        };
        let predicted = power(contacts, grains);
        let report = integration.second_half(grains, &mut contacts.blocks, neighbours, (dt, go_on), ranks);
        contacts.add_up();
        if let Some(immersion) = immersion {
            immersion.sum_powers(&contacts.blocks);
        }
        contacts.sums.lost.sliding += std::mem::take(&mut contacts.released) / clock.dt;
        if contacts.outside.acts() || !contacts.bonds.is_empty() {
            integration.bodies.show(grains);
        }
        contacts.outside.measure(grains);
        contacts.bonds.measure(grains);
        // Torques from outside and of bonds are in the correction too, but no loss of contacts.
        let turned = 2.0 / 3.0 * (power(contacts, grains) - predicted);
        contacts.sums.lost.correct(report.correction + turned);
        (self.reactions.on_fixed, self.reactions.driven_power) = (report.fixed_force, report.driven_power);
    }

    /// What grains did to the walls goes to those who move them.
    fn apply_reactions(&mut self, hosts: &mut Hosts, ledger: &mut Ledger) {
        let Self { walls, faces, contacts, reactions, clock, .. } = self;
        reactions.sum_wall_loads(contacts);
        if clock.settling {
            return;
        }
        faces.measure(walls);
        for (wall, load) in walls.iter_mut().zip(&reactions.wall_loads) {
            if let Some((host, interface)) = wall.host() {
                hosts.list[host].hear(interface, load.force, load.torque, wall.pose.origin());
            }
            let exchange = wall.after(load.force, load.torque, clock.dt);
            ledger.post(Account::ForceWork, exchange.work);
            ledger.post(Account::HostDamping, exchange.lost);
        }
    }

    fn check_finite(&self) -> Result<(), Fault> {
        let piece = piece(self.grains.len());
        let bad = |column: &[DVec3]| column.par_iter().with_min_len(piece).position_first(|p| !p.is_finite());
        // Of grains of other ranks the positions alone are known, and where a velocity is no number a position is none any more.
        let columns = [("position", &self.grains.position), ("velocity", &self.grains.velocity)];
        for (what, column) in columns.into_iter().take(if self.ranks.is_alone() { 2 } else { 1 }) {
            if let Some(i) = bad(column) {
                return Err(Fault::NotFinite {
                    step: self.clock.step,
                    time: self.clock.time(),
                    grain: self.grains.id[i] as usize,
                    what,
                });
            }
        }
        Ok(())
    }

    /// Whether an overlap may be beyond the limit.
    fn is_deep(&self, overlap: f64) -> bool {
        overlap > self.limits.largest_overlap * self.limits.smallest_diameter.min(self.integration.bodies.finest())
    }

    /// The deepest contact of the blocks of this rank, where it may be beyond the limit.
    fn deepest_beyond_limit(&self) -> Option<Contact> {
        let blocks = &self.contacts.blocks[self.neighbours.own()];
        if !blocks.iter().any(|block| self.is_deep(block.sums.deepest)) {
            return None;
        }
        let mut own = Vec::new();
        each_contact(&self.contacts, &self.force_input(), self.neighbours.own(), |contact| own.push(contact));
        self.deepest(own)
    }

    /// The deepest of these contacts, by overlap over diameter.
    fn deepest(&self, contacts: Vec<Contact>) -> Option<Contact> {
        let ratio = |contact: &Contact| self.overlap_ratio(contact);
        contacts.into_iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
    }

    /// Ends the run where the deepest contact of any rank is beyond the limit; each brings its own.
    fn check_overlap(&self, deepest: Option<Contact>) -> Result<(), Fault> {
        if !self.is_deep(self.contacts.sums.deepest) {
            return Ok(());
        }
        let all = self.of_all_ranks(deepest.into_iter().collect());
        let Some(contact) = self.deepest(all) else { return Ok(()) };
        let ratio = self.overlap_ratio(&contact);
        let limit = self.limits.largest_overlap;
        if ratio <= limit {
            return Ok(());
        }
        let held = |i: usize| self.grains.inverse_mass[i] == 0.0;
        let driven =
            |wall: &Wall| matches!(wall.mover, Mover::Motion(..) | Mover::Steered(_)) || wall.turning.is_some();
        let second = contact.second;
        let rounded = |i: usize| self.integration.bodies.rounding(i).is_some();
        Err(Fault::Overlap {
            step: self.clock.step,
            time: self.clock.time(),
            grain: self.grains.id[contact.first] as usize,
            other: self.named(&contact),
            ratio,
            of: if rounded(contact.first) || !contact.wall && rounded(second) {
                "twice the radius of its rounded edges"
            } else {
                "its diameter"
            },
            limit,
            crushed: held(contact.first) || if contact.wall { driven(&self.walls[second]) } else { held(second) },
        })
    }
}
