//! Checks that many fields of a scene share.

use crate::limits;
use document::{FieldPath, Folder, Problem, ProblemKind, Shown};
use glam::DVec3;
use scene::{Distribution, Energy};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// The checks of a scene, and what all of them need to know. A check returns the value if it is valid.
#[derive(Debug)]
pub(crate) struct Checks {
    document: document::Checks,
    /// Time of the picture, s.
    pub(crate) time_s: f64,
    /// Energy tables of the rough surfaces so far: surfaces with equal parameters share one.
    energies: Vec<(Distribution, [f64; 2], Arc<Energy>)>,
}

impl Deref for Checks {
    type Target = document::Checks;

    fn deref(&self) -> &document::Checks {
        &self.document
    }
}

impl DerefMut for Checks {
    fn deref_mut(&mut self) -> &mut document::Checks {
        &mut self.document
    }
}

impl Checks {
    pub(crate) fn new(folder: &Folder) -> Self {
        Self {
            document: document::Checks::new(folder),
            time_s: 0.0,
            energies: Vec::new(),
        }
    }

    /// As [`document::Checks::finish`].
    pub(crate) fn finish<T>(self, value: Option<T>) -> Result<(T, Vec<String>), Vec<Problem>> {
        self.document.finish(value)
    }

    /// The energy table of a rough surface.
    pub(crate) fn energy(
        &mut self,
        distribution: Distribution,
        roughness: [f64; 2],
    ) -> Arc<Energy> {
        let is_same = |known: &&(Distribution, [f64; 2], Arc<Energy>)| {
            (known.0, known.1) == (distribution, roughness)
        };
        if let Some((.., energy)) = self.energies.iter().find(is_same) {
            return Arc::clone(energy);
        }
        let energy = Arc::new(prepare::energy(distribution, roughness));
        self.energies
            .push((distribution, roughness, Arc::clone(&energy)));
        energy
    }

    /// Checks that the coordinates of a point are in range.
    pub(crate) fn point(&mut self, field: &FieldPath, point: [f64; 3]) -> Option<DVec3> {
        let mut is_sound = true;
        for (index, &value) in point.iter().enumerate() {
            let coordinate = self.number(&field.index(index), value, &limits::COORDINATE);
            is_sound &= coordinate.is_some();
        }
        is_sound.then_some(DVec3::from_array(point))
    }

    /// Normalizes a direction, which may have any length except 0.
    pub(crate) fn direction(&mut self, field: &FieldPath, direction: [f64; 3]) -> Option<DVec3> {
        let vector = self.point(field, direction)?;
        if vector.length() < limits::MIN_DISTANCE {
            let message = format!(
                "found {}, which has no direction; its length must be at least {}",
                shown(vector),
                Shown(limits::MIN_DISTANCE)
            );
            self.report(Problem::new(ProblemKind::OutOfRange, field, message));
            return None;
        }
        Some(vector.normalize())
    }

    /// The vector between two points, which must differ; otherwise the problem is reported at `field`.
    ///
    /// They must be far enough apart to differ when they are rounded to `f32`.
    pub(crate) fn distance(
        &mut self,
        (field, to): (&FieldPath, DVec3),
        (other, from): (&FieldPath, DVec3),
    ) -> Option<DVec3> {
        let largest = from.abs().max_element().max(to.abs().max_element());
        let least = limits::MIN_DISTANCE * largest.max(1.0);
        let vector = to - from;
        if vector.length() >= least {
            return Some(vector);
        }
        let message = format!(
            "found {}, which is not far enough from `{other}` {}; the two must be at least {least:.1e} apart",
            shown(to),
            shown(from),
        );
        let problem = Problem::new(ProblemKind::Inconsistent, field, message);
        self.report(problem.involving(other.clone()));
        None
    }

    /// The component of the unit vector `up` perpendicular to the unit vector `axis`, normalized.
    pub(crate) fn across(
        &mut self,
        (field, up): (&FieldPath, DVec3),
        (axis, what): (DVec3, &str),
        involved: &[FieldPath],
    ) -> Option<DVec3> {
        let across = up - axis * up.dot(axis);
        if across.length() >= limits::MIN_SINE {
            return Some(across.normalize());
        }
        let message = format!(
            "found a direction parallel to {what} {}; it must have another direction",
            shown(axis)
        );
        let problem = Problem::new(ProblemKind::Inconsistent, field, message);
        self.report(involved.iter().cloned().fold(problem, Problem::involving));
        None
    }
}

/// Checks the width and height of a picture on a surface; the inner `None` means that the surface determines them.
#[expect(clippy::option_option, reason = "the outer one is the check's result")]
pub(crate) fn placed_size(
    checks: &mut Checks,
    field: &FieldPath,
    size: Option<[f64; 2]>,
) -> Option<Option<[f64; 2]>> {
    let Some([width, height]) = size else {
        return Some(None);
    };
    let width = checks.number(&field.index(0), width, &limits::LENGTH);
    let height = checks.number(&field.index(1), height, &limits::LENGTH);
    Some(Some([width?, height?]))
}

/// A vector as TOML writes it.
fn shown(vector: DVec3) -> String {
    let [x, y, z] = vector.to_array().map(Shown);
    format!("[{x}, {y}, {z}]")
}
