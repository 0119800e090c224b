//! The hierarchy of boxes around objects and the tree of emitters, depth first, for traversal by loops without a stack.

use super::vec3;
use crate::layout::{self, NONE, Record};
use scene::{EmitterTree, Hierarchy};

/// The rows of both trees.
#[derive(Debug, Default)]
pub(super) struct Trees {
    pub(super) rows: Vec<[u32; 4]>,
    /// Rows of the hierarchy, which comes first; 0 where objects are few.
    pub(super) hierarchy_rows: u32,
    /// The row of the first node of the tree of emitters.
    pub(super) first_emitter_node: u32,
    /// The row of the node of each emitter.
    pub(super) emitter_nodes: Vec<u32>,
}

impl Trees {
    pub(super) fn new(hierarchy: &Hierarchy, lights: &EmitterTree) -> Self {
        let mut trees = Self::default();
        if !hierarchy.nodes.is_empty() {
            for &object in &hierarchy.everywhere {
                trees.object(object);
            }
            trees.node(hierarchy, 0);
        }
        trees.hierarchy_rows = trees.rows.len() as u32;
        trees.first_emitter_node = trees.hierarchy_rows;
        trees.lights(lights);
        trees
    }

    fn push<R: Record>(&mut self, record: R) {
        self.rows.extend_from_slice(bytemuck::cast_slice(&[record]));
    }

    /// Adds an object that is tested for every ray that gets here.
    fn object(&mut self, object: u32) {
        self.push(layout::Node {
            low: [f32::MIN; 3],
            next: self.rows.len() as u32 + layout::Node::ROWS,
            high: [f32::MAX; 3],
            object,
        });
    }

    /// Adds a box with all its contents.
    fn node(&mut self, hierarchy: &Hierarchy, node: usize) {
        let of = &hierarchy.nodes[node];
        let place = self.rows.len();
        self.push(layout::Node::default());
        let (first, count) = (of.first as usize, of.count as usize);
        let objects = &hierarchy.leaves[first..first + count];
        let only = match *objects {
            [only] => Some(only),
            _ => None,
        };
        if count == 0 {
            self.node(hierarchy, first);
            self.node(hierarchy, first + 1);
        } else if only.is_none() {
            for &object in objects {
                self.object(object);
            }
        }
        let packed = layout::Node {
            low: vec3(of.low),
            next: self.rows.len() as u32,
            high: vec3(of.high),
            object: only.unwrap_or(NONE),
        };
        let rows: [[u32; 4]; layout::Node::ROWS as usize] = bytemuck::cast(packed);
        self.rows[place..place + rows.len()].copy_from_slice(&rows);
    }

    fn lights(&mut self, lights: &EmitterTree) {
        let first = self.first_emitter_node;
        let row = |node: u32| first + node * layout::EmitterNode::ROWS;
        let row_or_none = |node: u32| {
            if node == EmitterTree::NONE {
                NONE
            } else {
                row(node)
            }
        };
        for node in &lights.nodes {
            self.push(layout::EmitterNode {
                center: vec3(node.center),
                reach: node.reach as f32,
                axis: vec3(node.axis),
                cone: node.cone as f32,
                power: node.power as f32,
                variance: node.variance as f32,
                even: node.even as f32,
                along: node.along as f32,
                near: node.near as f32,
                next: row(node.next),
                parent: row_or_none(node.parent),
                emitter: if node.source == EmitterTree::NONE {
                    NONE
                } else {
                    node.source
                },
            });
        }
        self.emitter_nodes = lights.leaves.iter().map(|&node| row(node)).collect();
    }
}
