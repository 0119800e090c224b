//! What a spectral file says about itself, and its attributes.

use std::collections::BTreeMap;

use exr::meta::attribute::{AttributeValue, Chromaticities, Text};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use spectra::BandGrid;

use super::wavelength::radiance_scale;
use colorimetry::srgb;

const LAYOUT_VERSION: (&str, &str) = ("spectralLayoutVersion", "1.0");
const UNITS_KEY: &str = "emissiveUnits";
const UNITS: &str = "W.m^-2.sr^-1.nm^-1";
const LAMBDA_MIN: &str = "pellicle.lambdaMin";
const LAMBDA_MAX: &str = "pellicle.lambdaMax";
const EXPOSURE: &str = "pellicle.exposureEv";
const SETTING: &str = "pellicle.setting.";

/// The most stops, up or down, that a file's exposure is believed to be.
const MOST_STOPS: f64 = 40.0;

/// The most bytes that an attribute's name may have in an `OpenEXR` file.
const NAME_BYTES: usize = 255;

/// Name and version of this software, as files name it.
pub fn software() -> String {
    concat!("Pellicle ", env!("CARGO_PKG_VERSION")).to_owned()
}

/// What a file says beside its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Metadata {
    /// Name and version of the software that wrote the file; empty when the file does not say.
    pub software: String,
    /// The exposure, in stops, that the file's R, G and B were developed with.
    pub exposure_ev: f64,
    /// The unit of radiance, by the layout's spelling. Always `W.m^-2.sr^-1.nm^-1` in files written here; a unit that is
    /// a scale away is converted on reading, any other is told as the file has it. `W.m^-2.sr^-1`, the layout's own
    /// example, means per nm. Empty when the file does not say.
    pub emissive_units: String,
    /// How the image came about: seed, samples, adapter. Names of 1 to 238 bytes.
    pub settings: BTreeMap<String, String>,
    /// What reading the file had to assume or change, each as what is said after the file's name; nothing for files written
    /// here. It is not written.
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
    /// The first setting whose name cannot be an attribute's.
    pub(super) fn bad_setting(&self) -> Option<&str> {
        let is_bad = |name: &str| {
            name.is_empty() || name.contains('\0') || SETTING.len() + name.len() > NAME_BYTES
        };
        let mut names = self.settings.keys().map(String::as_str);
        names.find(|name| is_bad(name))
    }

    /// Puts everything into the header of a file.
    pub(super) fn into_header(self, grid: &BandGrid, header: &mut Header) {
        let own = &mut header.own_attributes;
        own.layer_name = None;
        own.software_name = Some(text(&self.software));
        let mut put = |name: &str, value| own.other.insert(text(name), value);
        put(LAYOUT_VERSION.0, string(LAYOUT_VERSION.1));
        put(UNITS_KEY, string(UNITS));
        put(LAMBDA_MIN, AttributeValue::F64(grid.min_nm()));
        put(LAMBDA_MAX, AttributeValue::F64(grid.max_nm()));
        put(EXPOSURE, AttributeValue::F64(self.exposure_ev));
        for (name, value) in &self.settings {
            put(&format!("{SETTING}{name}"), string(value));
        }
        header.shared_attributes.chromaticities = Some(chromaticities());
    }

    /// Reads everything from the header of a file; what is missing is empty or 0.
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

    /// What the file's radiances are multiplied by; the unit is then ours, where it is a scale away from it.
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
                let note = format!("its unit {unit:?} is no spectral radiance: values are kept");
                self.notes.push(note);
                1.0
            }
        }
    }
}

/// The ends of the band grid in nm, where the file tells them.
pub(super) fn range_nm(header: &Header) -> Option<(f64, f64)> {
    Some((number(header, LAMBDA_MIN)?, number(header, LAMBDA_MAX)?))
}

/// The exposure, in stops; 0 where the file does not say, or nothing that an exposure can be.
fn exposure_ev(header: &Header, notes: &mut Vec<String>) -> f64 {
    let told = number(header, EXPOSURE).unwrap_or(0.0);
    // A NaN fails the comparison.
    if told.abs() <= MOST_STOPS {
        return told;
    }
    notes.push(format!(
        "its exposure of {told} stops is none from -{MOST_STOPS} to {MOST_STOPS}: 0 is taken"
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

/// An attribute that is a string, of the part or of the whole file.
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

/// Strings stand in the file as UTF-8, which the format asks for.
pub(super) fn text(string: &str) -> Text {
    Text::from_slice_unchecked(string.as_bytes())
}

fn string(value: &str) -> AttributeValue {
    AttributeValue::Text(text(value))
}

/// What a string of a file says, whatever its bytes are.
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
