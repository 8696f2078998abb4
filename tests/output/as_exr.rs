//! EXR, read back.

use super::{encoded, film};
use exr::prelude::{AttributeValue, FlatSamples, ReadChannels, ReadLayers, Text, f16, read};
use luch::film::{COST, FAR_AWAY, Film, Layer};
use luch::output::{Format, Options};
use luch::scene::Shown;
use std::io;

type Reading = exr::prelude::Image<exr::prelude::Layer<exr::prelude::AnyChannels<FlatSamples>>>;

fn exr(film: &Film, comments: Option<&str>) -> Reading {
    let options = Options {
        comments: comments.map(str::to_owned),
        ..Options::default()
    };
    let bytes = encoded(film, Format::Exr, &options);
    read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .pedantic()
        .non_parallel()
        .from_buffered(io::Cursor::new(bytes))
        .unwrap()
}

/// The channel of that name as 32-bit floats, and whether the file has it as such.
fn exr_channel(image: &Reading, name: &str) -> (Vec<f32>, bool) {
    let channels = &image.layer_data.channel_data.list;
    let channel = channels.iter().find(|channel| channel.name.eq(name));
    match &channel.unwrap().sample_data {
        FlatSamples::F16(values) => (values.iter().map(|v| v.to_f32()).collect(), false),
        FlatSamples::F32(values) => (values.clone(), true),
        FlatSamples::U32(_) => panic!("no layer is of whole numbers"),
    }
}

#[test]
fn an_exr_keeps_light_as_halves_and_depth_as_floats() {
    let pixels = [
        [0.1, 2.0, 3000.0, 1.0],
        [0.0, 0.25, 0.5, 0.5],
        [0.0; 4],
        [0.0; 4],
    ];
    // However the background is shown: the film has it in its beauty, or not.
    for shown in [Shown::Always, Shown::OnDisplay, Shown::Never] {
        let image = exr(&film(2, shown, &pixels), None);
        assert_eq!(image.layer_data.size, exr::math::Vec2(2, 2));
        for (channel, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
            let expected = pixels.map(|pixel| f16::from_f32(pixel[channel]).to_f32());
            assert_eq!(exr_channel(&image, name), (expected.to_vec(), false));
        }
        let depth = vec![1.0, 2.0, 3.0, FAR_AWAY];
        assert_eq!(exr_channel(&image, "Z"), (depth, true));
    }
}

#[test]
fn a_layer_with_a_name_is_read_back_under_it() {
    let mut film = film(2, Shown::Never, &[[1.0; 4], [0.5; 4]]);
    film.layers.push(Layer {
        // More than 16 bits could tell apart.
        values: vec![1.0, 70_001.0, 3.25, 0.0],
        ..COST
    });
    let image = exr(&film, None);
    assert_eq!(exr_channel(&image, "cost.nodes"), (vec![1.0, 3.25], true));
    let primitives = (vec![70_001.0, 0.0], true);
    assert_eq!(exr_channel(&image, "cost.primitives"), primitives);
    assert_eq!(exr_channel(&image, "Z").0.len(), 2);
}

#[test]
fn an_exr_is_one_part_of_zipped_scan_lines_from_the_top() {
    use exr::meta::{BlockDescription, MetaData, attribute::LineOrder};
    let film = film(1, Shown::Never, &[[0.5; 4], [1.0; 4]]);
    let bytes = encoded(&film, Format::Exr, &Options::default());
    let headers = MetaData::read_from_buffered(&bytes[..], true)
        .unwrap()
        .headers;
    assert_eq!(headers.len(), 1);
    assert_eq!(headers[0].compression, exr::prelude::Compression::ZIP1);
    assert_eq!(headers[0].line_order, LineOrder::Increasing);
    assert_eq!(headers[0].blocks, BlockDescription::ScanLines);
    let names = headers[0].channels.list.iter();
    let names: Vec<String> = names.map(|channel| channel.name.to_string()).collect();
    assert_eq!(names, ["A", "B", "G", "R", "Z"]);
}

#[test]
fn an_exr_says_what_its_numbers_are_and_what_made_them() {
    let film = film(1, Shown::Never, &[[1.0; 4]]);
    let comments = "luch render сцена/é.glb";
    let image = exr(&film, Some(comments));
    let primaries = image.attributes.chromaticities.unwrap();
    assert_eq!(primaries.red, exr::math::Vec2(0.64, 0.33));
    assert_eq!(primaries.white, exr::math::Vec2(0.3127, 0.329));
    let attributes = image.layer_data.attributes;
    let id = &attributes.other[&Text::from("colorInteropID")];
    assert_eq!(id, &AttributeValue::Text(Text::from("lin_rec709_scene")));
    let software = attributes.software_name.unwrap().to_string();
    assert!(software.starts_with("luch "), "{software}");
    assert_eq!(attributes.comments.unwrap().bytes(), comments.as_bytes());
}

#[test]
fn the_attributes_of_an_exr_stand_in_the_order_of_their_names() {
    let options = Options {
        comments: Some("luch".into()),
        ..Options::default()
    };
    let bytes = encoded(&film(1, Shown::Never, &[[1.0; 4]]), Format::Exr, &options);
    let at = |name: &str| {
        let name = format!("{name}\0");
        let mut places = bytes.windows(name.len());
        places.position(|window| window == name.as_bytes()).unwrap()
    };
    let names = [
        "channels",
        "colorInteropID",
        "comments",
        "dataWindow",
        "software",
    ];
    assert!(names.map(at).is_sorted());
}

#[test]
fn too_much_light_for_a_half_keeps_its_colour() {
    let image = exr(&film(1, Shown::Never, &[[1e6, 5e5, 0.0, 1.0]]), None);
    let value = |name| exr_channel(&image, name).0[0];
    let colour = ["R", "G", "B", "A"].map(value);
    assert_eq!(colour, [65504.0, 32752.0, 0.0, 1.0]);
}

#[test]
fn no_number_of_an_exr_is_infinite_or_none() {
    let mut film = film(1, Shown::Never, &[[f32::NAN, f32::INFINITY, -1.0, 1.0]]);
    film.layers[1].values = vec![f32::INFINITY];
    let image = exr(&film, None);
    for name in ["R", "G", "B", "A", "Z"] {
        let (values, _) = exr_channel(&image, name);
        assert!(values.iter().all(|value| value.is_finite()), "{name}");
    }
}
