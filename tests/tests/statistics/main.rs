//! Proofs by counting and averaging: samplers, ways to find light, options of path sampling, a walk among facets. These are the slowest
//! tests for what they render: each needs many samples.

mod direct_light;
mod facet_energy;
mod rounds;
mod samplers;
mod sampling;
