//! A small fuzzer for readers of files, which runs on stable Rust as ordinary tests.
//!
//! A [`Campaign`] feeds a reader with a corpus, then with mutated copies of it. Each input is an execution of its own that can be
//! repeated: its random numbers depend only on the seed and its number. An input with a new outcome is added to the inputs
//! to mutate; outcomes are distinguished by the words of the error, which represent the path through the reader.
//!
//! A reader fails when it panics, takes longer than 1 s for each 100 kB, holds more than 20 times the input plus 64 MB in addition to
//! its result, or reports itself that an accepted input is unsound.
//!
//! | variable | meaning |
//! | --- | --- |
//! | `PELLICLE_FUZZ_SECONDS` | how long each campaign runs; without it, a fixed number of executions |
//! | `PELLICLE_FUZZ_SEED` | seed of the mutations; 1 by default |
//!
//! The current input is in the temporary folder as `pellicle-fuzz/NAME.running`, in case the process is killed; inputs that
//! failed are in the same folder.

mod campaign;
mod mutation;
mod watch;

pub use campaign::{Campaign, Outcome};
