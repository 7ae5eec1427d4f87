//! Tables in pages written by hand: what stands between `<!-- generated: NAME -->` and `<!-- end -->`.

use crate::shell::{output, root};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Pages with such tables, with their new text.
pub fn pages(tsubu: &str) -> Result<Vec<(String, String)>, String> {
    let mut pages = vec![filled("benches/README.md", "race", &race()?)?];
    pages.extend(studies(tsubu)?);
    Ok(pages)
}

/// A page with another table in it.
pub fn filled(page: &str, name: &str, table: &str) -> Result<(String, String), String> {
    let text = fs::read_to_string(root().join(page)).map_err(|error| format!("cannot read {page}: {error}"))?;
    put(&text, name, table).map(|text| (page.to_owned(), text)).ok_or_else(|| format!("{page} has no table `{name}`"))
}

fn put(text: &str, name: &str, table: &str) -> Option<String> {
    let begin = format!("<!-- generated: {name} -->");
    let (before, rest) = text.split_once(&begin)?;
    let (_, after) = rest.split_once("<!-- end -->")?;
    Some(format!("{before}{begin}\n\n{table}\n<!-- end -->{after}"))
}

/// The latest race: the last in the order of names, which begin with the day.
fn race() -> Result<String, String> {
    let folder = root().join("benches/results");
    let mut files: Vec<PathBuf> = list(&folder)?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    let latest = files.last().ok_or("there is no race in benches/results")?;
    let text = fs::read_to_string(latest).map_err(|error| format!("cannot read {}: {error}", latest.display()))?;
    let race: Value = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", latest.display()))?;
    let stem = latest.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(race_table(&race, &stem))
}

fn race_table(race: &Value, name: &str) -> String {
    let about = |what: &str| race["about"][what].as_str().unwrap_or("not told").to_owned();
    let mut table = format!(
        "[{name}](results/{name}.md): {} (family, model {}), {} cores, {}; tsubu {}; LAMMPS {}; medians of {} runs in turn.\n\n",
        about("processor"),
        about("family, model"),
        about("cores"),
        about("rustc").split(" (").next().unwrap_or_default(),
        about("tsubu"),
        about("LAMMPS"),
        about("runs"),
    );
    table += "| workload | grains | code | one core | two cores | tsubu over it: one core | two cores |\n|---|---|---|---|---|---|---|\n";
    for workload in race["workloads"].as_array().into_iter().flatten() {
        let mut rates: BTreeMap<(String, u64), Vec<f64>> = BTreeMap::new();
        for run in workload["runs"].as_array().into_iter().flatten() {
            let rate = run["million particle-steps per second"].as_f64();
            let (Some(code), Some(cores), Some(rate)) = (run["code"].as_str(), run["cores"].as_u64(), rate) else {
                continue;
            };
            rates.entry((code.to_owned(), cores)).or_default().push(rate);
        }
        let median =
            |code: &str, cores| rates.get(&(code.to_owned(), cores)).cloned().map_or(f64::NAN, crate::race::median);
        let mut codes: Vec<&str> = rates.keys().map(|(code, _)| code.as_str()).collect();
        codes.dedup();
        codes.sort_by_key(|code| *code != "tsubu");
        for code in codes {
            // Two ranks run on two cores alone.
            let told = |number: f64, digits| if number.is_nan() { String::new() } else { format!("{number:.digits$}") };
            let over = |cores| match code {
                "tsubu" => String::new(),
                _ => told(median("tsubu", cores) / median(code, cores), 2),
            };
            let _ = writeln!(
                table,
                "| {} | {} | {code} | {} | {} | {} | {} |",
                workload["about"].as_str().unwrap_or_default(),
                workload["grains"],
                told(median(code, 1), 1),
                told(median(code, 2), 1),
                over(1),
                over(2),
            );
        }
    }
    table + "\nMillion particle-steps a second.\n"
}

/// Pages of studies with what is kept of their claims. The marks name the studies: `<!-- generated: claims STUDY ... -->` is a table
/// case by case, `<!-- generated: values CASE -->` one claim by claim, `<!-- generated: results STUDY -->` what was measured by every model, `<!-- generated: standing STUDY ... -->` how the study stands, `<!-- generated: open STUDY ... -->` why what does not hold does not.
fn studies(tsubu: &str) -> Result<Vec<(String, String)>, String> {
    let kept = crate::claims::read()?;
    let mut pages = Vec::new();
    for folder in list(&root().join("studies"))? {
        let page = format!("studies/{}/README.md", folder.file_name().unwrap_or_default().to_string_lossy());
        let Ok(mut text) = fs::read_to_string(root().join(&page)) else { continue };
        for mark in marks(&text) {
            let table = match mark.split_once(' ') {
                Some(("claims", names)) => claim_table(&kept, names),
                Some(("values", case)) => value_table(&kept, case),
                Some(("results", study)) => result_tables(study)?,
                Some(("standing" | "open", _)) => printed(tsubu, &mark)?,
                _ => return Err(format!("{page}: nobody makes the table `{mark}`")),
            };
            text = put(&text, &mark, &table).ok_or_else(|| format!("{page}: the table `{mark}` has no end"))?;
        }
        pages.push((page, text));
    }
    Ok(pages)
}

