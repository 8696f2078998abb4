//! A name for each object and each material, which is theirs alone.

use super::{GROUND, Scene};
use std::collections::{HashMap, HashSet};

/// Gives names that nothing else has: to the first that wants one that very name, to others `name.2`, `name.3`...
#[derive(Debug, Default)]
pub(crate) struct OwnNames {
    /// What somebody is called by the file: nobody else gets that.
    given: HashSet<String>,
    taken: HashSet<String>,
    /// The number that the next of a name may get.
    next: HashMap<String, u32>,
}

impl OwnNames {
    /// None is taken yet; `given` are those that files have, which nobody gets by a number of luch's.
    pub(crate) fn among<'a>(given: impl Iterator<Item = &'a str>) -> OwnNames {
        OwnNames {
            given: given.map(str::to_owned).collect(),
            ..OwnNames::default()
        }
    }

    /// A name like this.
    pub(crate) fn own(&mut self, name: &str) -> String {
        if self.taken.insert(name.to_owned()) {
            return name.to_owned();
        }
        let next = self.next.entry(name.to_owned()).or_insert(2);
        loop {
            let own = format!("{name}.{next}");
            *next = next.saturating_add(1);
            if !self.given.contains(&own) && self.taken.insert(own.clone()) {
                return own;
            }
        }
    }
}

/// What the objects of a scene are called, or their materials.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Each once.
    pub list: Vec<String>,
    /// Of each object by its number ([`Scene::object_of`]), and of the ground ([`Scene::ground_object`]): an index into the
    /// list.
    pub of_objects: Vec<u32>,
}

impl Scene {
    /// The number of objects, which is the number of the ground, too: it comes after the others.
    pub fn ground_object(&self) -> u32 {
        (self.spheres.len() + self.planes.len() + self.instances.len()) as u32
    }

    /// What every object is called: as its file calls it, `sphere 2` or the like where that says nothing. What has the
    /// same name is one object; what has the ground's, where there is a ground, gets another.
    pub fn object_names(&self) -> Names {
        let spheres = self.spheres.iter().map(|sphere| sphere.name.as_str());
        let planes = self.planes.iter().map(|plane| plane.name.as_str());
        let instances = self.instances.iter().map(|instance| instance.name.as_str());
        let of = |kind: &'static str| (1u32..).map(move |number| (kind, number));
        let all = spheres.zip(of("sphere"));
        let all = all.chain(planes.zip(of("plane")));
        self.named(all.chain(instances.zip(of("object"))))
    }

    /// What the material of every object is called, in the same way.
    pub fn material_names(&self) -> Names {
        let spheres = self.spheres.iter().map(|sphere| sphere.material);
        let planes = self.planes.iter().map(|plane| plane.material);
        let instances = self.instances.iter().map(|instance| instance.material);
        let all = spheres.chain(planes).chain(instances);
        self.named(all.map(|index| {
            let name = self.material(index).name.as_str();
            (name, ("material", index + 1))
        }))
    }

    fn named<'a>(
        &self,
        all: impl Iterator<Item = (&'a str, (&'static str, u32))> + Clone,
    ) -> Names {
        let mut own = OwnNames::among(all.clone().map(|(name, _)| name));
        let ground = self.ground.map(|_| own.own(GROUND));
        let mut list = Vec::new();
        // By name, or by number where there is no name.
        let mut known: HashMap<(&str, u32), u32> = HashMap::new();
        let mut of_objects: Vec<u32> = all
            .map(|(name, (kind, number))| {
                let is_nameless = name.is_empty();
                let key = if is_nameless {
                    (kind, number)
                } else {
                    (name, 0)
                };
                *known.entry(key).or_insert_with(|| {
                    list.push(match name {
                        "" => own.own(&format!("{kind} {number}")),
                        name => own.own(name),
                    });
                    list.len() as u32 - 1
                })
            })
            .collect();
        if let Some(ground) = ground {
            of_objects.push(list.len() as u32);
            list.push(ground);
        }
        Names { list, of_objects }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_shares_a_name_gets_a_number_that_no_file_has() {
        let given = ["wheel", "wheel", "wheel.2", "wheel", "door"];
        let mut names = OwnNames::among(given.into_iter());
        assert_eq!(
            given.map(|name| names.own(name)),
            ["wheel", "wheel.3", "wheel.2", "wheel.4", "door"]
        );
    }
}
