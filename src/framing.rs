//! A camera for what has none: what of a scene counts, from where it is seen, and how far away.

mod direction;
mod fit;
mod interior;
mod strays;
mod surroundings;
#[cfg(test)]
mod tests;
mod voxels;

pub use direction::{Direction, View};

use crate::camera::Camera;
use crate::geometry::{Bounds, Triangle};
use glam::DVec3;
use interior::Room;
use rayon::iter::ParallelIterator;
use rayon::slice::ParallelSlice;

/// The vertical field of view of a framed picture, in radians (35 degrees): as far from a fish eye as from a telescope.
pub const FOV_Y: f64 = 0.610_865_238_198_015_3;
/// The same below a sky that the eye would otherwise have to leave (60 degrees).
const FOV_Y_BELOW_SKY: f64 = 1.047_197_551_196_597_6;

/// A triangle of what is to be framed.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// World space.
    pub triangle: Triangle,
    /// Whether it is seen from behind as well.
    pub double_sided: bool,
    /// Whether what lies behind it is seen through it, as through glass.
    pub is_clear: bool,
    /// The number of the thing that it belongs to: the faces of one follow each other.
    pub object: u32,
}

impl Face {
    fn points(&self) -> [DVec3; 3] {
        self.triangle.0.map(|p| p.as_dvec3())
    }

    /// Twice the area, along the normal.
    fn area_normal(&self) -> DVec3 {
        let [a, b, c] = self.points();
        (b - a).cross(c - a)
    }
}

/// What a picture is to be of: the faces that count, and whether they are a room around the viewer.
#[derive(Clone, Debug)]
pub struct Subject {
    faces: Vec<Face>,
    /// The box around what counts; empty where nothing does.
    pub bounds: Bounds,
    /// What does not count: skies, floors and seas far larger than the rest.
    pub left_out: Vec<LeftOut>,
    /// How many faces do not count since they are few, small and far from the rest.
    pub strays: usize,
    room: Option<Room>,
    /// The boxes of skies: the eye stays below them.
    skies: Vec<Bounds>,
}

/// Something that is seen where it is in the picture, but does not make the rest smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOut {
    /// As its faces have it.
    pub object: u32,
    /// The diagonal of its box over that of the rest's.
    pub times_as_large: f64,
}

impl Subject {
    /// What of `faces` counts: not the floor, sea or sky that is more than five times as large as all the rest, nor a
    /// few small triangles far away. A scene of nothing else counts whole.
    pub fn of(faces: impl Iterator<Item = Face>) -> Subject {
        let mut faces = there(faces);
        let (left_out, skies) = surroundings::left_out(&faces);
        if !left_out.is_empty() {
            let counts = |face: &Face| left_out.iter().all(|out| out.object != face.object);
            faces.retain(counts);
        }
        let strays = strays::remove(&mut faces);
        let bounds = bounds(&faces);
        Subject {
            room: interior::room(&faces, &bounds),
            faces,
            bounds,
            left_out,
            strays,
            skies,
        }
    }

    /// Everything counts, and is seen from outside.
    pub fn whole(faces: impl Iterator<Item = Face>) -> Subject {
        let faces: Vec<Face> = faces.collect();
        Subject {
            bounds: bounds(&faces),
            faces,
            left_out: Vec::new(),
            strays: 0,
            room: None,
            skies: Vec::new(),
        }
    }

    /// Whether it is a closed room with something in it, to be seen from inside.
    pub fn is_interior(&self) -> bool {
        self.room.is_some()
    }

    /// Whether hardly any light comes to it from outside: it is a room, or there is a sky over it that is a thing.
    pub fn is_enclosed(&self) -> bool {
        self.is_interior() || !self.skies.is_empty()
    }

    /// A camera that sees the subject in a picture of this `aspect` (width / height), with a vertical field of view in
    /// radians where one is given.
    ///
    /// From outside, the projection of its faces fills 80 % of the width or the height, and is in the middle; where no
    /// direction is asked for, that is from three quarters and slightly above, or from where the broad side is seen if
    /// that view is edge-on. A room is seen from inside, along its longest free way, unless a direction is asked for.
    /// Without faces it looks at the origin.
    pub fn camera(&self, view: &View, aspect: f64, fov_y: Option<f64>) -> Camera {
        if let (Some(room), Direction::Broadest) = (&self.room, view.direction) {
            return room.camera(view, aspect, fov_y);
        }
        let towards_viewer = view.angles(&self.faces).unit();
        let from_afar =
            |fov_y| fit::camera(&self.faces, &self.bounds, towards_viewer, aspect, fov_y);
        let camera = from_afar(fov_y.unwrap_or(FOV_Y));
        let is_below = |sky: &Bounds| {
            let position = camera.position;
            position.cmpgt(sky.min.as_dvec3()).all() && position.cmplt(sky.max.as_dvec3()).all()
        };
        if fov_y.is_none() && !self.skies.iter().all(is_below) {
            return view.zoomed(from_afar(FOV_Y_BELOW_SKY), FOV_Y_BELOW_SKY);
        }
        view.zoomed(camera, fov_y.unwrap_or(FOV_Y))
    }
}

/// The faces of finite numbers; without those that have no area, unless none has any.
fn there(faces: impl Iterator<Item = Face>) -> Vec<Face> {
    let is_finite = |face: &Face| face.triangle.0.iter().all(|p| p.is_finite());
    let mut faces: Vec<Face> = faces.filter(is_finite).collect();
    let has_area = |face: &Face| face.area_normal().length_squared() > 0.0;
    if faces.iter().any(has_area) {
        faces.retain(has_area);
    }
    faces
}

/// The box around faces.
fn bounds(faces: &[Face]) -> Bounds {
    let around = |piece: &[Face]| Bounds::around(piece.iter().flat_map(|face| face.triangle.0));
    pieces(faces, around)
        .into_iter()
        .fold(Bounds::EMPTY, Bounds::union)
}

/// The length from corner to corner; 0 for an empty box.
fn diagonal(bounds: &Bounds) -> f64 {
    if bounds.is_empty() {
        return 0.0;
    }
    (bounds.max.as_dvec3() - bounds.min.as_dvec3()).length()
}

/// What `of` says of each piece of the faces, in their order. The pieces are the same on every machine.
fn pieces<T: Send>(faces: &[Face], of: impl Fn(&[Face]) -> T + Send + Sync) -> Vec<T> {
    const PIECE: usize = 1 << 14;
    faces.par_chunks(PIECE).map(of).collect()
}
