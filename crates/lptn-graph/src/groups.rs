//! Grouping of nodes and boundaries into boxes.

use std::collections::{BTreeMap, BTreeSet};

use lptn_network::{BoundaryId, Item, Network, NodeId};
use lptn_report::MORE_MEMBERS;

/// More places than this are grouped by default.
pub const MOST_PLACES: usize = 150;

/// Groups are joined further until there are no more places than this.
const READABLE: usize = 40;

/// Grouping of many nodes into boxes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// Instances of a large family as one; more if there are more than [`MOST_PLACES`].
    Auto,
    /// Always.
    Yes,
    /// Never.
    No,
}

/// Nodes or boundaries that are drawn as one box; an ungrouped one is alone in its group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) nodes: Vec<NodeId>,
    pub(crate) boundaries: Vec<BoundaryId>,
    /// Number and kind of its members, if there are several.
    pub(crate) words: Option<String>,
}

/// Levels at which names are distinguished.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    /// Every node is a separate box.
    Alone,
    /// All instances of a family of many are one box.
    Repeated,
    /// Each grid and each instance of a template is one box.
    Instances,
    /// All instances of a template, and all members of a family, are one box.
    Families,
    /// Names that differ only in the number at their end are one box.
    Numbers,
}

/// The boxes of a network, in the order of the file.
pub(crate) fn groups(network: &Network, grouping: Grouping) -> Vec<Group> {
    let places = network.nodes().len() + network.boundaries().len();
    let alone = match grouping {
        Grouping::Auto => places <= MOST_PLACES,
        Grouping::Yes => false,
        Grouping::No => true,
    };
    if alone {
        let level = if grouping == Grouping::No { Level::Alone } else { Level::Repeated };
        return at_level(network, level);
    }
    let mut found = at_level(network, Level::Instances);
    for level in [Level::Families, Level::Numbers] {
        if found.len() > READABLE {
            found = at_level(network, level);
        }
    }
    found
}

fn at_level(network: &Network, level: Level) -> Vec<Group> {
    let mut places: BTreeMap<(bool, String), usize> = BTreeMap::new();
    let mut groups: Vec<Group> = Vec::new();
    let many = many(network);
    let mut join = |boundary: bool, name: &str, label: String| {
        let key = match level {
            Level::Alone => name.to_owned(),
            Level::Repeated if !many.contains(&label) => name.to_owned(),
            _ => label,
        };
        let place = *places.entry((boundary, key.clone())).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Group { name: key, ..Group::default() });
        }
        place
    };
    let mut members: Vec<(usize, Item)> = Vec::new();
    for id in network.thermal_nodes() {
        let name = &network.nodes()[id.index()].name;
        let label = match network.whole(Item::Node(id)) {
            Some(whole) => label(&network.name_of(whole), level),
            None => label(name, level),
        };
        members.push((join(false, name, label), Item::Node(id)));
    }
    for id in network.boundary_ids() {
        let name = &network.boundaries()[id.index()].name;
        let joins = level == Level::Repeated || level >= Level::Families;
        let label = if joins { label(name, level) } else { name.clone() };
        members.push((join(true, name, label), Item::Boundary(id)));
    }
    for (place, member) in members {
        match member {
            Item::Node(id) => groups[place].nodes.push(id),
            Item::Boundary(id) => groups[place].boundaries.push(id),
            _ => {}
        }
    }
    groups.iter_mut().for_each(|group| finish(network, group));
    groups
}

/// The families of which a large number of instances has nodes or boundaries.
fn many(network: &Network) -> BTreeSet<String> {
    let nodes = network.thermal_nodes().filter(|id| network.whole(Item::Node(*id)).is_none());
    let nodes = nodes.map(|id| network.nodes()[id.index()].name.as_str());
    let boundaries = network.boundaries().iter().map(|boundary| boundary.name.as_str());
    let mut instances: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for name in nodes.chain(boundaries).filter(|name| head(name).contains('[')) {
        instances.entry(label(name, Level::Families)).or_default().insert(head(name));
    }
    let large = instances.into_iter().filter(|(_, all)| all.len() >= MORE_MEMBERS);
    large.map(|(family, _)| family).collect()
}

/// The instance that a name belongs to: `row[3]` of `row[3].base`.
fn head(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// The name of the box of a node or boundary at a level.
fn label(name: &str, level: Level) -> String {
    let head = head(name);
    let family = || match head.split_once('[') {
        Some((family, _)) => format!("{family}[*]"),
        None => head.to_owned(),
    };
    match level {
        Level::Alone => name.to_owned(),
        // a member of a family that is not an instance is a separate box
        Level::Instances => head.to_owned(),
        Level::Families | Level::Repeated => family(),
        Level::Numbers => {
            let family = family();
            let stem = family.trim_end_matches(|c: char| c.is_ascii_digit());
            let stem = stem.trim_end_matches('_');
            if stem.is_empty() || stem.len() == family.len() { family } else { format!("{stem}*") }
        }
    }
}

/// Names a box after its only member; otherwise counts the members.
fn finish(network: &Network, group: &mut Group) {
    match (group.nodes.as_slice(), group.boundaries.as_slice()) {
        ([one], []) => group.name = network.nodes()[one.index()].name.clone(),
        ([], [one]) => group.name = network.boundaries()[one.index()].name.clone(),
        (nodes, []) => {
            let grid = |id: &NodeId| match network.whole(Item::Node(*id)) {
                Some(Item::Grid(grid)) => Some(grid),
                _ => None,
            };
            let first = nodes.first().and_then(grid);
            group.words = Some(match first {
                Some(of) if nodes.iter().all(|id| grid(id) == first) => {
                    let of = &network.grids()[of.index()];
                    let cells: Vec<String> =
                        of.cells.iter().take(of.axes).map(ToString::to_string).collect();
                    format!("{} cells", cells.join(" × "))
                }
                _ => instances(network, nodes),
            });
        }
        (_, boundaries) => group.words = Some(format!("{} boundaries", boundaries.len())),
    }
}

/// "24 nodes"; if several instances have as many each, "\u{d7} 24, 2 nodes each".
fn instances(network: &Network, nodes: &[NodeId]) -> String {
    let mut sizes: BTreeMap<&str, usize> = BTreeMap::new();
    for id in nodes {
        *sizes.entry(head(&network.nodes()[id.index()].name)).or_default() += 1;
    }
    let count = sizes.len();
    let each = nodes.len() / count.max(1);
    let same = sizes.iter().all(|(name, size)| name.contains('[') && *size == each);
    match (same && count > 1, each) {
        (true, 1) => format!("\u{d7} {count}"),
        (true, each) => format!("\u{d7} {count}, {each} nodes each"),
        _ => format!("{} nodes", nodes.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Level, label};

    #[test]
    fn names_lose_what_tells_them_apart() {
        use Level::{Families, Instances, Numbers};
        for (name, level, expected) in [
            ("planet[2].gear", Instances, "planet[2]"),
            ("planet[2].gear", Families, "planet[*]"),
            ("steel", Families, "steel"),
            ("w12", Families, "w12"),
            ("w_12", Numbers, "w*"),
            ("hot[3]", Numbers, "hot[*]"),
        ] {
            assert_eq!(label(name, level), expected);
        }
    }
}
