//! A triangle with five PNGs of 2048 x 2048, and each of them alone; throughput in pixels.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Throughput};
use luch::load;
use std::fs::{self, File};
use std::path::Path;

/// Pixels of a texture's side.
const TEXTURE_SIZE: u32 = 2048;

/// The slots of a material, each with a texture of its own.
const SLOTS: [&str; 5] = ["color", "roughness", "normal", "occlusion", "emissive"];

pub(super) fn case(group: &mut BenchmarkGroup<WallTime>, folder: &Path) {
    for (slot, name) in SLOTS.iter().enumerate() {
        write_png(&folder.join(format!("{name}.png")), slot as u32);
    }
    let all: Vec<usize> = (0..SLOTS.len()).collect();
    let mut case = |name: &str, slots: &[usize]| {
        let path = folder.join(format!("{name}.gltf"));
        fs::write(&path, with_textures(slots)).expect("a model");
        let pixels = slots.len() as u64 * u64::from(TEXTURE_SIZE) * u64::from(TEXTURE_SIZE);
        group.throughput(Throughput::Elements(pixels));
        group.bench_function(format!("textures/{name}"), |bench| {
            bench.iter(|| load::open(&path, &load::Options::default()))
        });
    };
    case("all", &all);
    for (slot, name) in SLOTS.iter().enumerate() {
        case(name, &[slot]);
    }
}

/// A triangle whose material has textures in some of its slots.
fn with_textures(slots: &[usize]) -> String {
    // A slot whose own texture is not asked for shows the first.
    let texture = |slot: usize| {
        let index = slots.iter().position(|&s| s == slot).unwrap_or(0);
        format!("{{\"index\": {index}}}")
    };
    let images: Vec<String> = slots
        .iter()
        .map(|&slot| format!("{{\"uri\": \"{}.png\"}}", SLOTS[slot]))
        .collect();
    let textures: Vec<String> = (0..slots.len())
        .map(|index| format!("{{\"source\": {index}}}"))
        .collect();
    // Three corners: (0, 0, 0), (1, 0, 0), (0, 1, 0).
    let buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "buffers": [{{"byteLength": 36, "uri": "data:;base64,{buffer}"}}],
        "images": [{}], "textures": [{}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {}, "metallicRoughnessTexture": {}}},
            "normalTexture": {}, "occlusionTexture": {}, "emissiveTexture": {}}}]}}"#,
        images.join(", "),
        textures.join(", "),
        texture(0),
        texture(1),
        texture(2),
        texture(3),
        texture(4),
    )
}

/// Waves with some noise, as hard to unpack as a photograph; the later slots are smoother and so quicker.
fn write_png(path: &Path, slot: u32) {
    let mut random = 12_345_u32 + slot;
    let mut pixels = Vec::with_capacity((TEXTURE_SIZE * TEXTURE_SIZE * 3) as usize);
    for y in 0..TEXTURE_SIZE {
        for x in 0..TEXTURE_SIZE {
            for channel in 0..3 {
                random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let noise = (random >> 24) >> (3 + slot / 2);
                let wave = (x * (channel + 1) / 16) ^ (y / 8 + slot);
                pixels.push((wave % 200 + noise) as u8);
            }
        }
    }
    let file = File::create(path).expect("a file");
    let mut encoder = png::Encoder::new(file, TEXTURE_SIZE, TEXTURE_SIZE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&pixels).expect("pixels");
    writer.finish().expect("an end");
}
