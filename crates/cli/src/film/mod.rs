//! `pellicle film`.

mod look;
mod model;
pub(crate) mod numbers;
mod pictures;
mod report;
mod spectra;
pub(crate) mod swatch;
mod uses;

use crate::print;
use clap::ValueEnum;
use look::Look;
use miette::{IntoDiagnostic, WrapErr, miette};
use model::{ModelName, PathName};
use numbers::{List, Vary};
use pellicle::coating::{Angle, Light, MatchBy, Model, Stack, StackColor, parse_srgb};
use pellicle::gpu::AdapterChoice;
use pellicle::spectra::Observer;
use pellicle::spectra::wording::number;
use pellicle::{Backend, Renderer, coating, stacks};
use std::path::PathBuf;

/// What a stack of thin films does to light: spectra, colors, plots, tolerances.
///
/// STACK is a stack file (TOML), - for one from standard input, or a stack in one line such as "air | silica 300nm | silicon": the medium that light comes from,
/// layers with thicknesses in nm or um, the substrate. A medium is a material's name, a number 1.5, 1.5+0.1i (n + ik, k > 0
/// absorbs), or a file .csv or .yml. "air" has n = 1.0003 as measured; "vacuum" and 1 are 1 exactly.
///
/// Groups repeat, (TiO2 60nm | SiO2 90nm)^8, and letters may be defined before the stack, with thicknesses in waves at a wavelength in
/// nm: "H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 2H | BK7".
///
/// A stack file has `incident` ("air" when absent), `substrate`, and per layer `[[layer]]` with `index` and `thickness_nm`. An index
/// is whatever a scene's materials accept, a table in place { nm = [...], n = [...], k = [...] } included.
#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is an option of its own"
)]
pub(crate) struct Arguments {
    /// A stack file, or a stack in one line (with | between its media)
    stack: String,
    /// Let a stack file name files outside of its folder: only for those that can be trusted
    #[arg(long)]
    allow_outside: bool,
    /// Angles of incidence in degrees, 0 to less than 90: a list, or FROM:TO:STEP
    #[arg(long, default_value = "0", value_parser = List::parse, allow_hyphen_values = true)]
    angles: List,
    /// Wavelengths in vacuum, nm: FROM:TO:STEP, or a list [default: 380:780:10; of a plot 380:780:1]
    #[arg(long, value_parser = List::parse, allow_hyphen_values = true)]
    wavelengths: Option<List>,
    /// How R and T are printed: rows go by angle, then by wavelength [default: table, unless something else is asked for]
    #[arg(long, value_enum, conflicts_with_all = ["wanted", "tolerance", "sensitivity"])]
    format: Option<Format>,
    /// Go on with a medium's first and last values beyond its data
    #[arg(long)]
    clamp: bool,
    /// By which formula R and T are computed: exact, for any stack; two_beam, which scenes have too, for one film that does not absorb
    /// between equal media. By two beams R + T is not 1, and there is no A
    #[arg(long, value_enum, default_value_t = ModelName::Exact)]
    model: ModelName,
    /// What --model two_beam takes for the path difference between the two beams [default: optical]
    #[arg(long, value_enum)]
    path_difference: Option<PathName>,
    /// Print the absorptance of each layer too (always from the CPU)
    #[arg(long)]
    absorptance: bool,
    /// What computes R and T: the CPU in f64, or a GPU in f32. To 5e-5 up to 88° for ordinary stacks seen from air; incidence from a
    /// denser medium near a critical angle, films beyond 10 µm and hundreds of layers lose more
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    #[command(flatten)]
    look: Look,
    /// Write a plot of R, T and A over wavelength with the color of each angle (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Write a chart of the color over thickness and angle of one layer (.png): of --vary [default: layer 1 from 0 to 1000 nm, or to
    /// twice its thickness]; with several --angles, between the smallest and the largest
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    /// A layer's number from 1 and its thicknesses in nm, for --chart and --match
    #[arg(long, value_name = "LAYER:FROM:TO", value_parser = Vary::parse, allow_hyphen_values = true)]
    vary: Option<Vary>,
    /// Find the thickness of --vary whose color is nearest to this one of sRGB, like "#2e6fd0"
    #[arg(id = "wanted", long = "match", value_name = "COLOR", value_parser = wanted, requires = "vary")]
    wanted: Option<Wanted>,
    /// What has to match: the whole color, lightness included, at --exposure; or its chromaticity, each film first made as bright as
    /// the wanted color
    #[arg(long, value_enum, default_value_t = MatchByName::Color, requires = "wanted")]
    match_by: MatchByName,
    /// Scatter of the color when each layer's thickness is off by a random error of this standard deviation, like 2%
    #[arg(long, value_name = "PERCENT", value_parser = numbers::percent, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// How many stacks --tolerance draws
    #[arg(long, default_value_t = 10_000, requires = "tolerance")]
    trials: u32,
    /// Which stacks --tolerance draws
    #[arg(long, default_value_t = 0, requires = "tolerance")]
    seed: u64,
    /// Color difference per nm of each layer, and dR/dd at --design
    #[arg(long)]
    sensitivity: bool,
    /// The wavelength at which --sensitivity tells dR/dd, nm
    #[arg(long, value_name = "NM", default_value = "550", value_parser = numbers::number, requires = "sensitivity")]
    design: f64,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// For people, with the color of each angle
    Table,
    /// wavelength_nm,angle_deg,Rs,Rp,Ts,Tp with 17 digits
    Csv,
    /// Everything, with the stack and its indices
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

/// A wanted color as it was written and as XYZ.
#[derive(Clone, Debug)]
struct Wanted {
    xyz: [f64; 3],
}

fn wanted(text: &str) -> Result<Wanted, String> {
    let xyz = parse_srgb(text).map_err(|error| error.to_string())?;
    Ok(Wanted { xyz })
}

/// The most wavelengths times angles.
const MOST_ROWS: usize = 4_000_000;

/// What every part of the command needs.
struct Film<'a> {
    arguments: &'a Arguments,
    stack: Stack,
    angles: Vec<Angle>,
    light: Light,
    exposure_ev: f64,
}

