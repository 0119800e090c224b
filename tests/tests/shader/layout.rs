//! Checks the layout that host and shader share: the generated files are fresh, and naga sees the same offsets as Rust.

use pellicle_tests::sources::root;
use std::collections::BTreeMap;

#[test]
fn the_generated_files_are_fresh() {
    for (name, expected) in gpu::modules::generated() {
        let path = root().join(format!("shaders/{name}.wgsl"));
        if std::env::var_os("PELLICLE_BLESS").is_some() {
            std::fs::write(&path, &expected).expect("the file can be written");
        }
        let found = std::fs::read_to_string(&path).expect("the file exists");
        assert!(
            found == expected,
            "shaders/{name}.wgsl is stale; regenerate it with PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::"
        );
    }
}

/// Constants that a scene decides are declared in one file: `true` in another would hold for every scene.
#[test]
fn other_files_declare_no_features() {
    let is_feature = |line: &str| {
        line.starts_with("override ")
            || line.starts_with("const ")
                && [": bool = true;", ": bool = false;"]
                    .iter()
                    .any(|end| line.ends_with(end))
    };
    let mut files = 0;
    for module in gpu::modules::MODULES {
        let found: Vec<_> = module
            .source
            .lines()
            .filter(|line| is_feature(line))
            .collect();
        files += usize::from(!found.is_empty());
        assert!(
            module.name == "features" || found.is_empty(),
            "{}: {found:?}",
            module.name
        );
    }
    assert_eq!(files, 1, "shaders/features.wgsl has them");
}

/// Size and offset of every member of every struct, as naga lays them out.
fn structs_of_naga() -> BTreeMap<String, (u32, BTreeMap<String, u32>)> {
    let module = naga::front::wgsl::parse_str(&gpu::layout::wgsl()).expect("layout parses");
    let mut structs = BTreeMap::new();
    for (_, ty) in module.types.iter() {
        if let naga::TypeInner::Struct { members, span } = &ty.inner {
            let offsets = members
                .iter()
                .map(|member| (member.name.clone().unwrap_or_default(), member.offset))
                .collect();
            structs.insert(ty.name.clone().unwrap_or_default(), (*span, offsets));
        }
    }
    structs
}

macro_rules! assert_layout {
    ($structs:expr, $name:ident: $($field:ident),+) => {
        let (size, offsets) = &$structs[stringify!($name)];
        assert_eq!(*size as usize, size_of::<gpu::layout::$name>(), stringify!($name));
        let expected: BTreeMap<String, u32> = [$((
            stringify!($field).to_owned(),
            std::mem::offset_of!(gpu::layout::$name, $field) as u32,
        )),+].into();
        for (field, offset) in &expected {
            assert_eq!(offsets.get(field), Some(offset), "{}.{field}", stringify!($name));
        }
    };
}

#[test]
fn naga_sees_the_offsets_of_rust() {
    let structs = structs_of_naga();
    assert_eq!(structs.len(), 5);
    assert_layout!(structs, Frame: camera_origin, seed, camera_back, image_size, first_environment, observer, first_filter);
    assert_layout!(structs, Batch: tile_origin, tile_size, first_sample, sample_count);
    assert_layout!(structs, StackRun: wavelength_count, stack_count, incident);
    assert_layout!(structs, RunLayer: medium, thickness_nm);
    assert_layout!(structs, RunStack: substrate, first_layer, layer_count);
}

/// The comparison above can fail: a struct with one more member has another size.
#[test]
fn a_shifted_member_is_noticed() {
    let shifted = gpu::layout::wgsl().replace(
        "    half_height: f32,",
        "    other: vec4u,\n    half_height: f32,",
    );
    let module = naga::front::wgsl::parse_str(&shifted).expect("still parses");
    let frame = module
        .types
        .iter()
        .find(|(_, ty)| ty.name.as_deref() == Some("Frame"));
    let naga::TypeInner::Struct { span, .. } = frame.expect("Frame exists").1.inner else {
        panic!("Frame is a struct");
    };
    assert_ne!(span as usize, size_of::<gpu::layout::Frame>());
}
