//! What is in the picture, and how large.

use super::*;
use crate::generate::{self, Decoration};
use crate::mesh::Mesh;
use crate::scene::SceneDescription;
use glam::Vec3;

mod rooms;

fn square(corners: [Vec3; 4]) -> Vec<Face> {
    let [a, b, c, d] = corners;
    let face = |t| Face {
        triangle: Triangle(t),
        double_sided: false,
        is_clear: false,
        object: 0,
    };
    vec![face([a, b, c]), face([a, c, d])]
}

fn box_faces(size: Vec3) -> Vec<Face> {
    let corner = |i: u32| {
        let pick = |bit: u32, s: f32| if i & bit == 0 { -s } else { s };
        Vec3::new(pick(1, size.x), pick(2, size.y), pick(4, size.z))
    };
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    quads
        .iter()
        .flat_map(|quad| square(quad.map(corner)))
        .collect()
}

/// The faces as a thing of this number, carried.
fn object(object: u32, faces: &[Face], scale: f32, offset: Vec3) -> Vec<Face> {
    let carried = |face: &Face| Face {
        triangle: Triangle(face.triangle.0.map(|p| p * scale + offset)),
        object,
        ..*face
    };
    faces.iter().map(carried).collect()
}

fn of_mesh(mesh: &Mesh, double_sided: bool) -> Vec<Face> {
    let face = |index| Face {
        triangle: mesh.triangle(index),
        double_sided,
        is_clear: false,
        object: 0,
    };
    (0..mesh.triangles.len() as u32).map(face).collect()
}

fn turned_around(faces: &[Face]) -> Vec<Face> {
    let turned = |face: &Face| {
        let [a, b, c] = face.triangle.0;
        Face {
            triangle: Triangle([a, c, b]),
            ..*face
        }
    };
    faces.iter().map(turned).collect()
}

/// A square floor, whose corners are so far from its middle along both axes.
fn floor(half: f32) -> Vec<Face> {
    square(
        [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)]
            .map(|(x, z)| Vec3::new(x, 0.0, z) * half),
    )
}

/// What counts of several things, each of another number, and the camera toward it.
fn seen(things: &[Vec<Face>]) -> (Subject, Camera) {
    let numbered = (0..).zip(things);
    let faces = numbered.flat_map(|(number, faces)| object(number, faces, 1.0, Vec3::ZERO));
    let subject = Subject::of(faces);
    let camera = subject.camera(&View::default(), 1.5, None);
    (subject, camera)
}

fn numbers_left_out(subject: &Subject) -> Vec<u32> {
    subject.left_out.iter().map(|out| out.object).collect()
}

/// The least and the greatest picture position of the faces' vertices, 0..1 in both directions.
fn projected(camera: &Camera, faces: &[Face], aspect: f64) -> (DVec3, DVec3) {
    let [u, v, w] = camera.basis();
    let tan = libm::tan(FOV_Y / 2.0);
    let position = |p: Vec3| {
        let d = p.as_dvec3() - camera.position;
        let z = d.dot(w);
        assert!(z > 0.0);
        DVec3::new(
            0.5 + d.dot(u) / z / tan / aspect / 2.0,
            0.5 + d.dot(v) / z / tan / 2.0,
            0.0,
        )
    };
    let all = faces.iter().flat_map(|f| f.triangle.0).map(position);
    all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), p| {
        (a.min(p), b.max(p))
    })
}

#[test]
fn a_box_fills_four_fifths_of_the_tighter_side_and_is_centred() {
    for size in [
        Vec3::ONE,
        Vec3::new(10.0, 1.0, 1.0),
        Vec3::new(0.001, 0.004, 0.001),
        Vec3::splat(1e4),
    ] {
        for aspect in [16.0 / 9.0, 0.5] {
            let faces = box_faces(size);
            let camera = Subject::of(faces.iter().copied()).camera(&View::default(), aspect, None);
            let (min, max) = projected(&camera, &faces, aspect);
            let (filled, middle) = (max - min, (max + min) / 2.0);
            assert!(
                (filled.x.max(filled.y) - 0.8).abs() < 0.01,
                "{size} {aspect}: {filled}"
            );
            assert!(
                (middle.x - 0.5).abs() < 0.1 && (middle.y - 0.5).abs() < 0.1,
                "{middle}"
            );
        }
    }
}

#[test]
fn a_solid_is_seen_from_three_quarters_and_above() {
    let camera = Subject::of(box_faces(Vec3::ONE).into_iter()).camera(&View::default(), 1.5, None);
    assert!(camera.position.x > 0.0 && camera.position.y > 0.0 && camera.position.z > 0.0);
}

#[test]
fn nothing_flat_is_seen_edge_on_or_from_behind() {
    for normal in [
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::NEG_X,
        Vec3::NEG_Y,
        Vec3::NEG_Z,
        Vec3::new(1.0, 0.0, -1.0),
    ] {
        let (e1, e2) = normal.normalize().any_orthonormal_pair();
        let faces = square([-e1 - e2, e1 - e2, e1 + e2, e2 - e1]);
        let camera = Subject::of(faces.iter().copied()).camera(&View::default(), 1.5, None);
        let toward = (camera.position - camera.look_at).normalize();
        assert!(
            faces[0].triangle.normal().as_dvec3().dot(toward) > 0.3,
            "{normal}"
        );
    }
}

