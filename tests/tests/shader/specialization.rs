//! The shader of a scene contains what the scene needs and no more, in both forms of its tables. No device is needed.

use gpu::modules::{Shader, Specialization};
use gpu::{Feature, PackedScene};
use naga::{Block, Expression, Function, Handle, Literal, Module, Statement};
use pellicle_tests::scenes::{BANDS, all, made_polarized, small};
use std::collections::{BTreeMap, BTreeSet};

fn made_for(name: &str, is_software: bool) -> Specialization {
    PackedScene::new(&small(name, [96, 72], 16, BANDS, 1)).specialization(is_software)
}

fn shader(made_for: &Specialization) -> Shader {
    Shader::assemble(made_for, "")
}

fn functions(module: &Module) -> BTreeSet<String> {
    let functions = module.functions.iter();
    functions.filter_map(|(_, f)| f.name.clone()).collect()
}

#[test]
fn specialized_shaders_are_valid_and_bind_few_buffers() {
    for name in all().into_iter().chain(made_polarized()) {
        for is_software in [false, true] {
            let module = shader(&made_for(name, is_software)).specialized("render");
            let module = module.unwrap_or_else(|error| panic!("{name}: {error}"));
            let flags = naga::valid::ValidationFlags::all();
            naga::valid::Validator::new(flags, naga::valid::Capabilities::empty())
                .validate(&module)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string("")));
            let count = |wanted: fn(naga::AddressSpace) -> bool| {
                let variables = module.global_variables.iter();
                variables.filter(|(_, v)| wanted(v.space)).count()
            };
            let storage = count(|space| matches!(space, naga::AddressSpace::Storage { .. }));
            let uniform = count(|space| space == naga::AddressSpace::Uniform);
            println!(
                "{name}: {} functions, {storage} storage and {uniform} uniform buffers",
                module.functions.len()
            );
            assert!(storage <= 6, "{name}: {storage} storage buffers");
            assert!(uniform <= 12, "{name}: {uniform} uniform buffers");
            assert!(!is_software || storage < 3, "{name}: {storage}");
        }
    }
}

/// Finds the functions that can run without folding branches: it walks from the entry point through everything except
/// code behind a condition that is false whatever the rest is.
struct Walk<'a> {
    module: &'a Module,
    reached: BTreeSet<Handle<Function>>,
}

impl<'a> Walk<'a> {
    fn of(module: &'a Module) -> BTreeSet<String> {
        let mut walk = Self {
            module,
            reached: BTreeSet::new(),
        };
        let entry = module.entry_points.iter().find(|e| e.name == "render");
        let function = &entry.expect("the entry point exists").function;
        walk.function(function);
        let reached = walk.reached.iter();
        let names = reached.filter_map(|&handle| module.functions[handle].name.clone());
        names.collect()
    }

    fn function(&mut self, function: &'a Function) {
        let mut written = BTreeMap::new();
        self.block(function, &function.body, &mut written);
    }

    /// Walks a block and returns whether the code after it may run. `written` maps variables to the values that were last written to
    /// them, as far as these are known.
    fn block(
        &mut self,
        function: &'a Function,
        block: &'a Block,
        written: &mut BTreeMap<u32, Option<bool>>,
    ) -> bool {
        block.iter().all(|statement| match statement {
            Statement::Call { function: call, .. } => {
                if self.reached.insert(*call) {
                    self.function(&self.module.functions[*call]);
                }
                true
            }
            Statement::Store { pointer, value } => {
                if let Expression::LocalVariable(variable) = function.expressions[*pointer] {
                    let value = self.value(function, *value, written);
                    written.insert(variable.index() as u32, value);
                }
                true
            }
            Statement::If {
                condition,
                accept,
                reject,
            } => match self.value(function, *condition, written) {
                Some(true) => self.block(function, accept, written),
                Some(false) => self.block(function, reject, written),
                None => {
                    let mut other = written.clone();
                    let after_accept = self.block(function, accept, written);
                    let after_reject = self.block(function, reject, &mut other);
                    if !after_accept {
                        *written = other;
                    } else if after_reject {
                        for (variable, value) in other {
                            let here = written.entry(variable).or_insert(None);
                            if *here != value {
                                *here = None;
                            }
                        }
                    }
                    after_accept || after_reject
                }
            },
            Statement::Block(inner) => self.block(function, inner, written),
            Statement::Loop {
                body, continuing, ..
            } => {
                // The writes of a loop are not known in its first pass either.
                let mut within = BTreeMap::new();
                self.block(function, body, &mut within);
                self.block(function, continuing, &mut within);
                written.clear();
                true
            }
            Statement::Switch { .. } => panic!("the shaders contain no switch"),
            Statement::Return { .. } | Statement::Break | Statement::Continue => false,
            _ => true,
        })
    }

