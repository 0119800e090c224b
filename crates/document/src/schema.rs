//! The JSON Schema of types that are read from files.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

/// The JSON Schema (draft 7, which TOML editors understand) of files that are read as `T`.
pub fn schema_of<T: JsonSchema>() -> Value {
    let mut schema = SchemaSettings::draft07()
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value();
    remove_null(&mut schema);
    spread_shared_fields(&mut schema);
    schema
}

/// Handles a table with shared fields besides those of several forms: each form gets the shared fields too, and then allows no others, like
/// any other table.
fn spread_shared_fields(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            let is_mixed = object.contains_key("anyOf") && object.contains_key("properties");
            if is_mixed && let Some(Value::Object(shared)) = object.remove("properties") {
                object.remove("type");
                let forms = object.get_mut("anyOf").and_then(Value::as_array_mut);
                for form in forms.into_iter().flatten() {
                    form["additionalProperties"] = false.into();
                    if let Some(own) = form["properties"].as_object_mut() {
                        own.extend(shared.clone());
                    }
                }
            }
            object.values_mut().for_each(spread_shared_fields);
        }
        Value::Array(items) => items.iter_mut().for_each(spread_shared_fields),
        _ => {}
    }
}

/// Removes null, which TOML lacks: optional fields are left out. `anyOf [X, null]` becomes X, and a default of null is removed.
fn remove_null(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            object.retain(|key, value| key != "default" || !value.is_null());
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|kind| kind != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".to_owned(), only);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice.get("type").is_none_or(|kind| kind != "null"));
                if choices.len() == 1
                    && let Some(only) = object.remove("anyOf")
                {
                    object.insert("allOf".to_owned(), only);
                }
            }
            object.values_mut().for_each(remove_null);
        }
        Value::Array(items) => items.iter_mut().for_each(remove_null),
        _ => {}
    }
}
