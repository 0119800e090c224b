//! Intervals of wavelengths whose data cannot be used.

use std::sync::Arc;

/// An open interval of wavelengths whose data cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The last valid wavelength before it, nm; 0 if there is none.
    pub from_nm: f64,
    /// The first valid wavelength after it, nm; infinite if there is none.
    pub to_nm: f64,
    /// What is wrong, and where.
    pub reason: Arc<str>,
}

/// Faults in order of wavelength that do not overlap.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Faults(Vec<Fault>);

impl Faults {
    /// Sorts the faults and merges those that overlap, with the reason of the first.
    pub(crate) fn new(mut faults: Vec<Fault>) -> Self {
        faults.sort_by(|a, b| a.from_nm.total_cmp(&b.from_nm));
        let mut apart: Vec<Fault> = Vec::with_capacity(faults.len());
        for fault in faults {
            match apart.last_mut() {
                Some(last) if fault.from_nm < last.to_nm => {
                    last.to_nm = last.to_nm.max(fault.to_nm);
                }
                _ => apart.push(fault),
            }
        }
        Self(apart)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Fault> {
        self.0.iter()
    }

    /// Returns the fault that contains `nm`; its ends are valid to within 1e-9 nm.
    pub(crate) fn at(&self, nm: f64) -> Option<&Fault> {
        self.within(nm, nm)
    }

    /// Returns the first fault that overlaps a range.
    pub(crate) fn within(&self, low_nm: f64, high_nm: f64) -> Option<&Fault> {
        let next = self.0.partition_point(|fault| fault.to_nm <= low_nm + 1e-9);
        let fault = self.0.get(next)?;
        (fault.from_nm + 1e-9 < high_nm).then_some(fault)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(from_nm: f64, to_nm: f64, reason: &str) -> Fault {
        let reason = reason.into();
        Fault {
            from_nm,
            to_nm,
            reason,
        }
    }

    #[test]
    fn faults_are_found_between_their_ends_alone() {
        let faults = Faults::new(vec![
            fault(900.0, f64::INFINITY, "end"),
            fault(0.0, 300.0, "start"),
            fault(500.0, 510.0, "a"),
            fault(505.0, 520.0, "b"),
        ]);
        assert_eq!(faults.iter().count(), 3);
        for (low, high, reason) in [
            (1.0, 1.0, Some("start")),
            (300.0, 500.0, None),
            (300.0, 501.0, Some("a")),
            (515.0, 515.0, Some("a")),
            (520.0, 900.0, None),
            (899.0, 901.0, Some("end")),
            (1e6, 1e6, Some("end")),
            (1.0, 1e6, Some("start")),
            (f64::NAN, f64::NAN, None),
        ] {
            let found = faults.within(low, high).map(|fault| &*fault.reason);
            assert_eq!(found, reason, "{low} to {high}");
        }
        assert_eq!(faults.at(510.0).map(|fault| &*fault.reason), Some("a"));
        assert_eq!(faults.at(500.0), None);
    }
}
