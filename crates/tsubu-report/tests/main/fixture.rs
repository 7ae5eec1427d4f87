//! Folders as runs leave them, with motion made up from sines.

use std::io::Write as _;
use std::path::Path;

use tsubu_frame::summary::write_json;
use tsubu_frame::whole::write_atomically;
use tsubu_frame::{Cell, Claim, Formats, Frame, FrameWriter, History, Kind, Source, Status, Summary, Table};

const FREQUENCY: f64 = 2.1;

fn host(t: f64) -> f64 {
    0.0041 * (1.0 - (-t).exp()) * (std::f64::consts::TAU * FREQUENCY * t).sin()
}

/// A row of balls hopping in a box that swings sideways.
pub fn frame(t: f64, grains: usize) -> Frame {
    let (radius, wide, high) = (0.003, 0.07, 0.09);
    let across = 10;
    let mut frame = Frame { time: t, step: (t / 2e-5).round() as u64, ..Frame::default() };
    let (mut position, mut velocity) = (Vec::new(), Vec::new());
    for i in 0..grains {
        let (column, row) = ((i % across) as f64, (i / across) as f64);
        let phase = std::f64::consts::TAU * FREQUENCY * t + 0.12 * column + 0.25 * row;
        let lift = 0.02 * (1.0 + 0.3 * row) * phase.sin().max(0.0) * (1.0 - (-t).exp());
        let speed = 0.02 * std::f64::consts::TAU * FREQUENCY * phase.cos() * f64::from(phase.sin() > 0.0);
        position.push([8.0 * host(t) + 0.0065 * (column + 0.5) + 0.002, radius * (1.0 + 2.0 * row) + lift, 0.0]);
        velocity.push([0.0, speed, 0.0]);
    }
    frame.vector(Kind::Grain, "position", "m", position);
    frame.vector(Kind::Grain, "velocity", "m/s", velocity);
    frame.scalar(Kind::Grain, "radius", "m", vec![radius; grains]);
    frame.integer(Kind::Grain, "id", "-", (0..grains as i64).collect());
    let x = 8.0 * host(t);
    let corners = vec![[x, 0.0, 0.0], [x + wide, 0.0, 0.0], [x + wide, high, 0.0], [x, high, 0.0]];
    frame.vector(Kind::Surface, "position", "m", corners);
    frame.integer(Kind::Surface, "outline", "-", vec![0; 4]);
    frame
}

/// The summary of that run.
pub fn summary(method: &str) -> Summary {
    let mut s = Summary {
        tsubu_version: "0.1.0".into(),
        status: Status::Finished,
        method: method.into(),
        dimension: 2,
        particles: 30,
        steps: 250_000,
        time_step: 2e-5,
        simulated_seconds: 5.0,
        wall_seconds: if method == "dem" { 1.93 } else { 0.021 },
        threads: 2,
        particle_steps_per_second: 3.89e6,
        contacts_mean: 41.3,
        state_hash: "9f2c1ab0d4e85f1170ac66d2381b7c55".into(),
        ..Summary::default()
    };
    for (name, joule) in [
        ("kinetic", 0.000_31),
        ("potential", 0.0012),
        ("elastic", 0.000_004),
        ("dissipated by normal damping", 0.0231),
        ("dissipated by sliding", 0.0088),
        ("dissipated by the host", 0.0142),
        ("work of the base", -0.0476),
    ] {
        s.energy.terms.insert(name, joule);
    }
    s.energy.residual_relative = 2.7e-7;
    s.results.insert("rms displacement [m]", 0.002_81);
    s.results.insert("loss factor [-]", 0.0412);
    s.results.insert("lift-off phases [deg]", vec![41.0, 43.5, 40.2]);
    s.claims.push(Claim::judge(
        "peak displacement",
        4.083_61e-3,
        Some(4.08e-3),
        Some(4.09e-3),
        Source::scene("closed form"),
    ));
    s.warnings.push(
        "contact.normal: the overlap reached 1.3 % of a diameter; a stiffer spring would keep it below 1 %".into(),
    );
    s
}

