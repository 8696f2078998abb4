//! `[[sphere]]` and `[[plane]]`.

use super::kind::{ABOVE_ZERO, DIRECTION, POINT};
use super::materials::{Materials, Wearer};
use super::table::{Schema, Table};
use crate::Error;
use crate::geometry::{Plane, Sphere};
use crate::scene::Object;

const SPHERE: Schema = Schema {
    key: "sphere",
    label: "[[sphere]]",
    keys: &["center", "radius", "material"],
};

const PLANE: Schema = Schema {
    key: "plane",
    label: "[[plane]]",
    keys: &["point", "normal", "material"],
};

/// Every sphere, in the file's order.
pub(super) fn spheres(
    root: &Table<'_>,
    materials: &Materials,
) -> Result<Vec<Object<Sphere>>, Error> {
    let sphere = |table: &Table<'_>| {
        let shape = Sphere {
            center: table.required("center", &POINT)?.as_vec3(),
            radius: table.required("radius", &ABOVE_ZERO)?,
        };
        let material = materials.required(table, Wearer::Other)?;
        Ok(nameless(shape, material))
    };
    root.tables(&SPHERE)?.iter().map(sphere).collect()
}

/// Every plane, in the file's order; normals as long as the file has them.
pub(super) fn planes(root: &Table<'_>, materials: &Materials) -> Result<Vec<Object<Plane>>, Error> {
    let plane = |table: &Table<'_>| {
        let shape = Plane {
            point: table.required("point", &POINT)?.as_vec3(),
            normal: table.required("normal", &DIRECTION)?,
        };
        let material = materials.required(table, Wearer::Plane)?;
        Ok(nameless(shape, material))
    };
    root.tables(&PLANE)?.iter().map(plane).collect()
}

fn nameless<S>(shape: S, material: u32) -> Object<S> {
    Object {
        name: String::new(),
        shape,
        material,
    }
}
