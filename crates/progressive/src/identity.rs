//! What a render is of, so that its files are not mixed with those of another.

use scene::Scene;
use std::collections::BTreeMap;
use std::fmt::{self, Debug, Display};

/// Digits of a digest: the chance that two different scenes share one is 2⁻⁶⁴.
const DIGITS: usize = 16;
/// What the names of an identity begin with among the settings of a spectral image.
const PREFIX: &str = "identity.";

/// Everything that decides over the bits of a picture, by name: settings as they are, and digests of what is long.
///
/// The number of samples is not in it: a picture can be continued. Neither are the exposure, which only developing uses, and
/// the window and the numbers of the samples, which parts of a picture do not share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity(BTreeMap<String, String>);

/// Something in which two identities differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What it is.
    pub name: String,
    /// What the file has.
    pub found: String,
    /// What was wanted.
    pub wanted: String,
}

/// `seed (3 instead of 4)`; digests are not shown.
impl Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |value: &str| match value {
            "" => "none".to_owned(),
            value => value.to_owned(),
        };
        match self.name.as_str() {
            "lights" | "camera" | "materials" | "objects" | "environment" | "spectra" => {
                write!(f, "{}", self.name)
            }
            name => write!(
                f,
                "{} ({} instead of {})",
                name.replace('_', " "),
                shown(&self.found),
                shown(&self.wanted)
            ),
        }
    }
}

/// Lists differences in a line.
pub(crate) fn listed(differences: &[Difference]) -> String {
    let shown: Vec<String> = differences.iter().map(ToString::to_string).collect();
    shown.join(", ")
}

impl Identity {
    /// The identity of a scene that a backend renders.
    pub fn new(scene: &Scene, backend: &str) -> Self {
        let settings = scene.settings();
        let lights = (scene.lights(), scene.light_groups());
        let spectra = (scene.spectra(), scene.observer());
        let materials = (scene.materials(), scene.estimates());
        let size = format!("{}x{}", settings.width, settings.height);
        let clamp = settings.clamp.map_or_else(String::new, |c| c.to_string());
        let entries = [
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("backend", backend.to_owned()),
            ("camera", digest(scene.camera())),
            ("objects", digest(&scene.objects())),
            ("materials", digest(&materials)),
            ("lights", digest(&lights)),
            ("environment", digest(scene.environment())),
            ("spectra", digest(&spectra)),
            ("size", size),
            ("bands", bands(scene)),
            ("seed", settings.seed.to_string()),
            ("time_s", settings.time_s.to_string()),
            ("sampler", format!("{:?}", settings.sampler)),
            ("wavelengths", format!("{:?}", settings.sampling)),
            ("max_path_segments", settings.max_path_segments.to_string()),
            ("direct_light", format!("{:?}", settings.direct_light)),
            ("film_splits", settings.film_splits.to_string()),
            ("roulette_after", settings.roulette_after.to_string()),
            ("clamp", clamp),
        ];
        let polarization = polarization(scene).map(|value| ("polarization", value));
        let entries = entries.into_iter().chain(polarization);
        Self(
            entries
                .map(|(name, value)| (name.to_owned(), value))
                .collect(),
        )
    }

    /// The identity of an adaptive render with this mean number of samples, which decides over those of each tile.
    #[must_use]
    pub fn adaptive(mut self, samples: u32) -> Self {
        self.insert("adaptive_samples", samples.to_string());
        self
    }

    /// Whether it is that of an adaptive render.
    pub(crate) fn is_adaptive(&self) -> bool {
        self.0.contains_key("adaptive_samples")
    }

    /// A digest of all entries.
    pub fn digest(&self) -> String {
        digest(&self.0)
    }

    /// The identity of a render that the CPU has continued after the GPU failed. It goes with no other file.
    #[must_use]
    pub fn mixed(mut self) -> Self {
        if let Some(backend) = self.0.get_mut("backend") {
            backend.push_str(", then the CPU");
        }
        self
    }

    /// Adds an entry.
    pub(crate) fn insert(&mut self, name: &str, value: String) {
        self.0.insert(name.to_owned(), value);
    }

