//! A run on several ranks: rank 0 makes it, and tells the others what its engine is asked for, so that theirs do the same.

use super::start::Start;
use super::{RunError, stages};
use crate::engine::{Engine, Fault, Note, OpenError};
use crate::interrupt::Interrupt;
use crate::ledger::{Energies, Ledger};
use crate::partner::Hosts;
use crate::ranks::{Communicator, Reader};
use crate::view::{Contacts, View, Wants};
use crate::wall::Wall;
use std::any::Any;
use std::sync::Arc;
use tsubu_frame::state::{MissingSection, Section};
use tsubu_frame::{Frame, State};
use tsubu_scene::{Plan, Scene};

macro_rules! orders {
    ($($order:ident)*) => {
        /// What all engines do together.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Order {
            $($order),*
        }

        /// Each at the place of its number.
        const ORDERS: &[Order] = &[$(Order::$order),*];
    };
}
orders! { Advance AdvanceUnseen Change GrainFrame ContactFrame Places Forces Save Load End }

/// The engine of rank 0.
pub(super) struct Leader {
    engine: Box<dyn Engine>,
    communicator: Arc<dyn Communicator>,
}

impl Leader {
    /// An engine that is one of several, or the same alone.
    pub fn of(engine: Box<dyn Engine>, communicator: Option<Arc<dyn Communicator>>) -> Box<dyn Engine> {
        match communicator {
            Some(communicator) => Box::new(Self { engine, communicator }),
            None => engine,
        }
    }

    fn tell(&self, order: Order, more: impl IntoIterator<Item = f64>) {
        let mut message = vec![f64::from(order as u8)];
        message.extend(more);
        self.communicator.broadcast(&mut message);
    }
}

impl Drop for Leader {
    fn drop(&mut self) {
        // In a panic the others may be anywhere; whoever started them ends them.
        if !std::thread::panicking() {
            self.tell(Order::End, None);
        }
    }
}

/// Makes the run of a scene on a rank that is not the first, as long as that wishes. Whoever asks it to stop is to ask the first.
pub fn follow(scene: &Scene, communicator: &Arc<dyn Communicator>, interrupt: &Interrupt) -> Result<(), RunError> {
    let _held = interrupt.hold();
    let Start { mut engine, mut hosts, .. } = Start::of(scene, Some(communicator))?;
    let (mut ledger, mut stage) = (Ledger::default(), 0);
    loop {
        let mut message = Vec::new();
        communicator.broadcast(&mut message);
        let mut message = Reader::new(&message);
        match ORDERS.get(message.number() as usize).copied().unwrap_or(Order::End) {
            // What went wrong went wrong on all ranks: the first tells it, and ends the run.
            Order::Advance => _ = engine.advance(message.number() as u64, &mut hosts, &mut ledger),
            Order::AdvanceUnseen => _ = engine.advance_unseen(message.number() as u64, &mut hosts, &mut ledger),
            Order::Change => {
                let plans = scene.plans();
                _ = stages::change(&mut *engine, &mut hosts, [&plans[stage], &plans[stage + 1]]);
                stage += 1;
            }
            Order::GrainFrame => _ = engine.grain_frame(&hosts),
            Order::ContactFrame => _ = engine.contact_frame(),
            Order::Places => _ = engine.view(Wants::TOUCHES),
            Order::Forces => _ = engine.view(Wants::CONTACTS),
            Order::Save => engine.save(&mut State::default()),
            Order::Load => {
                let mut state = receive_state(message.number() as usize, communicator);
                engine.load(&mut state)?;
                hosts.load(&state)?;
            }
            Order::End => return Ok(()),
        }
    }
}

impl Engine for Leader {
    fn notes(&self) -> &[Note] {
        self.engine.notes()
    }

    fn time_step(&self) -> f64 {
        self.engine.time_step()
    }

    fn step_key(&self) -> &str {
        self.engine.step_key()
    }

    fn steps(&self) -> u64 {
        self.engine.steps()
    }

    fn stage_begin(&self) -> (u64, f64) {
        self.engine.stage_begin()
    }

    fn change(&mut self, plans: [&Plan; 2], hosts: &Hosts) -> Result<(), OpenError> {
        self.tell(Order::Change, None);
        self.engine.change(plans, hosts)
    }

    fn grains(&self) -> usize {
        self.engine.grains()
    }

    fn traffic(&self) -> Vec<(String, u64)> {
        self.engine.traffic()
    }

