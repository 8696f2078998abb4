//! What luch writes, other readers read: crate `image` for PNG, crate `exr` for EXR.

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels, ReadLayers, Text, f16, read};
use image::{DynamicImage, ImageFormat};
use luch::Error;
use luch::color::Rgb;
use luch::film::{BEAUTY, DEPTH, FAR_AWAY, Film, Layer, Statistics};
use luch::output::{BitDepth, Destination, Display, Format, Options, encode};
use luch::scene::{Background, Shown};
use std::fs;
use std::io::{self, Write};
use std::path::Path;

type Reading = exr::prelude::Image<exr::prelude::Layer<exr::prelude::AnyChannels<FlatSamples>>>;

/// A film of these pixels, `width` a row, seen at distances 1, 2, 3...; the last is far away.
fn film(width: u32, shown: Shown, pixels: &[[f32; 4]]) -> Film {
    let mut depth: Vec<f32> = (1..=pixels.len()).map(|t| t as f32).collect();
    *depth.last_mut().unwrap() = FAR_AWAY;
    let layer = |layer: Layer, values| Layer { values, ..layer };
    Film {
        width,
        height: pixels.len() as u32 / width,
        layers: vec![
            layer(BEAUTY, pixels.as_flattened().to_vec()),
            layer(DEPTH, depth),
        ],
        background: Background {
            color: Rgb::new(0.5, 0.25, 1.0),
            shown,
        },
        complete: true,
        statistics: Statistics::default(),
    }
}

fn encoded(film: &Film, format: Format, options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(film, format, options, Path::new("test"), &mut bytes).unwrap();
    bytes
}

/// A PNG of `film`, decoded by crate `image`.
fn png(film: &Film, options: &Options) -> DynamicImage {
    let bytes = encoded(film, Format::Png, options);
    image::load_from_memory_with_format(&bytes, ImageFormat::Png).unwrap()
}

fn png_pixel(shown: Shown, pixel: [f32; 4], options: &Options) -> Vec<u8> {
    png(&film(1, shown, &[pixel]), options).as_bytes().to_vec()
}

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

struct Row {
    display: Display,
    light: [f32; 3],
    linear: [f32; 3],
    codes: [u8; 3],
}

/// 25 colours through each display transform, computed in double precision from the sources that the transforms name.
fn vectors() -> Vec<Row> {
    let row = |line: &str| {
        let mut cells = line.split(',');
        let name = cells.next().unwrap();
        let display = Display::ALL.into_iter().find(|d| d.name() == name).unwrap();
        let mut three = || [(); 3].map(|()| cells.next().unwrap().parse::<f32>().unwrap());
        Row {
            display,
            light: three(),
            linear: three(),
            codes: three().map(|code| code as u8),
        }
    };
    let table = include_str!("output/display_vectors.csv");
    table.lines().skip(1).map(row).collect()
}

#[test]
fn every_display_transform_agrees_with_its_source() {
    let rows = vectors();
    for display in Display::ALL {
        assert_eq!(rows.iter().filter(|r| r.display == display).count(), 25);
    }
    for row in rows {
        let shown: [f32; 3] = row.display.apply(row.light.into()).into();
        for (found, expected) in shown.into_iter().zip(row.linear) {
            assert!(
                (found - expected).abs() <= 2e-6,
                "{:?} of {:?}: {shown:?}, expected {:?}",
                row.display,
                row.light,
                row.linear
            );
        }
    }
}

#[test]
fn every_display_transform_gives_its_eight_bit_codes() {
    for display in Display::ALL {
        let rows: Vec<Row> = vectors()
            .into_iter()
            .filter(|r| r.display == display)
            .collect();
        let pixels: Vec<[f32; 4]> = rows
            .iter()
            .map(
                |Row {
                     light: [r, g, b], ..
                 }| [*r, *g, *b, 1.0],
            )
            .collect();
        let options = Options {
            display,
            ..Options::default()
        };
        let picture = png(&film(5, Shown::Always, &pixels), &options);
        let expected: Vec<u8> = rows.iter().flat_map(|row| row.codes).collect();
        assert_eq!(picture.as_bytes(), expected, "{display:?}");
    }
}

