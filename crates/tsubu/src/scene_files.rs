//! The scene as it stands in the folders of results.

use tsubu_frame::{FileError, RunFolder};
use tsubu_scene::Scene;

/// The files that [`write`] writes.
pub(crate) fn names(scene: &Scene) -> Vec<String> {
    scene.companions().into_iter().map(|(name, _)| name).chain(["scene.toml".to_owned()]).collect()
}

/// Writes `scene.toml` with every default, and beside it the files that it names, so that the folder alone runs again.
pub(crate) fn write(folder: &RunFolder, scene: &Scene) -> Result<(), FileError> {
    // The scene comes last: where it stands, all that it needs stands too.
    for (name, bytes) in scene.companions() {
        folder.write_editable(&name, &bytes)?;
    }
    folder.write_editable("scene.toml", scene.resolved_toml().as_bytes())
}
