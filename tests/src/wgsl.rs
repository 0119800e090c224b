//! Reading WGSL text: what it declares and what it uses.

use std::collections::BTreeSet;

/// The identifiers of a WGSL text in order, without comments and numbers; a name after a dot keeps the dot.
pub fn identifiers(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    for line in source.lines() {
        let code = line.split("//").next().unwrap_or("");
        let mut word = String::new();
        let mut before = ' ';
        for c in code.chars().chain([' ']) {
            if c.is_alphanumeric() || c == '_' {
                if word.is_empty() && before == '.' {
                    word.push('.');
                }
                word.push(c);
            } else if !word.is_empty() {
                let first = word.chars().next().unwrap_or('0');
                if !first.is_ascii_digit() {
                    found.push(std::mem::take(&mut word));
                }
                word.clear();
            }
            before = c;
        }
    }
    found
}

/// Names that a WGSL text declares at module scope: functions, structs, constants, variables.
pub fn declarations(source: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for line in source.lines() {
        // Declarations start at the beginning of a line, after attributes.
        let code = line
            .rsplit(") var")
            .next()
            .filter(|_| line.starts_with('@'))
            .map_or_else(|| line.to_owned(), |rest| format!("var{rest}"));
        let keyword = code.split([' ', '<']).next().unwrap_or("");
        if !["fn", "struct", "const", "override", "var"].contains(&keyword) {
            continue;
        }
        let after = match code.find('>') {
            Some(end) if code.starts_with("var<") => &code[end + 1..],
            _ => &code[keyword.len()..],
        };
        names.extend(identifiers(after).into_iter().next());
    }
    names
}

/// Names of the functions that a WGSL text declares.
pub fn functions(source: &str) -> BTreeSet<String> {
    let heads = source.lines().filter_map(|line| line.strip_prefix("fn "));
    heads
        .filter_map(|rest| identifiers(rest).into_iter().next())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "// fn comment()\n@group(0) @binding(1) var<storage, read> objects: array<Object>;\n\
        var table: texture_2d<f32>;\n\
        const PI: f32 = 3.1; // PI\nstruct Ray {\n    origin: vec3f,\n}\nvar<private> count: u32;\n\
        fn hit(ray: Ray) -> f32 {\n    let first = objects[0].radius * 2u;\n    return first;\n}\n";

    #[test]
    fn declarations_are_found() {
        let expected = ["PI", "Ray", "count", "hit", "objects", "table"].map(String::from);
        assert_eq!(declarations(SOURCE), BTreeSet::from(expected));
        assert_eq!(functions(SOURCE), BTreeSet::from(["hit".to_owned()]));
    }

    #[test]
    fn identifiers_leave_out_comments_and_numbers_and_mark_members() {
        let found = identifiers(SOURCE);
        assert!(found.contains(&".radius".to_owned()));
        assert!(!found.contains(&"comment".to_owned()) && !found.contains(&"2u".to_owned()));
    }
}