#[test]
fn a_png_has_its_rows_from_the_top_and_an_srgb_chunk() {
    let [black, white, red] = [[0.0, 0.0, 0.0, 1.0], [1.0; 4], [1.0, 0.0, 0.0, 1.0]];
    let film = film(2, Shown::Always, &[black, white, red, red, black, black]);
    let bytes = encoded(&film, Format::Png, &Options::default());
    assert!(bytes.windows(4).any(|chunk| chunk == b"sRGB"));
    let picture = png(&film, &Options::default()).into_rgb8();
    assert_eq!(picture.dimensions(), (2, 3));
    assert_eq!(picture.get_pixel(1, 0).0, [255, 255, 255]);
    assert_eq!(picture.get_pixel(0, 1).0, [255, 0, 0]);
    assert_eq!(picture.get_pixel(1, 2).0, [0, 0, 0]);
}

#[test]
fn a_background_for_displays_lies_behind_the_picture() {
    // Half covered by light of 0.5: 0.25 of it is in the pixel, and half of the background (0.5, 0.25, 1).
    let pixel = [0.25, 0.25, 0.25, 0.5];
    let options = Options {
        bit_depth: BitDepth::Sixteen,
        ..Options::default()
    };
    let half = png_pixel(Shown::OnDisplay, pixel, &options);
    let whole = png_pixel(Shown::Always, [0.5, 0.375, 0.75, 1.0], &options);
    assert_eq!(half.len(), 6);
    assert_eq!(half, whole);
}

#[test]
fn a_picture_without_background_has_straight_alpha() {
    // Premultiplied light of 0.18 under an alpha of 1/4 is light of 0.72; display transforms see that.
    let pixel = [0.18, 0.045, 0.0, 0.25];
    for display in Display::ALL {
        let options = Options {
            display,
            ..Options::default()
        };
        let found = png_pixel(Shown::Never, pixel, &options);
        let opaque = png_pixel(Shown::Always, [0.72, 0.18, 0.0, 1.0], &options);
        assert_eq!(found[..3], opaque, "{display:?}");
        assert_eq!(found[3], 64);
    }
}

#[test]
fn nothing_is_transparent_black() {
    let nothing = png_pixel(Shown::Never, [0.0; 4], &Options::default());
    assert_eq!(nothing, [0; 4]);
}

#[test]
fn a_stop_of_exposure_doubles_the_light() {
    let one_stop = Options {
        exposure: 1.0,
        display: Display::Reinhard,
        ..Options::default()
    };
    let none = Options {
        exposure: 0.0,
        ..one_stop.clone()
    };
    for shown in [Shown::Always, Shown::OnDisplay, Shown::Never] {
        let [once, twice] = [[0.1, 0.2, 0.3, 1.0], [0.2, 0.4, 0.6, 1.0]];
        assert_eq!(
            png_pixel(shown, once, &one_stop),
            png_pixel(shown, twice, &none)
        );
    }
}

#[test]
fn sixteen_bits_refine_eight() {
    let pixels: Vec<[f32; 4]> = (0..=100)
        .map(|step| [step as f32 / 100.0, 0.0, 1.0, 1.0])
        .collect();
    let film = film(101, Shown::Never, &pixels);
    let sixteen = Options {
        bit_depth: BitDepth::Sixteen,
        ..Options::default()
    };
    let fine = png(&film, &sixteen);
    assert!(matches!(fine, DynamicImage::ImageRgba16(_)));
    let coarse = png(&film, &Options::default()).into_rgba8();
    for (fine, coarse) in fine.into_rgba16().iter().zip(coarse.iter()) {
        assert!((f32::from(*fine) / 257.0 - f32::from(*coarse)).abs() <= 0.51);
    }
}

