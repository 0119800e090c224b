//! What host and shader share, defined once.
//!
//! Macros take documented Rust types, constants and bindings, prove at compile time that Rust places every field where WGSL expects
//! it, and generate the text of `layout.wgsl`, `records.wgsl` and `bindings.wgsl` in `shaders/`. Those files are committed, and a test
//! checks that they are up to date, as it does for `features.wgsl`.

#[macro_use]
mod declare;
pub(crate) mod bindings;
mod constants;
pub(crate) mod list_form;
mod records;
mod structs;

pub(crate) use bindings::bindings_wgsl;
pub use constants::*;
pub(crate) use declare::constant;
use declare::declare;
pub use records::*;
pub use structs::*;

/// Returns the first lines of a generated file, which is made from a file of `crates/gpu/src`.
pub(crate) fn heading(what: &str, source: &str) -> String {
    format!(
        "// {what}\n//\n// Generated from crates/gpu/src/{source}: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::\n"
    )
}

/// Returns the text of `shaders/layout.wgsl`.
pub fn wgsl() -> String {
    let mut text = heading("Constants and structs of host and shader.", "layout");
    for declaration in constants::CONSTANTS.iter().chain(structs::STRUCTS) {
        text += &declare(declaration);
    }
    text
}

/// Returns the text of `shaders/records.wgsl`.
pub fn records_wgsl() -> String {
    let mut text = heading(
        "The records of a scene, and how they are read.",
        "layout/records.rs",
    );
    for (list, records) in records::LISTS {
        for record in records {
            text += &declare(record).replace("LIST", list);
        }
    }
    for (function, record, what) in [
        ("shape_at", "Shape", "Returns a shape by its index"),
        ("emitter_at", "Emitter", "Returns an emitter by its index"),
        (
            "material_at",
            "Material",
            "Returns a material by its index: materials come first among the records",
        ),
    ] {
        let [lower, upper] = [record.to_lowercase(), record.to_uppercase()];
        text += &format!(
            "\n/// {what}.\nfn {function}(number: u32) -> {record} {{\n    return load_{lower}(number * {upper}_ROWS);\n}}\n"
        );
    }
    text
}