/// A whole run folder.
pub fn run(dir: &Path, method: &str, snapshots: usize) {
    summary(method).write(&dir.join("summary.json")).unwrap();
    let header = [
        "time [s]",
        "host structure displacement [m]",
        "kinetic energy [J]",
        "potential energy [J]",
        "dissipated by normal damping [J]",
        "dissipated by sliding [J]",
        "contacts [-]",
    ];
    let mut history = History::create(&dir.join("history.csv"), &header).unwrap();
    let lag = if method == "dem" { 0.0 } else { 0.004 };
    for i in 0..5000 {
        let t = f64::from(i) * 1e-3;
        let swing = (std::f64::consts::TAU * FREQUENCY * t).sin().powi(2);
        history
            .append(&[
                t,
                host(t - lag),
                4e-4 * swing,
                1.2e-3 + 2e-4 * swing,
                4.6e-3 * t,
                1.7e-3 * t,
                40.0 + 8.0 * swing,
            ])
            .unwrap();
    }
    history.sync().unwrap();
    if snapshots > 0 {
        let mut frames = FrameWriter::create(dir, Formats::default());
        for i in 0..snapshots {
            let t = 5.0 - (snapshots - 1 - i) as f64 / (24.0 * FREQUENCY);
            frames.write(&frame(t, 30)).unwrap();
        }
    }
    text(
        dir,
        "scene.toml",
        "title = \"Swinging box\"\n\n[run]\nduration = \"5 s\"\nmethod = \"dem\" # <script>alert(1)</script>\n\n[[host]]\nname = \"structure\"\nstiffness = \"123.4 N/m\"\n",
    );
    text(
        dir,
        "check.txt",
        "ok   contact time 1.21 ms, 60 steps per contact\nwarn overlap 1.3 % of d: raise contact.normal.stiffness\n",
    );
}

/// A folder of `tsubu response`.
pub fn response(dir: &Path) {
    let mut table = Table::new([
        "frequency [Hz]",
        "frequency ratio [-]",
        "rms displacement [m]",
        "peak displacement [m]",
        "rms spread low [m]",
        "rms spread high [m]",
        "case [text]",
        "method [text]",
    ]);
    let mut cases = Table::new([
        "case [text]",
        "method [text]",
        "particles [-]",
        "peak frequency ratio [-]",
        "peak rms [m]",
        "half-power damping [-]",
        "loss factor [-]",
        "apparent mass [kg]",
        "added-mass limit [-]",
        "wall seconds [s]",
    ]);
    let mut causes = Table::new(["case [text]", "normal damping [J]", "sliding [J]", "host damper [J]", "rolling [J]"]);
    for n in [0_u32, 10, 20, 40] {
        let case = format!("N = {n}");
        let (mass, damping) = (1.0 + 0.002 * f64::from(n), 0.012 + 0.0011 * f64::from(n));
        let mut top = (0.0, 0.0);
        for i in 0..31 {
            let r = 0.7 + 0.02 * f64::from(i);
            let rms = 4e-4 / ((1.0 - mass * r * r).powi(2) + (2.0 * damping * r).powi(2)).sqrt();
            if rms > top.1 {
                top = (r, rms);
            }
            let spread = if n == 0 { 0.0 } else { 0.04 };
            let numbers = [2.1 * r, r, rms, 1.42 * rms, rms * (1.0 - spread), rms * (1.0 + spread)];
            let words = [Cell::from(case.as_str()), Cell::from("dem")];
            table.push(numbers.map(Cell::Number).into_iter().chain(words));
        }
        let numbers = [f64::from(n), top.0, top.1, damping, 2.0 * damping, 0.01 * f64::from(n), 1.0 / mass.sqrt(), 0.4];
        cases.push([Cell::from(case.as_str()), Cell::from("dem")].into_iter().chain(numbers.map(Cell::Number)));
        let n = f64::from(n);
        causes.push(
            std::iter::once(Cell::from(case))
                .chain([3e-5 * n, 1.4e-5 * n, 3e-3 / (1.0 + 0.1 * n), 0.0].map(Cell::Number)),
        );
    }
    table.write(&dir.join("response.csv")).unwrap();
    cases.write(&dir.join("cases.csv")).unwrap();
    causes.write(&dir.join("energy_by_cause.csv")).unwrap();
    summary("dem").write(&dir.join("summary.json")).unwrap();
    text(dir, "scene.toml", "[sweep]\n");
}

