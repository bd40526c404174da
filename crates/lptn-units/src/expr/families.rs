//! `max(cell[*].T)`: an argument of `min`, `max`, `mean` or `sum` for each instance of a family.

use std::borrow::Cow;
use std::ops::Range;

use super::Expression;
use super::function::{self, Function};
use super::tree::{Id, Node, Tree};

/// The names of all members of a family, by its name with `[*]`.
type Members<'a> = &'a dyn Fn(&str) -> Option<Vec<String>>;

/// In a name: every instance.
const STAR: &str = "[*]";

impl Expression {
    /// The same expression with one argument for each instance where an argument of `min`, `max`,
    /// `mean` or `sum` names a family, `cell[*].T`. All families of one argument take the same
    /// index. A family of one leaves its argument alone. The innermost of several calls takes a family.
    ///
    /// `members` gives the names of a family. A family that it does not know, or several of
    /// different size, stay as they are.
    pub fn with_members(&self, members: Members<'_>) -> Cow<'_, Self> {
        let starred = |(node, _): &(Node, Range<usize>)| is_family(node);
        if !self.tree.nodes().any(starred) {
            return Cow::Borrowed(self);
        }
        let (to, written) = (Tree::default(), Vec::new());
        let mut copy = Copy { whole: self, from: &self.tree, members, to, written, index: None };
        copy.node(self.tree.root());
        let Copy { to, written, .. } = copy;
        let mut whole = Self { tree: to, ..self.clone() };
        // the text of an argument has the new names inside it
        let inside = |place: &Range<usize>, whole: &Range<usize>| {
            whole.start <= place.start && place.end <= whole.end
        };
        whole.renamed.retain(|(place, _)| !written.iter().any(|(whole, _)| inside(place, whole)));
        whole.renamed.extend(written);
        whole.renamed.sort_by_key(|(span, _)| span.start);
        Cow::Owned(whole)
    }
}

fn is_family(node: &Node) -> bool {
    matches!(node, Node::Name(name) if name.contains(STAR))
}

struct Copy<'a> {
    whole: &'a Expression,
    from: &'a Tree,
    members: Members<'a>,
    to: Tree,
    /// The places of arguments, and the text of their members.
    written: Vec<(Range<usize>, String)>,
    /// The member that families are replaced by.
    index: Option<usize>,
}

impl Copy<'_> {
    /// Copies a node after its operands; its new index.
    fn node(&mut self, id: Id) -> Id {
        let from = self.from;
        let new = match from.node(id) {
            Node::Name(name) => Node::Name(self.named(name)),
            Node::Negate(a) => Node::Negate(self.node(*a)),
            Node::Binary(operator, a, b) => {
                let (a, b) = (self.node(*a), self.node(*b));
                Node::Binary(*operator, a, b)
            }
            Node::Compare(comparison, a, b) => {
                let (a, b) = (self.node(*a), self.node(*b));
                Node::Compare(*comparison, a, b)
            }
            Node::Call { function, name_span, arguments } => {
                let family = takes_families(function)
                    && self.index.is_none()
                    && arguments.iter().any(|argument| self.count(*argument).is_some());
                let arguments = match family {
                    true => self.each(arguments),
                    false => arguments.iter().map(|&argument| self.node(argument)).collect(),
                };
                match arguments[..] {
                    [one] if family => {
                        // one member replaces the call
                        if let Some((_, text)) = self.written.pop() {
                            self.written.push((from.span(id), text));
                        }
                        return one;
                    }
                    _ => {
                        let (function, name_span) = (function.clone(), name_span.clone());
                        Node::Call { function, name_span, arguments }
                    }
                }
            }
            other => other.clone(),
        };
        self.to.push(new, from.span(id))
    }

    fn named(&self, name: &str) -> String {
        let member = self.index.and_then(|index| (self.members)(name)?.get(index).cloned());
        member.filter(|_| name.contains(STAR)).unwrap_or_else(|| name.to_owned())
    }

    /// The arguments, each once for every member of its families.
    fn each(&mut self, arguments: &[Id]) -> Vec<Id> {
        let mut all = Vec::new();
        for &argument in arguments {
            let Some(count) = self.count(argument) else {
                all.push(self.node(argument));
                continue;
            };
            for index in 0..count {
                self.index = Some(index);
                all.push(self.node(argument));
            }
            self.index = None;
            let each: Vec<String> = (0..count).map(|index| self.member(argument, index)).collect();
            self.written.push((self.from.span(argument), each.join(", ")));
        }
        all
    }

    /// The text of an argument for one member of its families, with the new names.
    fn member(&self, root: Id, index: usize) -> String {
        let families = (self.from.first(root)..=root).filter_map(|id| {
            let Node::Name(name) = self.from.node(id) else { return None };
            let member = (self.members)(name)?.get(index)?.clone();
            Some((self.from.span(id), member))
        });
        let families: Vec<(Range<usize>, String)> = families.collect();
        let others = self.whole.renamed.iter();
        let others = others.filter(|(span, _)| !families.iter().any(|(family, _)| family == span));
        let mut renamed: Vec<_> = others.cloned().chain(families.iter().cloned()).collect();
        renamed.sort_by_key(|(span, _)| span.start);
        self.whole.text_of(&self.from.span(root), &renamed)
    }

    /// The number of members of all families below an argument; `None` without families, or if
    /// there are others inside a further `min`, `max`, `mean` or `sum`.
    fn count(&self, root: Id) -> Option<usize> {
        let nodes = || (self.from.first(root)..=root).map(|id| self.from.node(id));
        let takes = |node: &Node| match node {
            Node::Call { function, .. } => takes_families(function),
            _ => false,
        };
        let families = nodes().filter(|node| is_family(node)).filter_map(|node| match node {
            Node::Name(name) => Some((self.members)(name).map(|names| names.len())),
            _ => None,
        });
        let counts: Vec<Option<usize>> = families.collect();
        let first = (*counts.first()?)?;
        let even = counts.iter().all(|count| *count == Some(first));
        (even && first > 0 && !nodes().any(takes)).then_some(first)
    }
}

fn takes_families(name: &str) -> bool {
    use Function::{Max, Mean, Min, Sum};
    matches!(function::find(name), Some(Min | Max | Mean | Sum))
}
