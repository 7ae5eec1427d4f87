//! Methods with grains on sites, from their scenes: books, resume, gates, refusals.

use tsubu::engine::{self, Engine, OpenError};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::State;
use tsubu_scene::plan::{Method, Plan};
use tsubu_scene::{Scene, plan};

const SCENES: [(&str, u64); 8] = [
    (include_str!("../../../../scenes/voids.toml"), 60),
    (include_str!("../../../../scenes/sorting-chute.toml"), 60),
    (include_str!("../../../../scenes/lattice-grains.toml"), 400),
    (include_str!("../../../../scenes/pile-forces.toml"), 15),
    (include_str!("../../../../scenes/gas-channel.toml"), 40),
    (include_str!("../../../../scenes/gas-pipe.toml"), 200),
    (include_str!("../../../../scenes/elongated-hopper.toml"), 100),
    (include_str!("../../../../scenes/poured-silo.toml"), 2000),
];

pub(super) fn plan(text: &str) -> Plan {
    let scene = Scene::parse("test", text, std::path::Path::new("."), &[]).map_err(|c| c.to_string()).unwrap();
    scene.plan().clone()
}

pub(super) struct Run {
    pub engine: Box<dyn Engine>,
    hosts: Hosts,
    pub ledger: Ledger,
}

impl Run {
    pub fn new(plan: &Plan) -> Self {
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open(plan, &hosts).unwrap();
        let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
        Self { engine, hosts, ledger }
    }

    pub fn steps(&mut self, count: u64) {
        self.engine.advance(count, &mut self.hosts, &mut self.ledger).unwrap();
    }

    pub fn state(&self) -> State<'static> {
        let mut state = State::default();
        self.engine.save(&mut state);
        state.into_owned()
    }
}

/// A run that is broken off and taken up again ends with the same bits, and the books close.
#[test]
fn sites_resume_with_the_same_bits() {
    for (text, steps) in SCENES {
        let mut plan = plan(text);
        let methods = if plan.method == Method::AfterCaramHong {
            vec![Method::AfterCaramHong, Method::Litwiniszyn]
        } else {
            vec![plan.method]
        };
        for method in methods {
            plan.method = method;
            let mut whole = Run::new(&plan);
            whole.steps(steps);
            let half = whole.state();
            let begun = half.hash();
            whole.steps(steps);
            let mut again = Run::new(&plan);
            again.engine.load(&mut half.clone()).unwrap();
            assert_eq!(again.state().hash(), begun, "{}", method.name());
            again.steps(steps);
            assert_eq!(again.state().hash(), whole.state().hash(), "{}", method.name());
            assert_ne!(whole.state().hash(), begun, "{}: nothing happened", method.name());
            let residual = whole.ledger.residual_relative(&engine::energies(&*whole.engine, &whole.hosts));
            assert!(residual.abs() < 1e-9, "{}: {residual}", method.name());
        }
    }
}

/// A wall that vanishes lets the grains behind it go, and not before.
#[test]
fn gates_open_on_sites() {
    let text = r#"
        title = "a bed behind a gate"
        method = "after-caram-hong"
        duration = 1
        [materials.sand]
        young-modulus = 1e7
        [particles.sand]
        material = "sand"
        diameter = 1e-3
        mass = 1e-6
        count = 60
        start.rows.region = { low = [0, 0], high = [0.01, 0.02] }
        [walls.box]
        material = "sand"
        shape.box = { width = 0.08, height = 0.02, floor-centre = [0.03, 0] }
        [walls.back]
        material = "sand"
        shape.plane = { point = [0, 0], normal = "x" }
        [walls.gate]
        material = "sand"
        shape.plane = { point = [0.01, 0], normal = "-x" }
        until = 0.2
    "#;
    let plan = plan(text);
    let mut run = Run::new(&plan);
    let front = |run: &Run| {
        let frame = run.engine.frame(&run.hosts);
        match &frame.column(tsubu_frame::Kind::Grain, "position").unwrap().values {
            tsubu_frame::Values::Vector(p) => p.iter().map(|p| p[0]).fold(0.0, f64::max),
            _ => f64::NAN,
        }
    };
    let step = run.engine.time_step();
    run.steps((0.19 / step) as u64);
    assert!(front(&run) < 0.01, "{}", front(&run));
    run.steps((0.4 / step) as u64);
    assert!(front(&run) > 0.0105, "{}", front(&run));
}

