//! Thin layers, free or on a surface, at a point of a path.

use crate::bands::{
    At, BandMueller, BandPowers, Bands, Knots, Mueller, Row, Spectrum, StoredMueller, Tables,
    Through,
};
use crate::{SurfacePoint, layer_thickness};
use glam::DVec3;
use optics::wide::{
    Index, Lanes, PolarizedPowers, Real, SCALED_AFTER, Sweep, clear_film_polarized,
    clear_film_reflectance, interface_polarized, interface_reflectance, two_beam_polarized,
    two_beam_powers,
};
use pulp::Simd;
use scene::limits::MAX_LAYERS;
use scene::{Interference, PathDifference, Shape, SpectrumId, Thickness};

/// Smaller cosines are not visible; the bound keeps a grazing ray finite.
pub(crate) const GRAZING: f64 = 1e-6;

/// A medium of index n + ik.
#[derive(Clone, Copy)]
pub(crate) struct Medium {
    n: Row,
    k: Row,
    /// Whether k is 0 in every band.
    is_clear: bool,
}

impl Medium {
    pub(crate) fn new(tables: &Tables, n: SpectrumId, k: SpectrumId) -> Self {
        let (n, k) = (n.into(), k.into());
        let is_clear = tables.extent(k) == (0.0, 0.0);
        Self { n, k, is_clear }
    }

    #[inline(always)]
    fn n<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        bands.spectrum(self.n, at)
    }

    /// Returns the reflectance for unpolarized light from air.
    #[inline(always)]
    pub(crate) fn reflectance<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        at: At,
        cosine: f64,
    ) -> Lanes<S> {
        let (n, k) = (self.n(bands, at), bands.spectrum(self.k, at));
        interface_reflectance(n, k, cosine.max(GRAZING))
    }

    /// Returns what is reflected of polarized light from air.
    #[inline(always)]
    pub(crate) fn polarized<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        at: At,
        cosine: f64,
    ) -> PolarizedPowers<Lanes<S>> {
        let (n, k) = (self.n(bands, at), bands.spectrum(self.k, at));
        interface_polarized(n, k, cosine.max(GRAZING))
    }

    #[inline(always)]
    fn index<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Index<Lanes<S>> {
        let (n, k) = (self.n(bands, at), bands.spectrum(self.k, at));
        Index::new(n, k, self.is_clear, bands.splat(1.0))
    }
}

/// The layers of a film or of a coating, the outermost first.
pub(crate) struct Layers<'a>(Vec<(Medium, &'a Thickness)>);

impl<'a> Layers<'a> {
    pub(crate) fn new(tables: &Tables, layers: &'a [scene::Layer]) -> Self {
        let layer =
            |layer: &'a scene::Layer| (Medium::new(tables, layer.n, layer.k), &layer.thickness);
        Self(layers.iter().map(layer).collect())
    }

