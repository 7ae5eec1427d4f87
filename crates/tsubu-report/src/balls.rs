//! Particle pictures: what is to be drawn of a frame, and how large.

use std::collections::BTreeMap;
use tsubu_frame::{Frame, Kind, Values};

use crate::compass::Compass;
use crate::solid::Solid;

/// What the colour of a grain tells.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ColourBy {
    /// Its speed.
    #[default]
    Speed,
    /// Any column of real numbers.
    Column(String),
    /// A value a grain given from outside, such as its height at the start, with its name and unit.
    Given(String, String, Vec<f64>),
}

/// From where one looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// Onto the plane if all grains lie in one (of y or z), slantwise from above (z up) otherwise.
    #[default]
    Auto,
    /// Against z: x to the right, y up.
    Front,
    /// Along y: x to the right, z up.
    Side,
    /// Slantwise from above, z up.
    Slant,
}

/// How pictures of a run look; one `Look` for all pictures that are to be compared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// Colour.
    pub colour: ColourBy,
    /// Ends of the colour scale; from the values if none.
    pub range: Option<(f64, f64)>,
    /// Part of the picture plane to be seen [m]: left, bottom, right, top; everything if none.
    pub window: Option<[f64; 4]>,
    /// Velocity arrows (in SVG pictures).
    pub arrows: bool,
    /// Viewpoint.
    pub view: View,
    /// Time of the last picture of a series [s]: all are labelled alike.
    pub last: Option<f64>,
    /// What the values 0, 1, 2... are called, where they are numbers of something; empty where they measure.
    pub names: Vec<String>,
}

/// The grains and walls of one moment, turned to the viewer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balls {
    /// Simulated time [s].
    pub time: f64,
    /// Centres: to the right, up, towards the viewer [m].
    pub centres: Vec<[f64; 3]>,
    /// Radii [m].
    pub radii: Vec<f64>,
    /// Numbers of the outlines of grains that are no discs or spheres; empty where all are.
    pub shape: Vec<i64>,
    /// Outlines by number: corners round the centre [m], turned like it.
    pub shapes: BTreeMap<i64, Vec<[f64; 3]>>,
    /// Superellipsoids, one for each grain, `None` for a sphere; empty where all are.
    pub solids: Vec<Option<Solid>>,
    /// Velocities, turned like the centres [m/s].
    pub velocities: Vec<[f64; 3]>,
    /// Values behind the colours.
    pub values: Vec<f64>,
    /// Name and unit of the values.
    pub quantity: (String, String),
    /// Closed outlines of the walls.
    pub outlines: Vec<Vec<[f64; 3]>>,
    /// Which of them are of endless planes, drawn as far as there is something else to see.
    pub endless: Vec<bool>,
    /// Triangles of the walls.
    pub faces: Vec<[[f64; 3]; 3]>,
    /// Outlines of the water's surface, endless as those of planes are.
    pub water: Vec<Vec<[f64; 3]>>,
    /// Which way is which.
    pub compass: Compass,
    /// Whether one looks slantwise into space, not onto a plane.
    pub space: bool,
}

impl Balls {
    /// Takes what a picture needs from a frame.
    pub fn of(frame: &Frame, look: &Look) -> Self {
        let position = frame.vectors(Kind::Grain, "position");
        let view = settled(look.view, frame);
        let turn = turned(view);
        let count = position.len();
        let radii = match scalars(frame, "radius") {
            Some(r) if r.len() == count => r.to_vec(),
            _ => vec![fallback_radius(position); count],
        };
        let velocity = frame.vectors(Kind::Grain, "velocity");
        let Walls { outlines, endless, faces, water } = walls(frame, &turn);
        let (quantity, values) = match &look.colour {
            ColourBy::Speed => (
                ("speed".to_owned(), "m/s".to_owned()),
                velocity.iter().map(|v| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()).collect(),
            ),
            ColourBy::Column(name) => {
                let unit = frame.column(Kind::Grain, name).map_or("-", |c| c.unit);
                let whole = frame.integers(Kind::Grain, name).iter().map(|v| *v as f64);
                let values = scalars(frame, name).map_or_else(|| whole.collect(), <[f64]>::to_vec);
                ((name.clone(), unit.to_owned()), values)
            }
            ColourBy::Given(name, unit, values) => ((name.clone(), unit.clone()), values.clone()),
        };
        Self {
            time: frame.time,
            centres: position.iter().map(|p| turn(*p)).collect(),
            radii,
            shape: frame.integers(Kind::Grain, "shape").to_vec(),
            shapes: shapes(frame, &turn),
            solids: Solid::all(frame, &turn),
            velocities: velocity.iter().map(|v| turn(*v)).collect(),
            values,
            quantity,
            outlines,
            endless,
            faces,
            water,
            compass: Compass::of(frame, &turn),
            space: view == View::Slant,
        }
    }

