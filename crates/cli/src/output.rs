//! The output files of a render.

use crate::print;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::picture_file::spectral_exr::{self, Frame, Metadata, WriteOptions, WriteRowsError};
use pellicle::picture_file::{Destination, can_create_in};
use pellicle::spectra::SpectralImage;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The files that a render writes.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Outputs {
    pictures: Vec<PathBuf>,
    spectral: Vec<PathBuf>,
}

impl Outputs {
    /// Interprets the values of `-o`: `.png` is a picture, `.exr` a spectral image, a name without extension both, and a
    /// folder both, named after the scene. If `-o` is not given, both are written to the current folder.
    pub(crate) fn new(scene: &Path, asked: &[PathBuf]) -> miette::Result<Self> {
        let mut outputs = Self::default();
        let stem = scene.file_stem().unwrap_or("render".as_ref());
        if asked.is_empty() {
            outputs.add_both(Path::new(stem));
        }
        for path in asked {
            let extension = path.extension().map(OsStr::to_string_lossy);
            match extension.map(|name| name.to_lowercase()).as_deref() {
                _ if is_standard_output(path) => outputs.pictures.push(path.clone()),
                _ if path.is_dir() => outputs.add_both(&path.join(stem)),
                _ if names_a_folder(path) => return Err(no_folder("-o", path, path)),
                Some("png") => outputs.pictures.push(path.clone()),
                Some("exr") => outputs.spectral.push(path.clone()),
                None if is_stream(path) => outputs.pictures.push(path.clone()),
                None => outputs.add_both(path),
                Some(_) => {
                    return Err(miette!(
                        help = "end it in .png (picture) or .exr (spectral image), or leave out the ending for both",
                        "-o {}: a file with this ending cannot be written",
                        path.display()
                    ));
                }
            }
        }
        for path in outputs.paths() {
            check_place("-o", path, scene)?;
        }
        outputs.check_names()?;
        Ok(outputs)
    }

    /// Checks that a file beside the outputs can be written, and is none of them.
    pub(crate) fn check_also(&self, option: &str, path: &Path, read: &Path) -> miette::Result<()> {
        if is_stream(path) {
            return Err(miette!(
                help = "name a file",
                "{option} {}: this is no file",
                path.display()
            ));
        }
        check_place(option, path, read)?;
        let mut all = Self::default();
        all.spectral.extend(self.paths().cloned());
        all.spectral.push(path.to_owned());
        all.check_names()
    }

    /// Whether an output is a pipe or a device.
    pub(crate) fn has_stream(&self) -> bool {
        self.paths().any(|path| is_stream(path))
    }

    fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.pictures.iter().chain(&self.spectral)
    }

    /// Checks that no file is written twice, under one name or under two.
    fn check_names(&self) -> miette::Result<()> {
        let mut known: Vec<(&PathBuf, PathBuf)> = Vec::new();
        let to_standard_output = self.pictures.iter().filter(|path| is_standard_output(path));
        if to_standard_output.count() > 1 {
            return Err(miette!("-o -: standard output gets one picture"));
        }
        for path in self.paths() {
            let Ok(Destination::File(file)) = Destination::of(path) else {
                continue;
            };
            let folder = folder_of(&file).canonicalize().into_diagnostic()?;
            let file = folder.join(file.file_name().unwrap_or_default());
            if let Some((first, _)) = known.iter().find(|(_, other)| *other == file) {
                return Err(miette!(
                    help = "name each file once",
                    "{} and {}: these are the same file",
                    first.display(),
                    path.display()
                ));
            }
            known.push((path, file));
        }
        Ok(())
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

    /// Returns the same outputs with the number of a frame in each name, as in `name_0000.png`. The number has four digits,
    /// or as many as that of the last frame, so that names sort by frame.
    pub(crate) fn of_frame(&self, frame: u32, last: u32) -> Self {
        let digits = last.to_string().len().max(4);
        let number = format!("_{frame:0digits$}.");
        let numbered =
            |paths: &[PathBuf]| paths.iter().map(|path| numbered(path, &number)).collect();
        Self {
            pictures: numbered(&self.pictures),
            spectral: numbered(&self.spectral),
        }
    }

    /// The pictures among the outputs.
    pub(crate) fn pictures(&self) -> &[PathBuf] {
        &self.pictures
    }

    /// The spectral images among the outputs.
    pub(crate) fn spectral(&self) -> &[PathBuf] {
        &self.spectral
    }
}

/// Writes a spectral image whose rows are supplied while it is written.
pub(crate) fn write_rows(
    path: &Path,
    frame: Frame,
    metadata: &Metadata,
    next: &mut dyn FnMut() -> miette::Result<Option<SpectralImage>>,
) -> miette::Result<()> {
    match spectral_exr::write_rows(path, frame, metadata, WriteOptions::default(), next) {
        Ok(()) => print::note(format_args!("wrote {}", path.display())),
        Err(WriteRowsError::Source(error)) => return Err(error),
        Err(WriteRowsError::Write(error)) => {
            let error = Err(error).into_diagnostic();
            return error.wrap_err_with(|| format!("{} was not written", path.display()));
        }
        Err(_) => return Err(miette!("{} was not written", path.display())),
    }
    Ok(())
}

