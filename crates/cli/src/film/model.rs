//! By which formula R and T are computed, as options say it.

use clap::ValueEnum;
use miette::miette;
use pellicle::coating::{Model, PathDifference};

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum ModelName {
    /// All beams, however often they are reflected
    Exact,
    /// The two beams that are reflected once by one film that does not absorb, between equal media
    #[value(name = "two_beam")]
    TwoBeam,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum PathName {
    /// 2 n d cos θ, as physics has it
    Optical,
    /// 2 d cos θ, without the index
    #[value(name = "as_printed")]
    AsPrinted,
}

/// The model that both options name.
pub(super) fn model(model: ModelName, path: Option<PathName>) -> miette::Result<Model> {
    match (model, path) {
        (ModelName::Exact, None) => Ok(Model::Exact),
        (ModelName::Exact, Some(_)) => Err(miette!(
            help = "leave it out, or add --model two_beam",
            "--path-difference: the exact model has no choice of path difference"
        )),
        (ModelName::TwoBeam, Some(PathName::AsPrinted)) => {
            Ok(Model::TwoBeam(PathDifference::AsPrinted))
        }
        (ModelName::TwoBeam, None | Some(PathName::Optical)) => {
            Ok(Model::TwoBeam(PathDifference::Optical))
        }
    }
}

/// What is said of a model behind the label of a stack: nothing of the exact one.
pub(super) fn remark(model: Model) -> String {
    match model.path_difference() {
        None => String::new(),
        Some(path) => format!(", two beams, path difference {path}"),
    }
}
