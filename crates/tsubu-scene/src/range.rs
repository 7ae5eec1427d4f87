//! Ranges of values: from one to another in steps, or everything between.

use toml::{Table, Value};

/// More values than these are a slip in the step.
const MOST: f64 = 10_000.0;

/// A number, and what stands behind it: 6 and `mm` of `"6 mm"`. `None` for what is no number.
pub fn number(value: &Value) -> Option<(f64, &str)> {
    match value {
        Value::Integer(x) => Some((*x as f64, "")),
        Value::Float(x) => Some((*x, "")),
        Value::String(text) => {
            let text = text.trim();
            let end =
                (1..=text.len()).rev().find(|end| text.get(..*end).is_some_and(|part| part.parse::<f64>().is_ok()))?;
            Some((text[..end].parse().ok()?, text[end..].trim()))
        }
        _ => None,
    }
}

/// The value of that size, written as the ends of its range are: a whole number, or a number with this unit behind it.
pub fn value(size: f64, unit: &str, whole: bool) -> Value {
    match (whole, unit) {
        (true, _) => Value::Integer(size.round() as i64),
        (_, "") => Value::Float(size),
        _ => format!("{size} {unit}").into(),
    }
}

/// Both ends of `[{ from, to }]`, which is how a range without steps stands in a plan; `None` for a list of values.
pub fn ends(values: &[Value]) -> Option<[Value; 2]> {
    let [Value::Table(range)] = values else { return None };
    let end = |name: &str| range.get(name).cloned();
    if range.len() == 2 { Some([end("from")?, end("to")?]) } else { None }
}

/// The values of `{ from, to, step }`, or `[{ from, to }]` where there is no step; in words why it is no range.
pub(crate) fn listed(range: &Table) -> Result<Vec<Value>, String> {
    let end = |name: &str| range.get(name).ok_or_else(|| format!("a range needs `{name}`"));
    if let Some(extra) = range.keys().find(|key| !["from", "to", "step"].contains(&key.as_str())) {
        return Err(format!("a range has no `{extra}`"));
    }
    let [from, to] = [end("from")?, end("to")?];
    let all: Vec<&Value> = [from, to].into_iter().chain(range.get("step")).collect();
    let numbers: Option<Vec<(f64, &str)>> = all.iter().map(|value| number(value)).collect();
    let Some(numbers) = numbers else { return Err("the ends and the step of a range are numbers".to_owned()) };
    let (low, unit) = numbers[0];
    let high = numbers[1].0;
    if let Some((_, other)) = numbers.iter().find(|(_, other)| *other != unit) {
        return Err(format!("a range has one unit, not `{unit}` and `{other}`"));
    }
    if low >= high || !(high - low).is_finite() {
        return Err(format!("{low} is not below {high}"));
    }
    let Some((step, _)) = numbers.get(2) else {
        let ends = [("from", from), ("to", to)].map(|(name, value)| (name.to_owned(), value.clone()));
        return Ok(vec![Value::Table(ends.into_iter().collect())]);
    };
    let steps = (high - low) / step;
    if !(*step > 0.0 && steps < MOST) {
        return Err(format!("steps of {step} do not lead from {low} to {high} in fewer than {MOST}"));
    }
    let whole = all.iter().all(|value| value.is_integer());
    // 0.85 + 7 * 0.01 is 0.9199999999999999; nobody means that.
    let tidy = |x: f64| format!("{x:.12e}").parse().unwrap_or(x);
    Ok((0..=(steps + 1e-9) as usize).map(|i| value(tidy(low + i as f64 * step), unit, whole)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(text: &str) -> Table {
        text.parse().expect("a table")
    }

    #[test]
    fn a_range_in_steps_is_a_list() {
        let listed = |text: &str| listed(&range(text)).expect("a range");
        assert_eq!(listed("from = 5\nto = 16\nstep = 5"), [5.into(), 10.into(), 15.into()] as [Value; 3]);
        assert_eq!(listed("from = 0.85\nto = 0.88\nstep = 0.01"), [0.85, 0.86, 0.87, 0.88].map(Value::from));
        let lengths = listed("from = '6 mm'\nto = '6.5 mm'\nstep = '.25 mm'");
        assert_eq!(lengths, ["6 mm", "6.25 mm", "6.5 mm"].map(Value::from));
        assert_eq!(ends(&lengths), None);
        let open = listed("from = '6 mm'\nto = '9 mm'");
        assert_eq!(ends(&open), Some(["6 mm".into(), "9 mm".into()]));
    }

    #[test]
    fn what_is_no_range_is_said() {
        for (text, said) in [
            ("from = 1", "needs `to`"),
            ("from = 1\nto = 3\nsteps = 2", "has no `steps`"),
            ("from = '1 mm'\nto = '1 cm'", "one unit"),
            ("from = 3\nto = 3", "3 is not below 3"),
            ("from = 1\nto = 3\nstep = 0", "do not lead"),
            ("from = 'steel'\nto = 'glass'", "are numbers"),
        ] {
            let told = listed(&range(text)).expect_err("no range");
            assert!(told.contains(said), "{told}");
        }
    }
}
