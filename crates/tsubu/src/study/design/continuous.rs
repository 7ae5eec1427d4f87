//! Keys of a design that vary continuously: so many values that steps between them do not count.

use crate::study::ranges::Range;
use std::collections::BTreeMap;
use toml::Value;
use tsubu_scene::range::ends;

/// Combinations that all of them together may have.
const COMBINATIONS: f64 = 4096.0;
/// Values of one, at most and at least.
const VALUES: [usize; 2] = [65, 5];
/// Neighbours are so many steps of a range apart: nearer ones would be all but the same.
const STEPS: usize = 16;

/// Puts values in the place of ranges without steps: as many for each as keep all combinations within bounds. Gives how many values on a
/// neighbour is, key by key; in words why that cannot be.
pub(super) fn lay_out(vary: &mut BTreeMap<String, Vec<Value>>) -> Result<Vec<usize>, String> {
    let continuous = vary.values().filter(|values| ends(values).is_some()).count();
    let listed: usize = vary.values().filter(|values| ends(values).is_none()).map(Vec::len).product();
    let fit = (COMBINATIONS / listed as f64).powf(1.0 / continuous.max(1) as f64).floor() as usize;
    if continuous > 0 && fit < VALUES[1] {
        return Err(format!(
            "`design.vary` has {continuous} keys that vary continuously beside {listed} combinations of lists, more than can be looked \
             through: list fewer values, or give ranges a `step`"
        ));
    }
    let mut strides = Vec::new();
    for (key, values) in vary.iter_mut() {
        let mut stride = 1;
        if ends(values).is_some() {
            let range = Range::new("design", key, values)?;
            let number = fit.min(VALUES[0]);
            *values = (0..number).map(|i| range.typed(i as f64 / (number - 1) as f64)).collect();
            // Of whole numbers there may be fewer.
            values.dedup();
            stride = ((values.len() - 1) / STEPS).max(1);
        }
        strides.push(stride);
    }
    Ok(strides)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn varied(keys: &[&str]) -> BTreeMap<String, Vec<Value>> {
        let range = |text: &&str| vec![Value::Table(text.parse().expect("a range"))];
        keys.iter().enumerate().map(|(index, text)| (format!("key-{index}"), range(text))).collect()
    }

    /// A range has 65 values, 1/64 of it apart, of lengths that differ by a factor of ten or more by their logarithm; whole numbers have their own;
    /// three together have 16 each. Lists stay. Control: a list of 1000 leaves no room for one.
    #[test]
    fn a_range_has_as_many_values_as_fit() {
        let mut vary = varied(&["from = '60 mm'\nto = '124 mm'", "from = 1\nto = 9"]);
        assert_eq!(lay_out(&mut vary), Ok(vec![3, 1]));
        assert_eq!((vary["key-0"].len(), &vary["key-0"][1], vary["key-1"].len()), (64, &"61.0159 mm".into(), 9));
        let mut vary = varied(&["from = '60 mm'\nto = '124 mm'"]);
        assert_eq!((lay_out(&mut vary), &vary["key-0"][64]), (Ok(vec![4]), &"124 mm".into()));
        assert_eq!(vary["key-0"][1], "61 mm".into());
        let mut vary = varied(&["from = '1 mm'\nto = '100 mm'"]);
        assert_eq!((lay_out(&mut vary), &vary["key-0"][32]), (Ok(vec![4]), &"10 mm".into()));
        let mut vary = varied(&["from = 0.1\nto = 0.2"; 3]);
        assert_eq!((lay_out(&mut vary), vary["key-2"].len()), (Ok(vec![1; 3]), 15));
        vary = varied(&["from = 0.1\nto = 0.2"]);
        vary.insert("names".to_owned(), vec![Value::from("steel"); 1000]);
        assert!(lay_out(&mut vary).is_err_and(|told| told.contains("give ranges a `step`")));
    }
}
