//! Whatever is fed to the reader, it answers with a scene or with complaints that can be printed.

use crate::products::IN_SPACE;
use crate::{GOOD, read};
use proptest::prelude::*;
use tsubu_scene::TEMPLATES;

/// Reads and prints; a panic fails the test.
fn survive(text: &str, changes: &[&str]) {
    if let Err(complaints) = read(text, changes) {
        assert!(complaints.len() > 0);
        assert!(!complaints.to_string().is_empty());
        let _ = complaints.render(true);
    }
}

/// The nearest place where a text can be cut.
fn cut(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

#[test]
fn odd_texts() {
    let deep_list = format!("x = {}{}", "[".repeat(5000), "]".repeat(5000));
    let deep_table = format!("x = {}", "{a=".repeat(5000));
    let deep_key = format!("{} = 1", vec!["a"; 5000].join("."));
    let long_line = format!("title = \"{}\" extra", "é".repeat(100_000));
    let many_errors = "= 1\n".repeat(2000);
    let texts = [
        "\u{feff}",
        "\r\n\r\n",
        "\0",
        "[",
        "[[",
        "x",
        "\u{feff}x = 1",
        "a.b = 1\na = 2",
        "\"\" = 1",
        "x = \"",
        "x = '''",
        "duration = 99999999999999999999999",
        "duration = 0x7fffffffffffffffff",
        "seed = -1",
        "seed = 1e400",
        "seed = nan",
        "duration = 1979-05-27",
        "materials = 1",
        "materials = []",
        "materials = [1, {}]",
        "claim = {}",
        "claim = [1]",
        "dimension = 3.5",
        "\u{202e}x = 1",
        "x = \"\u{1b}[31m\"",
        "日本語 = 1",
        "\tx = 1",
        "[contact]\nnormal = {}",
        "[particles.a]\nstart.at.position = [[nan, 1], [[], {}], 3]",
        "[sweep.vary]\n\"\" = [1]",
        "[sweep.vary]\n\"a..b\" = [1]",
        &deep_list,
        &deep_table,
        &deep_key,
        &long_line,
        &many_errors,
    ];
    for text in texts {
        survive(text, &[]);
        survive(&text.replace('\n', "\r\n"), &[]);
        survive(&format!("{GOOD}{text}"), &[]);
        survive(GOOD, &[text]);
        survive(GOOD, &[&format!("title={text}")]);
        survive(GOOD, &[&format!("{text}=1")]);
        survive(GOOD, &[&format!("particles.{text}.{text}={text}")]);
    }
}

#[test]
fn line_ends_and_byte_order_marks_do_not_matter() {
    let plain = read(GOOD, &[]).expect("good").plan().clone();
    assert_eq!(read(&GOOD.replace('\n', "\r\n"), &[]).expect("good").plan(), &plain);
    assert_eq!(read(&format!("\u{feff}{GOOD}"), &[]).expect("good").plan(), &plain);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_text(text in "(?s).{0,200}") {
        survive(&text, &[]);
        survive(GOOD, &[&text]);
    }

    #[test]
    fn text_made_of_toml_pieces(pieces in proptest::collection::vec(
        prop_oneof![
            Just("["), Just("]"), Just("{"), Just("}"), Just("="), Just("\n"), Just("."), Just(","), Just("\""), Just("'"),
            Just("particles"), Just("materials"), Just("start"), Just("at"), Just("contact"), Just("normal"), Just("response"),
            Just("vary"), Just("1"), Just("-1e300"), Just("nan"), Just(" "), Just("\"6 mm\""), Just("#"), Just("é"), Just("claim"),
        ], 0..60)) {
        survive(&pieces.concat(), &[]);
    }

    #[test]
    fn a_scene_cut_short_or_damaged(which in 0..TEMPLATES.len(), from in 0_usize..4000, length in 0_usize..40, with in "(?s).{0,6}") {
        let text = TEMPLATES[which].text;
        let start = cut(text, from);
        survive(&text[..start], &[]);
        let end = cut(text, start + length).max(start);
        survive(&format!("{}{with}{}", &text[..start], &text[end..]), &[]);
    }

    #[test]
    fn a_wide_scene_cut_short_or_damaged(from in 0_usize..4000, length in 0_usize..40, with in "(?s).{0,6}") {
        let start = cut(IN_SPACE, from);
        let end = cut(IN_SPACE, start + length).max(start);
        survive(&format!("{}{with}{}", &IN_SPACE[..start], &IN_SPACE[end..]), &[]);
    }

    #[test]
    fn a_value_swapped_for_any_other(wide in any::<bool>(), line in 0_usize..100, value in prop_oneof![
        Just("nan"), Just("inf"), Just("-1"), Just("0"), Just("1e308"), Just("9223372036854775807"), Just("\"\""), Just("[]"), Just("{}"),
        Just("true"), Just("[[1, 2], [1]]"), Just("1979-05-27"), Just("\"1e400 m\""), Just("{ x = { y = [] } }"),
    ]) {
        let text = if wide { IN_SPACE } else { GOOD };
        let text: Vec<String> = text.lines().enumerate().map(|(index, typed)| match typed.split_once(" = ") {
            Some((key, _)) if index == line => format!("{key} = {value}"),
            _ => typed.to_string(),
        }).collect();
        survive(&text.join("\n"), &[]);
    }
}
