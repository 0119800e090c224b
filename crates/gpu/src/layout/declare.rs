//! Declarations in both languages: Rust types and constants, and the WGSL text of the same.

/// A type with the same bytes in Rust and in WGSL (WGSL specification, section 14.4.1).
pub(super) trait Shared {
    const NAME: &'static str;
    const ALIGN: usize;
    const SIZE: usize;
    /// Whether a record's loader turns the bits of its words into floats.
    const IS_FLOAT: bool;
}

macro_rules! shared {
    ($($rust:ty = $name:literal, $align:literal, $size:literal, $is_float:literal;)*) => {
        $(impl Shared for $rust {
            const NAME: &'static str = $name;
            const ALIGN: usize = $align;
            const SIZE: usize = $size;
            const IS_FLOAT: bool = $is_float;
        })*
    };
}

shared! {
    u32 = "u32", 4, 4, false;
    f32 = "f32", 4, 4, true;
    [u32; 2] = "vec2u", 8, 8, false;
    [f32; 2] = "vec2f", 8, 8, true;
    [f32; 3] = "vec3f", 16, 12, true;
    [f32; 4] = "vec4f", 16, 16, true;
}

/// A member of a struct as WGSL declares it.
pub(super) struct Member {
    pub(super) doc: &'static str,
    pub(super) name: &'static str,
    pub(super) wgsl_type: &'static str,
    pub(super) words: usize,
    pub(super) is_float: bool,
}

/// A declaration of `layout.wgsl`.
pub(super) struct Declaration {
    pub(super) doc: &'static str,
    pub(super) name: &'static str,
    pub(super) body: Body,
}

pub(super) enum Body {
    Struct(&'static [Member]),
    /// A struct of whole rows of the list of records, with a function that reads it from there.
    Record(&'static [Member]),
    Constant(u32),
}

pub(super) const fn larger(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

macro_rules! structs {
    ($list:ident, $body:ident; $(
        #[doc = $doc:literal]
        pub struct $name:ident {
            $(#[doc = $field_doc:literal] pub $field:ident: $type:ty,)*
        }
    )*) => {
        $(
            #[doc = $doc]
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
            pub struct $name {
                $(#[doc = $field_doc] pub $field: $type,)*
            }

            const _: () = {
                let mut end = 0;
                let mut align = 4;
                $(
                    let start = usize::next_multiple_of(end, <$type as Shared>::ALIGN);
                    assert!(
                        std::mem::offset_of!($name, $field) == start,
                        concat!("WGSL places ", stringify!($name), ".", stringify!($field), " elsewhere"),
                    );
                    end = start + <$type as Shared>::SIZE;
                    align = larger(align, <$type as Shared>::ALIGN);
                )*
                assert!(
                    std::mem::size_of::<$name>() == usize::next_multiple_of(end, align),
                    concat!("WGSL gives ", stringify!($name), " another size"),
                );
            };
        )*
        pub(super) const $list: &[Declaration] = &[$(Declaration {
            doc: $doc,
            name: stringify!($name),
            body: Body::$body(&[$(Member {
                doc: $field_doc,
                name: stringify!($field),
                wgsl_type: <$type as Shared>::NAME,
                words: <$type as Shared>::SIZE / 4,
                is_float: <$type as Shared>::IS_FLOAT,
            }),*]),
        }),*];
    };
}

macro_rules! records {
    ($list:ident; $($(#[doc = $doc:literal])* pub struct $name:ident $body:tt)*) => {
        structs! { $list, Record; $($(#[doc = $doc])* pub struct $name $body)* }
        $(impl Record for $name {}
        const _: () = assert!(size_of::<$name>().is_multiple_of(16), "a record takes whole rows");)*
    };
}

macro_rules! constants {
    ($list:ident; $(#[doc = $doc:literal] pub const $name:ident = $value:expr;)*) => {
        $(#[doc = $doc] pub const $name: u32 = $value;)*
        pub(super) const $list: &[Declaration] = &[$(Declaration {
            doc: $doc,
            name: stringify!($name),
            body: Body::Constant($name),
        }),*];
    };
}

pub(super) fn declare(declaration: &Declaration) -> String {
    let (name, doc) = (declaration.name, declaration.doc.replace(['[', ']'], ""));
    let head = format!("\n///{doc}\n");
    match declaration.body {
        Body::Constant(value) => {
            let value = format!("{value}u");
            "\n".to_owned() + &constant(&doc, name, "u32", &value)
        }
        Body::Struct(members) => head + &declare_struct(name, members),
        Body::Record(members) => {
            head + &declare_struct(name, members) + &declare_loader(name, members)
        }
    }
}

/// Returns a documented constant of WGSL.
pub(crate) fn constant(doc: &str, name: &str, kind: &str, value: &str) -> String {
    format!("///{doc}\nconst {name}: {kind} = {value};\n")
}

fn declare_struct(name: &str, members: &[Member]) -> String {
    let mut text = format!("struct {name} {{\n");
    for member in members {
        let doc = member.doc.replace(['[', ']'], "");
        text += &format!("    ///{doc}\n    {}: {},\n", member.name, member.wgsl_type);
    }
    text + "}\n"
}

/// Returns a function that reads a record, word by word of its rows.
fn declare_loader(name: &str, members: &[Member]) -> String {
    let mut next = 0;
    let values = members.iter().map(|member| {
        let words = (next..next + member.words).map(|word| {
            let word = format!("row_{}.{}", word / 4, ["x", "y", "z", "w"][word % 4]);
            if member.is_float {
                format!("bitcast<f32>({word})")
            } else {
                word
            }
        });
        let words: Vec<_> = words.collect();
        next += member.words;
        match member.words {
            1 => words.concat(),
            _ => format!("{}({})", member.wgsl_type, words.join(", ")),
        }
    });
    let values = values.collect::<Vec<_>>().join(",\n        ");
    let row = |row| format!("    let row_{row} = LIST_row(row + {row}u);\n");
    let rows = (0..next / 4).map(row).collect::<Vec<_>>().concat();
    format!(
        "const {}_ROWS: u32 = {}u;\nfn load_{}(row: u32) -> {name} {{\n{rows}    return {name}(\n        {values},\n    );\n}}\n",
        name.to_uppercase(),
        next / 4,
        name.to_lowercase(),
    )
}