#[test]
fn nothing_and_a_point_still_get_a_camera() {
    let point = Face {
        triangle: Triangle([Vec3::ONE; 3]),
        double_sided: true,
        is_clear: false,
        object: 0,
    };
    for faces in [vec![], vec![point]] {
        let camera = Subject::of(faces.into_iter()).camera(&View::default(), 1.0, None);
        assert!(camera.position.is_finite() && camera.position != camera.look_at);
    }
}

#[test]
fn a_floor_a_sea_and_a_sky_far_larger_than_the_rest_do_not_make_it_smaller() {
    let model = box_faces(Vec3::ONE);
    let (_, alone) = seen(std::slice::from_ref(&model));
    let ball = of_mesh(&generate::icosphere(3), false);
    let sky = |radius: f32| object(0, &turned_around(&ball), radius, Vec3::ZERO);
    let sky_box = turned_around(&box_faces(Vec3::splat(100.0)));
    let below = |faces: Vec<Face>| object(0, &faces, 1.0, Vec3::NEG_Y);
    for (around, left_out) in [
        (vec![below(floor(500.0))], vec![0]),
        (
            vec![below(box_faces(Vec3::new(500.0, 0.1, 500.0)))],
            vec![0],
        ),
        (vec![sky(500.0)], vec![0]),
        (vec![sky_box], vec![0]),
        (vec![sky(1000.0), below(floor(30.0))], vec![0, 1]),
        (vec![below(floor(500.0)), sky(700.0)], vec![1, 0]),
    ] {
        let count = around.len();
        let (subject, camera) = seen(&[around, vec![model.clone()]].concat());
        assert_eq!(numbers_left_out(&subject).len(), left_out.len());
        assert!(
            numbers_left_out(&subject)
                .iter()
                .all(|&out| (out as usize) < count)
        );
        assert_eq!(camera, alone);
        assert!(subject.left_out.iter().all(|out| out.times_as_large > 5.0));
        assert!(!subject.is_interior());
    }
}

#[test]
fn a_sky_that_is_only_just_far_larger_keeps_the_eye_below_it() {
    let model = box_faces(Vec3::ONE);
    let ball = of_mesh(&generate::icosphere(3), true);
    let (subject, camera) = seen(&[model, object(0, &ball, 6.0, Vec3::ZERO)]);
    assert_eq!(numbers_left_out(&subject), [1]);
    assert!(camera.position.length() < 5.8, "{}", camera.position);
}

#[test]
fn a_floor_or_a_sky_alone_is_what_the_picture_is_of() {
    let sky = turned_around(&of_mesh(&generate::icosphere(2), false));
    for faces in [floor(1000.0), sky] {
        let (subject, _) = seen(&[faces]);
        assert_eq!((subject.left_out.len(), subject.strays), (0, 0));
        assert!(!subject.is_interior() && !subject.bounds.is_empty());
    }
}

#[test]
fn a_case_with_something_small_in_it_and_a_board_with_writing_on_it_count() {
    let small = object(0, &box_faces(Vec3::ONE), 0.01, Vec3::ZERO);
    let writing = box_faces(Vec3::new(0.05, 0.001, 0.05));
    for case in [
        box_faces(Vec3::ONE),
        of_mesh(&generate::icosphere(2), false),
    ] {
        let (subject, _) = seen(&[case, small.clone()]);
        assert_eq!(subject.left_out, []);
    }
    let (subject, _) = seen(&[floor(1.0), writing]);
    assert_eq!(subject.left_out, []);
}

#[test]
fn a_few_small_triangles_far_away_do_not_make_the_rest_smaller() {
    let model = of_mesh(&generate::icosphere(2), false);
    let (_, alone) = seen(std::slice::from_ref(&model));
    let speck = square([Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y]);
    for far in [1e2, 1e6, 1e12] {
        for direction in [Vec3::X, Vec3::NEG_Y, Vec3::ONE] {
            let stray = object(1, &speck, 0.01, direction * far);
            let second = object(1, &speck, 0.01, direction * (-3.0 * far));
            let (subject, camera) = seen(&[model.clone(), stray, second]);
            // Some have no area so far away, and are not there at all.
            assert!(far > 1e2 || subject.strays == 4, "{direction}");
            assert_eq!(camera, alone);
        }
    }
}

#[test]
fn equals_are_all_in_the_picture_however_far_apart() {
    let ball = of_mesh(&generate::icosphere(2), false);
    let places = [0.0, 100.0, 350.0].map(|x| object(0, &ball, 1.0, Vec3::X * x));
    let (subject, _) = seen(&places);
    assert_eq!((subject.left_out.len(), subject.strays), (0, 0));
    assert!(subject.bounds.max.x > 350.0 && subject.bounds.min.x < 0.0);
}
