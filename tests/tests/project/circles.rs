//! Checks that the modules of a folder have an order: none uses another that uses it, directly or through others.
//!
//! A folder counts as one module with all that it contains, and what a module passes on with `pub use` counts where it is declared. A
//! module and the modules inside it may use each other: a parent calls its children, and they use the types that it declares. Unit tests
//! may use anything. Paths among the arguments of macros are not seen.

use pellicle_tests::sources::sources;
use std::collections::{BTreeMap, BTreeSet};
use syn::visit::{self, Visit};
use syn::{Attribute, ItemMod, ItemUse, UseTree};

/// Crates whose modules still have circles.
const KNOWN: &[&str] = &[];

/// The names from a crate's root to a module, or of an item.
type Names = Vec<String>;

/// What is used by each module of a folder.
type Arrows = BTreeMap<String, BTreeSet<String>>;

/// What a file uses.
#[derive(Default)]
struct Module {
    /// The names that `use` brings in, with their paths.
    imported: BTreeMap<String, Names>,
    /// All paths.
    paths: Vec<Names>,
}

impl Module {
    fn parse(text: &str) -> Self {
        let mut module = Self::default();
        module.visit_file(&syn::parse_file(text).expect("the source is Rust"));
        module
    }

    fn import(&mut self, tree: &UseTree, before: &Names) {
        let path = |name: &str| match name {
            "self" => before.clone(),
            _ => [before.clone(), vec![name.to_owned()]].concat(),
        };
        let (path, alias) = match tree {
            UseTree::Path(inner) => {
                return self.import(&inner.tree, &path(&inner.ident.to_string()));
            }
            UseTree::Group(group) => {
                return group
                    .items
                    .iter()
                    .for_each(|tree| self.import(tree, before));
            }
            UseTree::Name(name) => (path(&name.ident.to_string()), None),
            UseTree::Rename(name) => (path(&name.ident.to_string()), Some(name.rename.to_string())),
            UseTree::Glob(_) => (before.clone(), Some("*".to_owned())),
        };
        let alias = alias.or_else(|| path.last().cloned());
        self.imported
            .extend(alias.map(|alias| (alias, path.clone())));
        self.paths.push(path);
    }
}

impl Visit<'_> for Module {
    fn visit_item_mod(&mut self, item: &ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_use(&mut self, item: &ItemUse) {
        if !is_for_tests(&item.attrs) {
            self.import(&item.tree, &Names::new());
        }
    }

    fn visit_path(&mut self, path: &syn::Path) {
        let names = path.segments.iter().map(|name| name.ident.to_string());
        self.paths.push(names.collect());
        visit::visit_path(self, path);
    }
}

fn is_for_tests(attributes: &[Attribute]) -> bool {
    let mut lists = attributes.iter().filter_map(|a| a.meta.require_list().ok());
    lists.any(|list| list.path.is_ident("cfg") && list.tokens.to_string() == "test")
}

/// The modules of a crate.
struct Modules(BTreeMap<Names, Module>);

impl Modules {
    /// The modules of files, given with their paths from the crate's `src`.
    fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let module = |(path, text): (&str, &str)| {
            let names = path.trim_end_matches(".rs").split('/');
            let mut names: Names = names.map(str::to_owned).collect();
            names.pop_if(|last| ["lib", "main", "mod"].contains(&last.as_str()));
            let is_test = names.iter().any(|name| name == "tests");
            (!is_test).then(|| (names, Module::parse(text)))
        };
        Self(files.into_iter().filter_map(module).collect())
    }

    /// The module that declares what a path in the module `from` means; `None` if it is not in this crate.
    fn declares(&self, from: &[String], path: &[String]) -> Option<Names> {
        let (first, rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Names::new(),
            "self" => from.to_vec(),
            "super" => from.split_last()?.1.to_vec(),
            name => return self.named(from, name, rest),
        };
        let mut rest = rest;
        while let Some((_, after)) = rest.split_first().filter(|(name, _)| *name == "super") {
            at.pop();
            rest = after;
        }
        match rest.split_first() {
            Some((name, rest)) => self.named(&at, name, rest).or(Some(at)),
            None => Some(at),
        }
    }

    /// The same for a path that begins with a name in the module `at`: of a module in it, or imported.
    fn named(&self, at: &[String], name: &str, rest: &[String]) -> Option<Names> {
        let inner = [at.to_vec(), vec![name.to_owned()]].concat();
        if self.0.contains_key(&inner) {
            let found = rest.split_first();
            let found = found.and_then(|(name, rest)| self.named(&inner, name, rest));
            return found.or(Some(inner));
        }
        let imported = self.0.get(at)?.imported.get(name)?;
        let is_itself = imported.first().is_some_and(|first| first == name);
        let full = [imported.clone(), rest.to_vec()].concat();
        (!is_itself).then(|| self.declares(at, &full))?
    }

    /// What the modules directly in a folder use of each other.
    fn arrows(&self, folder: &[String]) -> Arrows {
        let inside = |names: &[String]| names.strip_prefix(folder)?.first().cloned();
        let mut arrows = Arrows::new();
        for (from, module) in &self.0 {
            let Some(own) = inside(from) else { continue };
            let used = module.paths.iter();
            let used = used.filter_map(|path| inside(&self.declares(from, path)?));
            let others = used.filter(|used| *used != own);
            arrows.entry(own.clone()).or_default().extend(others);
        }
        arrows
    }

    /// A circle in each folder that has one.
    fn circles(&self) -> Vec<String> {
        let folders = self.0.keys().filter_map(|names| names.split_last());
        let folders: BTreeSet<&[String]> = folders.map(|(_, folder)| folder).collect();
        let circle = |folder: &[String]| {
            let circle = circle(self.arrows(folder))?;
            let folder: String = folder
                .iter()
                .flat_map(|name| [name.as_str(), "/"])
                .collect();
            Some(format!("{folder}{{{}}}", circle.join(" -> ")))
        };
        folders.into_iter().filter_map(circle).collect()
    }
}

