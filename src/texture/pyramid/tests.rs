use super::*;

fn image(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let pixels = (0..width * height).map(|at| pixel(at % width, at / width));
    Image {
        name: String::new(),
        width,
        height,
        pixels: Pixels::Eight(pixels.collect()),
    }
}

fn bytes(image: &Image) -> &[[u8; 4]] {
    match &image.pixels {
        Pixels::Eight(pixels) => pixels,
        Pixels::Sixteen(_) => &[],
    }
}

#[test]
fn levels_of_one_colour_have_that_colour() {
    for encoding in [Encoding::Srgb, Encoding::Linear] {
        for size in [[8, 8], [7, 5], [1, 9], [13, 1], [6, 3]] {
            for byte in 0..=255 {
                let color = [byte, 255 - byte, byte / 2, 200];
                let image = image(size[0], size[1], |_, _| color);
                for fourth in [Fourth::Number, Fourth::Coverage] {
                    let pyramid = Pyramid::of(&image, encoding, fourth);
                    let all = pyramid.levels().iter().flat_map(bytes);
                    assert!(all.into_iter().all(|pixel| *pixel == color));
                }
            }
        }
    }
}

#[test]
fn the_last_level_is_one_pixel_and_each_has_half_the_pixels_of_the_one_below() {
    let pyramid = Pyramid::of(
        &image(13, 4, |_, _| [0; 4]),
        Encoding::Linear,
        Fourth::Number,
    );
    let sizes = pyramid
        .levels()
        .iter()
        .map(|level| [level.width, level.height]);
    assert_eq!(sizes.collect::<Vec<_>>(), [[6, 2], [3, 1], [1, 1]]);
}

#[test]
fn a_checkers_mean_is_half_of_the_light_not_half_of_the_bytes() {
    let board = image(4, 4, |x, y| {
        let white = 255 * ((x + y) % 2) as u8;
        [white, white, white, 255]
    });
    let srgb = Pyramid::of(&board, Encoding::Srgb, Fourth::Number);
    // 0.5 of the light is 187.5 of 255.
    assert!(
        bytes(&srgb.levels()[0])
            .iter()
            .all(|pixel| *pixel == [188, 188, 188, 255])
    );
    let linear = Pyramid::of(&board, Encoding::Linear, Fourth::Number);
    assert!(
        bytes(&linear.levels()[1])
            .iter()
            .all(|pixel| *pixel == [128, 128, 128, 255])
    );
}

#[test]
fn every_pixel_of_an_odd_image_counts_alike() {
    for at in 0..49 {
        let board = image(7, 7, |x, y| [if y * 7 + x == at { 245 } else { 0 }; 4]);
        let pyramid = Pyramid::of(&board, Encoding::Linear, Fourth::Number);
        let [last] = bytes(&pyramid.levels()[1]) else {
            panic!("two levels");
        };
        // 245 / 49 = 5, rounded twice.
        assert!((4..=6).contains(&last[0]), "{at}: {last:?}");
    }
}

#[test]
fn what_is_not_there_gives_no_colour_to_what_is() {
    let leaf = image(
        2,
        2,
        |x, _| if x == 0 { [200, 100, 50, 255] } else { [0; 4] },
    );
    let pyramid = Pyramid::of(&leaf, Encoding::Srgb, Fourth::Coverage);
    assert_eq!(bytes(&pyramid.levels()[0]), [[200, 100, 50, 128]]);
    // Where the fourth channel is something else, colours count alike.
    let pyramid = Pyramid::of(&leaf, Encoding::Linear, Fourth::Number);
    assert_eq!(bytes(&pyramid.levels()[0]), [[100, 50, 25, 128]]);
}

#[test]
fn a_mask_keeps_how_much_of_it_is_there() {
    // Three of four pixels reach the cutoff; the mean of their alphas would not.
    let alphas = [130, 130, 130, 0];
    let leaf = image(2, 2, |x, y| [9, 9, 9, alphas[(y * 2 + x) as usize]]);
    let mask = Fourth::Mask { cutoff: 0.5 };
    let pyramid = Pyramid::of(&leaf, Encoding::Srgb, mask);
    assert_eq!(bytes(&pyramid.levels()[0]), [[9, 9, 9, 191]]);
}
