//! Which object and material faces belong to.

use super::geometry::Group;
use super::text::name;
use std::collections::HashMap;
use std::ops::Range;

/// Names in the order in which they first appear, as the file's bytes have them.
#[derive(Default)]
struct Names {
    list: Vec<Vec<u8>>,
    indices: HashMap<Vec<u8>, u32>,
}

impl Names {
    fn index(&mut self, bytes: &[u8]) -> u32 {
        if let Some(&known) = self.indices.get(bytes) {
            return known;
        }
        let index = self.list.len() as u32;
        self.list.push(bytes.to_owned());
        self.indices.insert(bytes.to_owned(), index);
        index
    }

    /// Takes over all of `other`; what each of its indices is here.
    fn append(&mut self, other: &Names) -> Vec<u32> {
        other.list.iter().map(|bytes| self.index(bytes)).collect()
    }

    fn into_text(self) -> Vec<String> {
        self.list.iter().map(|bytes| name(bytes)).collect()
    }
}

/// What a piece of a file says of an object, a group or a material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Named {
    /// Nothing: it is what it was before the piece.
    #[default]
    AsBefore,
    /// That there is none.
    None,
    /// An index of a name.
    Name(u32),
}

impl Named {
    /// What it is where `before` was, each name being another.
    fn after(self, before: Named, renamed: &[u32]) -> Named {
        match self {
            Named::AsBefore => before,
            Named::None => Named::None,
            Named::Name(index) => renamed
                .get(index as usize)
                .map_or(Named::None, |&index| Named::Name(index)),
        }
    }

    fn index(self) -> Option<u32> {
        match self {
            Named::Name(index) => Some(index),
            Named::AsBefore | Named::None => None,
        }
    }
}

/// What a face belongs to.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
struct Place {
    object: Named,
    group: Named,
    material: Named,
}

/// The faces of a piece of a file, by what they belong to.
#[derive(Default)]
pub(super) struct Runs {
    objects: Names,
    groups: Names,
    materials: Names,
    place: Place,
    /// Faces between two statements that change it.
    runs: Vec<(Place, Range<u32>)>,
    start: u32,
}

impl Runs {
    /// `o`: `faces` are there before it, as in the statements below.
    pub(super) fn object(&mut self, faces: usize, name: &[u8]) {
        self.end(faces);
        self.place.object = Named::Name(self.objects.index(name));
    }

    /// `g`.
    pub(super) fn group(&mut self, faces: usize, name: &[u8]) {
        self.end(faces);
        self.place.group = Named::Name(self.groups.index(name));
    }

    /// `usemtl`; without a name, none.
    pub(super) fn material(&mut self, faces: usize, name: &[u8]) {
        self.end(faces);
        self.place.material = match name {
            [] => Named::None,
            _ => Named::Name(self.materials.index(name)),
        };
    }

    /// The end of a run, as of the piece.
    pub(super) fn end(&mut self, faces: usize) {
        let end = faces as u32;
        self.add(self.place, self.start..end);
        self.start = end;
    }

    fn add(&mut self, place: Place, faces: Range<u32>) {
        match self.runs.last_mut() {
            _ if faces.is_empty() => {}
            Some((last, before)) if *last == place && before.end == faces.start => {
                before.end = faces.end;
            }
            _ => self.runs.push((place, faces)),
        }
    }

    /// Takes over the piece after, which is at its end; `faces` are there before it.
    pub(super) fn append(&mut self, piece: &Runs, faces: usize) {
        let objects = self.objects.append(&piece.objects);
        let groups = self.groups.append(&piece.groups);
        let materials = self.materials.append(&piece.materials);
        let before = self.place;
        let after = |place: Place| Place {
            object: place.object.after(before.object, &objects),
            group: place.group.after(before.group, &groups),
            material: place.material.after(before.material, &materials),
        };
        let first = faces as u32;
        for (place, faces) in &piece.runs {
            let faces = first.saturating_add(faces.start)..first.saturating_add(faces.end);
            self.add(after(*place), faces);
        }
        self.place = after(piece.place);
    }

    /// All of a file's, by object and material.
    pub(super) fn sorted(self) -> Sorted {
        let has_objects = !self.objects.list.is_empty();
        let mut names = if has_objects {
            self.objects
        } else {
            self.groups
        };
        let mut sorted: Vec<Group> = Vec::new();
        let mut known: HashMap<(u32, Option<u32>), usize> = HashMap::new();
        for (place, faces) in self.runs {
            let object = if has_objects {
                place.object
            } else {
                place.group
            };
            let object = object.index().unwrap_or_else(|| names.index(b""));
            let material = place.material.index();
            let next = sorted.len();
            let at = *known.entry((object, material)).or_insert(next);
            match sorted.get_mut(at) {
                Some(group) => group.faces.push(faces),
                None => sorted.push(Group {
                    object,
                    material,
                    faces: vec![faces],
                }),
            }
        }
        Sorted {
            groups: sorted,
            objects: names.into_text(),
            has_objects,
            materials: self.materials.into_text(),
        }
    }
}

/// The faces of a file, by object and material: the fields of a [`Geometry`](super::geometry::Geometry).
pub(super) struct Sorted {
    pub(super) groups: Vec<Group>,
    pub(super) objects: Vec<String>,
    pub(super) has_objects: bool,
    pub(super) materials: Vec<String>,
}
