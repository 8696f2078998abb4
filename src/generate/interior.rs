//! A furnished room: what makes a search hard in practice, walls of two triangles beside handles and fringes of
//! thousands.

mod dining;
mod furniture;
mod parts;
mod shell;

use super::Random;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::light::{Falloff, Light, LightKind};
use crate::material::{Material, Model, Textured};
use crate::mesh::Mesh;
use crate::scene::{Background, Instance, SceneDescription, Shown};
use crate::texture::{Encoding, Filter, Image, Pixels, Texture, TextureUse, Wrap};
use glam::{DAffine3, Vec3};
use std::sync::Arc;

/// Whether the surfaces of [`interior`] carry textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decoration {
    /// One colour a material.
    Plain,
    /// An image of 512 x 512 pixels on every material.
    Textured,
}

/// A dining room of about 88,000 triangles, lit by a lamp over the table and one in a corner, seen from inside. It has
/// one mesh and one material for each of seven finishes; normals are smooth where things are round.
pub fn interior(decoration: Decoration) -> SceneDescription {
    let size = Vec3::new(5.2, 2.6, 4.4);
    let mut room = Room::default();
    shell::shell(&mut room, size);
    shell::window(&mut room);
    let table = Vec3::new(2.6, 0.0, 1.7);
    shell::rug(&mut room, table);
    dining::table(&mut room, table);
    for x in [-0.45, 0.45] {
        dining::chair(&mut room, table + Vec3::new(x, 0.0, -0.7), 1.0);
        dining::chair(&mut room, table + Vec3::new(x, 0.0, 0.7), -1.0);
    }
    furniture::cupboards(&mut room, Vec3::new(0.02, 0.0, 0.3), 4);
    furniture::sofa(&mut room, Vec3::new(3.6, 0.0, 3.85));
    let lamp = table + Vec3::Y * 1.55;
    dining::hanging_lamp(&mut room, lamp, size.y);
    furniture::plant(&mut room, Vec3::new(4.8, 0.0, 0.4));

    let position = Vec3::new(4.7, 1.75, 3.1);
    let camera = Camera::looking_at(position, Vec3::new(1.3, 0.75, 1.2), Vec3::Y, 1.0);
    let light = |position, intensity| Light {
        name: String::new(),
        kind: LightKind::Point { position },
        color: Rgb::WHITE,
        intensity,
        falloff: Falloff::InverseSquare,
        range: None,
    };
    SceneDescription {
        background: Background::plain(Rgb::grey(0.6), Shown::Always),
        ambient: Rgb::grey(0.1),
        lights: vec![
            light(lamp - Vec3::Y * 0.02, 1.5),
            light(Vec3::new(4.9, 2.2, 4.0), 1.0),
        ],
        ..room.described(camera, decoration)
    }
}

/// What a thing is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finish {
    Wall,
    Floor,
    Wood,
    Metal,
    Cloth,
    China,
    Leaf,
}

impl Finish {
    const ALL: [Finish; 7] = [
        Finish::Wall,
        Finish::Floor,
        Finish::Wood,
        Finish::Metal,
        Finish::Cloth,
        Finish::China,
        Finish::Leaf,
    ];

    /// Name, colour, and the share of mirrored light.
    fn looks(self) -> (&'static str, Rgb, f32) {
        let rgb = |r, g, b| Rgb { r, g, b };
        match self {
            Finish::Wall => ("wall", rgb(0.8, 0.78, 0.72), 0.0),
            Finish::Floor => ("floor", rgb(0.4, 0.28, 0.18), 0.1),
            Finish::Wood => ("wood", rgb(0.45, 0.27, 0.14), 0.0),
            Finish::Metal => ("metal", rgb(0.3, 0.3, 0.32), 0.5),
            Finish::Cloth => ("cloth", rgb(0.25, 0.35, 0.5), 0.0),
            Finish::China => ("china", rgb(0.85, 0.85, 0.82), 0.05),
            Finish::Leaf => ("leaf", rgb(0.15, 0.4, 0.12), 0.0),
        }
    }
}

/// One mesh for each finish.
#[derive(Default)]
struct Room {
    meshes: [Mesh; Finish::ALL.len()],
}

