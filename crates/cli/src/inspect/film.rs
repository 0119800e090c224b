//! The film that a position shows.

use super::{FilmArguments, Inspection};
use crate::film::numbers::Vary;
use crate::{lamp, print};
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::coating::{Angle, FilmFits, FilmFitting, Measured, Stack, View, nearest_fit};
use pellicle::color::Probe;
use pellicle::pick::{self, Picked, SceneLamp, SceneLamps};
use pellicle::picture_file::spectral_exr::RowReader;
use pellicle::relight::xyz::exposure_scale;
use pellicle::scene::Scene;
use pellicle::scene_file::SceneFile;
use std::path::{Path, PathBuf};

/// What is known about films.
pub(super) enum Films {
    /// No film was given.
    None,
    /// The films of a scene.
    Scene(Box<KnownScene>),
    /// One stack at one angle.
    Stack(Box<Stack>, Angle, Vec<SceneLamp>),
}

pub(super) struct KnownScene {
    file: SceneFile,
    scene: Scene,
    directory: PathBuf,
    lamps: SceneLamps,
}

/// What was found at a position.
pub(super) enum FilmFinding {
    /// The scene has no film there. This is what it has instead.
    Other(String),
    /// A film.
    Film(Box<Fitted>),
}

/// A film and the thicknesses that are closest to what is seen.
pub(super) struct Fitted {
    /// The name of its material in the scene.
    pub(super) material: Option<String>,
    pub(super) stack: Stack,
    pub(super) layer: usize,
    pub(super) range_nm: (f64, f64),
    pub(super) angle: Angle,
    /// The name of the lamp.
    pub(super) lamp: String,
    /// The fits; `None` if the position is black.
    pub(super) fits: Option<FilmFits>,
    /// The spectrum of the best film by shape, as bright as what is seen.
    pub(super) model: Option<Vec<f64>>,
}

/// The default for the largest thickness to fit, nm.
const USUAL_TO_NM: f64 = 2000.0;

impl Films {
    pub(super) fn new(inspection: &Inspection) -> miette::Result<Self> {
        let asked = &inspection.arguments.film;
        if let Some(path) = &asked.scene {
            return Ok(Self::Scene(Box::new(KnownScene::read(path, inspection)?)));
        }
        let Some(text) = &asked.film else {
            return match asked.vary {
                Some(_) => Err(miette!(
                    "--vary has no effect here: it is for the film of --film or --scene"
                )),
                None => Ok(Self::None),
            };
        };
        let angle = Angle::from_degrees(asked.angle.unwrap_or(0.0))
            .map_err(|error| miette!("--angle: {error}"))?;
        let lamps = lamps(asked, &inspection.image)?;
        let open = if asked.allow_outside {
            Stack::open_trusted
        } else {
            Stack::open
        };
        let stack = open(text)?;
        print::notes(stack.notes());
        Ok(Self::Stack(Box::new(stack), angle, lamps))
    }

    /// The film at a position; `None` if no film was given.
    pub(super) fn find(
        &self,
        inspection: &Inspection,
        probe: &Probe,
    ) -> miette::Result<Option<FilmFinding>> {
        match self {
            Self::None => Ok(None),
            Self::Stack(stack, angle, lamps) => {
                let fitted = fitted(inspection, probe, stack, *angle, lamps)?;
                Ok(Some(FilmFinding::Film(Box::new(fitted))))
            }
            Self::Scene(known) => known.find(inspection, probe).map(Some),
        }
    }
}

impl KnownScene {
    fn read(path: &Path, inspection: &Inspection) -> miette::Result<Self> {
        let allow_outside = inspection.arguments.film.allow_outside;
        let mut file = SceneFile::read(path)?.allow_outside(allow_outside);
        let image = &inspection.image;
        let render = &mut file.description.render;
        render.size = image.size();
        render.bands = image.bands().count();
        if let Some(time) = inspection.image.metadata().settings.get("time_s") {
            render.time_s = time.parse().unwrap_or(render.time_s);
        }
        let scene = file.validate()?;
        let (found, own) = (image.bands(), &scene.settings().bands);
        if found != own {
            return Err(miette!(
                help = "give the scene that the image was rendered from",
                "--scene {}: its bands go from {} to {} nm, those of the image from {} to {} nm",
                path.display(),
                own.min_nm(),
                own.max_nm(),
                found.min_nm(),
                found.max_nm()
            ));
        }
        let lamps = SceneLamps::new(&file.description, &scene);
        if lamps.is_empty() {
            return Err(miette!("--scene {}: it has no emitters", path.display()));
        }
        Ok(Self {
            directory: path.parent().unwrap_or(Path::new("")).to_owned(),
            file,
            scene,
            lamps,
        })
    }