/// Computes, prints and writes what is asked for.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    arguments.check_uses()?;
    let film = Film::new(arguments)?;
    print::notes(film.stack.notes());
    // What cannot be written is told before anything is computed.
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
        let exposure = pellicle::scene::limits::EXPOSURE_EV;
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

    /// The wavelengths asked for, or 380 to 780 nm in these steps.
    fn wavelengths_nm(&self, step_nm: usize) -> miette::Result<Vec<f64>> {
        let nm = match &self.arguments.wavelengths {
            Some(List(nm)) => nm.clone(),
            None => (380..=780).step_by(step_nm).map(f64::from).collect(),
        };
        self.check_rows(nm.len())?;
        let possible = pellicle::scene::limits::TABLE_NM;
        match nm.iter().find(|&&nm| !possible.contains(nm)) {
            Some(nm) => Err(miette!(
                "--wavelengths: {} nm; it must be from {possible}",
                number(*nm)
            )),
            None => Ok(nm),
        }
    }

    /// What a model is not defined for is told before anything is computed.
    fn check_model(&self) -> miette::Result<()> {
        if self.stack.model() != Model::Exact {
            self.stack.sampled(&self.wavelengths_nm(10)?)?;
        }
        Ok(())
    }

    /// The stack in a line, with what is computed of it.
    fn title(&self) -> String {
        self.stack.label() + &model::remark(self.stack.model())
    }

    /// With the absorptance of layers a row has a figure for each of them.
    fn check_rows(&self, wavelengths: usize) -> miette::Result<()> {
        let angles = self.angles.len();
        let rows = wavelengths * angles;
        let layers = self.stack.layers().len();
        if rows > MOST_ROWS {
            return Err(miette!(
                "{wavelengths} wavelengths at {angles} angles are {rows} rows; at most {MOST_ROWS} are possible"
            ));
        }
        if self.arguments.absorptance && rows.saturating_mul(layers) > MOST_ROWS {
            return Err(miette!(
                help = "take fewer wavelengths or angles",
                "--absorptance: {rows} rows of {layers} layers; rows times layers may be at most {MOST_ROWS}"
            ));
        }
        Ok(())
    }

    /// What computes R and T.
    fn renderer(&self) -> miette::Result<Renderer> {
        let backend = match self.arguments.backend {
            BackendName::Cpu => Backend::Cpu,
            BackendName::Gpu => Backend::Gpu(AdapterChoice::Best),
        };
        Renderer::open(&backend).into_diagnostic()
    }

    /// Below this an absorptance is the rounding of R + T. Two beams have none.
    fn rounding(&self) -> f64 {
        if self.stack.model() != Model::Exact {
            return f64::INFINITY;
        }
        match self.arguments.backend {
            BackendName::Cpu => 1e-9,
            BackendName::Gpu => 2e-4,
        }
    }

    /// Says what was assumed of a light whose table is too coarse for the film's fringes.
    fn note_light(&self) -> miette::Result<()> {
        /// Color differences that can be seen.
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
                "note: {name} is known at steps of {step} nm, which are too coarse for the fringes of this film: its power is taken as \
                 linear in between (its lines alone, at those wavelengths, would make a color that differs by ΔE00 {most:.1})"
            ));
        }
        Ok(())
    }

    /// Says that colors are shown as the light makes them. D65 is the display's own white.
    fn note_adaptation(&self) {
        let only_csv = self.arguments.shows_no_color();
        let observer = self.arguments.look.observer;
        if observer != Observer::Cie1931Deg2 && !only_csv {
            print::note(format_args!(
                "swatches and codes of sRGB take XYZ of {observer} as if they were those of CIE 1931, for which sRGB is defined"
            ));
        }
        if self.light.name() != "D65" && !only_csv {
            print::note(format_args!(
                "swatches and codes of sRGB are not adapted to {}: white under it does not look white",
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
