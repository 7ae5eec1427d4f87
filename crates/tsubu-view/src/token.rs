//! The secret in the address: who does not know it is shown nothing.

use std::fmt::Write as _;

use crate::ViewError;

/// 128 random bits as 32 hexadecimal digits.
pub fn draw() -> Result<String, ViewError> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|_| ViewError::Random)?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

/// Whether two tokens are the same, in a time that does not tell how much of them is.
pub fn same(one: &str, other: &str) -> bool {
    let differ = one.bytes().zip(other.bytes()).fold(0, |all, (a, b)| all | (a ^ b));
    one.len() == other.len() && differ == 0
}
