//! No ray slips through an edge or a vertex of a closed mesh.

use crate::common::scenes;
use glam::{DAffine3, DVec3, Vec3};
use luch::accel::{Accel, Isa, Options};
use luch::generate::{self, Random};
use luch::mesh::Mesh;
use luch::ray::Ray;
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};

/// So many rays in all, alone and in packets, with every kernel.
const RAYS: usize = 2_400_000;

/// A closed mesh, and for each vertex a point well inside that sees it.
struct Closed {
    name: String,
    mesh: Mesh,
    hearts: Vec<Vec3>,
    /// How large the mesh is.
    scale: f32,
    /// How far inside, as a share of the way to the heart, rounding cannot carry a point out.
    inside: f32,
}

/// A vertex, or a point of an edge: where neighbours must agree.
#[derive(Clone, Copy)]
struct Target {
    point: Vec3,
    heart: Vec3,
    /// The least and the mean of the normals of all triangles there.
    normals: [Vec3; 6],
    out: Vec3,
}

/// A point as something that can be looked up.
fn key(p: Vec3) -> [u32; 3] {
    (p + Vec3::ZERO).to_array().map(f32::to_bits)
}

fn cube() -> (Mesh, Vec<Vec3>) {
    let positions = (0..8).map(|i: u32| {
        let side = |bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
        Vec3::new(side(1), side(2), side(4))
    });
    let mesh = Mesh {
        positions: positions.collect(),
        triangles: vec![
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
        ],
        ..Mesh::default()
    };
    (mesh, vec![Vec3::ZERO; 8])
}

fn icosphere() -> (Mesh, Vec<Vec3>) {
    let mesh = generate::icosphere(4);
    let hearts = vec![Vec3::ZERO; mesh.positions.len()];
    (mesh, hearts)
}

/// A tube: the heart of a vertex is in the middle of its ring.
fn knot() -> (Mesh, Vec<Vec3>) {
    let around = 20;
    let mesh = generate::knot(240, around);
    let ring = around as usize + 1;
    let middle = |ring: &[Vec3]| ring[1..].iter().sum::<Vec3>() / around as f32;
    let hearts = mesh
        .positions
        .chunks(ring)
        .flat_map(|r| vec![middle(r); r.len()]);
    let hearts = hearts.collect();
    (mesh, hearts)
}

fn all() -> Vec<Closed> {
    let mut all = Vec::new();
    for (scale, moved) in [(1e-3, 0.0), (1.0, 0.0), (1e3, 0.0), (1.0, 1e4), (1e3, 1e4)] {
        let offset = DVec3::new(moved, -moved, moved);
        let to_world =
            DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
        for (name, (mesh, hearts)) in [
            ("cube", cube()),
            ("icosphere", icosphere()),
            ("knot", knot()),
        ] {
            let place = |p: Vec3| to_world.transform_point3(p.as_dvec3()).as_vec3();
            all.push(Closed {
                name: format!("{name} scaled by {scale} and moved by {moved}"),
                mesh: mesh.transformed(&to_world),
                hearts: hearts.into_iter().map(place).collect(),
                scale: scale as f32,
                inside: if moved > scale * 100.0 { 0.05 } else { 1e-3 },
            });
        }
    }
    all
}

