//! Options that show an image under other lamps and for other observers.

use crate::lamp::{self, Lamp};
use miette::IntoDiagnostic;
use pellicle::relight::{Relight, relight};
use pellicle::spectra::{Observer, SpectralImage};

/// The lamps of light groups, and the observer.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct RelightArguments {
    /// Give a light group another lamp, an illuminant or a file such as a .csv, with or without a factor (`key=F11`,
    /// `sky=D65*0.3`), or keep its lamp and change its brightness (`sky=*0.3`); can be repeated
    #[arg(long = "light", value_name = "GROUP=LAMP*FACTOR", value_parser = light)]
    lights: Vec<(String, Relight)>,
    /// The CIE observer: 1931_2, 1964_10, 2015_2 or 2015_10
    #[arg(long, value_name = "NAME", default_value = Observer::Cie1931Deg2.name())]
    observer: Observer,
}

impl RelightArguments {
    /// Whether an image stays unchanged, so that its XYZ is enough.
    pub(crate) fn is_nothing(&self) -> bool {
        self.lights.is_empty() && self.observer == Observer::Cie1931Deg2
    }

    /// The observer.
    pub(crate) fn observer(&self) -> Observer {
        self.observer
    }

    /// Applies the lamps and the observer to an image that was rendered or read.
    pub(crate) fn apply(&self, image: &mut SpectralImage) -> miette::Result<()> {
        if self.is_nothing() {
            return Ok(());
        }
        relight(image, &self.lights, self.observer).into_diagnostic()
    }
}

fn light(text: &str) -> Result<(String, Relight), String> {
    let (group, lamp) = text
        .split_once('=')
        .map(|(group, lamp)| (group.trim(), lamp.trim()))
        .filter(|(group, _)| !group.is_empty())
        .ok_or("write a light group and its lamp, such as key=F11, key=D65*0.3 or key=*0.3")?;
    let relight = if let Some(factor) = lamp.strip_prefix('*') {
        Relight {
            lamp: None,
            factor: lamp::parse_factor(factor)?,
        }
    } else {
        let Lamp {
            spectrum, factor, ..
        } = Lamp::parse(lamp)?;
        Relight {
            lamp: Some(spectrum),
            factor,
        }
    };
    Ok((group.to_owned(), relight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use pellicle::spectra::{BandGrid, LightGroup};

    #[derive(Debug, Parser)]
    struct Command {
        #[command(flatten)]
        relight: RelightArguments,
    }

    fn parsed(arguments: &[&str]) -> Result<RelightArguments, clap::Error> {
        let command = ["develop"].iter().chain(arguments);
        Command::try_parse_from(command).map(|command| command.relight)
    }

    fn image() -> SpectralImage {
        let grid = BandGrid::visible(8).unwrap();
        let d65 = pellicle::spectra::illuminant("D65").unwrap().data;
        let groups = ["key", "sky"].map(|name| LightGroup {
            name: name.to_owned(),
            lamp: grid.lamp(&d65),
        });
        let mut image = SpectralImage::with_light_groups(1, 1, grid, groups.to_vec());
        image.set_pixel_by_light((0, 0), &[1.0; 16], &[0.0; 8], &[[1.0; 3]; 2], 1);
        image
    }

    #[test]
    fn without_options_nothing_changes() {
        let options = parsed(&[]).unwrap();
        let mut same = image();
        options.apply(&mut same).unwrap();
        assert!(options.is_nothing() && same == image());
    }

    #[test]
    fn lamps_factors_and_observers_are_applied() {
        let options = parsed(&["--light", "key=F11*2", "--light", "sky=*0.25"]).unwrap();
        let mut image = image();
        options.apply(&mut image).unwrap();
        assert_eq!(image.group_radiance(1), [0.25; 8]);
        assert_eq!(image.group_xyz(1), [[0.25; 3]]);
        assert_ne!(image.group_radiance(0), [1.0; 8]);
        let before = image.xyz().to_vec();
        let options = parsed(&["--observer", "1964_10"]).unwrap();
        options.apply(&mut image).unwrap();
        assert_ne!(image.xyz(), before);
    }

    #[test]
    fn what_is_no_light_is_reported() {
        for (arguments, said) in [
            (["--light", "F11"], "key=F11"),
            (["--light", "=F11"], "key=F11"),
            (["--light", "key=f11"], "did you mean"),
            (["--light", "key=*x"], "is not a factor"),
            (["--light", "key="], "known names:"),
            (["--observer", "1931"], "known names: 1931_2"),
        ] {
            let error = parsed(&arguments).unwrap_err().to_string();
            assert!(error.contains(said), "{arguments:?}: {error}");
        }
        let options = parsed(&["--light", "moon=F11"]).unwrap();
        let error = options.apply(&mut image()).unwrap_err().to_string();
        assert!(error.contains("it has \"key\", \"sky\""), "{error}");
    }
}
