//! Which space keeps hue, compared with the judgment of observers and for interference colors outside the gamut.

use color::develop::{Gamut, GamutMapping};
use colorimetry::adaptation::Adaptation;
use colorimetry::ciecam16::{Surround, Ucs, ViewingConditions};
use colorimetry::lab::delta_e_2000;
use colorimetry::matrix::{inverse, times};
use colorimetry::{Display, Lab, Oklab};
use relight::BandWeights;
use relight::xyz::exposure_scale;
use spectra::BandGrid;
use std::collections::BTreeMap;

/// Colors seen as the same hue, by the name of the hue, and their white.
struct Loci {
    white: [f64; 3],
    hues: BTreeMap<&'static str, Vec<[f64; 3]>>,
}

impl Loci {
    fn read(text: &'static str, white: [f64; 3]) -> Self {
        let mut hues = BTreeMap::<_, Vec<_>>::new();
        let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
        for line in lines {
            let mut fields = line.split(',');
            let hue = fields.next().unwrap();
            let mut next = || fields.next().unwrap().parse().unwrap();
            hues.entry(hue).or_default().push([next(), next(), next()]);
        }
        Self { white, hues }
    }

    fn hung_berns() -> Self {
        let (x, y) = (0.3101, 0.3163);
        let white = [x / y, 1.0, (1.0 - x - y) / y];
        Self::read(include_str!("data/hung_berns_1995.csv"), white)
    }

    fn ebner_fairchild() -> Self {
        let white = [0.9501, 1.0, 1.0881];
        Self::read(include_str!("data/ebner_fairchild_1998.csv"), white)
    }
}

/// A color space: conversions from and to XYZ of lightness and the two coordinates of hue.
struct Space {
    name: &'static str,
    of_xyz: Box<dyn Fn([f64; 3]) -> [f64; 3]>,
    to_xyz: Box<dyn Fn([f64; 3]) -> [f64; 3]>,
}

fn spaces(white: [f64; 3]) -> [Space; 3] {
    let d65 = Display::named("srgb").unwrap().white_xyz();
    let to_d65 = Adaptation::Bradford.matrix(white, d65);
    let from_d65 = inverse(&to_d65);
    // The conditions with which the authors of CIECAM16 compare spaces: an average surround, and an adapting field of a fifth of
    // 64 cd/m².
    let conditions =
        ViewingConditions::new(white.map(|v| 100.0 * v), 64.0, 20.0, Surround::Average);
    [
        Space {
            name: "CIELAB",
            of_xyz: Box::new(move |xyz| {
                let Lab { l, a, b } = Lab::from_xyz(xyz, white);
                [l, a, b]
            }),
            to_xyz: Box::new(move |[l, a, b]| Lab { l, a, b }.to_xyz(white)),
        },
        Space {
            name: "CIECAM16-UCS",
            of_xyz: Box::new(move |xyz| {
                let Ucs { j, a, b } = conditions.ucs(xyz.map(|v| 100.0 * v));
                [j, a, b]
            }),
            to_xyz: Box::new(move |[j, a, b]| {
                conditions.xyz_of_ucs(Ucs { j, a, b }).map(|v| v / 100.0)
            }),
        },
        Space {
            name: "Oklab",
            of_xyz: Box::new(move |xyz| {
                let Oklab { l, a, b } = Oklab::from_xyz(times(&to_d65, xyz));
                [l, a, b]
            }),
            to_xyz: Box::new(move |[l, a, b]| times(&from_d65, Oklab { l, a, b }.to_xyz())),
        },
    ]
}

/// Returns how far each color moves, in ΔE₀₀, when it takes the mean hue of the colors seen as the same hue.
fn errors(space: &Space, colors: &[[f64; 3]], white: [f64; 3]) -> Vec<f64> {
    let own: Vec<[f64; 3]> = colors.iter().map(|&xyz| (space.of_xyz)(xyz)).collect();
    let directions = own
        .iter()
        .map(|[_, a, b]| [a / a.hypot(*b), b / a.hypot(*b)]);
    let [a, b] = directions.fold([0.0; 2], |sum, d| [sum[0] + d[0], sum[1] + d[1]]);
    let (a, b) = (a / a.hypot(b), b / a.hypot(b));
    let moved = own.iter().map(|&[l, x, y]| {
        let chroma = x.hypot(y);
        (space.to_xyz)([l, chroma * a, chroma * b])
    });
    let lab = |xyz| Lab::from_xyz(xyz, white);
    let pairs = moved.zip(colors);
    pairs
        .map(|(moved, &xyz)| delta_e_2000(lab(moved), lab(xyz)))
        .collect()
}

