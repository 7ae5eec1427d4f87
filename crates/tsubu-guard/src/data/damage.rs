//! One damage to a file, and what must come of it.

use super::{File, Format};
use crate::draw::Draw;
use crate::nasty;
use crate::reading::Expect;
use crate::spoil;
use std::ops::Range;

/// Damages the file; where that cannot be done as drawn, it stays whole.
pub fn damage(draw: &mut Draw, file: &mut File) {
    let (change, damaged) = match draw.below(7) {
        0 => ("cut off", cut(draw, file)),
        1 => ("a word misspelt", word(draw, file)),
        2 => ("no number", no_number(draw, file)),
        3 => ("a row too few or too many", row(draw, file)),
        4 => ("a cell too few or too many", cell(draw, file)),
        5 => ("another count", count(draw, file)),
        _ => {
            let spoilt = spoil::bytes(draw, &file.bytes, file.plain.1.as_bytes());
            ("damaged bytes", Some((spoilt, Expect::Survive)))
        }
    };
    if let Some((bytes, expect)) = damaged.filter(|(bytes, _)| *bytes != file.bytes) {
        file.bytes = bytes;
        file.expect = expect;
        file.change = change;
    }
}

type Damaged = Option<(Vec<u8>, Expect)>;

/// Written to the end of a disk that was full.
fn cut(draw: &mut Draw, file: &File) -> Damaged {
    let at = draw.below(file.bytes.len());
    let (kept, lost) = file.bytes.split_at(at);
    if file.format != Format::BinaryStl && lost.trim_ascii().is_empty() {
        return None;
    }
    let text = String::from_utf8_lossy(&file.bytes).to_lowercase();
    let told = match file.format {
        // Nothing in these tells where they end, and a number cut short is a number.
        Format::Csv | Format::Obj => false,
        // Every line of a dump has an end, and every tag.
        Format::BinaryStl | Format::Dump | Format::Vtp => true,
        Format::Stl => text.find("endsolid").is_some_and(|end| at < end + "endsolid".len()),
        // So is the last number of the last row, and velocities need not be there.
        Format::Xyz | Format::Data => {
            let last_before = |end: usize| numbers(&text[..end], file.format).last().map_or(0, |number| number.start);
            let velocities = text.find("velocities");
            let between = velocities.is_some_and(|end| (last_before(end)..=end).contains(&at));
            at <= last_before(text.len()) && !between
        }
    };
    Some((kept.to_vec(), if told { Expect::Refuse } else { Expect::Survive }))
}

/// A word with a slip of the hand.
fn word(draw: &mut Draw, file: &File) -> Damaged {
    let text = std::str::from_utf8(&file.bytes).ok()?;
    let words: Vec<Range<usize>> = pieces(text, |c| c.is_ascii_alphabetic()).filter(|word| word.len() > 2).collect();
    let said_beside = |word: &Range<usize>| {
        let line = text[..word.start].rfind('\n').map_or(0, |end| end + 1);
        // Another unit may be a unit too, and what stands behind `#` is for people.
        text[line..word.start].contains(['#', '[', '('])
    };
    let words: Vec<&Range<usize>> = words.iter().filter(|word| !said_beside(word)).collect();
    let word = words.get(draw.below(words.len().max(1)))?;
    let slip = nasty::misspelt(draw, &text[word.start..word.end]);
    // Columns that nobody knows are none of the grains'.
    let ignored = file.format == Format::Vtp;
    Some((replaced(text, word, &slip), if ignored { Expect::Survive } else { Expect::SameOrRefuse }))
}

/// What is no number where a number stands.
fn no_number(draw: &mut Draw, file: &File) -> Damaged {
    const NOT: &[&str] = &[
        "nan", "inf", "-inf", "infinity", "1e400", "-1e999", "1,5", "1d-3", "--1", "1e", "0x10", "1.2.3", "١", "one",
        "1_0",
    ];
    let text = std::str::from_utf8(&file.bytes).ok()?;
    let numbers = numbers(text, file.format);
    let number = numbers.get(draw.below(numbers.len().max(1)))?;
    let not = *draw.pick(NOT);
    Some((replaced(text, number, not), Expect::Refuse))
}

/// A row too few, too many, or in the wrong place.
fn row(draw: &mut Draw, file: &File) -> Damaged {
    let text = std::str::from_utf8(&file.bytes).ok()?;
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let rows: Vec<usize> = (0..lines.len()).filter(|at| is_row(lines[*at], file.format)).collect();
    let at = *rows.get(draw.below(rows.len().max(1)))?;
    let counted = matches!(file.format, Format::Xyz | Format::Data | Format::Dump | Format::Vtp | Format::Stl);
    // One that is there twice is no other one.
    let expect = if counted { Expect::Refuse } else { Expect::Other };
    if draw.one_in(2) {
        lines.remove(at);
    } else {
        lines.insert(at, lines[at]);
    }
    Some((lines.concat().into_bytes(), expect))
}

