//! The matrices of hosts: sizes, symmetry, definiteness.

use super::{Parts, rotor};
use crate::complaint::Complaint;
use crate::plan::{Host, Signal, Structure};
use crate::symmetric::{asymmetry, positive_definite};

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (wall, _) in parts.walls.iter().filter(|(_, wall)| wall.interface.is_some() && wall.host.is_none()) {
        complaints.push(
            Complaint::new(format!("the wall `{wall}` hangs on an interface of no host"))
                .at(&parts.root.locate(&["walls", wall, "interface"]), "of which host?")
                .hint("add `host = \"NAME\"`"),
        );
    }
    atlas(parts, complaints);
    for (name, host) in &parts.hosts {
        let at = |keys: &[&str]| {
            let path: Vec<&str> = ["hosts", name.as_str(), "structure"].iter().chain(keys).copied().collect();
            parts.root.locate(&path)
        };
        interfaces(parts, name, host, complaints);
        dwell(parts, name, host, complaints);
        idle_base(parts, name, host, complaints);
        match &host.structure {
            Structure::Oscillator { .. } | Structure::Pendulum { .. } => {}
            Structure::Shaker {} => shaker(parts, name, host, complaints),
            Structure::Modes { mode } => {
                if mode.is_empty() {
                    complaints.push(
                        Complaint::new(format!("the host `{name}` has no modes"))
                            .at(&at(&["modes"]), "the list is empty"),
                    );
                } else if host.at.is_none() && mode.iter().all(|mode| mode.shape == 0.0) {
                    complaints.push(
                        Complaint::new(format!("no mode of the host `{name}` moves the walls"))
                            .at(&at(&["modes"]), "every `shape` is 0"),
                    );
                }
            }
            Structure::Matrices { mass, damping, stiffness, coordinate, participation, .. } => {
                let size = mass.len();
                rotor::check(parts, name, host, complaints);
                for (key, matrix) in [("damping", damping), ("stiffness", stiffness)] {
                    if matrix.len() != size {
                        complaints.push(
                            Complaint::new(format!("`{key}` of the host `{name}` has another size than `mass`")).at(
                                &at(&["matrices", key]),
                                format!("{0} x {0}, but `mass` is {size} x {size}", matrix.len()),
                            ),
                        );
                    }
                }
                for (key, matrix, definite) in
                    [("mass", mass, true), ("damping", damping, false), ("stiffness", stiffness, true)]
                {
                    if let Some((i, j)) = asymmetry(matrix) {
                        complaints.push(Complaint::new(format!("`{key}` of the host `{name}` is not symmetric")).at(
                            &at(&["matrices", key]),
                            format!(
                                "row {}, column {} is {}, but mirrored {}",
                                i + 1,
                                j + 1,
                                matrix[i][j],
                                matrix[j][i]
                            ),
                        ));
                    } else if definite && !positive_definite(matrix) {
                        complaints.push(
                            Complaint::new(format!("`{key}` of the host `{name}` is not positive definite"))
                                .at(&at(&["matrices", key]), "some displacement would have no or negative energy"),
                        );
                    }
                }
                if participation.len() != size {
                    complaints.push(
                        Complaint::new(format!("`participation` of the host `{name}` has another size than `mass`"))
                            .at(
                                &at(&["matrices", "participation"]),
                                format!("{} numbers, {size} coordinates", participation.len()),
                            ),
                    );
                }
                if *coordinate >= size {
                    complaints.push(Complaint::new(format!("the host `{name}` has no coordinate {coordinate}")).at(
                        &at(&["matrices", "coordinate"]),
                        format!("coordinates here: 0 to {}", size.saturating_sub(1)),
                    ));
                }
            }
        }
    }
}

