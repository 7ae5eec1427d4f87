//! `tsubu explain`: what a law, a force of the water, a watch, a wall, a method or a claim is.

use crate::failure::Failure;
use crate::output;
use crate::stream::Stream;
use crate::table;
use clap::Args;
use std::fmt::Write as _;
use tsubu::explain::{self, Entry, Kind};
use tsubu_frame::Origin;
use tsubu_verify::{CASES, Case, recorded};

/// How far text runs.
const WIDTH: usize = 96;
/// Lines of a formula that are longer are cut between words.
const LONGEST: usize = 124;
/// A line of a sentence that is as long as this goes on in the next.
const GOES_ON: usize = 80;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu explain                      everything there is, by kind
  tsubu explain hertz                formula, symbols with units, limits, source, keys
  tsubu explain tangential.spring    one of several that are called so
  tsubu explain haff                 a verification case, whose claims `tsubu verify haff` checks")]
pub struct Options {
    /// What is to be explained; nothing lists all names
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Print a generated page of the book instead
    #[arg(long, hide = true, conflicts_with = "name", value_name = "PAGE")]
    page: Option<String>,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    if let Some(name) = &options.page {
        return output::print(&page(name)?);
    }
    let Some(name) = &options.name else { return output::print(&list()) };
    let entries = explain::entries();
    let (mut texts, mut seen) = (Vec::new(), Vec::new());
    for entry in entries.iter().filter(|entry| entry.is_called(name)) {
        texts.push(thing(entry));
        seen.push(&entry.choice.path);
    }
    let cases: Vec<&Case> = CASES.iter().filter(|case| case.name == name || case.study == name).collect();
    if let [case] = cases[..] {
        texts.push(single(case));
    } else if !cases.is_empty() {
        texts.push(study(name, &cases));
    }
    if texts.is_empty() { Err(unknown(name, &entries)) } else { output::print(&texts.join("\n")) }
}

/// All names, by kind.
fn list() -> String {
    let mut text = String::new();
    for kind in Kind::ALL {
        let mut home = String::new();
        let _ = writeln!(text, "{}", Stream::Data.bold_cyan(kind.title()));
        for entry in kind.entries() {
            if entry.choice.home() != home {
                entry.choice.home().clone_into(&mut home);
                let _ = writeln!(text, "  {home}");
            }
            let _ = writeln!(text, "    {:<28} {}", entry.choice.name(), entry.choice.sentence());
        }
        text.push('\n');
    }
    let _ = writeln!(text, "{}", Stream::Data.bold_cyan("Claims: verification cases"));
    for case in CASES {
        let _ = writeln!(text, "    {:<28} {}", case.name, case.about);
    }
    text + "\n`tsubu explain NAME` tells formula, symbols with units, limits, source and keys.\n"
}

/// A thing of a scene.
fn thing(entry: &Entry) -> String {
    let mut text =
        format!("{}\n{}.\n", Stream::Data.bold_cyan(&entry.choice.typed()), wrapped(&entry.choice.sentence(), 0));
    if let Some(about) = entry.about {
        text.push('\n');
        text += &laid_out(about.formula);
        text.push('\n');
        for (heading, section) in about.sections().skip(1) {
            let _ = writeln!(text, "{heading:<8} {}", wrapped(section, 9));
        }
    }
    let widest = entry.choice.keys.iter().map(|key| key.name.len()).max().unwrap_or_default();
    let indent = widest + 4;
    for (index, key) in entry.choice.key_texts().enumerate() {
        let gap = if index == 0 { "\nkeys\n" } else { "" };
        let value = format!("{}; default: {}", key.value, key.default);
        let value = if key.default == "required" { format!("{}; required", key.value) } else { value };
        let _ = writeln!(text, "{gap}  {:<widest$}  {}", key.name, wrapped(key.about, indent));
        let _ = writeln!(text, "{}{}", " ".repeat(indent), wrapped(&value, indent));
    }
    text
}

/// A verification case, with its claims as they were found when they were last kept.
fn single(case: &Case) -> String {
    let mut text = format!("{}\n{}.\n\n", Stream::Data.bold_cyan(case.name), wrapped(case.about, 0));
    text += &facts(case.study, case.name, case.budget);
    let kept = recorded(case.name);
    if kept.is_empty() {
        return text;
    }
    let mut rows = vec![["claim", "value", "accepted", ""].map(str::to_owned).to_vec()];
    rows.extend(kept.iter().map(|claim| {
        let range = table::range(claim.low, claim.high);
        vec![claim.name.clone(), table::number(claim.value), range, claim.verdict().word().to_owned()]
    }));
    let mut sources: Vec<&str> = Vec::new();
    for claim in &kept {
        if !claim.source.is_empty() && !sources.contains(&claim.source.as_str()) {
            sources.push(&claim.source);
        }
    }
    for (index, source) in sources.iter().enumerate() {
        let heading = if index == 0 { "source" } else { "" };
        let _ = writeln!(text, "{heading:<8} {}", wrapped(source, 9));
    }
    text + "\nas found when they were last kept\n" + &table::aligned(&rows)
}

/// The cases of a study.
fn study(name: &str, cases: &[&Case]) -> String {
    let rows: Vec<Vec<String>> = cases.iter().map(|case| vec![case.name.to_owned(), case.about.to_owned()]).collect();
    let budget = cases.iter().map(|case| case.budget).sum();
    format!("{}\n{}\n{}", Stream::Data.bold_cyan(name), table::aligned(&rows), facts(name, name, budget))
}

fn facts(study: &str, name: &str, budget: u32) -> String {
    let mut text = String::new();
    for (heading, section) in [
        ("study", study.to_owned()),
        ("claims", format!("`tsubu verify {name}` runs it and prints each with value, accepted range and source")),
        ("takes", format!("up to {budget} s on one thread")),
    ] {
        let _ = writeln!(text, "{heading:<8} {}", wrapped(&section, 9));
    }
    text
}

