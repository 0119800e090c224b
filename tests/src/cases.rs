//! Suites whose cases are made at run time: one for each function, or for each scene.

use libtest_mimic::{Arguments, Trial};
use std::process::ExitCode;

/// Runs the cases that the arguments select, as the harness of `#[test]` does.
pub fn run(cases: Vec<Trial>) -> ExitCode {
    libtest_mimic::run(&Arguments::from_args(), cases).exit_code()
}

/// A case that fails when the function panics.
pub fn case(name: impl Into<String>, run: impl FnOnce() + Send + 'static) -> Trial {
    Trial::test(name, move || {
        run();
        Ok(())
    })
}

/// Prints what was measured if the harness got `--nocapture`, because it captures nothing itself.
pub fn report(measured: &str) {
    if std::env::args().any(|argument| argument == "--nocapture") {
        println!("{measured}");
    }
}

/// A case of several comparisons, which fails if any of them does.
pub fn comparisons(
    name: impl Into<String>,
    run: impl FnOnce() -> Vec<Result<String, String>> + Send + 'static,
) -> Trial {
    let name = name.into();
    Trial::test(name.clone(), move || {
        let compared = run();
        if compared.is_empty() {
            return Err("nothing was compared".into());
        }
        for found in compared.iter().flatten() {
            report(&format!("{name}: {found}"));
        }
        let wrong: Vec<String> = compared.into_iter().filter_map(Result::err).collect();
        if wrong.is_empty() {
            Ok(())
        } else {
            Err(wrong.join("\n").into())
        }
    })
}

/// Cases that are named after the functions that they run.
#[macro_export]
macro_rules! cases {
    ($($function:path),* $(,)?) => {
        vec![$($crate::cases::case(stringify!($function), $function)),*]
    };
}
