//! What waits for analyses that lptn does not have yet.

/// What may go unanswered.
#[derive(Clone, Copy)]
pub struct Waiting<'a> {
    /// Pairs of case and quantity.
    pub list: &'a [(&'a str, &'a str)],
    /// The cases that the list speaks of. In a case from elsewhere, which it cannot know, whatever
    /// needs an analysis that lptn does not have waits.
    pub known: &'a [String],
}

impl Waiting<'_> {
    pub fn is_listed(&self, case: &str, quantity: &str) -> bool {
        self.list.contains(&(case, quantity))
    }

    pub fn may_wait(&self, case: &str, quantity: &str) -> bool {
        self.is_listed(case, quantity) || !self.known.iter().any(|known| known == case)
    }
}
