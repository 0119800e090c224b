//! `pellicle merge`.

use crate::{output, print};
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::progressive::{Merged, merge};
use std::path::PathBuf;

/// Join parts of a picture (`render --part`), or different samples of it (`render --samples-from`).
///
/// Parts give the bits of the whole picture, samples their mean with the variance of all. Files that are missing, there twice, damaged or of another
/// render are refused.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The spectral images (.exr) to join, in any order
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// The joined spectral image (.exr)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Checks, joins and writes.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let target = &arguments.output;
    let is_exr = target
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    if !is_exr {
        return Err(miette!(
            help = "end it in .exr, and develop the picture from it with `pellicle develop`",
            "-o {}: a spectral image with this ending cannot be written",
            target.display()
        ));
    }
    for part in &arguments.parts {
        output::check_place("-o", target, part)?;
    }
    let merged = merge(&arguments.parts, target);
    let merged = merged
        .into_diagnostic()
        .wrap_err("the files were not joined")?;
    print::note(format_args!(
        "wrote {} from {} {}",
        target.display(),
        arguments.parts.len(),
        match merged {
            Merged::Parts => "parts of the picture",
            Merged::Ranges => "ranges of samples",
        }
    ));
    Ok(())
}
