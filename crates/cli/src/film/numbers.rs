//! Numbers on the command line: lists, ranges, percentages.

/// The largest length of a list.
const MAX: usize = 100_000;

/// Numbers in the order in which they were written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct List(pub(crate) Vec<f64>);

impl List {
    /// Parses `0,30,60`, `380:780:10` (from, to, step), or several of either.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut numbers = Vec::new();
        for item in text.split(',') {
            numbers.extend(item_of_list(item.trim())?);
            if numbers.len() > MAX {
                return Err(format!("more than {MAX} numbers"));
            }
        }
        Ok(Self(numbers))
    }
}

fn item_of_list(item: &str) -> Result<Vec<f64>, String> {
    let parts: Vec<&str> = item.split(':').collect();
    match parts.as_slice() {
        [only] => Ok(vec![number(only)?]),
        [from, to, step] => {
            let decimals = decimals(from).zip(decimals(step)).map(|(a, b)| a.max(b));
            range(number(from)?, number(to)?, number(step)?, decimals)
        }
        _ => Err(format!(
            "{item:?} is neither a number nor a range FROM:TO:STEP like 380:780:10"
        )),
    }
}

/// The numbers `from`, `from` + `step` … up to `to`, which is included if a step falls on it except for rounding.
fn range(from: f64, to: f64, step: f64, decimals: Option<usize>) -> Result<Vec<f64>, String> {
    if to < from {
        return Err(format!(
            "the range runs backwards; write {to}:{from}:{}",
            step.abs()
        ));
    }
    if step <= 0.0 {
        return Err(format!("a step of {step}; it must be more than 0"));
    }
    let steps = ((to - from) / step + 1e-9).floor();
    if steps >= MAX as f64 {
        return Err(format!("more than {MAX} numbers; use a larger step"));
    }
    Ok((0..=steps as usize)
        .map(|i| rounded(from + i as f64 * step, decimals))
        .collect())
}

/// Rounds a number to this many decimals: 508.2, not 508.20000000000005.
fn rounded(value: f64, decimals: Option<usize>) -> f64 {
    let written = decimals.and_then(|decimals| format!("{value:.decimals$}").parse().ok());
    written.unwrap_or(value)
}

/// The number of decimals of a written number; `None` if it has an exponent, or too many decimals to round to.
fn decimals(text: &str) -> Option<usize> {
    let text = text.trim();
    let count = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    (!text.contains(['e', 'E']) && count <= 12).then_some(count)
}

/// Parses a finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let value: Option<f64> = text.trim().parse().ok();
    value
        .filter(|value| value.is_finite())
        .ok_or_else(|| format!("{text:?} is not a number"))
}

/// Parses `2%` as 0.02.
pub(crate) fn percent(text: &str) -> Result<f64, String> {
    let digits = text
        .trim()
        .strip_suffix('%')
        .ok_or("write the tolerance in percent, such as 2%")?;
    Ok(number(digits)? / 100.0)
}

/// A layer whose thickness varies: `LAYER:FROM:TO`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vary {
    /// Counted from 1, as it was written.
    pub(crate) layer: usize,
    pub(crate) from_nm: f64,
    pub(crate) to_nm: f64,
}

impl Vary {
    /// The thickest layer, nm.
    const MAX_NM: f64 = pellicle::coating::Stack::THICKNESS_NM.high;

    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').collect();
        let [layer, from, to] = parts.as_slice() else {
            return Err("write a layer and its range, LAYER:FROM:TO, as in 1:20:400".into());
        };
        let layer = layer
            .trim()
            .parse()
            .map_err(|_| format!("{layer:?} is not the number of a layer; the first is 1"))?;
        let (from_nm, to_nm) = (number(from)?, number(to)?);
        if !(0.0 <= from_nm && from_nm < to_nm && to_nm <= Self::MAX_NM) {
            return Err(format!(
                "thicknesses from {from} to {to} nm; they must increase and be between 0 and {} nm",
                Self::MAX_NM
            ));
        }
        Ok(Self {
            layer,
            from_nm,
            to_nm,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_numbers_and_ranges() {
        let list = |text| List::parse(text).map(|list| list.0);
        assert_eq!(list("0,30, 60"), Ok(vec![0.0, 30.0, 60.0]));
        assert_eq!(list("380:400:10,550"), Ok(vec![380.0, 390.0, 400.0, 550.0]));
        assert_eq!(list("380:399:10"), Ok(vec![380.0, 390.0]));
        assert_eq!(list("0:0.3:0.1").unwrap().len(), 4);
        assert_eq!(list("508:508.5:0.1").unwrap()[2], 508.2);
        assert_eq!(list("380:780:0.1").unwrap()[1282], 508.2);
        assert_eq!(list("0.25:1:.25").unwrap()[1..], [0.5, 0.75, 1.0]);
        assert_eq!(list("0:4e-1:1e-1").unwrap()[2], 0.2);
        assert_eq!(list("5:5:1"), Ok(vec![5.0]));
        for bad in [
            "", "a", "1,", "1:2", "1:2:3:4", "1:2:0", "1:2:-1", "nan", "inf", "0:1e9:1",
        ] {
            assert!(list(bad).is_err(), "{bad}");
        }
        assert!(list("780:380:10").unwrap_err().contains("380:780:10"));
    }

    #[test]
    fn a_share_has_its_sign() {
        assert_eq!(percent("2%"), Ok(0.02));
        assert_eq!(percent("0.5 %"), Ok(0.005));
        assert!(percent("2").is_err() && percent("x%").is_err());
    }

    #[test]
    fn a_layer_and_its_range() {
        let expected = Vary {
            layer: 1,
            from_nm: 20.0,
            to_nm: 400.0,
        };
        assert_eq!(Vary::parse("1:20:400"), Ok(expected));
        for bad in [
            "", "1", "1:20", "x:1:2", "1:400:20", "1:-1:20", "1:2:1e9", "-1:1:2",
        ] {
            assert!(Vary::parse(bad).is_err(), "{bad}");
        }
    }
}
