//! What an EXR says of itself, read back.

use super::{encoded, film};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::meta::header::Header as Read;
use glam::{DMat4, DVec3, DVec4, Vec3};
use luch::accel::{self, Accel};
use luch::camera::{Camera, Fov, Projection};
use luch::color::Rgb;
use luch::film::{Film, Layers};
use luch::geometry::Sphere;
use luch::material::Material;
use luch::output::{Fact, Format, Frame, Header, Options};
use luch::render::{Progress, Settings, render};
use luch::scene::{Background, Object, Scene, SceneDescription, Shown};
use luch::shade::Shading;
use std::f64::consts::FRAC_PI_2;

fn read(film: &Film, header: Header) -> Read {
    let options = Options {
        header,
        ..Options::default()
    };
    let bytes = encoded(film, Format::Exr, &options);
    let mut headers = MetaData::read_from_buffered(&bytes[..], true)
        .unwrap()
        .headers;
    headers.remove(0)
}

/// The attribute of that name, if the file has it.
fn attribute(read: &Read, name: &str) -> Option<AttributeValue> {
    let mut all = read.all_named_attributes();
    let found = all.find(|(key, _)| *key == name.as_bytes());
    found.map(|(_, value)| value.clone())
}

fn words(read: &Read, name: &str) -> Option<String> {
    match attribute(read, name)? {
        AttributeValue::Text(text) => Some(String::from_utf8(text.bytes().to_vec()).unwrap()),
        other => panic!("{name}: {other:?}"),
    }
}

/// What a matrix of the file makes of a point: a row vector, as OpenEXR has them.
fn seen(read: &Read, name: &str, point: DVec3) -> DVec3 {
    let Some(AttributeValue::Matrix4x4(rows)) = attribute(read, name) else {
        panic!("no {name}");
    };
    // Rows become columns: the transpose multiplies column vectors.
    let matrix = DMat4::from_cols_array(&rows.map(f64::from));
    let DVec4 { x, y, z, w } = matrix * point.extend(1.0);
    DVec3::new(x, y, z) / w
}

/// A camera that looks askew, with what it sees.
fn askew(projection: Projection) -> Camera {
    Camera {
        projection,
        ..Camera::looking_at(
            DVec3::new(1.0, 4.0, 9.0),
            DVec3::new(0.5, 0.0, -1.0),
            DVec3::Y,
            1.0,
        )
    }
}

fn projections() -> [Projection; 4] {
    let perspective = |fov| Projection::Perspective { fov };
    [
        perspective(Fov::Y(0.7)),
        perspective(Fov::X(1.1)),
        perspective(Fov::Both(1.2, 0.6)),
        Projection::Orthographic {
            half_width: None,
            half_height: 3.0,
        },
    ]
}

const SIZE: [u32; 2] = [64, 40];

fn header_of(camera: Camera) -> Header {
    Header {
        camera: Some(camera),
        ..Header::default()
    }
}

#[test]
fn a_small_sphere_is_in_the_pixel_that_world_to_ndc_names() {
    let [width, height] = SIZE;
    let settings = Settings::new(width, height, 1, 0, Shading::Flat).unwrap();
    for projection in projections() {
        let camera = askew(projection);
        for center in [
            Vec3::new(-1.3, 0.4, 0.2),
            Vec3::new(2.1, -0.7, -1.0),
            Vec3::new(0.2, 1.4, 3.0),
        ] {
            let sphere = Object {
                name: String::new(),
                shape: Sphere {
                    center,
                    radius: 0.25,
                },
                material: 0,
            };
            let scene = Scene::new(SceneDescription {
                materials: vec![Material::matt("white", Rgb::WHITE)],
                spheres: vec![sphere],
                background: Background::plain(Rgb::BLACK, Shown::Never),
                ..SceneDescription::empty(camera)
            })
            .unwrap();
            let accel = Accel::build(&scene, &accel::Options::default());
            let film = render(&scene, &accel, &settings, &Progress::default());
            let read = read(&film, header_of(camera));
            let ndc = seen(&read, "worldToNDC", center.as_dvec3());
            let (x, y) = (ndc.x * f64::from(width), ndc.y * f64::from(height));
            // The mean of the pixels where the sphere is, weighed by alpha.
            let mut sum = DVec3::ZERO;
            for (at, [.., alpha]) in (0..).zip(film.beauty()) {
                let (column, row) = (at % width, at / width);
                let place = DVec3::new(f64::from(column) + 0.5, f64::from(row) + 0.5, 1.0);
                sum += place * f64::from(alpha);
            }
            let mean = sum / sum.z;
            let off = (mean.x - x).hypot(mean.y - y);
            assert!(sum.z > 2.0 && off < 0.5, "{projection:?} {center}: {off}");
        }
    }
}

