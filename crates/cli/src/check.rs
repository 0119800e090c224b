//! `pellicle check`.

use crate::{memory, print};
use pellicle::scene_file::SceneFile;
use std::path::Path;

/// Validates a scene and prints a summary in one line.
pub(crate) fn run(path: &Path, allow_outside: bool) -> miette::Result<()> {
    let file = SceneFile::read(path)?.allow_outside(allow_outside);
    let scene = file.validate()?;
    print::notes(scene.notes());
    let settings = scene.settings();
    print::result(format_args!(
        "{}: valid; {}×{} pixels, {}, {}, {}, {}; {}",
        print::name(path),
        settings.width,
        settings.height,
        counted(settings.bands.count(), "band"),
        counted(settings.samples, "sample"),
        counted(scene.objects().len(), "object"),
        light(scene.lamps(), scene.is_lit_by_environment()),
        memory::of_picture(&scene),
    ))
}

/// `1 object`, `2 objects`.
fn counted(count: impl TryInto<u64>, what: &str) -> String {
    let count = count.try_into().unwrap_or(u64::MAX);
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// What lights the scene, in words.
fn light(lamps: usize, is_lit_by_environment: bool) -> String {
    match (lamps, is_lit_by_environment) {
        (0, false) => "no light".to_owned(),
        (0, true) => "lit by its environment".to_owned(),
        (lamps, false) => counted(lamps, "light"),
        (lamps, true) => format!("{}, and an environment", counted(lamps, "light")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_reported_in_words() {
        for (lamps, environment, words) in [
            (0, false, "no light"),
            (0, true, "lit by its environment"),
            (1, false, "1 light"),
            (2, true, "2 lights, and an environment"),
        ] {
            assert_eq!(light(lamps, environment), words);
        }
        assert_eq!(counted(1_u32, "object"), "1 object");
    }
}
