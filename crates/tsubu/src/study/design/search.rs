//! Which candidates are measured next.

use super::candidates::Candidates;
use crate::study::surrogate::{Surrogate, expected_improvement};

/// Candidates that are measured before anything is guessed: so many, and so many more a key.
const FIRST: usize = 3;
const FIRST_A_KEY: usize = 2;
/// Candidates of a round: they run side by side, and what is measured must not depend on the number of threads.
const ROUND: usize = 4;

/// Those to begin with.
pub(super) fn first(candidates: &Candidates) -> Vec<usize> {
    candidates.spread(FIRST + FIRST_A_KEY * candidates.values.len())
}

/// Fits what is known, as candidate and value to be low; guesses its logarithm.
pub(super) fn fit(candidates: &Candidates, known: &[(usize, f64)]) -> Option<Surrogate> {
    let places: Vec<Vec<f64>> = known.iter().map(|(index, _)| candidates.list[*index].place.clone()).collect();
    let values: Vec<f64> = known.iter().map(|(_, value)| value.ln()).collect();
    Surrogate::fit(&places, &values)
}

/// Those of a round: where the value is expected to fall farthest below the best, each as if those before it had come out as expected.
/// None where that is less than the share `within`, or all are known. `closed` are not to be asked again.
pub(super) fn next(candidates: &Candidates, known: &[(usize, f64)], closed: &[usize], within: f64) -> Vec<usize> {
    let Some(mut surrogate) = fit(candidates, known) else {
        // One value alone says nothing: take what is far from it.
        let open = candidates.spread(candidates.list.len()).into_iter().filter(|index| !closed.contains(index));
        return open.take(ROUND).collect();
    };
    // The best as the surrogate has it: a lucky measurement is no mark to beat.
    let expected = known.iter().map(|(index, _)| surrogate.at(&candidates.list[*index].place)[0]);
    let best = expected.fold(f64::INFINITY, f64::min);
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < ROUND {
        let open = (0..candidates.list.len()).filter(|index| !closed.contains(index) && !chosen.contains(index));
        let gains = open.map(|index| (index, expected_improvement(surrogate.at(&candidates.list[index].place), best)));
        let Some((index, gain)) = gains.reduce(|most, one| if one.1 > most.1 { one } else { most }) else { break };
        if gain < within {
            break;
        }
        chosen.push(index);
        surrogate = surrogate.believing(&candidates.list[index].place);
    }
    chosen
}
