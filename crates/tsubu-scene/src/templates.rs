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
        name: "ring-down",
        about: "a box on a spring let go with balls inside: damping from the decay",
        text: include_str!("../../../scenes/ring-down.toml"),
    },
];
