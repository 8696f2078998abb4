//! Rays that go the same way, as pictures make them: what packets are for.

use glam::Vec3;
use luch::accel::linear;
use luch::generate::Random;
use luch::ray::Ray;
use luch::scene::Scene;

/// Rays that are searched for in one call.
pub(super) struct Batch {
    pub(super) name: &'static str,
    pub(super) rays: Vec<Ray>,
}

/// What rays of a scene look at: vertices, the tops of spheres, and anything between.
struct Sights {
    points: Vec<Vec3>,
    size: f32,
    random: Random,
}

impl Sights {
    fn new(scene: &Scene) -> Sights {
        let vertices = scene.instances().iter().flat_map(|instance| {
            let to_world = move |p: &Vec3| match &instance.space {
                Some(space) => space.to_world.transform_point3(*p),
                None => *p,
            };
            scene
                .mesh(instance.mesh)
                .positions
                .iter()
                .take(300)
                .map(to_world)
        });
        let spheres = scene.spheres().iter();
        let mut points: Vec<Vec3> = spheres
            .map(|s| s.shape.center + Vec3::Y * s.shape.radius)
            .chain(vertices)
            .collect();
        if points.is_empty() {
            points.push(Vec3::ZERO);
        }
        let mut middle = points.clone();
        middle.sort_by(|a, b| a.length().total_cmp(&b.length()));
        let middle = middle[middle.len() / 2];
        // Not the size of the bounds: one sphere may be a million times the others.
        let mut distances: Vec<f32> = points.iter().map(|p| p.distance(middle)).collect();
        distances.sort_by(f32::total_cmp);
        let size = distances[distances.len() / 2].max(1e-5);
        Sights {
            points,
            size,
            random: Random::new(21),
        }
    }

    fn point(&mut self) -> Vec3 {
        let index = self.random.next_u64() as usize % self.points.len();
        self.points[index]
    }

    /// A tile of a picture: rays from one point, `spread` wide on both sides.
    fn tile(&mut self, count: usize, away: f32, spread: f32) -> Vec<Ray> {
        let target = self.point();
        let along = self.random.direction();
        let origin = target - along * (self.size * away);
        let right = along.any_orthonormal_vector();
        let up = along.cross(right);
        let ray = |index: usize| {
            let (x, y) = ((index % 8) as f32 - 3.5, (index / 8 % 8) as f32 - 3.5);
            let direction = along + (right * x + up * y) * (spread / 4.0);
            Ray::new(origin, direction.normalize(), 0.0, f32::INFINITY)
        };
        (0..count).map(ray).collect()
    }

    /// From one point in all directions with these components, most of them 0.
    fn along_axes(&mut self, components: Vec3) -> Vec<Ray> {
        let origin = self.point() - components * (self.size * 2.0);
        let ray = |index: usize| {
            let slant = Vec3::new(0.0, index as f32 * 0.01, 0.0) * components.abs();
            let direction = (components + slant).normalize();
            Ray::new(origin, direction, 0.0, f32::INFINITY)
        };
        (0..24).map(ray).collect()
    }

    /// From many points in one direction, as from a light that is far away.
    fn directional(&mut self, direction: Vec3, count: usize) -> Vec<Ray> {
        (0..count)
            .map(|_| {
                let jitter = self.random.in_cube() * (self.size * 0.2);
                let origin = self.point() + jitter - direction * (self.size * 4.0);
                Ray::new(origin, direction, 0.0, f32::INFINITY)
            })
            .collect()
    }
}

/// Batches of every size and kind for a scene.
pub(super) fn coherent(scene: &Scene) -> Vec<Batch> {
    let mut sights = Sights::new(scene);
    let mut batches = Vec::new();
    let mut add = |name, rays| batches.push(Batch { name, rays });
    for count in [1, 7, 8, 17, 64, 65, 200] {
        add("a tile", sights.tile(count, 3.0, 0.2));
    }
    add("a tile close by", sights.tile(64, 0.05, 0.4));
    add("a narrow tile far away", sights.tile(64, 1000.0, 1e-3));
    add("all octants", sights.tile(64, 0.3, 6.0));
    add("one ray, many times", sights.tile(64, 2.0, 0.0));
    for components in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.0, 1.0, -1.0), Vec3::ONE] {
        add("parallel to axes", sights.along_axes(components));
    }
    for direction in [
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::new(0.6, -0.8, 0.0),
        sights.random.direction(),
    ] {
        add("directional", sights.directional(direction, 64));
    }
    add("directional, few", sights.directional(Vec3::NEG_Z, 9));

    let mut limited = sights.tile(64, 3.0, 0.3);
    for (index, ray) in limited.iter_mut().enumerate() {
        ray.t_min = sights.size * (index % 5) as f32 * 0.7;
        ray.t_max = sights.size * (index % 7) as f32;
    }
    add("between two limits", limited);

    // Some end, some begin, exactly where there is something.
    let mut going_on = sights.tile(64, 3.0, 0.2);
    for (index, ray) in going_on.iter_mut().enumerate() {
        if let Some(hit) = linear::intersect(scene, ray) {
            match index % 4 {
                0 => *ray = ray.beyond(hit.t, hit.primitive),
                1 => ray.t_max = hit.t,
                2 => ray.t_min = hit.t,
                _ => {}
            }
        }
    }
    add("beyond what they met", going_on);
    batches
}