    /// Writes the thicknesses at a point, nm, to the front of `nm` and returns them.
    pub(crate) fn thickness_nm<'b>(
        &self,
        surface: &SurfaceAt<'_>,
        nm: &'b mut Nanometers,
    ) -> &'b [f64] {
        for (nm, (_, thickness)) in nm.iter_mut().zip(&self.0) {
            *nm = layer_thickness(thickness, surface.shape, surface.position);
        }
        &nm[..self.0.len()]
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Writes the thicknesses, nm, to the front of `nm` and returns them, if they are the same everywhere.
    pub(crate) fn even_thickness_nm<'b>(&self, nm: &'b mut Nanometers) -> Option<&'b [f64]> {
        for (nm, (_, thickness)) in nm.iter_mut().zip(&self.0) {
            let Thickness::Constant { nm: even } = thickness else {
                return None;
            };
            *nm = *even;
        }
        Some(&nm[..self.0.len()])
    }

    /// Returns the sum of the layers' thicknesses times their largest index, nm.
    pub(crate) fn optical_thickness_nm(&self, tables: &Tables, nm: &[f64]) -> f64 {
        let layers = self.0.iter().zip(nm);
        let optical = |((medium, _), nm): (&(Medium, _), &f64)| tables.extent(medium.n).1 * nm;
        layers.map(optical).sum()
    }

    /// Returns the fields on top of the layers on a substrate, for light from air, or from behind for free layers (then in reverse order).
    #[inline(always)]
    fn sweep<S: Simd>(
        &self,
        (bands, at): (&Bands<'_, S>, At),
        nm: &[f64],
        substrate: &Index<Lanes<S>>,
        (cosine, from_behind): (f64, bool),
    ) -> Sweep<Lanes<S>> {
        let half_waves_per_nm = bands.inverse_wavelength(at).times(2.0);
        let cos2 = cosine * cosine;
        let q0_squared = bands.splat(cos2);
        let mut sweep = Sweep::new(&substrate.wave(q0_squared, cos2, half_waves_per_nm));
        let count = self.0.len();
        for step in 0..count {
            if step > 0 && step % SCALED_AFTER == 0 {
                sweep.rescale();
            }
            let layer = if from_behind { step } else { count - 1 - step };
            let index = self.0[layer].0.index(bands, at);
            let wave = index.wave(q0_squared, cos2, half_waves_per_nm);
            sweep.pass(&wave, bands.splat(nm[layer]));
        }
        sweep
    }

    /// Returns R_s, R_p, T_s and T_p on a substrate, with the arguments of [`Self::sweep`].
    #[inline(always)]
    fn powers<S: Simd>(
        &self,
        (bands, at): (&Bands<'_, S>, At),
        nm: &[f64],
        substrate: &Index<Lanes<S>>,
        met: (f64, bool),
    ) -> [Lanes<S>; 4] {
        let eta = bands.splat(met.0);
        self.sweep((bands, at), nm, substrate, met).powers(eta, eta)
    }

    /// Returns what is reflected and what is transmitted of polarized light, with the arguments of [`Self::sweep`].
    #[inline(always)]
    fn polarized<S: Simd>(
        &self,
        (bands, at): (&Bands<'_, S>, At),
        nm: &[f64],
        substrate: &Index<Lanes<S>>,
        met: (f64, bool),
    ) -> [PolarizedPowers<Lanes<S>>; 2] {
        let eta = bands.splat(met.0);
        self.sweep((bands, at), nm, substrate, met)
            .polarized(eta, eta)
    }
}

/// Thicknesses of the largest possible number of layers, nm.
pub(crate) type Nanometers = [f64; MAX_LAYERS];

/// The point where a path meets a surface.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceAt<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) position: DVec3,
}

/// A free film in air.
pub(crate) struct Film<'a> {
    layers: Layers<'a>,
    kind: FilmKind,
}

/// The formula by which a film is computed.
#[derive(Clone, Copy)]
enum FilmKind {
    /// One non-absorbing layer with n ≥ 1.
    Clear,
    /// One layer by the two-beam formula.
    TwoBeam(optics::PathDifference),
    /// Any layers.
    Stack,
}

impl<'a> Film<'a> {
    pub(crate) fn new(
        tables: &Tables,
        layers: &'a [scene::Layer],
        interference: Interference,
    ) -> Self {
        let layers = Layers::new(tables, layers);
        let kind = match (interference, &layers.0[..]) {
            (Interference::TwoBeam(PathDifference::Optical), _) => {
                FilmKind::TwoBeam(optics::PathDifference::Optical)
            }
            (Interference::TwoBeam(PathDifference::AsPrinted), _) => {
                FilmKind::TwoBeam(optics::PathDifference::AsPrinted)
            }
            (Interference::Exact, [(medium, _)])
                if medium.is_clear && tables.extent(medium.n).0 >= 1.0 =>
            {
                FilmKind::Clear
            }
            (Interference::Exact, _) => FilmKind::Stack,
        };
        Self { layers, kind }
    }

    /// Returns the film at the point where a path with this direction meets it.
    pub(crate) fn at(
        &'a self,
        shape: &'a Shape,
        point: &SurfacePoint,
        direction: DVec3,
    ) -> FilmAt<'a> {
        FilmAt {
            film: self,
            surface: SurfaceAt {
                shape,
                position: point.position,
            },
            cosine: point.cosine.max(GRAZING),
            is_front: point.is_front,
            direction,
            normal: point.normal,
        }
    }
}

