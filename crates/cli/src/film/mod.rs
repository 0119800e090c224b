//! `pellicle film`.

mod look;
mod model;
pub(crate) mod numbers;
mod phase;
mod pictures;
mod report;
mod spectra;
mod uses;

use crate::print;
use clap::ValueEnum;
use look::Look;
use miette::{IntoDiagnostic, WrapErr, miette};
use model::{ModelName, PathName};
use numbers::{List, Vary};
use pellicle::coating::{Angle, Light, MatchBy, Model, Stack, StackColor, parse_srgb};
use pellicle::document::wording::number;
use pellicle::gpu::AdapterChoice;
use pellicle::spectra::Observer;
use pellicle::{Backend, Renderer, coating, stacks};
use phase::PhaseOptions;
use std::path::PathBuf;

/// Compute spectra, colors, plots and tolerances of a stack of thin films.
///
/// STACK is a stack file (TOML), - to read one from standard input, or a stack in one line such as "air | silica 300nm | silicon": the
/// incident medium, the layers with thicknesses in nm or um, and the substrate. A medium is the name of a material, a number such as 1.5
/// or 1.5+0.1i (n + ik; k > 0 absorbs), or a .csv or .yml file. "air" has the measured n = 1.0003; "vacuum" and 1 are exactly 1.
///
/// Groups can be repeated, as in (TiO2 60nm | SiO2 90nm)^8. Letters can be defined before the stack, with optical thicknesses in waves at
/// a wavelength in nm: "H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 2H | BK7".
///
/// A stack file has `incident` ("air" if it is left out), `substrate`, and for each layer a `[[layer]]` with `index` and `thickness_nm`.
/// An index is anything that a material of a scene accepts, including an inline table { nm = [...], n = [...], k = [...] }.
#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is an option of its own"
)]
pub(crate) struct Arguments {
    /// A stack file, or a stack in one line (with | between its media)
    stack: String,
    /// Allow a stack file to refer to files outside its folder; use this only for files that you trust
    #[arg(long)]
    allow_outside: bool,
    /// Angles of incidence in degrees, from 0 to less than 90: a list, or FROM:TO:STEP
    #[arg(long, default_value = "0", value_parser = List::parse, allow_hyphen_values = true)]
    angles: List,
    /// Vacuum wavelengths in nm: FROM:TO:STEP, or a list [default: 380:780:10; for a plot 380:780:1]
    #[arg(long, value_parser = List::parse, allow_hyphen_values = true)]
    wavelengths: Option<List>,
    /// Output format of R and T; rows are sorted by angle, then by wavelength [default: table, unless another output is requested]
    #[arg(long, value_enum, conflicts_with_all = ["wanted", "tolerance", "sensitivity"])]
    format: Option<Format>,
    /// Extend the first and last values of a medium beyond its data
    #[arg(long)]
    clamp: bool,
    /// Formula for R and T: exact, for any stack; or two_beam, which scenes offer too, for one film that does not absorb, between equal
    /// media. With two_beam, R + T is not 1, and there is no A
    #[arg(long, value_enum, default_value_t = ModelName::Exact)]
    model: ModelName,
    /// Path difference between the two beams of --model two_beam [default: optical]
    #[arg(long, value_enum)]
    path_difference: Option<PathName>,
    /// Also print the absorptance of each layer (always computed on the CPU)
    #[arg(long)]
    absorptance: bool,
    #[command(flatten)]
    phases: PhaseOptions,
    /// Device that computes R and T: the CPU in f64, or a GPU in f32. On a GPU, ordinary stacks seen from air are accurate to 5e-5 up to
    /// 88°; errors are larger for incidence from a denser medium near a critical angle, films beyond 10 µm, and hundreds of layers
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    #[command(flatten)]
    look: Look,
    /// Write a plot of R, T and A over wavelength with the color of each angle (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Write a chart of the color over angle and the thickness of one layer (.png). --vary chooses the layer and its range [default:
    /// layer 1 from 0 to 1000 nm, or to twice its thickness]; the smallest and the largest of several --angles limit the angle
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    /// Number of a layer, counted from 1, and its range of thickness in nm, for --chart and --match
    #[arg(long, value_name = "LAYER:FROM:TO", value_parser = Vary::parse, allow_hyphen_values = true)]
    vary: Option<Vary>,
    /// Find the thickness in the range of --vary whose color is closest to this sRGB color, such as "#2e6fd0"
    #[arg(id = "wanted", long = "match", value_name = "COLOR", value_parser = wanted, requires = "vary")]
    wanted: Option<Wanted>,
    /// What must match: the whole color, including lightness, at --exposure; or the chromaticity alone, after scaling each film to the
    /// brightness of the wanted color
    #[arg(long, value_enum, default_value_t = MatchByName::Color, requires = "wanted")]
    match_by: MatchByName,
    /// Print the spread of the color if the thickness of each layer has a random error with this standard deviation, such as 2%
    #[arg(long, value_name = "PERCENT", value_parser = numbers::percent, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Number of random stacks for --tolerance
    #[arg(long, default_value_t = 10_000, requires = "tolerance")]
    trials: u32,
    /// Seed of the random stacks for --tolerance
    #[arg(long, default_value_t = 0, requires = "tolerance")]
    seed: u64,
    /// Print the color difference per nm of each layer, and dR/dd at --design
    #[arg(long)]
    sensitivity: bool,
    /// Wavelength in nm at which --sensitivity prints dR/dd
    #[arg(long, value_name = "NM", default_value = "550", value_parser = numbers::number, requires = "sensitivity")]
    design: f64,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// A text table, with the color at each angle
    Table,
    /// wavelength_nm,angle_deg,Rs,Rp,Ts,Tp with 17 digits; then the columns of --absorptance and --phase
    Csv,
    /// All results, with the stack and its refractive indices
    Json,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum BackendName {
    Cpu,
    Gpu,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum MatchByName {
    Color,
    Chromaticity,
}

/// A wanted color as XYZ.
#[derive(Clone, Debug)]
struct Wanted {
    xyz: [f64; 3],
}

fn wanted(text: &str) -> Result<Wanted, String> {
    let xyz = parse_srgb(text).map_err(|error| error.to_string())?;
    Ok(Wanted { xyz })
}

/// The largest product of wavelengths and angles.
const MAX_ROWS: usize = 4_000_000;

/// The input that every part of the command needs.
struct Film<'a> {
    arguments: &'a Arguments,
    stack: Stack,
    angles: Vec<Angle>,
    light: Light,
    exposure_ev: f64,
}

/// Computes, prints and writes what was requested.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    arguments.check_uses()?;
    let film = Film::new(arguments)?;
    print::notes(film.stack.notes());
    // Report what cannot be written before computing anything.
    film.check_model()?;
    pictures::check(&film)?;
    if arguments.prints_spectra() {
        spectra::print(&film, arguments.format.unwrap_or(Format::Table))?;
    }
    report::print(&film)?;
    pictures::write(&film)?;
    film.note_adaptation();
    film.note_light()
}

