//! Damage to a text or to bytes that needs no knowledge of what they say.

use crate::draw::Draw;
use crate::nasty;

/// The bytes with one damage; `other` gives pieces to splice in.
pub fn bytes(draw: &mut Draw, bytes: &[u8], other: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    if out.is_empty() {
        return other.to_vec();
    }
    let at = draw.below(out.len());
    let end = (at + 1 + draw.below(40)).min(out.len());
    match draw.below(8) {
        0 => out.truncate(at),
        1 => out[at] ^= 1 << draw.below(8),
        2 => out[at] = draw.whole() as u8,
        3 => drop(out.drain(at..end)),
        4 => {
            let piece = out[at..end].to_vec();
            out.splice(at..at, piece);
        }
        5 if !other.is_empty() => {
            let from = draw.below(other.len());
            let to = (from + 1 + draw.below(200)).min(other.len());
            out.splice(at..end, other[from..to].iter().copied());
        }
        6 => {
            let value = nasty::text(draw);
            out.splice(at..end, value.bytes());
        }
        _ => out = lines(draw, &out, other),
    }
    out
}

/// The same line by line.
pub fn lines(draw: &mut Draw, bytes: &[u8], other: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    let others: Vec<&[u8]> = other.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return other.to_vec();
    }
    let (at, to) = (draw.below(lines.len()), draw.below(lines.len()));
    match draw.below(4) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(to, lines[at]),
        2 => lines.swap(at, to),
        _ if others.is_empty() => lines.truncate(at),
        _ => lines[at] = others[draw.below(others.len())],
    }
    lines.concat()
}

/// A text that means the same: other line ends, a mark at the beginning.
pub fn same_text(draw: &mut Draw, text: &str) -> String {
    match draw.below(3) {
        0 => text.replace('\n', "\r\n"),
        1 => format!("\u{feff}{text}"),
        _ => format!("\n{text}\n\n"),
    }
}