/// A free film at the point where a path meets it.
#[derive(Clone, Copy)]
pub(crate) struct FilmAt<'a> {
    film: &'a Film<'a>,
    surface: SurfaceAt<'a>,
    cosine: f64,
    is_front: bool,
    /// The direction of the path that meets it, and the normal on the side that it comes from: unit vectors.
    pub(crate) direction: DVec3,
    pub(crate) normal: DVec3,
}

impl FilmAt<'_> {
    /// Writes the thicknesses of its layers, nm, to the front of `nm` and returns them.
    pub(crate) fn thickness_nm<'b>(&self, nm: &'b mut Nanometers) -> &'b [f64] {
        self.film.layers.thickness_nm(&self.surface, nm)
    }

    /// Multiplies each band by the film's reflectance or transmittance for unpolarized light, for layers of these thicknesses.
    #[inline(always)]
    pub(crate) fn pass<S: Simd>(&self, bands: &Bands<'_, S>, nm: &[f64], through: Through<'_>) {
        let layers = &self.film.layers;
        let one = || (bands.knots(layers.0[0].0.n), 2.0 * nm[0]);
        match self.film.kind {
            FilmKind::Clear => {
                let (n, twice_nm) = one();
                let cos2 = self.cosine * self.cosine;
                bands.pass(&ClearFilm { n, twice_nm, cos2 }, through);
            }
            FilmKind::TwoBeam(path) => {
                let ((n, twice_nm), cosine) = (one(), self.cosine);
                let film = TwoBeamFilm {
                    n,
                    twice_nm,
                    cosine,
                    path,
                };
                bands.pass(&film, through);
            }
            FilmKind::Stack => bands.pass(&(self, nm), through),
        }
    }
}

/// The matrices of a film in each band, from the powers of reflected and transmitted light.
trait BandPolarized {
    fn polarized<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> [PolarizedPowers<Lanes<S>>; 2];
}

/// The matrix of the reflected light, or of the transmitted light.
struct OneOf<'a, T>(&'a T, usize);

impl<T: BandPolarized> BandMueller for OneOf<'_, T> {
    #[inline(always)]
    fn mueller<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Mueller<Lanes<S>> {
        Mueller::of(&self.0.polarized(bands, at)[self.1], 1.0)
    }
}

impl FilmAt<'_> {
    /// Writes the matrices of reflected and transmitted light for layers of these thicknesses, where they are wanted.
    #[inline(always)]
    pub(crate) fn mueller<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        nm: &[f64],
        to: [Option<StoredMueller>; 2],
        rows: &mut [Spectrum],
    ) {
        let layers = &self.film.layers;
        let one = || (bands.knots(layers.0[0].0.n), 2.0 * nm[0]);
        match self.film.kind {
            FilmKind::Clear => {
                let (n, twice_nm) = one();
                let cos2 = self.cosine * self.cosine;
                write_both(bands, &ClearFilm { n, twice_nm, cos2 }, to, rows);
            }
            FilmKind::TwoBeam(path) => {
                let ((n, twice_nm), cosine) = (one(), self.cosine);
                let film = TwoBeamFilm {
                    n,
                    twice_nm,
                    cosine,
                    path,
                };
                write_both(bands, &film, to, rows);
            }
            FilmKind::Stack => write_both(bands, &(self, nm), to, rows),
        }
    }
}

/// Writes the matrices of a film. A film that splits the path computes both at once.
#[inline(always)]
fn write_both<S: Simd>(
    bands: &Bands<'_, S>,
    film: &impl BandPolarized,
    to: [Option<StoredMueller>; 2],
    rows: &mut [Spectrum],
) {
    if let [Some(reflected), Some(transmitted)] = to {
        for at in bands.registers() {
            let [r, t] = film.polarized(bands, at);
            reflected.store((bands, at), rows, &Mueller::of(&r, 1.0));
            transmitted.store((bands, at), rows, &Mueller::of(&t, 1.0));
        }
        return;
    }
    for (side, to) in to.into_iter().enumerate() {
        if let Some(to) = to {
            bands.write_mueller(&OneOf(film, side), to, rows);
        }
    }
}

/// A clear film of one layer.
struct ClearFilm<'a> {
    n: Knots<'a>,
    twice_nm: f64,
    cos2: f64,
}

