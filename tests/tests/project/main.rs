//! The project itself: which crate uses which, names and spelling, and what the documentation claims.

mod names;
mod readme;
mod rooms;
