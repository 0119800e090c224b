//! What happened along a path of polarized light, from the camera on.

use crate::bands::{At, Bands, Spectrum, StoredMueller};
use crate::polarization::Turn;
use optics::wide::{Lanes, Real};
use pulp::Simd;
use scene::RenderSettings;

/// An event of a path. Numbers of spectra are indices in [`Record::spectra`].
#[derive(Clone, Copy, Debug)]
pub(super) enum Event {
    /// The light meets a film or a surface. Its axis then turns to that of the segment toward the camera.
    Meets { matrix: StoredMueller, turn: Turn },
    /// A film splits the path: the reflected light follows, the transmitted light where the path resumes.
    Splits {
        reflected: StoredMueller,
        transmitted: StoredMueller,
        turn: Turn,
    },
    /// The path goes on with the branch that was split off last.
    Resumes,
    /// Light of an emitter joins: its radiance, and S1, S2 and S3 over S0 about the axis of the segment toward the camera.
    Shines {
        light_group: usize,
        radiance: usize,
        stokes: Option<[f64; 3]>,
    },
    /// Light of an emitter joins: the first of four spectra, S0 to S3, about the axis that then turns to that of the segment toward the camera.
    Joins {
        light_group: usize,
        first: usize,
        turn: Turn,
    },
}

/// A path of polarized light.
#[derive(Debug)]
pub(super) struct Record {
    pub(super) events: Vec<Event>,
    /// Matrices and light, in the order of the events; those of earlier, longer paths behind `used`.
    pub(super) spectra: Vec<Spectrum>,
    used: usize,
    chunks: usize,
}

impl Record {
    pub(super) fn new(chunks: usize) -> Self {
        Self {
            events: Vec::new(),
            spectra: Vec::new(),
            used: 0,
            chunks,
        }
    }

    pub(super) fn begin(&mut self) {
        self.events.clear();
        self.used = 0;
    }

    /// Returns the first of some new spectra, with any values.
    pub(super) fn take(&mut self, count: usize) -> usize {
        let first = self.used;
        self.used += count;
        while self.spectra.len() < self.used {
            self.spectra.push(Spectrum::zero(self.chunks));
        }
        first
    }

    /// Gives back the spectra from one on.
    pub(super) fn give_back(&mut self, from: usize) {
        self.used = from;
    }

    /// Whether the path has found light of a group.
    pub(super) fn has_light(&self, group: usize) -> bool {
        self.events.iter().any(|event| match *event {
            Event::Shines { light_group, .. } | Event::Joins { light_group, .. } => {
                light_group == group
            }
            _ => false,
        })
    }

    /// Returns the Stokes vector of the light of a group that reaches the camera, in some bands. The path is followed as light goes, from its
    /// end to the camera, so that a vector is carried and not a matrix.
    #[inline(always)]
    pub(super) fn arriving<S: Simd>(
        &self,
        (bands, at): (&Bands<'_, S>, At),
        group: usize,
    ) -> [Lanes<S>; 4] {
        const MOST: usize = RenderSettings::MAX_FILM_SPLITS as usize;
        let dark = [bands.splat(0.0); 4];
        let mut light = dark;
        let mut waiting = [dark; MOST];
        let mut waits = 0;
        for event in self.events.iter().rev() {
            match *event {
                Event::Meets { matrix, turn } => {
                    light = bands.turned(turn, matrix.apply((bands, at), &self.spectra, light));
                }
                Event::Splits {
                    reflected,
                    transmitted,
                    turn,
                } => {
                    waits -= 1;
                    let through = transmitted.apply((bands, at), &self.spectra, waiting[waits]);
                    let mirrored = reflected.apply((bands, at), &self.spectra, light);
                    light = bands.turned(turn, sum(mirrored, through));
                }
                Event::Resumes => {
                    waiting[waits] = light;
                    waits += 1;
                    light = dark;
                }
                Event::Shines {
                    light_group,
                    radiance,
                    stokes,
                } if light_group == group => {
                    let radiance = bands.load(at, &self.spectra[radiance]);
                    light[0] = light[0] + radiance;
                    if let Some([s1, s2, s3]) = stokes {
                        light[1] = radiance.mul_add(bands.splat(s1), light[1]);
                        light[2] = radiance.mul_add(bands.splat(s2), light[2]);
                        light[3] = radiance.mul_add(bands.splat(s3), light[3]);
                    }
                }
                Event::Joins {
                    light_group,
                    first,
                    turn,
                } if light_group == group => {
                    let own = bands.load_four(at, &self.spectra[first..]);
                    let own = bands.turned(turn, own);
                    light = sum(light, own);
                }
                Event::Shines { .. } | Event::Joins { .. } => {}
            }
        }
        light
    }
}

#[inline(always)]
fn sum<T: Real>([a0, a1, a2, a3]: [T; 4], [b0, b1, b2, b3]: [T; 4]) -> [T; 4] {
    [a0 + b0, a1 + b1, a2 + b2, a3 + b3]
}
