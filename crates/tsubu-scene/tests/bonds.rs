//! Bonds that cannot be.

use std::path::Path;
use tsubu_scene::Scene;

const GRAINS: &str = "duration = '1 s'\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n[particles.grains]\n\
     material = 'rock'\ndiameter = '2 mm'\nstart.at.position = [[0, 0], ['2 mm', 0]]\n";

fn complaints(more: &str) -> String {
    match Scene::parse("scene.toml", &format!("{GRAINS}{more}"), Path::new(""), &[]) {
        Ok(_) => panic!("nothing is wrong with {more}"),
        Err(complaints) => complaints.to_string(),
    }
}

#[test]
fn bonds_that_cannot_be() {
    let scenes = [
        "[[bond]]\ngap = 0.1\n",
        "[[bond]]\nyoung-modulus = '1 GPa'\nparticles = ['grain']\n",
        "[[bond]]\nyoung-modulus = '1 GPa'\nweibull-modulus = 4\n",
        "[[bond]]\nyoung-modulus = '1 GPa'\nat = '2 s'\n",
        "[[bond]]\nyoung-modulus = '1 GPa'\n[contact]\nrotation = false\n",
        "[[bond]]\nyoung-modulus = '1 GPa'\n[dem]\nintegrator = 'symplectic-euler'\n",
        "[[bond]]\nyoung-modulus = '-1 GPa'\ntensile-strength = '1 MPa'\nstrength = 3\n",
    ];
    insta::assert_snapshot!(scenes.map(complaints).join("\n"));
}
