//! Adds pipes with plug flow.

use lptn_units::Type;

use crate::builder::NetworkBuilder;
use crate::id::{Field, Item, NodeId, StateId};
use crate::parts::pipe::PipePart;
use crate::value::Input;

impl NetworkBuilder {
    /// Makes a massless node with one stream into it and one out of it a pipe with plug flow.
    ///
    /// `passed` is a state whose rate is the flow; `content` has its type, `start` is the
    /// temperature of the content at the start.
    pub fn pipe(&mut self, node: NodeId, passed: StateId, content: Input, start: Input) {
        let (name, item) = (self.parts.nodes[node.index()].name.clone(), Item::Node(node));
        let ty = self.parts.states[passed.index()].ty;
        let content = self.typed((&name, item, Field::PipeContent), content, ty);
        let start = self.typed((&name, item, Field::Initial), start, Type::ABSOLUTE_TEMPERATURE);
        self.parts.pipes.push(PipePart { node, passed, content, start });
    }
}
