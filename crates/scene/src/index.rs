//! An index of refraction outside a scene.

use crate::description::Index;
use crate::validate;
use document::{Folder, Problems};
use spectra::OpticalConstants;

/// Returns the optical constants of `index`, and the assumptions about its files, one line each. Paths of files are relative to `folder`,
/// and the files must be in it.
///
/// The wavelengths of interest are not known here: reading a table outside its range fails later.
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
/// All problems of the index, and of the file that it names. The fields of the problems start at the index: `n[2]` is the third value of
/// its table.
pub fn optical_constants(
    index: &Index,
    folder: impl Into<Folder>,
) -> Result<(OpticalConstants, Vec<String>), Problems> {
    validate::optical_constants(index, &folder.into())
        .map_err(|list| Problems::of_program("the index", list))
}
