//! The stacks of parts that a scene can build.

use super::{Subject, constants};
use std::sync::LazyLock;
use tsubu::contact::Law;
use tsubu_scene::plan::{
    Cohesion, Contact, Damping, Film, MindlinForm, Normal, Rolling, SlipLever, Tangential, Twisting,
};

/// Hertz and nothing else.
pub fn hertz() -> Contact {
    Contact {
        normal: Normal::Hertz {},
        damping: Damping::None {},
        attraction: false,
        tangential: Tangential::None {},
        rolling: Rolling::None {},
        twisting: Twisting::None {},
        cohesion: Cohesion::None {},
        film: Film::None {},
        pulled_friction: false,
        rotation: true,
        slip_lever: SlipLever::Middle,
    }
}

/// Hooke and nothing else.
pub fn hooke(stiffness: f64) -> Contact {
    Contact { normal: Normal::Hooke { stiffness }, ..hertz() }
}

/// Mindlin with the default dashpot.
pub fn mindlin(form: MindlinForm) -> Tangential {
    Tangential::Mindlin { form, damping: None }
}

/// An example of each normal force.
pub fn normals() -> Vec<Normal> {
    let (stiffness, unloading_ratio, adhesion_ratio, plasticity_depth) = (1e5, 4.0, 1.5, 0.05);
    let luding = Normal::Luding { stiffness, unloading_ratio, adhesion_ratio, plasticity_depth };
    vec![Normal::Hertz {}, Normal::Hooke { stiffness }, luding]
}

fn dampings() -> Vec<Damping> {
    vec![
        Damping::Quarter {},
        Damping::None {},
        Damping::Sqrt { reference_speed: 1.0 },
        Damping::Linear { reference_speed: 1.0 },
        Damping::Rate { rate: 1e4 },
        Damping::Viscoelastic { coefficient: 1e7 },
        Damping::Dashpot { coefficient: 0.5 },
    ]
}

fn tangentials(normal: &Normal) -> Vec<Tangential> {
    let coulomb = Tangential::Coulomb { smoothing_speed: 1e-3 };
    match normal.stiffness() {
        None => {
            let [a, b] = [MindlinForm::Incremental, MindlinForm::Secant].map(mindlin);
            vec![a, b, coulomb, Tangential::None {}]
        }
        Some(_) => {
            vec![Tangential::Spring { ratio: 0.3, damping: 0.5, cohesion: 0.01 }, coulomb, Tangential::None {}]
        }
    }
}

fn rollings() -> Vec<Rolling> {
    vec![
        Rolling::None {},
        Rolling::Constant { smoothing_speed: 1e-3 },
        Rolling::Viscous { coefficient: 10.0 },
        Rolling::Epsd { ratio: 2.25, damping_ratio: 0.3 },
        Rolling::Epsd2 {},
        Rolling::Spring { stiffness: 1e4, damping: 1e-2 },
        Rolling::ContactWidth { smoothing_speed: 1e-3 },
    ]
}

fn twistings() -> Vec<Twisting> {
    vec![Twisting::None {}, Twisting::Sliding { smoothing_spin: 1e-2 }, Twisting::Spring {}]
}

fn cohesions() -> Vec<Cohesion> {
    vec![Cohesion::None {}, Cohesion::Dmt {}, Cohesion::Sjkr {}, Cohesion::Constant {}, Cohesion::Jkr {}]
}

/// What the scene refuses.
fn refused(c: &Contact) -> bool {
    let spring = matches!(c.tangential, Tangential::Mindlin { .. } | Tangential::Spring { .. });
    let needs_spring = matches!(c.rolling, Rolling::Epsd2 {}) || matches!(c.twisting, Twisting::Spring {});
    let told = c.normal.stiffness().is_some();
    needs_spring && !spring || told && matches!(c.cohesion, Cohesion::Jkr {})
}

/// Whether its bodies may hold each other.
pub fn attracts(c: &Contact) -> bool {
    !matches!(c.cohesion, Cohesion::None {}) || !c.normal.elastic()
}

/// Every stack, with the number of choices in which it differs from the first of its normal force.
fn stacks() -> Vec<(usize, Contact)> {
    let mut stacks = Vec::new();
    for normal in normals() {
        for (d, damping) in dampings().into_iter().enumerate() {
            for (a, attraction) in [false, true].into_iter().enumerate() {
                for (t, tangential) in tangentials(&normal).into_iter().enumerate() {
                    for (r, rolling) in rollings().into_iter().enumerate() {
                        for (w, twisting) in twistings().into_iter().enumerate() {
                            for (c, cohesion) in cohesions().into_iter().enumerate() {
                                let away = [d, a, t, r, w, c].into_iter().filter(|i| *i > 0).count();
                                let contact = Contact {
                                    normal: normal.clone(),
                                    damping: damping.clone(),
                                    attraction,
                                    tangential: tangential.clone(),
                                    rolling: rolling.clone(),
                                    twisting: twisting.clone(),
                                    cohesion,
                                    film: Film::None {},
                                    pulled_friction: false,
                                    rotation: true,
                                    slip_lever: SlipLever::Middle,
                                };
                                if !refused(&contact) {
                                    stacks.push((away, contact));
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    stacks
}

/// The laws of all stacks at work.
pub static ALL: LazyLock<Vec<Subject>> = LazyLock::new(|| stacks().into_iter().map(|(_, c)| subject(&c)).collect());

/// The laws of the stacks in which every choice meets every other, at work.
pub static PAIRS: LazyLock<Vec<Subject>> =
    LazyLock::new(|| stacks().into_iter().filter(|(away, _)| *away <= 2).map(|(_, c)| subject(&c)).collect());

/// A stack at work. The search for the damping number takes longer than all the rest, so it is done once for each kind.
pub fn subject(contact: &Contact) -> Subject {
    static KNOWN: LazyLock<Vec<(Normal, Damping, bool, f64)>> = LazyLock::new(|| {
        let mut known = Vec::new();
        for normal in normals() {
            for damping in dampings() {
                for attraction in [false, true] {
                    let (normal, damping) = (normal.clone(), damping.clone());
                    let contact = Contact { normal, damping, attraction, ..hertz() };
                    let mut pair = constants();
                    Law::new(&contact).prepare(&mut pair);
                    known.push((contact.normal, contact.damping, attraction, pair.damping));
                }
            }
        }
        known
    });
    let mut constants = constants();
    constants.cohesion = if matches!(contact.cohesion, Cohesion::Sjkr {}) { 5e5 } else { 0.05 };
    Law::new(&Contact { damping: Damping::None {}, ..contact.clone() }).prepare(&mut constants);
    let same = |(normal, damping, attraction, _): &&(Normal, Damping, bool, f64)| {
        (normal, damping, attraction) == (&contact.normal, &contact.damping, &contact.attraction)
    };
    constants.damping = KNOWN.iter().find(same).unwrap().3;
    Subject { contact: contact.clone(), law: Law::new(contact), constants, spoil: |_| {} }
}