/// A circle of arrows, with its first name again at its end.
fn circle(mut arrows: Arrows) -> Option<Names> {
    loop {
        let open: BTreeSet<String> = arrows.keys().cloned().collect();
        for targets in arrows.values_mut() {
            targets.retain(|name| open.contains(name));
        }
        arrows.retain(|_, targets| !targets.is_empty());
        if arrows.len() == open.len() {
            break;
        }
    }
    // Every name that is left leads to another one.
    let mut walk = vec![arrows.keys().next()?.clone()];
    loop {
        let next = arrows[walk.last()?].first()?.clone();
        let met = walk.iter().position(|name| *name == next);
        walk.push(next);
        if let Some(met) = met {
            return Some(walk.split_off(met));
        }
    }
}

/// The circles of each crate that has some.
fn found() -> BTreeMap<String, Vec<String>> {
    let sources = sources();
    let mut crates: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
    for source in sources.iter().filter(|source| source.ends_in("rs")) {
        if let Some((name, path)) = source.path.split_once("/src/") {
            crates.entry(name).or_default().push((path, &source.text));
        }
    }
    assert!(crates.len() > 12 && crates.contains_key("crates/spectra"));
    let circles = crates.into_iter().map(|(name, files)| {
        let circles = Modules::of(files).circles();
        (name.to_owned(), circles)
    });
    circles.filter(|(_, circles)| !circles.is_empty()).collect()
}

#[test]
fn modules_have_an_order() {
    let found = found();
    let new = found
        .iter()
        .filter(|(name, _)| !KNOWN.contains(&name.as_str()));
    let new: Vec<_> = new
        .map(|(name, circles)| format!("{name}: {}", circles.join(", ")))
        .collect();
    assert!(new.is_empty(), "{}", new.join("\n"));
    let solved = KNOWN.iter().filter(|name| !found.contains_key(**name));
    let solved: Vec<_> = solved.collect();
    assert!(solved.is_empty(), "without circles: {solved:?}");
}

fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    Modules::of(files.iter().copied()).circles()
}

#[test]
fn a_circle_is_noticed() {
    let root = (
        "lib.rs",
        "mod a; mod b; mod c; pub use a::{A, make as made};",
    );
    let a = (
        "a.rs",
        "use crate::b::{self, B}; pub struct A(B); pub fn make() {}",
    );
    let b = ("b.rs", "pub struct B(super::c::C);");
    for c in [
        "use crate::A;",
        "use super::made;",
        "fn f() { crate::a::make() }",
        "use super::*; use crate::a::*;",
    ] {
        assert_eq!(
            circles_of(&[root, a, b, ("c.rs", c)]),
            ["{a -> b -> c -> a}"],
            "{c}"
        );
    }
    for c in [
        "",
        "use std::a::A;",
        "#[cfg(test)] mod tests { use crate::A; }",
        "#[cfg(test)] use crate::A;",
    ] {
        assert!(circles_of(&[root, a, b, ("c.rs", c)]).is_empty(), "{c}");
    }
}

#[test]
fn a_folder_is_one_module_and_its_parent_may_use_it() {
    let root = ("lib.rs", "mod x; mod z;");
    let x = ("x/mod.rs", "mod p; mod q; pub struct X; use p::P;");
    let p = ("x/p.rs", "use super::X; pub struct P; use super::q::Q;");
    let (q, z) = (("x/q.rs", "pub struct Q;"), ("z.rs", "use crate::x::X;"));
    assert!(circles_of(&[root, x, p, q, z]).is_empty());
    let through = ("x/q.rs", "use crate::z; pub struct Q;");
    assert_eq!(circles_of(&[root, x, p, through, z]), ["{x -> z -> x}"]);
    let back = ("x/q.rs", "use super::p; pub struct Q;");
    assert_eq!(circles_of(&[root, x, p, back, z]), ["x/{p -> q -> p}"]);
}