/// Inserts a number before the ending, which every output has.
fn numbered(path: &Path, number: &str) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(number);
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

/// Whether a path that is not a folder is written like one.
fn names_a_folder(path: &Path) -> bool {
    let ends_in_separator = path.to_string_lossy().ends_with(std::path::is_separator);
    ends_in_separator || path.file_name().is_none()
}

fn no_folder(option: &str, path: &Path, folder: &Path) -> miette::Report {
    miette!(
        help = format!("create it first, or write elsewhere with {option}"),
        "{option} {}: there is no folder {}",
        path.display(),
        folder.display()
    )
}

/// The folder that contains a file.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Whether a path names a pipe or a device, or is `-`, standard output.
pub(crate) fn is_stream(path: &Path) -> bool {
    let destination = Destination::of(path);
    matches!(
        destination,
        Ok(Destination::Stream(_) | Destination::StandardOutput)
    )
}

/// Whether a path is `-`.
pub(crate) fn is_standard_output(path: &Path) -> bool {
    matches!(Destination::of(path), Ok(Destination::StandardOutput))
}

/// Checks that a path can be written to, so that errors are reported before the work and not after it. `option` is the
/// option that names the path, `read` the input file, which must not be overwritten.
pub(crate) fn check_place(option: &str, path: &Path, read: &Path) -> miette::Result<()> {
    if is_standard_output(path) {
        return Ok(());
    }
    if path.is_dir() {
        return Err(miette!("{option} {}: this is a folder", path.display()));
    }
    if names_a_folder(path) {
        return Err(no_folder(option, path, path));
    }
    let file = match Destination::of(path) {
        // It exists and is not replaced.
        Ok(Destination::Stream(_) | Destination::StandardOutput) => return Ok(()),
        Ok(Destination::File(file)) => file,
        Err(error) => return Err(miette!("{option} {}: {error}", path.display())),
    };
    let folder = folder_of(&file);
    if !folder.is_dir() {
        return Err(no_folder(option, path, folder));
    }
    if let (Ok(written), Ok(read)) = (path.canonicalize(), read.canonicalize())
        && written == read
    {
        return Err(miette!(
            help = format!("write elsewhere with {option}"),
            "{}: this would overwrite the file that is read",
            path.display()
        ));
    }
    can_create_in(folder)
        .into_diagnostic()
        .wrap_err_with(|| format!("{}: its folder cannot be written to", path.display()))
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
        let found = outputs(&["A.PNG", "b.c.Exr"]).unwrap();
        assert_eq!(found.pictures, [PathBuf::from("A.PNG")]);
        assert_eq!(found.spectral, [PathBuf::from("b.c.Exr")]);
        assert!(outputs(&["a.jpg"]).is_err());
    }

    #[test]
    fn frames_are_numbered_before_the_ending() {
        let found = outputs(&["a.PNG", "./c.d.exr"]).unwrap();
        assert_eq!(found.of_frame(7, 9).pictures, [PathBuf::from("a_0007.PNG")]);
        let late = found.of_frame(12_345, 12_345);
        assert_eq!(late.spectral, [PathBuf::from("./c.d_12345.exr")]);
        let early = found.of_frame(7, 12_345);
        assert_eq!(early.spectral, [PathBuf::from("./c.d_00007.exr")]);
    }

    #[test]
    fn a_folder_gets_both_files_named_after_the_scene() {
        let found = outputs(&["."]).unwrap();
        assert_eq!(found.pictures, [PathBuf::from("./soap_bubble.png")]);
        assert_eq!(found.spectral, [PathBuf::from("./soap_bubble.exr")]);
        for missing in ["no/such/folder/a.png", "no_such_folder/", "no_such/..", ""] {
            assert!(outputs(&[missing]).is_err(), "{missing:?}");
        }
    }

    #[test]
    fn a_file_is_named_once() {
        for asked in [
            ["a.png", "a.png"],
            ["a.png", "./a.png"],
            ["a.exr", "a"],
            ["a", "../cli/a.png"],
        ] {
            let error = outputs(&asked).unwrap_err().to_string();
            assert!(error.contains("the same file"), "{asked:?}: {error}");
        }
        assert!(outputs(&["a.png", "b.png", "a.exr"]).is_ok());
    }

    #[test]
    fn names_that_tell_no_kind_of_file_are_refused() {
        for name in ["a.png/", "a.exr/"] {
            assert!(outputs(&[name]).is_err(), "{name:?}");
        }
    }

    #[test]
    fn standard_output_gets_the_picture() {
        let found = outputs(&["-"]).unwrap();
        assert_eq!(found.pictures, [PathBuf::from("-")]);
        assert!(found.spectral.is_empty());
        assert!(outputs(&["-", "-"]).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_device_gets_the_picture() {
        let found = outputs(&["/dev/null"]).unwrap();
        assert_eq!(found.pictures, [PathBuf::from("/dev/null")]);
        assert!(found.spectral.is_empty());
    }
}
