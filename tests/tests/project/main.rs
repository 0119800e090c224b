//! The project itself: which crate uses which, names and spelling, and what the documentation claims.

mod dependencies;
mod names;
mod readme;
mod rooms;
