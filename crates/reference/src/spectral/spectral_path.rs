//! The spectrum of a path, updated as the path is traced.

use super::found::{Found, SpectralTransport};
use super::wavelengths::Wavelengths;
use crate::bands::{At, BandValue, Bands, Spectrum, Tables, Through};
use crate::bsdf::{Bsdf, Lobes};
use crate::layers::{FilmAt, Nanometers};
use crate::lifting::smooth_value;
use crate::transport::{Emitted, Scattering, Side, Transport};
use crate::{PreparedScene, Ray};
use optics::wide::{Lanes, Real};
use pulp::{Arch, Simd, WithSimd};
use scene::limits::MAX_LAYERS;
use scene::{EnvironmentPicture, PictureSpectra, RenderSettings};

/// The throughput of a path and the radiance that it has found.
pub(crate) struct SpectralPath<'a> {
    wavelengths: Wavelengths<'a>,
    throughput: Spectrum,
    /// Throughputs of the branches that wait, the one that was split off first in front.
    waiting: Vec<Spectrum>,
    waits: usize,
    /// Buffer for a product.
    product: Spectrum,
    /// Radiance of each light group.
    pub(super) radiance: Vec<Spectrum>,
    nm: Nanometers,
}

impl<'a> SpectralPath<'a> {
    /// Returns a path without light, for a number of light groups.
    pub(crate) fn new(arch: Arch, tables: &'a Tables, light_groups: usize) -> Self {
        let zero = Spectrum::zero(tables.chunks());
        let most = RenderSettings::MAX_FILM_SPLITS as usize;
        Self {
            wavelengths: Wavelengths::new(arch, tables),
            throughput: zero.clone(),
            waiting: vec![zero.clone(); most],
            waits: 0,
            product: zero.clone(),
            radiance: vec![zero; light_groups],
            nm: [0.0; MAX_LAYERS],
        }
    }

    /// Returns the throughput in each band.
    pub(crate) fn throughput(&self) -> &[f64] {
        &self.throughput.values()[..self.wavelengths.tables.bands()]
    }
}

impl<'a> SpectralTransport<'a> for SpectralPath<'a> {
    fn of_scene(arch: Arch, prepared: &'a PreparedScene<'a>) -> Self {
        let light_groups = prepared.scene.light_groups().len();
        Self::new(arch, &prepared.tables, light_groups)
    }

    fn found(&mut self) -> Found<'_, 'a> {
        Found {
            wavelengths: &self.wavelengths,
            radiance: &mut self.radiance,
            polarized: &mut [],
        }
    }
}

/// The value of a pixel of the environment.
impl BandValue for (&EnvironmentPicture, [u32; 2]) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let (picture, pixel) = *self;
        let texels = picture.texels.at(pixel);
        match picture.spectra {
            PictureSpectra::Bands => {
                let last = texels.len() - 1;
                bands.each(at, |band| f64::from(texels[(band / 4).min(last)][band % 4]))
            }
            PictureSpectra::Smooth => {
                let [c0, c1, c2, scale] = texels[0].map(f64::from);
                smooth_value([c0, c1, c2], bands.inverse_wavelength(at).recip()).times(scale)
            }
        }
    }
}

