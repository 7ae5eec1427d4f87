//! The scene as it stands in the folders of results.

use tsubu_frame::{FileError, RunFolder};
use tsubu_scene::Scene;

/// Writes `scene.toml` with every default, and beside it the files that it names, so that the folder alone runs again.
pub(crate) fn write(folder: &RunFolder, scene: &Scene) -> Result<(), FileError> {
    // The scene comes last: where it stands, all that it needs stands too.
    let companions = scene.companions();
    tsubu_frame::folder::list(folder.path(), companions.iter().map(|(name, _)| name.as_str()))?;
    for (name, bytes) in companions {
        folder.write(&name, &bytes)?;
    }
    folder.write("scene.toml", scene.resolved_toml().as_bytes())
}