/// A folder of `tsubu compare`.
pub fn compare(dir: &Path) {
    let mut table = Table::new(["quantity [text]", "unit [text]", "dem", "lattice"]);
    table.push([Cell::from("rms displacement"), Cell::from("m"), Cell::from(2.81e-3), Cell::from(2.77e-3)]);
    table.push([Cell::from("lift-off phase"), Cell::from("deg"), Cell::from(41.2), Cell::from(f64::NAN)]);
    table.push([Cell::from("buoyancy"), Cell::from("J"), Cell::from(0.0), Cell::from(f64::NAN)]);
    table.write(&dir.join("compare.csv")).unwrap();
    text(dir, "compare.json", "{}");
    run(&dir.join("dem"), "dem", 30);
    run(&dir.join("lattice"), "lattice", 0);
}

/// A folder of `tsubu sweep`.
pub fn sweep(dir: &Path) {
    let mut table = Table::new([
        "case [text]",
        "particles.balls.count [text]",
        "contact.restitution [text]",
        "wall seconds [s]",
        "energy residual [-]",
        "rms displacement [m]",
    ]);
    for (i, n) in [10.0, 20.0, 40.0, 10.0, 20.0, 40.0].into_iter().enumerate() {
        let e = if i < 3 { "0.5" } else { "0.75" };
        let words = [format!("count = {n}, e = {e}"), n.to_string(), e.to_owned()].map(Cell::Text);
        let rms = 0.02 / (n + 4.0) * if i < 3 { 1.0 } else { 0.8 };
        table.push(words.into_iter().chain([0.1 * n, 1e-6, rms].map(Cell::Number)));
    }
    table.write(&dir.join("sweep.csv")).unwrap();
    text(dir, "scene.toml", "[sweep]\n");
}

/// A folder of `tsubu sweep` over a friction and three seeds, with the heap angle last of ten results; one case failed.
pub fn calibration(dir: &Path) {
    let densities = (1..10).map(|i| format!("density {i} [kg/m^3]"));
    let header = ["case [text]", "materials.sand.friction [text]", "seed [text]", "status [text]", "wall seconds [s]"];
    let header = header.map(String::from).into_iter().chain(densities);
    let mut table = Table::new(header.chain(["heap angle [rad]", "remark [text]"].map(String::from)));
    for friction in [0.2, 0.4, 0.6] {
        for seed in [1.0, 2.0, 3.0] {
            let bad = (friction, seed) == (0.6, 3.0);
            let words = [format!("friction = {friction}, seed = {seed}"), friction.to_string(), seed.to_string()];
            let mut row: Vec<Cell> = words.map(Cell::Text).to_vec();
            row.extend([Cell::from(if bad { "failed" } else { "finished" }), Cell::from(2.0)]);
            row.extend((1..10).map(|i| Cell::from(1500.0 + f64::from(i) + friction)));
            row.push(Cell::from(if bad { f64::NAN } else { friction + 0.1 * (seed - 2.0) }));
            row.push(Cell::from(if bad { "grain 7 overlaps its neighbour" } else { "" }));
            table.push(row);
        }
    }
    table.write(&dir.join("sweep.csv")).unwrap();
    text(dir, "sweep.json", "{\"wall_seconds\": 10.0, \"jobs\": 2}");
    text(dir, "scene.toml", "[sweep]\n");
}

/// A folder of `tsubu verify`; `good` or with one claim that fails.
pub fn verify(dir: &Path, good: bool) {
    let high = if good { 4.09e-3 } else { 4.0e-3 };
    let claims = vec![
        Claim::judge("A-F3a peak ratio N=20", 0.973, Some(0.96), Some(0.98), Source::scene("figure 3a, digitised"))
            .of("damper-2003"),
        Claim::judge("A-7.1 added mass", 0.0421, Some(0.0419), Some(0.0423), Source::scene("closed form"))
            .of("damper-2003"),
        Claim::judge(
            "V-60 peak [m]",
            4.083_61e-3,
            Some(4.08e-3),
            Some(high),
            Source::scene("single-ball impact damper"),
        )
        .of("impact-damper"),
        Claim::judge("V-05 restitution", 0.75, None, Some(0.75), Source::scene("input")).of("restitution"),
    ];
    write_json(&dir.join("verify.json"), &claims).unwrap();
}

/// A text file.
pub fn text(dir: &Path, name: &str, content: &str) {
    write_atomically(&dir.join(name), |out| out.write_all(content.as_bytes())).unwrap();
}
