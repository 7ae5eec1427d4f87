//! What parts say of themselves.

use super::stack;
use std::collections::BTreeSet;

/// Every part says what it is, and symbols have units.
#[test]
fn every_part_speaks() {
    let mut names = BTreeSet::new();
    for subject in stack::PAIRS.iter() {
        for part in subject.law.parts() {
            let about = part.about();
            for text in [about.name, about.models, about.formula, about.symbols, about.limits, about.reference] {
                assert!(!text.is_empty(), "{}: a section is empty", about.name);
            }
            assert!(about.symbols.contains('['), "{}: symbols without units", about.name);
            names.insert((part.stage(), about.name));
        }
    }
    assert_eq!(names.len(), 2 + 4 + 5 + 4 + 6 + 2, "{names:?}");
}

/// Every stack a scene can ask for is asked.
#[test]
fn the_bench_knows_all_stacks() {
    assert_eq!((stack::ALL.len(), stack::PAIRS.len()), (6120, 350));
}
