//! split.wgsl: where paths divide or end.

use crate::world::{everything, rows};
use crate::{Check, table};
use pellicle_tests::tolerances::{ARITHMETIC, ARITHMETIC_OF_TABLES};

pub(crate) fn checks() -> Vec<Check> {
    vec![
        Check {
            probe: everything().probe((2, 1), "put(0u, reflected_part(u32(a(0u)), a(1u)));"),
            proves: &["reflected_part"],
            inputs: rows(2, |u| {
                let materials = everything().scene.estimates();
                let material = (u[0] * materials.len() as f64) as usize;
                let cosine = (1.02 * u[1]).min(1.0);
                (!materials[material].reflected.is_empty()).then(|| vec![material as f64, cosine])
            }),
            twin: |a| vec![everything().scene.estimates()[a[0] as usize].reflected_at(a[1])],
            tolerance: ARITHMETIC_OF_TABLES,
        },
        Check {
            probe: everything().probe(
                (1, 2),
                "put(0u, reflected_share(a(0u))); put(1u, chance_to_go_on(a(0u)));",
            ),
            proves: &["chance_to_go_on", "reflected_share"],
            inputs: table(&[(0.0, 1.2)], &[&[0.0], &[1.0]]),
            twin: |a| {
                let chance = reference::chance_to_go_on(a[0]);
                vec![reference::reflected_share(a[0]), chance]
            },
            tolerance: ARITHMETIC,
        },
    ]
}