    fn find(&self, inspection: &Inspection, probe: &Probe) -> miette::Result<FilmFinding> {
        let place = probe.region.center();
        let picked = pick::pick(&self.file.description, &self.scene, &self.directory, place);
        let picked = picked.map_err(|problems| {
            let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
            miette!("the film there cannot be computed: {}", said.join("; "))
        })?;
        let film = match picked {
            Picked::Environment => return Ok(FilmFinding::Other("the environment".to_owned())),
            Picked::Bare(material) => {
                return Ok(FilmFinding::Other(format!(
                    "{material:?}, which has no film"
                )));
            }
            Picked::Film(film) => film,
        };
        let lamps = self.lamps.of(&film);
        let fitted = fitted(inspection, probe, &film.stack, film.angle, &lamps)?;
        Ok(FilmFinding::Film(Box::new(Fitted {
            material: Some(film.material),
            ..fitted
        })))
    }
}

/// The lamp of --lamp, or the lamps that the file records, or else D65.
fn lamps(asked: &FilmArguments, image: &RowReader) -> miette::Result<Vec<SceneLamp>> {
    let nm = FilmFitting::wavelengths_nm(image.bands());
    if asked.lamp.is_none() {
        let known = pick::lamps_of_groups(image.light_groups(), &nm);
        if !known.is_empty() {
            return Ok(known);
        }
    }
    let text = asked.lamp.as_deref().unwrap_or("D65");
    let (name, spectrum) = lamp::spectrum(text).map_err(|error| miette!("--lamp: {error}"))?;
    let power = nm
        .iter()
        .map(|&nm| spectrum.at(nm))
        .collect::<Result<_, _>>();
    let power = power.into_diagnostic();
    let power =
        power.wrap_err_with(|| format!("--lamp {text} does not cover the image's bands"))?;
    Ok(vec![SceneLamp { name, power }])
}

/// The closest thicknesses, under the lamp for which they are closest.
fn fitted(
    inspection: &Inspection,
    probe: &Probe,
    stack: &Stack,
    angle: Angle,
    lamps: &[SceneLamp],
) -> miette::Result<Fitted> {
    let vary = vary(inspection.arguments.film.vary, stack)?;
    let bands = inspection.image.bands();
    let scale = exposure_scale(inspection.exposure_ev);
    let measured = Measured {
        bands,
        radiance: &probe.radiance,
        deviation: probe.deviation.as_deref(),
        xyz: probe.xyz.map(|v| v * scale),
    };
    let fitting = |lamp| FilmFitting {
        stack,
        layer: vary.layer - 1,
        from_nm: vary.from_nm,
        to_nm: vary.to_nm,
        angle,
        view: View::default(),
        lamp,
    };
    let candidates: Vec<FilmFitting> = lamps.iter().map(|lamp| fitting(&lamp.power)).collect();
    let nearest = nearest_fit(&candidates, &measured)?;
    let index = nearest.as_ref().map_or(0, |(index, _)| *index);
    let fits = nearest.map(|(_, fits)| fits);
    let model = fits.as_ref().map(|fits| {
        let nearest = fits.by_shape[0];
        let spectrum = candidates[index].spectrum(bands, nearest.thickness_nm)?;
        Ok::<_, pellicle::coating::SampleError>(
            spectrum.iter().map(|v| v * nearest.scale).collect(),
        )
    });
    Ok(Fitted {
        material: None,
        stack: stack.clone(),
        layer: vary.layer - 1,
        range_nm: (vary.from_nm, vary.to_nm),
        angle,
        lamp: lamps[index].name.clone(),
        model: model.transpose()?,
        fits,
    })
}

/// The layer whose thickness is fitted.
fn vary(asked: Option<Vary>, stack: &Stack) -> miette::Result<Vary> {
    let layers = stack.layers().len();
    if layers == 0 {
        return Err(miette!("{}: the stack has no layer", stack.label()));
    }
    let vary = asked.unwrap_or(Vary {
        layer: 1,
        from_nm: 0.0,
        to_nm: (1.5 * stack.thicknesses_nm()[0]).max(USUAL_TO_NM),
    });
    if (1..=layers).contains(&vary.layer) {
        Ok(vary)
    } else {
        Err(miette!(
            "--vary: there is no layer {}; {} has layers 1 to {layers}",
            vary.layer,
            stack.label()
        ))
    }
}
