//! What parts say of themselves.

use super::stack;
use std::collections::BTreeSet;
use tsubu_scene::plan::Contact;

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

/// Every part that a scene can ask for stands in the stacks that the laws' tests go through.
#[test]
fn the_stacks_have_every_part_of_a_scene() {
    let names = |c: &Contact| {
        let parts = [("normal", c.normal.name()), ("damping", c.damping.name()), ("tangential", c.tangential.name())];
        let more = [("rolling", c.rolling.name()), ("twisting", c.twisting.name()), ("cohesion", c.cohesion.name())];
        parts.into_iter().chain(more).map(|(family, name)| format!("contact.{family}.{name}"))
    };
    let asked: BTreeSet<String> = stack::PAIRS.iter().flat_map(|subject| names(&subject.contact)).collect();
    let choices = tsubu_scene::choices().into_iter().map(|choice| choice.path);
    let parts = choices.filter(|path| path.starts_with("contact.") && path.split('.').count() == 3);
    // Films are no part of these stacks; `film.rs` asks for theirs. The arm is no part of a law.
    let others = ["contact.film.", "contact.slip-lever."];
    let told: BTreeSet<String> = parts.filter(|path| !others.iter().any(|other| path.starts_with(other))).collect();
    assert_eq!(asked, told);
}
