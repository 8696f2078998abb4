//! Which of an accessor's vertices a mesh keeps.

use super::elements::Elements;

/// Which of an accessor's vertices a mesh keeps. Files share one long accessor between many primitives; each keeps
/// only what it draws.
pub(super) enum Kept {
    All(usize),
    /// In rising order.
    Some(Vec<u32>),
}

impl Kept {
    /// What `triangles` need of `count` vertices; the triangles then name the kept ones.
    pub(super) fn of(triangles: &mut [[u32; 3]], count: usize) -> Kept {
        // With so few to gain, vertices stay as they are.
        if count <= triangles.len().saturating_mul(4) {
            return Kept::All(count);
        }
        let mut used: Vec<u32> = triangles.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        for vertex in triangles.as_flattened_mut() {
            *vertex = used.partition_point(|&other| other < *vertex) as u32;
        }
        Kept::Some(used)
    }

    pub(super) fn count(&self) -> usize {
        match self {
            Kept::All(count) => *count,
            Kept::Some(used) => used.len(),
        }
    }

    /// Where vertex `old` of the accessor went, if it is kept.
    pub(super) fn place_of(&self, old: u32) -> Option<u32> {
        match self {
            Kept::All(_) => Some(old),
            Kept::Some(used) => used.binary_search(&old).ok().map(|place| place as u32),
        }
    }

    /// The kept vertices of the accessor, in order.
    pub(super) fn vertices(&self) -> Vec<u32> {
        match self {
            Kept::All(count) => (0..*count as u32).collect(),
            Kept::Some(used) => used.clone(),
        }
    }

    /// What `make` makes of each of the kept vertices' elements.
    pub(super) fn gather<const N: usize, T: Send>(
        &self,
        elements: &Elements,
        make: impl Fn([f32; N]) -> T + Send + Sync,
    ) -> Vec<T> {
        match self {
            Kept::All(count) => elements.first(*count, make),
            Kept::Some(used) => {
                let used = used.iter();
                used.map(|&i| make(elements.floats(i as usize))).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gltf::json::accessor::ComponentType;

    /// What is kept of the vertices 0, 1, 2 and so on.
    fn kept(triangles: &mut [[u32; 3]], count: usize) -> Vec<f32> {
        let bytes: Vec<u8> = (0..count).flat_map(|i| (i as f32).to_le_bytes()).collect();
        let elements = Elements::packed(&bytes, count, 1, ComponentType::F32, false);
        Kept::of(triangles, count).gather(&elements, |[i]| i)
    }

    #[test]
    fn a_small_part_of_a_long_accessor_keeps_its_own_vertices_only() {
        let mut triangles = vec![[90, 7, 40], [40, 7, 3]];
        assert_eq!(kept(&mut triangles, 100), [3., 7., 40., 90.]);
        assert_eq!(triangles, [[3, 1, 2], [2, 1, 0]]);
    }

    #[test]
    fn a_whole_accessor_is_kept_as_it_is() {
        let mut triangles = vec![[2, 1, 0]];
        assert_eq!(kept(&mut triangles, 4), [0., 1., 2., 3.]);
        assert_eq!(triangles, [[2, 1, 0]]);
    }
}
