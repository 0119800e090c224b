//! The polarized light of a path: recorded as the path is traced, and evaluated when it is asked for.

use super::events::{Event, Record};
use super::found::{Found, SpectralTransport};
use super::wavelengths::Wavelengths;
use crate::bands::{At, Bands, MuellerKind, Spectrum, StoredMueller};
use crate::layers::{FilmAt, Nanometers};
use crate::polarization::{Turn, axis_across, emitted_stokes};
use crate::transport::{Emitted, Scattering, Side, Transport};
use crate::{PreparedScene, Ray};
use glam::DVec3;
use optics::wide::{Lanes, Real, sin_cos_half_turns};
use pulp::{Arch, Simd, WithSimd};
use scene::limits::MAX_LAYERS;
use spectra::stokes::{Analyzer, Polarizer};

/// A path of polarized light.
pub(crate) struct StokesPath<'a> {
    wavelengths: Wavelengths<'a>,
    record: Record,
    /// The reference axis of light on the current segment, toward the camera.
    axis: DVec3,
    /// The axes where branches wait.
    waiting: Vec<DVec3>,
    /// What stands in front of the camera.
    analyzer: Option<Analyzer>,
    /// Vertical in the picture.
    up: DVec3,
    nm: Nanometers,
    radiance: Vec<Spectrum>,
    polarized: Vec<[Spectrum; 3]>,
}

impl<'a> SpectralTransport<'a> for StokesPath<'a> {
    fn of_scene(arch: Arch, prepared: &'a PreparedScene<'a>) -> Self {
        let (scene, tables) = (prepared.scene, &prepared.tables);
        let zero = Spectrum::zero(tables.chunks());
        let groups = scene.light_groups().len();
        let kept = if scene.content().is_polarized {
            groups
        } else {
            0
        };
        Self {
            wavelengths: Wavelengths::new(arch, tables),
            record: Record::new(tables.chunks()),
            axis: DVec3::X,
            waiting: Vec::new(),
            analyzer: scene.camera().polarizer.as_ref().map(Polarizer::analyzer),
            up: scene.camera().up,
            nm: [0.0; MAX_LAYERS],
            radiance: vec![zero.clone(); groups],
            polarized: vec![std::array::from_fn(|_| zero.clone()); kept],
        }
    }

    fn found(&mut self) -> Found<'_, 'a> {
        if self.analyzer.is_some_and(|of| of.path_nm.is_some()) {
            self.wavelengths.know();
        }
        let arch = self.wavelengths.arch;
        arch.dispatch(Evaluate(self));
        Found {
            wavelengths: &self.wavelengths,
            radiance: &mut self.radiance,
            polarized: &mut self.polarized,
        }
    }
}

impl StokesPath<'_> {
    /// Returns new spectra for a matrix.
    fn take(&mut self, kind: MuellerKind) -> StoredMueller {
        let first = self.record.take(kind.rows());
        StoredMueller { kind, first }
    }

    /// Turns the axis of the current segment to one across it and another direction, and returns the turn back.
    fn turn_to(&mut self, axis: DVec3, wo: DVec3) -> Turn {
        let turn = Turn::between(axis, self.axis, wo);
        self.axis = axis;
        turn
    }

    /// Makes a Stokes vector, in four spectra from `first` on, of the radiance of an emitter, and takes it through the films on its way to a
    /// surface, where it refers to an axis.
    fn arrive(
        &mut self,
        first: usize,
        light: &Emitted<'_>,
        films: &[FilmAt<'_>],
        at_surface: DVec3,
    ) {
        let arch = self.wavelengths.arch;
        // The axes of the segments: beside the surface, and behind each film.
        let axis_of = |film: &FilmAt<'_>| axis_across(film.direction, film.normal);
        let last = films.last().map_or(at_surface, axis_of);
        let of = light.emission.polarization.as_ref();
        let stokes = of.map_or([0.0; 3], |of| emitted_stokes(of, light.toward, last));
        arch.dispatch(Spread(self, first, stokes));
        for (i, film) in films.iter().enumerate().rev() {
            let before = i.checked_sub(1).map_or(at_surface, |i| axis_of(&films[i]));
            let turn = Turn::between(axis_of(film), before, -film.direction);
            if let [_, Some(transmitted)] = self.film_matrices(film, false, true) {
                arch.dispatch(Apply(self, transmitted, turn, first));
                self.record.give_back(transmitted.first);
            }
        }
    }

    /// Computes the matrices of a film: for the reflected and for the transmitted light.
    fn film_matrices(
        &mut self,
        film: &FilmAt<'_>,
        reflects: bool,
        transmits: bool,
    ) -> [Option<StoredMueller>; 2] {
        self.wavelengths.know();
        let wanted = [reflects, transmits];
        let matrices = wanted.map(|wanted| wanted.then(|| self.take(MuellerKind::Amplitudes)));
        let arch = self.wavelengths.arch;
        arch.dispatch(FilmMatrices {
            path: self,
            film,
            to: matrices,
        });
        matrices
    }
}

