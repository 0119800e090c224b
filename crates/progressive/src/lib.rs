//! Renders in rounds: when to stop, checkpoints, parts of a picture.

mod noise;
