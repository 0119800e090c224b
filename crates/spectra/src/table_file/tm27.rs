//! IES TM-27: a spectrum in XML, `.spdx`.

use std::borrow::Cow;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::error::TableFileError;
use super::head::is_percent;
use super::line::number;
use super::options::Unit;
use super::{MAX_ROWS, Notes, Point, Series};

const FORMAT: &str = "IES TM-27";
/// The deepest nesting of elements that is accepted.
const MAX_DEPTH: usize = 64;

/// Whether a text has this format.
pub(super) fn is_tm27(text: &str) -> bool {
    text.trim_start().starts_with('<')
}

/// What has been read so far. Only the points are kept. Entities are not resolved: a value that refers to one is refused.
#[derive(Default)]
struct State<'a> {
    depth: usize,
    is_tm27: bool,
    spectra: usize,
    /// The wavelength and the text so far of the open element.
    open: Option<(Cow<'a, str>, String)>,
    is_in_quantity: bool,
    quantity: String,
    points: Vec<Point<'a>>,
}

/// Parses the spectrum of a text.
pub(super) fn series<'a>(text: &'a str, notes: &mut Notes) -> Result<Series<'a>, TableFileError> {
    let mut reader = Reader::from_str(text);
    let mut lines = LineCount {
        text,
        at: 0,
        line: 1,
    };
    let mut state = State::default();
    loop {
        let event = reader.read_event();
        let line = lines.until(reader.buffer_position());
        match event {
            Err(error) => return Err(wrong(line, error.to_string())),
            Ok(Event::Eof) => break,
            Ok(event) => state.take(line, event)?,
        }
    }
    if !state.is_tm27 {
        return Err(wrong(
            1,
            "it is XML without an element IESTM2714".to_owned(),
        ));
    }
    if state.depth > 0 {
        return Err(wrong(
            lines.line,
            "the file ends within an element".to_owned(),
        ));
    }
    notes.add("IES TM-27");
    Ok(Series {
        points: state.points,
        unit: Some((Unit::Nm, "as in TM-27")),
        scale: is_percent(&state.quantity).then_some(100.0),
    })
}

fn wrong(line: usize, wrong: String) -> TableFileError {
    let format = FORMAT;
    TableFileError::Format {
        line,
        format,
        wrong,
    }
}

/// Counts lines up to an advancing position.
struct LineCount<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl LineCount<'_> {
    fn until(&mut self, position: u64) -> usize {
        let position = usize::try_from(position)
            .unwrap_or(usize::MAX)
            .min(self.text.len());
        let between = self
            .text
            .as_bytes()
            .get(self.at..position)
            .unwrap_or_default();
        self.line += between.split(|&byte| byte == b'\n').skip(1).count();
        self.at = self.at.max(position);
        self.line
    }
}

impl<'a> State<'a> {
    fn take(&mut self, line: usize, event: Event<'a>) -> Result<(), TableFileError> {
        match event {
            Event::Start(element) => {
                self.depth += 1;
                if self.depth > MAX_DEPTH {
                    return Err(wrong(
                        line,
                        format!("elements are nested more than {MAX_DEPTH} deep"),
                    ));
                }
                self.start(line, &element)
            }
            Event::Empty(element) => {
                self.start(line, &element)?;
                self.end(line)
            }
            Event::End(_) => {
                self.depth = self.depth.saturating_sub(1);
                self.end(line)
            }
            Event::Text(text) => {
                self.text(&text.xml10_content());
                Ok(())
            }
            Event::CData(text) => {
                self.text(&text.xml10_content());
                Ok(())
            }
            Event::GeneralRef(_) if self.open.is_some() => Err(wrong(
                line,
                "a value refers to an entity; it must be a number".to_owned(),
            )),
            _ => Ok(()),
        }
    }

    fn start(&mut self, line: usize, element: &BytesStart) -> Result<(), TableFileError> {
        if self.open.is_some() {
            return Err(wrong(
                line,
                "SpectralData contains another element".to_owned(),
            ));
        }
        match element.local_name().as_ref() {
            name if name.starts_with("IESTM27") => self.is_tm27 = true,
            "SpectralDistribution" => {
                self.spectra += 1;
                if self.spectra > 1 {
                    return Err(wrong(
                        line,
                        "another SpectralDistribution begins here; only one is read".to_owned(),
                    ));
                }
            }
            "SpectralQuantity" => self.is_in_quantity = true,
            "SpectralData" => {
                let attribute = element.try_get_attribute("wavelength");
                let attribute = attribute.map_err(|error| wrong(line, error.to_string()))?;
                let Some(attribute) = attribute else {
                    return Err(wrong(line, "SpectralData has no wavelength".to_owned()));
                };
                self.open = Some((Cow::Owned(attribute.value.to_string()), String::new()));
            }
            _ => {}
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        let most = |kept: &str| 400_usize.saturating_sub(kept.len());
        if let Some((_, kept)) = &mut self.open {
            let most = most(kept);
            kept.extend(text.chars().take(most));
        } else if self.is_in_quantity {
            let most = most(&self.quantity);
            self.quantity.extend(text.chars().take(most));
        }
    }

    fn end(&mut self, line: usize) -> Result<(), TableFileError> {
        self.is_in_quantity = false;
        let Some((place_text, text)) = self.open.take() else {
            return Ok(());
        };
        if self.points.len() == MAX_ROWS {
            let (what, most) = ("points", MAX_ROWS);
            return Err(TableFileError::TooMany { what, most });
        }
        let text = text.trim().to_owned();
        let read = |text: &str| {
            // Numbers in XML have a decimal point.
            let found = number(text).filter(|_| !text.contains(','));
            found.ok_or_else(|| TableFileError::Number {
                line,
                text: text.to_owned(),
            })
        };
        self.points.push(Point {
            line,
            place: read(place_text.trim())?,
            value: read(&text)?,
            place_text,
            text: Cow::Owned(text),
        });
        Ok(())
    }
}
