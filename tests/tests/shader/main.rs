//! The shader as a whole: its text, its layout, what is left of it for a scene, its lists, and its compiled form.

mod layout;
mod lists;
mod modules;
mod pipeline_cache;
mod specialization;
