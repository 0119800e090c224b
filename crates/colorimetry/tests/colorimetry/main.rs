//! White points and displays.

mod display_files;
mod white_points;
