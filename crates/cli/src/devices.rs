//! `pellicle devices`.

use pellicle::gpu::{INSTALL_HINT, adapters};

/// Lists the adapters, the one that `--backend auto` takes first.
pub(crate) fn print() {
    let found = adapters();
    if found.is_empty() {
        println!("no Vulkan, Metal or DX12 driver found; renders run on the CPU\n{INSTALL_HINT}");
    }
    for (index, adapter) in found.iter().enumerate() {
        let default = if index == 0 { "  [default]" } else { "" };
        println!("{adapter}{default}");
        let limits = &adapter.limits;
        println!(
            "    storage binding {}, buffer {}, workgroup {} invocations, {} storage buffers per stage",
            mebibytes(limits.max_storage_buffer_binding_size),
            mebibytes(limits.max_buffer_size),
            limits.max_compute_invocations_per_workgroup,
            limits.max_storage_buffers_per_shader_stage,
        );
    }
}

fn mebibytes(bytes: u64) -> String {
    format!("{} MiB", bytes >> 20)
}
