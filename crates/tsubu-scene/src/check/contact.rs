//! Parts of the contact law that need one another.

use super::Parts;
use crate::complaint::Complaint;
use crate::plan::{Cohesion, Contact, Normal, Rolling, Tangential, Twisting};

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(contact) = parts.resolved.get("contact").and_then(|contact| contact.clone().try_into::<Contact>().ok())
    else {
        return;
    };
    let hertz = matches!(contact.normal, Normal::Hertz {});
    let sprung = matches!(contact.tangential, Tangential::Mindlin { .. } | Tangential::Spring { .. });
    let mut wants = |part: [&str; 2], other: [&str; 2], why: &str, hint: &str| {
        complaints.push(unfit(parts, part, other, why, hint));
    };
    match contact.tangential {
        Tangential::Mindlin { .. } if !hertz => wants(
            ["tangential", "mindlin"],
            ["normal", "hooke"],
            "its stiffness comes from `normal.hertz`",
            "with `normal.hooke` write tangential.spring = {}, or tangential.coulomb = {}",
        ),
        Tangential::Spring { .. } if hertz => wants(
            ["tangential", "spring"],
            ["normal", "hertz"],
            "its stiffness is a share of that of `normal.hooke`",
            "with `normal.hertz` write tangential.mindlin = {}",
        ),
        _ => {}
    }
    let cohesion = match contact.cohesion {
        Cohesion::Dmt {} => Some("dmt"),
        Cohesion::Jkr {} => Some("jkr"),
        Cohesion::None {} | Cohesion::Sjkr {} | Cohesion::Constant {} => None,
    };
    if let (Some(name), false) = (cohesion, hertz) {
        wants(
            ["cohesion", name],
            ["normal", "hooke"],
            "it is a theory of elastic spheres, `normal.hertz`",
            "with `normal.hooke` write cohesion.sjkr = {} or cohesion.constant = {}",
        );
    }
    let tangential = match contact.tangential {
        Tangential::None {} => "none",
        Tangential::Coulomb { .. } => "coulomb",
        Tangential::Mindlin { .. } => "mindlin",
        Tangential::Spring { .. } => "spring",
    };
    let hint = "write tangential.mindlin = {} with `normal.hertz`, tangential.spring = {} with `normal.hooke`";
    if matches!(contact.rolling, Rolling::Epsd2 {}) && !sprung {
        wants(["rolling", "epsd2"], ["tangential", tangential], "its stiffness is that of a tangential spring", hint);
    }
    if matches!(contact.twisting, Twisting::Spring {}) && !sprung {
        wants(["twisting", "spring"], ["tangential", tangential], "its stiffness is that of a tangential spring", hint);
    }
}

/// Points at the part if it was typed; a default does not stand in the file, so then at the other one.
fn unfit(parts: &Parts<'_>, part: [&str; 2], other: [&str; 2], why: &str, hint: &str) -> Complaint {
    let typed = |part: [&str; 2]| parts.root.find(&["contact", part[0], part[1]]).is_some();
    let place = |part: [&str; 2]| parts.root.locate(&["contact", part[0], part[1]]);
    let [name, with] = [part, other].map(|[key, choice]| format!("{key}.{choice}"));
    let complaint = Complaint::new(format!("`{name}` does not go with `{with}`"));
    let complaint = match (typed(part), typed(other)) {
        (true, true) => complaint.at(&place(part), why).also(&place(other), "chosen here"),
        (true, false) => complaint.at(&place(part), why).hint(format!("`{with}` is the default")),
        (false, _) => complaint.at(&place(other), "chosen here").hint(format!("`{name}` is the default; {why}")),
    };
    complaint.hint(hint)
}