    fn grain_steps(&self) -> u64 {
        self.engine.grain_steps()
    }

    fn worked(&self) -> &[f64] {
        self.engine.worked()
    }

    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        self.tell(Order::Advance, [steps as f64]);
        self.engine.advance(steps, hosts, ledger)
    }

    fn advance_unseen(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        self.tell(Order::AdvanceUnseen, [steps as f64]);
        self.engine.advance_unseen(steps, hosts, ledger)
    }

    fn grain_energies(&self) -> Energies {
        self.engine.grain_energies()
    }

    fn momentum(&self) -> [f64; 3] {
        self.engine.momentum()
    }

    fn centre_of_mass(&self) -> [f64; 3] {
        self.engine.centre_of_mass()
    }

    fn contacts(&self) -> usize {
        self.engine.contacts()
    }

    fn grain_frame(&self, hosts: &Hosts) -> Frame {
        self.tell(Order::GrainFrame, None);
        self.engine.grain_frame(hosts)
    }

    fn contact_frame(&self) -> Frame {
        self.tell(Order::ContactFrame, None);
        self.engine.contact_frame()
    }

    fn offers(&self) -> Wants {
        self.engine.offers()
    }

    fn view(&self, wants: Wants) -> View<'_> {
        match wants.contacts {
            Contacts::Nothing => {}
            Contacts::Places => self.tell(Order::Places, None),
            Contacts::Forces => self.tell(Order::Forces, None),
        }
        self.engine.view(wants)
    }

    fn walls(&self) -> &[Wall] {
        self.engine.walls()
    }

    fn renew(&mut self, column: &str) -> Option<Box<dyn Any + Send + Sync>> {
        self.engine.renew(column)
    }

    fn save<'a>(&'a self, state: &mut State<'a>) {
        self.tell(Order::Save, None);
        self.engine.save(state);
    }

    fn load(&mut self, state: &mut State) -> Result<(), MissingSection> {
        self.tell(Order::Load, [state.sections().count() as f64]);
        // One by one: all in one message would be in memory twice, on every rank.
        for (name, section) in state.sections() {
            self.communicator.broadcast(&mut written(name, section));
        }
        self.engine.load(state)
    }
}

/// A section of a state as numbers.
fn written(name: &str, section: &Section) -> Vec<f64> {
    let mut message = Vec::new();
    let text = |message: &mut Vec<f64>, text: &str| {
        message.push(text.len() as f64);
        message.extend(text.bytes().map(f64::from));
    };
    text(&mut message, name);
    match section {
        Section::Real(values) => {
            message.push(0.0);
            message.extend(values.iter());
        }
        Section::Integer(_) | Section::Index(_) => {
            message.push(1.0);
            message.extend(section.integers().map(|value| f64::from_bits(value as u64)));
        }
        Section::Text(value) => {
            message.push(2.0);
            message.extend(value.bytes().map(f64::from));
        }
    }
    message
}

/// The section that was written, with its name.
fn read(message: &[f64]) -> (String, Section<'static>) {
    let text = |bytes: &[f64]| {
        let bytes: Vec<u8> = bytes.iter().map(|byte| *byte as u8).collect();
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let mut message = Reader::new(message);
    let length = message.number() as usize;
    let name = text(message.numbers(length));
    let kind = message.number();
    let values = message.numbers(usize::MAX);
    let section = match kind {
        0.0 => Section::Real(values.to_vec().into()),
        1.0 => Section::Integer(values.iter().map(|value| value.to_bits() as i64).collect()),
        _ => Section::Text(text(values)),
    };
    (name, section)
}

/// The state that the first rank tells, with so many sections.
fn receive_state(sections: usize, communicator: &Arc<dyn Communicator>) -> State<'static> {
    let (mut state, mut message) = (State::default(), Vec::new());
    for _ in 0..sections {
        communicator.broadcast(&mut message);
        let (name, section) = read(&message);
        state.insert(name, section);
    }
    state
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_goes_over_to_the_last_bit() {
        let mut state = State::default();
        state.put_real("real", vec![0.1, f64::NAN, -0.0]);
        state.put_integer("integer", vec![i64::MIN, -1, 0, i64::MAX]);
        state.put_index("index", vec![0, u32::MAX]);
        state.put_text("text", "粒");
        state.put_text("", "");
        let mut back = State::default();
        for (name, section) in state.sections() {
            let (name, section) = read(&written(name, section));
            back.insert(name, section);
        }
        assert_eq!(back.hash(), state.hash());
    }
}