impl Transport for StokesPath<'_> {
    fn begin(&mut self, offset: f64, ray: &Ray) {
        self.wavelengths.begin(offset);
        self.record.begin();
        self.waiting.clear();
        self.axis = axis_across(ray.direction, self.up);
    }

    fn split(&mut self, film: &FilmAt<'_>) {
        if let [Some(reflected), Some(transmitted)] = self.film_matrices(film, true, true) {
            let axis = axis_across(film.direction, film.normal);
            let turn = self.turn_to(axis, -film.direction);
            self.waiting.push(axis);
            self.record.events.push(Event::Splits {
                reflected,
                transmitted,
                turn,
            });
        }
    }

    fn resume(&mut self) {
        if let Some(axis) = self.waiting.pop() {
            self.axis = axis;
            self.record.events.push(Event::Resumes);
        }
    }

    fn film(&mut self, film: &FilmAt<'_>, side: Side) {
        let is_reflected = side == Side::Reflected;
        let [reflected, transmitted] = self.film_matrices(film, is_reflected, !is_reflected);
        if let Some(matrix) = reflected.or(transmitted) {
            let axis = axis_across(film.direction, film.normal);
            let turn = self.turn_to(axis, -film.direction);
            self.record.events.push(Event::Meets { matrix, turn });
        }
    }

    fn scatter(&mut self, at: &Scattering<'_>) {
        if at.bsdf.needs_wavelengths() {
            self.wavelengths.know();
        }
        let matrix = self.take(at.bsdf.mueller_kind(&at.lobes));
        let arch = self.wavelengths.arch;
        arch.dispatch(Matrix(self, at, matrix));
        let [toward_camera, toward_light] = at.axes();
        let turn = self.turn_to(toward_camera, at.wo);
        self.axis = toward_light;
        self.record.events.push(Event::Meets { matrix, turn });
    }

    fn emit(&mut self, light: &Emitted<'_>, weight: f64) {
        if light.pixel.is_some() {
            self.wavelengths.know();
        }
        let radiance = self.record.take(1);
        let arch = self.wavelengths.arch;
        arch.dispatch(Shine(self, light, weight, radiance));
        let of = light.emission.polarization.as_ref();
        self.record.events.push(Event::Shines {
            light_group: light.emission.light_group.index(),
            radiance,
            stokes: of.map(|of| emitted_stokes(of, light.toward, self.axis)),
        });
    }

    fn connect(
        &mut self,
        at: &Scattering<'_>,
        light: &Emitted<'_>,
        weight: f64,
        films: &[FilmAt<'_>],
    ) {
        if at.bsdf.needs_wavelengths() || light.pixel.is_some() || !films.is_empty() {
            self.wavelengths.know();
        }
        let first = self.record.take(4);
        let matrix = self.take(at.bsdf.mueller_kind(&at.lobes));
        let light_group = light.emission.light_group.index();
        let arch = self.wavelengths.arch;
        arch.dispatch(Shine(self, light, weight, first));
        arch.dispatch(Matrix(self, at, matrix));
        let [toward_camera, toward_light] = at.axes();
        if matrix.kind != MuellerKind::Depolarizer || !films.is_empty() {
            self.arrive(first, light, films, toward_light);
        }
        if matrix.kind == MuellerKind::Depolarizer {
            // S0 alone counts, and what leaves is unpolarized.
            arch.dispatch(Dim(self, matrix.first, first));
            self.record.give_back(first + 1);
            self.record.events.push(Event::Shines {
                light_group,
                radiance: first,
                stokes: None,
            });
            return;
        }
        arch.dispatch(Apply(self, matrix, Turn::NONE, first));
        self.record.give_back(matrix.first);
        self.record.events.push(Event::Joins {
            light_group,
            first,
            turn: Turn::between(toward_camera, self.axis, at.wo),
        });
    }
}

/// Computes the matrices of a film.
struct FilmMatrices<'b, 'a> {
    path: &'b mut StokesPath<'a>,
    film: &'b FilmAt<'b>,
    /// For the reflected and for the transmitted light.
    to: [Option<StoredMueller>; 2],
}

impl WithSimd for FilmMatrices<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { path, film, to } = self;
        let bands = path.wavelengths.bands(simd);
        let nm = film.thickness_nm(&mut path.nm);
        film.mueller(&bands, nm, to, &mut path.record.spectra);
    }
}

/// Computes the matrix of a surface.
struct Matrix<'b, 'a>(&'b mut StokesPath<'a>, &'b Scattering<'b>, StoredMueller);

impl WithSimd for Matrix<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, at, to) = self;
        let bands = path.wavelengths.bands(simd);
        let nm = at.bsdf.thickness_nm(&mut path.nm);
        at.bsdf
            .mueller(&bands, (nm, at.lobes), to, &mut path.record.spectra);
    }
}

