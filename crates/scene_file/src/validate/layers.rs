//! The layers of films and coatings: one written in the material itself, or a list.

use super::checks::Checks;
use super::spectrum_list::SpectrumList;
use super::thickness;
use crate::description::{self, FilmModel, PathDifference};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind};
use scene::{Interference, Layer};

/// Layers as written in a material.
#[derive(Clone, Copy)]
pub(super) struct Written<'a> {
    pub(super) index: Option<&'a description::Index>,
    pub(super) thickness_nm: Option<&'a description::Thickness>,
    pub(super) layers: Option<&'a [description::Layer]>,
}

impl Written<'_> {
    /// Checks the layers of the material at `field`; there is at least one.
    pub(super) fn check(
        self,
        checks: &mut Checks,
        spectra: &mut SpectrumList,
        field: &FieldPath,
    ) -> Option<Vec<Layer>> {
        match (self.index, self.thickness_nm, self.layers) {
            (Some(index), Some(thickness_nm), None) => {
                let layer = check_layer(checks, spectra, field, (index, thickness_nm))?;
                Some(vec![layer])
            }
            (None, None, Some(layers)) => check_list(checks, spectra, &field.key("layers"), layers),
            (index, thickness_nm, layers) => {
                let given = [
                    ("index", index.is_some()),
                    ("thickness_nm", thickness_nm.is_some()),
                    ("layers", layers.is_some()),
                ];
                report_forms(checks, field, given);
                None
            }
        }
    }
}

/// Reports fields that match neither form.
fn report_forms(checks: &mut Checks, field: &FieldPath, given: [(&str, bool); 3]) {
    let found: Vec<_> = given
        .iter()
        .filter(|(_, is_given)| *is_given)
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    let found = match found.as_slice() {
        [] => "neither a layer nor a list of layers".to_owned(),
        names => names.join(" and "),
    };
    let message = format!(
        "found {found}; it must have `index` and `thickness_nm` (one layer) or `layers` (several)"
    );
    let kind = if given[2].1 {
        ProblemKind::Inconsistent
    } else {
        ProblemKind::MissingField
    };
    let help = "layers = [{ index = \"silica\", thickness_nm = 100 }, { index = \"gold\", thickness_nm = 20 }]";
    checks.report(Problem::new(kind, field, message).help(help));
}

fn check_list(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    layers: &[description::Layer],
) -> Option<Vec<Layer>> {
    if layers.is_empty() || layers.len() > limits::MAX_LAYERS {
        let message = format!(
            "found {} layers; there must be from 1 to {}",
            layers.len(),
            limits::MAX_LAYERS
        );
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
        return None;
    }
    let checked: Vec<_> = layers
        .iter()
        .enumerate()
        .map(|(place, layer)| {
            let written = (&layer.index, &layer.thickness_nm);
            check_layer(checks, spectra, &field.index(place), written)
        })
        .collect();
    checked.into_iter().collect()
}

fn check_layer(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    (index, thickness_nm): (&description::Index, &description::Thickness),
) -> Option<Layer> {
    let index = spectra.index(checks, &field.key("index"), index);
    let thickness = thickness::check(checks, &field.key("thickness_nm"), thickness_nm);
    let (n, k) = index?;
    Some(Layer {
        n,
        k,
        thickness: thickness?,
    })
}

/// Checks the interference model: the two-beam formula is for a single layer that does not absorb.
pub(super) fn check_interference(
    checks: &mut Checks,
    spectra: &SpectrumList,
    field: &FieldPath,
    (model, path_difference): (FilmModel, Option<PathDifference>),
    layers: &[Layer],
) -> Option<Interference> {
    if model == FilmModel::Exact {
        if path_difference.is_none() {
            return Some(Interference::Exact);
        }
        let message = "a path difference applies only to the two_beam model";
        let field = field.key("path_difference");
        let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
        checks.report(problem.help("leave it out, or write model = \"two_beam\""));
        return None;
    }
    let is_fit =
        matches!(layers, [only] if spectra.is_black(only.k) && spectra.least(only.n) >= 1.0);
    if !is_fit {
        let message =
            "the two-beam model is for a single layer with n ≥ 1 that does not absorb (k = 0)";
        let field = field.key("model");
        let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
        checks.report(problem.help("write model = \"exact\" for any stack"));
        return None;
    }
    Some(Interference::TwoBeam(
        path_difference.unwrap_or(PathDifference::Optical),
    ))
}
