//! The world: what there is, checked once and read-only afterwards.

mod check;
mod cone;
mod description;
mod error;
mod ground;
mod layout;
mod look;
mod microfacets;
mod mix;
mod names;
mod pyramids;
mod sharing;
mod surface;
mod through;

pub use description::{Background, Instance, Object, SceneDescription, Shown};
pub use error::SceneError;
pub use ground::{GROUND, Ground};
pub use layout::{PlacedInstance, Primitive, Recent};
pub use names::Names;
pub(crate) use names::OwnNames;
pub use pyramids::PreparedTextures;
pub use sharing::InstanceSpace;
pub use surface::{Met, Place, Surface};
pub use through::{Filter, Through, Way};

use crate::camera::Camera;
use crate::color::Rgb;
use crate::environment::Surroundings;
use crate::geometry::{Bounds, Plane, Sphere};
use crate::light::{Lamp, Light};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::shade::Reflectance;
use crate::texture::Texture;
use pyramids::Pyramids;
use std::sync::Arc;

/// A world that can be rendered: everything finite, every index in range, every vector that must have a length has it.
#[derive(Clone, Debug)]
pub struct Scene {
    camera: Camera,
    background: Background,
    ambient: Rgb,
    environment: Option<Arc<Surroundings>>,
    ground: Option<Ground>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    pyramids: Pyramids,
    lights: Vec<Light>,
    spheres: Vec<Object<Sphere>>,
    planes: Vec<Object<Plane>>,
    meshes: Vec<Mesh>,
    instances: Vec<PlacedInstance>,
    primitive_count: u32,
    bytes: u64,
    /// Of each material that answers light the same way everywhere, how.
    plain: Vec<Option<Reflectance>>,
    lamps: Vec<Lamp>,
    has_volumes: bool,
}

impl Scene {
    /// Checks a description and lays it out. Plane normals and light directions become unit length; meshes that are
    /// not worth sharing are carried into world space (see [`InstanceSpace`]).
    ///
    /// # Errors
    ///
    /// The first thing that is wrong: a number that is not finite, a size that is not above zero, a direction without
    /// length, an index out of range, more primitives than 32 bits can number.
    pub fn new(description: SceneDescription) -> Result<Scene, SceneError> {
        Scene::new_within(description, u64::MAX)
    }

    /// [`Scene::new`] of a scene that takes at most so many bytes, a search tree included.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`]; and where it takes more, before it does.
    pub fn new_within(
        mut description: SceneDescription,
        most_bytes: u64,
    ) -> Result<Scene, SceneError> {
        check::check(&description)?;
        let primitive_count = layout::count_primitives(&description)?;
        let pyramids = Pyramids::of(&description.textures, &description.materials);
        let bytes = sharing::bytes(&description).saturating_add(pyramids.bytes());
        if bytes > most_bytes {
            return Err(SceneError::OutOfMemory {
                needs: bytes,
                left: most_bytes,
            });
        }
        for plane in &mut description.planes {
            plane.shape.normal = unit(plane.shape.normal);
        }
        description.lights.iter_mut().for_each(normalize_direction);
        let first_triangle = (description.spheres.len() + description.planes.len()) as u32;
        let (meshes, instances) =
            sharing::place(description.meshes, description.instances, first_triangle);
        check::check_placed(&meshes, &instances)?;
        // Last: a camera may have been framed to what was found wrong above.
        check::check_camera(&description.camera)?;
        let in_environment = description.environment.is_some();
        let plain = |material| look::plain(material, in_environment);
        let plain = description.materials.iter().map(plain).collect();
        let has_volumes = description.materials.iter().any(|m| m.volume().is_some());
        let lamps = description.lights.iter().map(Lamp::of).collect();
        Ok(Scene {
            camera: description.camera,
            background: description.background,
            ambient: description.ambient,
            environment: description.environment,
            ground: description.ground,
            materials: description.materials,
            textures: description.textures,
            pyramids,
            lights: description.lights,
            spheres: description.spheres,
            planes: description.planes,
            meshes,
            instances,
            primitive_count,
            bytes,
            plain,
            lamps,
            has_volumes,
        })
    }

    /// Where the picture is taken from.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The same, seen by another camera: all that was made of it still holds, search trees too.
    ///
    /// # Errors
    ///
    /// The camera is none, as [`Scene::new`] finds.
    pub fn with_camera(self, camera: Camera) -> Result<Scene, SceneError> {
        check::check_camera(&camera)?;
        Ok(Scene { camera, ..self })
    }

    /// What a ray that misses everything sees.
    pub fn background(&self) -> Background {
        self.background
    }

    /// Constant light from everywhere.
    pub fn ambient(&self) -> Rgb {
        self.ambient
    }

    /// Light from everywhere that is not constant.
    pub fn environment(&self) -> Option<&Surroundings> {
        self.environment.as_deref()
    }

    /// The floor that shows shadows.
    pub fn ground(&self) -> Option<&Ground> {
        self.ground.as_ref()
    }

    /// The materials, by index.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Whether light goes into any body, so that it matters how far.
    pub fn has_volumes(&self) -> bool {
        self.has_volumes
    }

    /// The lights, in the order in which their light is added.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The same lights, made ready.
    pub fn lamps(&self) -> &[Lamp] {
        &self.lamps
    }

    /// The analytic spheres: primitives 0 to their number.
    pub fn spheres(&self) -> &[Object<Sphere>] {
        &self.spheres
    }

    /// The analytic planes: the primitives after the spheres.
    pub fn planes(&self) -> &[Object<Plane>] {
        &self.planes
    }

    /// The meshes that instances name, each in the space its instances say.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// The placed meshes: their triangles are the primitives after the planes, instance after instance.
    pub fn instances(&self) -> &[PlacedInstance] {
        &self.instances
    }

    /// Spheres, planes, and the triangles of every instance.
    pub fn primitive_count(&self) -> u32 {
        self.primitive_count
    }

    /// About what its meshes, a search tree over it and the smaller versions of its textures take, in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The box around spheres and instances; planes have none.
    pub fn bounds(&self) -> Bounds {
        let spheres = self.spheres.iter().map(|sphere| sphere.shape.bounds());
        let instances = self.instances.iter().map(|instance| match &instance.space {
            Some(space) => space.bounds,
            None => self.mesh(instance.mesh).bounds(),
        });
        spheres.chain(instances).fold(Bounds::EMPTY, Bounds::union)
    }

    /// A mesh by index: in range for the indices of a scene's own instances.
    pub fn mesh(&self, index: u32) -> &Mesh {
        &self.meshes[index as usize]
    }

    /// A material by index: in range for the indices of a scene's own objects.
    pub fn material(&self, index: u32) -> &Material {
        &self.materials[index as usize]
    }
}

/// Unit length for what [`check`] found to have a length.
fn unit(v: glam::Vec3) -> glam::Vec3 {
    v.as_dvec3().normalize_or(glam::DVec3::Y).as_vec3()
}

fn normalize_direction(light: &mut Light) {
    use crate::light::LightKind::{Directional, Point, Spot};
    match &mut light.kind {
        Directional { direction } | Spot { direction, .. } => *direction = unit(*direction),
        Point { .. } => {}
    }
}