/// Returns mean, 95th percentile and maximum.
fn summary(errors: &mut [f64]) -> [f64; 3] {
    errors.sort_by(f64::total_cmp);
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let p95 = errors[(0.95 * (errors.len() - 1) as f64).round() as usize];
    [mean, p95, errors[errors.len() - 1]]
}

/// The table in the documentation of gamut mapping is right to its last digit: mean, 95 %, blue if there is one, max. The means
/// agree with an independent computation (colour-science 0.4.7).
#[test]
fn oklab_keeps_hue_best() {
    for (loci, count, table) in [
        (
            Loci::hung_berns(),
            48,
            [
                "1.66 | 4.7 | 8.5 | 19.8",
                "1.03 | 3.4 | 3.3 | 6.7",
                "0.76 | 2.0 | 1.6 | 3.3",
            ],
        ),
        (
            Loci::ebner_fairchild(),
            321,
            ["1.33 | 4.0 | 11.0", "1.10 | 3.0 | 5.2", "0.93 | 2.5 | 4.5"],
        ),
    ] {
        let found: usize = loci.hues.values().map(Vec::len).sum();
        assert_eq!(found, count);
        for (space, line) in spaces(loci.white).iter().zip(table) {
            let of_hue = |colors: &Vec<[f64; 3]>| errors(space, colors, loci.white);
            let mut all: Vec<f64> = loci.hues.values().flat_map(of_hue).collect();
            let [mean, p95, max] = summary(&mut all);
            let blue = loci.hues.get("blue").map_or_else(String::new, |blue| {
                format!("{:.1} | ", summary(&mut of_hue(blue))[0])
            });
            let found = format!("{mean:.2} | {p95:.1} | {blue}{max:.1}");
            assert_eq!(found, line, "{}", space.name);
        }
    }
}

/// Returns the XYZ of free films in D65, 5 to 1500 nm thick, exposed so that the brightest are near the white.
fn films(index: f64) -> Vec<[f64; 3]> {
    let grid = BandGrid::visible(200).unwrap();
    let observer = BandWeights::observed(&grid, spectra::Observer::Cie1931Deg2);
    let light = spectra::illuminant("D65").unwrap().data;
    let r2 = ((1.0 - index) / (1.0 + index)).powi(2);
    // The largest reflectance of such a film.
    let most = 4.0 * r2 / (1.0 + r2).powi(2);
    let film = |thickness_nm: f64| {
        let radiance: Vec<f32> = (0..grid.count())
            .map(|band| {
                let nm = grid.center_nm(band);
                let f = 4.0 * r2 / (1.0 - r2).powi(2)
                    * (2.0 * std::f64::consts::PI * index * thickness_nm / nm)
                        .sin()
                        .powi(2);
                (light.at(nm).unwrap() * f / (1.0 + f) / most) as f32
            })
            .collect();
        observer.xyz(&radiance).map(|v| v * exposure_scale(0.0))
    };
    (1..=300).map(|i| film(5.0 * f64::from(i))).collect()
}

/// Hue is measured by the hue angle of CIECAM16, on which none of the mappings is based.
#[test]
fn interference_colors_keep_their_hue() {
    let display = Display::named("srgb").unwrap();
    let gamut = Gamut::new(&display);
    let white = display.white_xyz().map(|v| 100.0 * v);
    let judge = ViewingConditions::new(white, 64.0, 20.0, Surround::Average);
    let hue = |rgb| {
        judge
            .appearance(times(display.xyz_from_rgb(), rgb).map(|v: f64| 100.0 * v))
            .h
    };
    let outside: Vec<[f64; 3]> = [4.0 / 3.0, 2.4]
        .into_iter()
        .flat_map(films)
        .map(|xyz| times(display.rgb_from_xyz(), xyz))
        .filter(|&rgb| !gamut.contains(rgb))
        .collect();
    // The numbers in the documentation of gamut mapping.
    assert_eq!(outside.len(), 126);
    let turns = |mapping| {
        let turn = |&rgb: &[f64; 3]| {
            let turn = hue(gamut.map(mapping, rgb)) - hue(rgb);
            ((turn + 540.0).rem_euclid(360.0) - 180.0).abs()
        };
        let mut turns: Vec<f64> = outside.iter().map(turn).collect();
        let [mean, _, max] = summary(&mut turns);
        (format!("{mean:.1}"), format!("{max:.1}"))
    };
    for (mapping, mean, max) in [
        (GamutMapping::Clip, "3.7", "12.2"),
        (GamutMapping::TowardWhite, "1.1", "6.8"),
        (GamutMapping::Perceptual, "0.7", "5.6"),
    ] {
        let (found_mean, found_max) = turns(mapping);
        assert_eq!(
            (found_mean.as_str(), found_max.as_str()),
            (mean, max),
            "{mapping:?}"
        );
    }
}