#[test]
fn what_is_no_number_or_negative_is_black_in_a_png() {
    let pixel = [f32::NAN, -1.0, f32::INFINITY, 1.0];
    for shown in [Shown::Always, Shown::OnDisplay, Shown::Never] {
        let found = png_pixel(shown, pixel, &Options::default());
        assert_eq!(found[..3], [0, 0, 255], "{shown:?}");
    }
    let found = png_pixel(Shown::Never, [1.0, 1.0, 1.0, f32::NAN], &Options::default());
    assert_eq!(found, [0; 4]);
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

#[test]
fn the_same_film_becomes_the_same_bytes() {
    let pixels: Vec<[f32; 4]> = (0..4096u32)
        .map(|at| [at as f32 / 4096.0, (at % 64) as f32, (at % 7) as f32, 1.0])
        .collect();
    let film = film(64, Shown::Always, &pixels);
    let options = Options {
        comments: Some("luch render".into()),
        ..Options::default()
    };
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    for format in [Format::Png, Format::Exr] {
        let once = encoded(&film, format, &options);
        assert_eq!(once, encoded(&film, format, &options));
        let alone = one_thread.as_ref().unwrap();
        assert_eq!(once, alone.install(|| encoded(&film, format, &options)));
    }
}

#[test]
fn the_extension_names_the_format_in_either_case() {
    let of = |name: &str| Format::of(Path::new(name)).ok();
    assert_eq!(of("a.png"), Some(Format::Png));
    assert_eq!(of("b/a.b.EXR"), Some(Format::Exr));
    assert_eq!([of("a.jpg"), of("png"), of(".png"), of("-")], [None; 4]);
    let error = Format::of(Path::new("a.jpg")).unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }));
    assert!(error.to_string().starts_with("a.jpg: "), "{error}");
    assert!(error.to_string().contains(".png or .exr"), "{error}");
}

/// The names of what lies in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_whole_and_alone() {
    let folder = tempfile::tempdir().unwrap();
    let film = film(1, Shown::Always, &[[1.0; 4]]);
    for name in [
        "a.png",
        "b.exr",
        "наклон и очень длинное имя".repeat(5).as_str(),
    ] {
        let path = folder.path().join(name).with_extension("png");
        Destination::claim(&path)
            .unwrap()
            .write(&film, &Options::default())
            .unwrap();
        assert_eq!(
            fs::read(&path).unwrap(),
            encoded(&film, Format::Png, &Options::default())
        );
        fs::remove_file(path).unwrap();
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn an_old_file_stays_until_the_new_one_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    fs::write(&path, "old").unwrap();
    let destination = Destination::claim(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(destination.path(), path);
    assert_eq!(destination.format(), Format::Exr);
    let film = film(1, Shown::Always, &[[1.0; 4]]);
    destination.write(&film, &Options::default()).unwrap();
    let expected = encoded(&film, Format::Exr, &Options::default());
    assert_eq!(fs::read(&path).unwrap(), expected);
    assert_eq!(names(folder.path()), ["a.exr"]);
}

#[test]
fn a_failed_write_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    let mut film = film(1, Shown::Always, &[[1.0; 4]]);
    film.layers[0].values.pop();
    let destination = Destination::claim(&path).unwrap();
    let error = destination.write(&film, &Options::default()).unwrap_err();
    assert!(error.to_string().contains("3 values"), "{error}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.png"]);
}

#[test]
fn a_destination_that_is_dropped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let destination = Destination::claim(&folder.path().join("a.png")).unwrap();
    let temporary = destination.temporary_path().to_owned();
    let [name] = &names(folder.path())[..] else {
        panic!("only the temporary file lies there")
    };
    assert!(
        name.starts_with(".a.png.") && name.ends_with(".tmp"),
        "{name}"
    );
    assert!(temporary.is_absolute() && temporary.ends_with(name));
    drop(destination);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_unwritable_path_is_found_before_there_is_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name);
    fs::create_dir(inside("folder.png")).unwrap();
    fs::write(inside("file"), "").unwrap();
    for (path, expected) in [
        (inside("folder.png"), "is a folder"),
        (inside("missing/a.png"), "cannot write into its folder"),
        (inside("file/a.png"), "cannot open"),
        (inside("a.txt"), "does not end in"),
    ] {
        let error = Destination::claim(&path).unwrap_err().to_string();
        assert!(error.starts_with(path.to_str().unwrap()), "{error}");
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(names(folder.path()), ["file", "folder.png"]);
}

