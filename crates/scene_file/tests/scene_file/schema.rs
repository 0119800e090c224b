//! The committed JSON Schema is the one generated from the types, and agrees with the reader.

use pellicle_scene_file::SceneFile;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

#[test]
fn the_committed_schema_is_fresh() {
    let path = scenes().join("scene.schema.json");
    let mut fresh = serde_json::to_string_pretty(&pellicle_scene_file::schema()).unwrap();
    fresh.push('\n');
    if std::env::var_os("PELLICLE_BLESS").is_some() {
        std::fs::write(&path, &fresh).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    assert!(
        committed == fresh,
        "scenes/scene.schema.json is stale; run PELLICLE_BLESS=1 cargo test --release -p pellicle-scene-file schema"
    );
}

/// Finds every table of the schema, with its path.
fn tables<'a>(schema: &'a Value, way: &str, found: &mut Vec<(String, &'a Value)>) {
    match schema {
        Value::Object(object) => {
            if object.get("type").is_some_and(|kind| kind == "object") {
                found.push((way.to_owned(), schema));
            }
            for (key, value) in object {
                tables(value, &format!("{way}/{key}"), found);
            }
        }
        Value::Array(items) => {
            for (index, value) in items.iter().enumerate() {
                tables(value, &format!("{way}/{index}"), found);
            }
        }
        _ => {}
    }
}

#[test]
fn the_schema_refuses_unknown_fields_and_null_everywhere() {
    let schema = pellicle_scene_file::schema();
    let mut found = Vec::new();
    tables(&schema, "", &mut found);
    assert!(found.len() > 20, "only {} tables found", found.len());
    for (way, table) in found {
        let additional = &table["additionalProperties"];
        assert!(
            additional == false || additional.is_object(),
            "{way} accepts unknown fields"
        );
    }
    let text = schema.to_string();
    assert!(!text.contains("null"), "TOML has no null");
}

#[test]
fn every_field_of_the_schema_explains_itself() {
    let schema = pellicle_scene_file::schema();
    let mut found = Vec::new();
    tables(&schema, "", &mut found);
    for (way, table) in found {
        for (name, property) in table["properties"].as_object().into_iter().flatten() {
            let explained = property["description"].is_string() || name == "type";
            assert!(explained, "{way}: {name} has no description");
        }
    }
}

#[test]
fn every_shipped_scene_is_valid() {
    let mut count = 0;
    for entry in std::fs::read_dir(scenes()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        count += 1;
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(
            text.starts_with("#:schema ./scene.schema.json\n"),
            "{} does not name its schema",
            path.display()
        );
        let file = SceneFile::read(&path).unwrap_or_else(|problems| panic!("{problems:#}"));
        if let Err(problems) = file.validate() {
            panic!("{problems:#}");
        }
    }
    assert!(count >= 4, "only {count} scenes found");
}

#[test]
fn lists_of_layers_have_bounds() {
    let schema = pellicle_scene_file::schema();
    let mut found = Vec::new();
    tables(&schema, "", &mut found);
    let lists: Vec<_> = found
        .iter()
        .map(|(_, table)| &table["properties"]["layers"])
        .filter(|layers| !layers.is_null())
        .collect();
    assert_eq!(lists.len(), 2, "of films and coatings");
    for layers in lists {
        assert_eq!(
            (&layers["minItems"], &layers["maxItems"]),
            (&1.into(), &64.into())
        );
    }
}
