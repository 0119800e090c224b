//! The options of long renders: when they end, what they keep, which part of the picture they are of.

use crate::memory;
use miette::miette;
use pellicle::gpu::InjectedFault;
use pellicle::progressive::Goal;
use pellicle::scene::RenderSettings;
use pellicle::scene_file::limits;
use pellicle::spectra::Window;
use std::path::PathBuf;
use std::time::Duration;

#[derive(clap::Args)]
#[command(next_help_heading = "Long renders")]
pub(crate) struct Endurance {
    /// Stop after this time, such as 90s, 10min or 2h
    #[arg(long, value_name = "DURATION", value_parser = duration)]
    time: Option<Duration>,
    /// Stop when the standard error of the median pixel, over all bands, is this fraction of its radiance, such as 1%
    #[arg(long, value_name = "PERCENT", value_parser = noise)]
    noise: Option<f64>,
    /// Take more samples where the picture is noisier, as a pilot of few samples with another seed decides; --samples is the mean
    #[arg(long, conflicts_with_all = ["time", "noise"])]
    pub(super) adaptive: bool,
    /// Write the picture again and again while it is rendered, such as every 10s
    #[arg(long, value_name = "DURATION", value_parser = duration)]
    pub(super) preview_every: Option<Duration>,
    /// Keep the state of the render in this file, from which --resume goes on
    #[arg(long, value_name = "FILE", conflicts_with = "frames")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Time between checkpoints
    #[arg(long, value_name = "DURATION", value_parser = duration, default_value = "60s", requires = "checkpoint")]
    pub(super) checkpoint_every: Duration,
    /// Go on from the checkpoint, if there is one; a larger --samples continues a finished picture
    #[arg(long, requires = "checkpoint")]
    pub(super) resume: bool,
    /// Render only these pixels of the picture
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", value_parser = crop, conflicts_with = "part")]
    crop: Option<Window>,
    /// Render a part of the picture, K of N: rows, to be joined by `pellicle merge`
    #[arg(long, value_name = "K/N", value_parser = part, conflicts_with_all = ["frames", "adaptive"])]
    pub(super) part: Option<Part>,
    /// The number of the first sample: renders of other samples of the same picture can be joined by `pellicle merge`
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0,
        conflicts_with = "adaptive"
    )]
    pub(super) samples_from: u32,
    /// Use at most this memory, such as 4GB; larger pictures are rendered in strips of rows [default: four fifths of what is free]
    #[arg(long, value_name = "SIZE", value_parser = memory::bytes)]
    pub(super) max_memory: Option<u64>,
    /// Go on with the CPU when the GPU fails for good; the picture then has the bits of neither alone
    #[arg(long)]
    pub(super) allow_cpu: bool,
    /// Faults for tests, such as lost@2 for a device that is lost in round 2
    #[arg(long, hide = true, value_name = "FAULT@ROUND", value_parser = fault)]
    pub(super) inject_fault: Vec<(InjectedFault, u32)>,
}

/// A part of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    number: u32,
    count: u32,
}

impl Part {
    /// `3_of_16`, with as many digits in the first number as in the second.
    pub(super) fn file_name(self) -> String {
        let digits = self.count.to_string().len();
        format!("{:0digits$}_of_{}", self.number, self.count)
    }
}

fn duration(text: &str) -> Result<Duration, String> {
    let parsed = humantime::parse_duration(text).ok();
    let parsed = parsed.filter(|duration| !duration.is_zero());
    parsed.ok_or_else(|| {
        "write a time with its unit, as in 90s, 10min or 2h (the scene's own time is --scene-time)".to_owned()
    })
}

fn noise(text: &str) -> Result<f64, String> {
    let parsed = match text.strip_suffix('%') {
        Some(percent) => percent.trim_end().parse().map(|value: f64| 0.01 * value),
        None => text.parse(),
    };
    parsed
        .ok()
        .filter(|noise: &f64| (1e-6..0.5).contains(noise))
        .ok_or_else(|| {
            "write a fraction of the radiance, as in 1% or 0.01, from 0.0001% and below 50%"
                .to_owned()
        })
}

fn crop(text: &str) -> Result<Window, String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Window {
            origin: [x, y],
            size: [width, height],
        }),
        _ => Err(
            "write the column and row of the first pixel, width and height, as in 100,50,320,240"
                .to_owned(),
        ),
    }
}

fn part(text: &str) -> Result<Part, String> {
    let numbers = text.split_once('/');
    let parsed = numbers.and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    parsed
        .filter(|&(number, count)| (1..=count).contains(&number))
        .map(|(number, count)| Part { number, count })
        .ok_or_else(|| "write a part and their number, as in 3/16; the first is 1/16".to_owned())
}

