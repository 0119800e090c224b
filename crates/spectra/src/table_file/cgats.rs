//! CGATS.17: spectra of samples, with a sample in each row and a wavelength in each column.

use std::borrow::Cow;

use super::error::{TableFileError, cell_text};
use super::head::is_percent;
use super::line::{DecimalSigns, Line, Separator, lines, split};
use super::options::{ColumnChoice, Options, Unit};
use super::{MAX_COLUMNS, MAX_ROWS, Notes, Point, Series};

const FORMAT: &str = "CGATS";

/// Whether a text has this format.
pub(super) fn is_cgats(text: &str) -> bool {
    lines(text).any(|line| line.content.eq_ignore_ascii_case("BEGIN_DATA_FORMAT"))
}

/// The parsed contents of a file.
#[derive(Default)]
struct File<'a> {
    fields: Vec<&'a str>,
    samples: Vec<Line<'a>>,
    /// The number that represents 1, if the file states it.
    scale: Option<f64>,
    last_line: usize,
}

/// The part of the file that a line belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Head,
    Fields,
    Between,
    Data,
}

/// Returns the spectrum of the only sample, or of the chosen one.
pub(super) fn series<'a>(
    text: &'a str,
    options: &Options,
    notes: &mut Notes,
) -> Result<Series<'a>, TableFileError> {
    let file = read(text)?;
    let spectral = spectral_fields(&file.fields);
    if spectral.is_empty() {
        return Err(wrong(
            file.last_line,
            "no field has a wavelength in its name, as SPECTRAL_NM380, SPEC_380 or nm380 do"
                .to_owned(),
        ));
    }
    let sample = chosen(&file, options, notes)?;
    let cells = cells_of(sample);
    if cells.len() != file.fields.len() {
        return Err(TableFileError::Columns {
            line: sample.number,
            found: cells.len(),
            expected: format!("{}, one per field", file.fields.len()),
        });
    }
    let mut signs = DecimalSigns::default();
    let mut points = Vec::with_capacity(spectral.len());
    for (field, (place, place_text)) in spectral {
        let cell = cells.get(field).copied().unwrap_or_default();
        points.push(Point {
            line: sample.number,
            place,
            place_text: Cow::Borrowed(place_text),
            value: signs.number(sample.number, field + 1, cell)?,
            text: Cow::Borrowed(cell),
        });
    }
    if signs.is_comma() {
        notes.add("decimal commas");
    }
    Ok(Series {
        points,
        unit: Some((Unit::Nm, "as in CGATS")),
        scale: file.scale,
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

fn read(text: &str) -> Result<File<'_>, TableFileError> {
    let mut file = File::default();
    let mut part = Part::Head;
    for line in lines(text) {
        file.last_line = line.number;
        let content = line.content;
        let is = |keyword: &str| content.eq_ignore_ascii_case(keyword);
        match part {
            _ if is("BEGIN_DATA_FORMAT") && file.fields.is_empty() => part = Part::Fields,
            _ if is("BEGIN_DATA_FORMAT") || is("BEGIN_DATA") && part == Part::Data => {
                return Err(wrong(
                    line.number,
                    "another table begins here; only one is read".to_owned(),
                ));
            }
            _ if is("END_DATA_FORMAT") => part = Part::Between,
            _ if is("BEGIN_DATA") => part = Part::Data,
            _ if is("END_DATA") => part = Part::Between,
            _ if content.starts_with('#') => {}
            Part::Fields => {
                file.fields.extend(cells_of(&line));
                check_count("columns", file.fields.len(), MAX_COLUMNS)?;
            }
            Part::Data => {
                file.samples.push(line);
                check_count("samples", file.samples.len(), MAX_ROWS)?;
            }
            Part::Head | Part::Between => file.scale = scale(content).or(file.scale),
        }
    }
    if file.samples.is_empty() {
        return Err(TableFileError::Empty);
    }
    if part == Part::Data {
        return Err(wrong(
            file.last_line,
            "the file ends before END_DATA".to_owned(),
        ));
    }
    Ok(file)
}

fn check_count(what: &'static str, count: usize, most: usize) -> Result<(), TableFileError> {
    if count > most {
        return Err(TableFileError::TooMany { what, most });
    }
    Ok(())
}

/// Returns the number that represents 1, if a line of the header states it.
fn scale(content: &str) -> Option<f64> {
    let (keyword, value) = content.split_once(char::is_whitespace)?;
    if keyword.eq_ignore_ascii_case("SPECTRAL_NORM") {
        let norm = super::line::number(value.trim().trim_matches('"'))?;
        return (norm > 0.0).then_some(norm);
    }
    is_percent(content).then_some(100.0)
}

/// Splits a line into cells, at tabs if there are any, else at blanks.
fn cells_of<'a>(line: &Line<'a>) -> Vec<&'a str> {
    let separator = if line.content.contains('\t') {
        Separator::Tab
    } else {
        Separator::Blanks
    };
    split(line.content, separator)
}

