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

impl Template {
    /// The files that the scene names: what each is called, and what is in it.
    pub fn files(&self) -> &'static [(&'static str, &'static str)] {
        match self.name {
            "mixer" | "mixed" => &[("mixer-blade.stl", include_str!("../../../scenes/mixer-blade.stl"))],
            _ => &[],
        }
    }
}

/// Every template; the first is the main example. Names and texts are those of `scenes/README.md`.
pub static TEMPLATES: &[Template] = &[
    Template {
        name: "damper",
        about: "50 balls in a box on a spring: the frequency response of a granular damper",
        text: include_str!("../../../scenes/damper.toml"),
    },
    Template {
        name: "machine-damper",
        about: "a box of steel balls on a machine: which one quiets it best, within 0.8 kg?",
        text: include_str!("../../../scenes/machine-damper.toml"),
    },
    Template {
        name: "drop",
        about: "one ball dropped in a still box: each rebound reaches e² of the height before",
        text: include_str!("../../../scenes/drop.toml"),
    },
    Template {
        name: "shaken-box",
        about: "40 balls in a box that a shaker moves by ±24 mm at 6 Hz: the bed is thrown, comes apart and lands",
        text: include_str!("../../../scenes/shaken-box.toml"),
    },
    Template {
        name: "impact-damper",
        about: "one ball between two stops at resonance: two impacts a cycle, known in closed form",
        text: include_str!("../../../scenes/impact-damper.toml"),
    },
    Template {
        name: "beam-damper",
        about: "a box of balls at the tip of a clamped beam: it moves and tilts with the modes, and damps the first resonance",
        text: include_str!("../../../scenes/beam-damper.toml"),
    },
    Template {
        name: "beam",
        about: "a cantilever of bonded grains bends as beam theory says",
        text: include_str!("../../../scenes/beam.toml"),
    },
    Template {
        name: "agglomerate",
        about: "an agglomerate of bonded grains flies against a plate and breaks",
        text: include_str!("../../../scenes/agglomerate.toml"),
    },
    Template {
        name: "masonry",
        about: "in the plane: a ball flies against a wall of bricks, which are polygons that bonds hold together",
        text: include_str!("../../../scenes/masonry.toml"),
    },
    Template {
        name: "fibre",
        about: "a fibre of bonded grains bends under its weight by 64 degrees, as the heavy elastica does",
        text: include_str!("../../../scenes/fibre.toml"),
    },
    Template {
        name: "rock-core",
        about: "in space: a core of bonded grains is pressed between plates until it fails; its stress, its cracks and its fragments",
        text: include_str!("../../../scenes/rock-core.toml"),
    },
    Template {
        name: "random-vibration",
        about: "a box of balls on a machine under random vibration: spectra of base and machine, and what is transmitted",
        text: include_str!("../../../scenes/random-vibration.toml"),
    },
    Template {
        name: "rods",
        about: "in space: rods, tetrahedra and balls fall into a box; a clump is spheres that are one body",
        text: include_str!("../../../scenes/rods.toml"),
    },
    Template {
        name: "ellipsoids",
        about: "in space: ellipsoids, pills and dice with round edges fall into a box beside balls",
        text: include_str!("../../../scenes/ellipsoids.toml"),
    },
    Template {
        name: "cubes",
        about: "in space: cubes, tetrahedra and prisms with rounded edges fall into a box beside balls",
        text: include_str!("../../../scenes/cubes.toml"),
    },
    Template {
        name: "polygons",
        about: "in the plane: squares, triangles and hexagons with rounded corners fall into a box beside discs",
        text: include_str!("../../../scenes/polygons.toml"),
    },
    Template {
        name: "cells",
        about: "hexagons, rods and hooks made of lattice cells lose a side wall, by CL-CA; the same file runs by DEM with the same outlines",
        text: include_str!("../../../scenes/cells.toml"),
    },
    Template {
        name: "mixed",
        about: "in space: balls, clumps, ellipsoids and cubes side by side in a round vessel, stirred by a blade from an STL file",
        text: include_str!("../../../scenes/mixed.toml"),
    },
    Template {
        name: "heap",
        about: "a hopper empties onto a floor and a heap grows: watches count, weigh and measure; the scene claims what comes out",
        text: include_str!("../../../scenes/heap.toml"),
    },
    Template {
        name: "fill-and-open",
        about: "a silo that is filled, comes to rest and is opened: three stages of one run",
        text: include_str!("../../../scenes/fill-and-open.toml"),
    },
    Template {
        name: "mixer",
        about: "two sorts of grains are filled into a drum, come to rest, and a blade from an STL file turns in them",
        text: include_str!("../../../scenes/mixer.toml"),
    },
    Template {
        name: "triaxial",
        about: "spheres between planes: pressed together from all sides, then sheared at constant stress on their sides; a peak, and the critical state",
        text: include_str!("../../../scenes/triaxial.toml"),
    },
    Template {
        name: "hops",
        about: "a grain that hops along a floor: a watch measures every hop and every contact, and the scene claims what theory says",
        text: include_str!("../../../scenes/hops.toml"),
    },
    Template {
        name: "calibrate",
        about: "a grain was dropped and measured: how elastic is it, and how stiff its contacts?",
        text: include_str!("../../../scenes/calibrate.toml"),
    },
    Template {
        name: "rock-slide",
        about: "rock slides down a slope and over a plain: run-out, Heim's angle, deposit, transport",
        text: include_str!("../../../scenes/rock-slide.toml"),
    },
    Template {
        name: "ring-down",
        about: "a box on a spring pulled down by 20 mm and let go, with 30 balls inside",
        text: include_str!("../../../scenes/ring-down.toml"),
    },
    Template {
        name: "drum",
        about: "a drum that turns half a revolution a second: avalanches",
        text: include_str!("../../../scenes/drum.toml"),
    },
    Template {
        name: "hopper",
        about: "in space: grains come in as a stream, run through a funnel and vanish",
        text: include_str!("../../../scenes/hopper.toml"),
    },
    Template {
        name: "chute",
        about: "in space: a rough slope that repeats itself, ground of frozen grains, tilted gravity",
        text: include_str!("../../../scenes/chute.toml"),
    },
    Template {
        name: "powder",
        about: "a heap of grains that stick (JKR) and do not like to roll (EPSD)",
        text: include_str!("../../../scenes/powder.toml"),
    },
    Template {
        name: "saltation",
        about: "a grain leaps along the bed of a stream: a table of its hops",
        text: include_str!("../../../scenes/saltation.toml"),
    },
    Template {
        name: "saltation-space",
        about: "grains leap over a bed in space: hops as high, long and fast as measured ones",
        text: include_str!("../../../scenes/saltation-space.toml"),
    },
    Template {
        name: "bedload",
        about: "a stream and its bed: grains are carried, and slow the water",
        text: include_str!("../../../scenes/bedload.toml"),
    },
    Template {
        name: "debris-flow",
        about: "in space: stones fall into a stream down 15 degrees, slow it and are carried; its surface finds its level",
        text: include_str!("../../../scenes/debris-flow.toml"),
    },
    Template {
        name: "pebbles",
        about: "in space: balls, ellipsoids, cubes and pairs of balls fall through the surface of water, each with the drag of its shape",
        text: include_str!("../../../scenes/pebbles.toml"),
    },
    Template {
        name: "settling",
        about: "a quartz grain sinks in still water",
        text: include_str!("../../../scenes/settling.toml"),
    },
    Template {
        name: "wet-rebound",
        about: "a ball hits a wall in oil: the film between them takes speed twice; the scene claims what is left",
        text: include_str!("../../../scenes/wet-rebound.toml"),
    },
    Template {
        name: "dam-break",
        about: "a bed leans on a gate; the gate vanishes and the bed runs out",
        text: include_str!("../../../scenes/dam-break.toml"),
    },
    Template {
        name: "dam-break-space",
        about: "the same in space: how far the grains run out",
        text: include_str!("../../../scenes/dam-break-space.toml"),
    },
    Template {
        name: "collapse",
        about: "a heap of rods of two sizes loses its side wall, by CL-CA; the same file runs by DEM",
        text: include_str!("../../../scenes/collapse.toml"),
    },
    Template {
        name: "sinking-ball",
        about: "in space: a hollow ball, a wall that is a free body, falls into sand of a sieve curve",
        text: include_str!("../../../scenes/sinking-ball.toml"),
    },
    Template {
        name: "press",
        about: "a lid under constant pressure sinks until the bed carries it",
        text: include_str!("../../../scenes/press.toml"),
    },
    Template {
        name: "voids",
        about: "a silo runs out by voids that walk up through the bed, after Caram and Hong or by Litwiniszyn",
        text: include_str!("../../../scenes/voids.toml"),
    },
    Template {
        name: "sorting-chute",
        about: "two sizes flow down an endless chute, after Savage: large grains come to lie on top",
        text: include_str!("../../../scenes/sorting-chute.toml"),
    },
    Template {
        name: "lattice-grains",
        about: "balls fall in a box and come to rest, each on a node of a lattice (Gutt and Haff)",
        text: include_str!("../../../scenes/lattice-grains.toml"),
    },
    Template {
        name: "gas-channel",
        about: "a lattice gas (FHP-III) flows down a channel as a liquid would",
        text: include_str!("../../../scenes/gas-channel.toml"),
    },
    Template {
        name: "gas-pipe",
        about: "grains fall through a pipe without end and gather in waves, after Peng and Herrmann",
        text: include_str!("../../../scenes/gas-pipe.toml"),
    },
    Template {
        name: "elongated-hopper",
        about: "elongated grains line up as they run out of a hopper, after Baxter and Behringer",
        text: include_str!("../../../scenes/elongated-hopper.toml"),
    },
    Template {
        name: "poured-silo",
        about: "smooth and rough grains poured into a silo part on the slope, after Karolyi and Kertesz",
        text: include_str!("../../../scenes/poured-silo.toml"),
    },
    Template {
        name: "pile-forces",
        about: "forces in a pile, handed down from row to row, after Hemmingsson and Herrmann: a dip under the apex",
        text: include_str!("../../../scenes/pile-forces.toml"),
    },
];

#[cfg(test)]
mod tests {
    use super::TEMPLATES;

    /// The list of the program and the page beside the scenes were two texts, of which one lacked two scenes.
    #[test]
    fn the_page_of_scenes_says_the_same() {
        let page = include_str!("../../../scenes/README.md");
        let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| [")).collect();
        let listed = TEMPLATES.iter().map(|t| format!("| [{0}.toml]({0}.toml) | {1} |", t.name, t.about));
        let rows: Vec<&str> = rows.into_iter().filter(|row| !row.contains("from-lammps")).collect();
        assert_eq!(rows, listed.collect::<Vec<_>>());
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
        let files =
            std::fs::read_dir(folder).expect("a folder").filter_map(|file| file.ok()?.file_name().into_string().ok());
        let mut files: Vec<String> = files.filter_map(|name| Some(name.strip_suffix(".toml")?.to_string())).collect();
        let mut names: Vec<&str> = TEMPLATES.iter().map(|template| template.name).chain(["from-lammps"]).collect();
        files.sort_unstable();
        names.sort_unstable();
        assert_eq!(files, names);
    }
}
