//! The header of a Radiance picture: lines of text, an empty line, and a line with the size and orientation.

use colorimetry::Matrix3;
use colorimetry::chromaticity::xyz_from_rgb_of;
use colorimetry::matrix::{IDENTITY, product};
use colorimetry::srgb;

use super::RadianceError;

/// The most bytes of a header.
const MAX_BYTES: usize = 64 << 10;
/// The most characters of a line that an error shows.
const SHOWN: usize = 60;
/// Largest difference of chromaticities that count as equal: writers round them to three decimals.
const SAME: f64 = 6e-4;

/// The contents of a header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) layout: Layout,
    /// From the file's three numbers to linear red, green and blue of sRGB; `None` if they are the same.
    pub(super) to_linear: Option<Matrix3>,
    pub(super) notes: Vec<String>,
}

/// Size and orientation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    /// Pixels from left to right.
    pub(super) width: u32,
    /// Pixels from top to bottom.
    pub(super) height: u32,
    /// Whether scanlines are columns.
    is_turned: bool,
    /// Whether x increases from right to left.
    from_right: bool,
    /// Whether rows start at the bottom.
    from_bottom: bool,
}

impl Layout {
    /// The number of scanlines and their length.
    pub(super) fn scanlines(&self) -> [u32; 2] {
        if self.is_turned {
            [self.width, self.height]
        } else {
            [self.height, self.width]
        }
    }

    /// Index of a pixel of a scanline in the rows of the upright picture.
    pub(super) fn place(&self, scanline: u32, along: u32) -> usize {
        let (x, y) = if self.is_turned {
            (scanline, along)
        } else {
            (along, scanline)
        };
        let flipped =
            |at: u32, count: u32, is_flipped| if is_flipped { count - 1 - at } else { at };
        let x = flipped(x, self.width, self.from_right);
        let y = flipped(y, self.height, self.from_bottom);
        y as usize * self.width as usize + x as usize
    }

    /// Parses a line such as `-Y 2 +X 3`: two scanlines from the top, each of three pixels from the left.
    fn parse(line: &str) -> Option<Self> {
        let mut words = line.split_ascii_whitespace();
        let mut axis = || {
            let (name, count) = (words.next()?, words.next()?);
            let is_falling = match name.as_bytes().first()? {
                b'-' => true,
                b'+' => false,
                _ => return None,
            };
            Some((name.get(1..)?, is_falling, count.parse::<u32>().ok()?))
        };
        let (first, second) = (axis()?, axis()?);
        let (is_turned, y, x) = match (first.0, second.0) {
            ("Y", "X") => (false, first, second),
            ("X", "Y") => (true, second, first),
            _ => return None,
        };
        words.next().is_none().then_some(Self {
            width: x.2,
            height: y.2,
            is_turned,
            from_right: x.1,
            from_bottom: !y.1,
        })
    }
}

/// The lines of a header without their ends, `\n` or `\r\n`.
struct Lines<'a> {
    bytes: &'a [u8],
    /// Bytes and lines read so far.
    length: usize,
    line: usize,
}

impl Lines<'_> {
    fn next(&mut self) -> Result<String, RadianceError> {
        let rest = self.bytes.get(self.length..).unwrap_or_default();
        let end = rest.iter().position(|&byte| byte == b'\n');
        let line = &rest[..end.ok_or(RadianceError::NoEnd)?];
        self.length += line.len() + 1;
        self.line += 1;
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        Ok(String::from_utf8_lossy(line).into_owned())
    }
}

/// The combined contents of the lines.
struct Said {
    exposure: f64,
    corrections: [f64; 3],
    format: Option<String>,
    primaries: Option<[f64; 8]>,
    notes: Vec<String>,
}

impl Header {
    /// Reads the header. Returns it and its length in bytes.
    pub(super) fn read(file: &[u8]) -> Result<(Self, usize), RadianceError> {
        if !super::is_radiance(file) {
            return Err(RadianceError::NotRadiance);
        }
        let mut lines = Lines {
            bytes: &file[..file.len().min(MAX_BYTES)],
            length: 0,
            line: 0,
        };
        let mut said = Said {
            exposure: 1.0,
            corrections: [1.0; 3],
            format: None,
            primaries: None,
            notes: Vec::new(),
        };
        lines.next()?;
        loop {
            let text = lines.next()?;
            if text.is_empty() {
                break;
            }
            said.read(&text)
                .map_err(|problem| error(lines.line, &text, problem))?;
        }
        let text = lines.next()?;
        let layout = Layout::parse(&text).ok_or_else(|| {
            let problem =
                "does not say how large the picture is; -Y HEIGHT +X WIDTH would be right";
            error(lines.line, &text, problem)
        })?;
        let (width, height) = (layout.width, layout.height);
        if width == 0 || height == 0 {
            return Err(RadianceError::Empty { width, height });
        }
        said.note_layout(text.trim(), &layout);
        Ok((said.header(layout)?, lines.length))
    }
}

fn error(line: usize, text: &str, problem: &'static str) -> RadianceError {
    RadianceError::Line {
        line,
        found: text.chars().take(SHOWN).collect(),
        problem,
    }
}

