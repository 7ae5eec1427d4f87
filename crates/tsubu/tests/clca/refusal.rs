//! What CL-CA cannot do, it says: with the key and a way out.

use super::BOX;
use std::path::Path;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

fn message(changes: &[&str]) -> String {
    message_of(BOX, changes)
}

fn message_of(text: &str, changes: &[&str]) -> String {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    let scene = match Scene::parse("test", text, Path::new("."), &changes) {
        Ok(scene) => scene,
        Err(complaints) => return complaints.to_string(),
    };
    let hosts = Hosts::new(&scene.plan().hosts);
    tsubu::methods::open(scene.plan(), &hosts).err().map_or_else(|| "accepted".to_owned(), |error| error.to_string())
}

#[test]
fn what_is_wrong_is_refused_by_name() {
    assert_eq!(message(&[]), "accepted");
    let sand = message_of(&format!("{BOX}shapes.sand.hexagon.radius = 1\n"), &[]);
    assert!(sand.contains("cl-ca.shapes.sand: there is no group"), "{sand}");
    let mut wrong = Vec::new();
    for (changes, parts) in [
        (&["cl-ca.spacing=0.05 mm"][..], &["particles.large.diameter", "cl-ca.spacing"][..]),
        (&["cl-ca.shapes.rods.points.at=[[0,0],[0,4]]"], &["cl-ca.shapes.rods.points.at", "connected"]),
        (&["cl-ca.shapes.rods.points.at=[[0,0],[0.5,1.5]]"], &["cl-ca.shapes.rods.points.at", "whole numbers"]),
        (&["cl-ca.memory=0"], &["cl-ca.memory", "at least 1"]),
        (&["cl-ca.spacing=-1 mm"], &["cl-ca.spacing", "above 0"]),
        (&["cl-ca.spacing=1 nm"], &["particles.large.diameter"]),
        (&["dimension=3"], &["three"]),
        (&["gravity=[1, -9.8]"], &["gravity", "turn the scene"]),
        (&["particles.small.count=420"], &["particles.small.start", "no room"]),
        (&["cl-ca.rule=active", "walls.box.motion.signal.steady.rate=1 mm/s"], &["cl-ca.rule", "passive"]),
        (&["cl-ca.turning=true", "cl-ca.rule=passive"], &["cl-ca.turning"]),
        (&["gravity=0"], &["gravity", "nothing happens"]),
        (&["periodic.x=[0, 0.04]"], &["periodic"]),
    ] {
        let text = message(changes);
        if !parts.iter().all(|part| text.contains(part)) {
            wrong.push(format!("{changes:?} wanted {parts:?}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
