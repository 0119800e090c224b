//! The scanlines of a Radiance picture: flat, with repeated pixels (the old encoding), or with runs in each component (the new one).

use super::RadianceError;
use super::header::Layout;

/// The lengths of scanlines that may have runs in each component.
const WITH_RUNS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// A scanline's index, from 0, and its pixels.
type Scanline<'a> = (u32, &'a [[u8; 4]]);

/// Reads the scanlines one by one.
pub(super) struct Scanlines<'a> {
    data: &'a [u8],
    /// The next scanline, from 0, and the number of scanlines.
    next: u32,
    count: u32,
    pixels: Vec<[u8; 4]>,
}

/// What is wrong with a scanline.
enum Fault {
    CutShort,
    Damaged(&'static str),
}

impl<'a> Scanlines<'a> {
    pub(super) fn new(data: &'a [u8], layout: &Layout) -> Self {
        let [count, length] = layout.scanlines();
        Self {
            data,
            next: 0,
            count,
            pixels: vec![[0; 4]; length as usize],
        }
    }

    /// Returns the next scanline with its index from 0; `None` after the last.
    pub(super) fn next(&mut self) -> Result<Option<Scanline<'_>>, RadianceError> {
        if self.next == self.count {
            return Ok(None);
        }
        let (scanline, of) = (self.next + 1, self.count);
        read(&mut self.data, &mut self.pixels).map_err(|fault| match fault {
            Fault::CutShort => RadianceError::CutShort { scanline, of },
            Fault::Damaged(problem) => RadianceError::Damaged {
                scanline,
                of,
                problem,
            },
        })?;
        self.next = scanline;
        Ok(Some((scanline - 1, &self.pixels)))
    }
}

fn take<const N: usize>(data: &mut &[u8]) -> Result<[u8; N], Fault> {
    let (taken, rest) = data.split_first_chunk::<N>().ok_or(Fault::CutShort)?;
    *data = rest;
    Ok(*taken)
}

fn read(data: &mut &[u8], pixels: &mut [[u8; 4]]) -> Result<(), Fault> {
    let length = pixels.len();
    match *data {
        // As a pixel these bytes would be a dark color that is not normalized: its exponent could be smaller.
        [2, 2, high @ 0..0x80, low, rest @ ..] if WITH_RUNS.contains(&length) => {
            if usize::from(*high) << 8 | usize::from(*low) != length {
                return Err(Fault::Damaged("says that it has another length"));
            }
            *data = rest;
            (0..4).try_for_each(|component| read_component(data, pixels, component))
        }
        _ => read_pixels(data, pixels),
    }
}

/// Reads a component: runs of one value, and sequences of different values.
fn read_component(data: &mut &[u8], pixels: &mut [[u8; 4]], component: usize) -> Result<(), Fault> {
    let mut at = 0;
    while at < pixels.len() {
        let [code] = take(data)?;
        let count = usize::from(if code > 128 { code - 128 } else { code });
        let Some(part) = pixels.get_mut(at..at + count) else {
            return Err(Fault::Damaged("has a run beyond its end"));
        };
        if count == 0 {
            return Err(Fault::Damaged("has a run of no length"));
        }
        if code > 128 {
            let [value] = take(data)?;
            for pixel in part {
                pixel[component] = value;
            }
        } else {
            let (values, rest) = data.split_at_checked(count).ok_or(Fault::CutShort)?;
            *data = rest;
            for (pixel, &value) in part.iter_mut().zip(values) {
                pixel[component] = value;
            }
        }
        at += count;
    }
    Ok(())
}

/// Reads plain pixels; (1, 1, 1, n) repeats the pixel before it n times, and each directly following (1, 1, 1, n) counts 256 times
/// as much as the one before it.
fn read_pixels(data: &mut &[u8], pixels: &mut [[u8; 4]]) -> Result<(), Fault> {
    let (mut at, mut shift) = (0_usize, 0_u32);
    while at < pixels.len() {
        let pixel: [u8; 4] = take(data)?;
        if let [1, 1, 1, count] = pixel {
            let before = at.checked_sub(1).and_then(|before| pixels.get(before));
            let Some(&before) = before else {
                return Err(Fault::Damaged("begins with the repeat of a pixel"));
            };
            let count = u64::from(count).checked_shl(shift).unwrap_or(u64::MAX);
            let left = pixels.len() - at;
            let count = usize::try_from(count).ok().filter(|&count| count <= left);
            let Some(count) = count else {
                return Err(Fault::Damaged("has a run beyond its end"));
            };
            pixels[at..at + count].fill(before);
            at += count;
            shift = (shift + 8).min(64);
        } else {
            pixels[at] = pixel;
            at += 1;
            shift = 0;
        }
    }
    Ok(())
}