/// Returns the fields that hold a value at a wavelength: position, nm and its text.
fn spectral_fields<'a>(fields: &[&'a str]) -> Vec<(usize, (f64, &'a str))> {
    let all = fields.iter().enumerate();
    all.filter_map(|(at, field)| Some((at, wavelength(field)?)))
        .collect()
}

/// Returns the wavelength at the end of a field's name.
fn wavelength(field: &str) -> Option<(f64, &str)> {
    let digits = field.find(|c: char| c.is_ascii_digit())?;
    let (name, number) = field.split_at_checked(digits)?;
    let known = [
        "SPECTRAL_NM",
        "SPECTRAL_NM_",
        "SPECTRAL_",
        "SPEC_",
        "SPEC",
        "NM",
        "NM_",
    ];
    let is_known = known.iter().any(|known| known.eq_ignore_ascii_case(name));
    let is_plain = number.chars().all(|c| c.is_ascii_digit() || c == '.');
    (is_known && is_plain).then(|| Some((number.parse().ok()?, number)))?
}

/// Returns the chosen sample.
fn chosen<'f, 'a>(
    file: &'f File<'a>,
    options: &Options,
    notes: &mut Notes,
) -> Result<&'f Line<'a>, TableFileError> {
    let names: Vec<Vec<&str>> = file
        .samples
        .iter()
        .map(|sample| names_of(file, sample))
        .collect();
    let label = |at: usize| match names.get(at).map(Vec::as_slice) {
        None | Some([]) => (at + 1).to_string(),
        Some(names) => names
            .iter()
            .map(|name| cell_text(name))
            .collect::<Vec<_>>()
            .join(" "),
    };
    let known = || {
        let shown: Vec<_> = (0..file.samples.len().min(24)).map(label).collect();
        let more = file.samples.len().saturating_sub(24);
        let rest = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        format!("samples {}{rest}", shown.join(", "))
    };
    let matching: Vec<usize> = match options.columns.as_slice() {
        [] => (0..file.samples.len()).collect(),
        [ColumnChoice::Name(name)] => {
            let is_it = |at: &usize| {
                names
                    .get(*at)
                    .is_some_and(|names| names.contains(&name.trim()))
            };
            (0..names.len()).filter(is_it).collect()
        }
        [ColumnChoice::Number(number)] => {
            // Samples are often numbered: these numbers take precedence over positions.
            let id = number.to_string();
            let named = (0..names.len()).find(|&at| {
                names
                    .get(at)
                    .is_some_and(|names| names.contains(&id.as_str()))
            });
            let position = number.checked_sub(1).filter(|&at| at < names.len());
            named.or(position).into_iter().collect()
        }
        _ => return Err(TableFileError::OneQuantity),
    };
    match (matching.as_slice(), options.columns.as_slice()) {
        (&[only], _) => {
            if file.samples.len() > 1 {
                notes.add(format!("the sample {}", label(only)));
            }
            file.samples.get(only).ok_or(TableFileError::Empty)
        }
        (&[], [ColumnChoice::Name(name)]) => Err(TableFileError::NoColumn {
            asked: cell_text(name),
            known: known(),
        }),
        (&[], [ColumnChoice::Number(number)]) => Err(TableFileError::NoColumn {
            asked: number.to_string(),
            known: known(),
        }),
        _ => Err(TableFileError::WhichColumn {
            wrong: format!("there are {} samples, but one is needed", matching.len()),
            known: known(),
        }),
    }
}

/// Returns the id and the name of a sample.
fn names_of<'a>(file: &File<'a>, sample: &Line<'a>) -> Vec<&'a str> {
    let cells = cells_of(sample);
    let is_name = |field: &str| {
        ["SAMPLE_ID", "SAMPLEID", "SAMPLE_NAME", "SAMPLE_LOC"]
            .iter()
            .any(|known| known.eq_ignore_ascii_case(field))
    };
    let fields = file.fields.iter().zip(cells);
    fields
        .filter(|(field, _)| is_name(field))
        .map(|(_, cell)| cell)
        .collect()
}
