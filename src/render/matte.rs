//! Which objects and materials share a pixel.

use crate::film::{Manifest, Matte, RANKS, id_of};
use crate::sampling::Filter;
use crate::scene::{Names, Scene};
use crate::whitted::Share;

/// More objects than so many in one pixel are not told apart: those with the least shares go.
const MOST: usize = 64;

/// The shares that objects have of a pixel, each sample's by its weight: sums.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shares(Vec<(u32, f32)>);

/// The greatest shares of a pixel, which a second pass goes on with: more than the first samples of a pixel meet, unless
/// it looks through several layers.
pub(super) type KnownShares = [(u32, f32); RANKS];

impl Shares {
    /// Room of its own for each of so many pixels.
    pub(super) fn clear(all: &mut Vec<Shares>, pixels: usize) {
        all.iter_mut().for_each(|shares| shares.0.clear());
        all.resize_with(pixels, Shares::default);
    }

    pub(super) fn add(&mut self, share: &Share, weight: f32) {
        let more = share.share * weight;
        match self
            .0
            .iter_mut()
            .find(|(object, _)| *object == share.object)
        {
            Some((_, sum)) => *sum += more,
            None => {
                if self.0.len() == MOST {
                    let least = |a: &usize, b: &usize| self.0[*a].1.total_cmp(&self.0[*b].1);
                    let least = (0..self.0.len()).min_by(least);
                    least.map(|least| self.0.remove(least));
                }
                self.0.push((share.object, more));
            }
        }
    }

    /// What a second pass goes on with.
    pub(super) fn known(&self) -> KnownShares {
        let mut known = KnownShares::default();
        if let Some(all) = known.get_mut(..self.0.len()) {
            all.copy_from_slice(&self.0);
            return known;
        }
        let mut sorted = self.0.clone();
        sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
        known
            .iter_mut()
            .zip(sorted)
            .for_each(|(known, share)| *known = share);
        known
    }

    /// Goes on from there.
    pub(super) fn go_on_from(&mut self, known: &KnownShares) {
        self.0.clear();
        self.0.extend(known.iter().filter(|(_, sum)| *sum != 0.0));
    }
}

/// Ids, as the bits of floats, and coverages, those with the most coverage first.
pub(super) type Ranks = [[f32; 2]; RANKS];

/// The ids of every object and of its material.
#[derive(Debug, Default)]
pub(super) struct Ids {
    /// By the object's number.
    objects: Vec<u32>,
    materials: Vec<u32>,
}

impl Ids {
    /// The ids of a scene, and which names they stand for.
    pub(super) fn of(scene: &Scene) -> (Ids, Vec<Manifest>) {
        let (objects, of_objects) = named(Matte::Object, scene.object_names());
        let (materials, of_materials) = named(Matte::Material, scene.material_names());
        let ids = Ids { objects, materials };
        (ids, vec![of_objects, of_materials])
    }

    /// Of each of [`Matte::ALL`] the greatest shares, where the weights of a pixel's samples add to `weight`.
    pub(super) fn ranks(&self, shares: &Shares, weight: f32, filter: Filter) -> [Ranks; 2] {
        Matte::ALL.map(|matte| self.ranks_of(matte, shares, weight, filter))
    }

    fn ranks_of(&self, matte: Matte, shares: &Shares, weight: f32, filter: Filter) -> Ranks {
        let ids = match matte {
            Matte::Object => &self.objects,
            Matte::Material => &self.materials,
        };
        let mut merged: Vec<(u32, f32)> = Vec::with_capacity(shares.0.len());
        for &(object, sum) in &shares.0 {
            let id = ids.get(object as usize).copied().unwrap_or_default();
            match merged.iter_mut().find(|(known, _)| *known == id) {
                Some((_, known)) => *known += sum,
                None => merged.push((id, sum)),
            }
        }
        let mut scale = 1.0 / weight;
        if filter.has_negative_lobes() {
            // What rings below nothing is given back, so that all of them still cover what they cover together.
            let sum = |sum: f32, (_, share): &(u32, f32)| sum + share;
            let all = (merged.iter().fold(0.0, sum) * scale).clamp(0.0, 1.0);
            merged.retain(|(_, share)| *share > 0.0);
            scale = all / merged.iter().fold(0.0, sum).max(f32::MIN_POSITIVE);
        }
        merged.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut ranks = Ranks::default();
        for (rank, (id, share)) in ranks.iter_mut().zip(merged) {
            *rank = [f32::from_bits(id), share * scale];
        }
        ranks
    }
}

fn named(matte: Matte, names: Names) -> (Vec<u32>, Manifest) {
    let ids: Vec<u32> = names.list.iter().map(|name| id_of(name)).collect();
    let id = |index: &u32| ids.get(*index as usize).copied().unwrap_or_default();
    let of_objects = names.of_objects.iter().map(id).collect();
    let mut names: Vec<(String, u32)> = names.list.into_iter().zip(ids).collect();
    names.sort();
    (of_objects, Manifest { matte, names })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(object: u32, share: f32) -> Share {
        Share {
            sample: 0,
            object,
            share,
        }
    }

    #[test]
    fn where_a_filter_rings_no_share_is_below_zero_and_their_sum_stays() {
        let ids = Ids {
            objects: vec![1 << 23, 2 << 23, 3 << 23],
            materials: Vec::new(),
        };
        let mut shares = Shares::default();
        for (object, weight) in [(0, 3.0), (1, -1.0), (2, 2.0)] {
            shares.add(&share(object, 1.0), weight);
        }
        let [ranks, _] = ids.ranks(&shares, 4.0, Filter::Mitchell);
        let covered = ranks.map(|[_, coverage]| coverage);
        assert_eq!(covered, [0.6, 0.4, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(ranks[0][0].to_bits(), 1 << 23);
        assert_eq!(ranks[5][0].to_bits(), 0);
    }

    #[test]
    fn of_very_many_objects_the_greatest_are_told() {
        let mut shares = Shares::default();
        for object in 0..1000 {
            let size = if object == 500 { 1.0 } else { 1e-3 };
            shares.add(&share(object, size), 1.0);
        }
        assert_eq!(shares.0.len(), MOST);
        assert_eq!(shares.known()[0], (500, 1.0));
        let mut again = Shares::default();
        again.go_on_from(&shares.known());
        assert_eq!(again.known(), shares.known());
    }
}
