//! Normals of faces that have none of their own, where a smoothing group is on.
//!
//! As Blender's importer has them (version 4.5: `obj_import_mesh.cc`, and `mesh_normals.cc` for the weights): a face is
//! flat or smooth, whichever the group's number, and before any `s` flat. A vertex of smooth faces has the mean of their
//! normals, each weighted by its angle there, over all the smooth faces of its object, whatever their material.
//!
//! Two things are otherwise. Where normals stand anywhere in the file, Blender smooths every face without; here `s`
//! still decides. And a vertex between two fans of smooth faces that flat ones part has one normal here, two there.

use super::geometry::{Corner, Geometry, NONE};
use super::polygon::newell_normal;
use glam::{DVec3, Vec3};
use std::ops::Range;

/// Gives each corner of a smooth face that names no normal one of its own.
pub(super) fn add_normals(geometry: &mut Geometry) {
    let needs_one =
        |face: u32| is_smooth(geometry, face) && geometry.face(face).iter().any(is_bare);
    if !(0..geometry.faces.len() as u32).any(needs_one) {
        return;
    }
    let mut sums = vec![DVec3::ZERO; geometry.positions.len()];
    // Where the normal of a position is, for the object at hand.
    let mut places = vec![NONE; geometry.positions.len()];
    for faces in faces_of_objects(geometry) {
        let smooth = || {
            let all = faces.iter().flat_map(Clone::clone);
            all.filter(|&face| is_smooth(geometry, face))
        };
        let mut touched = Vec::new();
        for face in smooth() {
            add_face(geometry, geometry.face(face), &mut sums, &mut touched);
        }
        let mut normals = Vec::new();
        let first = geometry.normals.len() as u32;
        for &position in &touched {
            let sum = sums.get_mut(position as usize).map(std::mem::take);
            let normal = sum.unwrap_or_default().normalize_or_zero().as_vec3();
            if normal != Vec3::ZERO
                && let Some(place) = places.get_mut(position as usize)
                && *place == NONE
            {
                *place = first.saturating_add(normals.len() as u32);
                normals.push(normal);
            }
        }
        let bare: Vec<u32> = smooth().collect();
        geometry.normals.extend(normals);
        for face in bare {
            for corner in geometry.face_mut(face) {
                if is_bare(corner) {
                    corner.normal = places
                        .get(corner.position as usize)
                        .copied()
                        .unwrap_or(NONE);
                }
            }
        }
        for position in touched {
            if let Some(place) = places.get_mut(position as usize) {
                *place = NONE;
            }
        }
    }
}

/// Adds a face's normal to the sum of each of its corners.
fn add_face(geometry: &Geometry, corners: &[Corner], sums: &mut [DVec3], touched: &mut Vec<u32>) {
    let at = |corner: &Corner| {
        let position = geometry.positions.get(corner.position as usize);
        position.copied().unwrap_or_default().as_dvec3()
    };
    let polygon: Vec<DVec3> = corners.iter().map(at).collect();
    let Some(normal) = newell_normal(&polygon).try_normalize() else {
        return;
    };
    let before = polygon.iter().cycle().skip(polygon.len().saturating_sub(1));
    let after = polygon.iter().cycle().skip(1);
    for (((corner, &here), &before), &after) in corners.iter().zip(&polygon).zip(before).zip(after)
    {
        let one = (before - here).normalize_or_zero();
        let other = (after - here).normalize_or_zero();
        let angle = libm::acos(one.dot(other).clamp(-1.0, 1.0));
        if let Some(sum) = sums.get_mut(corner.position as usize) {
            *sum += normal * angle;
            touched.push(corner.position);
        }
    }
}

/// The faces of each object. Groups without objects around them part nothing.
fn faces_of_objects(geometry: &Geometry) -> Vec<Vec<Range<u32>>> {
    let count = if geometry.has_objects {
        geometry.objects.len()
    } else {
        1
    };
    let mut objects = vec![Vec::new(); count];
    for group in &geometry.groups {
        let object = if geometry.has_objects {
            group.object
        } else {
            0
        };
        if let Some(faces) = objects.get_mut(object as usize) {
            faces.extend(group.faces.iter().cloned());
        }
    }
    objects
}

fn is_smooth(geometry: &Geometry, face: u32) -> bool {
    let face = geometry.faces.get(face as usize);
    face.is_some_and(|face| face.is_smooth)
}

fn is_bare(corner: &Corner) -> bool {
    corner.normal == NONE
}
