//! What parts say of themselves.

use super::stack;
use std::collections::BTreeSet;

/// The parts of all laws that a scene can ask for have between them each text, and no other. A part with the text of
/// another one would be explained wrongly.
#[test]
fn parts_and_texts_belong_together() {
    let parts = stack::PAIRS.iter().flat_map(|subject| subject.law.parts());
    let told: BTreeSet<&str> = parts.map(|part| part.about().key).collect();
    let mut written: BTreeSet<&str> = tsubu::contact::ABOUT.iter().map(|about| about.key).collect();
    assert!(written.remove("contact.film.lubrication"), "films are no part of these stacks; `film.rs` asks for theirs");
    assert_eq!(told, written);
}

/// Every stack a scene can ask for is asked.
#[test]
fn the_bench_knows_all_stacks() {
    assert_eq!((stack::ALL.len(), stack::PAIRS.len()), (6120, 350));
}