#[test]
fn a_point_on_any_camera_ray_is_seen_where_the_ray_began() {
    let [width, height] = SIZE;
    let film = film(
        width,
        Shown::Never,
        &vec![[0.0; 4]; (width * height) as usize],
    );
    for projection in projections() {
        let camera = askew(projection);
        let view = camera.view(width, height);
        let read = read(&film, header_of(camera));
        for (x, y) in [(0.0, 0.0), (64.0, 40.0), (0.5, 39.5), (20.25, 11.0)] {
            let ray = view.primary_ray(x, y);
            let t = 7.5;
            let point = ray.point_at(t).as_dvec3();
            let ndc = seen(&read, "worldToNDC", point);
            let close = |found: f64, expected: f64| (found - expected).abs() < 1e-4;
            assert!(
                close(ndc.x * 64.0, x) && close(ndc.y * 40.0, y),
                "{projection:?}: {ndc}"
            );
            let depth = seen(&read, "worldToCamera", point).z;
            assert!(
                close(depth, f64::from(view.depth(&ray, t))),
                "{projection:?}: {depth}"
            );
        }
    }
}

#[test]
fn camera_space_has_right_up_and_forward_as_its_axes() {
    let camera = Camera::looking_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y, 1.0);
    let read = read(&film(1, Shown::Never, &[[0.0; 4]]), header_of(camera));
    let of = |point| seen(&read, "worldToCamera", point);
    assert_eq!(of(DVec3::new(1.0, 2.0, 2.0)), DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn lens_and_sensor_give_the_field_of_view() {
    let camera = Camera {
        near: 0.5,
        ..Camera::looking_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, FRAC_PI_2)
    };
    let read = read(&film(2, Shown::Never, &[[0.0; 4]; 2]), header_of(camera));
    // Twice as wide as high, and 45 degrees up: tan(fov_y/2) = 1 = 9 / 9.
    let sensor = AttributeValue::FloatVec2(exr::math::Vec2(36.0, 18.0));
    assert_eq!(attribute(&read, "sensorOverallDimensions"), Some(sensor));
    let length = attribute(&read, "pinholeFocalLength");
    assert!(matches!(length, Some(AttributeValue::F32(mm)) if (mm - 9.0).abs() < 1e-5));
    assert_eq!(attribute(&read, "near"), Some(AttributeValue::F32(0.5)));
    // Far is a number even where there is no end.
    assert_eq!(attribute(&read, "far"), Some(AttributeValue::F32(1e10)));
}

#[test]
fn what_is_not_known_is_not_said_but_the_owner_has_a_place() {
    let read = read(&film(1, Shown::Never, &[[0.0; 4]]), Header::default());
    assert_eq!(words(&read, "owner"), Some(String::new()));
    for name in [
        "capDate",
        "utcOffset",
        "worldToCamera",
        "framesPerSecond",
        "timeCode",
        "imageCounter",
    ] {
        assert_eq!(attribute(&read, name), None, "{name}");
    }
}

#[test]
fn owner_date_and_frame_are_said_as_openexr_has_them() {
    let header = Header {
        owner: "Студия".into(),
        captured: Some(1_709_251_199),
        frame: Some(Frame {
            number: 49,
            per_second: Some([24, 1]),
        }),
        facts: vec![
            ("commit".into(), Fact::Text("é".into())),
            ("bvh/nodes".into(), Fact::Number(7.0)),
        ],
        ..Header::default()
    };
    let read = read(&film(1, Shown::Never, &[[0.0; 4]]), header);
    assert_eq!(words(&read, "owner").as_deref(), Some("Студия"));
    assert_eq!(
        words(&read, "capDate").as_deref(),
        Some("2024:02:29 23:59:59")
    );
    assert_eq!(
        attribute(&read, "utcOffset"),
        Some(AttributeValue::F32(0.0))
    );
    let per_second = AttributeValue::Rational((24, 1));
    assert_eq!(attribute(&read, "framesPerSecond"), Some(per_second));
    assert_eq!(
        attribute(&read, "imageCounter"),
        Some(AttributeValue::I32(49))
    );
    let Some(AttributeValue::TimeCode(code)) = attribute(&read, "timeCode") else {
        panic!("no time code");
    };
    assert_eq!(
        (code.hours, code.minutes, code.seconds, code.frame),
        (0, 0, 2, 1)
    );
    assert_eq!(words(&read, "luch/commit").as_deref(), Some("é"));
    assert_eq!(
        attribute(&read, "luch/bvh/nodes"),
        Some(AttributeValue::F64(7.0))
    );
}

#[test]
fn an_exr_lists_its_layers_with_their_sums_and_units() {
    let layers = Layers {
        components: true,
        lights: Some(0),
        bounces: 2,
        ..Layers::default()
    };
    let mut film = film(1, Shown::Never, &[[0.0; 4]]);
    film.layers.extend(
        layers
            .of_parts(&[])
            .into_iter()
            .map(|layer| luch::film::Layer {
                values: vec![0.0; 3],
                ..layer
            }),
    );
    let read = read(&film, Header::default());
    let listed = words(&read, "luch/layers").unwrap();
    assert!(
        listed.starts_with("beauty, Z, diffuse, specular, "),
        "{listed}"
    );
    for (sum, expected) in [
        (
            "luch/sum/components",
            "beauty = diffuse + specular + reflection + transmission + emission + ambient",
        ),
        (
            "luch/sum/lights",
            "beauty = light_emission + light_ambient + light_environment + light_background",
        ),
        (
            "luch/sum/bounces",
            "reflection = reflection_1 + reflection_2",
        ),
    ] {
        assert_eq!(words(&read, sum).as_deref(), Some(expected));
    }
    let unit = words(&read, "luch/unit/Z").unwrap();
    assert!(unit.contains("scene units"), "{unit}");
}