impl Room {
    /// The mesh that has this finish.
    fn of(&mut self, finish: Finish) -> &mut Mesh {
        &mut self.meshes[finish as usize]
    }

    fn described(self, camera: Camera, decoration: Decoration) -> SceneDescription {
        let textured = decoration == Decoration::Textured;
        let material = |(texture, finish): (u32, Finish)| {
            let (name, color, reflectivity) = finish.looks();
            let mut material = Material::matt(name, color);
            if let Model::Phong(phong) = &mut material.model {
                phong.reflectivity = Rgb::grey(reflectivity);
                phong.specular = Textured::uniform(Rgb::grey(reflectivity));
                phong.diffuse.texture = textured.then_some(TextureUse {
                    texture,
                    uv_set: 0,
                    transform: None,
                });
            }
            material
        };
        let textures = Finish::ALL.map(|finish| grained(finish as u64));
        let instances = (0..).zip(Finish::ALL).map(|(number, finish)| Instance {
            name: finish.looks().0.into(),
            mesh: number,
            material: number,
            to_world: DAffine3::IDENTITY,
        });
        let named = self.meshes.into_iter().zip(Finish::ALL);
        SceneDescription {
            materials: (0..).zip(Finish::ALL).map(material).collect(),
            textures: if textured {
                textures.into()
            } else {
                Vec::new()
            },
            instances: instances.collect(),
            meshes: named
                .map(|(mesh, finish)| Mesh {
                    name: finish.looks().0.into(),
                    ..mesh
                })
                .collect(),
            ..SceneDescription::empty(camera)
        }
    }
}

/// Light squares with a random grain.
fn grained(seed: u64) -> Texture {
    const SIDE: u32 = 512;
    let mut random = Random::new(seed);
    let pixel = |at: u32| {
        let odd = (at % SIDE / 64 + at / SIDE / 64) % 2 == 1;
        let grain = (random.next_u64() >> 59) as u8;
        let grey = if odd { 220 } else { 190 } + grain;
        [grey, grey, grey, 255]
    };
    Texture {
        image: Arc::new(Image {
            name: format!("grain-{seed}"),
            width: SIDE,
            height: SIDE,
            pixels: Pixels::Eight((0..SIDE * SIDE).map(pixel).collect()),
        }),
        wrap: [Wrap::Repeat; 2],
        filter: Filter::Linear,
        mipmaps: true,
        encoding: Encoding::Srgb,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn the_room_is_a_scene_of_the_size_of_a_real_one() {
        for decoration in [Decoration::Plain, Decoration::Textured] {
            let triangles = Scene::new(interior(decoration)).map(|scene| scene.primitive_count());
            assert!(matches!(triangles, Ok(50_000..100_000)), "{triangles:?}");
        }
    }

    #[test]
    fn no_triangle_is_empty_and_normals_are_units_on_its_front() {
        for mesh in interior(Decoration::Plain).meshes {
            assert_eq!(mesh.normals.len(), mesh.positions.len());
            assert_eq!(mesh.uvs[0].len(), mesh.positions.len());
            for (index, corners) in (0..).zip(&mesh.triangles) {
                let [a, b, c] = mesh.triangle(index).0.map(Vec3::as_dvec3);
                let doubled = (b - a).cross(c - a);
                assert!(doubled.length() > 1e-10, "{} {index}", mesh.name);
                let towards = corners.map(|k| mesh.normals[k as usize].as_dvec3().dot(doubled));
                // A rim's smooth normals may look past one of its sides, but not all three.
                assert!(
                    towards.into_iter().sum::<f64>() > 0.0,
                    "{} {index}: {towards:?}",
                    mesh.name
                );
            }
        }
    }

    #[test]
    fn walls_are_a_million_times_as_large_as_the_smallest_details() {
        let meshes = interior(Decoration::Plain).meshes;
        let areas = meshes.iter().flat_map(|mesh| {
            (0..mesh.triangles.len() as u32).map(|index| {
                let [a, b, c] = mesh.triangle(index).0;
                (b - a).cross(c - a).length() / 2.0
            })
        });
        let (least, most) = areas.fold((f32::MAX, 0f32), |(least, most), area| {
            (least.min(area), most.max(area))
        });
        assert!(most / least > 1e6);
    }
}
