//! Frames with their numbers rounded to 8 or 16 bits: each as what it differs by from the one before it, which packs well.

use std::collections::BTreeMap;

use serde_json::{Value, json};

/// How finely the numbers of an array are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// In 254 steps.
    Eight,
    /// In 65534 steps.
    Sixteen,
}

impl Bits {
    /// The highest whole number; it stands for what is no number.
    const fn most(self) -> u16 {
        match self {
            Self::Eight => 0xff,
            Self::Sixteen => 0xffff,
        }
    }
}

/// An array of a moment.
#[derive(Clone, Debug)]
pub struct Array {
    /// Its name.
    pub name: String,
    /// Numbers a row: 1, or 3 for vectors.
    pub width: usize,
    /// How finely.
    pub bits: Bits,
    /// The numbers, row by row.
    pub values: Vec<f32>,
}

/// A moment.
#[derive(Clone, Debug, Default)]
pub struct Moment {
    /// What its head says beside its arrays.
    pub head: Value,
    /// Its arrays.
    pub arrays: Vec<Array>,
}

/// Moments as bytes, and the head that tells what they are: scales of the arrays, and a list of frames.
pub fn pack(moments: &[Moment]) -> (Value, Vec<u8>) {
    let scales = scales(moments);
    let mut bytes = Vec::new();
    let mut before: BTreeMap<&str, Vec<u16>> = BTreeMap::new();
    let frames: Vec<Value> = moments
        .iter()
        .map(|moment| {
            let mut now = BTreeMap::new();
            let mut told = Vec::new();
            for array in &moment.arrays {
                let values = rounded(array, &scales[&array.name]);
                told.push(add(array, &values, before.get(array.name.as_str()), &mut bytes));
                now.insert(array.name.as_str(), values);
            }
            before = now;
            let mut head = moment.head.clone();
            head["arrays"] = told.into();
            head
        })
        .collect();
    (json!({ "scales": scales, "frames": frames }), bytes)
}

/// Lowest and highest number of each array of the same name, for vectors along each axis.
fn scales(moments: &[Moment]) -> BTreeMap<String, Vec<[f32; 2]>> {
    let mut scales: BTreeMap<String, Vec<[f32; 2]>> = BTreeMap::new();
    for Array { name, width, values, .. } in moments.iter().flat_map(|moment| &moment.arrays) {
        let scale = scales.entry(name.clone()).or_insert_with(|| vec![[f32::INFINITY, f32::NEG_INFINITY]; *width]);
        for (place, x) in values.iter().enumerate().filter(|(_, x)| x.is_finite()) {
            let [low, high] = scale[place % width];
            scale[place % width] = [low.min(*x), high.max(*x)];
        }
    }
    // An array without a number has no scale of its own, and JSON no infinity.
    let known = |[low, high]: [f32; 2]| if low <= high { [low, high] } else { [0.0, 0.0] };
    scales.into_iter().map(|(name, scale)| (name, scale.into_iter().map(known).collect())).collect()
}

/// The numbers of an array as steps between the ends of its scale, axis after axis.
fn rounded(array: &Array, scale: &[[f32; 2]]) -> Vec<u16> {
    let Array { width, bits, values, .. } = array;
    let most = bits.most();
    let step = |axis: usize, x: f32| {
        let [low, high] = scale[axis];
        let share = if high > low { (f64::from(x) - f64::from(low)) / (f64::from(high) - f64::from(low)) } else { 0.0 };
        if x.is_finite() { (share * f64::from(most - 1)).round() as u16 } else { most }
    };
    (0..*width).flat_map(|axis| values.iter().skip(axis).step_by(*width).map(move |x| step(axis, *x))).collect()
}

/// Adds the bytes of an array and tells of them: nothing where it is as before, else what it differs by; of 16 bits the lower
/// halves, then the higher.
fn add(array: &Array, values: &[u16], before: Option<&Vec<u16>>, bytes: &mut Vec<u8>) -> Value {
    let bits = if array.bits == Bits::Eight { 8 } else { 16 };
    let before = before.filter(|before| before.len() == values.len());
    let same = before.is_some_and(|before| before == values);
    if !same {
        let differences = || {
            let earlier = before.into_iter().flatten().copied().chain(std::iter::repeat(0));
            values.iter().zip(earlier).map(|(now, earlier)| now.wrapping_sub(earlier))
        };
        bytes.extend(differences().map(|d| d as u8));
        if array.bits == Bits::Sixteen {
            bytes.extend(differences().map(|d| (d >> 8) as u8));
        }
    }
    json!({ "name": array.name, "bits": bits, "length": values.len(), "same": same })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_as_before_takes_no_bytes_and_nothing_is_off_by_more_than_half_a_step() {
        let array = |name: &str, bits, values: Vec<f32>| Array { name: name.into(), width: 1, bits, values };
        let moment = |x: f32| Moment {
            head: json!({ "time": 0.5 }),
            arrays: vec![
                array("radius", Bits::Eight, vec![1.0, 2.0, f32::NAN]),
                array("place", Bits::Sixteen, vec![x, -3.0, 5.0]),
            ],
        };
        let (head, bytes) = pack(&[moment(1.0), moment(1.5)]);
        // Three bytes and three pairs, then three pairs alone.
        assert_eq!(bytes.len(), 3 + 6 + 6);
        assert_eq!(
            (&head["frames"][0]["arrays"][0]["same"], &head["frames"][1]["arrays"][0]["same"]),
            (&json!(false), &json!(true))
        );
        assert_eq!(head["scales"]["place"][0], json!([-3.0, 5.0]));
        assert_eq!(bytes[2], 0xff, "what is no number");
        let at = |place: usize| u16::from(bytes[place]) | u16::from(bytes[place + 3]) << 8;
        let read = |steps: u16| -3.0 + 8.0 * f64::from(steps) / 65534.0;
        assert!((read(at(3)) - 1.0).abs() <= 4.0 / 65534.0);
        assert!((read(at(3).wrapping_add(at(9))) - 1.5).abs() <= 4.0 / 65534.0);
    }
}
