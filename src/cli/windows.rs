//! Which pixels of a picture are rendered: a crop, one of several tiles, a margin.

use super::Failure;
use super::values::whole_number;
use clap::Args;
use luch::film::Window;
use luch::render::Settings;

/// What can be said of a picture's window.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct WindowArguments {
    /// Render these pixels alone, from column X0 and row Y0, of the picture's upper left corner, to before column X1 and
    /// row Y1. Each is what it is in the whole picture; an EXR says where they lie, a PNG is the crop
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, conflicts_with = "tile", value_parser = crop)]
    crop: Option<Crop>,

    /// Render tile I of N alone, from 1: one of N strips from the top; or the tile in column I of NX and row J of NY
    #[arg(long, value_name = "I/N|I,J/NX,NY", allow_hyphen_values = true, value_parser = tile)]
    tile: Option<Tile>,

    /// Render so many pixels more on each side of the picture, which stays as it is: an EXR's data window is larger than
    /// its display window then
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = whole_number(0..=MOST_OVERSCAN))]
    overscan: Option<u32>,
}

/// More than any picture in memory is wide.
const MOST_OVERSCAN: u32 = 1 << 28;

/// The first column and row, and those behind the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Crop([i32; 4]);

/// One of `[count; 2]` tiles across and down, each from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Tile {
    number: [u32; 2],
    count: [u32; 2],
}

impl WindowArguments {
    /// The settings for those pixels that are asked for.
    pub(super) fn of(&self, settings: Settings) -> Result<Settings, Failure> {
        let overscan = self.overscan.unwrap_or(0);
        let whole = Window::whole(settings.width(), settings.height()).grown(overscan);
        let window = match (self.crop, self.tile) {
            (Some(crop), _) => crop.of(whole, overscan),
            (_, Some(tile)) => tile.of(whole),
            _ => Ok(whole),
        };
        window.map_err(Failure::usage_or_scene).and_then(|window| {
            let settings = settings.with_window(window);
            settings.map_err(Failure::usage_or_scene)
        })
    }
}

impl Crop {
    fn of(self, whole: Window, overscan: u32) -> Result<Window, String> {
        let Crop([left, top, right, bottom]) = self;
        let window = Window {
            left,
            top,
            width: left.abs_diff(right),
            height: top.abs_diff(bottom),
        };
        if window.is_within(whole) {
            return Ok(window);
        }
        let Window { width, height, .. } = whole;
        let picture = match overscan {
            0 => format!(
                "the picture of {width} x {height} pixels; keep it inside, or add a margin with --overscan"
            ),
            _ => format!(
                "the picture and its margin, {},{},{},{}; keep it inside, or make --overscan larger",
                whole.left,
                whole.top,
                whole.right(),
                whole.bottom()
            ),
        };
        Err(format!(
            "--crop {left},{top},{right},{bottom} reaches beyond {picture}"
        ))
    }
}

impl Tile {
    fn of(self, whole: Window) -> Result<Window, String> {
        let Tile {
            number: [i, j],
            count: [across, down],
        } = self;
        let Window { width, height, .. } = whole;
        if across > width || down > height {
            return Err(format!(
                "--tile asks for {across} tiles across and {down} down of {width} x {height} pixels, some without a pixel; \
                 ask for fewer"
            ));
        }
        Ok(whole.column(i, across).strip(j, down))
    }
}

/// Four numbers, as in `0,0,320,240`.
fn crop(text: &str) -> Result<Crop, String> {
    let numbers = text.split(',').map(|number| number.trim().parse());
    let numbers: Result<Vec<i32>, _> = numbers.collect();
    match numbers.as_deref() {
        Ok(&[left, top, right, bottom]) if left < right && top < bottom => {
            Ok(Crop([left, top, right, bottom]))
        }
        Ok(&[_, _, _, _]) => {
            Err("expected the second column and row, which are not in the crop, above the first, as in 0,0,320,240".into())
        }
        _ => Err("expected four whole numbers of pixels with commas between, as in 0,0,320,240".into()),
    }
}

/// A tile and how many there are, as in `2/8`, or `1,2/4,3`.
fn tile(text: &str) -> Result<Tile, String> {
    let pair = |text: &str| {
        let (across, down) = text.split_once(',')?;
        Some([across.trim().parse().ok()?, down.trim().parse().ok()?])
    };
    let both = |(number, count): (&str, &str)| match number.contains(',') {
        true => Some((pair(number)?, pair(count)?)),
        false => Some((
            [1, number.trim().parse().ok()?],
            [1, count.trim().parse().ok()?],
        )),
    };
    let found = text.split_once('/').and_then(both);
    let (number, count): ([u32; 2], [u32; 2]) = found.ok_or(
        "expected a tile and how many there are, as in 2/8, or column and row, as in 1,2/4,3",
    )?;
    let mut counted = number.iter().zip(&count);
    match counted.find(|(number, count)| !(1..=**count).contains(number)) {
        Some((number, count)) => Err(format!(
            "there is no tile {number} of {count}; the first is 1, the last {count}"
        )),
        None => Ok(Tile { number, count }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_is_two_corners_of_which_the_second_is_outside() {
        assert_eq!(crop("-1, 2,30,4"), Ok(Crop([-1, 2, 30, 4])));
        for wrong in [
            "",
            "1,2,3",
            "1,2,3,4,5",
            "0.5,0,1,1",
            "5,0,5,1",
            "0,3,1,2",
            "0,0,1,99999999999",
        ] {
            assert!(crop(wrong).is_err(), "{wrong}");
        }
        let whole = Window::whole(40, 4);
        let outside = crop("-1,2,30,4").and_then(|crop| crop.of(whole, 0));
        assert_eq!(
            outside,
            Err("--crop -1,2,30,4 reaches beyond the picture of 40 x 4 pixels; keep it inside, or add a margin with --overscan".into())
        );
        let far = crop("-2147483648,-2147483648,2147483647,2147483647");
        assert!(far.and_then(|crop| crop.of(whole.grown(9), 9)).is_err());
        assert!(
            crop("-1,2,30,4")
                .and_then(|crop| crop.of(whole.grown(1), 1))
                .is_ok()
        );
    }

    #[test]
    fn a_tile_is_one_of_so_many_from_the_first() {
        let strip = Tile {
            number: [1, 2],
            count: [1, 8],
        };
        assert_eq!(tile("2/8"), Ok(strip));
        let square = Tile {
            number: [4, 1],
            count: [4, 3],
        };
        assert_eq!(tile("4,1/4,3"), Ok(square));
        assert_eq!(
            tile("0/4"),
            Err("there is no tile 0 of 4; the first is 1, the last 4".into())
        );
        for wrong in [
            "",
            "2",
            "/",
            "1/0",
            "5/4",
            "1,2/4",
            "1/4,3",
            "1,5/4,3",
            "-1/4",
            "1.5/4",
            "1,1,1/2,2,2",
        ] {
            assert!(tile(wrong).is_err(), "{wrong}");
        }
        assert!(strip.of(Window::whole(1, 7)).is_err());
    }
}
