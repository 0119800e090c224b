//! Pictures as environment and as textures, and the sky: a file that cannot be used is reported once, with its name and what
//! would be right.

use crate::{CAMERA, read, said};
use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use image::{ImageBuffer, Rgb};
use pellicle_scene_file::Problems;
use picture_file::spectral_exr::{Metadata, WriteOptions};
use scene::{Environment, EnvironmentPicture, LightShape, PictureSpectra, Scene};
use spectra::{BandGrid, SpectralImage};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn checked(folder: &Path, rest: &str) -> Result<Scene, Problems> {
    let text = format!("{CAMERA}render = {{ bands = 8 }}\n{rest}\n");
    read(&text, folder)
}

fn surrounded_by(folder: &Path, image: &str) -> Result<Scene, Problems> {
    checked(
        folder,
        &format!("environment = {{ type = 'image', image = '{image}' }}"),
    )
}

/// There is one problem, at this field, that contains all phrases.
fn assert_reported(result: Result<Scene, Problems>, field: &str, phrases: &[&str]) {
    let Err(problems) = result else {
        panic!("it is accepted");
    };
    assert_eq!(problems.iter().count(), 1, "{problems:#}");
    let problem = problems.iter().next().unwrap();
    assert_eq!(problem.field.to_string(), field, "{problems:#}");
    let said = said(problem);
    for phrase in phrases {
        assert!(said.contains(phrase), "{said:?} lacks {phrase:?}");
    }
    let name = phrases[0];
    assert_eq!(said.matches(name).count(), 1, "{said}");
}

/// An OpenEXR file with channels of these names.
fn write_exr(
    path: &Path,
    size: (usize, usize),
    names: &[&str],
    values: &[f32],
    of: Option<Chromaticities>,
) {
    let channel = |name: &&str| AnyChannel::new(*name, FlatSamples::F32(values.to_vec()));
    let channels = AnyChannels::sort(names.iter().map(channel).collect());
    let layer = Layer::new(
        size,
        LayerAttributes::default(),
        Encoding::UNCOMPRESSED,
        channels,
    );
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = of;
    image.write().to_file(path).unwrap();
}

fn write_spectra(path: &Path, [width, height]: [u32; 2], bands: BandGrid, value: f32) {
    let mut image = SpectralImage::new(width, height, bands);
    let spectrum = vec![value; image.bands().count() as usize];
    for y in 0..height {
        for x in 0..width {
            image.set_pixel((x, y), &spectrum, &spectrum, [1.0; 3], 1);
        }
    }
    picture_file::spectral_exr::write(path, &image, &Metadata::default(), WriteOptions::default())
        .unwrap();
}

/// Writes files that are no pictures of light.
fn write_bad_files(folder: &Path) {
    let hdr = include_bytes!("../../../../tests/data/environment.hdr");
    fs::write(folder.join("cut.hdr"), &hdr[..hdr.len() / 2]).unwrap();
    fs::write(folder.join("head.hdr"), &hdr[..20]).unwrap();
    fs::write(folder.join("text.hdr"), "a picture").unwrap();
    fs::create_dir(folder.join("folder.exr")).unwrap();
    write_exr(&folder.join("depth.exr"), (2, 1), &["Z"], &[1.0; 2], None);
    let layers = ["a.R", "a.G", "a.B", "b.R", "b.G", "b.B"];
    write_exr(&folder.join("layers.exr"), (2, 1), &layers, &[1.0; 2], None);
    write_exr(
        &folder.join("whole.exr"),
        (8, 4),
        &["R", "G", "B"],
        &[1.0; 32],
        None,
    );
    let whole = fs::read(folder.join("whole.exr")).unwrap();
    fs::write(folder.join("cut.exr"), &whole[..whole.len() - 40]).unwrap();
    fs::write(folder.join("head.exr"), &whole[..60]).unwrap();
    write_spectra(
        &folder.join("spectra.exr"),
        [8, 4],
        BandGrid::visible(8).unwrap(),
        1.0,
    );
    let spectra = fs::read(folder.join("spectra.exr")).unwrap();
    fs::write(folder.join("few.exr"), &spectra[..spectra.len() / 2]).unwrap();
}

/// A file that is no picture of light is reported with this phrase.
fn no_picture(name: &str, phrase: &str) {
    let directory = TempDir::new().unwrap();
    write_bad_files(directory.path());
    assert_reported(
        surrounded_by(directory.path(), name),
        "environment.image",
        &[name, phrase],
    );
}

