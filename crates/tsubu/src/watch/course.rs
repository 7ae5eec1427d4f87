//! The course of one grain between touches of the bed: contact, flight, contact.

use glam::DVec3;

/// A grain at a look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// When [s].
    pub time: f64,
    /// Centre, as if the world did not repeat [m].
    pub place: DVec3,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Spin [rad/s].
    pub spin: DVec3,
    /// The deepest of its contacts with the bed.
    pub touch: Option<Touch>,
}

/// A contact with the bed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// From the grain to the bed.
    pub normal: DVec3,
    /// Overlap [m].
    pub overlap: f64,
    /// Velocity of the bed [m/s].
    pub bed: DVec3,
}

/// Which way is up, and along which way hops are long.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sense {
    /// Unit vector across the bed.
    pub up: DVec3,
    /// Unit vector along the bed.
    pub along: DVec3,
}

/// A finished hop, and the contact it began with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hop {
    /// Take-off [s].
    pub start: f64,
    /// From take-off to the next touch [s].
    pub flight: f64,
    /// Way along [m].
    pub length: f64,
    /// Highest centre above that at take-off [m].
    pub height: f64,
    /// Below the plane of the bed, at the impact before take-off [rad].
    pub angle: f64,
    /// At the impact, against the bed [m/s].
    pub impact: f64,
    /// At take-off [m/s].
    pub rebound: f64,
    /// Normal speed at take-off over that at the impact [-].
    pub restitution: f64,
    /// From touch to take-off [s].
    pub contact: f64,
    /// Largest of the contact [m].
    pub overlap: f64,
    /// At the impact [rad/s].
    pub spin: DVec3,
}

/// What is known of a grain's way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Phase {
    /// Nobody has looked yet.
    #[default]
    New,
    /// Off the bed, and nobody has seen it leave.
    Adrift,
    /// On the bed.
    Touching,
    /// Off the bed.
    Flying,
}

const PHASES: [Phase; 4] = [Phase::New, Phase::Adrift, Phase::Touching, Phase::Flying];

/// Numbers of a course in a checkpoint.
pub(super) const NUMBERS: usize = 33;

/// What the next look needs to know. Impacts that nobody has seen are not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    pub phase: Phase,
    // The last look.
    time: f64,
    place: DVec3,
    velocity: DVec3,
    spin: DVec3,
    // The contact that goes on, or the one before the flight.
    begun: f64,
    angle: f64,
    impact: f64,
    closing: f64,
    overlap: f64,
    turned: DVec3,
    // Its state at the last look at which it was there.
    normal: DVec3,
    depth: f64,
    bed: DVec3,
    // The flight.
    start: f64,
    from: DVec3,
    left: DVec3,
    top: f64,
}

impl Default for Course {
    fn default() -> Self {
        Self::from_numbers(0, &[f64::NAN; NUMBERS])
    }
}

/// Time that a speed needs for a way, at least zero and at most `longest`.
fn needs(way: f64, speed: f64, longest: f64) -> f64 {
    if speed > 0.0 { (way / speed).min(longest) } else { longest }
}

impl Course {
    /// Takes a look; gives the hop that has ended since the last one.
    pub fn look(&mut self, now: &Seen, sense: &Sense) -> Option<Hop> {
        let mut ended = None;
        self.phase = match (self.phase, now.touch) {
            (Phase::New | Phase::Adrift, None) => Phase::Adrift,
            (Phase::New, Some(touch)) => {
                (self.begun, self.angle, self.impact, self.closing) = (f64::NAN, f64::NAN, f64::NAN, f64::NAN);
                (self.turned, self.overlap) = (DVec3::NAN, touch.overlap);
                self.keep(touch)
            }
            (Phase::Touching, Some(touch)) => {
                self.overlap = self.overlap.max(touch.overlap);
                self.keep(touch)
            }
            (Phase::Touching, None) => self.take_off(now, sense),
            (Phase::Flying, None) => {
                self.climb(now, sense);
                Phase::Flying
            }
            (Phase::Adrift | Phase::Flying, Some(touch)) => {
                // How fast it closed before the contact began to slow it down tells when that was.
                let closing = (self.velocity - touch.bed).dot(touch.normal);
                let time = now.time - needs(touch.overlap, closing, now.time - self.time);
                if self.phase == Phase::Flying {
                    ended = Some(self.land(now, time, sense));
                }
                let fall = self.velocity - touch.bed;
                let down = -fall.dot(sense.up);
                self.begun = time;
                self.angle = down.atan2((fall + down * sense.up).length());
                (self.impact, self.closing) = (fall.length(), closing);
                (self.turned, self.overlap) = (self.spin, touch.overlap);
                self.keep(touch)
            }
        };
        (self.time, self.place, self.velocity, self.spin) = (now.time, now.place, now.velocity, now.spin);
        ended
    }

