use super::*;
use spectra::{KM_LUMENS_PER_WATT, LightGroup};

fn illuminant(name: &str) -> Spectrum {
    spectra::illuminant(name).unwrap().data
}

fn group(grid: &BandGrid, name: &str, lamp: Option<&str>) -> LightGroup {
    LightGroup {
        name: name.to_owned(),
        lamp: lamp.and_then(|lamp| grid.lamp(&illuminant(lamp))),
    }
}

/// A white surface under each light group; XYZ marks the groups.
fn image(groups: &[(&str, Option<&str>)]) -> SpectralImage {
    let grid = BandGrid::visible(16).unwrap();
    let groups: Vec<_> = groups
        .iter()
        .map(|(name, lamp)| group(&grid, name, *lamp))
        .collect();
    let count = groups.len();
    let mut image = SpectralImage::with_light_groups(3, 2, grid, groups);
    for (x, y) in (0..6).map(|i| (i % 3, i / 3)) {
        let level = |i: usize| 0.5 + (i % 7) as f32 * 0.1 + y as f32;
        let radiance: Vec<f32> = (0..16 * count).map(level).collect();
        let xyz: Vec<_> = (0..count).map(|g| [g as f32 + 1.0; 3]).collect();
        image.set_pixel_by_light((x, y), &radiance, &[0.01; 16], &xyz, 4);
    }
    image
}

fn change(name: &str, lamp: Option<&str>, factor: f64) -> (String, Relight) {
    let lamp = lamp.map(illuminant);
    (name.to_owned(), Relight { lamp, factor })
}

const DEG2: Observer = Observer::Cie1931Deg2;

#[test]
fn what_is_left_as_it_is_keeps_its_bits() {
    let before = image(&[("key", Some("D65")), ("sky", None)]);
    let mut after = before.clone();
    relight(&mut after, &[], DEG2).unwrap();
    assert_eq!(after, before);
    let same = [change("key", Some("D65"), 1.0), change("sky", None, 1.0)];
    relight(&mut after, &same, DEG2).unwrap();
    assert_eq!(after, before);
    // A new lamp for one light group leaves the other unchanged.
    relight(&mut after, &[change("key", Some("A"), 1.0)], DEG2).unwrap();
    assert_eq!(after.group_radiance(1), before.group_radiance(1));
    assert_eq!(after.group_xyz(1), before.group_xyz(1));
    assert_ne!(after.group_xyz(0), before.group_xyz(0));
    assert_ne!(after.light_groups()[0].lamp, before.light_groups()[0].lamp);
}

#[test]
fn a_factor_multiplies_a_light_group_and_the_total_is_the_sum() {
    let before = image(&[("key", Some("D65")), ("sky", None)]);
    let mut after = before.clone();
    relight(&mut after, &[change("sky", None, 0.25)], DEG2).unwrap();
    for (i, &total) in after.radiance().iter().enumerate() {
        let [key, sky] = [0, 1].map(|group| before.group_radiance(group)[i]);
        assert_eq!(after.group_radiance(1)[i], 0.25 * sky);
        assert_eq!(total, key + 0.25 * sky);
        // The relative noise stays.
        let ratio = total / before.radiance()[i];
        assert!((after.variance()[i] - 0.01 * ratio * ratio).abs() < 1e-8);
    }
    assert_eq!(after.xyz()[0], [1.5; 3]);
    let mut off = before.clone();
    relight(
        &mut off,
        &[change("key", None, 0.0), change("sky", None, 0.0)],
        DEG2,
    )
    .unwrap();
    assert!(
        off.radiance()
            .iter()
            .chain(off.variance())
            .all(|&value| value == 0.0)
    );
}