impl Said {
    fn read(&mut self, text: &str) -> Result<(), &'static str> {
        let Some((name, value)) = text.split_once('=') else {
            return Ok(());
        };
        match name {
            "EXPOSURE" => {
                let [factor] = numbers(value).ok_or("is not a number")?;
                if self.is_factor(factor, text) {
                    self.exposure *= factor;
                }
            }
            "COLORCORR" => {
                let factors: [f64; 3] = numbers(value).ok_or("is not three numbers")?;
                if factors.iter().all(|&factor| self.is_factor(factor, text)) {
                    for (product, factor) in self.corrections.iter_mut().zip(factors) {
                        *product *= factor;
                    }
                }
            }
            "FORMAT" => {
                let value = value.trim().to_owned();
                if self.format.as_ref().is_some_and(|format| *format != value) {
                    return Err("contradicts the FORMAT before it");
                }
                if !matches!(value.as_str(), "32-bit_rle_rgbe" | "32-bit_rle_xyze") {
                    return Err(
                        "is a format that is not supported; 32-bit_rle_rgbe and 32-bit_rle_xyze are",
                    );
                }
                self.format = Some(value);
            }
            "PRIMARIES" => {
                let problem = "is not the eight numbers x y of red, green, blue and white";
                let value: [f64; 8] = numbers(value).ok_or(problem)?;
                if self.primaries.is_some_and(|primaries| primaries != value) {
                    return Err("contradicts the PRIMARIES before it");
                }
                if from_primaries(value).is_none() {
                    return Err("is not three primaries that mix to a white");
                }
                self.primaries = Some(value);
            }
            "GAMMA" if numbers(value) != Some([1.0]) => {
                let note = format!("{} is ignored: the pixels are read as linear", short(text));
                self.notes.push(note);
            }
            _ => {}
        }
        Ok(())
    }

    /// Whether pixels can have been multiplied by a factor; notes a factor that is ignored.
    fn is_factor(&mut self, factor: f64, text: &str) -> bool {
        let is_sound = factor.is_finite() && factor > 0.0;
        if !is_sound {
            let note = format!("{} is ignored: it is not above 0 and finite", short(text));
            if !self.notes.contains(&note) {
                self.notes.push(note);
            }
        }
        is_sound
    }

    fn note_layout(&mut self, text: &str, layout: &Layout) {
        if layout.is_turned || layout.from_right || layout.from_bottom {
            self.notes.push(format!("turned upright from {text}"));
        }
    }

    fn header(mut self, layout: Layout) -> Result<Header, RadianceError> {
        let divisor = self.corrections.map(|factor| factor * self.exposure);
        if divisor.iter().any(|factor| !factor.is_normal()) {
            return Err(RadianceError::Divisor(divisor));
        }
        if divisor == [self.exposure; 3] && self.exposure != 1.0 {
            let product = self.exposure;
            self.notes
                .push(format!("EXPOSURE={product}: pixels divided by {product}"));
        } else if divisor != [1.0; 3] {
            let [r, g, b] = divisor;
            self.notes.push(format!(
                "EXPOSURE and COLORCORR: pixels divided by {r}, {g} and {b}"
            ));
        }
        let colors = self.colors();
        let is_plain = colors.is_none() && divisor == [1.0; 3];
        let of_colors = colors.unwrap_or(IDENTITY);
        let divided = of_colors.map(|row| std::array::from_fn(|i| row[i] / divisor[i]));
        Ok(Header {
            layout,
            to_linear: (!is_plain).then_some(divided),
            notes: self.notes,
        })
    }

    /// Returns the matrix to linear sRGB; `None` if the numbers already are linear sRGB.
    fn colors(&mut self) -> Option<Matrix3> {
        match (self.format.as_deref(), self.primaries) {
            (Some("32-bit_rle_xyze"), primaries) => {
                self.notes.push(
                    "XYZE: Y = 1 is the luminance of (1, 1, 1); if Y is in cd/m², as Radiance writes it, scale = 1/179 gives the values that \
                     Radiance writes in red, green and blue"
                        .to_owned(),
                );
                if primaries.is_some() {
                    self.notes
                        .push("PRIMARIES are not used: the pixels are XYZ".to_owned());
                }
                Some(*srgb::rgb_from_xyz())
            }
            (format, primaries) => {
                if format.is_none() {
                    let note = "no FORMAT in the header: read as 32-bit_rle_rgbe";
                    self.notes.push(note.to_owned());
                }
                let primaries = primaries.filter(|&found| !is_srgb(found))?;
                let shown: Vec<String> = primaries.iter().map(f64::to_string).collect();
                self.notes.push(format!(
                    "PRIMARIES={}: converted to those of sRGB",
                    shown.join(" ")
                ));
                from_primaries(primaries)
            }
        }
    }
}

/// Parses exactly `N` numbers separated by blanks.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text
        .split_ascii_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    numbers?.try_into().ok()
}

fn short(text: &str) -> String {
    text.trim().chars().take(SHOWN).collect()
}

fn is_srgb(found: [f64; 8]) -> bool {
    let own = srgb::PRIMARIES.as_flattened().iter().chain(&srgb::WHITE);
    found.iter().zip(own).all(|(a, b)| (a - b).abs() < SAME)
}

/// Returns the matrix from amounts of these primaries to those of sRGB; `None` if they are not primaries.
fn from_primaries([rx, ry, gx, gy, bx, by, wx, wy]: [f64; 8]) -> Option<Matrix3> {
    let to_xyz = xyz_from_rgb_of([[rx, ry], [gx, gy], [bx, by]], [wx, wy]);
    // Points on one line, or nearly on one, have no such matrix.
    let is_sound = to_xyz
        .iter()
        .flatten()
        .all(|m| m.is_finite() && m.abs() < 100.0);
    is_sound.then(|| product(srgb::rgb_from_xyz(), &to_xyz))
}