impl Closed {
    /// All vertices and two points of each edge, neighbours together.
    fn targets(&self) -> Vec<Target> {
        let mesh = &self.mesh;
        let corners = |index: usize| mesh.triangles[index].map(|i| mesh.positions[i as usize]);
        let mut around: HashMap<[u32; 3], BTreeSet<usize>> = HashMap::new();
        for index in 0..mesh.triangles.len() {
            for corner in corners(index) {
                around.entry(key(corner)).or_default().insert(index);
            }
        }
        let normal = |index: &usize| mesh.triangle(*index as u32).normal();
        let target = |point: Vec3, heart: Vec3, triangles: &BTreeSet<usize>| {
            let mut normals = [normal(triangles.iter().next().expect("a triangle")); 6];
            triangles
                .iter()
                .zip(&mut normals)
                .for_each(|(i, n)| *n = normal(i));
            assert!(
                triangles.len() <= 6,
                "{}: {} triangles at {point}",
                self.name,
                triangles.len()
            );
            let out = normals.iter().sum::<Vec3>().normalize();
            Target {
                point,
                heart,
                normals,
                out,
            }
        };
        let mut random = Random::new(8);
        let mut targets = Vec::new();
        for indices in &mesh.triangles {
            let [a, b, c] = indices.map(|i| i as usize);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (mesh.positions[p], mesh.positions[q]);
                let at_vertex = &around[&key(from)];
                targets.push(target(from, self.hearts[p], at_vertex));
                let at_edge: BTreeSet<usize> = at_vertex & &around[&key(to)];
                assert_eq!(at_edge.len(), 2, "{} is closed", self.name);
                for share in [0.5, 0.2 + 0.6 * random.next_f32()] {
                    let heart = self.hearts[p].lerp(self.hearts[q], share);
                    targets.push(target(from.lerp(to, share), heart, &at_edge));
                }
            }
        }
        targets
    }

    /// Rays that must meet the mesh, 64 that go much the same way after another 64.
    fn rays(&self, targets: &[Target], count: usize) -> Vec<Ray> {
        let mut random = Random::new(9);
        let mut rays = Vec::with_capacity(count + 64);
        let mut packet = Vec::with_capacity(64);
        while rays.len() < count {
            let first = random.next_u64() as usize % targets.len();
            let center = targets[first];
            let neighbours = (first..first + 400).map(|i| targets[i % targets.len()]);
            let kind = random.next_u64() % 6;
            let towards = random.next_f32().max(0.1);
            let eye = match kind {
                0 => center.point.lerp(center.heart, towards),
                _ => {
                    let away = [2.0, 20.0, 2000.0][kind as usize % 3] * self.scale;
                    let slant = (center.out + random.in_cube() * 0.3).normalize();
                    center.point + slant * away
                }
            };
            let just_outside = 0.02 * self.scale;
            packet.clear();
            packet.extend(
                neighbours
                    .filter_map(|target| {
                        let origin = match kind {
                            0 | 3 | 4 | 5 => eye,
                            // Just inside, and not at the nearest wall alone.
                            1 => target.point.lerp(target.heart, self.inside),
                            _ => target.point + target.out * just_outside,
                        };
                        let direction = match kind {
                            1 if rays.len() % 128 == 0 => center.point - target.heart,
                            _ => target.point - origin,
                        };
                        let ray = Ray::new(origin, direction.normalize(), 0.0, f32::INFINITY);
                        // From outside the direction is rounded: what is seen must not be the outline.
                        let seen = target.normals.iter().all(|n| n.dot(-ray.direction) > 0.3);
                        (kind <= 1 || seen).then_some(ray)
                    })
                    .take(64),
            );
            rays.extend_from_slice(&packet);
        }
        rays
    }
}

#[test]
fn no_ray_slips_through_an_edge_or_a_vertex() {
    let meshes = all();
    let kernels = Isa::available();
    let count = RAYS / (meshes.len() * kernels.len() * 2);
    let traced: usize = meshes
        .into_par_iter()
        .map(|closed| {
            let rays = closed.rays(&closed.targets(), count);
            let scene = scenes::mesh_scene(closed.mesh).expect("a scene");
            let mut traced = 0;
            for &isa in &kernels {
                for packets in [false, true] {
                    let options = Options {
                        isa,
                        packets,
                        ..Options::default()
                    };
                    let accel = Accel::build(&scene, &options);
                    let (mut hits, mut occluded) = (Vec::new(), Vec::new());
                    accel.intersect_all(&rays, &mut hits);
                    accel.occluded_all(&rays, &mut occluded);
                    for (index, ray) in rays.iter().enumerate() {
                        let met = (hits[index].is_some(), occluded[index]);
                        assert_eq!(met, (true, true), "{}, {options:?}: {ray:?}", closed.name);
                    }
                    traced += rays.len();
                }
            }
            traced
        })
        .sum();
    assert!(traced >= 2_000_000, "{traced} rays");
}