cases! { no_picture:
    a_missing_picture("none.hdr", "cannot be opened");
    half_a_radiance_file("cut.hdr", "cut short");
    the_header_of_a_radiance_file("head.hdr", "cut short");
    a_text("text.hdr", "neither a Radiance picture (.hdr) nor an OpenEXR picture");
    a_folder("folder.exr", "is a directory");
    a_picture_of_depths("depth.exr", "neither channels R, G and B, nor X, Y and Z");
    a_picture_of_two_layers("layers.exr", "several layers of colors, \"a\", \"b\"");
    an_openexr_file_without_its_end("cut.exr", "cut short");
    the_header_of_an_openexr_file("head.exr", "cut short");
    half_a_spectral_file("few.exr", "cut short");
}

/// Luminance is gray, and a layer is chosen by name. The last number of each texel is twice its largest component.
#[test]
fn luminance_and_layers_of_openexr_are_environment() {
    let directory = TempDir::new().unwrap();
    let folder = directory.path();
    let scale_of = |rest: &str| {
        let text = format!("environment = {{ type = 'image', {rest} }}");
        let scene = checked(folder, &text).unwrap();
        match scene.environment() {
            Environment::Picture { picture, .. } => picture.texels.values[0][3],
            other => panic!("{other:?}"),
        }
    };
    write_exr(&folder.join("gray.exr"), (2, 1), &["Y"], &[0.75; 2], None);
    assert_eq!(scale_of("image = 'gray.exr'"), 1.5);
    let layers = ["B", "G", "R", "key.B", "key.G", "key.R"];
    let path = folder.join("layers.exr");
    write_exr(&path, (2, 1), &layers, &[0.25; 2], None);
    assert_eq!(scale_of("image = 'layers.exr'"), 0.5);
    assert_eq!(scale_of("image = 'layers.exr', layer = 'key'"), 0.5);
    let wrong = "environment = { type = 'image', image = 'layers.exr', layer = 'fill' }";
    let phrases = ["layers.exr", "no layer \"fill\"", "\"key\""];
    assert_reported(checked(folder, wrong), "environment.image", &phrases);
    let hdr = include_bytes!("../../../../tests/data/environment.hdr");
    fs::write(folder.join("sky.hdr"), hdr).unwrap();
    let radiance = "environment = { type = 'image', image = 'sky.hdr', layer = 'key' }";
    assert_reported(
        checked(folder, radiance),
        "environment.image",
        &["sky.hdr", "no layers"],
    );
}

#[test]
fn pictures_of_a_wrong_size_are_reported() {
    let directory = TempDir::new().unwrap();
    let folder = directory.path();
    let ball = ImageBuffer::from_pixel(64, 64, Rgb([1.0_f32; 3]));
    ball.save(folder.join("ball.exr")).unwrap();
    fs::write(
        folder.join("wide.hdr"),
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8193 +X 16386\n",
    )
    .unwrap();
    write_spectra(
        &folder.join("wide_spectra.exr"),
        [16_400, 1],
        BandGrid::visible(1).unwrap(),
        1.0,
    );
    write_spectra(
        &folder.join("square.exr"),
        [64, 64],
        BandGrid::visible(8).unwrap(),
        1.0,
    );
    write_spectra(
        &folder.join("fine.exr"),
        [520, 260],
        BandGrid::visible(1).unwrap(),
        1.0,
    );
    let reported = |name: &str, phrases: &[&str]| {
        let phrases = [&[name], phrases].concat();
        assert_reported(surrounded_by(folder, name), "environment.image", &phrases);
    };
    reported("ball.exr", &["64 × 64", "twice as wide as high"]);
    reported("square.exr", &["64 × 64", "twice as wide as high"]);
    reported("wide.hdr", &["16386 × 8193", "at most 16384 per side"]);
    reported("wide_spectra.exr", &["16400 × 1", "at most 16384 per side"]);
    // A picture with few bands takes all the bands of the scene.
    let text = format!(
        "{CAMERA}render = {{ bands = 1024, size = [8, 8] }}\nenvironment = {{ type = 'image', image = 'fine.exr' }}\n"
    );
    assert_reported(
        read(&text, folder),
        "environment.image",
        &["fine.exr", "520 × 260", "1024 bands", "at most 131072"],
    );
}

fn no_light(value: f32, said: &str) {
    let directory = TempDir::new().unwrap();
    let mut values = [1.0; 32];
    values[2 * 8 + 5] = value;
    let path = directory.path().join("a.exr");
    write_exr(&path, (8, 4), &["R", "G", "B"], &values, None);
    let phrases = ["a.exr", "column 6 of row 3", said, "at most 1e9"];
    let read = surrounded_by(directory.path(), "a.exr");
    assert_reported(read, "environment.image", &phrases);
}