fn unknown(name: &str, entries: &[Entry]) -> Failure {
    let known: Vec<&str> = entries
        .iter()
        .flat_map(|entry| [entry.choice.name(), &entry.choice.path])
        .chain(CASES.iter().flat_map(|case| [case.name, case.study]))
        .collect();
    let failure = Failure::wrong(format!("there is nothing called `{name}`"));
    match tsubu_scene::nearest(name, known) {
        Some(meant) => failure.hint(format!("did you mean `{meant}`? `tsubu explain` lists all names")),
        None => failure.hint("`tsubu explain` lists all names"),
    }
}

/// A generated page of the book.
fn page(name: &str) -> Result<String, Failure> {
    Ok(match name {
        "scene-reference" => tsubu_scene::reference(),
        "contact" => explain::page(Kind::Contact),
        "water" => explain::page(Kind::Water),
        "watches" => explain::page(Kind::Watch),
        "walls" => explain::page(Kind::Wall),
        "methods" => explain::page(Kind::Method),
        "claims" => claims(),
        "held-against" => super::held_against::page(),
        "origins" => super::origins::page(),
        "verdicts" => super::origins::verdicts(),
        _ => match name.split_once(' ') {
            Some(("standing", studies)) => super::standing::standing(studies),
            Some(("open", studies)) => super::standing::open(studies),
            _ => return Err(Failure::wrong(format!("the book has no generated page `{name}`"))),
        },
    })
}

/// The page of the verification cases.
fn claims() -> String {
    let mut page = String::from(
        "# Verification cases\n\n<!-- Generated by `cargo xtask gen` from the cases; do not edit. -->\n\n\
         `tsubu verify NAME` runs a case, or all cases of a study, and prints each claim with value, accepted range and source.\n\
         The budget is the time on one thread. `tsubu verify` alone runs all up to a minute but for those that show a gap: a claim of\n\
         theirs fails, and the study says why. What claims were when they were last kept is told here, and by\n\
         `tsubu explain NAME` one by one.\n",
    );
    let mut studies: Vec<&str> = CASES.iter().map(|case| case.study).collect();
    studies.sort_unstable();
    studies.dedup();
    for study in studies {
        let _ = write!(
            page,
            "\n## `{study}`\n\n| case | what it checks | claims that hold | budget |\n|---|---|---|---|\n"
        );
        for case in CASES.iter().filter(|case| case.study == study) {
            // Controls are no claims.
            let mut kept = recorded(case.name);
            kept.retain(|claim| claim.origin != Origin::Control);
            let hold = kept.iter().filter(|claim| claim.pass).count();
            let kept = if kept.is_empty() { "not kept yet".to_owned() } else { format!("{hold} of {}", kept.len()) };
            let _ = writeln!(page, "| `{}` | {} | {kept} | {} |", case.name, case.about, case.budget_text());
        }
    }
    page
}

/// A text of columns and sentences: what fits stays as it is, sentences with lines that are too long are set anew.
fn laid_out(text: &str) -> String {
    let has_columns = |line: &str| line.trim_start().contains("  ") || line.starts_with(' ');
    let mut lines = text.lines().peekable();
    let mut out = String::new();
    while let Some(line) = lines.next() {
        if has_columns(line) {
            let line = if line.chars().count() > LONGEST { wrapped(line, 6) } else { line.to_owned() };
            let _ = writeln!(out, "  {line}");
            continue;
        }
        let mut sentence = vec![line];
        while sentence.last().is_some_and(|line| line.chars().count() > GOES_ON) {
            let Some(next) = lines.next_if(|next| !has_columns(next)) else { break };
            sentence.push(next);
        }
        let fits = sentence.iter().all(|line| line.chars().count() <= LONGEST);
        let _ = writeln!(out, "  {}", if fits { sentence.join("\n  ") } else { wrapped(&sentence.join(" "), 2) });
    }
    out
}

/// Text in lines of a readable length; those after the first begin with `indent` blanks.
fn wrapped(text: &str, indent: usize) -> String {
    let (mut wrapped, mut length) = (String::new(), indent);
    for word in text.split_whitespace() {
        let size = word.chars().count();
        if length > indent && length + 1 + size > WIDTH {
            wrapped.push('\n');
            wrapped.extend(std::iter::repeat_n(' ', indent));
            length = indent;
        } else if length > indent {
            wrapped.push(' ');
            length += 1;
        }
        wrapped += word;
        length += size;
    }
    wrapped
}

#[cfg(test)]
mod tests {
    use super::{laid_out, wrapped};

    /// Sentences over several lines were broken in the middle, with the rest of each line further to the right.
    #[test]
    fn sentences_are_set_anew_and_columns_stay() {
        let long = "word ".repeat(26);
        let text = laid_out(&format!("a column   [m]\n{long}\nthe end of it.\nF = k d\n"));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!((lines[0], lines[3]), ("  a column   [m]", "  F = k d"));
        assert!(lines[2].ends_with("word the end of it."), "{text}");
        assert!(lines.iter().all(|line| line.starts_with("  ") && !line.starts_with("   ")), "{text}");
    }

    #[test]
    fn text_is_cut_between_words() {
        let text = "word ".repeat(40);
        let lines: Vec<String> = wrapped(&text, 4).lines().map(str::to_owned).collect();
        assert!(lines.iter().all(|line| line.chars().count() <= super::WIDTH), "{lines:?}");
        assert!(lines.len() == 3 && lines[1].starts_with("    word"), "{lines:?}");
        assert_eq!(wrapped("one", 9), "one");
    }
}
