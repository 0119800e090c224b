//! `pellicle devices`.

use crate::print;
use pellicle::gpu::{INSTALL_HINT, adapters};

/// Lists the adapters, starting with the one that `--backend auto` uses.
pub(crate) fn print() -> miette::Result<()> {
    let found = adapters();
    if found.is_empty() {
        print::result("no Vulkan, Metal or DX12 driver found; renders run on the CPU")?;
        print::result(INSTALL_HINT)?;
    }
    for (index, adapter) in found.iter().enumerate() {
        let default = if index == 0 { "  [default]" } else { "" };
        print::result(format_args!("{adapter}{default}"))?;
        let limits = &adapter.limits;
        print::result(format_args!(
            "    storage binding {}, buffer {}, workgroup {} invocations, {} storage buffers per stage",
            mebibytes(limits.max_storage_buffer_binding_size),
            mebibytes(limits.max_buffer_size),
            limits.max_compute_invocations_per_workgroup,
            limits.max_storage_buffers_per_shader_stage,
        ))?;
    }
    Ok(())
}

fn mebibytes(bytes: u64) -> String {
    format!("{} MiB", bytes >> 20)
}
