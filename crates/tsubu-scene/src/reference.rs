//! The scene reference page, made from the table of keys.

use crate::keys::{self, Key, Kind, Need, Variant, Word};
use crate::suggest;
use crate::units::DIMENSIONS;
use std::fmt::Write as _;

const HEAD: &str = "\
# Scene reference

<!-- Generated from the table of keys in crates/tsubu-scene/src/keys; do not edit. -->

A scene is one TOML file. Every key it can hold is on this page.

**Quantities** are numbers in SI units, or text with a unit: `0.006` or `\"6 mm\"`, `\"123.4 N/m\"`, `\"2650 kg/m^3\"`. Units
are built with products (`N s/m` or `N.s/m`), quotients and powers (`m/s^2`). Text without a unit is an error.

**Vectors** have two entries [x, z] in the plane (`dimension = 2`) and three [x, y, z] in space; x runs to the right, z up.
**Directions** are `\"x\"`, `\"-z\"` and so on, or a vector of any length.

**Choices** are made by the name of a table: `[contact.normal.hertz]`, or `normal.hertz = {}` inside `[contact]`. Only one of
the tables of a choice can be given. What a choice is, with formula, symbols, limits and source, is told by `tsubu explain NAME`, and here:
[contact laws](explained/contact.md), [water](explained/water.md), [watches](explained/watches.md), [walls](explained/walls.md),
[methods](explained/methods.md).

**Files** are named from the folder of the scene file. The run folder gets copies of those with grains and meshes, so that its
`scene.toml` runs again. Grains come from CSV, extended XYZ, LAMMPS data, LAMMPS dump and VTK PolyData files, all in SI units unless a header says otherwise:

- `.csv` with a header: `x`, `y`, `z`, then what there is of `d` (or `diameter`) or `r` (or `radius`), `vx`, `vy`, `vz`, `wx`, `wy`,
  `wz`, in any order, with units as in `x [mm]`; other columns are passed over. Without a header: x, y, z and perhaps the
  radius; in the plane x, z and perhaps the radius. Lines that begin with `#` are passed over.
- `.xyz`: one frame, `Properties` with `pos` and what there is of `radius` (or `diameter`), `velo` and `omega`.
- `.data`: atom_style sphere, the sections `Atoms` and `Velocities`; densities are the materials'.
- `.lammpstrj`: dump files as tsubu and LAMMPS write them, of several snapshots the last: `x y z` (or `xu yu zu`) and what there is of `id`, `type`,
  `vx`, `vy`, `vz`, `omegax`, `omegay`, `omegaz`, `radius` (or `diameter`), `density` and `mass`; masses must be those of the scene.
- `.vtp`: VTK PolyData, in text or raw appended, as in `frames/` of a run: points and what there is of `velocity`, `spin`, `radius` (or `diameter`),
  `mass`, `density`, `id` and `group`; all else is passed over.

In the plane every y must be 0. Meshes come from `.stl` (text or binary) and `.obj` files.

NAME stands for a name of your own. A value can be changed from the command line without touching the file:
`--set particles.balls.count=30`, `--set contact.damping.quarter={}`.

";

/// The page in Markdown.
pub fn reference() -> String {
    let mut page = String::from(HEAD);
    let _ = writeln!(page, "A [stage](stages.md) may set keys with a star, and what stands in their tables.\n");
    let _ = writeln!(page, "## Top of the file\n");
    rows(&mut page, keys::SCENE);
    for key in keys::SCENE {
        section(&mut page, key, "", 2);
    }
    page.push_str("## Units\n\n| quantity | units |\n|---|---|\n");
    for dimension in DIMENSIONS.iter().filter(|dimension| !dimension.si.is_empty()) {
        let units: Vec<String> = dimension.units.iter().map(|unit| format!("`{unit}`")).collect();
        let _ = writeln!(page, "| {} | {} |", dimension.name, units.join(", "));
    }
    page
}

/// The tables below a key, each with a heading of its own.
fn section(page: &mut String, key: &'static Key, path: &str, level: usize) {
    let here = if path.is_empty() { key.name.to_string() } else { format!("{path}.{}", key.name) };
    let hashes = "#".repeat(level.min(4));
    let (heading, about, keys) = match key.kind {
        Kind::Table(keys) => (format!("[{here}]"), key.about, keys),
        Kind::Named(keys, about) => (format!("[{here}.NAME]"), about, keys),
        Kind::Many(keys) => (format!("[[{here}]]"), key.about, keys),
        Kind::Choice(variants) => {
            match told_at(variants) {
                Some(home) if home.matches('.').count() < here.matches('.').count() => {
                    let _ = writeln!(page, "{hashes} Choice `{here}`\n\n{}: the choices of `{home}`.\n", key.about);
                }
                _ => choices(page, key.about, variants, &here, &hashes),
            }
            return;
        }
        Kind::NamedChoice(variants, about) => {
            choices(page, about, variants, &format!("{here}.NAME"), &hashes);
            return;
        }
        _ => return,
    };
    let _ = writeln!(page, "{hashes} `{heading}`\n\n{about}.\n");
    rows(page, keys);
    let inner = heading.trim_matches(['[', ']']);
    for key in keys {
        section(page, key, inner, level + 1);
    }
}

/// Where a choice is told in full: the shortest of its paths.
fn told_at(variants: &'static [Variant]) -> Option<String> {
    let mut paths = Vec::new();
    keys::walk(&mut |path, keys| {
        let same = |key: &&Key| matches!(key.kind, Kind::Choice(others) if std::ptr::eq(others, variants));
        paths.extend(keys.iter().filter(same).map(|key| format!("{path}.{}", key.name)));
    });
    paths.into_iter().min_by_key(|path| path.matches('.').count())
}