    /// Corners of a grain's outline, turned to the viewer [m]; `None`: it is a disc or a sphere.
    pub fn outline(&self, grain: usize) -> Option<impl Iterator<Item = [f64; 3]> + Clone> {
        let centre = self.centres[grain];
        let corners = self.shapes.get(self.shape.get(grain)?)?;
        Some(corners.iter().map(move |corner| std::array::from_fn(|k| centre[k] + corner[k])))
    }

    /// Whether there is nothing to see: neither grains nor walls.
    pub fn is_empty(&self) -> bool {
        self.centres.is_empty() && self.outlines.is_empty() && self.faces.is_empty()
    }

    /// The rectangle that holds the walls that end somewhere and all grains but the few that are far off: left, bottom, right,
    /// top. Those that got away would leave the others no room.
    pub fn extent(&self) -> [f64; 4] {
        let mut e = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let inner = self.inner();
        let seen = |c: &[f64; 3]| c[0] >= inner[0] && c[1] >= inner[1] && c[0] <= inner[2] && c[1] <= inner[3];
        let kept = || (0..self.centres.len()).filter(|&grain| seen(&self.centres[grain]));
        let round = kept().filter(|&grain| self.outline(grain).is_none());
        let spheres = round.map(|grain| (self.centres[grain], self.radii[grain]));
        let corners = kept().filter_map(|grain| self.outline(grain)).flatten();
        // Endless walls are drawn as far as there is something else: they frame a picture only where they are all there is.
        let alone = self.centres.is_empty() && self.endless.iter().all(|endless| *endless) && self.faces.is_empty();
        let lines = self.outlines.iter().enumerate();
        let lines =
            lines.filter(|(k, _)| alone || !self.endless.get(*k).copied().unwrap_or(false)).map(|(_, line)| line);
        let walls = lines.flatten().chain(self.faces.iter().flatten());
        for (c, r) in spheres.chain(corners.chain(walls.copied()).map(|corner| (corner, 0.0))) {
            if c.iter().all(|x| x.is_finite()) {
                e = [e[0].min(c[0] - r), e[1].min(c[1] - r), e[2].max(c[0] + r), e[3].max(c[1] + r)];
            }
        }
        // Water that is deep does not make the grains small.
        let level = self.water.iter().flatten().filter(|_| !self.space).map(|corner| corner[1]);
        let highest = e[3] + (e[2] - e[0]).max(e[3] - e[1]);
        e[3] = level.filter(|level| *level <= highest).fold(e[3], f64::max);
        // A lone level wall has a width and no height, and is something to see.
        let (width, height) = (e[2] - e[0], e[3] - e[1]);
        if width.min(height) >= 0.0 && width.max(height) > 0.0 { e } else { [0.0, 0.0, 1.0, 1.0] }
    }

    /// Centres of all grains but those of the outermost hundredth at each side that are far off: left, bottom, right, top.
    fn inner(&self) -> [f64; 4] {
        let ends = |axis: usize| {
            let mut places: Vec<f64> = self.centres.iter().map(|c| c[axis]).filter(|x| x.is_finite()).collect();
            places.sort_by(f64::total_cmp);
            // Of fewer than a hundred nobody is left out, nor is who is near.
            let out = places.len() / 100;
            let at = |k: usize| places.get(k).copied().unwrap_or(f64::NAN);
            let [first, low] = [at(0), at(out)];
            let [high, last] = [1 + out, 1].map(|k| at(places.len().wrapping_sub(k)));
            let near = 0.5 * (high - low);
            [if first >= low - near { first } else { low }, if last <= high + near { last } else { high }]
        };
        let ([left, right], [bottom, top]) = (ends(0), ends(1));
        [left, bottom, right, top]
    }

    /// How many grains have their centres outside of a window.
    pub(crate) fn outside(&self, w: [f64; 4]) -> usize {
        self.centres.iter().filter(|c| !(c[0] >= w[0] && c[1] >= w[1] && c[0] <= w[2] && c[1] <= w[3])).count()
    }

    /// The value that all but a hundredth of the grains stay below, where the highest is far beyond it; else the highest.
    fn high(&self) -> f64 {
        let mut values: Vec<f64> = self.values.iter().copied().filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let Some(&highest) = values.last() else { return 1.0 };
        let most = values[values.len() - 1 - values.len() / 100];
        if highest > 2.0 * most && most > 0.0 { most } else { highest }
    }

    /// Lowest and highest value behind the colours.
    pub fn range(&self) -> (f64, f64) {
        let finite = || self.values.iter().copied().filter(|v| v.is_finite());
        let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
        if low <= high { (low, high) } else { (0.0, 1.0) }
    }

