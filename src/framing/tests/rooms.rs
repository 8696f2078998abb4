//! What is a room, and what only looks like one.

use super::*;

/// The generated room, or without one of its walls: those of its faces for which `is_left` holds.
fn furnished_room(double_sided: bool, is_left: impl Fn(Vec3) -> bool) -> Vec<Face> {
    let SceneDescription { meshes, .. } = generate::interior(Decoration::Plain);
    let of_meshes = (0..)
        .zip(&meshes)
        .flat_map(|(number, mesh)| object(number, &of_mesh(mesh, double_sided), 1.0, Vec3::ZERO));
    let middle = |face: &Face| face.triangle.0.iter().sum::<Vec3>() / 3.0;
    of_meshes.filter(|face| is_left(middle(face))).collect()
}

#[test]
fn a_furnished_room_is_seen_from_inside() {
    for double_sided in [true, false] {
        for scale in [1.0, 1000.0] {
            let room = furnished_room(double_sided, |_| true);
            let carried = |face: &Face| Face {
                triangle: Triangle(face.triangle.0.map(|p| p * scale)),
                ..*face
            };
            let subject = Subject::of(room.iter().map(carried));
            assert!(subject.is_interior() && subject.left_out.is_empty());
            let camera = subject.camera(&View::default(), 1.5, None);
            let eye = camera.position / f64::from(scale);
            // 5.2 by 2.6 by 4.4 metres.
            assert!((1.0..1.9).contains(&eye.y), "{eye}");
            assert!(
                (0.1..5.1).contains(&eye.x) && (0.1..4.3).contains(&eye.z),
                "{eye}"
            );
            let ahead = eye - camera.basis()[2] * -2.0;
            assert!(
                (0.0..5.2).contains(&ahead.x) && (0.0..4.4).contains(&ahead.z),
                "{ahead}"
            );
            let outside = View {
                direction: Direction::Top,
                ..View::default()
            };
            assert!(subject.camera(&outside, 1.5, None).position.y > 2.6 * f64::from(scale));
        }
    }
}

#[test]
fn a_dolls_house_is_seen_from_outside() {
    let without_ceiling = furnished_room(true, |p| p.y < 2.59);
    let without_front = furnished_room(true, |p| p.z < 4.38);
    // With a block that hides the open side from what is behind it.
    let mut open_box = turned_around(&box_faces(Vec3::ONE));
    open_box.retain(|face| face.triangle.0.iter().any(|p| p.z < 0.5));
    open_box.extend(object(
        1,
        &box_faces(Vec3::new(0.7, 0.6, 0.3)),
        1.0,
        Vec3::NEG_Y * 0.4,
    ));
    for house in [without_ceiling, without_front, open_box] {
        assert!(!Subject::of(house.into_iter()).is_interior());
    }
}

#[test]
fn a_solid_is_no_room_whichever_way_its_faces_are_turned() {
    let ball = of_mesh(&generate::icosphere(3), true);
    let cube = of_mesh(&generate::icosphere(0), true);
    for solid in [ball, cube, box_faces(Vec3::ONE)] {
        assert!(!Subject::of(solid.iter().copied()).is_interior());
        assert!(!Subject::of(turned_around(&solid).into_iter()).is_interior());
    }
}

#[test]
fn views_are_from_where_they_say() {
    let subject = Subject::of(box_faces(Vec3::ONE).into_iter());
    let toward = |direction, orbit| {
        let view = View {
            direction,
            orbit,
            zoom: 1.0,
        };
        let camera = subject.camera(&view, 1.0, None);
        (camera.position - camera.look_at).normalize()
    };
    let is_close = |a: DVec3, b: DVec3| (a - b).length() < 2e-3;
    for (direction, expected) in [
        (Direction::Front, DVec3::Z),
        (Direction::Back, DVec3::NEG_Z),
        (Direction::Left, DVec3::NEG_X),
        (Direction::Right, DVec3::X),
        (Direction::Top, DVec3::Y),
    ] {
        assert!(is_close(toward(direction, [0.0, 0.0]), expected));
    }
    assert!(is_close(toward(Direction::Front, [90.0, 0.0]), DVec3::X));
    assert!(is_close(toward(Direction::Front, [0.0, 500.0]), DVec3::Y));
    assert!(is_close(toward(Direction::Top, [0.0, -90.0]), DVec3::Z));
    let three_quarter = toward(Direction::ThreeQuarter, [0.0, 0.0]);
    assert!(is_close(
        toward(Direction::Front, [35.0, 22.0]),
        three_quarter
    ));
    assert!(is_close(
        toward(Direction::Broadest, [0.0, 0.0]),
        three_quarter
    ));
}

#[test]
fn a_zoom_of_two_makes_everything_twice_as_large() {
    let faces = box_faces(Vec3::ONE);
    let subject = Subject::of(faces.iter().copied());
    let tan = |zoom| {
        let view = View {
            zoom,
            ..View::default()
        };
        let camera = subject.camera(&view, 1.0, Some(1.0));
        let fov = match camera.projection {
            crate::camera::Projection::Perspective {
                fov: crate::camera::Fov::Y(fov),
            } => fov,
            _ => 0.0,
        };
        (libm::tan(fov / 2.0), camera.position)
    };
    let ((once, place), (twice, same_place)) = (tan(1.0), tan(2.0));
    assert!((once / twice - 2.0).abs() < 1e-12);
    assert_eq!(place, same_place);
}
