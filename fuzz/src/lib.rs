//! A small fuzzer for readers of files, which runs on stable Rust as ordinary tests.
//!
//! A [`Campaign`] feeds a reader with a corpus, then with changed copies of it. Each input is an execution of its own that can be
//! run again: its random numbers follow from the seed and its number alone. An input whose outcome has not been seen before joins
//! what is changed next; outcomes are told apart by the words of the error, which stand for the path through the reader.
//!
//! A reader fails when it panics, takes longer than 1 s for each 100 kB, holds more than 20 times the input and 64 MB beside what it
//! returns, or says itself that what it accepted is unsound.
//!
//! | variable | meaning |
//! | --- | --- |
//! | `PELLICLE_FUZZ_SECONDS` | how long each campaign runs; without it a fixed number of executions |
//! | `PELLICLE_FUZZ_SEED` | another sequence of changes; 1 without it |
//!
//! The input that runs is in the temporary folder as `pellicle-fuzz/NAME.running`, for a process that is killed; those that
//! failed lie beside it.

mod campaign;
mod mutation;
mod watch;

pub use campaign::{Campaign, Outcome};