#[test]
fn a_write_protected_file_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let error = Destination::claim(&path).unwrap_err();
    assert!(error.to_string().contains("is write-protected"), "{error}");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn write(path: &Path) {
        let film = film(1, Shown::Always, &[[1.0; 4]]);
        let destination = Destination::claim(path).unwrap();
        destination.write(&film, &Options::default()).unwrap();
    }

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn what_a_link_leads_to_is_replaced_and_the_link_stays() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        fs::create_dir(inside("frames")).unwrap();
        fs::write(inside("frames/7.png"), "old").unwrap();
        symlink("frames/7.png", inside("last.png")).unwrap();
        symlink("frames/8.png", inside("next.png")).unwrap();
        for (link, file) in [("last.png", "frames/7.png"), ("next.png", "frames/8.png")] {
            write(&inside(link));
            assert_eq!(fs::read_link(inside(link)).unwrap(), Path::new(file));
            assert!(fs::read(inside(file)).unwrap().starts_with(b"\x89PNG"));
        }
        assert_eq!(names(&inside("frames")), ["7.png", "8.png"]);
        assert_eq!(names(folder.path()), ["frames", "last.png", "next.png"]);
    }

    #[test]
    fn a_link_to_itself_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        symlink("a.png", &path).unwrap();
        let error = Destination::claim(&path).unwrap_err();
        assert!(error.to_string().contains("too many links"), "{error}");
    }

    #[test]
    fn a_device_is_no_destination() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("null.png");
        symlink("/dev/null", &path).unwrap();
        let error = Destination::claim(&path).unwrap_err();
        assert!(error.to_string().contains("is a device"), "{error}");
    }

    #[test]
    fn a_new_file_has_ordinary_permissions_and_a_replaced_one_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let ordinary = folder.path().join("ordinary");
        fs::write(&ordinary, "").unwrap();
        let path = folder.path().join("a.png");
        write(&path);
        assert_eq!(mode(&path), mode(&ordinary));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write(&path);
        assert_eq!(mode(&path), 0o640);
    }
}

/// Has room for so many bytes, then is full.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.checked_sub(bytes.len()) {
            Some(room) => self.0 = room,
            None => return Err(io::ErrorKind::StorageFull.into()),
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_ends() {
    let film = film(1, Shown::Always, &[[1.0; 4], [0.5; 4]]);
    for format in [Format::Png, Format::Exr] {
        let options = Options::default();
        let size = encoded(&film, format, &options).len();
        for room in 0..size {
            let written = encode(&film, format, &options, Path::new("a"), &mut Full(room));
            match written {
                Err(Error::Io { source, .. }) => {
                    assert_eq!(source.kind(), io::ErrorKind::StorageFull);
                }
                other => panic!("{format:?} in {room} bytes: {other:?}"),
            }
        }
    }
}

#[test]
fn a_film_without_pixels_or_beauty_is_an_error() {
    let whole = film(1, Shown::Always, &[[1.0; 4]]);
    let without_pixels = Film {
        width: 0,
        ..whole.clone()
    };
    let without_beauty = Film {
        layers: Vec::new(),
        ..whole.clone()
    };
    let too_wide = Film {
        width: u32::MAX,
        ..whole
    };
    for film in [without_pixels, without_beauty, too_wide] {
        for format in [Format::Png, Format::Exr] {
            let options = Options::default();
            let result = encode(&film, format, &options, Path::new("a"), &mut io::sink());
            assert!(matches!(result, Err(Error::Malformed { .. })));
        }
    }
}