/// A cell too few or too many.
fn cell(draw: &mut Draw, file: &File) -> Damaged {
    let text = std::str::from_utf8(&file.bytes).ok()?;
    let numbers = numbers(text, file.format);
    let number = numbers.get(draw.below(numbers.len().max(1)))?;
    let line = text[..number.start].rfind('\n').map_or(0, |end| end + 1);
    let one_more = draw.one_in(2);
    let expect = match (file.format, text[line..].starts_with('f')) {
        // Polygons have any number of corners, and corners may have a weight and a colour.
        (Format::Obj, true) => Expect::Other,
        (Format::Obj, false) if one_more => Expect::Survive,
        _ => Expect::Refuse,
    };
    let cell = &text[number.start..number.end];
    let separator = [",", ";", "\t"]
        .into_iter()
        .find(|separator| text[line..].lines().next().is_some_and(|l| l.contains(separator)));
    let separator = separator.filter(|_| file.format == Format::Csv).unwrap_or(" ");
    let with = if one_more { format!("{cell}{separator}{cell}") } else { String::new() };
    if !one_more && separator != " " {
        // An empty cell is no number.
        return Some((replaced(text, number, ""), Expect::Refuse));
    }
    Some((replaced(text, number, &with), expect))
}

/// What stands before the number of grains of a VTK file.
const POINTS: &str = "NumberOfPoints=\"";

/// A count that does not hold.
fn count(draw: &mut Draw, file: &File) -> Damaged {
    if file.format == Format::BinaryStl {
        let mut bytes = file.bytes.clone();
        bytes[80] = bytes[80].wrapping_add(1 + draw.below(200) as u8);
        return Some((bytes, Expect::Refuse));
    }
    let text = std::str::from_utf8(&file.bytes).ok()?;
    if file.format == Format::Vtp {
        let from = text.find(POINTS)? + POINTS.len();
        let end = from + text[from..].find('"')?;
        return Some((replaced(text, &(from..end), "99"), Expect::Refuse));
    }
    let end = match file.format {
        Format::Xyz => text.find(['\r', '\n'])?,
        Format::Data => text.find(" atoms")?,
        _ => return None,
    };
    let start = text[..end].rfind('\n').map_or(0, |end| end + 1);
    let wrong = text[start..end].parse::<usize>().ok()? + 1 + draw.below(9);
    Some((replaced(text, &(start..end), &wrong.to_string()), Expect::Refuse))
}

fn replaced(text: &str, range: &Range<usize>, with: &str) -> Vec<u8> {
    [&text[..range.start], with, &text[range.end..]].concat().into_bytes()
}

/// Stretches of letters of a kind.
fn pieces(text: &str, of: impl Fn(char) -> bool) -> impl Iterator<Item = Range<usize>> {
    let mut from = 0;
    text.split(move |c| !of(c)).filter_map(move |piece| {
        let start = from;
        from += piece.len() + 1;
        (!piece.is_empty()).then(|| start..start + piece.len())
    })
}

/// Whether records of the file stand in this line.
fn is_row(line: &str, format: Format) -> bool {
    let line = line.trim();
    let numbers = line.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    match format {
        Format::Csv | Format::Vtp => numbers,
        Format::Xyz => line.starts_with("G "),
        // Not the counts and ends of the head.
        Format::Data => numbers && !line.ends_with(|c: char| c.is_alphabetic()),
        // Not steps, counts and ends of the box.
        Format::Dump => numbers && line.split_whitespace().count() > 4,
        Format::Obj => line.starts_with("f "),
        Format::Stl => line.to_lowercase().starts_with("vertex"),
        Format::BinaryStl => false,
    }
}

/// Every number of the records.
fn numbers(text: &str, format: Format) -> Vec<Range<usize>> {
    let mut out = Vec::new();
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        if is_row(line, format) || (format == Format::Obj && line.starts_with("v ")) {
            let cells = pieces(line, |c| !c.is_whitespace() && !",;".contains(c));
            let number = |cell: &Range<usize>| line[cell.start..].starts_with(|c: char| c.is_ascii_digit() || c == '-');
            out.extend(cells.filter(number).map(|cell| begin + cell.start..begin + cell.end));
        }
        begin += line.len();
    }
    out
}