/// An atlas shakes walls along a line: there are such walls, and they hang on the host that it names.
fn atlas(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let name = parts.resolved.get("atlas").and_then(|atlas| atlas.get("host")).and_then(toml::Value::as_str);
    let Some((name, host)) = name.and_then(|name| Some((name, parts.hosts.get(name)?))) else { return };
    let place = parts.root.locate(&["atlas"]);
    if host.turns() {
        complaints.push(
            Complaint::new(format!("an atlas shakes walls along a line, and those of the pendulum `{name}` turn"))
                .at(&place, "asked for here")
                .hint("take a host that moves along its `direction`"),
        );
    } else if !parts.walls.iter().any(|(_, wall)| wall.host.as_deref() == Some(name)) {
        complaints.push(
            Complaint::new(format!("no wall hangs on the host `{name}`, so there is no cavity to shake"))
                .at(&place, "asked for here")
                .hint(format!("add `host = \"{name}\"` to the walls of the cavity")),
        );
    }
}

/// A base that takes part in no mode moves nothing: a table of modes without that column says so of all.
fn idle_base(parts: &Parts<'_>, name: &str, host: &Host, complaints: &mut Vec<Complaint>) {
    let Structure::Modes { mode } = &host.structure else { return };
    if host.base.is_some() && !mode.is_empty() && mode.iter().all(|mode| mode.participation == 0.0) {
        complaints.push(
            Complaint::new(format!("the base of the host `{name}` moves nothing"))
                .at(&parts.root.locate(&["hosts", name, "base"]), "every `participation` is 0")
                .also(&parts.root.locate(&["hosts", name, "structure"]), "the structure")
                .hint("`participation` says how the base drives each mode; a table of modes has a column of that name"),
        );
    }
}

/// A shaker is where its base is: it has a base, and no force or beginning of its own.
fn shaker(parts: &Parts<'_>, name: &str, host: &Host, complaints: &mut Vec<Complaint>) {
    let path = |key| ["hosts", name, key];
    if host.base.is_none() {
        complaints.push(
            Complaint::new(format!("the shaker `{name}` has no `base`"))
                .at(&parts.root.locate(&path("structure")), "how does it move?")
                .hint("base.sine = { acceleration = \"2 g\", frequency = \"30 Hz\" }"),
        );
    }
    // Written out in full, a scene says of every host that it begins at 0.
    let told = [
        ("force", host.force.is_some()),
        ("displacement", host.displacement != 0.0),
        ("velocity", host.velocity != 0.0),
    ];
    for (key, told) in told {
        if told {
            complaints.push(
                Complaint::new(format!("the shaker `{name}` moves as its `base` says, whatever `{key}` is"))
                    .at(&parts.root.locate(&path(key)), "has no effect")
                    .hint("leave it out; a force that moves a mass is `structure.oscillator`"),
            );
        }
    }
}

/// A dwell has one sine whose frequency it moves, and nobody else does.
fn dwell(parts: &Parts<'_>, name: &str, host: &Host, complaints: &mut Vec<Complaint>) {
    if host.dwell.is_none() {
        return;
    }
    let place = parts.root.locate(&["hosts", name, "dwell"]);
    let sines =
        [&host.base, &host.force].into_iter().filter(|signal| matches!(signal, Some(Signal::Sine { .. }))).count();
    if sines != 1 || host.is_shaker() {
        complaints.push(
            Complaint::new(format!("the host `{name}` has no sine whose frequency could follow its resonance"))
                .at(&place, "needs a structure that answers, and one of `base.sine` and `force.sine`")
                .hint("base.sine = { acceleration = \"0.5 g\", frequency = \"20 Hz\" }, a frequency to begin with"),
        );
    }
    for study in ["response", "atlas"] {
        let of = parts.resolved.get(study).and_then(|study| study.get("host")).and_then(toml::Value::as_str);
        if of == Some(name) {
            complaints.push(
                Complaint::new(format!("both `dwell` and [{study}] move the frequency of the host `{name}`"))
                    .at(&place, "follows the resonance")
                    .also(&parts.root.locate(&[study]), "goes through frequencies")
                    .hint("leave one of them out"),
            );
        }
    }
}

