//! Colors of stacks, compared with independent computations and with finer sums.

mod coarse_tables;
mod colors;
mod fringes;