/// Names of the tables of a page.
fn marks(text: &str) -> Vec<String> {
    let begins = text.split("<!-- generated: ").skip(1);
    begins.filter_map(|rest| Some(rest.split_once(" -->")?.0.to_owned())).collect()
}

/// A page or a table that the program prints.
pub fn printed(tsubu: &str, name: &str) -> Result<String, String> {
    output(tsubu, &["explain", "--page", name])
}

/// Claims of some studies case by case: how many hold, and each that fails.
fn claim_table(kept: &[Value], studies: &str) -> String {
    let mut table =
        String::from("| case | claims | hold | FAIL or undecided: value (accepted range) |\n|---|---|---|---|\n");
    let text = |claim: &Value, what: &str| claim[what].as_str().unwrap_or_default().to_owned();
    let own = |claim: &&Value| claim["origin"] != "control" || claim["pass"] != true;
    let wanted = kept.iter().filter(own).filter(|claim| studies.split(' ').any(|study| claim["study"] == study));
    let mut cases: Vec<(String, Vec<&Value>)> = Vec::new();
    for claim in wanted {
        let case = text(claim, "case");
        match cases.last_mut() {
            Some((last, claims)) if *last == case => claims.push(claim),
            _ => cases.push((case, vec![claim])),
        }
    }
    for (case, claims) in cases {
        let failed: Vec<&&Value> = claims.iter().filter(|claim| claim["pass"] == false).collect();
        let told: Vec<String> = failed
            .iter()
            .map(|c| {
                format!(
                    "{}: {} ({}{})",
                    text(c, "name"),
                    number(&c["value"]),
                    range(c),
                    if is_undecided(c) { "; undecided" } else { "" }
                )
            })
            .collect();
        let _ = writeln!(
            table,
            "| `{case}` | {} | {} | {} |",
            claims.len(),
            claims.len() - failed.len(),
            told.join("<br>").replace('|', "\\|")
        );
    }
    table
}

/// Claims of a case one by one; of ensembles with the interval of their mean.
fn value_table(kept: &[Value], case: &str) -> String {
    let mut table = String::from("| claim | value | 95 % interval | accepted | |\n|---|---|---|---|---|\n");
    for claim in kept.iter().filter(|claim| claim["case"] == case && claim["origin"] != "control") {
        let name = claim["name"].as_str().unwrap_or_default().replace('|', "\\|");
        let verdict = match claim["pass"] == true {
            true => "pass",
            false if is_undecided(claim) => "undecided",
            false => "**FAIL**",
        };
        let ends = &claim["ensemble"]["interval"];
        let interval =
            if ends.is_array() { format!("{} to {}", number(&ends[0]), number(&ends[1])) } else { String::new() };
        let _ = writeln!(table, "| {name} | {} | {interval} | {} | {verdict} |", number(&claim["value"]), range(claim));
    }
    table
}

/// What every model of a study gave, a table a scene, of `results/STUDY.csv`; models that gave nothing are left out.
fn result_tables(study: &str) -> Result<String, String> {
    let path = root().join(format!("studies/{study}/results/{study}.csv"));
    let wrong = |error: csv::Error| format!("{}: {error}", path.display());
    let mut reader = csv::Reader::from_path(&path).map_err(wrong)?;
    // Scene, quantity, and a column a model.
    let header = reader.headers().map_err(wrong)?.clone();
    let models = header.iter().map(|cell| cell.split(" [").next().unwrap_or(cell)).skip(2);
    let mut scenes: BTreeMap<String, (Vec<String>, Vec<Vec<f64>>)> = BTreeMap::new();
    for row in reader.records() {
        let row = row.map_err(wrong)?;
        let (quantities, values) = scenes.entry(row[0].to_owned()).or_default();
        quantities.push(row[1].to_owned());
        values.push(row.iter().skip(2).map(|cell| cell.parse().unwrap_or(f64::NAN)).collect());
    }
    let mut text = String::new();
    for (scene, (quantities, values)) in scenes {
        let _ = writeln!(text, "| {scene} | {} |\n|---|{}", quantities.join(" | "), "---|".repeat(quantities.len()));
        for (place, model) in models.clone().enumerate() {
            let given: Vec<f64> = values.iter().map(|values| values[place]).collect();
            if !given.iter().all(|value| value.is_nan()) {
                let told: Vec<String> = given.into_iter().map(three_figures).collect();
                let _ = writeln!(text, "| {model} | {} |", told.join(" | "));
            }
        }
        text.push('\n');
    }
    Ok(text.trim_end().to_owned() + "\n")
}

fn three_figures(value: f64) -> String {
    match format!("{value:.2e}").parse::<f64>() {
        Ok(short) if short.is_finite() => short.to_string(),
        _ => "–".to_owned(),
    }
}

