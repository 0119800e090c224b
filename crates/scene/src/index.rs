//! An index of refraction outside a scene.

use crate::description::Index;
use crate::{Folder, Problems, validate};
use spectra::OpticalConstants;

/// The optical constants that `index` describes, and what was assumed of its files, a line each; files that it names are looked for from `folder` and must
/// lie in it.
///
/// What wavelengths will be asked for is not known here: that a table is too short shows when it is read.
///
/// ```
/// use pellicle_scene::{description::Index, optical_constants};
/// let gold = Index::Name("gold".to_owned());
/// let (constants, _) = optical_constants(&gold, "").unwrap();
/// assert!(constants.k.at(600.0).unwrap() > 2.0);
/// assert!(constants.k.at(1e5).is_err());
/// ```
///
/// # Errors
/// Everything that is wrong with the index, and with the file that it names. The fields of the problems start at the
/// index: `n[2]` is the third value of its table.
pub fn optical_constants(
    index: &Index,
    folder: impl Into<Folder>,
) -> Result<(OpticalConstants, Vec<String>), Problems> {
    validate::optical_constants(index, &folder.into()).map_err(Problems::of_index)
}
