//! What is in the picture, and how large.

use super::*;
use glam::Vec3;

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
