//! Features that may touch now, of many pairs of bodies in a row.
//!
//! Corners are looked at one by one. Edges that cross are many of a kind, and go side by side, see `crossing.rs`.

use super::Turned;
use super::contact::{Contact, edges_of};
use super::crossing::Crossings;
use super::near::{Near, Sleeper};
use super::touch::Cut;
use glam::DVec3;

/// Two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Couple {
    /// Number of the pair in the list.
    pub pair: u32,
    /// Local numbers.
    pub bodies: [u32; 2],
    /// From the centre of the first to that of the second [m].
    pub apart: DVec3,
    /// How far both have gone [m].
    pub path: f64,
}

/// A pair of features.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    couple: u32,
    /// Where it is among those that are near.
    sleeper: u32,
}

/// The features that may touch, in order.
#[derive(Clone, Debug, Default)]
pub struct Awake {
    couples: Vec<Couple>,
    /// These, and room for more.
    rows: Vec<Row>,
    count: usize,
    crossings: Crossings,
    /// How far rows are from being contacts at least [m]; below 0 of contacts.
    gaps: Vec<f64>,
    /// What a look at two bodies finds.
    pub(super) found: Vec<Contact>,
}

/// Rows that are worked on together, at most.
const TOGETHER: usize = 64;

impl Awake {
    /// Whether it is time to look.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.count >= TOGETHER
    }

    /// Adds those features of two bodies that do not sleep, of some that lie from `first` on.
    #[inline]
    pub(super) fn add(&mut self, couple: Couple, first: u32, sleepers: &[Sleeper]) {
        if self.rows.len() < self.count + sleepers.len() + 1 {
            self.rows.resize(2 * (self.count + sleepers.len() + 1), Row::default());
        }
        let rows = &mut self.rows[self.count..];
        let (mut awake, number) = (0, self.couples.len() as u32);
        // Without a branch: a processor cannot guess who sleeps.
        for (k, sleeper) in (first..).zip(sleepers) {
            rows[awake] = Row { couple: number, sleeper: k };
            awake += usize::from(sleeper.is_awake(couple.path));
        }
        self.count += awake;
        self.couples.push(couple);
    }

    /// Appends where those that were added touch, or are nearer than `reach` [m], in their order, and forgets them; tells whose each contact is. `seen` are the bodies by local number.
    pub fn touch(
        &mut self,
        near: &mut Near,
        (seen, reach): (&[Turned], f64),
        contacts: &mut Vec<Contact>,
        mut tell: impl FnMut(&Couple),
    ) {
        let mut first = 0;
        while first < self.count {
            let begin = contacts.len();
            let end = self.fill(first, near, (seen, reach), contacts);
            self.crossings.find();
            let Self { couples, rows, crossings, gaps, .. } = self;
            let cut = |couple: &Couple| Cut::of(couple.bodies.map(|body| &seen[body as usize]), reach);
            for r in 0..crossings.rows() {
                let at = crossings.name[r] as usize;
                let couple = &couples[rows[first + at].couple as usize];
                gaps[at] = crossings.contact(r, cut(couple).distance(), &mut contacts[begin + at]);
            }
            let mut kept = begin;
            for (k, (row, gap)) in (begin..).zip(rows[first..end].iter().zip(gaps)) {
                let couple = &couples[row.couple as usize];
                if *gap < 0.0 {
                    if kept < k {
                        contacts[kept] = contacts[k];
                    }
                    kept += 1;
                    tell(couple);
                } else {
                    near.features[row.sleeper as usize].sleep(couple.path, *gap, cut(couple).radii);
                }
            }
            contacts.truncate(kept);
            first = end;
        }
        self.couples.clear();
        self.count = 0;
    }

    /// Looks at corners, and puts edges side by side, from a row on; each row is a contact more. Returns how far it came.
    fn fill(
        &mut self,
        first: usize,
        near: &mut Near,
        (seen, reach): (&[Turned], f64),
        contacts: &mut Vec<Contact>,
    ) -> usize {
        let Self { couples, rows, count, crossings, gaps, .. } = self;
        crossings.clear();
        gaps.clear();
        for row in &rows[first..*count] {
            if crossings.is_full() || gaps.len() == TOGETHER {
                break;
            }
            let couple = &couples[row.couple as usize];
            let [a, b] = couple.bodies.map(|body| &seen[body as usize]);
            let cut = Cut::of([a, b], reach);
            let sleeper = &mut near.features[row.sleeper as usize];
            let feature = sleeper.feature;
            let mut gap = -1.0;
            if let Some([p, q]) = edges_of(feature) {
                let name = gaps.len() as u32;
                crossings.push((name, feature), [a.ends_of_edge(p), b.ends_of_edge(q)], couple.apart, cut.radii);
                contacts.push(Contact::default());
            } else {
                let found = cut.corner([a, b], couple.apart, feature, |core, point| {
                    sleeper.distance(couple.path, core, point, cut.distance())
                });
                contacts.push(found.unwrap_or_else(|apart| {
                    gap = apart;
                    Contact::default()
                }));
            }
            gaps.push(gap);
        }
        first + gaps.len()
    }
}
