//! Which pixels a film has: any rectangle of the plane that the picture lies in.

/// A rectangle of pixels. The pixel at `[0, 0]` is the upper left one of the whole picture; what lies to the left of it or
/// above has negative places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// The column of its leftmost pixels.
    pub left: i32,
    /// The row of its uppermost pixels.
    pub top: i32,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
}

impl Window {
    /// The window of a whole picture.
    pub const fn whole(width: u32, height: u32) -> Window {
        Window {
            left: 0,
            top: 0,
            width,
            height,
        }
    }

    /// The first column to the right of it.
    pub fn right(self) -> i64 {
        i64::from(self.left) + i64::from(self.width)
    }

    /// The first row below it.
    pub fn bottom(self) -> i64 {
        i64::from(self.top) + i64::from(self.height)
    }

    /// How many pixels it has.
    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Where the pixel of this column and row is, row by row from the top; `None` outside the window.
    pub fn index(self, [i, j]: [i32; 2]) -> Option<usize> {
        let is_inside = i >= self.left && j >= self.top;
        let (across, down) = (i.abs_diff(self.left), j.abs_diff(self.top));
        let is_inside = is_inside && across < self.width && down < self.height;
        is_inside.then(|| down as usize * self.width as usize + across as usize)
    }

    /// Whether the pixel of this column and row is in the window.
    pub fn contains(self, place: [i32; 2]) -> bool {
        self.index(place).is_some()
    }

    /// Whether every pixel of it is one of `other`.
    pub fn is_within(self, other: Window) -> bool {
        self.left >= other.left
            && self.top >= other.top
            && self.right() <= other.right()
            && self.bottom() <= other.bottom()
    }

    /// The window with so many pixels more on each side.
    pub fn grown(self, by: u32) -> Window {
        let both = by.saturating_mul(2);
        Window {
            left: self.left.saturating_sub_unsigned(by),
            top: self.top.saturating_sub_unsigned(by),
            width: self.width.saturating_add(both),
            height: self.height.saturating_add(both),
        }
    }

    /// The pixels that it shares with `other`; `None` where there are none.
    pub fn shared(self, other: Window) -> Option<Window> {
        let (left, top) = (self.left.max(other.left), self.top.max(other.top));
        let (right, bottom) = (
            self.right().min(other.right()),
            self.bottom().min(other.bottom()),
        );
        let side = |from: i32, to: i64| u32::try_from(to - i64::from(from)).ok();
        let (width, height) = (side(left, right)?, side(top, bottom)?);
        (width > 0 && height > 0).then_some(Window {
            left,
            top,
            width,
            height,
        })
    }

    /// Part `number` of `count`, from 1, of the same height but for a pixel, from the top: all of them together are the
    /// window. Parts are empty where there are more of them than rows.
    pub fn strip(self, number: u32, count: u32) -> Window {
        let [above, below] = cuts(self.height, number, count);
        Window {
            top: self.top.saturating_add_unsigned(above),
            height: below - above,
            ..self
        }
    }

    /// Part `number` of `count`, from 1, of the same width but for a pixel, from the left.
    pub fn column(self, number: u32, count: u32) -> Window {
        let [before, after] = cuts(self.width, number, count);
        Window {
            left: self.left.saturating_add_unsigned(before),
            width: after - before,
            ..self
        }
    }
}

/// Where part `number` of `count` begins and ends.
fn cuts(length: u32, number: u32, count: u32) -> [u32; 2] {
    let count = count.max(1);
    let number = number.clamp(1, count);
    // No more than the length, which is 32 bits.
    let cut = |parts: u32| (u64::from(length) * u64::from(parts) / u64::from(count)) as u32;
    [cut(number - 1), cut(number)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_an_index_in_its_window_alone() {
        let window = Window {
            left: -2,
            top: 3,
            width: 4,
            height: 2,
        };
        assert_eq!(window.index([-2, 3]), Some(0));
        assert_eq!(window.index([1, 4]), Some(7));
        for outside in [[-3, 3], [2, 3], [0, 2], [0, 5], [i32::MAX, i32::MIN]] {
            assert_eq!(window.index(outside), None, "{outside:?}");
        }
    }

    #[test]
    fn parts_cover_their_window_without_overlap() {
        for height in [1, 2, 7, 48, 1081] {
            let window = Window::whole(5, height);
            for count in (1..=height.min(60)).chain([height]) {
                let parts = (1..=count).map(|number| window.strip(number, count));
                let bottom = parts.fold(0, |bottom, part| {
                    assert_eq!(i64::from(part.top), bottom);
                    assert!(part.height > 0 && part.width == 5);
                    part.bottom()
                });
                assert_eq!(bottom, i64::from(height));
            }
        }
        let [left, right] = [1, 2].map(|number| Window::whole(5, 3).column(number, 2));
        assert_eq!([left.width, right.width, right.left as u32], [2, 3, 2]);
    }

    #[test]
    fn what_windows_share_is_in_both() {
        let whole = Window::whole(10, 10);
        let beyond = whole.grown(1);
        assert_eq!(beyond.shared(whole), Some(whole));
        assert!(whole.is_within(beyond) && !beyond.is_within(whole));
        let far = Window { left: 10, ..whole };
        assert_eq!(whole.shared(far), None);
    }
}
