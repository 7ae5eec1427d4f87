//! One run on several ranks: the bits of one.
//!
//! The ranks of these tests are threads that talk through channels. What goes over MPI is in `crates/tsubu-mpi/tests`.

mod patient;
mod shapes;
mod traps;

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::ranks::Communicator;
use tsubu::view::Wants;
use tsubu_frame::State;
use tsubu_scene::Scene;

/// A rank that is a thread.
#[derive(Debug)]
struct Thread {
    rank: usize,
    to: Vec<Sender<Vec<f64>>>,
    from: Vec<Mutex<Receiver<Vec<f64>>>>,
    sent: AtomicUsize,
    /// How many messages have gone to others, and how many numbers.
    told: Arc<[AtomicUsize; 2]>,
    /// In which exchanges numbers go over wrong by their last bit.
    wrong: Range<usize>,
}

impl Thread {
    fn team(size: usize) -> Vec<Self> {
        let counted = || AtomicUsize::new(0);
        let mut team: Vec<Self> = (0..size)
            .map(|rank| Self {
                rank,
                to: Vec::new(),
                from: Vec::new(),
                sent: counted(),
                told: Arc::new([counted(), counted()]),
                wrong: 0..0,
            })
            .collect();
        for sender in 0..size {
            for receiver in 0..size {
                let (to, from) = channel();
                team[sender].to.push(to);
                team[receiver].from.push(Mutex::new(from));
            }
        }
        team
    }

    fn receive(&self, rank: usize) -> Vec<f64> {
        let from = self.from[rank].lock().unwrap();
        from.recv_timeout(Duration::from_mins(1)).expect("every rank sends")
    }
}

impl Communicator for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.to.len()
    }

    fn exchange_while(&self, messages: &mut [Vec<f64>], partners: &[usize], work: &mut dyn FnMut() -> bool) {
        if self.wrong.contains(&self.sent.fetch_add(1, Ordering::Relaxed)) {
            // What counts or names something stays.
            let numbers = messages.iter_mut().flatten().filter(|number| number.fract() != 0.0);
            numbers.for_each(|number| *number = f64::from_bits(number.to_bits() ^ 1));
        }
        for &rank in partners {
            self.told[0].fetch_add(1, Ordering::Relaxed);
            self.told[1].fetch_add(messages[rank].len(), Ordering::Relaxed);
            self.to[rank].send(std::mem::take(&mut messages[rank])).unwrap();
        }
        while work() {}
        for &rank in partners {
            messages[rank] = self.receive(rank);
        }
    }

    fn broadcast(&self, message: &mut Vec<f64>) {
        if self.rank == 0 {
            self.to[1..].iter().for_each(|to| to.send(message.clone()).unwrap());
        } else {
            *message = self.receive(0);
        }
    }
}

/// A scene on ranks and threads: hash of all there is after so many steps, and what `look` makes of it, both of rank 0.
struct Job<'a> {
    text: &'a str,
    folder: &'a std::path::Path,
    steps: &'a [u64],
    resume: bool,
}