    /// Place of a grain's value on the colour scale.
    pub fn shade(&self, grain: usize, (low, high): (f64, f64)) -> f64 {
        let value = self.values.get(grain).copied().unwrap_or(f64::NAN);
        if high > low { (value - low) / (high - low) } else { value * 0.0 + 0.35 }
    }
}

/// Settles what all the pictures of a series have in common: one window, one colour scale from zero or the lowest
/// value to the highest.
pub fn common(series: &[Balls], look: &Look) -> Look {
    let mut look = look.clone();
    if look.window.is_none() {
        look.window = series
            .iter()
            .filter(|balls| !balls.is_empty())
            .map(Balls::extent)
            .reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]);
    }
    look.last = look.last.or_else(|| series.iter().map(|balls| balls.time).reduce(f64::max));
    if look.range.is_none() {
        let joined = series
            .iter()
            .filter(|balls| !balls.values.is_empty())
            .map(|balls| (balls.range().0, balls.high()))
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        look.range = joined.map(|(low, high)| if look.colour == ColourBy::Speed { (0.0, high) } else { (low, high) });
    }
    look
}

fn scalars<'a>(frame: &'a Frame, name: &str) -> Option<&'a [f64]> {
    match frame.column(Kind::Grain, name).map(|c| &c.values) {
        Some(Values::Scalar(v)) => Some(v),
        _ => None,
    }
}

/// Points without a radius are drawn small against the picture.
fn fallback_radius(position: &[[f64; 3]]) -> f64 {
    let reach = position.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |a, x| a.max(x.abs()));
    if reach > 0.0 { reach * 0.01 } else { 1e-3 }
}

type Points = Vec<[f64; 3]>;

/// Outlines of grains, by number.
fn shapes(frame: &Frame, turn: impl Fn([f64; 3]) -> [f64; 3]) -> BTreeMap<i64, Points> {
    let number = frame.integers(Kind::Global, "shape of corner");
    let mut shapes = BTreeMap::<i64, Points>::new();
    for (number, corner) in number.iter().zip(frame.vectors(Kind::Global, "corner")) {
        shapes.entry(*number).or_default().push(turn(*corner));
    }
    shapes
}

/// What is round the grains.
#[derive(Default)]
struct Walls {
    outlines: Vec<Points>,
    endless: Vec<bool>,
    faces: Vec<[[f64; 3]; 3]>,
    water: Vec<Points>,
}

fn walls(frame: &Frame, turn: impl Fn([f64; 3]) -> [f64; 3]) -> Walls {
    let points = frame.vectors(Kind::Surface, "position");
    let zeros = vec![0; points.len()];
    let column = |name| Some(frame.integers(Kind::Surface, name)).filter(|v| v.len() == points.len()).unwrap_or(&zeros);
    let (face, endless, wall) = (column("face"), column("endless"), column("wall"));
    let mut walls = Walls::default();
    let mut start = 0;
    for group in column("outline").chunk_by(|a, b| a == b) {
        let corners: Vec<_> = points[start..start + group.len()].iter().map(|p| turn(*p)).collect();
        match corners[..] {
            // The surface of the water has the number -1; its outline tells all of it.
            [_, _, _] if face[start] != 0 && wall[start] < 0 => {}
            [a, b, c] if face[start] != 0 => walls.faces.push([a, b, c]),
            _ if wall[start] < 0 => walls.water.push(corners),
            _ => {
                walls.outlines.push(corners);
                walls.endless.push(endless[start] != 0);
            }
        }
        start += group.len();
    }
    walls
}

/// The view, where it is left to the frame: onto the plane in which everything lies.
fn settled(view: View, frame: &Frame) -> View {
    if view != View::Auto {
        return view;
    }
    let position = frame.vectors(Kind::Grain, "position");
    let flat = |axis: usize| position.windows(2).all(|p| p[0][axis] == p[1][axis]);
    // A lone grain lies in every plane; faces tell that it lies in space.
    let solid = frame.integers(Kind::Surface, "face").iter().any(|face| *face != 0);
    match () {
        () if solid => View::Slant,
        // Up is z wherever the plane allows it.
        () if flat(1) => View::Side,
        () if flat(2) => View::Front,
        () => View::Slant,
    }
}

fn turned(view: View) -> impl Fn([f64; 3]) -> [f64; 3] {
    let (sin_a, cos_a) = 30.0_f64.to_radians().sin_cos();
    let (sin_e, cos_e) = 18.0_f64.to_radians().sin_cos();
    move |[x, y, z]| match view {
        View::Side => [x, z, -y],
        View::Slant => {
            let right = x * cos_a + y * sin_a;
            let away = -x * sin_a + y * cos_a;
            [right, z * cos_e + away * sin_e, z * sin_e - away * cos_e]
        }
        View::Auto | View::Front => [x, y, z],
    }
}
