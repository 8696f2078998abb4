//! Textures: which image each shows, where on the mesh, and what becomes of images that cannot be read.

use super::file::{File, warnings};
use luch::load::Model;
use luch::material::Model as Shape;
use luch::texture::{Image, Pixels, TextureUse};
use serde_json::json;
use std::sync::Arc;

/// A picture of one pixel.
fn png(color: [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&color).expect("a pixel");
    writer.finish().expect("an end");
    bytes
}

fn webp(color: [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image_webp::WebPEncoder::new(&mut bytes)
        .encode(&color, 1, 1, image_webp::ColorType::Rgb8)
        .expect("a picture");
    bytes
}

fn base_texture(model: &Model, material: usize) -> Option<&TextureUse> {
    match &model.materials[material].model {
        Shape::MetallicRoughness(m) => m.base_color.texture.as_ref(),
        _ => None,
    }
}

fn base_image(model: &Model, material: usize) -> Option<&Arc<Image>> {
    let used = base_texture(model, material)?;
    Some(&model.textures[used.texture as usize].image)
}

fn first_pixel(image: &Image) -> [u8; 4] {
    match &image.pixels {
        Pixels::Eight(pixels) => pixels[0],
        Pixels::Sixteen(_) => panic!("8 bits expected"),
    }
}

/// A triangle whose materials show the file's textures, in order.
fn with_images(images: &[&[u8]], textures: serde_json::Value) -> File {
    let mut file = File::triangle();
    let views: Vec<usize> = images.iter().map(|image| file.view(image)).collect();
    let images = views.iter().map(|view| json!({"bufferView": view}));
    file.json["images"] = images.collect();
    let count = textures.as_array().map_or(0, Vec::len);
    file.json["textures"] = textures;
    let material = |i| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}});
    file.json["materials"] = (0..count).map(material).collect();
    file
}

#[test]
fn each_slot_has_a_transform_of_its_own() {
    let mut file = with_images(&[&png([1, 2, 3])], json!([{"source": 0}]));
    let moved = |transform| json!({"index": 0, "extensions": {"KHR_texture_transform": transform}});
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": {
            "baseColorTexture": moved(json!({"offset": [0.5, -1], "scale": [2, 3], "texCoord": 1})),
            "metallicRoughnessTexture": {"index": 0},
        },
        "normalTexture": moved(json!({"scale": [4, 4]})),
        "occlusionTexture": moved(json!({"offset": [0.25, 0]})),
        "emissiveTexture": moved(json!({"scale": "twice"})),
    }]);
    let model = file.model();
    let material = &model.materials[0];
    let Shape::MetallicRoughness(m) = &material.model else {
        panic!("{:?}", material.model)
    };
    let columns = |used: Option<&TextureUse>| {
        let used = used.expect("a texture");
        (used.uv_set, used.transform.map(|m| m.to_cols_array()))
    };
    assert_eq!(
        columns(m.base_color.texture.as_ref()),
        (1, Some([2., 0., 0., 0., 3., 0., 0.5, -1., 1.]))
    );
    assert_eq!(columns(m.metallic_roughness.as_ref()), (0, None));
    assert_eq!(
        columns(m.occlusion.texture.as_ref()),
        (0, Some([1., 0., 0., 0., 1., 0., 0.25, 0., 1.]))
    );
    assert_eq!(
        columns(material.normal_map.as_ref().map(|map| &map.texture)),
        (0, Some([4., 0., 0., 0., 4., 0., 0., 0., 1.]))
    );
    assert_eq!(columns(material.emission.texture.as_ref()), (0, None));
    let said = warnings(&model);
    assert!(
        said.iter()
            .any(|w| w.starts_with("material 0: invalid type: string \"twice\"")),
        "{said:?}"
    );
}

#[test]
fn an_extensions_image_comes_before_the_textures_own() {
    let images = [&webp([9, 8, 7])[..], &png([1, 2, 3])];
    let webp = json!({"EXT_texture_webp": {"source": 0}});
    let model = with_images(&images, json!([{"source": 1, "extensions": webp}])).model();
    let image = base_image(&model, 0).expect("an image");
    assert_eq!(first_pixel(image), [9, 8, 7, 255]);
    assert_eq!(warnings(&model), [""; 0]);
}

#[test]
fn the_textures_own_image_stands_for_one_that_cannot_be_read() {
    let images = [
        &b"RIFF\x04\0\0\0WEBP"[..],
        &png([1, 2, 3]),
        b"\xabKTX 20\xbb\r\n\x1a\n",
    ];
    let textures = json!([
        {"source": 1, "extensions": {"EXT_texture_webp": {"source": 0}}},
        {"source": 1, "extensions": {"KHR_texture_basisu": {"source": 2}}},
        {"source": 1, "extensions": {"KHR_texture_basisu": {"source": 7}}},
        {"source": 1, "extensions": {"EXT_texture_avif": {"source": 0}}},
        {"extensions": {"EXT_texture_webp": {"source": 0}}},
        {"extensions": {"EXT_texture_avif": {"source": 0}}},
    ]);
    let model = with_images(&images, textures).model();
    for material in 0..4 {
        let image = base_image(&model, material).expect("an image");
        assert_eq!(first_pixel(image), [1, 2, 3, 255]);
    }
    assert!(base_texture(&model, 4).is_none() && base_texture(&model, 5).is_none());
    assert_eq!(
        warnings(&model),
        [
            "texture 2: image 7 does not exist, there are 3: the extension is ignored",
            "texture 5: has no image that luch reads: it is left out",
            "image 0: broken WebP: IO Error: failed to fill whole buffer: it is left out",
            "image 2: broken KTX2: its header is not in the file: it is left out",
        ]
    );
}

#[test]
fn an_image_that_many_textures_show_is_decoded_once() {
    let mut file = with_images(
        &[&png([1, 2, 3]), &png([4, 5, 6])],
        json!([{"source": 0}, {"source": 0, "sampler": 0}, {"source": 2}, {"source": 1}]),
    );
    file.json["samplers"] = json!([{"wrapS": 33071, "magFilter": 9728}]);
    let same = file.json["images"][0].clone();
    super::file::push(&mut file.json["images"], same);
    let model = file.model();
    let images: Vec<_> = (0..4).filter_map(|m| base_image(&model, m)).collect();
    assert!(Arc::ptr_eq(images[0], images[1]) && Arc::ptr_eq(images[0], images[2]));
    assert_eq!(first_pixel(images[3]), [4, 5, 6, 255]);
}
