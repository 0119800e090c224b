//! Files that other programs wrote.

use std::path::Path;

use pellicle_color::BandWeights;
use pellicle_color::spectral_exr::{self, ReadExrError};
use spectra::BandGrid;

/// Writes a file with these channels, as another program might.
fn write_foreign(path: &Path, names: &[&str]) {
    use exr::prelude::*;

    let channel = |&name: &&str| {
        let samples = FlatSamples::F16((0..6).map(|i| f16::from_f32(i as f32)).collect());
        AnyChannel::new(name, samples)
    };
    let channels = AnyChannels::sort(names.iter().map(channel).collect());
    let image = Image::from_channels((3, 2), channels);
    image.write().to_file(path).unwrap();
}

#[test]
fn files_of_other_programs_are_read() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let names = [
        "R",
        "S0.500nm",
        "S0.4,5e2nm",
        "S0.550,00nm",
        "S1.450nm",
        "T.450nm",
    ];
    write_foreign(&path, &names);
    let (image, metadata) = spectral_exr::read(&path).unwrap();
    let grid = BandGrid::new(425.0, 575.0, 3).unwrap();
    assert_eq!(image.bands(), &grid);
    assert_eq!(image.pixel(2, 1), [5.0; 3]);
    assert_eq!((image.samples()[0], metadata.software.as_str()), (0, ""));
    let xyz = BandWeights::observed(&grid, spectra::Observer::Cie1931Deg2)
        .xyz(&[5.0; 3])
        .map(|v| v as f32);
    assert_eq!(image.xyz()[5].map(f32::to_bits), xyz.map(f32::to_bits));
}

#[test]
fn spectra_that_cannot_be_used_are_told_apart() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let fault = |names: &[&str]| {
        write_foreign(&path, names);
        spectral_exr::read(&path).unwrap_err()
    };
    assert!(matches!(
        fault(&["R", "G", "B"]),
        ReadExrError::NoSpectrum { .. }
    ));
    for names in [
        &["S0.400nm", "S0.410nm", "S0.430nm"][..],
        &["S0.400nm", "S0.400,0nm"],
        &["S0.0,5um", "S0.0,6um"],
        &["S0.550nm"],
        &["S0.900nm", "S0.910nm"],
    ] {
        let error = fault(names);
        assert!(
            matches!(error, ReadExrError::Bands { .. }),
            "{names:?}: {error}"
        );
    }
}
