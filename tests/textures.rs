//! Textures, averaged over what rays see of them: a checkered floor to the horizon, and what one sample a pixel makes of it
//! beside 256 points a pixel.

use glam::{DAffine3, Vec2, Vec3};
use luch::accel::{Accel, Options};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::geometry::Plane;
use luch::material::{Material, Model, Textured};
use luch::mesh::Mesh;
use luch::render::{Progress, Settings, render};
use luch::scene::{Instance, Object, Scene, SceneDescription};
use luch::shade::Shading;
use luch::texture::{
    Checker, Encoding, Filter, Image, Pixels, Texture, TextureFilter, TextureUse, Wrap,
};
use std::sync::Arc;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;
/// The first row of which every sample lies on the floor.
const HORIZON: u32 = HEIGHT / 2;

/// Over the floor, level, at an angle to its squares.
fn camera() -> Camera {
    Camera::looking_at(
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.3, 1.0, -1.0),
        Vec3::Y,
        1.0,
    )
}

/// Black and white squares of side 1.
fn checker_plane() -> SceneDescription {
    let mut material = Material::matt("checker", Rgb::BLACK);
    if let Model::Phong(phong) = &mut material.model {
        phong.checker = Some(Checker {
            color: Rgb::WHITE,
            size: 1.0,
        });
    }
    let shape = Plane {
        point: Vec3::ZERO,
        normal: Vec3::Y,
    };
    let plane = Object {
        name: String::new(),
        shape,
        material: 0,
    };
    SceneDescription {
        materials: vec![material],
        planes: vec![plane],
        ..SceneDescription::empty(camera())
    }
}

/// Two by two squares of 16 pixels.
fn board(filter: Filter) -> Texture {
    let pixel = |at: u32| {
        let white = 255 * ((at % 32 / 16 + at / 32 / 16) % 2) as u8;
        [white, white, white, 255]
    };
    Texture {
        image: Arc::new(Image {
            name: String::new(),
            width: 32,
            height: 32,
            pixels: Pixels::Eight((0..32 * 32).map(pixel).collect()),
        }),
        wrap: [Wrap::Repeat; 2],
        filter,
        mipmaps: true,
        encoding: Encoding::Srgb,
    }
}

fn textured(texture: u32) -> Material {
    let mut material = Material::matt("board", Rgb::WHITE);
    if let Model::Phong(phong) = &mut material.model {
        phong.diffuse = Textured {
            factor: Rgb::WHITE,
            texture: Some(TextureUse {
                texture,
                uv_set: 0,
                transform: None,
            }),
        };
    }
    material
}

/// A square about the origin, on the floor, its texture once every two units.
fn quad(reach: f32) -> Mesh {
    let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(Vec2::from);
    Mesh {
        positions: corners
            .map(|c| Vec3::new(c.x, 0.0, c.y) * reach)
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        uvs: [corners.map(|c| c * reach / 2.0).to_vec(), Vec::new()],
        ..Mesh::default()
    }
}

/// The same floor as a textured mesh, very large.
fn textured_quad() -> SceneDescription {
    let instance = Instance {
        name: String::new(),
        mesh: 0,
        material: 0,
        to_world: DAffine3::IDENTITY,
    };
    SceneDescription {
        materials: vec![textured(0)],
        textures: vec![board(Filter::Linear)],
        meshes: vec![quad(2000.0)],
        instances: vec![instance],
        ..SceneDescription::empty(camera())
    }
}

/// The red of every pixel, flat.
fn seen(scene: &SceneDescription, samples: u32, filter: TextureFilter) -> Vec<f32> {
    let scene = Scene::new(scene.clone()).expect("a scene");
    let settings = Settings::new(WIDTH, HEIGHT, samples, 5, Shading::Flat).expect("settings");
    let film = render(
        &scene,
        &Accel::build(&scene, &Options::default()),
        &settings.with_texture_filter(filter),
        &Progress::default(),
    );
    film.beauty().map(|[red, ..]| red).collect()
}

fn rows(picture: &[f32], from: u32, to: u32) -> &[f32] {
    &picture[(from * WIDTH) as usize..(to * WIDTH) as usize]
}

/// The mean and the greatest difference.
fn difference(a: &[f32], b: &[f32]) -> [f32; 2] {
    let all: Vec<f32> = a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect();
    let mean = all.iter().sum::<f32>() / all.len() as f32;
    [mean, all.into_iter().fold(0.0, f32::max)]
}

fn spread(values: &[f32]) -> f32 {
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    let squares = values.iter().map(|v| (v - mean) * (v - mean));
    (squares.sum::<f32>() / values.len() as f32).sqrt()
}

#[test]
fn measure() {
    for (name, scene) in [("plane", checker_plane()), ("quad", textured_quad())] {
        let exact = seen(&scene, 256, TextureFilter::Point);
        for samples in [1, 4] {
            for filter in [TextureFilter::Point, TextureFilter::Footprint] {
                let found = seen(&scene, samples, filter);
                println!("{name} {samples} {filter:?}");
                for (from, to) in [(HORIZON + 1, HEIGHT), (HORIZON + 1, 36), (36, 40), (40, 48), (48, HEIGHT)] {
                    let (a, b) = (rows(&found, from, to), rows(&exact, from, to));
                    println!("  {from}..{to}: {:?} spread {} of {}", difference(a, b), spread(a), spread(b));
                }
            }
        }
    }
}
