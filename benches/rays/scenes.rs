//! The scenes of the table, by name, and any model file.

use glam::Vec3;
use luch::camera::Camera;
use luch::generate::{self, Decoration};
use luch::load::{self, Viewpoint};
use luch::mesh::Mesh;
use luch::scene::Scene;
use std::path::{Path, PathBuf};

/// The generated scenes, in the table's order.
pub(crate) const GENERATED: [&str; 5] = ["interior", "mesh", "terrain-1m", "hair", "terrain-8m"];

/// A real interior to hold beside the generated one, below the folder of test models.
const REAL_INTERIOR: &str = "valid/gkj-hotel-room-lotus-carpet/scene.glb";

/// The real interior, where the folder of test models is there: that of `LUCH_TEST_MODELS`.
pub(crate) fn real_interior() -> Option<PathBuf> {
    let root = std::env::var_os("LUCH_TEST_MODELS").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models"),
        PathBuf::from,
    );
    let file = root.join(REAL_INTERIOR);
    file.is_file().then_some(file)
}

/// Whether this is the name of a generated scene or of a file.
pub(crate) fn exists(name: &str) -> bool {
    GENERATED.contains(&name) || Path::new(name).is_file()
}

/// What the tables call a scene: a model named like its folder's others goes by its folder.
pub(crate) fn short_name(name: &str) -> String {
    let path = Path::new(name);
    let part = |path: &Path| {
        path.file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
    };
    match part(path) {
        Some(stem) if stem == "scene" => path.parent().and_then(part).unwrap_or(stem),
        Some(stem) if path.is_file() => stem,
        _ => name.to_owned(),
    }
}

/// The scene of this name.
pub(crate) fn make(name: &str) -> Result<Scene, String> {
    let camera = |position: [f32; 3], at: [f32; 3], fov: f64| {
        Camera::looking_at(Vec3::from(position), Vec3::from(at), Vec3::Y, fov)
    };
    let landscape = |cells| {
        generate::mesh_scene(
            generate::terrain(cells, 1),
            camera([0.0, 1.1, 0.95], [0.0, -0.1, 0.05], 0.58),
        )
    };
    let description = match name {
        "interior" => return interior(Decoration::Plain),
        "mesh" => generate::mesh_scene(statue(), camera([0.0, 0.3, 2.6], [0.0, 0.0, 0.0], 0.85)),
        "terrain-1m" => landscape(707),
        "hair" => generate::mesh_scene(
            generate::hair(50_000, 10, 2),
            camera([0.0, 0.3, 1.5], [0.0, 0.0, 0.0], 0.6),
        ),
        "terrain-8m" => landscape(2000),
        file => return open(Path::new(file)),
    };
    Scene::new(description).map_err(|error| error.to_string())
}

/// The generated room.
pub(crate) fn interior(decoration: Decoration) -> Result<Scene, String> {
    Scene::new(generate::interior(decoration)).map_err(|error| error.to_string())
}

/// A file, as `luch` frames and lights it.
fn open(file: &Path) -> Result<Scene, String> {
    let viewpoint = Viewpoint::of_file(16.0 / 9.0);
    let asset = load::open(file, &load::Options::default()).map_err(|error| error.to_string())?;
    let (scene, _) = asset
        .scene(0.0, &viewpoint)
        .map_err(|error| error.to_string())?;
    Ok(scene)
}

/// A closed body of 69,312 triangles with hollows and bulges of several sizes, like a scanned figure: a cube of grids
/// of 76 x 76, blown up to a sphere and displaced. Vertices that two sides share have the same bits.
fn statue() -> Mesh {
    const CELLS: i32 = 76;
    let mut mesh = Mesh::default();
    for (axis, end) in (0..3).flat_map(|axis| [(axis, CELLS), (axis, -CELLS)]) {
        let first = mesh.positions.len() as u32;
        let row = CELLS as u32 + 1;
        for (i, j) in (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| (i, j))) {
            let mut lattice = [end; 3];
            lattice[(axis + 1) % 3] = 2 * i - CELLS;
            lattice[(axis + 2) % 3] = 2 * j - CELLS;
            mesh.positions
                .push(skin(lattice.map(|x| x as f32 / CELLS as f32)));
        }
        let cells = (1..row).flat_map(|j| (1..row).map(move |i| first + j * row + i));
        mesh.triangles.extend(cells.flat_map(|d| {
            let (c, b, a) = (d - 1, d - row, d - row - 1);
            if end > 0 {
                [[a, b, d], [a, d, c]]
            } else {
                [[a, d, b], [a, c, d]]
            }
        }));
    }
    mesh
}

/// Where the statue has a point of the cube.
fn skin(of_cube: [f32; 3]) -> Vec3 {
    let p = Vec3::from(of_cube).normalize();
    let wave = |frequency: f32, phase: f32| {
        let q = (p * frequency + Vec3::new(1.0, 1.3, 2.1) * phase).map(libm::sinf);
        q.x * q.y * q.z
    };
    let height = 0.28 * wave(2.5, 0.4) + 0.12 * wave(6.0, 1.0) + 0.04 * wave(19.0, 2.0);
    p * (0.9 + height + 0.02 * wave(47.0, 3.0))
}

/// Every triangle in world space, in the order of the scene's primitives; `None` where there are primitives of other
/// kinds, which Embree would have to be given in another way.
pub(crate) fn triangles(scene: &Scene) -> Option<(Vec<Vec3>, Vec<[u32; 3]>)> {
    if !scene.spheres().is_empty() || !scene.planes().is_empty() {
        return None;
    }
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for instance in scene.instances() {
        let mesh = scene.mesh(instance.mesh);
        let first = positions.len() as u32;
        positions.extend(mesh.positions.iter().map(|p| match &instance.space {
            None => *p,
            Some(space) => space.to_world.transform_point3(*p),
        }));
        triangles.extend(
            mesh.triangles
                .iter()
                .map(|corners| corners.map(|i| first + i)),
        );
    }
    Some((positions, triangles))
}
