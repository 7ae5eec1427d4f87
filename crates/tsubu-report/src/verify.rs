//! The report of the shipped verification cases and studies.

use tsubu_frame::{Claim, summary::read_json};

use crate::page::{Block, Report, Tone};
use crate::source::{Source, card, claims_table, versions};

/// What the last column of a claim says.
const SOURCES: &str = "A claim holds if its value lies in the accepted range. The source says where the range comes from: an \
     author and a year, a figure of the study's paper, or a closed form. Codes such as V-05, A-7.1 or CH-A4 number the \
     sections of the project's specification and of its list of verification cases, which follow the named source or give \
     the closed form.";

pub(crate) fn build(source: &mut Source) -> Report {
    let claims = read(source);
    let failed: Vec<&Claim> = claims.iter().filter(|c| !c.pass).collect();
    let mut studies: Vec<&str> = Vec::new();
    for claim in &claims {
        if !studies.contains(&study(claim)) {
            studies.push(study(claim));
        }
    }
    let mut report = Report {
        kind: "Verification".into(),
        title: "Every claim, run again".into(),
        headline: match (claims.len(), failed.as_slice()) {
            (0, _) => "No claim was checked.".into(),
            (n, []) if studies.len() == 1 => format!("All {n} claims hold."),
            (n, []) => format!("All {n} claims hold, in {} studies.", studies.len()),
            (n, [one]) => format!("One of {n} claims does not hold: {}.", one.name),
            (n, more) => format!("{} of {n} claims do not hold.", more.len()),
        },
        verdict: Some(match (claims.len(), failed.len()) {
            (0, _) => (Tone::Warning, "nothing checked".into()),
            (_, 0) => (Tone::Good, "all pass".into()),
            (_, n) => (Tone::Bad, format!("{n} FAIL")),
        }),
        versions: versions(None),
        ..Report::default()
    };
    for name in &studies {
        let all = claims.iter().filter(|c| study(c) == *name);
        let (total, good) = all.fold((0, 0), |(n, p), c| (n + 1, p + usize::from(c.pass)));
        let tone = if good == total { Tone::Good } else { Tone::Bad };
        report.cards.push(card(name, format!("{good} / {total}"), "", "claims hold".into(), tone));
    }
    report.section("To be noted", source.note_blocks());
    if !failed.is_empty() {
        report.section("What does not hold", vec![claims_table(&failed)]);
    }
    if !claims.is_empty() {
        report.section("How to read the sources", vec![Block::Text(SOURCES.into())]);
    }
    for name in &studies {
        let of: Vec<&Claim> = claims.iter().filter(|c| study(c) == *name).collect();
        report.section(*name, vec![claims_table(&of)]);
    }
    if let Some(text) = source.text("verify.txt") {
        report.section("As printed", vec![Block::Typed(text)]);
    }
    report
}

/// A claim's study: told, or the part of its name before a slash.
fn study(claim: &Claim) -> &str {
    match (claim.study.as_str(), claim.name.split_once('/')) {
        ("", Some((study, _))) => study.trim(),
        ("", None) => "Claims",
        (told, _) => told,
    }
}

/// A list of claims, or an object with a `claims` list.
fn read(source: &mut Source) -> Vec<Claim> {
    #[derive(serde::Deserialize)]
    #[serde(untagged)]
    enum Either {
        List(Vec<Claim>),
        Object { claims: Vec<Claim> },
    }
    let read = read_json(&source.dir.join("verify.json"));
    match source.told(read) {
        Some(Either::List(claims) | Either::Object { claims }) => claims,
        None => Vec::new(),
    }
}
