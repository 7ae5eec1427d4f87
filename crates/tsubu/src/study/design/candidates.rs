//! What a design may be: every combination of the values that it may take, within its limits.

use super::limits::Limits;
use crate::study::cases::{Case, cases};
use rayon::prelude::*;
use tsubu_scene::plan::Design;
use tsubu_scene::{Plan, Scene};

/// More combinations than these are not looked through.
pub(super) const MOST: usize = 20_000;

/// All combinations that can be, in the order of [`cases`].
pub(super) struct Candidates {
    /// Those within the limits.
    pub list: Vec<Candidate>,
    /// The limits, with those that are beyond them.
    pub limits: Limits,
    /// How many are no scene, and what the first of them is told.
    pub wrong: usize,
    pub first_wrong: Option<String>,
    /// Numbers of values, key by key.
    pub values: Vec<usize>,
    /// Whether these have an order.
    ordered: Vec<bool>,
    /// How many values on a neighbour is, where they have one.
    strides: Vec<usize>,
}

/// A combination.
pub(super) struct Candidate {
    pub case: Case,
    pub plan: Plan,
    /// Which value of each key.
    pub digits: Vec<usize>,
    /// Where it is for the surrogate: from 0 to 1 along keys whose values have an order, a corner for each value of others.
    pub place: Vec<f64>,
}

impl Candidates {
    /// Reads all combinations of a scene.
    pub fn new(scene: &Scene, wanted: &Design, strides: Vec<usize>) -> Self {
        let values: Vec<usize> = wanted.vary.values().map(Vec::len).collect();
        let ordered: Vec<bool> = wanted.vary.values().map(|list| list.iter().all(has_order)).collect();
        let read: Vec<(usize, Case, Result<Plan, String>)> = cases(&wanted.vary)
            .into_par_iter()
            .enumerate()
            .map(|(index, case)| {
                let plan = case.scene(scene).map(|scene| scene.plan().clone());
                let told =
                    |wrong: tsubu_scene::Complaints| wrong.to_string().lines().next().unwrap_or_default().to_owned();
                (index, case, plan.map_err(told))
            })
            .collect();
        let mut candidates = Self {
            list: Vec::new(),
            limits: Limits::new(wanted),
            wrong: 0,
            first_wrong: None,
            values,
            ordered,
            strides,
        };
        for (index, case, plan) in read {
            let known = plan.and_then(|plan| Ok((candidates.limits.needs(&case.name, &plan, wanted)?, plan)));
            match known {
                Err(told) => {
                    candidates.wrong += 1;
                    candidates.first_wrong.get_or_insert_with(|| format!("`{}`: {told}", case.name));
                }
                Ok((needs, _)) if !candidates.limits.hold(&needs) => candidates.limits.beyond.push(needs),
                Ok((_, plan)) => {
                    let digits = digits(index, &candidates.values);
                    let place = place(&digits, &candidates.values, &candidates.ordered);
                    candidates.list.push(Candidate { case, plan, digits, place });
                }
            }
        }
        candidates
    }

    /// Why none of so many combinations can be.
    pub fn none(&self, number: usize) -> String {
        let wrong = self.first_wrong.as_ref().map(|first| match self.limits.beyond.len() {
            0 => format!("each is wrong; the first, {first}"),
            _ => format!("{} are wrong, the first, {first}", self.wrong),
        });
        let beyond = (!self.limits.beyond.is_empty()).then(|| self.limits.told());
        let why: Vec<String> = beyond.into_iter().chain(wrong).collect();
        format!("none of the {number} combinations of `design.vary` can be: {}", why.join("; "))
    }

    /// Candidates with one key a step on; of a key whose values have no order, with any other.
    pub fn neighbours(&self, of: usize) -> Vec<usize> {
        let own = &self.list[of].digits;
        let one_on = |other: &usize| {
            let other = &self.list[*other].digits;
            let mut differ = (0..own.len()).filter(|key| own[*key] != other[*key]);
            let (Some(key), None) = (differ.next(), differ.next()) else { return false };
            let (stride, last) = (self.strides[key], self.values[key] - 1);
            // Beyond the end is the end.
            let steps = [own[key].saturating_sub(stride), (own[key] + stride).min(last)];
            !self.ordered[key] || steps.contains(&other[key])
        };
        (0..self.list.len()).filter(one_on).collect()
    }

