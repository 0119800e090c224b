//! The options that choose the formula for R and T.

use clap::ValueEnum;
use miette::miette;
use pellicle::coating::{Model, PathDifference};

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum ModelName {
    /// All beams, however often they are reflected, for any stack
    Exact,
    /// Only the two beams that are reflected once, for one film that does not absorb, between equal media
    #[value(name = "two_beam")]
    TwoBeam,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum PathName {
    /// 2 n d cos θ, the physical path difference
    Optical,
    /// 2 d cos θ, without the index
    #[value(name = "as_printed")]
    AsPrinted,
}

/// The model that the two options choose.
pub(super) fn model(model: ModelName, path: Option<PathName>) -> miette::Result<Model> {
    match (model, path) {
        (ModelName::Exact, None) => Ok(Model::Exact),
        (ModelName::Exact, Some(_)) => Err(miette!(
            help = "leave it out, or add --model two_beam",
            "--path-difference: a path difference applies only to the two_beam model"
        )),
        (ModelName::TwoBeam, Some(PathName::AsPrinted)) => {
            Ok(Model::TwoBeam(PathDifference::AsPrinted))
        }
        (ModelName::TwoBeam, None | Some(PathName::Optical)) => {
            Ok(Model::TwoBeam(PathDifference::Optical))
        }
    }
}

/// The remark on a model after the label of a stack; empty for the exact one.
pub(super) fn remark(model: Model) -> String {
    match model.path_difference() {
        None => String::new(),
        Some(path) => format!(", two beams, path difference {path}"),
    }
}
