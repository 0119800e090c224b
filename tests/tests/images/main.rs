//! Rendered pictures against known answers: closed forms, figures computed elsewhere, units of light, and goldens.

mod bodies;
mod closed_forms;
mod environment;
mod fields;
mod photometry;
mod pictures;
mod polarization;
mod relighting;
