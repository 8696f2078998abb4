//! What a model's nodes place in a scene.

use super::PlacedModel;
use crate::light::Light;
use crate::load::names::ModelNames;
use crate::load::pose::{Pose, PosedMeshes};
use crate::load::viewpoint::{self, Choices};
use crate::scene::{Instance, SceneDescription};

impl PlacedModel {
    /// Adds what the model's nodes place in a pose. Of each of its meshes, which of the scene's it is to be: those are
    /// empty yet.
    pub(super) fn add_to(
        &self,
        pose: &Pose,
        names: ModelNames,
        scene: &mut SceneDescription,
        choices: &mut Choices,
    ) -> Vec<Option<u32>> {
        let model = &self.model;
        let [first_material, first_texture] =
            [scene.materials.len(), scene.textures.len()].map(|length| length as u32);
        scene.textures.extend_from_slice(&model.textures);
        scene
            .materials
            .extend(
                pose.materials
                    .iter()
                    .zip(names.materials)
                    .map(|(material, name)| {
                        let mut material = material.clone();
                        material.name = name;
                        material
                            .textures_mut()
                            .for_each(|used| used.texture += first_texture);
                        material
                    }),
            );
        let mut meshes = PosedMeshes::of(pose);
        for posed in pose.nodes.iter().filter(|posed| posed.is_visible) {
            let node = posed.node;
            let name = names.nodes.get(posed.index).map_or("", String::as_str);
            let to_world = self.to_world * posed.to_model;
            if let Some(light) = node.light.and_then(|light| pose.lights.get(light)) {
                let of_light = if light.name.is_empty() {
                    &node.name
                } else {
                    &light.name
                };
                let carried = viewpoint::carried(light, &to_world);
                scene.lights.push(Light {
                    name: of_light.clone(),
                    ..carried
                });
            }
            if let Some(analytic) = &node.analytic {
                let material = self.material.unwrap_or(first_material + analytic.material);
                analytic.add_to(scene, name, material, to_world);
            }
            let parts = node
                .shape
                .and_then(|shape| model.shapes.get(shape))
                .map_or(&[][..], |shape| &shape.parts);
            for part in parts {
                let (mesh, to_model) = meshes.place(posed, part, &mut scene.meshes);
                for to_model in node.places(to_model) {
                    scene.instances.push(Instance {
                        name: name.to_owned(),
                        mesh,
                        material: self.material.unwrap_or(first_material + part.material),
                        to_world: self.to_world * to_model,
                    });
                }
            }
        }
        for (count, what) in [(pose.nowhere, "node"), (meshes.left_out, "triangle")] {
            if count > 0 {
                choices.lines.push(format!(
                    "pose: {count} {what}{} whose place is not of finite numbers then",
                    if count == 1 {
                        " is left out,"
                    } else {
                        "s are left out,"
                    }
                ));
            }
        }
        meshes.own
    }
}
