//! Checks of pipes for one set of parameters.

use lptn_laws::Range;

use super::Work;
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, End, Field, Item, NodeId};
use crate::parts::pipe::{Pipe, PipePart};

impl Work<'_> {
    /// The pipes with their numbers; those with an error are left out.
    pub(crate) fn pipes(&mut self) -> Vec<Pipe> {
        let parts = self.parts;
        parts.pipes.iter().filter_map(|part| self.pipe(part)).collect()
    }

    fn pipe(&mut self, part: &PipePart) -> Option<Pipe> {
        let item = Item::Node(part.node);
        let content = self.constant(item, Field::PipeContent, &part.content, Range::Positive);
        let start = self.constant(item, Field::Initial, &part.start, Range::Temperature);
        let streams = self.streams_of(part.node);
        if streams.is_none() {
            self.error(item, BuildErrorKind::PipeEnds { node: part.node });
        }
        let flow = self.parts.states[part.passed.index()].source?;
        Some(Pipe { node: part.node, passed: part.passed, flow, content, start, streams: streams? })
    }

    /// The stream into a node and the one out of it, if nothing else reaches it.
    fn streams_of(&self, node: NodeId) -> Option<[ConductorId; 2]> {
        let parts = self.parts;
        let (mut into, mut out) = (None, None);
        for (i, path) in parts.conductors.iter().enumerate() {
            let ends = [path.to, path.from].map(|end| end == End::Node(node));
            let place = match ends {
                [false, false] => continue,
                [true, false] => &mut into,
                _ => &mut out,
            };
            if !path.law.is_stream() || place.replace(ConductorId::from_len(i)).is_some() {
                return None;
            }
        }
        let heated = parts.sources.iter().flat_map(|source| &source.into);
        let heated = heated.into_iter().any(|(other, _)| *other == node);
        Some([into?, out?]).filter(|_| !heated)
    }
}