    /// The candidate that is farthest from all of these, with that distance [steps]; of equals the first, and none where all are among
    /// these.
    pub fn farthest(&self, from: &[usize]) -> Option<(usize, f64)> {
        let nearest = |index: usize| {
            let own = &self.list[index].digits;
            let squares = from.iter().map(|other| self.apart(own, &self.list[*other].digits));
            squares.fold(f64::INFINITY, f64::min)
        };
        let open = (0..self.list.len()).map(|index| (index, nearest(index))).filter(|(_, near)| *near > 0.0);
        let farthest = open.reduce(|most, one| if one.1 > most.1 { one } else { most });
        farthest.map(|(index, square)| (index, square.sqrt()))
    }

    /// Square of the distance of two combinations, in steps from one neighbour to the next; two names are one apart.
    fn apart(&self, from: &[usize], to: &[usize]) -> f64 {
        let of_key = |key: usize| {
            if self.ordered[key] {
                from[key].abs_diff(to[key]) as f64 / self.strides[key] as f64
            } else {
                f64::from(u8::from(from[key] != to[key]))
            }
        };
        (0..from.len()).map(|key| of_key(key).powi(2)).sum()
    }

    /// So many candidates that lie far from each other, from the one in the middle on: each next is the farthest from those before.
    pub fn spread(&self, number: usize) -> Vec<usize> {
        let distance =
            |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() };
        let middle = vec![0.5; self.list.first().map_or(0, |first| first.place.len())];
        let mut nearest: Vec<f64> = self.list.iter().map(|one| -distance(&one.place, &middle)).collect();
        let mut chosen = Vec::new();
        while chosen.len() < number.min(self.list.len()) {
            let most = |best: usize, other: usize| if nearest[other] > nearest[best] { other } else { best };
            let next = (0..nearest.len()).reduce(most).unwrap_or_default();
            let first = chosen.is_empty();
            chosen.push(next);
            for (near, one) in nearest.iter_mut().zip(&self.list) {
                let to_it = distance(&one.place, &self.list[next].place);
                *near = if first { to_it } else { near.min(to_it) };
            }
        }
        chosen
    }
}

/// Whether a value is a number or a quantity, and no name.
fn has_order(value: &toml::Value) -> bool {
    let digit = |text: &str| text.trim_start_matches(['-', '+', '.']).starts_with(|c: char| c.is_ascii_digit());
    value.is_integer() || value.is_float() || value.as_str().is_some_and(digit)
}

/// Which value of each key a combination has; the last key varies fastest.
fn digits(index: usize, values: &[usize]) -> Vec<usize> {
    let mut left = index;
    let mut digits: Vec<usize> = values
        .iter()
        .rev()
        .map(|number| {
            let digit = left % number;
            left /= number;
            digit
        })
        .collect();
    digits.reverse();
    digits
}

fn place(digits: &[usize], values: &[usize], ordered: &[bool]) -> Vec<f64> {
    let mut place = Vec::new();
    for ((digit, number), ordered) in digits.iter().zip(values).zip(ordered) {
        if *ordered {
            place.push(*digit as f64 / (number - 1).max(1) as f64);
        } else {
            // Corners are one apart, as are the ends of an ordered key.
            place.extend((0..*number).map(|other| if other == *digit { std::f64::consts::FRAC_1_SQRT_2 } else { 0.0 }));
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_count_like_digits() {
        let values = [2, 3];
        let all: Vec<Vec<usize>> = (0..6).map(|index| digits(index, &values)).collect();
        assert_eq!(all, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        assert_eq!(place(&[1, 1], &values, &[true, true]), [1.0, 0.5]);
        let candidates = |ordered: [bool; 2], strides: [usize; 2]| Candidates {
            list: Vec::new(),
            limits: Limits::default(),
            wrong: 0,
            first_wrong: None,
            values: vec![3, 3],
            ordered: ordered.to_vec(),
            strides: strides.to_vec(),
        };
        assert_eq!(candidates([false, true], [1, 1]).apart(&[0, 2], &[2, 2]), 1.0);
        assert_eq!(candidates([true, true], [1, 1]).apart(&[0, 2], &[2, 1]), 5.0);
        assert_eq!(candidates([true, true], [2, 1]).apart(&[0, 2], &[2, 1]), 2.0);
        let corners = [0, 1].map(|digit| place(&[digit, 0], &values, &[false, true]));
        let apart: f64 = corners[0].iter().zip(&corners[1]).map(|(a, b)| (a - b).powi(2)).sum();
        assert!((apart - 1.0).abs() < 1e-12);
        assert!(has_order(&"6 mm".into()) && has_order(&"-.5 m".into()) && has_order(&3.into()));
        assert!(!has_order(&"steel".into()) && !has_order(&true.into()));
    }
}
