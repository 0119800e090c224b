//! Films, coatings and their materials, mostly without a picture: against published figures, independent computations and each other.

mod orders;
mod physics;
mod process_colors;
mod renderer_stacks;
mod stack_batches;
mod stacks;
mod two_beam;
