//! Where a render is written.

use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color;
use pellicle::color::spectral_exr::{Metadata, WriteOptions};
use pellicle::spectra::SpectralImage;
use std::path::{Path, PathBuf};

/// The files that a render writes.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Outputs {
    pictures: Vec<PathBuf>,
    spectral: Vec<PathBuf>,
}

impl Outputs {
    /// From what `-o` says: `.png` is a picture, `.exr` a spectral image, a name without extension both. Without any,
    /// both are named after the scene and stand in the current folder.
    pub(crate) fn new(scene: &Path, asked: &[PathBuf]) -> miette::Result<Self> {
        let mut outputs = Self::default();
        if asked.is_empty() {
            let stem = scene.file_stem().unwrap_or("render".as_ref());
            outputs.add_both(Path::new(stem));
        }
        for path in asked {
            match path.extension().and_then(|extension| extension.to_str()) {
                Some("png") => outputs.pictures.push(path.clone()),
                Some("exr") => outputs.spectral.push(path.clone()),
                None => outputs.add_both(path),
                Some(other) => {
                    return Err(miette!(
                        help = "end it in .png (picture) or .exr (spectral image), or leave the ending out for both",
                        "-o {}: a file ending in .{other} cannot be written",
                        path.display()
                    ));
                }
            }
        }
        outputs.check_folders()?;
        Ok(outputs)
    }

    fn add_both(&mut self, base: &Path) {
        // The base may have dots of its own: append rather than replace.
        let named = |ending: &str| {
            let mut name = base.as_os_str().to_owned();
            name.push(ending);
            PathBuf::from(name)
        };
        self.pictures.push(named(".png"));
        self.spectral.push(named(".exr"));
    }

    /// A missing folder is told before the render, not after it.
    fn check_folders(&self) -> miette::Result<()> {
        for path in self.pictures.iter().chain(&self.spectral) {
            let folder = path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty());
            if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
                return Err(miette!(
                    help = "create it first, or write elsewhere with -o",
                    "-o {}: there is no folder {}",
                    path.display(),
                    folder.display()
                ));
            }
        }
        Ok(())
    }

    /// Develops and writes.
    pub(crate) fn write(&self, image: &SpectralImage, metadata: &Metadata) -> miette::Result<()> {
        if !self.pictures.is_empty() {
            let picture = color::develop(image, metadata.exposure_ev);
            for path in &self.pictures {
                color::png::write(path, &picture)
                    .into_diagnostic()
                    .wrap_err_with(|| format!("{} was not written", path.display()))?;
                eprintln!("wrote {}", path.display());
            }
        }
        for path in &self.spectral {
            color::spectral_exr::write(path, image, metadata, WriteOptions::default())
                .into_diagnostic()
                .wrap_err_with(|| format!("{} was not written", path.display()))?;
            eprintln!("wrote {}", path.display());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outputs(asked: &[&str]) -> miette::Result<Outputs> {
        let asked: Vec<PathBuf> = asked.iter().map(PathBuf::from).collect();
        Outputs::new(Path::new("scenes/soap_bubble.toml"), &asked)
    }

    #[test]
    fn without_o_both_files_are_named_after_the_scene() {
        let found = outputs(&[]).unwrap();
        assert_eq!(found.pictures, [PathBuf::from("soap_bubble.png")]);
        assert_eq!(found.spectral, [PathBuf::from("soap_bubble.exr")]);
    }

    #[test]
    fn endings_choose_what_is_written() {
        let found = outputs(&["a.png", "b.exr", "c"]).unwrap();
        assert_eq!(found.pictures, ["a.png", "c.png"].map(PathBuf::from));
        assert_eq!(found.spectral, ["b.exr", "c.exr"].map(PathBuf::from));
        assert!(outputs(&["a.jpg"]).is_err());
        assert!(outputs(&["no/such/folder/a.png"]).is_err());
    }
}