    fn keep(&mut self, touch: Touch) -> Phase {
        (self.normal, self.depth, self.bed) = (touch.normal, touch.overlap, touch.bed);
        Phase::Touching
    }

    /// Where it was at a time between the last look and this one.
    fn between(&self, now: &Seen, time: f64) -> DVec3 {
        self.place.lerp(now.place, (time - self.time) / (now.time - self.time))
    }

    fn take_off(&mut self, now: &Seen, sense: &Sense) -> Phase {
        let leaving = -(now.velocity - self.bed).dot(self.normal);
        self.start = self.time + needs(self.depth, leaving, now.time - self.time);
        self.from = self.between(now, self.start);
        self.top = now.place.dot(sense.up).max(self.from.dot(sense.up));
        self.left = now.velocity - self.bed;
        Phase::Flying
    }

    /// The highest point may lie between two looks: even gravity makes a parabola.
    fn climb(&mut self, now: &Seen, sense: &Sense) {
        let (before, after) = (self.velocity.dot(sense.up), now.velocity.dot(sense.up));
        let mut top = now.place.dot(sense.up);
        if before > 0.0 && after <= 0.0 {
            let crest = 0.5 * before * before / (before - after) * (now.time - self.time);
            top = top.max(self.place.dot(sense.up) + crest);
        }
        self.top = self.top.max(top);
    }

    fn land(&self, now: &Seen, time: f64, sense: &Sense) -> Hop {
        let place = self.between(now, time);
        let leaving = -self.left.dot(self.normal);
        Hop {
            start: self.start,
            flight: time - self.start,
            length: (place - self.from).dot(sense.along),
            height: self.top.max(place.dot(sense.up)) - self.from.dot(sense.up),
            angle: self.angle,
            impact: self.impact,
            rebound: self.left.length(),
            restitution: if self.closing > 0.0 { leaving / self.closing } else { f64::NAN },
            contact: self.start - self.begun,
            overlap: self.overlap,
            spin: self.turned,
        }
    }

    /// As plain numbers, for a checkpoint; the phase goes apart.
    pub fn numbers(&self) -> [f64; NUMBERS] {
        let mut numbers = [0.0; NUMBERS];
        let single = [
            self.time,
            self.begun,
            self.angle,
            self.impact,
            self.closing,
            self.overlap,
            self.depth,
            self.start,
            self.top,
        ];
        let vectors = [self.place, self.velocity, self.spin, self.turned, self.normal, self.bed, self.from, self.left];
        let all = single.into_iter().chain(vectors.iter().flat_map(DVec3::to_array));
        for (number, value) in numbers.iter_mut().zip(all) {
            *number = value;
        }
        numbers
    }

    /// Back from [`Course::numbers`].
    pub fn from_numbers(phase: usize, n: &[f64; NUMBERS]) -> Self {
        let vector = |k: usize| DVec3::from_slice(&n[9 + 3 * k..12 + 3 * k]);
        Self {
            phase: PHASES.get(phase).copied().unwrap_or_default(),
            time: n[0],
            begun: n[1],
            angle: n[2],
            impact: n[3],
            closing: n[4],
            overlap: n[5],
            depth: n[6],
            start: n[7],
            top: n[8],
            place: vector(0),
            velocity: vector(1),
            spin: vector(2),
            turned: vector(3),
            normal: vector(4),
            bed: vector(5),
            from: vector(6),
            left: vector(7),
        }
    }
}