#[test]
fn a_new_lamp_on_white_is_the_new_lamp() {
    let grid = BandGrid::visible(16).unwrap();
    for groups in [
        &[("all", Some("D65"))][..],
        &[("all", Some("D65")), ("dark", None)],
    ] {
        let mut image = image(groups);
        let d65 = Spectrum::Table(group(&grid, "", Some("D65")).lamp.unwrap());
        let mean = |lamp: &Spectrum, band: u32| {
            let place = |i: u32| grid.wavelength_nm(band, (f64::from(i) + 0.5) / 500.0);
            let sum: f64 = (0..500).map(|i| lamp.at(place(i)).unwrap()).sum();
            (sum / 500.0) as f32
        };
        let mut white: Vec<f32> = (0..16).map(|band| mean(&d65, band)).collect();
        white.resize(16 * groups.len(), 0.0);
        let xyz = vec![[0.0; 3]; groups.len()];
        image.set_pixel_by_light((1, 1), &white, &[0.0; 16], &xyz, 1);
        let doubled = [change("all", Some("FL11"), 2.0)];
        relight(&mut image, &doubled, DEG2).unwrap();
        // The lamp as a render over the bands uses it.
        let fl11 = Spectrum::Table(group(&grid, "", Some("FL11")).lamp.unwrap());
        for (band, &found) in (0..).zip(image.pixel(1, 1)) {
            let expected = 2.0 * mean(&fl11, band);
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{band}: {found} {expected}"
            );
        }
        let mut y = 0.0;
        for nm in (0..4000).map(|i| 380.05 + 0.1 * f64::from(i)) {
            y += 0.2 * KM_LUMENS_PER_WATT * fl11.at(nm).unwrap() * DEG2.at(nm)[1];
        }
        let found = f64::from(image.xyz()[4][1]);
        assert!((found / y - 1.0).abs() < 1e-4, "{found} {y}");
        // And back to the first lamp.
        relight(&mut image, &[change("all", Some("D65"), 0.5)], DEG2).unwrap();
        for (found, expected) in image.pixel(1, 1).iter().zip(&white) {
            assert!((found / expected - 1.0).abs() < 2e-2, "{found} {expected}");
        }
    }
}

#[test]
fn another_observer_sees_the_same_bands() {
    let before = image(&[("key", Some("D65")), ("sky", None)]);
    let mut after = before.clone();
    relight(&mut after, &[], Observer::Cie1964Deg10).unwrap();
    assert_eq!(after.radiance(), before.radiance());
    assert_ne!(after.xyz(), before.xyz());
    let sum = BandWeights::observed(before.bands(), Observer::Cie1964Deg10);
    let expected = sum.xyz(&before.group_radiance(1)[..16]);
    let found = after.group_xyz(1)[0];
    assert!((f64::from(found[0]) / expected[0] - 1.0).abs() < 1e-6);
}

#[test]
fn what_cannot_be_relit_is_reported_and_left() {
    let before = image(&[("key", Some("D65")), ("sky", None)]);
    let narrow = Tabulated::new(vec![(400.0, 1.0), (700.0, 1.0)]).unwrap();
    let narrow = Relight {
        lamp: Some(Spectrum::Table(narrow)),
        factor: 1.0,
    };
    let dark = Tabulated::new(vec![(380.0, 0.0), (600.0, 0.0), (780.0, 1.0)]).unwrap();
    for (changes, said) in [
        (vec![change("moon", None, 1.0)], "it has \"key\", \"sky\""),
        (
            vec![change("key", None, 1.0), change("key", None, 2.0)],
            "given twice",
        ),
        (vec![change("key", None, -1.0)], "number of at least 0"),
        (vec![change("key", None, f64::NAN)], "number of at least 0"),
        (vec![change("sky", Some("A"), 1.0)], "only its factor"),
        (vec![("key".to_owned(), narrow)], "does not cover"),
    ] {
        let mut image = before.clone();
        let error = relight(&mut image, &changes, DEG2).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
        assert_eq!(image, before);
    }
    let mut image = before;
    image.light_group_mut(0).lamp = Some(dark);
    let error = relight(&mut image, &[change("key", Some("A"), 1.0)], DEG2).unwrap_err();
    assert!(error.to_string().contains("from 555 to 580 nm"), "{error}");
}