fn no_spectrum_of_light(value: f32) {
    let directory = TempDir::new().unwrap();
    let bands = BandGrid::visible(8).unwrap();
    write_spectra(&directory.path().join("a.exr"), [4, 2], bands, value);
    let phrases = ["a.exr", "column 1 of row 1", "it must be a number"];
    let read = surrounded_by(directory.path(), "a.exr");
    assert_reported(read, "environment.image", &phrases);
}

// Pixels that are no light are reported by their place.
cases! { no_light:
    a_pixel_that_is_no_number(f32::NAN, "a value of NaN");
    an_infinite_pixel(f32::INFINITY, "a value of inf");
    a_pixel_of_minus_infinity(f32::NEG_INFINITY, "a value of -inf");
    a_pixel_that_is_too_bright(2e9, "a value of 2e9");
}

cases! { no_spectrum_of_light:
    a_spectrum_that_is_no_number(f32::NAN);
    an_infinite_spectrum(f32::INFINITY);
}

/// Colors outside of sRGB have components below 0, and so does the ringing of filters: they are clipped.
#[test]
fn what_is_below_0_counts_as_0() {
    let directory = TempDir::new().unwrap();
    write_exr(
        &directory.path().join("a.exr"),
        (2, 1),
        &["R", "G", "B"],
        &[-1.0, 2.0],
        None,
    );
    let scene = surrounded_by(directory.path(), "a.exr").unwrap_or_else(|p| panic!("{p:#}"));
    let Environment::Picture { picture, .. } = scene.environment() else {
        panic!("it is not a picture");
    };
    assert_eq!(picture.texels.at([0, 0])[0][3], 0.0);
    assert_eq!(picture.texels.at([1, 0])[0][3], 4.0);
    write_spectra(
        &directory.path().join("b.exr"),
        [2, 1],
        BandGrid::visible(8).unwrap(),
        -1.0,
    );
    let scene = surrounded_by(directory.path(), "b.exr").unwrap_or_else(|p| panic!("{p:#}"));
    let Environment::Picture { picture, .. } = scene.environment() else {
        panic!("it is not a picture");
    };
    assert_eq!(picture.texels.at([1, 0]), [[0.0; 4]; 2]);
}

#[test]
fn spectra_that_end_within_the_bands_are_reported() {
    let directory = TempDir::new().unwrap();
    let narrow = BandGrid::new(400.0, 700.0, 6).unwrap();
    write_spectra(&directory.path().join("narrow.exr"), [2, 1], narrow, 1.0);
    let phrases = ["narrow.exr", "400", "700", "380", "780"];
    assert_reported(
        surrounded_by(directory.path(), "narrow.exr"),
        "environment.image",
        &phrases,
    );
}

fn chromaticities(points: [[f32; 2]; 4]) -> Chromaticities {
    let [red, green, blue, white] = points.map(|[x, y]| Vec2(x, y));
    Chromaticities {
        red,
        green,
        blue,
        white,
    }
}

/// ACES primaries AP1 (S-2014-004): the white remains that of D60, and red is redder than in sRGB.
#[test]
fn the_primaries_of_a_file_are_honored() {
    let directory = TempDir::new().unwrap();
    let ap1 = chromaticities([
        [0.713, 0.293],
        [0.165, 0.830],
        [0.128, 0.044],
        [0.32168, 0.33767],
    ]);
    write_exr(
        &directory.path().join("ap1.exr"),
        (2, 1),
        &["R", "G", "B"],
        &[1.0; 2],
        Some(ap1),
    );
    let scene = surrounded_by(directory.path(), "ap1.exr").unwrap_or_else(|p| panic!("{p:#}"));
    let Environment::Picture { picture, .. } = scene.environment() else {
        panic!("it is not a picture");
    };
    assert_eq!(picture.spectra, PictureSpectra::Smooth);
    // XYZ of the white, Y = 1, by the matrix of IEC 61966-2-1 (its inverse to 4 decimals): R = 1.0415, G = 0.9963, B = 0.8987.
    let red: f64 = 3.2406 * 0.952_646 - 1.5372 - 0.4986 * 1.008_825;
    let scale = f64::from(picture.texels.at([0, 0])[0][3]);
    assert!((scale / (2.0 * red) - 1.0).abs() < 1e-3, "{scale} {red}");
    let line = chromaticities([[0.2, 0.2], [0.3, 0.3], [0.4, 0.4], [0.33, 0.33]]);
    write_exr(
        &directory.path().join("line.exr"),
        (2, 1),
        &["R", "G", "B"],
        &[1.0; 2],
        Some(line),
    );
    let phrases = ["line.exr", "`chromaticities`", "not three primaries"];
    assert_reported(
        surrounded_by(directory.path(), "line.exr"),
        "environment.image",
        &phrases,
    );
}

