//! The spectrum of a path, updated as the path is traced.

use crate::bands::{At, BandValue, Bands, Spectrum, Tables, Through};
use crate::bsdf::{Bsdf, Lobes};
use crate::layers::{FilmAt, Nanometers};
use crate::lifting::smooth_value;
use crate::transport::{Emitted, Side, Transport};
use optics::wide::{Lanes, Real};
use pulp::{Arch, Simd, WithSimd};
use scene::limits::MAX_LAYERS;
use scene::{EnvironmentPicture, PictureSpectra, RenderSettings};

/// The throughput of a path and the radiance that it has found.
pub(crate) struct SpectralPath<'a> {
    arch: Arch,
    tables: &'a Tables,
    /// Position of the wavelengths in their bands, in [0, 1).
    offset: f64,
    place: (usize, f64),
    /// 1/λ, where it has been needed.
    inverse_wavelength: Spectrum,
    knows_wavelengths: bool,
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
            arch,
            tables,
            offset: 0.0,
            place: (0, 0.0),
            inverse_wavelength: zero.clone(),
            knows_wavelengths: false,
            throughput: zero.clone(),
            waiting: vec![zero.clone(); most],
            waits: 0,
            product: zero.clone(),
            radiance: vec![zero; light_groups],
            nm: [0.0; MAX_LAYERS],
        }
    }

    /// Returns the position of the wavelengths in their bands, in [0, 1).
    pub(crate) fn offset(&self) -> f64 {
        self.offset
    }

    #[inline(always)]
    pub(super) fn bands<S: Simd>(&self, simd: S) -> Bands<'_, S> {
        Bands::new(simd, self.tables, self.place, &self.inverse_wavelength)
    }

    /// Returns the radiance of each light group in the bands: `[light group][band]`.
    pub(crate) fn radiance(&self) -> impl Iterator<Item = &[f64]> {
        let bands = self.tables.bands();
        self.radiance.iter().map(move |of| &of.values()[..bands])
    }

    /// Returns the throughput in each band.
    pub(crate) fn throughput(&self) -> &[f64] {
        &self.throughput.values()[..self.tables.bands()]
    }

    fn know_wavelengths(&mut self) {
        if !self.knows_wavelengths {
            self.arch.dispatch(Wavelengths(self));
            self.knows_wavelengths = true;
        }
    }

    /// Scales down a path that is brighter than `most` in a band.
    pub(crate) fn dim(&mut self, most: f64) {
        let of_band = |band: usize| self.radiance().map(|group| group[band]).sum::<f64>();
        let brightest = (0..self.tables.bands()).map(of_band).fold(most, f64::max);
        for value in self.radiance.iter_mut().flat_map(Spectrum::values_mut) {
            *value *= most / brightest;
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
    fn begin(&mut self, offset: f64) {
        self.offset = offset;
        self.place = self.tables.place(offset);
        self.waits = 0;
        self.throughput.fill(1.0);
        for radiance in &mut self.radiance {
            radiance.fill(0.0);
        }
        self.knows_wavelengths = false;
    }

    fn split(&mut self, film: &FilmAt<'_>) {
        self.know_wavelengths();
        self.arch.dispatch(Split(self, film));
    }

    fn resume(&mut self) {
        self.waits -= 1;
        std::mem::swap(&mut self.throughput, &mut self.waiting[self.waits]);
    }

    fn film(&mut self, film: &FilmAt<'_>, side: Side) {
        self.know_wavelengths();
        self.arch.dispatch(Pass(self, film, side));
    }

    fn scatter(&mut self, bsdf: &Bsdf<'_>, lobes: &Lobes) {
        if bsdf.needs_wavelengths() {
            self.know_wavelengths();
        }
        self.arch.dispatch(Scatter(self, bsdf, lobes));
    }

    fn emit(&mut self, light: &Emitted<'_>, weight: f64) {
        if light.pixel.is_some() {
            self.know_wavelengths();
        }
        self.arch.dispatch(Emit(self, light, weight));
    }

    fn connect(
        &mut self,
        (bsdf, lobes): (&Bsdf<'_>, &Lobes),
        light: &Emitted<'_>,
        weight: f64,
        films: &[FilmAt<'_>],
    ) {
        if bsdf.needs_wavelengths() || light.pixel.is_some() || !films.is_empty() {
            self.know_wavelengths();
        }
        self.arch.dispatch(Connect {
            path: self,
            bsdf,
            lobes,
            light,
            weight,
            films,
        });
    }
}

struct Wavelengths<'b, 'a>(&'b mut SpectralPath<'a>);

impl WithSimd for Wavelengths<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path) = self;
        let grid = path.tables.grid();
        let [offset, width, first_nm] =
            [path.offset, grid.width_nm(), grid.min_nm()].map(|number| Lanes::splat(simd, number));
        for chunk in 0..path.inverse_wavelength.0.len() {
            for at in At::lanes::<S>(chunk) {
                let nm = (at.band(simd) + offset).mul_add(width, first_nm);
                at.store(nm.recip(), &mut path.inverse_wavelength.0);
            }
        }
    }
}

struct Split<'b, 'a>(&'b mut SpectralPath<'a>, &'b FilmAt<'b>);

impl WithSimd for Split<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(path, film) = self;
        let bands = Bands::new(simd, path.tables, path.place, &path.inverse_wavelength);
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
        let bands = Bands::new(simd, path.tables, path.place, &path.inverse_wavelength);
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
        let bands = Bands::new(simd, path.tables, path.place, &path.inverse_wavelength);
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
        let Self(path, Emitted { emission, pixel }, weight) = self;
        let bands = Bands::new(simd, path.tables, path.place, &path.inverse_wavelength);
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
        let Emitted { emission, pixel } = self.light;
        let bands = Bands::new(simd, path.tables, path.place, &path.inverse_wavelength);
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
