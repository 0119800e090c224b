//! The project itself: which crate and which module uses which, names and spelling, and what the documentation claims.

mod circles;
mod dependencies;
mod names;
mod readme;
mod rooms;
