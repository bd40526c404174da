//! Items by name, without a second copy of the names.

use crate::id::Item;

/// Items by the hash of their name; the items have the names. Nothing depends on the order of its
/// slots.
#[derive(Clone, Debug, Default)]
pub(crate) struct NameIndex {
    /// Their number is a power of two; at most two thirds are taken.
    slots: Vec<Option<(u32, Item)>>,
    taken: usize,
}

impl NameIndex {
    /// The item of this name for which `is` is true.
    pub(crate) fn find(&self, name: &str, is: impl Fn(Item) -> bool) -> Option<Item> {
        let hash = hash(name);
        let mut at = self.start(hash);
        while let Some((found, item)) = *self.slots.get(at)? {
            if found == hash && is(item) {
                return Some(item);
            }
            at = (at + 1) & (self.slots.len() - 1);
        }
        None
    }

    /// Adds an item whose name is not there yet.
    pub(crate) fn insert(&mut self, name: &str, item: Item) {
        if 3 * (self.taken + 1) > 2 * self.slots.len() {
            let slots = vec![None; (2 * self.slots.len()).max(16)];
            let old = std::mem::replace(&mut self.slots, slots);
            old.into_iter().flatten().for_each(|(hash, item)| self.put(hash, item));
        }
        self.put(hash(name), item);
        self.taken += 1;
    }

    fn put(&mut self, hash: u32, item: Item) {
        let mut at = self.start(hash);
        while self.slots[at].is_some() {
            at = (at + 1) & (self.slots.len() - 1);
        }
        self.slots[at] = Some((hash, item));
    }

    fn start(&self, hash: u32) -> usize {
        hash as usize & self.slots.len().wrapping_sub(1)
    }
}

/// The upper half of a product of words of 8 bytes, into which every bit goes. Names made to
/// collide would only cost time.
fn hash(name: &str) -> u32 {
    // 2^64 over the golden ratio (D. E. Knuth, The Art of Computer Programming 3, section 6.4)
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;
    let mut hash = name.len() as u64;
    for chunk in name.as_bytes().chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        hash = (hash.rotate_left(29) ^ u64::from_le_bytes(word)).wrapping_mul(FACTOR);
        hash ^= hash >> 32;
    }
    let [a, b, c, d, ..] = hash.wrapping_mul(FACTOR).to_be_bytes();
    u32::from_be_bytes([a, b, c, d])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::NodeId;

    #[test]
    fn items_are_found_by_their_names_and_others_not() {
        let names: Vec<String> = (0..5000).map(|i| format!("n{i}")).collect();
        let mut index = NameIndex::default();
        let is = |name: &'static str| move |_: Item| name.is_empty();
        assert_eq!(index.find("n0", is("")), None);
        for (i, name) in names.iter().enumerate() {
            index.insert(name, Item::Node(NodeId::from_len(i)));
        }
        let find = |name: &str| {
            index.find(name, |item| matches!(item, Item::Node(id) if names[id.index()] == name))
        };
        for (i, name) in names.iter().enumerate() {
            assert_eq!(find(name), Some(Item::Node(NodeId::from_len(i))));
        }
        assert_eq!(find("n5000"), None);
    }
}
