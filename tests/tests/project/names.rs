//! Names and spelling: American English everywhere, and the same names in both languages.

mod spelling;
mod twins;