fn choices(page: &mut String, about: &str, variants: &'static [Variant], here: &str, hashes: &str) {
    let _ = writeln!(page, "{hashes} Choice `{here}`\n\n{about}.\n");
    for variant in variants {
        let _ = writeln!(page, "- `{}`: {}", variant.name, variant.about);
    }
    page.push('\n');
    for variant in variants.iter().filter(|variant| !variant.keys.is_empty()) {
        let _ = writeln!(page, "Keys of `[{here}.{}]`:\n", variant.name);
        rows(page, variant.keys);
    }
    // Below all of them: a heading would cut the list of variants in two.
    for variant in variants {
        for key in variant.keys {
            section(page, key, &format!("{here}.{}", variant.name), 4);
        }
    }
}

fn rows(page: &mut String, keys: &[Key]) {
    page.push_str("| key | value | default | meaning |\n|---|---|---|---|\n");
    for key in keys {
        let range = key.range.words().map(|words| format!(", {words}")).unwrap_or_default();
        let stage = if key.may_change { " *" } else { "" };
        let _ = writeln!(page, "| `{}`{stage} | {}{range} | {} | {} |", key.name, value(key), default(key), key.about);
    }
    page.push('\n');
}

/// What the value is, in a few words.
pub(crate) fn value(key: &Key) -> String {
    match key.kind {
        Kind::Quantity(dimension) if dimension.si.is_empty() => "number".to_string(),
        Kind::Quantity(dimension) => format!("{} [{}]", bare_name(dimension.name), dimension.si),
        Kind::Whole => "whole number".to_string(),
        Kind::Text => "text".to_string(),
        Kind::Flag => "`true` or `false`".to_string(),
        Kind::OneOf(words) => words_of(words),
        Kind::SomeOf(words) => format!("list of {}", words_of(words)),
        Kind::Wholes => "list of whole numbers".to_string(),
        Kind::Names(family) => format!("names of {}", family.table()),
        Kind::Vector(dimension) => format!("vector [{}], or `\"origin\"`", dimension.si),
        Kind::Vectors(dimension) => format!("list of vectors [{}]", dimension.si),
        Kind::Turning(dimension) => format!("number or vector [{}]", dimension.si),
        Kind::Turnings(dimension) => format!("list of numbers or vectors [{}]", dimension.si),
        Kind::Axis => "direction, y allowed in the plane".to_string(),
        Kind::Direction => "direction".to_string(),
        Kind::Slope => "angle [rad], or percent".to_string(),
        Kind::Gravity => "acceleration or vector [m/s^2]".to_string(),
        Kind::Quantities(dimension) if dimension.si.is_empty() => "list of numbers".to_string(),
        Kind::Quantities(dimension) => format!("list [{}]", dimension.si),
        Kind::Ends(dimension) => format!("two ends [{}]", dimension.si),
        Kind::Cohesion => "force [N] or energy density [J/m^3]".to_string(),
        Kind::Matrix(dimension) => format!("square matrix [{}]", dimension.si),
        Kind::Ratios => "list, or `{ from, to }`, or `{ from, to, step }`".to_string(),
        Kind::Name(family) => format!("name of a {}", family.noun()),
        Kind::NamePair => "two material names".to_string(),
        Kind::Table(_) => "table".to_string(),
        Kind::Named(..) | Kind::NamedChoice(..) => "named tables".to_string(),
        Kind::Many(_) => "list of tables".to_string(),
        Kind::Choice(variants) => format!("choice of {}", suggest::list(variants.iter().map(|variant| variant.name))),
        Kind::Vary => "quoted keys with lists or `{ from, to, step }`".to_string(),
        Kind::Set => "scene keys with values".to_string(),
    }
}

fn words_of(words: &[Word]) -> String {
    words.iter().map(|word| format!("`\"{}\"` ({})", word.name, word.about)).collect::<Vec<_>>().join(", ")
}

/// What is read where it is not given, in a few words.
pub(crate) fn default(key: &Key) -> String {
    match key.need {
        Need::Required => "required".to_string(),
        Need::Optional => "not there".to_string(),
        Need::Default("{}") if has_defaults(key) => "all its defaults".to_string(),
        Need::Default("{}" | "[]" | "''") => "empty".to_string(),
        Need::Default(text) => format!("`{}`", text.replace('\'', "\"")),
        Need::Word(word) => format!("`\"{word}\"`"),
        Need::Derived(text) | Need::DerivedOrWord(text, _) => text.to_string(),
    }
}

/// A table of keys that need not be there has nothing to fill in.
fn has_defaults(key: &Key) -> bool {
    matches!(key.kind, Kind::Table(keys) if keys.iter().any(|key| !matches!(key.need, Need::Optional)))
}

/// The length, not a length.
fn bare_name(name: &str) -> &str {
    name.trim_start_matches("an ").trim_start_matches("a ")
}

/// A key in one line of plain text, as an editor shows it when the pointer rests on the key.
pub(crate) fn describe(key: &Key) -> String {
    let range = key.range.words().map(|words| format!("; {words}")).unwrap_or_default();
    let value = match key.kind {
        Kind::Quantity(dimension) if !dimension.si.is_empty() => {
            format!(
                " ({} in {}, or text such as {})",
                bare_name(dimension.name),
                dimension.si,
                dimension.examples_text()
            )
        }
        _ => String::new(),
    };
    let default = match key.need {
        Need::Derived(text) | Need::DerivedOrWord(text, _) => format!("; default: {text}"),
        Need::Word(word) => format!("; default: \"{word}\""),
        _ => String::new(),
    };
    format!("{}{value}{range}{default}", key.about)
}