/// A wall that stood where grains are removed leaves an outlet, not an empty site: a bed over it runs out. Grains that fill what
/// they find would stop one row lower.
#[test]
fn an_outlet_below_a_gate_opens_with_it() {
    for method in ["litwiniszyn", "after-caram-hong", "after-savage", "gutt-haff"] {
        let text = format!(
            r#"
            title = "a bed on a trap door"
            method = "{method}"
            duration = 1
            [materials.sand]
            young-modulus = 1e7
            restitution = 0.5
            [particles.sand]
            material = "sand"
            diameter = 1e-3
            mass = 1e-6
            count = 60
            start.rows.region = {{ low = [0, 2e-3], high = [0.01, 0.02] }}
            [walls.box]
            material = "sand"
            shape.box = {{ width = 0.01, height = 0.02, floor-centre = [0.005, 0] }}
            [walls.door]
            material = "sand"
            shape.plane.point = [0, 2e-3]
            until = 0.05
            [removal.below.inside]
            region = {{ low = [0, 0], high = [0.01, 2.4e-3] }}
            "#
        );
        let mut run = Run::new(&plan(&text));
        let step = run.engine.time_step();
        run.steps((0.04 / step) as u64);
        assert_eq!(run.engine.grains(), 60, "{method}");
        let mut again = Run::new(&plan(&text));
        run.steps((0.03 / step) as u64);
        again.engine.load(&mut run.state()).unwrap();
        for run in [&mut run, &mut again] {
            run.steps((0.6 / step) as u64);
            assert!(run.engine.grains() < 10, "{method}: {} grains are left", run.engine.grains());
        }
        assert_eq!(run.state().hash(), again.state().hash(), "{method}");
    }
}

pub(super) fn refused(change: impl Fn(&mut Plan), text: &str) -> String {
    let mut plan = plan(text);
    change(&mut plan);
    match methods::open(&plan, &Hosts::new(&plan.hosts)) {
        Err(OpenError::Refused(refusal)) => refusal.to_string(),
        Err(other) => other.to_string(),
        Ok(_) => "not refused".to_owned(),
    }
}

/// What sites cannot do is refused by name, with what to do.
#[test]
fn sites_refuse_what_they_cannot_do() {
    let text = SCENES[0].0;
    let space = refused(|p| p.dimension = 3, text);
    assert!(space.contains("dimension") && space.contains("`method = \"dem\"`"), "{space}");
    let tilted = refused(|p| p.gravity = [1.0, 0.0, -9.0], text);
    assert!(tilted.contains("gravity") && tilted.contains("along -z"), "{tilted}");
    let many = refused(|p| p.particles.get_mut("sand").unwrap().count = 1_000_000, text);
    assert!(many.contains("particles.sand.start.rows") && many.contains("free sites"), "{many}");
    let moving = refused(
        |p| {
            let signal = plan::Signal::Steady { rate: 1.0 };
            p.walls.get_mut("silo").unwrap().motion = Some(plan::Motion { direction: [1.0, 0.0, 0.0], signal });
        },
        text,
    );
    assert!(moving.contains("walls.silo.motion") && moving.contains("stand still"), "{moving}");
    let repeated = refused(|p| p.periodic.x = Some([-0.12, 0.12]), text);
    assert!(repeated.contains("periodic") && repeated.contains("after-savage"), "{repeated}");
}

/// The scene that shows voids by two methods: between its grains and the plane below which they are gone lies a row of empty
/// sites, and every void of Litwiniszyn's ended there. Not one grain left, and nobody said so.
#[test]
fn voids_cross_a_gap_between_outlet_and_bed() {
    let mut plan = plan(SCENES[0].0);
    for method in [Method::AfterCaramHong, Method::Litwiniszyn] {
        plan.method = method;
        let mut run = Run::new(&plan);
        run.steps(400);
        assert!(run.engine.grains() < 3700, "{}: {} grains are left", method.name(), run.engine.grains());
        assert!(run.engine.notes().iter().all(|note| note.key != "removal.below"), "{:?}", run.engine.notes());
    }
}

/// An outlet that no grain can come to was passed over in silence: grains stayed for ever.
#[test]
fn an_outlet_without_sites_or_without_a_way_is_said() {
    let voids = SCENES[0].0;
    // A way over the rim of the silo is one.
    let lid = "[walls.lid]\nmaterial = \"sand\"\nshape.plane = { point = [0, \"401 mm\"], normal = \"-z\" }\n[removal";
    let closed = voids.replace("length = \"106 mm\"", "length = \"240 mm\"").replacen("[removal", lid, 1);
    let thin = voids.replace(
        "[removal.below.behind]\npoint = [0, \"-1 mm\"]\nnormal = \"z\"",
        "[removal.below.inside]\nregion = { low = [\"-9 mm\", \"-1.2 mm\"], high = [\"9 mm\", \"-1.1 mm\"] }",
    );
    assert!(closed != voids && thin != voids);
    for method in ["after-caram-hong", "litwiniszyn", "after-savage", "gutt-haff", "fhp", "after-karolyi-kertesz"] {
        let note = |text: &str| {
            let text = text
                .replace("count = 4000", "count = 1000")
                .replace("method = \"after-caram-hong\"", &format!("method = \"{method}\""));
            let (text, _) = text.split_once("[watch").unwrap();
            let run = Run::new(&plan(text));
            let note = run.engine.notes().iter().find(|note| note.key == "removal.below");
            note.map(|note| note.text.clone())
        };
        assert_eq!(note(voids), None, "{method}");
        let (closed, thin) = (note(&closed).unwrap_or_default(), note(&thin).unwrap_or_default());
        assert!(closed.contains("walls stand between"), "{method}: {closed}");
        assert!(thin.contains("it holds no site"), "{method}: {thin}");
    }
}
