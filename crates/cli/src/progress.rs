//! How far a render is: on a terminal a line that is redrawn, elsewhere nothing.

use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;

/// A bar over `total` samples, after `heading`, with samples per second and time left, on standard error when that is a terminal.
pub(crate) fn bar(total: u64, heading: &str) -> ProgressBar {
    let bar = ProgressBar::new(total).with_prefix(heading.to_owned());
    let rate = |state: &ProgressState, out: &mut dyn Write| {
        // The width of the number is bounded, so a failure to write can only come from the terminal itself.
        let _ = write!(out, "{}", HumanCount(state.per_sec() as u64));
    };
    let template = "{prefix}{bar:32} {percent:>3} %  {rate} samples/s  {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.with_key("rate", rate));
    }
    bar
}
