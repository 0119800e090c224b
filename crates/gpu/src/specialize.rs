//! Reduces a module to what its entry point reaches: branches on constants are folded, and functions, constants, types and bindings
//! that are then unused are removed, before any driver sees them.

use naga::{
    Arena, Block, Constant, Expression, Function, Handle, Literal, LocalVariable, Module,
    Statement, UnaryOperator,
};
use std::collections::HashMap;

/// Removes everything from a valid module except one entry point and what it reaches.
pub(crate) fn specialize(module: &mut Module, entry_point: &str) {
    module
        .entry_points
        .retain(|entry| entry.name == entry_point);
    let truths = truths(module);
    for (_, function) in module.functions.iter_mut() {
        fold(function, &truths);
    }
    for entry in &mut module.entry_points {
        fold(&mut entry.function, &truths);
    }
    naga::compact::compact(module, naga::compact::KeepUnused::No);
}

/// The values of the boolean constants.
type Truths = HashMap<Handle<Constant>, bool>;

fn truths(module: &Module) -> Truths {
    let constants = module.constants.iter();
    let truth = |(handle, constant): (Handle<Constant>, &Constant)| match module.global_expressions
        [constant.init]
    {
        Expression::Literal(Literal::Bool(value)) => Some((handle, value)),
        _ => None,
    };
    constants.filter_map(truth).collect()
}

/// Folds the branches of a function until no branch with a known condition is left.
fn fold(function: &mut Function, truths: &Truths) {
    // Names of expressions would keep expressions alive that are no longer reached.
    function.named_expressions.clear();
    loop {
        let known = Known {
            truths,
            expressions: &function.expressions,
            stored: stored_once(function),
        };
        let mut folded = 0;
        let body = std::mem::take(&mut function.body);
        let body = known.fold(body, &mut folded);
        function.body = body;
        if folded == 0 {
            return;
        }
    }
}

/// The values of unnamed variables that are written at one place. The front end creates them for `&&` and `||`, and writes them
/// before they are read.
type Stored = HashMap<Handle<LocalVariable>, Handle<Expression>>;

fn stored_once(function: &Function) -> Stored {
    let mut stores: HashMap<_, Vec<_>> = HashMap::new();
    each_statement(&function.body, &mut |statement| {
        if let Statement::Store { pointer, value } = *statement
            && let Expression::LocalVariable(variable) = function.expressions[pointer]
            && function.local_variables[variable].name.is_none()
        {
            stores.entry(variable).or_default().push(value);
        }
    });
    let once = |(variable, values): (_, Vec<_>)| match values[..] {
        [value] => Some((variable, value)),
        _ => None,
    };
    stores.into_iter().filter_map(once).collect()
}

fn each_statement(block: &Block, look: &mut impl FnMut(&Statement)) {
    for statement in block {
        look(statement);
        match statement {
            Statement::Block(inner) => each_statement(inner, look),
            Statement::If { accept, reject, .. } => {
                each_statement(accept, look);
                each_statement(reject, look);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    each_statement(&case.body, look);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                each_statement(body, look);
                each_statement(continuing, look);
            }
            _ => {}
        }
    }
}

/// What is known about a function's conditions.
struct Known<'a> {
    truths: &'a Truths,
    expressions: &'a Arena<Expression>,
    stored: Stored,
}

impl Known<'_> {
    /// Returns the value of a condition, if it is always the same.
    fn value(&self, condition: Handle<Expression>) -> Option<bool> {
        match self.expressions[condition] {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            Expression::Constant(constant) => self.truths.get(&constant).copied(),
            Expression::Unary {
                op: UnaryOperator::LogicalNot,
                expr,
            } => self.value(expr).map(|value| !value),
            Expression::Load { pointer } => match self.expressions[pointer] {
                Expression::LocalVariable(variable) => self.value(*self.stored.get(&variable)?),
                _ => None,
            },
            _ => None,
        }
    }

    /// Returns a block in which each `if` whose condition is known is replaced by the branch that is taken; `folded` counts them.
    fn fold(&self, block: Block, folded: &mut u32) -> Block {
        let mut result = Block::with_capacity(block.len());
        for (statement, span) in block.span_into_iter() {
            let statement = match statement {
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => match self.value(condition) {
                    Some(value) => {
                        *folded += 1;
                        let taken = if value { accept } else { reject };
                        Statement::Block(self.fold(taken, folded))
                    }
                    None => Statement::If {
                        condition,
                        accept: self.fold(accept, folded),
                        reject: self.fold(reject, folded),
                    },
                },
                Statement::Block(inner) => Statement::Block(self.fold(inner, folded)),
                Statement::Switch {
                    selector,
                    mut cases,
                } => {
                    for case in &mut cases {
                        case.body = self.fold(std::mem::take(&mut case.body), folded);
                    }
                    Statement::Switch { selector, cases }
                }
                Statement::Loop {
                    body,
                    continuing,
                    break_if,
                } => Statement::Loop {
                    body: self.fold(body, folded),
                    continuing: self.fold(continuing, folded),
                    break_if,
                },
                other => other,
            };
            let ends = ends(&statement);
            result.push(statement, span);
            if ends {
                // The rest is never reached.
                break;
            }
        }
        result
    }
}

/// Whether nothing after a statement in its block is reached.
fn ends(statement: &Statement) -> bool {
    match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill => true,
        Statement::Block(inner) => inner.last().is_some_and(ends),
        Statement::If { accept, reject, .. } => {
            accept.last().is_some_and(ends) && reject.last().is_some_and(ends)
        }
        _ => false,
    }
}