impl Job<'_> {
    fn opened(&self, communicator: Option<&Arc<dyn Communicator>>) -> (Box<dyn Engine>, Hosts, Ledger) {
        let scene = Scene::parse("test", self.text, self.folder, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let hosts = Hosts::new(&scene.plan().hosts);
        let engine = methods::open_on_ranks(scene.plan(), &hosts, communicator.cloned()).unwrap();
        let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
        (engine, hosts, ledger)
    }

    /// Hash of the state, which the first rank has, and of the grains, which all have; goes on from what is `saved`, which goes from the first to
    /// the others.
    fn go(&self, communicator: Option<&Arc<dyn Communicator>>, saved: &Mutex<State>) -> [String; 2] {
        let state = |engine: &dyn Engine, hosts: &Hosts, ledger: &Ledger| {
            let mut state = State::default();
            engine.save(&mut state);
            hosts.save(&mut state);
            ledger.save(&mut state);
            state.into_owned()
        };
        let load = |saved: &State| {
            let (mut engine, mut hosts, _) = self.opened(communicator);
            engine.load(&mut saved.clone()).unwrap();
            hosts.load(saved).unwrap();
            (engine, hosts, Ledger::load(saved).unwrap())
        };
        let begin = saved.lock().unwrap().clone();
        let begun = begin.integer("dem.step").is_ok();
        let (mut engine, mut hosts, mut ledger) = if begun { load(&begin) } else { self.opened(communicator) };
        let first = engine.frame(&hosts);
        for &steps in self.steps {
            // Ranks go a part of the way unseen.
            let unseen = if communicator.is_some() { steps / 3 } else { 0 };
            engine.advance_unseen(unseen, &mut hosts, &mut ledger).unwrap();
            engine.advance_unseen(unseen, &mut hosts, &mut ledger).unwrap();
            engine.advance(steps - 2 * unseen, &mut hosts, &mut ledger).unwrap();
            if self.resume {
                let written = state(&*engine, &hosts, &ledger);
                if communicator.is_none_or(|all| all.rank() == 0) {
                    *saved.lock().unwrap() = written;
                }
                if let Some(all) = communicator {
                    all.broadcast(&mut Vec::new());
                }
                let saved = saved.lock().unwrap().clone();
                (engine, hosts, ledger) = load(&saved);
            }
        }
        let frame = engine.frame(&hosts);
        let mut state = state(&*engine, &hosts, &ledger);
        // What is shown must be the same as well.
        state.put_text("frame", format!("{:?}{:?}", first.columns, frame.columns));
        let mut grains = State::default();
        grains.put_text("grains", format!("{:?}", engine.view(Wants::default()).grains));
        grains.put_text("energies", format!("{:?}", engine::energies(&*engine, &hosts)));
        [state.hash(), grains.hash()]
    }

    fn on(&self, ranks: usize, threads: usize) -> String {
        self.with(Thread::team(ranks), threads).unwrap()
    }

    /// On a team of ranks; `None`: they do not have the same grains.
    fn with(&self, team: Vec<Thread>, threads: usize) -> Option<String> {
        self.from(&Mutex::new(State::default()), team, threads)
    }

    /// The same from what is `saved` on.
    fn from(&self, saved: &Mutex<State>, team: Vec<Thread>, threads: usize) -> Option<String> {
        let work = |communicator: Option<&Arc<dyn Communicator>>| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| self.go(communicator, saved))
        };
        if team.len() == 1 {
            let [state, _] = work(None);
            return Some(state);
        }
        std::thread::scope(|scope| {
            let ranks: Vec<_> = team
                .into_iter()
                .map(|one| scope.spawn(|| work(Some(&(Arc::new(one) as Arc<dyn Communicator>)))))
                .collect();
            let mut hashes: Vec<[String; 2]> = ranks.into_iter().map(|rank| rank.join().unwrap()).collect();
            let [state, grains] = hashes.remove(0);
            hashes.iter().all(|[_, other]| *other == grains).then_some(state)
        })
    }

    /// Holds the bits of one rank against those of several.
    fn same(&self, ranks: &[usize]) {
        let one = self.on(1, 1);
        for &ranks in ranks {
            assert_eq!(one, self.on(ranks, 1), "{ranks} ranks");
        }
        assert_eq!(one, self.on(2, 2), "2 ranks of 2 threads");
    }

    /// Hash of what is saved at the end, where each part of the steps is made on so many ranks.
    fn in_turn(&self, ranks: &[usize]) -> String {
        let saved = Mutex::new(State::default());
        for (steps, &ranks) in self.steps.chunks(1).zip(ranks) {
            let part = Job { steps, resume: true, ..*self };
            part.from(&saved, Thread::team(ranks), 1).expect("all ranks have the same grains");
        }
        saved.into_inner().unwrap().hash()
    }

    /// Holds the bits of one rank against those of any number of one and two threads, and of a run that goes on on others.
    fn same_on_any(&self) {
        let one = self.on(1, 1);
        for ranks in [1, 2, 3, 4, 7] {
            for threads in [1, 2] {
                assert_eq!(one, self.on(ranks, threads), "{ranks} ranks of {threads} threads");
            }
        }
        assert_eq!(self.in_turn(&[1; 3]), self.in_turn(&[3, 7, 2]), "3, 7 and 2 ranks in turn");
    }
}

fn job(text: &str) -> Job<'_> {
    Job { text, folder: std::path::Path::new("."), steps: &[350, 1, 300], resume: false }
}

/// 2,500 balls in a box that shakes on a spring, with friction springs, spin and rolling friction.
const DAMPER: &str = r#"
gravity = 10
duration = "1 s"
[materials.glass]
young-modulus = "10 MPa"
restitution = 0.6
friction = 0.5
rolling-friction = 0.05
[particles.balls]
material = "glass"
count = 2500
diameter = "2 mm"
mass = "0.01 g"
start.rows = { spacing = 1.02, jitter = 0.8, speed = 0.3 }
[walls.box]
material = "glass"
host = "spring"
shape.box = { width = "110 mm", height = "200 mm" }
[hosts.spring]
direction = "z"
structure.oscillator = { mass = "86 g", stiffness = "1234 N/m", damping = "0.08 N s/m" }
base.sine = { amplitude = "2 mm", frequency = "18 Hz" }
[contact]
rolling.constant = {}
[dem]
time-step = "2e-5 s"
"#;

#[test]
fn a_damper_has_the_bits_of_one_rank() {
    job(DAMPER).same(&[2, 3, 7]);
    Job { resume: true, ..job(DAMPER) }.same(&[3]);
}