fn fault(text: &str) -> Result<(InjectedFault, u32), String> {
    let (name, round) = text.split_once('@').ok_or("write FAULT@ROUND")?;
    let fault = match name {
        "lost" => InjectedFault::Lost,
        "out-of-memory" => InjectedFault::OutOfMemory,
        "refused" => InjectedFault::Refused,
        _ => return Err("lost, out-of-memory or refused".to_owned()),
    };
    Ok((fault, round.parse().map_err(|_| "the number of a round")?))
}

impl Endurance {
    /// When a render with these settings ends.
    pub(super) fn goal(&self, settings: &RenderSettings, samples: Option<u32>) -> Goal {
        let most = limits::MAX_SAMPLES.saturating_sub(self.samples_from);
        // Another end replaces the scene's number of samples, but not one that was asked for.
        let ends_otherwise = self.time.is_some() || self.noise.is_some();
        let samples = match samples {
            None if ends_otherwise => most,
            _ => settings.samples,
        };
        Goal {
            samples,
            seconds: self.time.map(|time| time.as_secs_f64()),
            noise: self.noise,
        }
    }

    /// The pixels to render.
    pub(super) fn window(&self, settings: &RenderSettings) -> miette::Result<Window> {
        let picture = Window::whole([settings.width, settings.height]);
        if let Some(crop) = self.crop {
            if picture.contains(&crop) {
                return Ok(crop);
            }
            return Err(miette!(
                help = format!(
                    "the picture has {}×{} pixels",
                    settings.width, settings.height
                ),
                "--crop: {crop} are not all within the picture"
            ));
        }
        let Some(Part { number, count }) = self.part else {
            return Ok(picture);
        };
        if count > settings.height {
            return Err(miette!(
                help = "ask for fewer parts",
                "--part: {count} parts of a picture of {} rows would have no rows",
                settings.height
            ));
        }
        let row =
            |part: u32| (u64::from(part) * u64::from(settings.height) / u64::from(count)) as u32;
        Ok(picture.rows(row(number - 1)..row(number)))
    }

    /// Reports options that cannot work together.
    pub(super) fn check(
        &self,
        settings: &RenderSettings,
        samples: Option<u32>,
    ) -> miette::Result<()> {
        let samples = self.goal(settings, samples).samples.max(1);
        let end = u64::from(self.samples_from) + u64::from(samples);
        let most = u64::from(limits::MAX_SAMPLES);
        if end > most {
            return Err(miette!(
                "--samples-from {}: with {samples} samples of each pixel there would be {end}, but at most {most} are possible",
                self.samples_from,
            ));
        }
        if let (Some(path), false) = (&self.checkpoint, self.resume)
            && path.exists()
        {
            return Err(miette!(
                help = "go on from it with --resume, or remove it",
                "--checkpoint {}: this file exists",
                path.display()
            ));
        }
        Ok(())
    }

    /// Whether anything needs all pixels at once.
    pub(super) fn needs_rounds(&self) -> bool {
        let ends_otherwise = self.time.is_some() || self.noise.is_some() || self.adaptive;
        ends_otherwise || self.preview_every.is_some() || self.checkpoint.is_some()
    }

    /// The shortest time between two things that are done between rounds.
    pub(super) fn shortest_interval(&self) -> Option<Duration> {
        let checkpoint = self.checkpoint.as_ref().map(|_| self.checkpoint_every);
        [self.preview_every, checkpoint].into_iter().flatten().min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_read() {
        assert_eq!(duration("90s"), Ok(Duration::from_secs(90)));
        assert_eq!(duration("10min"), Ok(Duration::from_mins(10)));
        assert!(
            ["90", "0s", "-1s", "soon"]
                .iter()
                .all(|text| duration(text).is_err())
        );
        assert_eq!((noise("2%"), noise("0.02")), (Ok(0.02), Ok(0.02)));
        assert!(
            ["0", "-1%", "200%", "NaN", "x"]
                .iter()
                .all(|text| noise(text).is_err())
        );
        assert_eq!(
            part("3/16"),
            Ok(Part {
                number: 3,
                count: 16
            })
        );
        assert_eq!(part("3/16").unwrap().file_name(), "03_of_16");
        assert!(
            ["0/4", "5/4", "1", "1/0", "a/b"]
                .iter()
                .all(|text| part(text).is_err())
        );
        assert_eq!(crop("1,2, 3,4").unwrap().to_string(), "3×4 pixels at 1,2");
        assert!(
            ["1,2,3", "1,2,0,4", "1,2,3,-4"]
                .iter()
                .all(|text| crop(text).is_err())
        );
        assert_eq!(fault("lost@2"), Ok((InjectedFault::Lost, 2)));
        assert!(fault("lost").is_err() && fault("x@1").is_err());
    }
}