impl<'a> Film<'a> {
    fn new(arguments: &'a Arguments) -> miette::Result<Self> {
        let look = &arguments.look;
        let exposure = pellicle::scene_file::limits::EXPOSURE_EV;
        if !exposure.contains(look.exposure) {
            return Err(miette!(
                "--exposure {}: it must be from {exposure}",
                number(look.exposure)
            ));
        }
        let angle =
            |&deg: &f64| Angle::from_degrees(deg).map_err(|error| miette!("--angles: {error}"));
        let model = model::model(arguments.model, arguments.path_difference)?;
        let open = if arguments.allow_outside {
            Stack::open_trusted
        } else {
            Stack::open
        };
        let mut stack = open(&arguments.stack)?.with_model(model);
        if arguments.clamp {
            stack = stack.clamped(arguments.used_nm());
        }
        let angles = arguments
            .angles
            .0
            .iter()
            .map(angle)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            arguments,
            stack,
            angles,
            light: look.light()?,
            exposure_ev: look.exposure,
        })
    }

    /// The requested wavelengths, or 380 to 780 nm in steps of `step_nm`.
    fn wavelengths_nm(&self, step_nm: usize) -> miette::Result<Vec<f64>> {
        let nm = match &self.arguments.wavelengths {
            Some(List(nm)) => nm.clone(),
            None => (380..=780).step_by(step_nm).map(f64::from).collect(),
        };
        self.check_rows(nm.len())?;
        let possible = pellicle::media::limits::TABLE_NM;
        match nm.iter().find(|&&nm| !possible.contains(nm)) {
            Some(nm) => Err(miette!(
                "--wavelengths: {} nm; it must be from {possible}",
                number(*nm)
            )),
            None => Ok(nm),
        }
    }

    /// Checks that the model is defined for the stack, before anything is computed.
    fn check_model(&self) -> miette::Result<()> {
        if self.stack.model() != Model::Exact {
            self.stack.sampled(&self.wavelengths_nm(10)?)?;
        }
        Ok(())
    }

    /// The stack in one line, with the model if it is not the exact one.
    fn title(&self) -> String {
        self.stack.label() + &model::remark(self.stack.model())
    }

    /// Checks the number of rows. With --absorptance, a row has a value for each layer.
    fn check_rows(&self, wavelengths: usize) -> miette::Result<()> {
        let angles = self.angles.len();
        let rows = wavelengths * angles;
        let layers = self.stack.layers().len();
        if rows > MAX_ROWS {
            return Err(miette!(
                "{wavelengths} wavelengths at {angles} angles are {rows} rows; at most {MAX_ROWS} are possible"
            ));
        }
        if self.arguments.absorptance && rows.saturating_mul(layers) > MAX_ROWS {
            return Err(miette!(
                help = "use fewer wavelengths or angles",
                "--absorptance: {rows} rows of {layers} layers; rows times layers may be at most {MAX_ROWS}"
            ));
        }
        Ok(())
    }

    /// The renderer that computes R and T.
    fn renderer(&self) -> miette::Result<Renderer> {
        let backend = match self.arguments.backend {
            BackendName::Cpu => Backend::Cpu,
            BackendName::Gpu => Backend::Gpu(AdapterChoice::Best),
        };
        Renderer::open(&backend).into_diagnostic()
    }

    /// An absorptance below this value is a rounding error of R + T. Two beams have no absorptance.
    fn rounding(&self) -> f64 {
        if self.stack.model() != Model::Exact {
            return f64::INFINITY;
        }
        match self.arguments.backend {
            BackendName::Cpu => 1e-9,
            BackendName::Gpu => 2e-4,
        }
    }

    /// Prints what was assumed about an illuminant whose table is too coarse for the fringes of the film.
    fn note_light(&self) -> miette::Result<()> {
        /// The smallest color difference that can be seen.
        const SEEN: f64 = 0.5;
        if self.light.step_nm() == 1.0 || self.arguments.shows_no_color() {
            return Ok(());
        }
        let color = self.color()?;
        let doubt = |&angle: &Angle| color.doubt(self.stack.thicknesses_nm(), angle);
        let most = self.angles.iter().map(doubt).fold(0.0, f64::max);
        if most > SEEN {
            let (name, step) = (self.light.name(), self.light.step_nm());
            print::note(format_args!(
                "note: the table of {name} has steps of {step} nm, which are too coarse for the fringes of this film: its power is taken as \
                 linear in between (lines at those wavelengths alone would give a color that differs by ΔE00 {most:.1})"
            ));
        }
        Ok(())
    }

    /// Prints that colors are not adapted to the illuminant. D65 needs no note, as it is the white of the display.
    fn note_adaptation(&self) {
        let only_csv = self.arguments.shows_no_color();
        let observer = self.arguments.look.observer;
        if observer != Observer::Cie1931Deg2 && !only_csv {
            print::note(format_args!(
                "swatches and sRGB codes treat XYZ of {observer} as XYZ of CIE 1931, for which sRGB is defined"
            ));
        }
        if self.light.name() != "D65" && !only_csv {
            print::note(format_args!(
                "swatches and sRGB codes are not adapted to {}: a white surface under it does not look white",
                self.light.name()
            ));
        }
    }

    /// R and T for each angle at each wavelength.
    fn powers(
        &self,
        renderer: &Renderer,
        sampled: &coating::Sampled,
    ) -> miette::Result<Vec<Vec<coating::Powers>>> {
        if sampled.model() != Model::Exact {
            let thicknesses = self.stack.thicknesses_nm();
            let angles = self.angles.iter();
            return Ok(angles.map(|&a| sampled.powers(thicknesses, a)).collect());
        }
        let thicknesses = [self.stack.thicknesses_nm().to_vec()];
        let batch = sampled.batch(&thicknesses, &self.angles);
        let powers = stacks::evaluate(renderer, &batch.as_batch()).into_diagnostic()?;
        let per_angle = powers.chunks(sampled.wavelengths_nm().len());
        Ok(per_angle.map(<[_]>::to_vec).collect())
    }

    fn color(&self) -> miette::Result<StackColor> {
        StackColor::new(&self.stack, self.light.clone(), self.arguments.look.view())
            .map_err(miette::Report::from)
            .wrap_err("a color needs data from 380 to 780 nm")
    }

    /// The layer of --vary, counted from 0.
    fn layer_of(&self, vary: &Vary) -> miette::Result<usize> {
        let layers = self.stack.layers().len();
        if (1..=layers).contains(&vary.layer) {
            return Ok(vary.layer - 1);
        }
        let has = match layers {
            0 => "the stack has no layers".to_owned(),
            1 => "the stack has one layer, number 1".to_owned(),
            _ => format!("the stack has layers 1 to {layers}"),
        };
        Err(miette!(
            help = has,
            "--vary: there is no layer {}",
            vary.layer
        ))
    }

    fn match_by(&self) -> MatchBy {
        match self.arguments.match_by {
            MatchByName::Color => MatchBy::Color,
            MatchByName::Chromaticity => MatchBy::Chromaticity,
        }
    }
}
