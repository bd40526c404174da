//! Conductors and sources by the million, without names.

use lptn_laws::{Formula, Kind};
use lptn_units::{Dimension, Type};

use crate::builder::{NetworkBuilder, Path, make_room};
use crate::error::BuildErrorKind;
use crate::id::{ConductorId, End, Item, NodeId, SourceId};
use crate::law::Law;
use crate::parts::element::{Conductor, Source};
use crate::parts::label::Label;
use crate::value::Input;

/// Largest difference of the sum of a source's shares from 1.
const SHARES: f64 = 1e-9;

const CONDUCTANCE: Type = Type::of(Dimension::CONDUCTANCE);
const AREA: Type = Type::of(Dimension::AREA);

impl NetworkBuilder {
    /// Adds a conductor that is called by a number, `import.conductor[17]`. Numbers are at least 1
    /// and rise with each conductor that is added.
    pub fn numbered_conductor(
        &mut self,
        number: u32,
        kind: Kind,
        (from, to): (End, End),
        path: Path,
    ) -> ConductorId {
        let position = self.parts.conductors.len();
        self.parts.numbered_conductors.get_or_insert((position, number));
        self.push_conductor(Label::Number(number), kind, (from, to), path)
    }

    /// Adds a source that is called by a number, `import.source[17]`, as
    /// [`NetworkBuilder::numbered_conductor`].
    pub fn numbered_source(&mut self, number: u32, into: End, power: Input) -> SourceId {
        let position = self.parts.sources.len();
        self.parts.numbered_sources.get_or_insert((position, number));
        self.push_source(Label::Number(number), Kind::Source, &[(into, 1.0)], Path::heat(power))
    }

    pub(crate) fn push_conductor(
        &mut self,
        label: Label,
        kind: Kind,
        (from, to): (End, End),
        path: Path,
    ) -> ConductorId {
        let item = Item::Conductor(ConductorId::from_len(self.parts.conductors.len()));
        let law = match path {
            // nearly all conductors of a large network
            path if is_plain(&path) => path.map(|_, input| input.value),
            path => self.law(&label.of_conductor(), item, path),
        };
        self.push_law(label, kind, (from, to), law)
    }

    /// Adds a conductor with a law whose values are of the right types.
    pub(crate) fn push_law(
        &mut self,
        label: Label,
        kind: Kind,
        (from, to): (End, End),
        law: Law,
    ) -> ConductorId {
        let id = ConductorId::from_len(self.parts.conductors.len());
        let item = Item::Conductor(id);
        let name = || label.of_conductor();
        if !(self.knows(from) && self.knows(to)) {
            self.error(&name(), BuildErrorKind::ForeignId { item });
        }
        if from == to {
            self.error(&name(), BuildErrorKind::SelfLink { conductor: id });
        }
        make_room(&mut self.parts.conductors, 1);
        self.parts.conductors.push(Conductor { label, kind, from, to, law });
        id
    }

    pub(crate) fn push_source(
        &mut self,
        label: Label,
        kind: Kind,
        into: &[(End, f64)],
        law: Path,
    ) -> SourceId {
        let id = SourceId::from_len(self.parts.sources.len());
        let item = Item::Source(id);
        let name = label.of_source().into_owned();
        let law = self.law(&name, item, law);
        let sum: f64 = into.iter().map(|(_, share)| share).sum();
        let usable = into.iter().all(|(_, share)| share.is_finite() && *share >= 0.0);
        if !(usable && (sum - 1.0).abs() <= SHARES) {
            self.error(&name, BuildErrorKind::Shares { source: id, sum });
        }
        let into =
            into.iter().map(|&(end, share)| (self.heated((&name, id), end), share)).collect();
        self.parts.sources.push(Source { label, into, kind, law });
        id
    }

    /// The node that a source heats.
    fn heated(&mut self, (name, source): (&str, SourceId), end: End) -> NodeId {
        self.check_end(name, Item::Source(source), end);
        match end {
            End::Node(node) => node,
            End::Boundary(_) => {
                self.error(name, BuildErrorKind::SourceIntoBoundary { source });
                NodeId(0)
            }
        }
    }
}

/// True for a conductance or an exchange area of the right type, which need no name for messages.
fn is_plain(path: &Path) -> bool {
    let wanted = match path.formula() {
        Formula::Conductance => CONDUCTANCE,
        Formula::ExchangeArea => AREA,
        _ => return false,
    };
    path.fluid().is_none() && matches!(path.values(), [input] if input.ty == wanted)
}
