//! The report of the shipped verification cases and studies.

use tsubu_frame::{Claim, Origin, Points, Verdict, summary::read_json};

use crate::claims::claims_table;
use crate::ensemble;
use crate::figure::{Axis, Figure, Series, Style};
use crate::gallery;
use crate::page::{Block, Report, Tone, card};
use crate::source::Source;
use crate::summary::versions;

/// What the last column of a claim says.
const SOURCES: &str = "A claim holds if its value lies in the accepted range. The source says where the range comes from: an \
     author and a year, a figure of the study's paper, or a closed form. Codes such as V-05, A-7.1 or CH-A4 number the \
     sections of the project's specification and of its list of verification cases, which follow the named source or give \
     the closed form. A claim on an ensemble holds if the 95 % interval of the mean lies in the range, and is undecided if the \
     interval lies neither in it nor outside.";

pub(crate) fn build(source: &mut Source) -> Report {
    let claims = read(source);
    let of = |verdict| claims.iter().filter(|claim| claim.verdict() == verdict).collect::<Vec<&Claim>>();
    let (failed, undecided) = (of(Verdict::Fail), of(Verdict::Undecided));
    // Controls are no claims; one that fails is told all the same.
    let own = |claim: &&Claim| claim.origin != Origin::Control;
    let mut studies: Vec<&str> = Vec::new();
    for claim in &claims {
        if !studies.contains(&study(claim)) {
            studies.push(study(claim));
        }
    }
    let mut report = Report {
        kind: "Verification".into(),
        title: "Every claim, run again".into(),
        headline: match (claims.iter().filter(own).count(), failed.as_slice()) {
            (0, _) => "No claim was checked.".into(),
            (n, []) if !undecided.is_empty() => format!("None of {n} claims fails; {} undecided.", undecided.len()),
            (n, []) if studies.len() == 1 => format!("All {n} claims hold."),
            (n, []) => format!("All {n} claims hold, in {} studies.", studies.len()),
            (n, [one]) => format!("One of {n} claims does not hold: {}.", one.name),
            (n, more) => format!("{} of {n} claims do not hold.", more.len()),
        },
        verdict: Some(match (claims.len(), failed.len()) {
            (0, _) => (Tone::Warning, "nothing checked".into()),
            (_, 0) if !undecided.is_empty() => (Tone::Warning, format!("{} undecided", undecided.len())),
            (_, 0) => (Tone::Good, "all pass".into()),
            (_, n) => (Tone::Bad, format!("{n} FAIL")),
        }),
        versions: versions(None),
        ..Report::default()
    };
    for name in &studies {
        let all = claims.iter().filter(own).filter(|c| study(c) == *name);
        let (total, good) = all.fold((0, 0), |(n, p), c| (n + 1, p + usize::from(c.pass)));
        let tone = if good == total { Tone::Good } else { Tone::Bad };
        report.cards.push(card(name, format!("{good} / {total}"), "", "claims hold".into(), tone));
    }
    report.section("To be noted", source.note_blocks());
    if !failed.is_empty() {
        report.section("What does not hold", vec![claims_table(&failed, |_| "-")]);
    }
    if !undecided.is_empty() {
        report.section("What is undecided", vec![claims_table(&undecided, |_| "-")]);
    }
    if !claims.is_empty() {
        report.section("How to read the sources", vec![Block::Text(SOURCES.into())]);
    }
    for name in &studies {
        let of: Vec<&Claim> = claims.iter().filter(|c| study(c) == *name).collect();
        let mut blocks = gallery::blocks(source, name);
        blocks.extend(figures(source, name, &of));
        if let Some(svg) = ensemble::strips(&of) {
            blocks.push(source.drawing(&format!("{}_ensembles", plain(name)), svg, ensemble::CAPTION));
        }
        blocks.push(claims_table(&of, |_| "-"));
        report.section(*name, blocks);
    }
    if let Some(text) = source.text("verify.txt") {
        report.section("As printed", vec![Block::Typed(text)]);
    }
    report
}

/// What the values of a study's claims were made of, a figure for all claims that share one: what came out as points, what the
/// source says dashed in the same colour.
fn figures(source: &mut Source, study: &str, claims: &[&Claim]) -> Vec<Block> {
    let all: Vec<&Points> = claims.iter().filter_map(|claim| claim.points.as_ref()).collect();
    let mut titles: Vec<&str> = Vec::new();
    for points in &all {
        if !titles.contains(&points.figure.as_str()) {
            titles.push(&points.figure);
        }
    }
    let pairs = |points: &[[f64; 2]]| points.iter().map(|[x, y]| (*x, *y)).collect::<Vec<_>>();
    let mut blocks = Vec::new();
    for title in titles {
        let mut figure = Figure { title: title.to_owned(), ..Figure::default() };
        for (colour, points) in all.iter().filter(|points| points.figure == title).enumerate() {
            let [x, y] = points.axes.each_ref().map(|header| Axis::from_header(header));
            (figure.x, figure.y) = if points.log { (x.log(), y.log()) } else { (x, y) };
            // Points alone, or they would hide the line that they are held against.
            let style = if points.published.is_empty() { Style::LineAndPoints } else { Style::Points };
            let found = Series::line(points.series.clone(), pairs(&points.found)).styled(style);
            let published = Series::line("", pairs(&points.published)).styled(Style::Dashed);
            figure.series.extend([found, published].map(|series| Series { colour: Some(colour), ..series }));
        }
        figure.series.retain(|series| !series.points.is_empty());
        let caption = "Points: tsubu. Dashed: what the source of the claim says.";
        blocks.extend(source.figure(&format!("{}_{}", plain(study), plain(title)), &figure, caption));
    }
    blocks
}

/// A text as a part of a file's name.
fn plain(text: &str) -> String {
    text.to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "_")
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
