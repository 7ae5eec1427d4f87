//! What was typed is quoted in messages; nobody reads a megabyte of it, or three hundred digits.

/// Characters of a word that are quoted in full.
const WORD: usize = 80;
/// Characters of a whole line of a message.
const LINE: usize = 1000;
/// The longest of the digits that doubles need.
const DIGITS: usize = 24;

/// The text with what is too long left out of its words, its numbers and itself.
pub(super) fn brief(text: &str) -> String {
    if text.len() <= DIGITS {
        return text.to_string();
    }
    // First the ends of what is very long: the words of a megabyte need not be looked at.
    let text = without_middle(text, 4 * LINE);
    let mut short = String::new();
    let mut rest = text.as_str();
    while !rest.is_empty() {
        let end = rest.find(between_words).unwrap_or(rest.len());
        short.push_str(&word(&rest[..end]));
        rest = &rest[end..];
        if let Some(c) = rest.chars().next() {
            short.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    without_middle(&short, LINE)
}

fn between_words(c: char) -> bool {
    c.is_whitespace() || matches!(c, '`' | '"' | '\'' | '(' | ')' | '[' | ']' | ',' | ';' | ':' | '=')
}

fn word(word: &str) -> String {
    if word.len() > DIGITS
        && word.chars().all(|c| c.is_ascii_digit() || "+-.eE_".contains(c))
        && let Ok(number) = word.replace('_', "").parse::<f64>()
        && number.is_finite()
    {
        return format!("{number:e}");
    }
    without_middle(word, WORD)
}

/// A value that stands in a sentence.
pub(crate) fn value(text: &str) -> String {
    without_middle(text, WORD)
}

fn without_middle(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_string();
    }
    let (head, tail) = (most * 2 / 3, most / 4);
    let head: String = text.chars().take(head).collect();
    let tail: String = text.chars().skip(count - tail).collect();
    format!("{head}...{tail}")
}

#[cfg(test)]
mod tests {
    use super::brief;

    #[test]
    fn what_can_be_read_stays_as_it_is() {
        for text in ["`6 kg` is a mass, not a length", "keys here: `a`, `b`", &"word ".repeat(190)] {
            assert_eq!(brief(text), text);
        }
        assert_eq!(brief("0.30000000000000004 m"), "0.30000000000000004 m");
    }

    /// A number of 300 digits and a string of a megabyte were echoed whole.
    #[test]
    fn what_nobody_reads_is_left_out() {
        assert_eq!(brief(&format!("`{}` is large", 1e300)), "`1e300` is large");
        assert_eq!(brief(&format!("{} m is small", 1e-300)), "1e-300 m is small");
        let long = brief(&format!("unknown `key`: `{}`", "x".repeat(1_000_000)));
        assert!(long.starts_with("unknown `key`: `xxx") && long.ends_with("xxx`") && long.len() < 120, "{long}");
        let words = brief(&format!("`{}` is not a number", "two words ".repeat(100_000)));
        assert!(words.ends_with("is not a number") && words.len() < 1010, "{words}");
        assert!(brief(&"é".repeat(5000)).chars().count() <= 80);
    }
}