/// Mass that nobody means, too little and too much [kg].
const ABSURD: [f64; 2] = [1e-9, 1e12];

/// The shapes of interfaces have as many entries as the structure has coordinates, and walls hang on interfaces that are there.
fn interfaces(parts: &Parts<'_>, name: &str, host: &Host, complaints: &mut Vec<Complaint>) {
    let coordinates = match &host.structure {
        Structure::Oscillator { .. } | Structure::Pendulum { .. } | Structure::Shaker {} => 1,
        Structure::Matrices { mass, .. } => mass.len(),
        Structure::Modes { mode } => mode.len(),
    };
    let plane = parts.resolved.get("dimension").and_then(toml::Value::as_integer) == Some(2);
    for (interface, shapes) in &host.interface {
        let path = ["hosts", name, "interface", interface];
        for (key, list, may_be_empty) in
            [("translation", &shapes.translation, false), ("rotation", &shapes.rotation, true)]
        {
            if list.len() != coordinates && !(may_be_empty && list.is_empty()) {
                complaints.push(
                    Complaint::new(format!("`{key}` of the interface `{interface}` has another number of vectors than the host `{name}` has coordinates"))
                        .at(&parts.root.locate(&[&path[..], &[key]].concat()), format!("{} vectors, {coordinates} coordinates", list.len())),
                );
            }
        }
        let leaves = |list: &[[f64; 3]], axes: &[usize]| list.iter().any(|v| axes.iter().any(|axis| v[*axis] != 0.0));
        if plane && (leaves(&shapes.translation, &[1]) || leaves(&shapes.rotation, &[0, 2])) {
            complaints.push(
                Complaint::new(format!("the interface `{interface}` of the host `{name}` leaves the plane"))
                    .at(&parts.root.locate(&path), "moves along y, or turns about x or z")
                    .hint("the scene is in the plane of x and z; `dimension = 3` is space"),
            );
        }
        if let Structure::Modes { mode } = &host.structure {
            let mobility =
                mode.iter().zip(&shapes.translation).map(|(mode, t)| t.iter().map(|x| x * x).sum::<f64>() / mode.mass);
            let mass = 1.0 / mobility.sum::<f64>();
            if mass.is_finite() && !(ABSURD[0]..=ABSURD[1]).contains(&mass) {
                complaints.push(
                    Complaint::new(format!("the host `{name}` would show a mass of {mass:.1e} kg at its interface `{interface}`"))
                        .at(&parts.root.locate(&path), "nobody means that")
                        .hint("vectors of modal mass one have units: in a table of modes write `NAME x [1/sqrt(t)]` where the mass was in tonnes"),
                );
            }
        }
    }
    if matches!(host.structure, Structure::Pendulum { .. }) {
        for (key, there) in [("base", host.base.is_some()), ("interface", !host.interface.is_empty())] {
            if there {
                complaints.push(
                    Complaint::new(format!("the pendulum `{name}` has no `{key}`"))
                        .at(&parts.root.locate(&["hosts", name, key]), "not of a pendulum")
                        .hint("its walls turn about its axis without an interface; `force` drives it"),
                );
            }
        }
    }
    let hanging = parts.walls.iter().filter(|(_, wall)| wall.host.as_deref() == Some(name));
    for (wall, interface) in hanging.filter_map(|(wall, plan)| Some((wall, plan.interface.as_ref()?))) {
        if !host.interface.contains_key(interface) {
            let names: Vec<String> = host.interface.keys().map(|name| format!("`{name}`")).collect();
            complaints.push(
                Complaint::new(format!("the host `{name}` has no interface `{interface}`"))
                    .at(&parts.root.locate(&["walls", wall, "interface"]), "not an interface")
                    .hint(if names.is_empty() {
                        "it has none".to_owned()
                    } else {
                        format!("interfaces here: {}", names.join(", "))
                    }),
            );
        }
    }
}