/// A step at whose end nobody looks sends what is estimated on one rank, and a number that tells how long a rank has worked; one that makes lists anew sends
/// positions to all, and what else grains have to one other rank at most: how many move hangs on how fast the ranks were.
#[test]
fn what_goes_over_is_what_is_estimated() {
    let ranks = 3;
    let others = ranks as f64 - 1.0;
    let step = |scene: &str| {
        let job = job(scene);
        let (engine, ..) = job.opened(None);
        let share = engine.on_ranks(ranks).unwrap();
        let team = Thread::team(ranks);
        let sent: Vec<_> = team.iter().map(|one| one.told.clone()).collect();
        std::thread::scope(|scope| {
            for one in team {
                scope.spawn(|| {
                    let (told, all) = (one.told.clone(), Arc::new(one) as Arc<dyn Communicator>);
                    let (mut engine, mut hosts, mut ledger) = job.opened(Some(&all));
                    engine.advance_unseen(1, &mut hosts, &mut ledger).unwrap();
                    told.iter().for_each(|count| count.store(0, Ordering::Relaxed));
                    engine.advance_unseen(1, &mut hosts, &mut ledger).unwrap();
                });
            }
        });
        let told = |what: usize| sent.iter().map(move |told| told[what].load(Ordering::Relaxed));
        (share, told(0).max().unwrap(), told(1).map(|numbers| 8.0 * numbers as f64).collect::<Vec<_>>())
    };
    let (share, messages, sent) = step(DAMPER);
    let most = sent.iter().fold(0.0_f64, |a, b| a.max(*b));
    let told = share.bytes + 8.0 * others;
    assert!(most <= told && most > 0.95 * told, "{most} of {told} bytes");
    assert_eq!(messages, share.messages);
    let anew = step(&DAMPER.replace("[dem]", "[dem]\nskin = 1e-9")).2;
    let anew = anew.iter().sum::<f64>() - sent.iter().sum::<f64>();
    let [positions, others_once] = [8.0 * 3.0 * 2500.0 * others, 8.0 * 12.0 * 2500.0];
    // With so thin a skin fewer grains are seen across the cuts.
    assert!(anew > 0.8 * positions && anew < 1.2 * positions + others_once, "{anew} bytes where lists are made anew");
    assert!(share.bytes_anew > positions / ranks as f64 && share.bytes_anew < 1.4 * positions / ranks as f64);
}

/// Of some thousand exchanges some are wrong by the last bit: the bits are others. Few alone may be those of new lists, in which nothing goes over, or of grains that fly.
#[test]
fn a_last_bit_that_goes_over_wrong_is_seen() {
    let mut team = Thread::team(2);
    team[1].wrong = 400..480;
    let job = job(DAMPER);
    assert_ne!(job.with(team, 1), Some(job.on(1, 1)));
}

/// Grains flow down a rough periodic slope; some come, some go, a gate opens, and a row is driven.
const FLOW: &str = r#"
dimension = 3
gravity = [5, 0, -9]
duration = "1 s"
speed-scale = "1 m/s"
[materials.glass]
young-modulus = "2 MPa"
restitution = 0.6
friction = 0.5
density = "2500 kg/m^3"
[periodic]
x = ["0 mm", "48 mm"]
y = ["0 mm", "24 mm"]
[particles.a-base]
material = "glass"
count = 288
diameter = "2 mm"
motion.frozen = {}
start.rows = { spacing = 1.0, jitter = 0, region = { low = [0, 0, 0], high = ["48 mm", "24 mm", "2 mm"] } }
[particles.b-flow]
material = "glass"
count = 1800
size.uniform = { smallest = "1.8 mm", largest = "2.2 mm" }
start.rows = { spacing = 1.01, jitter = 1, speed = 0.5, region = { low = [0, 0, "2.2 mm"], high = ["48 mm", "24 mm", "40 mm"] } }
[particles.c-row]
material = "glass"
count = 8
diameter = "2 mm"
motion.driven = { direction = "y", signal.sine = { amplitude = "1 mm", frequency = "60 Hz" } }
start.rows = { spacing = 1.0, jitter = 0, region = { low = ["10 mm", "12 mm", "42 mm"], high = ["40 mm", "14 mm", "44 mm"] } }
[particles.d-rain]
material = "glass"
count = 500
diameter = "2 mm"
start.stream = { region = { low = [0, 0, "50 mm"], high = ["48 mm", "24 mm", "56 mm"] }, rate = "30000 1/s", velocity = [0, 0, -0.5] }
[walls.gate]
material = "glass"
shape.sphere = { centre = ["24 mm", "12 mm", "20 mm"], radius = "5 mm" }
until = "5 ms"
[removal.side.inside]
region = { low = ["40 mm", 0, "5 mm"], high = ["48 mm", "8 mm", "20 mm"] }
[contact]
tangential.mindlin = {}
[dem]
time-step = "2e-5 s"
"#;

#[test]
fn a_flow_has_the_bits_of_one_rank() {
    job(FLOW).same(&[2, 4]);
}

/// A stream of water in layers takes from the grains what they take from it.
const STREAM: &str = r#"
[water]
density = "1000 kg/m^3"
viscosity = "1e-6 m^2/s"
drag.stokes-newton = {}
flow.coupled = { bottom = 0, top = "40 mm", shear-velocity = "0.2 m/s" }
fluctuation.strength = 0.5
"#;

#[test]
fn a_stream_has_the_bits_of_one_rank() {
    job(&format!("{FLOW}{STREAM}")).same(&[2, 3]);
}

#[test]
fn a_flow_goes_on_as_on_one_rank() {
    Job { resume: true, ..job(FLOW) }.same(&[3]);
}
