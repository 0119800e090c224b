//! The `pellicle` command: arguments, progress and errors. The library does the work.

mod bench;
mod booth;
mod check;
mod color;
mod compare;
mod develop;
mod devices;
mod display;
mod film;
mod image_file;
mod inspect;
mod interrupt;
mod lamp;
mod materials;
mod memory;
mod merge;
mod output;
mod print;
mod progress;
mod relight;
mod render;
mod swatch;

use clap::{Parser, Subcommand};
use render::Outcome;
use std::path::PathBuf;
use std::process::ExitCode;

/// Renders the color of thin films and metals, wavelength by wavelength.
#[derive(Parser)]
#[command(name = "pellicle", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to a picture (PNG) and a spectral image (EXR)
    Render(Box<render::Arguments>),
    /// Develop a spectral image into a picture for a display
    Develop(Box<develop::Arguments>),
    /// Validate a scene without rendering it
    Check {
        /// The scene file, or - for standard input
        scene: PathBuf,
        /// Allow the scene to refer to files outside its folder; use this only for scenes that you trust
        #[arg(long)]
        allow_outside: bool,
    },
    Film(film::Arguments),
    Color(color::Arguments),
    Display(display::Arguments),
    Compare(compare::Arguments),
    Merge(merge::Arguments),
    Inspect(inspect::Arguments),
    /// List the adapters that can render
    Devices,
    /// List the materials with built-in optical constants, or show one
    Materials(materials::Arguments),
    /// Print the JSON schema of scene files
    Schema,
    /// Measure samples per second on every adapter and on the CPU
    Bench(bench::Arguments),
}

fn main() -> ExitCode {
    print::keep_lines_whole();
    interrupt::listen();
    let arguments =
        Arguments::try_parse().unwrap_or_else(|error| print::exit_with::<Arguments>(&error));
    let result = match arguments.command {
        Command::Render(arguments) => match render::run(&arguments) {
            Ok(Outcome::Interrupted(signal)) => {
                return ExitCode::from(interrupt::exit_code(signal));
            }
            other => other.map(|_| ()),
        },
        Command::Develop(arguments) => develop::run(&arguments),
        Command::Check {
            scene,
            allow_outside,
        } => check::run(&scene, allow_outside),
        Command::Film(arguments) => film::run(&arguments),
        Command::Color(arguments) => color::run(&arguments),
        Command::Display(arguments) => display::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Devices => devices::print(),
        Command::Materials(arguments) => materials::run(&arguments),
        Command::Schema => print::result(format_args!("{:#}", pellicle::scene_file::schema())),
        Command::Bench(arguments) => bench::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(report) => {
            print::error(&report);
            ExitCode::FAILURE
        }
    }
}
