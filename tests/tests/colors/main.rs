//! Tables and colors: built-in data, white points, displays, gamut mapping, and the colors of stacks, compared with independent
//! computations, published figures and finer sums.

mod coarse_tables;
mod display_files;
mod fringes;
mod gamut;
mod indices;
mod stack_colors;
mod white_points;