    fn value(
        &self,
        function: &Function,
        condition: Handle<Expression>,
        written: &BTreeMap<u32, Option<bool>>,
    ) -> Option<bool> {
        match function.expressions[condition] {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            Expression::Constant(constant) => {
                let init = self.module.constants[constant].init;
                match self.module.global_expressions[init] {
                    Expression::Literal(Literal::Bool(value)) => Some(value),
                    _ => None,
                }
            }
            Expression::Unary {
                op: naga::UnaryOperator::LogicalNot,
                expr,
            } => self.value(function, expr, written).map(|value| !value),
            Expression::Load { pointer } => match function.expressions[pointer] {
                Expression::LocalVariable(variable) => {
                    written.get(&(variable.index() as u32)).copied().flatten()
                }
                _ => None,
            },
            _ => None,
        }
    }
}

#[test]
fn removed_functions_cannot_run() {
    let mut removed = 0;
    for name in all().into_iter().chain(made_polarized()) {
        let shader = shader(&made_for(name, false));
        let whole = shader.parse().expect("valid");
        let left = functions(&shader.specialized("render").expect("valid"));
        assert_eq!(left, Walk::of(&whole), "{name}");
        removed += whole.functions.len() - left.len();
    }
    assert!(removed > 1000, "only {removed} functions were removed");
}

/// The proof above can fail: functions that one scene lacks are reached in another.
#[test]
fn functions_that_another_scene_needs_can_run() {
    let wedge = made_for("film_wedge", false);
    let left = functions(&shader(&wedge).specialized("render").expect("valid"));
    assert!(!left.contains("stack_layer") && left.contains("clear_film_reflectance"));
    let features = wedge.features.with(Feature::Stacks, true);
    let with_stacks = Specialization { features, ..wedge };
    let reached = Walk::of(&shader(&with_stacks).parse().expect("valid"));
    assert!(reached.contains("stack_layer"));
    assert_ne!(left, reached);
}

/// A feature that no surface names is missing everywhere.
#[test]
fn some_scene_has_each_feature_of_surfaces() {
    let scenes = all();
    let features = scenes.iter().map(|name| made_for(name, false).features);
    let features: Vec<_> = features.collect();
    for feature in Feature::ALL.iter().copied().filter(|f| f.is_of_surfaces()) {
        let count = features.iter().filter(|of| of.has(feature)).count();
        println!("{feature:?}: {count} of {} scenes", features.len());
        assert!(count > 0, "{feature:?}");
    }
}

/// Bytes of private memory of an invocation: the path's record, the paths that wait, and the data between the two halves of a sample.
fn private_bytes(name: &str) -> u32 {
    let module = shader(&made_for(name, false)).specialized("render");
    let module = module.unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut layouter = naga::proc::Layouter::default();
    layouter.update(module.to_ctx()).expect("all have a size");
    let variables = module.global_variables.iter();
    let private = variables.filter(|(_, v)| v.space == naga::AddressSpace::Private);
    private.map(|(_, v)| layouter[v.ty].size).sum()
}

/// docs/performance.md reports these numbers: the memory of a path decides how many paths a GPU follows at a time.
#[test]
fn a_path_takes_little_memory() {
    for (name, most) in [
        ("bench/bubble", 1536),
        ("bench/metals", 512),
        ("bench/wedge", 512),
        ("everything", 8192),
    ] {
        let bytes = private_bytes(name);
        println!("{name}: {bytes} bytes");
        assert!(bytes <= most, "{name}: {bytes} bytes");
        assert!(
            bytes > most / 8,
            "{name}: {bytes} bytes: much less than before"
        );
    }
}
