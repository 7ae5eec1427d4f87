//! Scenes to begin with, for `tsubu new`.

/// A scene that is shipped in the program.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The name it is asked for by.
    pub name: &'static str,
    /// One line for the list.
    pub about: &'static str,
    /// The scene, with comments.
    pub text: &'static str,
}

/// Every template; the first is the main example.
pub static TEMPLATES: &[Template] = &[
    Template {
        name: "damper",
        about: "balls in a box on a spring: the frequency response of a granular damper",
        text: include_str!("../../../scenes/damper.toml"),
    },
    Template {
        name: "drop",
        about: "one ball dropped in a still box: rebound heights and times",
        text: include_str!("../../../scenes/drop.toml"),
    },
    Template {
        name: "shaken-box",
        about: "40 balls in a box that a shaker moves: the bed is thrown, separates and lands",
        text: include_str!("../../../scenes/shaken-box.toml"),
    },
    Template {
        name: "impact-damper",
        about: "one ball between two stops in a vibrating box: two impacts a cycle, known in closed form",
        text: include_str!("../../../scenes/impact-damper.toml"),
    },
    Template {
        name: "rock-slide",
        about: "rock slides down a slope and runs out over a plain: front, Heim's angle, deposit",
        text: include_str!("../../../scenes/rock-slide.toml"),
    },
    Template {
        name: "collapse",
        about: "540 rods of two sizes lose their side wall, by CL-CA: grains made of lattice points",
        text: include_str!("../../../scenes/collapse.toml"),
    },
    Template {
        name: "hops",
        about: "a grain hops along a floor: height, length, restitution and contact time of every hop",
        text: include_str!("../../../scenes/hops.toml"),
    },
    Template {
        name: "ring-down",
        about: "a box on a spring let go with balls inside: damping from the decay",
        text: include_str!("../../../scenes/ring-down.toml"),
    },
    Template {
        name: "drum",
        about: "230 discs in a drum that turns: avalanches",
        text: include_str!("../../../scenes/drum.toml"),
    },
    Template {
        name: "hopper",
        about: "beads rain into a funnel in space, run out below and are gone",
        text: include_str!("../../../scenes/hopper.toml"),
    },
    Template {
        name: "chute",
        about: "down a rough slope without end: periodic world, frozen ground, tilted gravity",
        text: include_str!("../../../scenes/chute.toml"),
    },
    Template {
        name: "powder",
        about: "a heap of sticky powder: JKR attraction, resistance to rolling",
        text: include_str!("../../../scenes/powder.toml"),
    },
    Template {
        name: "dam-break",
        about: "a bed of grains leans on a gate that vanishes: the bed runs out and stops",
        text: include_str!("../../../scenes/dam-break.toml"),
    },
    Template {
        name: "dam-break-space",
        about: "the same in space: how far the grains run out",
        text: include_str!("../../../scenes/dam-break-space.toml"),
    },
    Template {
        name: "wet-rebound",
        about: "a ball hits a wall in oil: what the film between them leaves of its speed",
        text: include_str!("../../../scenes/wet-rebound.toml"),
    },
    Template {
        name: "sinking-ball",
        about: "in space: a hollow ball, a free body among the walls, falls into sand of a sieve curve",
        text: include_str!("../../../scenes/sinking-ball.toml"),
    },
    Template {
        name: "press",
        about: "a lid under constant pressure sinks onto a bed and stops",
        text: include_str!("../../../scenes/press.toml"),
    },
    Template {
        name: "saltation",
        about: "a grain leaps along the bed of a stream: drag, buoyancy and added mass in a log-law flow",
        text: include_str!("../../../scenes/saltation.toml"),
    },
    Template {
        name: "saltation-space",
        about: "grains leap over a bed in space, held against measured hops",
        text: include_str!("../../../scenes/saltation-space.toml"),
    },
    Template {
        name: "bedload",
        about: "a stream carries the upper grains of its bed along and is slowed by them: momentum both ways",
        text: include_str!("../../../scenes/bedload.toml"),
    },
    Template {
        name: "voids",
        about: "a silo runs out by voids that walk up through the bed",
        text: include_str!("../../../scenes/voids.toml"),
    },
    Template {
        name: "sorting-chute",
        about: "two sizes flow down an endless chute on a square lattice and sort themselves",
        text: include_str!("../../../scenes/sorting-chute.toml"),
    },
    Template {
        name: "lattice-grains",
        about: "balls fall in a box and come to rest, each on a node of a lattice",
        text: include_str!("../../../scenes/lattice-grains.toml"),
    },
    Template {
        name: "pile-forces",
        about: "forces in a pile at rest, handed down from row to row",
        text: include_str!("../../../scenes/pile-forces.toml"),
    },
    Template {
        name: "gas-channel",
        about: "particles on a lattice flow down a channel between rough walls, as a liquid would",
        text: include_str!("../../../scenes/gas-channel.toml"),
    },
    Template {
        name: "gas-pipe",
        about: "grains fall through a pipe without end and gather in waves: a lattice gas that loses energy",
        text: include_str!("../../../scenes/gas-pipe.toml"),
    },
    Template {
        name: "elongated-hopper",
        about: "elongated grains of a lattice gas run out of a hopper and line up with the flow",
        text: include_str!("../../../scenes/elongated-hopper.toml"),
    },
    Template {
        name: "poured-silo",
        about: "smooth and rough grains poured into a silo part on the slope: avalanches on a lattice",
        text: include_str!("../../../scenes/poured-silo.toml"),
    },
    Template {
        name: "debris-flow",
        about: "stones of 10 to 100 cm and water down 15 degrees, in space: momentum both ways below a free surface",
        text: include_str!("../../../scenes/debris-flow.toml"),
    },
];
