//! Parts of the contact law that need one another.

mod cohesion;

use super::Parts;
use crate::complaint::Complaint;
use crate::plan::{Contact, MaterialPair, Normal, Rolling, Strength, Tangential, Twisting};

/// A stack of parts: the scene's, or that of a pair of materials.
struct Stack<'a> {
    parts: &'a Parts<'a>,
    contact: Contact,
    /// Number and names of the pair.
    pair: Option<(&'a str, &'a [String; 2])>,
}

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let contact = parts.resolved.get("contact").and_then(|contact| contact.clone().try_into::<Contact>().ok());
    let pairs = super::list::<MaterialPair>(parts.resolved, "material-pair");
    if let Some(contact) = &contact {
        stack(&Stack { parts, contact: contact.clone(), pair: None }, complaints);
    }
    for (index, pair) in &pairs {
        if let Some(contact) = &pair.contact {
            stack(&Stack { parts, contact: contact.clone(), pair: Some((index, &pair.between)) }, complaints);
        }
    }
    if let Some(contact) = &contact {
        cohesion::check(parts, contact, &pairs, complaints);
    }
}

fn stack(stack: &Stack<'_>, complaints: &mut Vec<Complaint>) {
    let contact = &stack.contact;
    let hertz = matches!(contact.normal, Normal::Hertz {});
    let [normal, tangential, cohesion] = [contact.normal.name(), contact.tangential.name(), contact.cohesion.name()];
    let mut wants = |part: [&str; 2], other: [&str; 2], why: &str, hint: &str| {
        complaints.extend(stack.unfit(part, other, why, hint));
    };
    match contact.tangential {
        Tangential::Mindlin { .. } if !hertz => wants(
            ["tangential", tangential],
            ["normal", normal],
            "its stiffness comes from `normal.hertz`",
            &format!("with `normal.{normal}` write tangential.spring = {{}}, or tangential.coulomb = {{}}"),
        ),
        Tangential::Spring { .. } if hertz => wants(
            ["tangential", tangential],
            ["normal", normal],
            "its stiffness is a share of that of `normal.hooke`",
            "with `normal.hertz` write tangential.mindlin = {}",
        ),
        _ => {}
    }
    if contact.cohesion.strength() == Some(Strength::SurfaceEnergy) && !hertz {
        wants(
            ["cohesion", cohesion],
            ["normal", normal],
            "it is a theory of elastic spheres, `normal.hertz`",
            &format!("with `normal.{normal}` write cohesion.sjkr = {{}} or cohesion.constant = {{}}"),
        );
    }
    let hint = "write tangential.mindlin = {} with `normal.hertz`, tangential.spring = {} with `normal.hooke`";
    let sprung = contact.tangential.sprung();
    if matches!(contact.rolling, Rolling::Epsd2 {}) && !sprung {
        wants(["rolling", "epsd2"], ["tangential", tangential], "its stiffness is that of a tangential spring", hint);
    }
    if matches!(contact.twisting, Twisting::Spring {}) && !sprung {
        wants(["twisting", "spring"], ["tangential", tangential], "its stiffness is that of a tangential spring", hint);
    }
}

impl Stack<'_> {
    /// Points at the part if it was typed; a default does not stand in the file, so then at the other one. A pair that only
    /// inherits both is left alone: the scene's stack has the complaint.
    fn unfit(&self, part: [&str; 2], other: [&str; 2], why: &str, hint: &str) -> Option<Complaint> {
        let own = |part| self.pair.map_or_else(|| at(&[], part), |(index, _)| at(&["material-pair", index], part));
        let root = self.parts.root;
        let typed = |part| [own(part), at(&[], part)].into_iter().find(|path| root.find(path).is_some());
        let place = |path: Option<Vec<&str>>| root.locate(&path.unwrap_or(vec!["contact"]));
        let names = |part| self.pair.is_none() || root.find(&own(part)).is_some();
        if !names(part) && !names(other) {
            return None;
        }
        let [name, with] = [part, other].map(|[key, choice]| format!("{key}.{choice}"));
        let pair = self.pair.map_or_else(String::new, |(_, [a, b])| format!(" between `{a}` and `{b}`"));
        let complaint = Complaint::new(format!("`{name}` does not go with `{with}`{pair}"));
        let complaint = match (typed(part), typed(other)) {
            (part_at, None) => complaint.at(&place(part_at), why).hint(format!("`{with}` is the default")),
            (None, other_at) => {
                complaint.at(&place(other_at), "chosen here").hint(format!("`{name}` is the default; {why}"))
            }
            (part_at, other_at) if names(part) => {
                complaint.at(&place(part_at), why).also(&place(other_at), "chosen here")
            }
            (part_at, other_at) => complaint.at(&place(other_at), "chosen here").also(&place(part_at), why),
        };
        let inherits = self.pair.is_some() && !(names(part) && names(other));
        let inherited = inherits.then(|| "what a pair does not name is as in `[contact]`".to_string());
        Some(complaint.hints(inherited).hint(hint))
    }
}

fn at<'a>(table: &[&'a str], [key, choice]: [&'a str; 2]) -> Vec<&'a str> {
    [table, &["contact", key, choice]].concat()
}
