//! The metadata of a spectral file, and its attributes.

use std::collections::BTreeMap;

use exr::meta::attribute::{AttributeValue, Chromaticities, Text};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use spectra::{BandGrid, Quantity};

use super::wavelength::radiance_scale;
use colorimetry::srgb;

const LAYOUT_VERSION: (&str, &str) = ("spectralLayoutVersion", "1.0");
const UNITS_KEY: &str = "emissiveUnits";
const UNITS: &str = Quantity::Radiance.unit();
const LAMBDA_MIN: &str = "pellicle.lambdaMin";
const LAMBDA_MAX: &str = "pellicle.lambdaMax";
const HANDEDNESS: &str = "polarisationHandedness";
const EXPOSURE: &str = "pellicle.exposureEv";
const SETTING: &str = "pellicle.setting.";

/// The largest plausible exposure of a file, in stops up or down.
const MAX_STOPS: f64 = 40.0;

/// The most bytes that an attribute's name may have in an `OpenEXR` file.
const NAME_BYTES: usize = 255;

/// Returns name and version of this software, as written into files.
pub fn software() -> String {
    concat!("Pellicle ", env!("CARGO_PKG_VERSION")).to_owned()
}

/// The data of a file other than its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Metadata {
    /// Name and version of the software that wrote the file; empty if the file does not name it.
    pub software: String,
    /// The exposure of the file's R, G and B, in stops.
    pub exposure_ev: f64,
    /// The unit of radiance, in the layout's spelling. Always `W.m^-2.sr^-1.nm^-1` in files written here. A unit that differs
    /// only by a scale is converted on reading; any other is kept as in the file. `W.m^-2.sr^-1`, the layout's own
    /// example, means per nm. Empty if the file has no unit.
    pub emissive_units: String,
    /// How the image was made: seed, samples, adapter. Names have 1 to 238 bytes.
    pub settings: BTreeMap<String, String>,
    /// The assumptions and changes made on reading the file, each worded to follow the file's name; empty for files written
    /// here. Notes are not written.
    pub notes: Vec<String>,
}

impl Default for Metadata {
    fn default() -> Self {
        Self {
            software: software(),
            exposure_ev: 0.0,
            emissive_units: UNITS.to_owned(),
            settings: BTreeMap::new(),
            notes: Vec::new(),
        }
    }
}

impl Metadata {
    /// Returns the first setting whose name cannot be the name of an attribute.
    pub(super) fn bad_setting(&self) -> Option<&str> {
        let is_bad = |name: &str| {
            name.is_empty() || name.contains('\0') || SETTING.len() + name.len() > NAME_BYTES
        };
        let mut names = self.settings.keys().map(String::as_str);
        names.find(|name| is_bad(name))
    }

    /// Writes everything into the header of a file.
    pub(super) fn into_header(self, grid: &BandGrid, is_polarized: bool, header: &mut Header) {
        let own = &mut header.own_attributes;
        own.layer_name = None;
        own.software_name = Some(text(&self.software));
        let mut put = |name: &str, value| own.other.insert(text(name), value);
        put(LAYOUT_VERSION.0, string(LAYOUT_VERSION.1));
        put(UNITS_KEY, string(UNITS));
        put(LAMBDA_MIN, AttributeValue::F64(grid.min_nm()));
        put(LAMBDA_MAX, AttributeValue::F64(grid.max_nm()));
        put(EXPOSURE, AttributeValue::F64(self.exposure_ev));
        if is_polarized {
            put(HANDEDNESS, string("right"));
        }
        for (name, value) in &self.settings {
            put(&format!("{SETTING}{name}"), string(value));
        }
        header.shared_attributes.chromaticities = Some(chromaticities());
    }

    /// Reads everything from the header of a file; missing entries are empty or 0.
    pub(super) fn of_header(header: &Header) -> Self {
        let own = &header.own_attributes;
        let mut notes = Vec::new();
        let mut settings = BTreeMap::new();
        for (name, value) in &own.other {
            if let (Some(key), AttributeValue::Text(value)) =
                (unicode(name).strip_prefix(SETTING), value)
            {
                settings.insert(key.to_owned(), unicode(value));
            }
        }
        Self {
            software: own.software_name.as_ref().map(unicode).unwrap_or_default(),
            exposure_ev: exposure_ev(header, &mut notes),
            emissive_units: emissive_units(&header.shared_attributes, own).unwrap_or_default(),
            settings,
            notes,
        }
    }

