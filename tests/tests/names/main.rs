//! Names and spelling: one English, and the same names in both languages.

mod spelling;
mod twins;
