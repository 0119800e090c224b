//! Functions of split.wgsl: where paths split or end.

use crate::world::{everything, rows, within};
use crate::{Check, lazy, table};
use pellicle_tests::tolerances::{ARITHMETIC, ARITHMETIC_OF_TABLES};

pub(crate) fn checks() -> Vec<Check> {
    vec![
        Check {
            probe: within(
                everything,
                (2, 1),
                "put(0u, reflected_at(u32(a(0u)), a(1u)));",
            ),
            proves: &["reflected_at"],
            inputs: lazy(move || {
                rows(2, |u| {
                    let materials = everything().scene.estimates();
                    let material = (u[0] * materials.len() as f64) as usize;
                    let cosine = (1.02 * u[1]).min(1.0);
                    (!materials[material].reflected.is_empty())
                        .then(|| vec![material as f64, cosine])
                })
            }),
            twin: |a| vec![everything().scene.estimates()[a[0] as usize].reflected_at(a[1])],
            tolerance: ARITHMETIC_OF_TABLES,
        },
        Check {
            probe: within(
                everything,
                (1, 2),
                "put(0u, reflection_probability(a(0u))); put(1u, rr_survival_probability(a(0u)));",
            ),
            proves: &["rr_survival_probability", "reflection_probability"],
            inputs: lazy(move || table(&[(0.0, 1.2)], &[&[0.0], &[1.0]])),
            twin: |a| {
                let chance = reference::rr_survival_probability(a[0]);
                vec![reference::reflection_probability(a[0]), chance]
            },
            tolerance: ARITHMETIC,
        },
    ]
}