fn bad_texture(name: &str, phrase: &str) {
    let directory = TempDir::new().unwrap();
    let folder = directory.path();
    let png = include_bytes!("../../../../tests/data/colors.png");
    fs::write(folder.join("cut.png"), &png[..png.len() / 2]).unwrap();
    let hdr = include_bytes!("../../../../tests/data/environment.hdr");
    fs::write(folder.join("other.png"), hdr).unwrap();
    let texture = format!(
        "[materials.wall]\ntype = 'diffuse'\nreflectance = {{ texture = '{name}' }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'wall'\ncenter = [0, 0, 0]\nradius = 1"
    );
    let field = "materials.wall.reflectance.texture";
    assert_reported(checked(folder, &texture), field, &[name, phrase]);
}

cases! { bad_texture:
    a_missing_texture("none.png", "cannot be opened");
    half_a_texture("cut.png", "is not a PNG picture that can be read");
    a_radiance_file_as_texture("other.png", "is not a PNG picture that can be read");
}

fn sky(says: &str) -> Result<Scene, Problems> {
    let sky = format!(
        "environment = {{ type = 'sky', sun_elevation_deg = 30, sun_azimuth_deg = 90{says} }}"
    );
    checked(Path::new(""), &sky)
}

fn picture_of(scene: &Scene) -> &EnvironmentPicture {
    match scene.environment() {
        Environment::Picture { picture, .. } => picture,
        _ => panic!("a sky is a picture"),
    }
}

fn group_names(scene: &Scene) -> Vec<(&str, bool)> {
    let groups = scene.light_groups().iter();
    groups
        .map(|group| (group.name.as_str(), group.lamp.is_some()))
        .collect()
}

#[test]
fn the_sun_is_there_unless_it_is_left_out() {
    let with = sky("").unwrap();
    let [sun] = with.lights() else {
        panic!("{:?}", with.lights());
    };
    let LightShape::DistantDisk { toward, .. } = sun.shape else {
        panic!("{sun:?}");
    };
    // 90° is toward +X.
    assert!((toward - glam::DVec3::new(0.75_f64.sqrt(), 0.5, 0.0)).length() < 1e-12);
    let without = sky(", sun = false").unwrap();
    assert!(without.lights().is_empty());
    // The sun still lights the ground.
    assert!(picture_of(&with) == picture_of(&without));
    let twice = sky(", scale = 2").unwrap();
    assert_eq!(twice.lights()[0].emission.scale, 2.0 * sun.emission.scale);
    let said = [
        ("", &[("sun", true), ("constant", true)][..]),
        (", light_group = 'day'", &[("day", false)]),
        (
            ", light_group = 'sky', sun_light_group = 'key'",
            &[("key", true), ("sky", true)],
        ),
        (
            ", sun_light_group = 'key'",
            &[("key", true), ("constant", true)],
        ),
        (", light_group = 'sky', sun = false", &[("sky", true)]),
    ];
    for (says, groups) in said {
        let scene = sky(says).unwrap_or_else(|p| panic!("{p:#}"));
        assert_eq!(group_names(&scene), groups, "{says}");
    }
}

fn bad_sky(says: &str, field: &str, phrase: &str) {
    let problems = sky(says).expect_err(says);
    assert_eq!(problems.iter().count(), 1, "{problems:#}");
    let problem = problems.iter().next().unwrap();
    assert_eq!(problem.field.to_string(), field, "{problems:#}");
    assert!(format!("{problems:#}").contains(phrase), "{problems:#}");
}

cases! { bad_sky:
    a_number_as_sun(", sun = 1", "environment.sun", "true or false");
    a_sun_with_a_bad_name(", sun_light_group = 'a b'", "environment.sun_light_group", "cannot be the name");
    a_sky_that_is_too_clear(", turbidity = 1", "environment.turbidity", "2 to 10");
    a_sky_below_0(", scale = -1", "environment.scale", "0 to 1e9");
    a_sky_that_is_too_bright(", scale = 1e8", "environment.scale", "at most 1e9");
}