impl BandPowers for ClearFilm<'_> {
    #[inline(always)]
    fn powers<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> (Lanes<S>, Lanes<S>) {
        let n = self.n.value(bands, at);
        let inverse_wavelength = bands.inverse_wavelength(at);
        let r = clear_film_reflectance(n, self.twice_nm, inverse_wavelength, self.cos2);
        (r, r.complement())
    }
}

impl BandPolarized for ClearFilm<'_> {
    #[inline(always)]
    fn polarized<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> [PolarizedPowers<Lanes<S>>; 2] {
        let n = self.n.value(bands, at);
        let inverse_wavelength = bands.inverse_wavelength(at);
        clear_film_polarized(n, self.twice_nm, inverse_wavelength, self.cos2)
    }
}

/// A film of one layer by the two-beam formula.
struct TwoBeamFilm<'a> {
    n: Knots<'a>,
    twice_nm: f64,
    cosine: f64,
    path: optics::PathDifference,
}

impl BandPowers for TwoBeamFilm<'_> {
    #[inline(always)]
    fn powers<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> (Lanes<S>, Lanes<S>) {
        let n = self.n.value(bands, at);
        let inverse_wavelength = bands.inverse_wavelength(at);
        two_beam_powers(n, self.twice_nm, inverse_wavelength, self.cosine, self.path)
    }
}

impl BandPolarized for TwoBeamFilm<'_> {
    #[inline(always)]
    fn polarized<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> [PolarizedPowers<Lanes<S>>; 2] {
        let n = self.n.value(bands, at);
        let inverse_wavelength = bands.inverse_wavelength(at);
        two_beam_polarized(n, self.twice_nm, inverse_wavelength, self.cosine, self.path)
    }
}

impl BandPolarized for (&FilmAt<'_>, &[f64]) {
    #[inline(always)]
    fn polarized<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> [PolarizedPowers<Lanes<S>>; 2] {
        let (film, nm) = self;
        let (zero, one) = (bands.splat(0.0), bands.splat(1.0));
        let air = Index::new(one, zero, true, one);
        let met = (film.cosine, !film.is_front);
        film.film.layers.polarized((bands, at), nm, &air, met)
    }
}

/// A film of any layers, and their thicknesses.
impl BandPowers for (&FilmAt<'_>, &[f64]) {
    #[inline(always)]
    fn powers<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> (Lanes<S>, Lanes<S>) {
        let (film, nm) = self;
        let (zero, one) = (bands.splat(0.0), bands.splat(1.0));
        let air = Index::new(one, zero, true, one);
        let met = (film.cosine, !film.is_front);
        let [r_s, r_p, t_s, t_p] = film.film.layers.powers((bands, at), nm, &air, met);
        ((r_s + r_p).times(0.5), (t_s + t_p).times(0.5))
    }
}

/// The boundary between air and an opaque medium, bare or coated.
pub(crate) struct Coating<'a> {
    pub(crate) medium: Medium,
    pub(crate) layers: Layers<'a>,
}

impl Coating<'_> {
    /// Returns the reflectance for unpolarized light at a cosine; `nm` are the thicknesses of the layers.
    #[inline(always)]
    pub(crate) fn reflectance<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        at: At,
        (nm, cosine): (&[f64], f64),
    ) -> Lanes<S> {
        if self.layers.0.is_empty() {
            return self.medium.reflectance(bands, at, cosine);
        }
        let cosine = cosine.max(GRAZING);
        let substrate = self.medium.index(bands, at);
        let met = (cosine, false);
        let [s, p, ..] = self.layers.powers((bands, at), nm, &substrate, met);
        (s + p).times(0.5)
    }

    /// Returns what is reflected of polarized light at a cosine; `nm` are the thicknesses of the layers.
    #[inline(always)]
    pub(crate) fn polarized<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        at: At,
        (nm, cosine): (&[f64], f64),
    ) -> PolarizedPowers<Lanes<S>> {
        if self.layers.0.is_empty() {
            return self.medium.polarized(bands, at, cosine);
        }
        let substrate = self.medium.index(bands, at);
        let met = (cosine.max(GRAZING), false);
        let [reflected, _] = self.layers.polarized((bands, at), nm, &substrate, met);
        reflected
    }
}
