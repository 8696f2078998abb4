//! The display transforms, against numbers from their sources.

use super::as_png::png;
use super::film;
use luch::output::{Display, Options};
use luch::scene::Shown;

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
    let table = include_str!("display_vectors.csv");
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