#[test]
fn variance_stays_where_a_band_gives_no_ratio() {
    let mut image = image(&[("all", Some("D65"))]);
    let mut radiance = [2.0; 16];
    (radiance[3], radiance[5]) = (f32::NAN, 0.0);
    image.set_pixel((1, 1), &radiance, &[0.01; 16], [1.0; 3], 4);
    let before = image.clone();
    let pixel = |image: &SpectralImage| image.variance()[4 * 16..5 * 16].to_vec();
    relight(&mut image, &[change("all", None, 3.0)], DEG2).unwrap();
    for (band, (after, before)) in pixel(&image).iter().zip(pixel(&before)).enumerate() {
        let expected = if band == 3 || band == 5 { 1.0 } else { 9.0 };
        assert!((after / before - expected).abs() < 1e-5, "{band}");
    }
    relight(&mut image, &[change("all", Some("A"), 1.0)], DEG2).unwrap();
    assert!((pixel(&image)[3] / pixel(&before)[3] - 1.0).abs() < 1e-5);
}

/// Light that is polarized alike in all bands keeps its degree under another lamp, in bands and in XYZ, and with a factor.
#[test]
fn components_change_as_s0_does() {
    for names in [&["key", "sky"][..], &["key"]] {
        let groups: Vec<_> = names.iter().map(|name| (*name, Some("D65"))).collect();
        let shares = [-0.5, 0.25, 0.125_f32];
        let mut image = image(&groups).with_polarization();
        let count = names.len();
        for (x, y) in (0..6).map(|i| (i % 3, i / 3)) {
            let place = (y * 3 + x) as usize;
            for (stokes, share) in Stokes::POLARIZED.into_iter().zip(shares) {
                let of_group = |g| image.group_radiance(g)[place * 16..][..16].to_vec();
                let s0: Vec<f32> = (0..count).flat_map(of_group).collect();
                let radiance: Vec<f32> = s0.iter().map(|v| share * v).collect();
                let xyz: Vec<_> = (0..count)
                    .map(|g| image.group_xyz(g)[place].map(|v| share * v))
                    .collect();
                image.set_component_by_light((x, y), stokes, &radiance, &xyz);
            }
        }
        let before = image.clone();
        relight(&mut image, &[change("key", Some("A"), 0.5)], DEG2).unwrap();
        assert_ne!(image.radiance(), before.radiance());
        for (stokes, share) in Stokes::POLARIZED.into_iter().zip(shares) {
            for quantity in [Quantity::Radiance, Quantity::Xyz] {
                let keys = LayerKey::all(count).filter(|key| key.quantity == quantity);
                for key in keys {
                    let of = |key| image.layer(key).unwrap().floats();
                    let pairs = of(key).iter().zip(of(key.component(stokes)));
                    for (s0, own) in pairs {
                        assert!((share * s0 - own).abs() <= 1e-5 * s0.abs(), "{key:?}");
                    }
                }
            }
        }
    }
}

/// Bands that a new lamp would make negative are 0, and nothing is more than fully polarized.
#[test]
fn no_component_is_larger_than_s0_under_another_lamp() {
    let mut image = image(&[("key", Some("D65"))]).with_polarization();
    let spiky: Vec<f32> = (0..16)
        .map(|b| if b % 4 == 1 { 1.0 } else { 1e-3 })
        .collect();
    image.set_pixel((0, 0), &spiky, &[0.0; 16], [1.0; 3], 1);
    let other: Vec<f32> = spiky
        .iter()
        .zip([1.0, -1.0].into_iter().cycle())
        .map(|(v, s)| s * v)
        .collect();
    image.set_component_by_light((0, 0), Stokes::S2, &other, &[[0.5; 3]]);
    relight(&mut image, &[change("key", Some("FL11"), 1.0)], DEG2).unwrap();
    let s2 = image.group_component(0, Stokes::S2);
    assert!(s2.iter().any(|&v| v < 0.0));
    for (s2, s0) in s2.iter().zip(image.radiance()) {
        assert!(s2.abs() <= *s0, "{s2} {s0}");
    }
}
