//! Sets of things that turn out to be one: points that coincide, edges that hang together.

/// Disjoint sets of the numbers 0, 1, …; the least member stands for its set.
#[derive(Debug, Clone, Default)]
pub(super) struct UnionFind {
    parents: Vec<usize>,
}

impl UnionFind {
    /// `count` sets of one member each.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count).collect() }
    }

    /// Adds the next number as a set of its own.
    pub(super) fn push(&mut self) {
        self.parents.push(self.parents.len());
    }

    /// The least member of the set that `member` belongs to.
    pub(super) fn find(&mut self, mut member: usize) -> usize {
        while self.parents[member] != member {
            // Halves the path, so that later walks are short.
            self.parents[member] = self.parents[self.parents[member]];
            member = self.parents[member];
        }
        member
    }

    /// Makes one set of the sets of `a` and `b`.
    pub(super) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_stands_for_its_set() {
        let mut sets = UnionFind::new(5);
        sets.unite(4, 2);
        sets.unite(3, 4);
        sets.push();
        assert_eq!([0, 1, 2, 3, 4, 5].map(|member| sets.find(member)), [0, 1, 2, 2, 2, 5]);
        sets.unite(1, 3);
        assert_eq!(sets.find(4), 1);
    }
}