    /// The entries by name.
    pub fn entries(&self) -> &BTreeMap<String, String> {
        &self.0
    }

    pub(crate) fn from_entries(entries: BTreeMap<String, String>) -> Self {
        Self(entries)
    }

    /// The entries as settings of a spectral image.
    pub fn settings(&self) -> impl Iterator<Item = (String, String)> {
        let entries = self.0.iter();
        entries.map(|(name, value)| (format!("{PREFIX}{name}"), value.clone()))
    }

    /// Whether a setting of a spectral image belongs to its identity.
    pub fn has(setting: &str) -> bool {
        setting.starts_with(PREFIX)
    }

    /// The identity among the settings of a spectral image; `None` if there is none.
    pub fn of_settings(settings: &BTreeMap<String, String>) -> Option<Self> {
        let entries = settings.iter().filter_map(|(name, value)| {
            let name = name.strip_prefix(PREFIX)?;
            Some((name.to_owned(), value.clone()))
        });
        let entries: BTreeMap<_, _> = entries.collect();
        (!entries.is_empty()).then_some(Self(entries))
    }

    /// In what this one, of a file, differs from a wanted one.
    pub fn differences(&self, wanted: &Self) -> Vec<Difference> {
        let mut names: Vec<&String> = self.0.keys().chain(wanted.0.keys()).collect();
        names.sort();
        names.dedup();
        let value = |of: &Self, name: &str| of.0.get(name).cloned().unwrap_or_default();
        names
            .into_iter()
            .map(|name| Difference {
                name: name.clone(),
                found: value(self, name),
                wanted: value(wanted, name),
            })
            .filter(|difference| difference.found != difference.wanted)
            .collect()
    }
}

fn bands(scene: &Scene) -> String {
    let bands = &scene.settings().bands;
    format!(
        "{} from {} to {} nm",
        bands.count(),
        bands.min_nm(),
        bands.max_nm()
    )
}

/// What is kept of light that is traced with its polarization; `None` if it is traced without. The polarizer itself is in the camera.
fn polarization(scene: &Scene) -> Option<String> {
    let kept = if scene.content().is_polarized {
        "all components"
    } else {
        "behind a polarizer"
    };
    scene.settings().polarization.then(|| kept.to_owned())
}

/// A digest of all values of something. Numbers are described with all their digits, so equal descriptions mean equal values.
fn digest(value: &dyn Debug) -> String {
    struct Hasher(blake3::Hasher);
    impl fmt::Write for Hasher {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut hasher = Hasher(blake3::Hasher::new());
    // Neither the hasher nor a derived description fails.
    let _ = fmt::write(&mut hasher, format_args!("{value:?}"));
    let digits = hasher.0.finalize().to_hex();
    digits[..DIGITS].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(entries: &[(&str, &str)]) -> Identity {
        let entries = entries
            .iter()
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()));
        Identity(entries.collect())
    }

    #[test]
    fn differences_are_named() {
        let a = identity(&[("seed", "3"), ("camera", "ab"), ("time_s", "0")]);
        let b = identity(&[
            ("seed", "4"),
            ("camera", "cd"),
            ("time_s", "0"),
            ("clamp", "2"),
        ]);
        let shown = listed(&a.differences(&b));
        assert_eq!(
            shown,
            "camera, clamp (none instead of 2), seed (3 instead of 4)"
        );
        assert!(a.differences(&a).is_empty());
    }

    #[test]
    fn it_goes_through_the_settings_of_an_image() {
        let identity = identity(&[("seed", "3"), ("clamp", "")]);
        let mut settings: BTreeMap<_, _> = identity.settings().collect();
        settings.insert("fov_deg".to_owned(), "30".to_owned());
        assert_eq!(Identity::of_settings(&settings), Some(identity));
        assert_eq!(Identity::of_settings(&BTreeMap::new()), None);
    }

    #[test]
    fn digests_tell_the_last_digit_of_a_number() {
        let value = 0.1_f64;
        let next = f64::from_bits(value.to_bits() + 1);
        assert_ne!(digest(&value), digest(&next));
        assert_eq!(digest(&vec![1.5]).len(), DIGITS);
    }
}