    /// Returns the factor on the file's radiances, and replaces a unit that differs from ours only by a scale with ours.
    pub(super) fn take_units(&mut self) -> f64 {
        let unit = self.emissive_units.as_str();
        match radiance_scale(unit) {
            _ if unit.is_empty() => 1.0,
            Some(1.0) => 1.0,
            Some(scale) => {
                let note = format!("radiances in {unit} are converted to {UNITS}");
                self.notes.push(note);
                UNITS.clone_into(&mut self.emissive_units);
                scale
            }
            None => {
                let note =
                    format!("its unit {unit:?} is not one of spectral radiance: values are kept");
                self.notes.push(note);
                1.0
            }
        }
    }
}

/// Returns the ends of the band grid in nm, if the file has them.
pub(super) fn range_nm(header: &Header) -> Option<(f64, f64)> {
    Some((number(header, LAMBDA_MIN)?, number(header, LAMBDA_MAX)?))
}

/// Returns the factor on S3 that makes it positive for right-handed light, of a file that has S3. Light is right-handed where S3 > 0 if
/// the file does not say which it is.
pub(super) fn sign_of_s3(header: &Header, notes: &mut Vec<String>) -> f32 {
    let said = attribute_text(
        &header.shared_attributes,
        &header.own_attributes,
        HANDEDNESS,
    );
    match said.as_deref().map(str::trim) {
        Some(text) if text.eq_ignore_ascii_case("right") => 1.0,
        Some(text) if text.eq_ignore_ascii_case("left") => {
            notes.push("its S3 is positive for left-handed light: the sign is changed".to_owned());
            -1.0
        }
        _ => {
            notes.push(format!(
                "its {HANDEDNESS} is neither right nor left: S3 > 0 is taken as right-handed"
            ));
            1.0
        }
    }
}

/// Returns the exposure in stops; 0 if the file has none, or none that is plausible.
fn exposure_ev(header: &Header, notes: &mut Vec<String>) -> f64 {
    let stops = number(header, EXPOSURE).unwrap_or(0.0);
    // A NaN fails the comparison.
    if stops.abs() <= MAX_STOPS {
        return stops;
    }
    notes.push(format!(
        "its exposure of {stops} stops is not from -{MAX_STOPS} to {MAX_STOPS}: 0 is used"
    ));
    0.0
}

fn number(header: &Header, name: &str) -> Option<f64> {
    match header.own_attributes.other.get(&text(name)) {
        Some(&AttributeValue::F64(value)) => Some(value),
        _ => None,
    }
}

fn emissive_units(shared: &ImageAttributes, own: &LayerAttributes) -> Option<String> {
    attribute_text(shared, own, UNITS_KEY)
}

/// Returns a string attribute of the part or of the whole file.
pub(super) fn attribute_text(
    shared: &ImageAttributes,
    own: &LayerAttributes,
    name: &str,
) -> Option<String> {
    let key = text(name);
    match own.other.get(&key).or_else(|| shared.other.get(&key)) {
        Some(AttributeValue::Text(value)) => Some(unicode(value)),
        _ => None,
    }
}

/// Converts a string for the file. The bytes are UTF-8, which the format requires.
pub(super) fn text(string: &str) -> Text {
    Text::from_slice_unchecked(string.as_bytes())
}

fn string(value: &str) -> AttributeValue {
    AttributeValue::Text(text(value))
}

/// Converts a string of a file, with invalid UTF-8 replaced.
pub(super) fn unicode(text: &Text) -> String {
    String::from_utf8_lossy(text.as_slice()).into_owned()
}

fn chromaticities() -> Chromaticities {
    let [red, green, blue] = srgb::PRIMARIES.map(point);
    Chromaticities {
        red,
        green,
        blue,
        white: point(srgb::WHITE),
    }
}

fn point([x, y]: [f64; 2]) -> exr::math::Vec2<f32> {
    exr::math::Vec2(x as f32, y as f32)
}
