//! A compile of a pipeline is reported before the first samples, and a compiled pipeline is kept.

use pellicle_tests::device::open;
use pellicle_tests::scenes::small;
use std::ops::ControlFlow;

#[test]
fn a_compile_is_reported_as_zero_samples() {
    // A device that has not compiled anything.
    let gpu = open();
    let scene = small("film_wedge", [16, 8], 2, 4, 0);
    let stopped = gpu::render(&gpu, &scene, &mut |_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(gpu::RenderError::Stopped)));
    let told = || {
        let mut told = Vec::new();
        let image = gpu::render(&gpu, &scene, &mut |done| {
            told.push(done);
            ControlFlow::Continue(())
        });
        assert!(image.is_ok());
        told
    };
    let first = told();
    assert_eq!((first[0], first.last()), (0, Some(&(16 * 8 * 2))));
    assert!(first.is_sorted_by(|a, b| a < b), "{first:?}");
    // The pipeline is kept: nothing is compiled.
    let second = told();
    assert!(second[0] > 0, "{second:?}");
}