/// Whether the interval of a claim that does not hold lies neither in its range nor outside.
fn is_undecided(claim: &Value) -> bool {
    let end = |value: &Value, open: f64| value.as_f64().unwrap_or(open);
    let interval = &claim["ensemble"]["interval"];
    let (Some(from), Some(to)) = (interval[0].as_f64(), interval[1].as_f64()) else { return false };
    to >= end(&claim["low"], f64::NEG_INFINITY) && from <= end(&claim["high"], f64::INFINITY)
}

/// With five figures.
fn number(value: &Value) -> String {
    let Some(x) = value.as_f64() else { return "none".to_owned() };
    let short: f64 = format!("{x:.4e}").parse().unwrap_or(x);
    if short != 0.0 && !(1e-3..1e6).contains(&short.abs()) { format!("{short:e}") } else { short.to_string() }
}

fn range(claim: &Value) -> String {
    match (&claim["low"], &claim["high"]) {
        (Value::Null, Value::Null) => "none".to_owned(),
        (Value::Null, high) => format!("at most {}", number(high)),
        (low, Value::Null) => format!("at least {}", number(low)),
        (low, high) => format!("{} to {}", number(low), number(high)),
    }
}

fn list(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("cannot read {}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Whoever opens a study wants to know first what came back and what did not.
    #[test]
    fn every_study_begins_with_how_it_stands() {
        for folder in list(&root().join("studies")).expect("studies").iter().filter(|path| path.is_dir()) {
            let text = fs::read_to_string(folder.join("README.md")).expect("a README");
            let first = text.lines().find(|line| line.starts_with("## "));
            assert_eq!(first, Some("## In short"), "{}", folder.display());
            let short = text.split("\n## ").nth(1).unwrap_or_default();
            assert!(short.contains("**Agrees:**") && short.contains("**Does not agree:**"), "{}", folder.display());
            let told = |line: &&str| !line.trim().is_empty() && !line.starts_with("<!--") && *line != "In short";
            let lines = short.lines().filter(told).count();
            assert!(lines <= 10, "{}: {lines} lines, ten say how a study stands", folder.display());
        }
    }

    #[test]
    fn what_stands_between_the_marks_is_replaced() {
        let text = "a\n<!-- generated: t -->\nold\n<!-- end -->\nb\n";
        let once = put(text, "t", "new\n").expect("a table");
        assert_eq!(once, "a\n<!-- generated: t -->\n\nnew\n\n<!-- end -->\nb\n");
        assert_eq!(put(&once, "t", "new\n"), Some(once.clone()), "again the same");
        assert_eq!(put(text, "u", "new\n"), None);
    }

    #[test]
    fn a_race_is_told_by_medians() {
        let run = |code: &str, cores: u32, rate: f64| json!({ "code": code, "cores": cores, "million particle-steps per second": rate });
        let runs = [
            run("tsubu", 1, 9.0),
            run("tsubu", 1, 10.0),
            run("tsubu", 1, 50.0),
            run("L", 1, 4.0),
            run("tsubu", 2, 18.0),
            run("L", 2, 9.0),
        ];
        let race = json!({ "about": { "runs": "3" }, "workloads": [{ "about": "bed", "grains": 7, "runs": runs }] });
        let table = race_table(&race, "day");
        assert!(
            table.contains("| bed | 7 | tsubu | 10.0 | 18.0 |  |  |\n| bed | 7 | L | 4.0 | 9.0 | 2.50 | 2.00 |"),
            "{table}"
        );
    }

    /// A mean whose interval reaches over an end of the range was told as one that fails.
    #[test]
    fn what_is_undecided_is_told_as_that() {
        let claim = |interval: [f64; 2]| json!({ "case": "a", "study": "s", "name": "x", "value": 2.5, "high": 2.0, "pass": false, "ensemble": { "interval": interval } });
        let kept = [claim([1.5, 3.5]), claim([2.25, 2.75])];
        let table = value_table(&kept, "a");
        assert!(table.contains("| 1.5 to 3.5 | at most 2 | undecided |"), "{table}");
        assert!(table.contains("| 2.25 to 2.75 | at most 2 | **FAIL** |"), "{table}");
        let table = claim_table(&kept, "s");
        assert!(table.contains("x: 2.5 (at most 2; undecided)<br>x: 2.5 (at most 2) |"), "{table}");
    }

    #[test]
    fn claims_that_fail_are_told() {
        let claim = |case: &str, study: &str, value: f64, pass: bool| json!({ "case": case, "study": study, "name": "x", "value": value, "high": 2.0, "pass": pass });
        let kept = [
            claim("a", "s", 1.0, true),
            claim("a", "s", 3.000_04, false),
            claim("b", "other", 3.0, false),
            claim("c", "t", 1e-7, true),
        ];
        let table = claim_table(&kept, "s t");
        assert!(table.ends_with("|\n| `a` | 2 | 1 | x: 3 (at most 2) |\n| `c` | 1 | 1 |  |\n"), "{table}");
        assert_eq!((number(&json!(1e-7)).as_str(), number(&json!(12.345_678)).as_str()), ("1e-7", "12.346"));
    }
}
