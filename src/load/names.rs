//! A name for each thing of a scene, the same at every moment: by a model's whole tree, not by what of it is seen.

use super::{Asset, Model};
use crate::scene::OwnNames;
use std::borrow::Cow;

/// What the parts of a model are called in a scene.
#[derive(Debug)]
pub(super) struct ModelNames {
    /// Of the nodes that show something, by their index; others have none.
    pub(super) nodes: Vec<String>,
    /// By their index.
    pub(super) materials: Vec<String>,
}

/// Those of each model of an asset, in order.
pub(super) fn of_models(asset: &Asset) -> Vec<ModelNames> {
    let models = || asset.models.iter().map(|placed| &placed.model);
    let all_nodes: Vec<Cow<'_, str>> = models().flat_map(nodes).flatten().collect();
    let mut of_nodes = OwnNames::among(all_nodes.iter().map(|name| &**name));
    let of_asset = asset.materials.iter();
    let all = of_asset.chain(models().flat_map(|model| &model.materials));
    let mut of_materials = OwnNames::among(all.map(|material| material.name.as_str()));
    for material in &asset.materials {
        of_materials.own(&material.name);
    }
    let own = |model: &Model| ModelNames {
        nodes: nodes(model)
            .map(|name| name.map_or_else(String::new, |name| of_nodes.own(&name)))
            .collect(),
        materials: (0..)
            .zip(&model.materials)
            .map(|(index, material): (u32, _)| match material.name.as_str() {
                "" => of_materials.own(&format!("material {index}")),
                name => of_materials.own(name),
            })
            .collect(),
    };
    models().map(own).collect()
}

/// What each node of a model wants to be called, if it shows something: as its file calls it or its mesh.
fn nodes(model: &Model) -> impl Iterator<Item = Option<Cow<'_, str>>> {
    model.nodes.iter().enumerate().map(|(index, node)| {
        let shape = node.shape.and_then(|shape| model.shapes.get(shape));
        if shape.is_none() && node.analytic.is_none() {
            return None;
        }
        let of_shape = shape.map_or("", |shape| shape.name.as_str());
        let names = [node.name.as_str(), of_shape];
        let name = names.into_iter().find(|name| !name.is_empty());
        Some(name.map_or_else(|| format!("node {index}").into(), Cow::from))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::load::{ModelMesh, Node};
    use crate::material::Material;

    #[test]
    fn nodes_and_materials_of_one_name_or_none_are_told_apart_in_the_order_of_the_file() {
        let shown = |name: &str, shape| Node {
            name: name.into(),
            shape,
            // What is not seen has its name, too.
            is_hidden: name == "wheel",
            ..Node::default()
        };
        let shape = |name: &str| ModelMesh {
            name: name.into(),
            ..ModelMesh::default()
        };
        let model = Model {
            nodes: vec![
                shown("wheel", Some(0)),
                shown("wheel", None),
                shown("", Some(0)),
                shown("wheel", Some(1)),
                shown("", Some(1)),
            ],
            shapes: vec![shape(""), shape("tyre")],
            materials: ["", "paint", "paint"]
                .map(|name| Material::matt(name, Rgb::WHITE))
                .into(),
            ..Model::default()
        };
        let asset = Asset::from(model);
        let names = &of_models(&asset)[0];
        assert_eq!(names.nodes, ["wheel", "", "node 2", "wheel.2", "tyre"]);
        assert_eq!(names.materials, ["material 0", "paint", "paint.2"]);
    }
}