impl Transport for SpectralPath<'_> {
    fn begin(&mut self, offset: f64, _: &Ray) {
        self.wavelengths.begin(offset);
        self.waits = 0;
        self.throughput.fill(1.0);
        for radiance in &mut self.radiance {
            radiance.fill(0.0);
        }
    }

    fn split(&mut self, film: &FilmAt<'_>) {
        self.wavelengths.know();
        self.wavelengths.arch.dispatch(Split(self, film));
    }

    fn resume(&mut self) {
        self.waits -= 1;
        std::mem::swap(&mut self.throughput, &mut self.waiting[self.waits]);
    }

    fn film(&mut self, film: &FilmAt<'_>, side: Side) {
        self.wavelengths.know();
        self.wavelengths.arch.dispatch(Pass(self, film, side));
    }

    fn scatter(&mut self, at: &Scattering<'_>) {
        if at.bsdf.needs_wavelengths() {
            self.wavelengths.know();
        }
        self.wavelengths
            .arch
            .dispatch(Scatter(self, at.bsdf, &at.lobes));
    }

    fn emit(&mut self, light: &Emitted<'_>, weight: f64) {
        if light.pixel.is_some() {
            self.wavelengths.know();
        }
        self.wavelengths.arch.dispatch(Emit(self, light, weight));
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
        self.wavelengths.arch.dispatch(Connect {
            path: self,
            bsdf: at.bsdf,
            lobes: &at.lobes,
            light,
            weight,
            films,
        });
    }
}

struct Split<'b, 'a>(&'b mut SpectralPath<'a>, &'b FilmAt<'b>);

impl WithSimd for Split<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, film) = self;
        let bands = path.wavelengths.bands(simd);
        let both = Through::Both(&mut path.throughput, &mut path.waiting[path.waits]);
        film.pass(&bands, film.thickness_nm(&mut path.nm), both);
        path.waits += 1;
    }
}

struct Pass<'b, 'a>(&'b mut SpectralPath<'a>, &'b FilmAt<'b>, Side);

impl WithSimd for Pass<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, film, side) = self;
        let bands = path.wavelengths.bands(simd);
        let through = match side {
            Side::Reflected => Through::Reflected(&mut path.throughput),
            Side::Transmitted => Through::Transmitted(&mut path.throughput),
        };
        film.pass(&bands, film.thickness_nm(&mut path.nm), through);
    }
}

struct Scatter<'b, 'a>(&'b mut SpectralPath<'a>, &'b Bsdf<'b>, &'b Lobes);

impl WithSimd for Scatter<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, bsdf, lobes) = self;
        let bands = path.wavelengths.bands(simd);
        let nm = bsdf.thickness_nm(&mut path.nm);
        bsdf.product(&bands, (nm, *lobes), &path.throughput, &mut path.product);
        std::mem::swap(&mut path.throughput, &mut path.product);
    }
}

struct Emit<'b, 'a>(&'b mut SpectralPath<'a>, &'b Emitted<'b>, f64);

impl WithSimd for Emit<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(
            path,
            Emitted {
                emission, pixel, ..
            },
            weight,
        ) = self;
        let bands = path.wavelengths.bands(simd);
        let light = bands.emission(emission, weight);
        let radiance = &mut path.radiance[emission.light_group.index()];
        match pixel {
            None => bands.add_product(radiance, &path.throughput, &light),
            Some(pixel) => {
                bands.product(&path.throughput, pixel, &mut path.product);
                bands.add_product(radiance, &path.product, &light);
            }
        }
    }
}

struct Connect<'b, 'a> {
    path: &'b mut SpectralPath<'a>,
    bsdf: &'b Bsdf<'b>,
    lobes: &'b Lobes,
    light: &'b Emitted<'b>,
    weight: f64,
    films: &'b [FilmAt<'b>],
}

impl WithSimd for Connect<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { path, bsdf, .. } = self;
        let Emitted {
            emission, pixel, ..
        } = self.light;
        let bands = path.wavelengths.bands(simd);
        let product = &mut path.product;
        let nm = bsdf.thickness_nm(&mut path.nm);
        bsdf.product(&bands, (nm, *self.lobes), &path.throughput, product);
        for film in self.films {
            let nm = film.thickness_nm(&mut path.nm);
            film.pass(&bands, nm, Through::Transmitted(product));
        }
        if let Some(pixel) = pixel {
            bands.multiply(product, pixel);
        }
        let light = bands.emission(emission, self.weight);
        let radiance = &mut path.radiance[emission.light_group.index()];
        bands.add_product(radiance, product, &light);
    }
}