/// Computes the radiance of an emitter.
struct Shine<'b, 'a>(&'b mut StokesPath<'a>, &'b Emitted<'b>, f64, usize);

impl WithSimd for Shine<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, light, weight, to) = self;
        let bands = path.wavelengths.bands(simd);
        let emission = bands.emission(&light.emission, weight);
        let radiance = &mut path.record.spectra[to];
        bands.write(&emission, radiance);
        if let Some(pixel) = &light.pixel {
            bands.multiply(radiance, pixel);
        }
    }
}

/// Multiplies a radiance by a value for each band.
struct Dim<'b, 'a>(&'b mut StokesPath<'a>, usize, usize);

impl WithSimd for Dim<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, by, radiance) = self;
        let bands = path.wavelengths.bands(simd);
        let spectra = &mut path.record.spectra;
        for at in bands.registers() {
            let product = bands.load(at, &spectra[radiance]) * bands.load(at, &spectra[by]);
            bands.store(at, product, &mut spectra[radiance]);
        }
    }
}

/// Writes S1, S2 and S3 of light behind its radiance.
struct Spread<'b, 'a>(&'b mut StokesPath<'a>, usize, [f64; 3]);

impl WithSimd for Spread<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, first, stokes) = self;
        let bands = path.wavelengths.bands(simd);
        let spectra = &mut path.record.spectra;
        for at in bands.registers() {
            let radiance = bands.load(at, &spectra[first]);
            for (i, part) in stokes.into_iter().enumerate() {
                bands.store(at, radiance.times(part), &mut spectra[first + 1 + i]);
            }
        }
    }
}

/// Multiplies light by a matrix, and turns its axis.
struct Apply<'b, 'a>(&'b mut StokesPath<'a>, StoredMueller, Turn, usize);

impl WithSimd for Apply<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, matrix, turn, first) = self;
        let bands = path.wavelengths.bands(simd);
        let spectra = &mut path.record.spectra;
        for at in bands.registers() {
            let light = bands.load_four(at, &spectra[first..]);
            let light = bands.turned(turn, matrix.apply((&bands, at), spectra, light));
            for (i, component) in light.into_iter().enumerate() {
                bands.store(at, component, &mut spectra[first + i]);
            }
        }
    }
}

/// Evaluates the record.
struct Evaluate<'b, 'a>(&'b mut StokesPath<'a>);

impl WithSimd for Evaluate<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path) = self;
        let bands = path.wavelengths.bands(simd);
        for (group, radiance) in path.radiance.iter_mut().enumerate() {
            if !path.record.has_light(group) {
                radiance.fill(0.0);
                if let Some(polarized) = path.polarized.get_mut(group) {
                    for of in polarized {
                        of.fill(0.0);
                    }
                }
                continue;
            }
            for at in bands.registers() {
                let light = path.record.arriving((&bands, at), group);
                if let Some(analyzer) = &path.analyzer {
                    bands.store(at, transmitted(&bands, at, analyzer, light), radiance);
                    continue;
                }
                bands.store(at, light[0], radiance);
                if let Some(polarized) = path.polarized.get_mut(group) {
                    for (to, component) in polarized.iter_mut().zip(&light[1..]) {
                        bands.store(at, *component, to);
                    }
                }
            }
        }
    }
}

/// Returns the radiance that passes the polarizer in front of the camera.
#[inline(always)]
fn transmitted<S: Simd>(
    bands: &Bands<'_, S>,
    at: At,
    analyzer: &Analyzer,
    [s0, s1, s2, s3]: [Lanes<S>; 4],
) -> Lanes<S> {
    let [w1, w2, w3] = match analyzer.path_nm {
        None => {
            let [w1, w2, w3] = analyzer.constant;
            [bands.splat(w1), bands.splat(w2), bands.splat(w3)]
        }
        Some(nm) => {
            // Of half the phase, both perhaps with the opposite sign.
            let (half_sin, half_cos) = sin_cos_half_turns(bands.inverse_wavelength(at).times(nm));
            let sin = (half_sin * half_cos).times(2.0);
            let cos = (half_sin * half_sin).times(2.0).complement();
            [
                weight(bands, analyzer, 0, (sin, cos)),
                weight(bands, analyzer, 1, (sin, cos)),
                weight(bands, analyzer, 2, (sin, cos)),
            ]
        }
    };
    let sum = w1.mul_add(s1, w2.mul_add(s2, w3.mul_add(s3, s0)));
    sum.times(0.5)
}

/// Returns the weight of a component for the sine and cosine of a phase.
#[inline(always)]
fn weight<S: Simd>(
    bands: &Bands<'_, S>,
    analyzer: &Analyzer,
    component: usize,
    (sin, cos): (Lanes<S>, Lanes<S>),
) -> Lanes<S> {
    let fixed = bands.splat(analyzer.constant[component]);
    let fixed = cos.mul_add(bands.splat(analyzer.cosine[component]), fixed);
    sin.mul_add(bands.splat(analyzer.sine[component]), fixed)
}
