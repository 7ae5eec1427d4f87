//! Columns of grains as one number a grain: what can be shown by colour.

use tsubu_frame::{Column, Frame, Kind, Values};

/// What the axes of a vector are called behind the name of its column.
const AXES: [&str; 3] = [" x", " y", " z"];

/// A number a grain with its unit, under a name.
pub struct Paint {
    /// The column's name; of a vector its size, and its components with ` x`, ` y`, ` z` behind.
    pub name: String,
    /// SI unit, `-` for none.
    pub unit: &'static str,
}

/// What grains of a frame can be coloured by.
pub fn paints(frame: &Frame) -> Vec<Paint> {
    let rows = frame.rows(Kind::Grain);
    let mut paints = Vec::new();
    for Column { name, unit, values, .. } in frame.of(Kind::Grain).filter(|column| column.values.len() == rows) {
        let mut add = |ending: &str| paints.push(Paint { name: format!("{name}{ending}"), unit });
        match values {
            Values::Scalar(_) | Values::Integer(_) => add(""),
            Values::Vector(_) => ["", AXES[0], AXES[1], AXES[2]].into_iter().for_each(add),
            Values::Quaternion(_) => {}
        }
    }
    paints
}

/// The numbers of that name; nothing if there are none.
pub fn values(frame: &Frame, name: &str) -> Option<Vec<f64>> {
    if let Some(column) = frame.column(Kind::Grain, name) {
        return match &column.values {
            Values::Scalar(v) => Some(v.clone()),
            Values::Integer(v) => Some(v.iter().map(|&x| x as f64).collect()),
            Values::Vector(v) => Some(v.iter().map(|x| x.iter().map(|c| c * c).sum::<f64>().sqrt()).collect()),
            Values::Quaternion(_) => None,
        };
    }
    let (axis, column) = AXES.iter().enumerate().find_map(|(axis, ending)| Some((axis, name.strip_suffix(ending)?)))?;
    match &frame.column(Kind::Grain, column)?.values {
        Values::Vector(v) => Some(v.iter().map(|x| x[axis]).collect()),
        _ => None,
    }
}

/// Lowest value, and the highest; where that is far beyond what all but a hundredth stay below, that.
pub fn range(values: &[f64]) -> Option<[f64; 2]> {
    let mut known: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    let (&low, &highest) = (known.first()?, known.last()?);
    let most = known[known.len() - 1 - known.len() / 100];
    Some([low, if highest > 2.0 * most && most > 0.0 { most } else { highest }])
}
